! SPDX-License-Identifier: BSD-3-Clause
! A host in Fortran: four slave nodes on springs are drawn, with friction, over a wavy rigid master of many segments. slide.c is the
! same program in C; both print the same forces.
! usage: slide MODEL.json [SEGMENTS]      The forces do not depend on the number of segments.
program slide
  use, intrinsic :: iso_c_binding, only: dp => c_double, long => c_int64_t, c_int32_t, c_loc, c_null_char, c_ptr
  use ents
  implicit none
  integer, parameter :: n = 4 ! slave nodes
  real(dp), target :: x(2, n), xi(n), gap(n), R(2, n), K(2, 2, n)
  integer(long), target :: segment(n), old(n), equations(2, n), row_begin(2*n + 1), columns(2, 2, n)
  real(dp), allocatable, target :: nodes(:, :), s(:, :), tree(:), begin(:, :), moved(:, :), end(:, :)
  integer(long), allocatable, target :: ends(:, :)
  integer(long) :: segments, size, m
  real(dp) :: force(2), step_r(2), error
  character(1000) :: argument
  type(c_ptr) :: model
  type(ents_report) :: report
  type(ents_layout) :: layout
  type(ents_master_mesh), target :: mesh
  type(ents_detection) :: found
  type(ents_input) :: in
  type(ents_output), target :: out
  type(ents_system) :: system
  integer :: i, step, iteration

  segments = 50
  call get_command_argument(2, argument)
  if (argument /= "") read (argument, *) segments
  call get_command_argument(1, argument)
  if (argument == "" .or. segments < 1) error stop "usage: slide MODEL.json [SEGMENTS]"
  call ents_init(report); call ents_init(layout); call ents_init(mesh); call ents_init(found); call ents_init(in)
  call ents_init(out); call ents_init(system)
  call check(ents_model_create_from_file(trim(argument)//c_null_char, model, report))
  call check(ents_model_layout(model, layout, report))
  m = layout%state_size
  allocate (begin(m, n), moved(m, n), end(m, n), nodes(2, segments + 1), s(2, segments), ends(2, segments))
  call check(ents_state_init(model, int(n, long), begin, m, report))
  nodes = 0
  nodes(1, :) = [(10*real(i, dp)/segments, i=0, int(segments))] ! towards +x: the normal is +y
  do i = 1, int(segments)
    ends(:, i) = [i - 1, i]  ! nodes and segments are counted from 0
    s(:, i) = nodes(1, i:i + 1) ! the length along x
  end do
  x(1, :) = [(1 + 0.3_dp*i, i=0, n - 1)]
  x(2, :) = 0.1_dp
  segment = -1; old = -1
  equations = reshape([(i, i=0, 2*n - 1)], [2, n]) ! those of a slave node are a block of 2 x 2
  row_begin = [(2*i, i=0, 2*n)]
  columns = spread(equations, 2, 2)

  mesh%segments = segments; mesh%connectivity = c_loc(ends); mesh%nodes = segments + 1; mesh%positions = c_loc(nodes)
  mesh%surface_coordinates = c_loc(s)
  size = 0
  call check(ents_tree_size(model, segments, size, report))
  allocate (tree(size))
  call check(ents_tree_build(model, mesh, tree, size, report))
  found%slave = c_loc(x); found%reach = 0.5_dp; found%segment = c_loc(segment); found%xi = c_loc(xi); found%gap = c_loc(gap)
  in%slave = c_loc(x); in%slave_stride = 2; in%state_begin = c_loc(moved); in%state_begin_stride = m; in%mesh = c_loc(mesh)
  in%segment = c_loc(segment); in%segment_stride = 1; in%start = c_loc(xi); in%start_stride = 1
  out%wanted = ENTS_STATE; out%state_end = c_loc(end); out%state_end_stride = m
  system%index_size = 8; system%slave_nodes = n; system%slave_equations = c_loc(equations); system%rows = 2*n
  system%residual = c_loc(R); system%row_begin = c_loc(row_begin); system%columns = c_loc(columns); system%values = c_loc(K)

  do step = 1, 60
    do iteration = 0, 30
      call check(ents_detect(model, mesh, tree, size, 0_long, int(n, long), found, report)) ! moving master: ents_tree_refit first
      do i = 1, n
        if (segment(i) == old(i)) then
          moved(:, i) = begin(:, i)
        else if (segment(i) >= 0 .and. old(i) >= 0) then ! the history follows the slave node to its new segment
          call check(ents_state_transfer(model, nodes(:, old(i) + 1:old(i) + 2), c_loc(s(1, old(i) + 1)), &
            nodes(:, segment(i) + 1:segment(i) + 2), c_loc(s(1, segment(i) + 1)), begin(:, i), moved(:, i), report))
        else
          call check(ents_state_init(model, 1_long, moved(:, i), m, report))
        end if
      end do
      R = 0; K = 0
      call check(ents_assemble(model, 0_long, int(n, long), in, c_loc(out), system, report))
      force = sum(R, 2)
      do i = 1, n ! the springs of the host, whose other ends move 0.05 a step; K(:, 1, i) is a row
        R(:, i) = R(:, i) + 100*(x(:, i) - [1 + 0.3_dp*(i - 1) + 0.05_dp*step, -0.05_dp])
        K(1, 1, i) = K(1, 1, i) + 100
        K(2, 2, i) = K(2, 2, i) + 100
      end do
      error = maxval(abs(R))
      if (error <= 1e-11_dp) exit
      if (iteration == 30) error stop "slide: no convergence"
      do i = 1, n ! Newton's step of each slave node
        step_r = [K(2, 2, i)*R(1, i) - K(2, 1, i)*R(2, i), K(1, 1, i)*R(2, i) - K(1, 2, i)*R(1, i)]
        x(:, i) = x(:, i) - step_r/(K(1, 1, i)*K(2, 2, i) - K(1, 2, i)*K(2, 1, i))
        if (gap(i) > 0) segment(i) = -1 ! search open nodes anew: they may have moved over a flank
      end do
    end do
    begin = end ! the step is accepted
    old = segment
    print '(a, i2, a, f14.9, 1x, f14.9)', "step ", step, "  force on the slave nodes ", -force
  end do
  call check(ents_model_destroy(model, report))

contains

  subroutine check(status) ! > 0: a host with step control would cut its step
    integer(c_int32_t), intent(in) :: status
    if (status == ENTS_OK) return
    print '(a)', "slide: "//ents_string(report%message)
    error stop
  end subroutine check

end program slide
