! Every procedure of the Fortran module is called once and does what its C twin promises: arguments arrive in the right order and
! the right way (by value, by reference), results come back. Geometry: a flat unit quad4 in z = 0 with a constant height of 1/4, where
! every expected number is exact in binary.
module heights
  use, intrinsic :: iso_c_binding
  implicit none

contains

  ! h = factor s_1 s_2; s(count, 2), jet(count, numbers)
  function product_of_coordinates(user_data, order, count, s, jet) result(status) bind(c)
    type(c_ptr), value :: user_data
    integer(c_int32_t), value :: order, count
    real(c_double), intent(in) :: s(count, 2)
    real(c_double), intent(out) :: jet(count, *)
    integer(c_int32_t) :: status
    real(c_double), pointer :: factor
    call c_f_pointer(user_data, factor)
    jet(:, 1:merge(6, 10, order == 2)) = 0
    jet(:, 1) = factor * s(:, 1) * s(:, 2)
    jet(:, 2) = factor * s(:, 2)
    jet(:, 3) = factor * s(:, 1)
    jet(:, 5) = factor
    status = 0
  end function product_of_coordinates
end module heights

program procedures
  use heights, only: product_of_coordinates
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use ents
  implicit none

  character(*), parameter :: model_text = '{"segment": "quad4", "height": {"type": "constant", "value": 0.25},' // &
    ' "projection": {"type": "normal"}, "contact": {"normal": {"type": "penalty", "stiffness": 8.0}}}'
  character(*), parameter :: map_text = '{"segment": "quad4", "height": {"type": "map", "data": "patch", "size": [2.0, 2.0],' // &
    ' "boundary": "periodic"}, "projection": {"type": "normal"}}'
  character(*), parameter :: path = "procedures_model.json"

  real(c_double), target :: master(3, 4) = reshape( &
    [-1d0, -1d0, 0d0, 1d0, -1d0, 0d0, 1d0, 1d0, 0d0, -1d0, 1d0, 0d0], [3, 4])
  real(c_double), target :: slave(3, 2) = reshape([0.5d0, 0d0, 0.5d0, 0d0, 0.5d0, 0.125d0], [3, 2])

  type(c_ptr) :: model
  type(ents_report) :: report
  type(ents_layout) :: layout
  integer, parameter :: unit = 20

  call ents_init(report)
  call check_texts()
  call expect(ents_check_contract(ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR, report) == ENTS_OK, "check_contract: this one")
  call expect(ents_check_contract(ENTS_CONTRACT_MAJOR + 1, 0_c_int32_t, report) == ENTS_VERSION, "check_contract: a later one")
  call expect(report%status == ENTS_VERSION .and. len(ents_string(report%message)) > 0, "check_contract: the report")

  call expect(ents_model_create(model_text // "rubbish", len(model_text, c_int64_t), c_null_ptr, c_null_ptr, 0_c_int64_t, &
    model, report) == ENTS_OK, "model_create reads `length` bytes: " // ents_string(report%message))
  call ents_init(layout)
  call expect(ents_model_layout(model, layout, report) == ENTS_OK, "model_layout")
  call expect(layout%dimension == 3 .and. layout%nodes == 4 .and. layout%parameters == 2 .and. layout%dofs == 15, "layout")
  call expect(iand(layout%needs, ENTS_NEEDS_MASTER) /= 0 .and. iand(layout%needs, ENTS_NEEDS_FRICTION) == 0, "layout%needs")
  call expect(any(ents_string(layout%instruction_set) == [character(8) :: "portable", "avx2", "avx512"]), "layout%instruction_set")
  call check_evaluate()
  call check_state()
  call check_areas()
  call check_surface()
  call check_admissibility()
  call check_whole_surface()
  call expect(ents_model_destroy(model, report) == ENTS_OK .and. .not. c_associated(model), "model_destroy clears the handle")

  call check_data()
  call check_height_function()

  open (unit=unit, file=path, action="write", status="replace")
  write (unit, '(a)') model_text
  close (unit)
  call expect(ents_model_create_from_file(path // c_null_char, model, report) == ENTS_OK, &
    "model_create_from_file: " // ents_string(report%message))
  call expect(ents_model_destroy(model, report) == ENTS_OK, "model_destroy")
  open (unit=unit, file=path)
  close (unit, status="delete")
  call expect(ents_model_create_from_file(path // c_null_char, model, report) == ENTS_FILE, "model_create_from_file: no file")
  call expect(index(ents_string(report%message), path) > 0, "the message names the file: " // ents_string(report%message))

contains

  subroutine expect(condition, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: what
    if (condition) return
    write (error_unit, '(2a)') "failed: ", what
    stop 1
  end subroutine expect

  subroutine check_height_function()
    character(*), parameter :: text = '{"segment": "quad4", "height": {"type": "callback", "name": "product", "bound": 1.0,' // &
      ' "slope": 1.0, "curvature": 1.0}}'
    real(c_double), target :: factor = 0.5d0, point(3, 1), xi(2, 1) = reshape([0.5d0, -0.25d0], [2, 1])
    type(ents_surface) :: surface
    call expect(ents_height_register("product" // c_null_char, 2_c_int32_t, c_funloc(product_of_coordinates), c_loc(factor), &
      report) == ENTS_OK, "height_register: " // ents_string(report%message))
    call expect(ents_model_create(text, len(text, c_int64_t), c_null_ptr, c_null_ptr, 0_c_int64_t, model, report) == ENTS_OK, &
      "a model with a height function: " // ents_string(report%message))
    call ents_init(surface)
    surface%master = c_loc(master)
    surface%xi = c_loc(xi)
    surface%point = c_loc(point)
    call expect(ents_surface_evaluate(model, 1_c_int64_t, surface, report) == ENTS_OK, "surface_evaluate of a height function")
    call expect(all(same(point(:, 1), [0.5d0, -0.25d0, -0.0625d0])), "the height function's point")
    call expect(ents_model_destroy(model, report) == ENTS_OK, "model_destroy")
    call expect(ents_height_register("product" // c_null_char, 2_c_int32_t, c_null_funptr, c_null_ptr, report) == ENTS_OK, &
      "height_register forgets")
    call expect(ents_model_create(text, len(text, c_int64_t), c_null_ptr, c_null_ptr, 0_c_int64_t, model, report) == &
      ENTS_BAD_VALUE, "a model whose height function is forgotten")
  end subroutine check_height_function

  ! Exact equality of two numbers, said without the comparison that compilers warn of.
  elemental function same(a, b)
    real(c_double), intent(in) :: a, b
    logical :: same
    same = abs(a - b) <= 0
  end function same

  subroutine check_texts()
    character(kind=c_char), target :: text(4) = ["t", "w", "o", c_null_char]
    type(ents_output) :: output
    call expect("<" // ents_string(c_loc(text)) // ">" == "<two>", "ents_string of a C text")
    call expect("<" // ents_string(text) // ents_string(text(1:2)) // ">" == "<twotw>", "ents_string of characters")
    call expect(ents_string(c_null_ptr) == "", "ents_string of a null pointer")
    call expect(ents_string(ents_status_text(ENTS_OK)) == "ok", "status_text")
    call expect(ents_string(ents_status_text(ENTS_FILE)) /= ents_string(ents_status_text(ENTS_VERSION)), "status_text by value")
    call expect(index(ents_string(ents_library_version()), ".") > 1, "library_version")
    output%wanted = ENTS_GAP
    output%gap = c_loc(text)
    output%struct_size = 0
    call ents_init(output)
    call expect(output%wanted == 0 .and. .not. c_associated(output%gap), "ents_init zeroes")
    call expect(output%struct_size > 0, "ents_init sets the size")
    output = ents_output(wanted=ENTS_GAP, gap=c_loc(text))
    call expect(output%wanted == ENTS_GAP .and. c_associated(output%gap) .and. output%gap_stride == 0, "a constructor")
  end subroutine check_texts

  subroutine check_evaluate()
    type(ents_input) :: input
    type(ents_output) :: output
    real(c_double), target :: gap(2), residual(15, 2)
    integer(c_int32_t), target :: flags(2)
    call ents_init(input)
    input%slave = c_loc(slave)
    input%slave_stride = 3
    input%master = c_loc(master)
    call ents_init(output)
    output%wanted = ENTS_GAP + ENTS_RESIDUAL + ENTS_FLAGS
    output%gap = c_loc(gap)
    output%gap_stride = 1
    output%residual = c_loc(residual)
    output%residual_stride = 15
    output%flags = c_loc(flags)
    output%flags_stride = 1

    gap = -7
    call expect(ents_evaluate(model, 1_c_int64_t, 1_c_int64_t, input, output, report) == ENTS_OK, "evaluate the second")
    call expect(same(gap(1), -7d0) .and. same(gap(2), -0.125d0), "`first` counts from 0, `count` elements are written")
    call expect(ents_evaluate(model, 0_c_int64_t, 2_c_int64_t, input, output, report) == ENTS_OK, "evaluate both")
    call expect(all(same(gap, [0.25d0, -0.125d0])), "gap")
    call expect(all(same(residual(:, 1), 0d0)), "an open element carries no force")
    ! Penalty force 8 * (-1/8) along z, shared by the master nodes as the bilinear basis says at (0, 1/2).
    call expect(all(same(residual(1:3, 2), [0d0, 0d0, -1d0])), "force on the slave node")
    call expect(all(same(residual(6:15:3, 2), [0.125d0, 0.125d0, 0.375d0, 0.375d0])), "forces on the master nodes")
    call expect(iand(flags(1), ENTS_FLAG_CONTACT) == 0 .and. iand(flags(2), ENTS_FLAG_CONTACT) /= 0, "flags")
  end subroutine check_evaluate

  subroutine check_state()
    real(c_double) :: state(layout%state_size + 1, 2)
    real(c_double), allocatable :: begin(:, :), end(:, :)
    integer :: i
    state = -7
    call expect(ents_state_init(model, 2_c_int64_t, state, size(state, 1, c_int64_t), report) == ENTS_OK, "state_init")
    call expect(all(same(state(layout%state_size + 1, :), -7d0)), "state_init keeps to state_size")
    call expect(ents_state_init(model, -1_c_int64_t, state, size(state, 1, c_int64_t), report) == ENTS_BAD_COUNT, "count < 0")
    do i = 1, 2 ! the second time they are there
      call expect(ents_state_allocate(model, 2_c_int64_t, begin, end, report) == ENTS_OK, "state_allocate")
      call expect(all(shape(begin) == [layout%state_size, 2]) .and. all(shape(end) == shape(begin)), "the sizes of both states")
      call expect(all(same(begin, state(:layout%state_size, :))) .and. all(same(end, begin)), "both are those of state_init")
    end do
    call expect(ents_state_allocate(model, -1_c_int64_t, begin, end, report) == ENTS_BAD_COUNT, "state_allocate: count < 0")
    call expect(ents_state_allocate(c_null_ptr, 1_c_int64_t, begin, end, report) == ENTS_NULL_ARGUMENT, "state_allocate: no model")
    call check_transfer(state(:, 1))
    call check_augment()
  end subroutine check_state

  ! From the right edge of the segment to the left one of its neighbour.
  subroutine check_transfer(state)
    real(c_double), intent(inout) :: state(:)
    real(c_double) :: moved(size(state)), neighbour(3, 4)
    neighbour = master
    neighbour(1, :) = neighbour(1, :) + 2
    state(2) = 1 ! a projection has been seen, at xi = (1, 1/2)
    state(4:5) = [1d0, 0.5d0]
    call expect(ents_state_transfer(model, master, c_null_ptr, neighbour, c_null_ptr, state, moved, report) == ENTS_OK, &
      "state_transfer: " // ents_string(report%message))
    call expect(all(abs(moved(4:5) - [-1d0, 0.5d0]) < 1d-12), "the place on the neighbour")
  end subroutine check_transfer

  subroutine check_augment()
    character(*), parameter :: text = '{"segment": "line2", "contact": {"normal": {"type": "augmented", "stiffness": 8.0}}}'
    type(c_ptr) :: augmented
    type(ents_layout) :: sizes
    real(c_double), allocatable :: begin(:), end(:)
    call expect(ents_model_create(text, len(text, c_int64_t), c_null_ptr, c_null_ptr, 0_c_int64_t, augmented, report) == ENTS_OK, &
      "augmented model: " // ents_string(report%message))
    call ents_init(sizes)
    call expect(ents_model_layout(augmented, sizes, report) == ENTS_OK .and. sizes%augmentable == 1, "augmentable")
    allocate (begin(sizes%state_size), end(sizes%state_size))
    call expect(ents_state_init(augmented, 1_c_int64_t, begin, size(begin, kind=c_int64_t), report) == ENTS_OK, "state_init")
    end = begin
    end(sizes%state_size - 1) = 3 ! the last one is the number of the segment
    call expect(ents_state_augment(augmented, 1_c_int64_t, begin, size(begin, kind=c_int64_t), end, size(end, kind=c_int64_t), &
      report) == ENTS_OK, "state_augment")
    call expect(same(begin(sizes%state_size - 1), 3d0), "the multiplier moves to the begin state")
    call expect(ents_model_destroy(augmented, report) == ENTS_OK, "model_destroy")
  end subroutine check_augment

  ! Two unit squares side by side, each a quarter of its area per node.
  subroutine check_areas()
    real(c_double) :: positions(3, 6) = reshape( &
      [0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 2d0, 0d0, 0d0, 0d0, 1d0, 0d0, 1d0, 1d0, 0d0, 2d0, 1d0, 0d0], [3, 6])
    integer(c_int64_t) :: connectivity(4, 2) = reshape([0_c_int64_t, 1_c_int64_t, 4_c_int64_t, 3_c_int64_t, &
      1_c_int64_t, 2_c_int64_t, 5_c_int64_t, 4_c_int64_t], [4, 2])
    real(c_double) :: areas(6), gap(6) = [0d0, 0d0, 1d0, 0d0, 0d0, 1d0], pressure(6) = [2d0, 1d0, 0d0, 2d0, 1d0, 0d0]
    type(ents_area) :: area
    call expect(ents_tributary_areas("quad4" // c_null_char, 2_c_int64_t, connectivity, 6_c_int64_t, positions, 0d0, areas, &
      report) == ENTS_OK, "tributary_areas: " // ents_string(report%message))
    call expect(all(abs(areas - [0.25d0, 0.5d0, 0.25d0, 0.25d0, 0.5d0, 0.25d0]) < 1d-15), "areas")
    call ents_init(area)
    call expect(ents_contact_area("quad4" // c_null_char, 2_c_int64_t, connectivity, 6_c_int64_t, positions, 0d0, gap, pressure, &
      1d0, area, report) == ENTS_OK, "contact_area: " // ents_string(report%message))
    call expect(abs(area%counted - 1.5d0) < 1d-15 .and. area%zero_line > 1d0 .and. area%zero_line < 2d0, "contact area")
    call expect(abs(area%peak_pressure - 2d0) < 1d-15, "peak pressure")
  end subroutine check_areas

  subroutine check_surface()
    type(ents_surface) :: surface
    real(c_double), target :: xi(2, 2) = reshape([0.5d0, -0.25d0, -1d0, 1d0], [2, 2]), point(3, 2), height(2)
    call ents_init(surface)
    surface%master = c_loc(master)
    surface%xi = c_loc(xi)
    surface%point = c_loc(point)
    surface%height = c_loc(height)
    call expect(ents_surface_evaluate(model, 2_c_int64_t, surface, report) == ENTS_OK, "surface_evaluate")
    call expect(all(same(point(:, 1), [0.5d0, -0.25d0, 0.25d0])) .and. all(same(point(:, 2), [-1d0, 1d0, 0.25d0])), "points")
    call expect(all(same(height, 0.25d0)), "heights")
  end subroutine check_surface

  subroutine check_admissibility()
    type(ents_admissibility) :: result
    real(c_double), target :: s(2, 4) = reshape([0d0, 0d0, 1d0, 0d0, 1d0, 1d0, 0d0, 1d0], [2, 4])
    call ents_init(result)
    result%samples = 3
    call expect(ents_model_check(model, c_loc(master), c_null_ptr, result, report) == ENTS_OK, "model_check")
    call expect(same(result%height_max, 0.25d0) .and. same(result%edge_height, 0.25d0), "heights of model_check")
    call expect(ents_model_check(model, c_loc(master), c_loc(s), result, report) == ENTS_OK, "model_check with coordinates")
  end subroutine check_admissibility

  ! Two squares at right angles, whose heights face each other: the edges of each are 1/4 behind the other.
  subroutine check_whole_surface()
    type(ents_master_mesh) :: mesh
    type(ents_surface_admissibility) :: result
    integer(c_int64_t), target :: connectivity(4, 2) = reshape([0_c_int64_t, 1_c_int64_t, 2_c_int64_t, 3_c_int64_t, &
      1_c_int64_t, 4_c_int64_t, 5_c_int64_t, 2_c_int64_t], [4, 2]), violations(2)
    real(c_double), target :: nodes(3, 6)
    nodes(:, 1:4) = master
    nodes(:, 5) = [1d0, -1d0, 2d0]
    nodes(:, 6) = [1d0, 1d0, 2d0]
    call ents_init(mesh)
    mesh%segments = 2
    mesh%connectivity = c_loc(connectivity)
    mesh%nodes = 6
    mesh%positions = c_loc(nodes)
    call ents_init(result)
    result%samples = 9
    violations = -7
    result%violations = c_loc(violations)
    call expect(ents_surface_check(model, mesh, result, report) == ENTS_OK, "surface_check")
    call expect(same(result%value(ENTS_CHECK_EDGE + 1), 0.25d0), "height on the edges")
    call expect(abs(result%value(ENTS_CHECK_JUMP + 1) - 0.25d0*sqrt(2d0)) < 1d-15, "jump")
    call expect(same(result%value(ENTS_CHECK_CROSSING + 1), 0.25d0), "depth of the crossing")
    call expect(result%segment(ENTS_CHECK_JUMP + 1) == 0 .and. result%other(ENTS_CHECK_JUMP + 1) == 1, "segments, from 0")
    call expect(same(result%xi(1, ENTS_CHECK_JUMP + 1), 1d0) .and. same(result%point(3, ENTS_CHECK_JUMP + 1), 0.25d0), "place")
    call expect(btest(result%violated, ENTS_CHECK_CROSSING) .and. all(violations == result%violated), "bits of conditions")
    call check_tree(mesh)
  end subroutine check_whole_surface

  subroutine check_tree(mesh)
    type(ents_master_mesh), intent(in) :: mesh
    real(c_double), allocatable :: tree(:)
    integer(c_int64_t) :: length
    integer :: i
    length = 0
    call expect(ents_tree_size(model, mesh%segments, length, report) == ENTS_OK .and. length > 0, "tree_size")
    do i = 1, 2 ! the second time it is there
      call expect(ents_tree_allocate(model, mesh, tree, report) == ENTS_OK .and. size(tree, kind=c_int64_t) == length, "its size")
      call expect(ents_tree_refit(model, mesh, tree, length, report) == ENTS_OK, "tree_refit finds a tree of this surface")
      tree = 0
      call expect(ents_tree_refit(model, mesh, tree, length, report) == ENTS_BAD_STATE, "tree_refit finds no tree")
    end do
    call expect(ents_tree_allocate(c_null_ptr, mesh, tree, report) == ENTS_NULL_ARGUMENT, "tree_allocate: no model")
  end subroutine check_tree

  ! A height map from the caller's memory: samples equal to 1/2 make a flat surface at 1/2.
  subroutine check_data()
    type(ents_data), target :: data(1)
    character(kind=c_char), target :: name(6) = ["p", "a", "t", "c", "h", c_null_char]
    real(c_double), target :: values(8, 8)
    values = 0.5d0
    call ents_init(data(1))
    data(1)%name = c_loc(name)
    data(1)%values = c_loc(values)
    data(1)%rows = 8
    data(1)%columns = 8
    call expect(ents_model_create(map_text, len(map_text, c_int64_t), c_null_ptr, c_loc(data), 1_c_int64_t, model, report) &
      == ENTS_OK, "model_create with data: " // ents_string(report%message))
    call expect(ents_model_destroy(model, report) == ENTS_OK, "model_destroy")
  end subroutine check_data

end program procedures
