! A Fortran host as its authors debug it: -ffpe-trap=invalid,zero,overflow, which ends the program at the first NaN. It makes the
! mistakes hosts make, runs out of memory at every allocation of a model, and reaches its last line.
program trapping_host
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use, intrinsic :: ieee_exceptions
  use ents
  implicit none

  interface
    ! support/memory.hpp
    subroutine memory_watch(failing, forever) bind(c)
      import :: c_int, c_long
      integer(c_long), value :: failing
      integer(c_int), value :: forever
    end subroutine memory_watch
    subroutine memory_unwatch() bind(c)
    end subroutine memory_unwatch
    function memory_left() bind(c)
      import :: c_long
      integer(c_long) :: memory_left
    end function memory_left
  end interface

  character(*), parameter :: model_text = '{"segment": "quad4",' // &
    ' "height": {"type": "map", "size": [2.0, 2.0], "origin": [-1, -1], "boundary": "clamped",' // &
    ' "values": [[0.0, 0.01, 0.02], [0.01, 0.03, -0.01], [0.0, 0.02, 0.01]]},' // &
    ' "contact": {"normal": {"type": "penalty", "stiffness": 1000.0},' // &
    ' "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 500.0}}}'
  integer, parameter :: dofs = 15
  integer(c_int64_t), parameter :: nan_bits = int(z'7FF8000000000000', c_int64_t), &
    signalling_bits = int(z'7FF4000000000000', c_int64_t), infinity_bits = int(z'7FF0000000000000', c_int64_t)

  real(c_double), target :: slave(3), master(3, 4), state(16), residual(dofs), tangent(dofs, dofs), gap
  real(c_double), parameter :: good_slave(3) = [0.1d0, 0.2d0, -0.01d0]
  real(c_double), parameter :: good_master(3, 4) = reshape( &
    [-1.0d0, -1.0d0, 0.1d0, 1.2d0, -1.0d0, 0.0d0, 1.0d0, 1.0d0, 0.0d0, -1.0d0, 0.9d0, 0.0d0], [3, 4])
  type(ents_report) :: report
  type(c_ptr) :: model
  integer(c_long) :: k, left
  integer(c_int32_t) :: status
  integer :: i

  call expect_traps("at the start")
  call ents_init(report)

  ! memory ends at the k-th allocation
  status = ENTS_NO_MEMORY
  k = 0
  do while (status /= ENTS_OK)
    k = k + 1
    call memory_watch(k, 1_c_int)
    status = ents_model_create(model_text, len(model_text, c_int64_t), c_null_ptr, c_null_ptr, 0_c_int64_t, model, report)
    call memory_unwatch()
    left = memory_left()
    if (status == ENTS_OK) exit
    call expect(status == ENTS_NO_MEMORY, "no memory is a status: " // ents_string(report%message))
    call expect(left == 0_c_long .and. .not. c_associated(model), "nothing is left of the model")
  end do
  call expect(k > 10, "a model takes more than ten allocations")

  ! texts that are no models
  call expect(create("") == ENTS_JSON_SYNTAX, "no text")
  call expect(create('{"segment": "quad5"}') == ENTS_BAD_VALUE, "a word without meaning")
  call expect(create('{"segment": "quad4", "penetration_limit": 1e999}') == ENTS_BAD_VALUE, "a number beyond the largest")
  call expect(create('{"segment": "quad4", "hight": null}') == ENTS_UNKNOWN_KEY, "an unknown key")

  ! numbers that are none, and numbers at the ends of the range
  call expect(evaluate() == ENTS_OK, "a good element: " // ents_string(report%message))
  call expect(gap < 0.0d0, "it is in contact")
  do i = 1, 3
    slave(i) = transfer(nan_bits, 0d0)
    call expect(evaluate() == ENTS_NON_FINITE, "NaN")
    slave(i) = transfer(signalling_bits, 0d0)
    call expect(evaluate() == ENTS_NON_FINITE, "signalling NaN")
    slave(i) = transfer(infinity_bits, 0d0)
    call expect(evaluate() == ENTS_NON_FINITE, "infinity")
    slave(i) = huge(1d0)
    call expect(evaluate() >= 0, "the largest number")
    slave(i) = tiny(1d0) / 1024
    call expect(evaluate() == ENTS_OK, "a denormal number")
  end do
  master = 0.5d0
  call expect(evaluate() == ENTS_DEGENERATE_SEGMENT, "a segment without area")
  call expect(report%step_factor > 0 .and. report%step_factor < 1, "how to go on")
  master = 1d200 * good_master
  call expect(evaluate() >= 0, "a huge segment")
  master = 1d-200 * good_master
  call expect(evaluate() >= 0, "a tiny segment")
  state = transfer(signalling_bits, 0d0)
  call expect(evaluate(with_state=.true.) == ENTS_BAD_STATE, "a state that was never made")

  call expect(evaluate() == ENTS_OK, "a good element after all that")
  call expect(ents_model_destroy(model, report) == ENTS_OK, "destroy")
  call expect_traps("at the end")
  write (*, '(a)') "last line"

contains

  subroutine expect(condition, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: what
    if (condition) return
    write (error_unit, '(2a)') "failed: ", what
    stop 1
  end subroutine expect

  subroutine expect_traps(when)
    character(*), intent(in) :: when
    logical :: halts(3)
    call ieee_get_halting_mode([ieee_invalid, ieee_divide_by_zero, ieee_overflow], halts)
    call expect(all(halts), "invalid, zero and overflow trap " // when)
  end subroutine expect_traps

  function create(text) result(outcome)
    character(*), intent(in) :: text
    type(c_ptr) :: none
    integer(c_int32_t) :: outcome
    outcome = ents_model_create(text, len(text, c_int64_t), c_null_ptr, c_null_ptr, 0_c_int64_t, none, report)
    call expect(.not. c_associated(none) .and. report%message(1) /= c_null_char, "no handle, but a message")
  end function create

  ! The element, then its numbers are the good ones again.
  function evaluate(with_state) result(outcome)
    logical, intent(in), optional :: with_state
    type(ents_input) :: input
    type(ents_output) :: output
    integer(c_int32_t) :: outcome
    logical, save :: filled = .false.
    if (.not. filled) call refill()
    filled = .true.
    call ents_init(input)
    input%slave = c_loc(slave)
    input%master = c_loc(master)
    if (present(with_state)) input%state_begin = c_loc(state)
    call ents_init(output)
    output%wanted = ENTS_GAP + ENTS_RESIDUAL + ENTS_TANGENT
    output%gap = c_loc(gap)
    output%residual = c_loc(residual)
    output%tangent = c_loc(tangent)
    outcome = ents_evaluate(model, 0_c_int64_t, 1_c_int64_t, input, output, report)
    call refill()
  end function evaluate

  subroutine refill()
    slave = good_slave
    master = good_master
  end subroutine refill

end program trapping_host
