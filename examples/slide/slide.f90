! SPDX-License-Identifier: BSD-3-Clause
! A host in Fortran: four slave nodes on springs are drawn, with friction, over a wavy rigid master of many segments. slide.c is the
! same program in C; both print the same forces.
! usage: slide MODEL.json [SEGMENTS]      The forces do not depend on the number of segments.
program slide
  use, intrinsic :: iso_c_binding, only: dp => c_double, long => c_int64_t, c_int32_t, c_loc, c_null_char, c_null_ptr, c_ptr
  use ents
  implicit none
  integer, parameter :: n = 4 ! slave nodes
  real(dp), target :: x(2, n), xi(n), gap(n), R(2, n), K(2, 2, n)
  integer(long), target :: segment(n) = -1
  real(dp), allocatable, target :: nodes(:, :), s(:, :), tree(:), begin(:, :), end(:, :)
  integer(long), allocatable, target :: ends(:, :)
  integer(long) :: segments = 50, size = 0, m
  real(dp) :: force(2), error
  character(1000) :: argument
  type(c_ptr) :: model
  type(ents_report) :: report
  type(ents_layout) :: layout
  type(ents_master_mesh), target :: mesh
  type(ents_detection) :: found
  type(ents_input) :: in
  type(ents_output), target :: out
  integer :: i, step, iteration

  call get_command_argument(2, argument)
  if (argument /= "") read (argument, *) segments
  call get_command_argument(1, argument)
  if (argument == "" .or. segments < 1) error stop "usage: slide MODEL.json [SEGMENTS]"
  call ents_init(report); call ents_init(layout); call ents_init(mesh)
  call ents_init(found); call ents_init(in); call ents_init(out)
  call check(ents_model_create_from_file(trim(argument)//c_null_char, model, report))
  call check(ents_model_layout(model, layout, report))
  m = layout%state_size
  allocate (begin(m, n), end(m, n), nodes(2, segments + 1), s(2, segments), ends(2, segments))
  call check(ents_state_init(model, int(n, long), begin, m, report))
  nodes = reshape([(10*real(i, dp)/segments, 0._dp, i=0, int(segments))], [2, int(segments) + 1]) ! towards +x: the normal is +y
  ends = reshape([(i, i + 1, i=0, int(segments) - 1)], [2, int(segments)]) ! nodes and segments are counted from 0
  s = reshape([(nodes(1, i:i + 1), i=1, int(segments))], [2, int(segments)]) ! the length along x
  x = reshape([(1 + 0.3_dp*i, 0.1_dp, i=0, n - 1)], [2, n])

  mesh%segments = segments; mesh%connectivity = c_loc(ends)
  mesh%nodes = segments + 1; mesh%positions = c_loc(nodes); mesh%surface_coordinates = c_loc(s)
  call check(ents_tree_size(model, segments, size, report))
  allocate (tree(size))
  call check(ents_tree_build(model, mesh, tree, size, report))
  found%slave = c_loc(x); found%reach = 0.5_dp; found%segment = c_loc(segment); found%xi = c_loc(xi); found%gap = c_loc(gap)
  in%state_begin = c_loc(begin); in%state_begin_stride = m
  out%wanted = ENTS_RESIDUAL + ENTS_TANGENT + ENTS_STATE
  ! Those of each slave node; with a `system` instead of c_null_ptr below they are added to sparse rows.
  out%residual = c_loc(R); out%residual_stride = 2; out%tangent = c_loc(K); out%tangent_stride = 4
  out%state_end = c_loc(end); out%state_end_stride = m

  do step = 1, 60
    do iteration = 0, 30
      ! A master that moves: ents_tree_refit first. One that deforms: in%positions_begin, too.
      call check(ents_iterate(model, mesh, tree, size, 0_long, int(n, long), found, in, c_loc(out), c_null_ptr, report))
      force = sum(R, 2)
      do i = 1, n ! the springs of the host, whose other ends move 0.05 a step
        R(:, i) = R(:, i) + 100*(x(:, i) - [1 + 0.3_dp*(i - 1) + 0.05_dp*step, -0.05_dp])
        K(:, :, i) = K(:, :, i) + reshape([100, 0, 0, 100], [2, 2])
      end do
      error = maxval(abs(R))
      if (error <= 1e-11_dp) exit
      if (iteration == 30) error stop "slide: no convergence"
      do i = 1, n ! Newton's step of each slave node
        x(:, i) = x(:, i) - [K(2, 2, i)*R(1, i) - K(1, 2, i)*R(2, i), K(1, 1, i)*R(2, i) - K(2, 1, i)*R(1, i)] &
                  /(K(1, 1, i)*K(2, 2, i) - K(1, 2, i)*K(2, 1, i))
      end do
      where (gap > 0) segment = -1 ! search open nodes anew: they may have moved over a flank
    end do
    begin = end ! the step is accepted
    print '(a, i2, a, f14.9, 1x, f14.9)', "step ", step, "  force on the slave nodes ", -force
  end do
  call check(ents_model_destroy(model, report))

contains

  subroutine check(status) ! > 0: a host with step control would cut its step
    integer(c_int32_t), intent(in) :: status
    if (status /= ENTS_OK) print '(a)', "slide: "//ents_string(report%message)
    if (status /= ENTS_OK) error stop
  end subroutine check

end program slide
