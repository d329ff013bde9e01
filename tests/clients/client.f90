! Three slave nodes against one quad4 segment that carries a sine: as one batch, then one by one. client.c and client.cpp do the
! same; all three print the same text. 17 significant digits name a double: same text, same bits.
program client
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use ents
  implicit none

  character(*), parameter :: model_text = &
    '{"segment": "quad4",' // &
    ' "height": {"type": "sine", "amplitude": 0.05, "wave_vector": [0.5, 0.25], "phase": 0.3},' // &
    ' "projection": {"type": "normal"},' // &
    ' "contact": {"normal": {"type": "penalty", "stiffness": 1000.0}}}'

  integer, parameter :: elements = 3, dofs = 3 * (1 + 4)

  type result
    integer(c_int32_t) :: flags(elements) = 0
    real(c_double) :: gap(elements) = 0
    real(c_double) :: residual(dofs, elements) = 0
    real(c_double) :: tangent(dofs, dofs, elements) = 0
  end type result

  real(c_double), target :: slave(3, elements) = reshape( &
    [0.1d0, 0.2d0, 0.02d0, -0.4d0, 0.3d0, -0.01d0, 0.5d0, -0.6d0, 0.4d0], [3, elements])
  real(c_double), target :: master(3, 4) = reshape( &
    [-1.0d0, -1.0d0, 0.1d0, 1.2d0, -1.0d0, 0.0d0, 1.0d0, 1.0d0, 0.0d0, -1.0d0, 0.9d0, 0.0d0], [3, 4])

  type(c_ptr) :: model
  type(ents_report) :: report
  type(result), target :: batch, single
  integer :: e

  call ents_init(report)
  call check(ents_check_contract(ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR, report))
  call check(ents_model_create(model_text, len(model_text, c_int64_t), c_null_ptr, c_null_ptr, 0_c_int64_t, model, report))
  call evaluate(0, elements, batch)
  do e = 0, elements - 1
    call evaluate(e, 1, single)
  end do
  if (any(transfer(batch, [0_c_int8_t]) /= transfer(single, [0_c_int8_t]))) then
    write (error_unit, '(a)') "the batch differs from single calls"
    stop 1
  end if

  do e = 1, elements
    write (*, '(a,2(1x,i0))') "contact", e - 1, iand(batch%flags(e), ENTS_FLAG_CONTACT)
    call print_values("gap", e - 1, batch%gap(e:e))
    call print_values("residual", e - 1, batch%residual(:, e))
    call print_values("tangent", e - 1, reshape(batch%tangent(:, :, e), [dofs * dofs]))
  end do
  call check(ents_model_destroy(model, report))

contains

  ! Evaluate the elements first .. first + count - 1 into their places in the arrays; `first` counts from 0.
  subroutine evaluate(first, count, values)
    integer, intent(in) :: first, count
    type(result), intent(inout), target :: values
    type(ents_input) :: input
    type(ents_output) :: output

    call ents_init(input)
    input%slave = c_loc(slave)
    input%slave_stride = 3
    input%master = c_loc(master) ! stride 0: one segment for all

    call ents_init(output)
    output%wanted = ENTS_FLAGS + ENTS_GAP + ENTS_RESIDUAL + ENTS_TANGENT
    output%gap = c_loc(values%gap)
    output%gap_stride = 1
    output%residual = c_loc(values%residual)
    output%residual_stride = dofs
    output%tangent = c_loc(values%tangent)
    output%tangent_stride = dofs * dofs
    output%flags = c_loc(values%flags)
    output%flags_stride = 1

    call check(ents_evaluate(model, int(first, c_int64_t), int(count, c_int64_t), input, output, report))
  end subroutine evaluate

  subroutine check(status)
    integer(c_int32_t), intent(in) :: status
    if (status == ENTS_OK) return
    write (error_unit, '(2a,i0,2a)') ents_string(ents_status_text(status)), " (element ", report%element, "): ", &
      ents_string(report%message)
    stop 1
  end subroutine check

  subroutine print_values(name, element, values)
    character(*), intent(in) :: name
    integer, intent(in) :: element
    real(c_double), intent(in) :: values(:)
    integer :: i
    do i = 1, size(values)
      write (*, '(a,2(1x,i0),1x,es24.16e2)') name, element, i - 1, values(i)
    end do
  end subroutine print_values

end program client
