! SPDX-License-Identifier: BSD-3-Clause
! A small finite element program in Fortran: two linear elastic blocks, the upper one slides on the textured surface of the lower
! one, with friction. It solves scene.json of this folder, which ents-lab reads, too; of that file it takes the contact model. The
! rest is written below.
!
! usage: fortran_host SCENE
program host
  use, intrinsic :: iso_c_binding, only: c_int, real64 => c_double
  use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
  use bodies, only: rectangle, mesh_rectangle, add_stiffness
  use contact, only: start_contact, add_contact, accept_contact
  implicit none
  integer, parameter :: steps = 9, iterations = 25
  real(real64), parameter :: push(2) = [0.2d0, -0.3d0], tolerance = 1d-12
  type(rectangle) :: lower = rectangle([0d0, 0d0], [4d0, 2d0], [8, 4], 1000d0, 0.3d0), &
    upper = rectangle([1.1d0, 2.05d0], [2.95d0, 3.55d0], [5, 5], 5000d0, 0.3d0)
  integer, parameter :: nodes = 9*5 + 6*6, dofs = 2*nodes
  real(real64) :: x(2, nodes), u(dofs), r(dofs), bulk(dofs, dofs), k(dofs, dofs), a(dofs, dofs), jump(dofs), prescribed(dofs)
  real(real64) :: error
  logical :: fixed(dofs)
  integer :: pivots(dofs), info, count, step, iteration, i
  interface
    subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info) ! LAPACK
      import :: real64
      integer, intent(in) :: n, nrhs, lda, ldb
      real(real64), intent(inout) :: a(lda, *), b(ldb, *)
      integer, intent(out) :: ipiv(*), info
    end subroutine dgesv
    subroutine c_exit(status) bind(c, name="exit") ! of the C library: stop would print, and error stop a backtrace
      import :: c_int
      integer(c_int), value :: status
    end subroutine c_exit
  end interface

  count = 0
  bulk = 0
  call mesh_rectangle(lower, x, count)
  call mesh_rectangle(upper, x, count)
  call add_stiffness(lower, x, bulk)
  call add_stiffness(upper, x, bulk)
  call start_contact(model_of(argument()), upper%row(0), lower%row(4), x)
  fixed = .false.
  prescribed = 0
  fixed(dofs_of(lower%row(0))) = .true.
  fixed(dofs_of(upper%row(5))) = .true.
  prescribed(dofs_of(upper%row(5))) = [(push, i=1, 6)]

  u = 0
  do step = 1, steps
    jump = 0
    where (fixed) jump = prescribed*step/steps - u
    do iteration = 0, iterations
      r = matmul(bulk, u)
      k = bulk ! k(column, row), which is the same for the bodies
      if (.not. add_contact(x + reshape(u, [2, nodes]), r, k)) error stop "smaller steps are needed"
      error = norm2(pack(r, .not. fixed))/max(norm2(pack(r, fixed)), tiny(1d0))
      if (iteration > 0 .and. error <= tolerance) exit
      if (iteration == iterations) error stop "no convergence"
      ! Newton's step; the first one takes the jump of the supports.
      a = transpose(k)
      do i = 1, dofs
        if (.not. fixed(i)) cycle
        a(i, :) = 0
        a(i, i) = 1
      end do
      r = merge(jump, -r, fixed)
      call dgesv(dofs, 1, a, dofs, pivots, r, dofs, info)
      if (info /= 0) error stop "the tangent is singular"
      u = u + r
      jump = 0
    end do
    call accept_contact()
    associate (support => dofs_of(lower%row(0)))
      print '(a, i0, a, i0, a, i0, a, es8.1, a, 2es24.15)', "step ", step, "/", steps, "  iterations ", iteration, &
        "  |r| ", error, "  force on the support", sum(r(support(1::2))), sum(r(support(2::2)))
    end associate
  end do

contains

  function dofs_of(row) result(numbers)
    integer, intent(in) :: row(:)
    integer :: numbers(2*size(row)), n
    numbers = [(2*row(n) - 1, 2*row(n), n=1, size(row))]
  end function dofs_of

  function argument() result(text)
    character(:), allocatable :: text
    integer :: length
    if (command_argument_count() /= 1) then
      call usage(error_unit)
      call quit(2)
    end if
    call get_command_argument(1, length=length)
    allocate (character(length) :: text)
    call get_command_argument(1, text)
    if (text == "-h" .or. text == "--help") then
      call usage(output_unit)
      call quit(0)
    end if
  end function argument

  subroutine usage(unit)
    integer, intent(in) :: unit
    write (unit, '(a)') "usage: fortran_host SCENE", "", &
      "Two elastic blocks, the upper one slides on the textured surface of the lower one, with friction.", &
      "SCENE: examples/fortran_host/scene.json. Its contact model is read, the rest is written in host.f90.", "", &
      "exit status: 0 done; 1 no convergence, or a wrong model; 2 no scene, or a wrong command line"
  end subroutine usage

  ! A mistake in the command line or the scene.
  subroutine mistake(message)
    character(*), intent(in) :: message
    write (error_unit, '(a)') "fortran_host: " // message
    call quit(2)
  end subroutine mistake

  subroutine quit(status)
    integer, intent(in) :: status
    flush (output_unit)
    flush (error_unit)
    call c_exit(int(status, c_int))
  end subroutine quit

  ! The object behind "model": in a JSON file.
  function model_of(file) result(text)
    character(*), intent(in) :: file
    character(:), allocatable :: text
    character(1000) :: line, reason
    integer :: unit, status, depth, from, to
    open (newunit=unit, file=file, status="old", action="read", iostat=status, iomsg=reason)
    if (status /= 0) call mistake("the scene " // file // " cannot be read: " // trim(reason))
    text = ""
    do
      read (unit, '(a)', iostat=status, iomsg=reason) line
      if (is_iostat_end(status)) exit
      if (status /= 0) call mistake("the scene " // file // " cannot be read: " // trim(reason))
      text = text // trim(line) // new_line("a")
    end do
    close (unit)
    from = index(text, '"model"')
    if (from == 0) call mistake(file // ' has no key "model": give a scene of ents-lab')
    from = from + index(text(from:), "{") - 1
    depth = 0
    do to = from, len(text)
      if (text(to:to) == "{") depth = depth + 1
      if (text(to:to) == "}") depth = depth - 1
      if (depth == 0) exit
    end do
    text = text(from:to)
  end function model_of

end program host
