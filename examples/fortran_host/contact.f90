! SPDX-License-Identifier: BSD-3-Clause
! Contact of two rows of nodes through the module ents: a smoothed master surface, detection, assembly, and the history that
! friction needs.
module contact
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_loc, c_null_char, c_null_ptr, c_ptr
  use ents
  implicit none
  private
  public :: start_contact, add_contact, accept_contact

  integer, parameter :: real64 = c_double, int64 = c_int64_t
  real(real64), parameter :: reach = 0.25d0 ! slave nodes farther away are open
  character(*), parameter :: line2 = "line2" // c_null_char, basis = "bspline4" // c_null_char

  ! What the library is shown lives here: it keeps nothing but the model.
  type(c_ptr) :: model
  type(ents_report) :: report
  type(ents_combination), target :: smoothed ! control points of the master, from its nodes
  type(ents_master_mesh), target :: mesh
  type(ents_system), target :: system
  integer, allocatable :: slaves(:), masters(:)
  integer(int64) :: slave_count, state_size
  integer(int64), allocatable, target :: segments(:, :), begin(:), of(:), rows(:), columns(:), segment(:)
  integer(int64), allocatable, target :: slave_equations(:, :), master_equations(:, :)
  real(real64), allocatable, target :: weights(:), points(:, :), coordinates(:, :), tree(:), areas(:), xi(:)
  real(real64), allocatable, target :: slave_now(:, :), slave_begin(:, :)
  real(real64), allocatable, target :: state_begin(:, :), state_end(:, :), points_begin(:, :)

