! SPDX-License-Identifier: BSD-3-Clause
! A host in Fortran: four slave nodes on springs are drawn, with friction, over a wavy rigid master of many segments. slide.c is the
! same program in C; both print the same forces.
! usage: slide MODEL.json [SEGMENTS]      The forces do not depend on the number of segments.
program slide
  use, intrinsic :: iso_c_binding, only: dp => c_double, long => c_int64_t, c_int32_t, c_loc, c_null_char, c_null_ptr, c_ptr
  use ents
  implicit none
  integer(long), parameter :: n = 4 ! slave nodes
  real(dp), target :: x(2, n), x_begin(2, n), xi(n), gap(n), R(2, n), K(2, 2, n)
  integer(long), target :: segment(n) = -1
  real(dp), allocatable, target :: nodes(:, :), s(:, :), tree(:), begin(:, :), end(:, :)
  integer(long), allocatable, target :: ends(:, :)
  integer(long) :: segments = 50, i
  real(dp) :: force(2), det(n)
  character(1000) :: argument
  type(c_ptr) :: model
  type(ents_report) :: report
  type(ents_master_mesh) :: mesh
  type(ents_detection) :: found
  type(ents_input) :: in
  type(ents_output), target :: out
  integer :: step, iteration

  call get_command_argument(2, argument)
  if (argument /= "") read (argument, *) segments
  call get_command_argument(1, argument)
  if (argument == "" .or. segments < 1) error stop "usage: slide MODEL.json [SEGMENTS]"
  call check(ents_model_create_from_file(trim(argument)//c_null_char, model, report))
  call check(ents_state_allocate(model, n, begin, end, report))
  nodes = reshape([(10*real(i, dp)/segments, 0._dp, i=0, segments)], [2_long, segments + 1]) ! towards +x: the normal is +y
  ends = reshape([(i, i + 1, i=0, segments - 1)], [2_long, segments]) ! nodes and segments are counted from 0
  s = reshape([(nodes(1, i:i + 1), i=1, segments)], [2_long, segments]) ! the length along x
  x = reshape([(1 + 0.3_dp*i, 0.1_dp, i=0, n - 1)], [2_long, n])
  x_begin = x

  mesh = ents_master_mesh(segments=segments, connectivity=c_loc(ends), nodes=segments + 1, positions=c_loc(nodes), &
                          surface_coordinates=c_loc(s))
  call check(ents_tree_allocate(model, mesh, tree, report))
  found = ents_detection(slave=c_loc(x), reach=0.5_dp, segment=c_loc(segment), xi=c_loc(xi), gap=c_loc(gap))
  in = ents_input(state_begin=c_loc(begin), state_begin_stride=size(begin, 1, long), slave_begin=c_loc(x_begin))
  ! Those of each slave node; with a `system` instead of c_null_ptr below they are added to sparse rows.
  out = ents_output(wanted=ENTS_RESIDUAL + ENTS_TANGENT + ENTS_STATE, residual=c_loc(R), residual_stride=2, &
                    tangent=c_loc(K), tangent_stride=4, state_end=c_loc(end), state_end_stride=size(end, 1, long))

  ! Once at the beginning: the states know where each node is before it touches.
  call check(ents_iterate(model, mesh, tree, size(tree, kind=long), 0_long, n, found, in, c_loc(out), c_null_ptr, report))
  begin = end
  do step = 1, 60
    do iteration = 0, 30
      ! A master that moves: ents_tree_refit first. One that deforms: in%positions_begin, too.
      call check(ents_iterate(model, mesh, tree, size(tree, kind=long), 0_long, n, found, in, c_loc(out), c_null_ptr, report))
      force = sum(R, 2)
      ! The springs of the host, whose other ends move 0.05 a step.
      R = R + 100*(x - reshape([(1 + 0.3_dp*i + 0.05_dp*step, -0.05_dp, i=0, n - 1)], [2_long, n]))
      K(1, 1, :) = K(1, 1, :) + 100
      K(2, 2, :) = K(2, 2, :) + 100
      if (maxval(abs(R)) <= 1e-11_dp) exit
      if (iteration == 30) error stop "slide: no convergence"
      det = K(1, 1, :)*K(2, 2, :) - K(1, 2, :)*K(2, 1, :) ! Newton's step of each slave node
      x(1, :) = x(1, :) - (K(2, 2, :)*R(1, :) - K(1, 2, :)*R(2, :))/det
      x(2, :) = x(2, :) - (K(1, 1, :)*R(2, :) - K(2, 1, :)*R(1, :))/det
      where (gap > 0) segment = -1 ! search open nodes anew: they may have moved over a flank
    end do
    begin = end ! the step is accepted
    x_begin = x
    print '(a, i2, a, f14.9, 1x, f14.9)', "step ", step, "  force on the slave nodes ", -force
  end do
  call check(ents_model_destroy(model, report))

contains

  subroutine check(status) ! > 0: a host with step control would cut its step
    integer(c_int32_t), intent(in) :: status
    if (status /= ENTS_OK) error stop "slide: "//ents_string(report%message)
  end subroutine check

end program slide
