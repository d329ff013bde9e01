! SPDX-License-Identifier: BSD-3-Clause
!
! ents - enriched node-to-segment contact elements for finite element codes: the Fortran 2003 view of ents.h.
!
! bindings.py writes ents.f90 from ents.h and ents.f90.in: change those. Names, order and meaning are those of the header, which
! documents every argument (shape, unit, errors); tests compare constants, struct offsets and procedures. What Fortran changes:
!   - arguments that may be null are type(c_ptr): c_loc of the array, of the zero-terminated text or of the struct, or c_null_ptr;
!     other texts are character arrays that end with c_null_char: trim(path) // c_null_char;
!   - a variable of a type starts with its struct_size, zeros and null pointers; so does what a constructor leaves out:
!     in = ents_input(slave=c_loc(x), slave_stride=3); `call ents_init(x)` sets all components back;
!   - arrays go into ents_input, ents_output ... as c_loc(array) of arrays with the target attribute; ENTS_XI | ENTS_GAP is
!     ior(ENTS_XI, ENTS_GAP), or ENTS_XI + ENTS_GAP. A C array [m][d] is a Fortran array (d, m);
!   - ents_tree_allocate and ents_state_allocate, which ents.h does not have, allocate arrays and fill them;
!   - order of a segment's nodes, and which way its normal points: "Segments" at the top of ents.h, where nodes are counted from 0;
!   - a model is a type(c_ptr); element numbers (`first`, report%element) and all indices are 0-based as in C;
!   - a height function (ents_height_register) is a type(c_funptr): c_funloc of a bind(c) function with the arguments of
!     ents_height_function in ents.h: user_data, order and count by value, s(count, d-1), jet(count, numbers);
!   - ents_string turns C texts (ents_status_text, layout%instruction_set) and report%message into Fortran's;
!   - ents_version is called ents_library_version here: Fortran cannot tell it from the status value ENTS_VERSION.
module ents
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_funptr, c_int32_t, c_int64_t, c_intptr_t, c_associated, &
    c_null_char, c_null_ptr, c_ptr
  implicit none
  public
  private :: c_char, c_double, c_f_pointer, c_funptr, c_int32_t, c_int64_t, c_intptr_t, c_associated, c_null_char, c_null_ptr, c_ptr

  ! Pass ENTS_CONTRACT_MAJOR and ENTS_CONTRACT_MINOR to ents_check_contract. ENTS_CHECK_... are counted from 0:
  ! value(ENTS_CHECK_FOLD + 1).
  integer(c_int32_t), parameter :: ENTS_CONTRACT_MAJOR = 1
  integer(c_int32_t), parameter :: ENTS_CONTRACT_MINOR = 11
  integer(c_int32_t), parameter :: ENTS_OK = 0
  integer(c_int32_t), parameter :: ENTS_NO_PROJECTION = 1
  integer(c_int32_t), parameter :: ENTS_SINGULAR_PROJECTION = 2
  integer(c_int32_t), parameter :: ENTS_AMBIGUOUS_PROJECTION = 3
  integer(c_int32_t), parameter :: ENTS_DEGENERATE_SEGMENT = 4
  integer(c_int32_t), parameter :: ENTS_GRAZING_RAY = 5
  integer(c_int32_t), parameter :: ENTS_DEEP_PENETRATION = 6
  integer(c_int32_t), parameter :: ENTS_OUT_OF_RANGE = 7
  integer(c_int32_t), parameter :: ENTS_NULL_ARGUMENT = -1
  integer(c_int32_t), parameter :: ENTS_STRUCT_SIZE = -2
  integer(c_int32_t), parameter :: ENTS_VERSION = -3
  integer(c_int32_t), parameter :: ENTS_NON_FINITE = -4
  integer(c_int32_t), parameter :: ENTS_JSON_SYNTAX = -5
  integer(c_int32_t), parameter :: ENTS_UNKNOWN_KEY = -6
  integer(c_int32_t), parameter :: ENTS_BAD_VALUE = -7
  integer(c_int32_t), parameter :: ENTS_FILE = -8
  integer(c_int32_t), parameter :: ENTS_BAD_MASK = -9
  integer(c_int32_t), parameter :: ENTS_BAD_COUNT = -10
  integer(c_int32_t), parameter :: ENTS_BAD_HANDLE = -11
  integer(c_int32_t), parameter :: ENTS_BAD_STATE = -12
  integer(c_int32_t), parameter :: ENTS_BAD_PATTERN = -13
  integer(c_int32_t), parameter :: ENTS_NO_MEMORY = -100
  integer(c_int32_t), parameter :: ENTS_INTERNAL = -101
  integer(c_int32_t), parameter :: ENTS_NEEDS_HEIGHT = 1
  integer(c_int32_t), parameter :: ENTS_NEEDS_SLOPE = 2
  integer(c_int32_t), parameter :: ENTS_NEEDS_CURVED = 4
  integer(c_int32_t), parameter :: ENTS_NEEDS_ITERATION = 8
  integer(c_int32_t), parameter :: ENTS_NEEDS_MASTER = 16
  integer(c_int32_t), parameter :: ENTS_NEEDS_FRICTION = 32
  integer(c_int32_t), parameter :: ENTS_NEEDS_HISTORY = 64
  integer(c_int32_t), parameter :: ENTS_NEEDS_MULTIPLIERS = 128
  integer(c_int32_t), parameter :: ENTS_NEEDS_ONE_BY_ONE = 256
  integer(c_int32_t), parameter :: ENTS_NEEDS_TEMPERATURES = 512
  integer(c_int32_t), parameter :: ENTS_NEEDS_FIRST_STATE = 1024
  integer(c_int32_t), parameter :: ENTS_SHARED_SLAVE = 1
  integer(c_int32_t), parameter :: ENTS_SHARED_SEGMENT = 2
  integer(c_int32_t), parameter :: ENTS_SHARED_AREA = 4
  integer(c_int32_t), parameter :: ENTS_SHARED_STATE = 8
  integer(c_int32_t), parameter :: ENTS_SHARED_MULTIPLIER = 16
  integer(c_int32_t), parameter :: ENTS_SHARED_NO_STATE = 32
  integer(c_int32_t), parameter :: ENTS_SHARED_SLAVE_VALUES = 64
  integer(c_int32_t), parameter :: ENTS_SHARED_TEMPERATURE = 128
  integer(c_int32_t), parameter :: ENTS_XI = 1
  integer(c_int32_t), parameter :: ENTS_GAP = 2
  integer(c_int32_t), parameter :: ENTS_NORMAL_GAP = 4
  integer(c_int32_t), parameter :: ENTS_NORMAL = 8
  integer(c_int32_t), parameter :: ENTS_POINT = 16
  integer(c_int32_t), parameter :: ENTS_GAP_GRADIENT = 32
  integer(c_int32_t), parameter :: ENTS_GAP_HESSIAN = 64
  integer(c_int32_t), parameter :: ENTS_XI_GRADIENT = 128
  integer(c_int32_t), parameter :: ENTS_XI_HESSIAN = 256
  integer(c_int32_t), parameter :: ENTS_ENERGY = 512
  integer(c_int32_t), parameter :: ENTS_PRESSURE = 1024
  integer(c_int32_t), parameter :: ENTS_RESIDUAL = 2048
  integer(c_int32_t), parameter :: ENTS_TANGENT = 4096
  integer(c_int32_t), parameter :: ENTS_STATE = 8192
  integer(c_int32_t), parameter :: ENTS_FLAGS = 16384
  integer(c_int32_t), parameter :: ENTS_ITERATIONS = 32768
  integer(c_int32_t), parameter :: ENTS_TRACTION = 65536
  integer(c_int32_t), parameter :: ENTS_SLIP = 131072
  integer(c_int32_t), parameter :: ENTS_AGE = 262144
  integer(c_int32_t), parameter :: ENTS_DISSIPATION = 524288
  integer(c_int32_t), parameter :: ENTS_FRICTION_ENERGY = 1048576
  integer(c_int32_t), parameter :: ENTS_HEAT = 2097152
  integer(c_int32_t), parameter :: ENTS_FLAG_CONTACT = 1
  integer(c_int32_t), parameter :: ENTS_FLAG_OUTSIDE = 2
  integer(c_int32_t), parameter :: ENTS_FLAG_FAR_SIDE = 4
  integer(c_int32_t), parameter :: ENTS_FLAG_SEARCHED = 8
  integer(c_int32_t), parameter :: ENTS_FLAG_STICK = 16
  integer(c_int32_t), parameter :: ENTS_FLAG_SLIP = 32
  integer(c_int32_t), parameter :: ENTS_FLAG_SHEAR_LIMIT = 64
  integer(c_int32_t), parameter :: ENTS_FLAG_AMBIGUOUS = 256
  integer(c_int32_t), parameter :: ENTS_FLAG_BEHIND_EDGE = 512
  integer(c_int32_t), parameter :: ENTS_FLAG_LEFT = 1024
  integer(c_int32_t), parameter :: ENTS_FLAG_NO_BEGIN = 2048
  integer(c_int32_t), parameter :: ENTS_FLAG_CROSSED = 4096
  integer(c_int32_t), parameter :: ENTS_FLAG_CHANGED = 128
  integer(c_int32_t), parameter :: ENTS_ENDS_STRAIGHT = 0
  integer(c_int32_t), parameter :: ENTS_ENDS_REPEATED = 1
  integer(c_int32_t), parameter :: ENTS_ENDS_QUASI_CUBIC = 2
  integer(c_int32_t), parameter :: ENTS_ENDS_QUASI_PARABOLIC = 3
  integer(c_int32_t), parameter :: ENTS_CHECK_CONTINUITY = 0
  integer(c_int32_t), parameter :: ENTS_CHECK_FOLD = 1
  integer(c_int32_t), parameter :: ENTS_CHECK_EDGE = 2
  integer(c_int32_t), parameter :: ENTS_CHECK_JUMP = 3
  integer(c_int32_t), parameter :: ENTS_CHECK_KINK = 4
  integer(c_int32_t), parameter :: ENTS_CHECK_WEDGE = 5
  integer(c_int32_t), parameter :: ENTS_CHECK_PROJECTION = 6
  integer(c_int32_t), parameter :: ENTS_CHECK_SHADOW = 7
  integer(c_int32_t), parameter :: ENTS_CHECK_OCCLUSION = 8
  integer(c_int32_t), parameter :: ENTS_CHECK_CROSSING = 9

  integer, parameter, private :: pointer_bytes = bit_size(0_c_intptr_t)/8

  type, bind(c) :: ents_report
    integer(c_int32_t) :: struct_size = 536
    integer(c_int32_t) :: status = 0
    integer(c_int64_t) :: element = 0
    real(c_double) :: step_factor = 0
    character(kind=c_char) :: message(512) = c_null_char
  end type ents_report

  type, bind(c) :: ents_data
    integer(c_int32_t) :: struct_size = 24 + 2*pointer_bytes
    integer(c_int32_t) :: reserved = 0
    type(c_ptr) :: name = c_null_ptr ! a text that ends with c_null_char
    type(c_ptr) :: values = c_null_ptr ! (columns, rows)
    integer(c_int64_t) :: rows = 0
    integer(c_int64_t) :: columns = 0
  end type ents_data

  type, bind(c) :: ents_layout
    integer(c_int32_t) :: struct_size = 72 + 1*pointer_bytes
    integer(c_int32_t) :: dimension = 0
    integer(c_int32_t) :: nodes = 0
    integer(c_int32_t) :: parameters = 0
    integer(c_int32_t) :: dofs = 0
    integer(c_int32_t) :: state_size = 0
    integer(c_int32_t) :: symmetric_tangent = 0
    integer(c_int32_t) :: own_surface_coordinates = 0
    integer(c_int32_t) :: multipliers = 0
    integer(c_int32_t) :: friction = 0
    integer(c_int32_t) :: augmentable = 0
    integer(c_int32_t) :: needs = 0
    type(c_ptr) :: instruction_set = c_null_ptr ! a text that ends with c_null_char
    integer(c_int32_t) :: named_parameters = 0
    integer(c_int32_t) :: fields = 0
    integer(c_int32_t) :: worn = 0
    integer(c_int32_t) :: slave_values = 0
    integer(c_int32_t) :: node_dofs = 0
    integer(c_int32_t) :: heat = 0
  end type ents_layout

  type, bind(c) :: ents_master_mesh
    integer(c_int32_t) :: struct_size = 24 + 4*pointer_bytes
    integer(c_int32_t) :: reserved = 0
    integer(c_int64_t) :: segments = 0
    type(c_ptr) :: connectivity = c_null_ptr ! (m, segments), int64
    integer(c_int64_t) :: nodes = 0
    type(c_ptr) :: positions = c_null_ptr ! (d, nodes)
    type(c_ptr) :: surface_coordinates = c_null_ptr ! (d-1, m, segments)
    type(c_ptr) :: temperature = c_null_ptr ! (nodes)
  end type ents_master_mesh

  type, bind(c) :: ents_detection
    integer(c_int32_t) :: struct_size = 24 + 14*pointer_bytes
    integer(c_int32_t) :: reserved = 0
    type(c_ptr) :: slave = c_null_ptr ! (d, count)
    real(c_double) :: reach = 0
    type(c_ptr) :: segment = c_null_ptr ! (count), int64
    type(c_ptr) :: xi = c_null_ptr ! (d-1, count)
    type(c_ptr) :: gap = c_null_ptr ! (count)
    type(c_ptr) :: flags = c_null_ptr ! (count), int32
    type(c_ptr) :: other = c_null_ptr ! (count), int64
    type(c_ptr) :: slave_node = c_null_ptr ! (count), int64
    integer(c_int64_t) :: permitted = 0
    type(c_ptr) :: slave_begin = c_null_ptr ! (d, count)
    type(c_ptr) :: positions_begin = c_null_ptr ! (d, nodes)
    type(c_ptr) :: slave_normal = c_null_ptr ! (d, count)
    type(c_ptr) :: slave_segment = c_null_ptr ! (count), int64
    type(c_ptr) :: depth = c_null_ptr ! (count)
    type(c_ptr) :: slave_side = c_null_ptr ! (count), int32
    type(c_ptr) :: segment_side = c_null_ptr ! int32
  end type ents_detection

  type, bind(c) :: ents_input
    integer(c_int32_t) :: struct_size = 112 + 14*pointer_bytes
    integer(c_int32_t) :: reserved = 0
    type(c_ptr) :: slave = c_null_ptr ! (d, elements)
    integer(c_int64_t) :: slave_stride = 0
    type(c_ptr) :: master = c_null_ptr ! (d, m, elements)
    integer(c_int64_t) :: master_stride = 0
    type(c_ptr) :: surface_coordinates = c_null_ptr ! (d-1, m, elements)
    integer(c_int64_t) :: surface_coordinates_stride = 0
    type(c_ptr) :: start = c_null_ptr ! (d-1, elements)
    integer(c_int64_t) :: start_stride = 0
    type(c_ptr) :: area = c_null_ptr ! (elements)
    integer(c_int64_t) :: area_stride = 0
    type(c_ptr) :: state_begin = c_null_ptr ! (state_size, elements)
    integer(c_int64_t) :: state_begin_stride = 0
    type(c_ptr) :: multiplier = c_null_ptr ! (multipliers, elements)
    integer(c_int64_t) :: multiplier_stride = 0
    type(c_ptr) :: mesh = c_null_ptr ! c_loc of an ents_master_mesh
    type(c_ptr) :: segment = c_null_ptr ! (elements), int64
    integer(c_int64_t) :: segment_stride = 0
    type(c_ptr) :: positions_begin = c_null_ptr ! (d, nodes)
    integer(c_int64_t) :: shared = 0
    type(c_ptr) :: slave_values = c_null_ptr ! (slave_values, elements)
    integer(c_int64_t) :: slave_values_stride = 0
    type(c_ptr) :: slave_begin = c_null_ptr ! (d, elements)
    type(c_ptr) :: slave_temperature = c_null_ptr ! (elements)
    integer(c_int64_t) :: slave_temperature_stride = 0
    type(c_ptr) :: master_temperature = c_null_ptr ! (m, elements)
    integer(c_int64_t) :: master_temperature_stride = 0
    real(c_double) :: time_increment = 0
  end type ents_input

  type, bind(c) :: ents_output
    integer(c_int32_t) :: struct_size = 200 + 23*pointer_bytes
    integer(c_int32_t) :: wanted = 0
    type(c_ptr) :: status = c_null_ptr ! (elements), int32
    integer(c_int64_t) :: status_stride = 0
    type(c_ptr) :: xi = c_null_ptr ! (d-1, elements)
    integer(c_int64_t) :: xi_stride = 0
    type(c_ptr) :: gap = c_null_ptr ! (elements)
    integer(c_int64_t) :: gap_stride = 0
    type(c_ptr) :: normal_gap = c_null_ptr ! (elements)
    integer(c_int64_t) :: normal_gap_stride = 0
    type(c_ptr) :: normal = c_null_ptr ! (d, elements)
    integer(c_int64_t) :: normal_stride = 0
    type(c_ptr) :: point = c_null_ptr ! (d, elements)
    integer(c_int64_t) :: point_stride = 0
    type(c_ptr) :: gap_gradient = c_null_ptr ! (n, elements)
    integer(c_int64_t) :: gap_gradient_stride = 0
    type(c_ptr) :: gap_hessian = c_null_ptr ! (n, n, elements)
    integer(c_int64_t) :: gap_hessian_stride = 0
    type(c_ptr) :: xi_gradient = c_null_ptr ! (n, d-1, elements)
    integer(c_int64_t) :: xi_gradient_stride = 0
    type(c_ptr) :: xi_hessian = c_null_ptr ! (n, n, d-1, elements)
    integer(c_int64_t) :: xi_hessian_stride = 0
    type(c_ptr) :: energy = c_null_ptr ! (elements)
    integer(c_int64_t) :: energy_stride = 0
    type(c_ptr) :: pressure = c_null_ptr ! (elements)
    integer(c_int64_t) :: pressure_stride = 0
    type(c_ptr) :: residual = c_null_ptr ! (dofs, elements)
    integer(c_int64_t) :: residual_stride = 0
    type(c_ptr) :: tangent = c_null_ptr ! (tangent_leading_dimension, dofs, elements)
    integer(c_int64_t) :: tangent_stride = 0
    integer(c_int64_t) :: tangent_leading_dimension = 0
    type(c_ptr) :: state_end = c_null_ptr ! (state_size, elements)
    integer(c_int64_t) :: state_end_stride = 0
    type(c_ptr) :: flags = c_null_ptr ! (elements), int32
    integer(c_int64_t) :: flags_stride = 0
    type(c_ptr) :: iterations = c_null_ptr ! (elements), int32
    integer(c_int64_t) :: iterations_stride = 0
    type(c_ptr) :: traction = c_null_ptr ! (d, elements)
    integer(c_int64_t) :: traction_stride = 0
    type(c_ptr) :: slip = c_null_ptr ! (elements)
    integer(c_int64_t) :: slip_stride = 0
    type(c_ptr) :: age = c_null_ptr ! (elements)
    integer(c_int64_t) :: age_stride = 0
    type(c_ptr) :: dissipation = c_null_ptr ! (elements)
    integer(c_int64_t) :: dissipation_stride = 0
    type(c_ptr) :: friction_energy = c_null_ptr ! (elements)
    integer(c_int64_t) :: friction_energy_stride = 0
    type(c_ptr) :: heat = c_null_ptr ! (2, elements)
    integer(c_int64_t) :: heat_stride = 0
  end type ents_output

  type, bind(c) :: ents_derivatives
    integer(c_int32_t) :: struct_size = 8 + 5*pointer_bytes
    integer(c_int32_t) :: reserved = 0
    type(c_ptr) :: gap = c_null_ptr ! (named_parameters, elements)
    type(c_ptr) :: energy = c_null_ptr ! (named_parameters, elements)
    type(c_ptr) :: residual = c_null_ptr ! (dofs, named_parameters, elements)
    type(c_ptr) :: adjoint = c_null_ptr ! (dofs, elements)
    type(c_ptr) :: product = c_null_ptr ! (named_parameters)
  end type ents_derivatives

  type, bind(c) :: ents_area
    integer(c_int32_t) :: struct_size = 72
    integer(c_int32_t) :: reserved = 0
    real(c_double) :: surface = 0
    real(c_double) :: counted = 0
    real(c_double) :: border_corrected = 0
    real(c_double) :: zero_line = 0
    real(c_double) :: estimate = 0
    real(c_double) :: error = 0
    real(c_double) :: peak_pressure = 0
    real(c_double) :: peak_drop = 0
  end type ents_area

  type, bind(c) :: ents_resultants
    integer(c_int32_t) :: struct_size = 160
    integer(c_int32_t) :: reserved = 0
    real(c_double) :: normal(3) = 0
    real(c_double) :: tangential(3) = 0
    real(c_double) :: moment(3) = 0
    real(c_double) :: centre(3) = 0
    real(c_double) :: area = 0
    real(c_double) :: largest_pressure = 0
    integer(c_int64_t) :: deepest = 0
    integer(c_int64_t) :: open = 0
    integer(c_int64_t) :: contact = 0
    integer(c_int64_t) :: stick = 0
    integer(c_int64_t) :: slip = 0
  end type ents_resultants

  type, bind(c) :: ents_suggestion
    integer(c_int32_t) :: struct_size = 32
    integer(c_int32_t) :: reserved = 0
    real(c_double) :: normal_stiffness = 0
    real(c_double) :: tangential_stiffness = 0
    real(c_double) :: time_step = 0
  end type ents_suggestion

  type, bind(c) :: ents_combination
    integer(c_int32_t) :: struct_size = 16 + 7*pointer_bytes
    integer(c_int32_t) :: reserved = 0
    integer(c_int64_t) :: points = 0
    type(c_ptr) :: begin = c_null_ptr ! (points + 1), int64
    type(c_ptr) :: nodes = c_null_ptr ! (begin[points]), int64
    type(c_ptr) :: weights = c_null_ptr ! (begin[points])
    type(c_ptr) :: reflected = c_null_ptr ! (begin[points]), int32
    type(c_ptr) :: shifts = c_null_ptr ! (d, points)
    type(c_ptr) :: heights = c_null_ptr ! (points)
    type(c_ptr) :: slopes = c_null_ptr ! (d-1, begin[points])
  end type ents_combination

  type, bind(c) :: ents_mirror
    integer(c_int32_t) :: struct_size = 8 + 3*pointer_bytes
    integer(c_int32_t) :: planes = 0
    type(c_ptr) :: axes = c_null_ptr ! (planes), int32
    type(c_ptr) :: places = c_null_ptr ! (planes)
    type(c_ptr) :: positions = c_null_ptr ! (d, nodes)
  end type ents_mirror

  type, bind(c) :: ents_pose
    integer(c_int32_t) :: struct_size = 104
    integer(c_int32_t) :: reserved = 0
    real(c_double) :: point(3) = 0
    real(c_double) :: turn(9) = 0
  end type ents_pose

  type, bind(c) :: ents_system
    integer(c_int32_t) :: struct_size = 40 + 13*pointer_bytes
    integer(c_int32_t) :: index_size = 0
    type(c_ptr) :: slave = c_null_ptr ! c_loc of an ents_combination
    type(c_ptr) :: master = c_null_ptr ! c_loc of an ents_combination
    integer(c_int64_t) :: slave_nodes = 0
    type(c_ptr) :: slave_equations = c_null_ptr ! (node_dofs, slave_nodes), int64
    integer(c_int64_t) :: master_nodes = 0
    type(c_ptr) :: master_equations = c_null_ptr ! (node_dofs, master_nodes), int64
    type(c_ptr) :: multiplier_equations = c_null_ptr ! (multipliers, elements), int64
    integer(c_int64_t) :: rows = 0
    type(c_ptr) :: residual = c_null_ptr ! (rows)
    type(c_ptr) :: row_begin = c_null_ptr ! (rows + 1)
    type(c_ptr) :: columns = c_null_ptr ! (row_begin[rows])
    type(c_ptr) :: values = c_null_ptr ! (row_begin[rows])
    type(c_ptr) :: places = c_null_ptr ! (places_size, elements), int64
    integer(c_int64_t) :: places_size = 0
    type(c_ptr) :: pose = c_null_ptr ! c_loc of an ents_pose
    type(c_ptr) :: body_equations = c_null_ptr ! (2D: 3, 3D: 6), int64
    type(c_ptr) :: slave_positions = c_null_ptr ! (d, slave_nodes)
  end type ents_system

  type, bind(c) :: ents_surface
    integer(c_int32_t) :: struct_size = 8 + 8*pointer_bytes
    integer(c_int32_t) :: reserved = 0
    type(c_ptr) :: master = c_null_ptr ! (d, m)
    type(c_ptr) :: surface_coordinates = c_null_ptr ! (d-1, m)
    type(c_ptr) :: xi = c_null_ptr ! (d-1, count)
    type(c_ptr) :: point = c_null_ptr ! (d, count)
    type(c_ptr) :: normal = c_null_ptr ! (d, count)
    type(c_ptr) :: height = c_null_ptr ! (count)
    type(c_ptr) :: base_point = c_null_ptr ! (d, count)
    type(c_ptr) :: base_normal = c_null_ptr ! (d, count)
  end type ents_surface

  type, bind(c) :: ents_admissibility
    integer(c_int32_t) :: struct_size = 128
    integer(c_int32_t) :: samples = 0
    integer(c_int32_t) :: continuity = 0
    integer(c_int32_t) :: reserved = 0
    real(c_double) :: fold = 0
    real(c_double) :: fold_xi(2) = 0
    real(c_double) :: edge_height = 0
    real(c_double) :: edge_height_xi(2) = 0
    real(c_double) :: reach = 0
    real(c_double) :: reach_xi(2) = 0
    real(c_double) :: shadow = 0
    real(c_double) :: shadow_xi(2) = 0
    real(c_double) :: height_min = 0
    real(c_double) :: height_max = 0
  end type ents_admissibility

  type, bind(c) :: ents_surface_admissibility
    integer(c_int32_t) :: struct_size = 1592 + 1*pointer_bytes
    integer(c_int32_t) :: samples = 0
    real(c_double) :: reach = 0
    real(c_double) :: kink = 0
    type(c_ptr) :: violations = c_null_ptr ! (segments), int64
    integer(c_int64_t) :: judged = 0
    integer(c_int64_t) :: violated = 0
    real(c_double) :: value(16) = 0
    real(c_double) :: bound(16) = 0
    real(c_double) :: missing(16) = 0
    integer(c_int64_t) :: segment(16) = 0
    real(c_double) :: xi(2, 16) = 0
    real(c_double) :: point(3, 16) = 0
    integer(c_int64_t) :: other(16) = 0
    real(c_double) :: other_xi(2, 16) = 0
    real(c_double) :: height_min = 0
    real(c_double) :: height_max = 0
  end type ents_surface_admissibility

  ! Set all components of a struct to what they are at the start: call ents_init(input).
  interface ents_init
    module procedure init_report, init_data, init_layout, init_master_mesh, init_detection, init_input, init_output, &
      init_derivatives, init_area, init_resultants, init_suggestion, init_combination, init_mirror, init_pose, init_system, &
      init_surface, init_admissibility, init_surface_admissibility
  end interface ents_init
  private :: init_report, init_data, init_layout, init_master_mesh, init_detection, init_input, init_output, init_derivatives, &
    init_area, init_resultants, init_suggestion, init_combination, init_mirror, init_pose, init_system, init_surface, &
    init_admissibility, init_surface_admissibility

  ! A C text as a Fortran one: ents_string(ents_status_text(status)), ents_string(report%message).
  interface ents_string
    module procedure string_from_pointer, string_from_characters
  end interface ents_string
  private :: string_from_pointer, string_from_characters

  ! `target` on structs tells the compiler that the arrays that they point to are written: without it gfortran takes what an
  ! intent(in) argument leads to for unchanged, and keeps old values of the arrays in registers.
  interface
    ! Text of a status value.
    function ents_status_text(status) result(text) bind(c, name="ents_status_text")
      import :: c_int32_t, c_ptr
      integer(c_int32_t), value :: status
      type(c_ptr) :: text
    end function ents_status_text

    ! Library version ("major.minor.patch", static text).
    function ents_library_version() result(text) bind(c, name="ents_version")
      import :: c_ptr
      type(c_ptr) :: text
    end function ents_library_version

    ! Does this library serve the caller's header?
    function ents_check_contract(major, minor, report) result(status) bind(c, name="ents_check_contract")
      import :: c_int32_t, ents_report
      integer(c_int32_t), value :: major, minor
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_check_contract

    ! Register a height function under a name.
    function ents_height_register(name, dimension, function, user_data, report) result(status) &
      bind(c, name="ents_height_register")
      import :: c_char, c_funptr, c_int32_t, c_ptr, ents_report
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t), value :: dimension
      type(c_funptr), value :: function
      type(c_ptr), value :: user_data
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_height_register

    ! Read a model from text (abi/model.schema.json says what it may hold).
    function ents_model_create(text, length, directory, data, data_count, model, report) result(status) &
      bind(c, name="ents_model_create")
      import :: c_char, c_int32_t, c_int64_t, c_ptr, ents_report
      character(kind=c_char), intent(in) :: text(*)
      integer(c_int64_t), value :: length
      type(c_ptr), value :: directory, data
      integer(c_int64_t), value :: data_count
      type(c_ptr), intent(out) :: model
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_model_create

    ! The same from a JSON file; relative names of height maps start at the file's own folder.
    function ents_model_create_from_file(path, model, report) result(status) bind(c, name="ents_model_create_from_file")
      import :: c_char, c_int32_t, c_ptr, ents_report
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), intent(out) :: model
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_model_create_from_file

    ! Release a model and set the handle to null.
    function ents_model_destroy(model, report) result(status) bind(c, name="ents_model_destroy")
      import :: c_int32_t, c_ptr, ents_report
      type(c_ptr), intent(inout) :: model
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_model_destroy

    function ents_model_layout(model, layout, report) result(status) bind(c, name="ents_model_layout")
      import :: c_int32_t, c_ptr, ents_layout, ents_report
      type(c_ptr), value :: model
      type(ents_layout), intent(inout), target :: layout
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_model_layout

    ! Numbers of a model may be named parameters.
    function ents_model_bind(model, parameters, fields, field_count, bound, report) result(status) bind(c, name="ents_model_bind")
      import :: c_int32_t, c_int64_t, c_ptr, ents_report
      type(c_ptr), value :: model, parameters, fields
      integer(c_int64_t), value :: field_count
      type(c_ptr), intent(inout) :: bound
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_model_bind

    ! Place of a named parameter among `parameters`.
    function ents_parameter_place(model, name, place, report) result(status) bind(c, name="ents_parameter_place")
      import :: c_char, c_int32_t, c_int64_t, c_ptr, ents_report
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), intent(inout) :: place
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_parameter_place

    ! The block of numbers of a field.
    function ents_field_size(model, name, size, report) result(status) bind(c, name="ents_field_size")
      import :: c_char, c_int32_t, c_int64_t, c_ptr, ents_report
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), intent(inout) :: size
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_field_size

    function ents_field_init(model, name, samples, block, size, report) result(status) bind(c, name="ents_field_init")
      import :: c_char, c_double, c_int32_t, c_int64_t, c_ptr, ents_report
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), value :: samples
      real(c_double), intent(inout) :: block(*)
      integer(c_int64_t), value :: size
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_field_init

    function ents_field_sample(model, name, block, size, count, s, height, report) result(status) &
      bind(c, name="ents_field_sample")
      import :: c_char, c_double, c_int32_t, c_int64_t, c_ptr, ents_report
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(in) :: block(*)
      integer(c_int64_t), value :: size, count
      real(c_double), intent(in) :: s(*)
      real(c_double), intent(inout) :: height(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_field_sample

    function ents_tree_size(model, segments, size, report) result(status) bind(c, name="ents_tree_size")
      import :: c_int32_t, c_int64_t, c_ptr, ents_report
      type(c_ptr), value :: model
      integer(c_int64_t), value :: segments
      integer(c_int64_t), intent(inout) :: size
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_tree_size

    function ents_tree_build(model, mesh, tree, size, report) result(status) bind(c, name="ents_tree_build")
      import :: c_double, c_int32_t, c_int64_t, c_ptr, ents_master_mesh, ents_report
      type(c_ptr), value :: model
      type(ents_master_mesh), intent(in), target :: mesh
      real(c_double), intent(inout) :: tree(*)
      integer(c_int64_t), value :: size
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_tree_build

    function ents_tree_refit(model, mesh, tree, size, report) result(status) bind(c, name="ents_tree_refit")
      import :: c_double, c_int32_t, c_int64_t, c_ptr, ents_master_mesh, ents_report
      type(c_ptr), value :: model
      type(ents_master_mesh), intent(in), target :: mesh
      real(c_double), intent(inout) :: tree(*)
      integer(c_int64_t), value :: size
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_tree_refit

    ! Boxes around the enriched segments, with their heights and borders.
    function ents_surface_boxes(model, mesh, boxes, report) result(status) bind(c, name="ents_surface_boxes")
      import :: c_double, c_int32_t, c_ptr, ents_master_mesh, ents_report
      type(c_ptr), value :: model
      type(ents_master_mesh), intent(in), target :: mesh
      real(c_double), intent(inout) :: boxes(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_surface_boxes

    ! Project the slave nodes first .. first + count - 1 on the surface.
    function ents_detect(model, mesh, tree, size, first, count, detection, report) result(status) bind(c, name="ents_detect")
      import :: c_double, c_int32_t, c_int64_t, c_ptr, ents_detection, ents_master_mesh, ents_report
      type(c_ptr), value :: model
      type(ents_master_mesh), intent(in), target :: mesh
      real(c_double), intent(in) :: tree(*)
      integer(c_int64_t), value :: size, first, count
      type(ents_detection), intent(in), target :: detection
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_detect

    ! Self-contact.
    function ents_thickness(model, mesh, tree, size, first, count, detection, thickness, report) result(status) &
      bind(c, name="ents_thickness")
      import :: c_double, c_int32_t, c_int64_t, c_ptr, ents_detection, ents_master_mesh, ents_report
      type(c_ptr), value :: model
      type(ents_master_mesh), intent(in), target :: mesh
      real(c_double), intent(in) :: tree(*)
      integer(c_int64_t), value :: size, first, count
      type(ents_detection), intent(in), target :: detection
      real(c_double), intent(inout) :: thickness(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_thickness

    ! Evaluate the elements first .. first + count - 1 of the arrays.
    function ents_evaluate(model, first, count, input, output, report) result(status) bind(c, name="ents_evaluate")
      import :: c_int32_t, c_int64_t, c_ptr, ents_input, ents_output, ents_report
      type(c_ptr), value :: model
      integer(c_int64_t), value :: first, count
      type(ents_input), intent(in), target :: input
      type(ents_output), intent(in), target :: output
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_evaluate

    ! Fill state blocks for elements without history.
    function ents_state_init(model, count, state, stride, report) result(status) bind(c, name="ents_state_init")
      import :: c_double, c_int32_t, c_int64_t, c_ptr, ents_report
      type(c_ptr), value :: model
      integer(c_int64_t), value :: count
      real(c_double), intent(inout) :: state(*)
      integer(c_int64_t), value :: stride
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_state_init

    ! Augmented Lagrangian with multipliers in the state (Uzawa's iteration).
    function ents_state_augment(model, count, state_begin, begin_stride, state_end, end_stride, report) result(status) &
      bind(c, name="ents_state_augment")
      import :: c_double, c_int32_t, c_int64_t, c_ptr, ents_report
      type(c_ptr), value :: model
      integer(c_int64_t), value :: count
      real(c_double), intent(inout) :: state_begin(*)
      integer(c_int64_t), value :: begin_stride
      real(c_double), intent(in) :: state_end(*)
      integer(c_int64_t), value :: end_stride
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_state_augment

    ! Move a state to another segment, for a slave node that has moved there.
    function ents_state_transfer(model, old_master, old_surface_coordinates, new_master, new_surface_coordinates, state, moved, &
      report) result(status) bind(c, name="ents_state_transfer")
      import :: c_double, c_int32_t, c_ptr, ents_report
      type(c_ptr), value :: model
      real(c_double), intent(in) :: old_master(*)
      type(c_ptr), value :: old_surface_coordinates
      real(c_double), intent(in) :: new_master(*)
      type(c_ptr), value :: new_surface_coordinates
      real(c_double), intent(in) :: state(*)
      real(c_double), intent(inout) :: moved(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_state_transfer

    ! Wear.
    function ents_wear_collect(model, first, count, input, thickness, state, state_stride, name, block, size, volume, report) &
      result(status) bind(c, name="ents_wear_collect")
      import :: c_char, c_double, c_int32_t, c_int64_t, c_ptr, ents_input, ents_report
      type(c_ptr), value :: model
      integer(c_int64_t), value :: first, count
      type(ents_input), intent(in), target :: input
      real(c_double), value :: thickness
      real(c_double), intent(inout) :: state(*)
      integer(c_int64_t), value :: state_stride
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(inout) :: block(*)
      integer(c_int64_t), value :: size
      type(c_ptr), value :: volume
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_wear_collect

    ! Derivatives of gap, energy and residual of the elements first .. first + count - 1 by every named parameter.
    function ents_parameter_derivatives(model, first, count, input, derivatives, report) result(status) &
      bind(c, name="ents_parameter_derivatives")
      import :: c_int32_t, c_int64_t, c_ptr, ents_derivatives, ents_input, ents_report
      type(c_ptr), value :: model
      integer(c_int64_t), value :: first, count
      type(ents_input), intent(in), target :: input
      type(ents_derivatives), intent(in), target :: derivatives
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_parameter_derivatives

    ! Tributary areas of slave nodes.
    function ents_tributary_areas(facet, facets, connectivity, nodes, positions, thickness, areas, report) result(status) &
      bind(c, name="ents_tributary_areas")
      import :: c_char, c_double, c_int32_t, c_int64_t, ents_report
      character(kind=c_char), intent(in) :: facet(*)
      integer(c_int64_t), value :: facets
      integer(c_int64_t), intent(in) :: connectivity(*)
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: positions(*)
      real(c_double), value :: thickness
      real(c_double), intent(inout) :: areas(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_tributary_areas

    ! Contact area of a slave surface from the results at its nodes.
    function ents_contact_area(facet, facets, connectivity, nodes, positions, thickness, gap, pressure, modulus, area, report) &
      result(status) bind(c, name="ents_contact_area")
      import :: c_char, c_double, c_int32_t, c_int64_t, ents_area, ents_report
      character(kind=c_char), intent(in) :: facet(*)
      integer(c_int64_t), value :: facets
      integer(c_int64_t), intent(in) :: connectivity(*)
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: positions(*)
      real(c_double), value :: thickness
      real(c_double), intent(in) :: gap(*), pressure(*)
      real(c_double), value :: modulus
      type(ents_area), intent(inout), target :: area
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_contact_area

    ! Resultants from the results of ents_evaluate or ents_iterate.
    function ents_contact_resultants(dimension, count, points, normal, pressure, traction, areas, flags, about, resultants, &
      report) result(status) bind(c, name="ents_contact_resultants")
      import :: c_double, c_int32_t, c_int64_t, c_ptr, ents_report, ents_resultants
      integer(c_int32_t), value :: dimension
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: points(*), normal(*), pressure(*)
      type(c_ptr), value :: traction
      real(c_double), intent(in) :: areas(*)
      integer(c_int32_t), intent(in) :: flags(*)
      type(c_ptr), value :: about
      type(ents_resultants), intent(inout), target :: resultants
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_contact_resultants

    ! Stiffness of a penalty from the bodies and the mesh, and the critical time step of an explicit host.
    function ents_suggest(modulus, spacing, area, slave_mass, master_mass, suggestion, report) result(status) &
      bind(c, name="ents_suggest")
      import :: c_double, c_int32_t, ents_report, ents_suggestion
      real(c_double), value :: modulus, spacing, area, slave_mass, master_mass
      type(ents_suggestion), intent(inout), target :: suggestion
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_suggest

    ! Positions of the points from those of the host's nodes; or any other numbers that are given per node (surface coordinates);
    ! with `reflected`, `shifts` or `heights` these are positions, and surface coordinates are components of the points.
    function ents_combine(combination, dimension, nodes, positions, points, report) result(status) bind(c, name="ents_combine")
      import :: c_double, c_int32_t, c_int64_t, ents_combination, ents_report
      type(ents_combination), intent(in), target :: combination
      integer(c_int32_t), value :: dimension
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: positions(*)
      real(c_double), intent(inout) :: points(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_combine

    ! Sampling points of slave facets, so that texture between slave nodes is seen and a constant pressure gives every slave node
    ! its exact share (Zavarise and De Lorenzis, IJNME 79, 2009).
    function ents_sampling_points(facet, per_direction, facets, connectivity, nodes, positions, thickness, begin, point_nodes, &
      weights, areas, report) result(status) bind(c, name="ents_sampling_points")
      import :: c_char, c_double, c_int32_t, c_int64_t, ents_report
      character(kind=c_char), intent(in) :: facet(*)
      integer(c_int32_t), value :: per_direction
      integer(c_int64_t), value :: facets
      integer(c_int64_t), intent(in) :: connectivity(*)
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: positions(*)
      real(c_double), value :: thickness
      integer(c_int64_t), intent(inout) :: begin(*), point_nodes(*)
      real(c_double), intent(inout) :: weights(*), areas(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_sampling_points

    ! A slave surface that is enriched, too.
    function ents_raise_points(surface, points, coordinates, heights, slopes, report) result(status) &
      bind(c, name="ents_raise_points")
      import :: c_double, c_int32_t, c_ptr, ents_combination, ents_report
      type(c_ptr), value :: surface
      type(ents_combination), intent(in), target :: points
      type(c_ptr), value :: coordinates
      real(c_double), intent(inout) :: heights(*), slopes(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_raise_points

    ! Wear of a slave surface whose points lie above their facets by a height that has a field, as ents_wear_collect for the master.
    function ents_wear_collect_slave(model, surface, points, coordinates, nodes, positions, thickness, areas, state, state_stride, &
      name, block, size, volume, report) result(status) bind(c, name="ents_wear_collect_slave")
      import :: c_char, c_double, c_int32_t, c_int64_t, c_ptr, ents_combination, ents_report
      type(c_ptr), value :: model, surface
      type(ents_combination), intent(in), target :: points
      type(c_ptr), value :: coordinates
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: positions(*)
      real(c_double), value :: thickness
      real(c_double), intent(in) :: areas(*)
      real(c_double), intent(inout) :: state(*)
      integer(c_int64_t), value :: state_stride
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(inout) :: block(*)
      integer(c_int64_t), value :: size
      type(c_ptr), value :: volume
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_wear_collect_slave

    ! A smoothed master surface over ordinary facets.
    function ents_smooth_size(facet, basis, ends, facets, connectivity, nodes, points, terms, report) result(status) &
      bind(c, name="ents_smooth_size")
      import :: c_char, c_int32_t, c_int64_t, ents_report
      character(kind=c_char), intent(in) :: facet(*), basis(*)
      integer(c_int32_t), value :: ends
      integer(c_int64_t), value :: facets
      integer(c_int64_t), intent(in) :: connectivity(*)
      integer(c_int64_t), value :: nodes
      integer(c_int64_t), intent(inout) :: points, terms
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_smooth_size

    function ents_smooth(facet, basis, ends, facets, connectivity, nodes, points, terms, segment_points, begin, point_nodes, &
      weights, report) result(status) bind(c, name="ents_smooth")
      import :: c_char, c_double, c_int32_t, c_int64_t, ents_report
      character(kind=c_char), intent(in) :: facet(*), basis(*)
      integer(c_int32_t), value :: ends
      integer(c_int64_t), value :: facets
      integer(c_int64_t), intent(in) :: connectivity(*)
      integer(c_int64_t), value :: nodes, points, terms
      integer(c_int64_t), intent(inout) :: segment_points(*), begin(*), point_nodes(*)
      real(c_double), intent(inout) :: weights(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_smooth

    ! As ents_smooth, for a surface that ends on planes of symmetry.
    function ents_smooth_mirrored_size(facet, basis, ends, facets, connectivity, nodes, mirror, points, terms, report) &
      result(status) bind(c, name="ents_smooth_mirrored_size")
      import :: c_char, c_int32_t, c_int64_t, ents_mirror, ents_report
      character(kind=c_char), intent(in) :: facet(*), basis(*)
      integer(c_int32_t), value :: ends
      integer(c_int64_t), value :: facets
      integer(c_int64_t), intent(in) :: connectivity(*)
      integer(c_int64_t), value :: nodes
      type(ents_mirror), intent(in), target :: mirror
      integer(c_int64_t), intent(inout) :: points, terms
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_smooth_mirrored_size

    function ents_smooth_mirrored(facet, basis, ends, facets, connectivity, nodes, mirror, points, terms, segment_points, begin, &
      point_nodes, weights, reflected, shifts, report) result(status) bind(c, name="ents_smooth_mirrored")
      import :: c_char, c_double, c_int32_t, c_int64_t, ents_mirror, ents_report
      character(kind=c_char), intent(in) :: facet(*), basis(*)
      integer(c_int32_t), value :: ends
      integer(c_int64_t), value :: facets
      integer(c_int64_t), intent(in) :: connectivity(*)
      integer(c_int64_t), value :: nodes
      type(ents_mirror), intent(in), target :: mirror
      integer(c_int64_t), value :: points, terms
      integer(c_int64_t), intent(inout) :: segment_points(*), begin(*), point_nodes(*)
      real(c_double), intent(inout) :: weights(*)
      integer(c_int32_t), intent(inout) :: reflected(*)
      real(c_double), intent(inout) :: shifts(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_smooth_mirrored

    ! The body's frame is that of space, the reference point its origin.
    function ents_pose_init(dimension, pose, report) result(status) bind(c, name="ents_pose_init")
      import :: c_int32_t, ents_pose, ents_report
      integer(c_int32_t), value :: dimension
      type(ents_pose), intent(inout), target :: pose
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_pose_init

    ! Move the reference point and turn the body about it.
    function ents_pose_move(dimension, translation, spin, pose, report) result(status) bind(c, name="ents_pose_move")
      import :: c_double, c_int32_t, ents_pose, ents_report
      integer(c_int32_t), value :: dimension
      real(c_double), intent(in) :: translation(*), spin(*)
      type(ents_pose), intent(inout), target :: pose
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_pose_move

    ! y = Q^T (x - point), positions; v = Q w, vectors.
    function ents_pose_to_body(dimension, pose, count, positions, in_body, report) result(status) &
      bind(c, name="ents_pose_to_body")
      import :: c_double, c_int32_t, c_int64_t, ents_pose, ents_report
      integer(c_int32_t), value :: dimension
      type(ents_pose), intent(in), target :: pose
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: positions(*)
      real(c_double), intent(inout) :: in_body(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_pose_to_body

    function ents_pose_to_space(dimension, pose, count, in_body, vectors, report) result(status) &
      bind(c, name="ents_pose_to_space")
      import :: c_double, c_int32_t, c_int64_t, ents_pose, ents_report
      integer(c_int32_t), value :: dimension
      type(ents_pose), intent(in), target :: pose
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: in_body(*)
      real(c_double), intent(inout) :: vectors(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_pose_to_space

    ! The element of a slave point and the body, from that of a rigid master in the body's frame.
    function ents_pose_element(dimension, pose, slave, residual, tangent, body_residual, body_tangent, report) result(status) &
      bind(c, name="ents_pose_element")
      import :: c_double, c_int32_t, ents_pose, ents_report
      integer(c_int32_t), value :: dimension
      type(ents_pose), intent(in), target :: pose
      real(c_double), intent(in) :: slave(*), residual(*), tangent(*)
      real(c_double), intent(inout) :: body_residual(*), body_tangent(*)
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_pose_element

    ! Evaluate the elements first .. first + count - 1 and add their residuals and tangents to the host's equations.
    function ents_assemble(model, first, count, input, output, system, report) result(status) bind(c, name="ents_assemble")
      import :: c_int32_t, c_int64_t, c_ptr, ents_input, ents_report, ents_system
      type(c_ptr), value :: model
      integer(c_int64_t), value :: first, count
      type(ents_input), intent(in), target :: input
      type(c_ptr), value :: output
      type(ents_system), intent(in), target :: system
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_assemble

    ! Contact of one Newton iteration in one call.
    function ents_iterate(model, mesh, tree, size, first, count, detection, input, output, system, report) result(status) &
      bind(c, name="ents_iterate")
      import :: c_double, c_int32_t, c_int64_t, c_ptr, ents_detection, ents_input, ents_master_mesh, ents_report
      type(c_ptr), value :: model
      type(ents_master_mesh), intent(in), target :: mesh
      real(c_double), intent(in) :: tree(*)
      integer(c_int64_t), value :: size, first, count
      type(ents_detection), intent(in), target :: detection
      type(ents_input), intent(in), target :: input
      type(c_ptr), value :: output, system
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_iterate

    function ents_surface_evaluate(model, count, surface, report) result(status) bind(c, name="ents_surface_evaluate")
      import :: c_int32_t, c_int64_t, c_ptr, ents_report, ents_surface
      type(c_ptr), value :: model
      integer(c_int64_t), value :: count
      type(ents_surface), intent(in), target :: surface
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_surface_evaluate

    function ents_model_check(model, master, surface_coordinates, result, report) result(status) bind(c, name="ents_model_check")
      import :: c_int32_t, c_ptr, ents_admissibility, ents_report
      type(c_ptr), value :: model, master, surface_coordinates
      type(ents_admissibility), intent(inout), target :: result
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_model_check

    function ents_surface_check(model, mesh, result, report) result(status) bind(c, name="ents_surface_check")
      import :: c_int32_t, c_ptr, ents_master_mesh, ents_report, ents_surface_admissibility
      type(c_ptr), value :: model
      type(ents_master_mesh), intent(in), target :: mesh
      type(ents_surface_admissibility), intent(inout), target :: result
      type(ents_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function ents_surface_check
  end interface

contains

  subroutine init_report(x)
    type(ents_report), intent(out) :: x
    x = ents_report()
  end subroutine init_report

  subroutine init_data(x)
    type(ents_data), intent(out) :: x
    x = ents_data()
  end subroutine init_data

  subroutine init_layout(x)
    type(ents_layout), intent(out) :: x
    x = ents_layout()
  end subroutine init_layout

  subroutine init_master_mesh(x)
    type(ents_master_mesh), intent(out) :: x
    x = ents_master_mesh()
  end subroutine init_master_mesh

  subroutine init_detection(x)
    type(ents_detection), intent(out) :: x
    x = ents_detection()
  end subroutine init_detection

  subroutine init_input(x)
    type(ents_input), intent(out) :: x
    x = ents_input()
  end subroutine init_input

  subroutine init_output(x)
    type(ents_output), intent(out) :: x
    x = ents_output()
  end subroutine init_output

  subroutine init_derivatives(x)
    type(ents_derivatives), intent(out) :: x
    x = ents_derivatives()
  end subroutine init_derivatives

  subroutine init_area(x)
    type(ents_area), intent(out) :: x
    x = ents_area()
  end subroutine init_area

  subroutine init_resultants(x)
    type(ents_resultants), intent(out) :: x
    x = ents_resultants()
  end subroutine init_resultants

  subroutine init_suggestion(x)
    type(ents_suggestion), intent(out) :: x
    x = ents_suggestion()
  end subroutine init_suggestion

  subroutine init_combination(x)
    type(ents_combination), intent(out) :: x
    x = ents_combination()
  end subroutine init_combination

  subroutine init_mirror(x)
    type(ents_mirror), intent(out) :: x
    x = ents_mirror()
  end subroutine init_mirror

  subroutine init_pose(x)
    type(ents_pose), intent(out) :: x
    x = ents_pose()
  end subroutine init_pose

  subroutine init_system(x)
    type(ents_system), intent(out) :: x
    x = ents_system()
  end subroutine init_system

  subroutine init_surface(x)
    type(ents_surface), intent(out) :: x
    x = ents_surface()
  end subroutine init_surface

  subroutine init_admissibility(x)
    type(ents_admissibility), intent(out) :: x
    x = ents_admissibility()
  end subroutine init_admissibility

  subroutine init_surface_admissibility(x)
    type(ents_surface_admissibility), intent(out) :: x
    x = ents_surface_admissibility()
  end subroutine init_surface_admissibility

  ! The tree of a mesh's segments: `tree` gets the size of ents_tree_size and the contents of ents_tree_build. Returns their status.
  function ents_tree_allocate(model, mesh, tree, report) result(status)
    type(c_ptr), intent(in) :: model
    type(ents_master_mesh), intent(in) :: mesh
    real(c_double), allocatable, intent(inout) :: tree(:)
    type(ents_report), intent(inout) :: report
    integer(c_int32_t) :: status
    integer(c_int64_t) :: length
    length = 0
    status = ents_tree_size(model, mesh%segments, length, report)
    if (status /= ENTS_OK) return
    if (allocated(tree)) deallocate (tree)
    allocate (tree(length))
    status = ents_tree_build(model, mesh, tree, length, report)
  end function ents_tree_allocate

  ! States of `count` elements at the begin and at the end of an increment, (state_size, count) each, from ents_state_init. Returns
  ! its status. The stride of both is size(begin, 1, c_int64_t).
  function ents_state_allocate(model, count, begin, end, report) result(status)
    type(c_ptr), intent(in) :: model
    integer(c_int64_t), intent(in) :: count
    real(c_double), allocatable, intent(inout) :: begin(:, :), end(:, :)
    type(ents_report), intent(inout) :: report
    integer(c_int32_t) :: status
    type(ents_layout) :: layout
    status = ents_model_layout(model, layout, report)
    if (status /= ENTS_OK) return
    if (allocated(begin)) deallocate (begin)
    if (allocated(end)) deallocate (end)
    allocate (begin(layout%state_size, max(count, 0_c_int64_t)))
    status = ents_state_init(model, count, begin, size(begin, 1, c_int64_t), report)
    if (status == ENTS_OK) end = begin
  end function ents_state_allocate

  pure function string_from_characters(characters) result(string)
    character(kind=c_char), intent(in) :: characters(:)
    character(:), allocatable :: string
    integer :: length, i
    length = 0
    do while (length < size(characters))
      if (characters(length + 1) == c_null_char) exit
      length = length + 1
    end do
    allocate (character(length) :: string)
    do i = 1, length
      string(i:i) = characters(i)
    end do
  end function string_from_characters

  function string_from_pointer(pointer) result(string)
    type(c_ptr), intent(in) :: pointer
    character(:), allocatable :: string
    character(kind=c_char), pointer :: characters(:)
    integer :: length
    if (.not. c_associated(pointer)) then
      string = ""
      return
    end if
    length = 0
    do
      call c_f_pointer(pointer, characters, [length + 1])
      if (characters(length + 1) == c_null_char) exit
      length = length + 1
    end do
    string = string_from_characters(characters(1:length))
  end function string_from_pointer

end module ents