contains

  ! slave_nodes, master_nodes: from left to right, so that the master's normal points up. x: (2, nodes), undeformed.
  subroutine start_contact(text, slave_nodes, master_nodes, x)
    character(*), intent(in) :: text ! the model, JSON
    integer, intent(in) :: slave_nodes(:), master_nodes(:)
    real(real64), intent(in) :: x(:, :)
    slaves = slave_nodes
    masters = master_nodes
    slave_count = size(slaves)
    call check(ents_check_contract(ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR, report))
    call check(ents_model_create(text, len(text, int64), c_null_ptr, c_null_ptr, 0_int64, model, report))
    if (index(text, '"bspline4"') == 0) error stop "the model's segment has to be bspline4"
    call smooth_master(x)
    call start_history(x)
    call describe_equations(size(x))
  end subroutine start_contact

  ! One spline segment a facet; the nodes at the ends count twice.
  subroutine smooth_master(x)
    real(real64), intent(in) :: x(:, :)
    integer(int64) :: facets(2, size(masters) - 1)
    integer(int64) :: count, terms
    integer :: i, j
    facets = chain(size(masters))
    call check(ents_smooth_size(line2, basis, ENTS_ENDS_REPEATED, size(facets, 2, int64), facets, &
      size(masters, kind=int64), count, terms, report))
    allocate (segments(4, size(facets, 2)), begin(count + 1), of(terms), weights(terms), points(2, count))
    call check(ents_smooth(line2, basis, ENTS_ENDS_REPEATED, size(facets, 2, int64), facets, size(masters, kind=int64), &
      count, terms, segments, begin, of, weights, report))
    smoothed = ents_combination(points=count, begin=c_loc(begin), nodes=c_loc(of), weights=c_loc(weights))
    call check(ents_combine(smoothed, 2, size(masters, kind=int64), x(:, masters), points, report))
    allocate (coordinates(4, size(segments, 2))) ! s is the undeformed x
    do j = 1, size(segments, 2)
      coordinates(:, j) = [(points(1, segments(i, j) + 1), i=1, 4)]
    end do
    mesh = ents_master_mesh(segments=size(segments, 2, int64), connectivity=c_loc(segments), nodes=count, &
      positions=c_loc(points), surface_coordinates=c_loc(coordinates))
    call check(ents_tree_allocate(model, mesh, tree, report))
  end subroutine smooth_master

  subroutine start_history(x)
    real(real64), intent(in) :: x(:, :)
    integer(int64) :: facets(2, size(slaves) - 1)
    allocate (areas(slave_count), xi(slave_count), segment(slave_count))
    slave_now = x(:, slaves)
    facets = chain(size(slaves))
    call check(ents_tributary_areas(line2, size(facets, 2, int64), facets, slave_count, slave_now, 1d0, areas, report))
    call check(ents_state_allocate(model, slave_count, state_begin, state_end, report))
    state_size = size(state_begin, 1, int64)
    segment = -1
    xi = 0
    points_begin = points
    slave_begin = slave_now
  end subroutine start_history

  ! The host's equations are its dofs, all of them, and its matrix is full: compressed rows with every column.
  subroutine describe_equations(dofs)
    integer, intent(in) :: dofs
    integer :: i, n
    slave_equations = equations(slaves)
    master_equations = equations(masters)
    rows = [(int(n, int64)*dofs, n=0, dofs)]
    columns = [((int(i, int64), i=0, dofs - 1), n=1, dofs)]
    system = ents_system(index_size=8, master=c_loc(smoothed), &
      slave_nodes=slave_count, slave_equations=c_loc(slave_equations), &
      master_nodes=size(masters, kind=int64), master_equations=c_loc(master_equations), &
      rows=int(dofs, int64), row_begin=c_loc(rows), columns=c_loc(columns))
  end subroutine describe_equations

  ! R is added to r, K to the transposed matrix k(column, row). False: the step is too large, k and r are not to be used.
  logical function add_contact(now, r, k) result(ok)
    real(real64), intent(in) :: now(:, :) ! (2, nodes)
    real(real64), intent(inout), target :: r(:), k(:, :)
    type(ents_detection) :: detection
    type(ents_input) :: input
    type(ents_output), target :: output
    integer(c_int32_t), target :: flags(size(slaves))
    slave_now = now(:, slaves)
    call check(ents_combine(smoothed, 2, size(masters, kind=int64), now(:, masters), points, report))
    call check(ents_tree_refit(model, mesh, tree, size(tree, kind=int64), report))
    detection = ents_detection(slave=c_loc(slave_now), reach=reach, segment=c_loc(segment), xi=c_loc(xi))
    input = ents_input(area=c_loc(areas), area_stride=1, state_begin=c_loc(state_begin), state_begin_stride=state_size, &
      positions_begin=c_loc(points_begin), slave_begin=c_loc(slave_begin))
    output = ents_output(wanted=ENTS_STATE + ENTS_FLAGS, state_end=c_loc(state_end), state_end_stride=state_size, &
      flags=c_loc(flags), flags_stride=1)
    system%residual = c_loc(r)
    system%values = c_loc(k)
    ok = ents_iterate(model, mesh, tree, size(tree, kind=int64), 0_int64, slave_count, detection, input, c_loc(output), &
      c_loc(system), report) == ENTS_OK
    if (report%status < 0) call check(report%status)
    if (.not. ok) return
    where (iand(flags, ENTS_FLAG_CONTACT) == 0) segment = -1 ! open nodes are searched anew: they may move over another flank
  end function add_contact

  ! What add_contact found last is the begin of the next increment.
  subroutine accept_contact()
    state_begin = state_end
    points_begin = points
    slave_begin = slave_now
  end subroutine accept_contact

  ! Whatever is not ENTS_OK ends the program with the library's message: a facet without area, say, has a positive status.
  subroutine check(status)
    integer(c_int32_t), intent(in) :: status
    if (status == ENTS_OK) return
    print '(a)', "ents: " // ents_string(report%message)
    error stop
  end subroutine check

  ! Facets of n nodes in a row, counted from 0.
  function chain(n) result(facets)
    integer, intent(in) :: n
    integer(int64) :: facets(2, n - 1)
    integer :: i
    facets(1, :) = [(int(i, int64), i=0, n - 2)]
    facets(2, :) = facets(1, :) + 1
  end function chain

  ! Rows of the nodes' dofs, counted from 0.
  function equations(nodes) result(numbers)
    integer, intent(in) :: nodes(:)
    integer(int64) :: numbers(2, size(nodes))
    numbers(1, :) = 2*(nodes - 1)
    numbers(2, :) = numbers(1, :) + 1
  end function equations

end module contact
