# SPDX-License-Identifier: BSD-3-Clause
"""Constants, structs and functions of ents.h. Written by abi/bindings/bindings.py: change ents.h, not this file."""
import ctypes
import enum

CONTRACT_MAJOR = 1
CONTRACT_MINOR = 11
ENDS_STRAIGHT = 0
ENDS_REPEATED = 1
ENDS_QUASI_CUBIC = 2
ENDS_QUASI_PARABOLIC = 3


class Status(enum.IntEnum):
    """Statuses of ents.h. 1 .. 99: cut the step; negative: raised as Error."""
    OK = 0
    NO_PROJECTION = 1
    SINGULAR_PROJECTION = 2
    AMBIGUOUS_PROJECTION = 3
    DEGENERATE_SEGMENT = 4
    GRAZING_RAY = 5
    DEEP_PENETRATION = 6
    OUT_OF_RANGE = 7
    NULL_ARGUMENT = -1
    STRUCT_SIZE = -2
    VERSION = -3
    NON_FINITE = -4
    JSON_SYNTAX = -5
    UNKNOWN_KEY = -6
    BAD_VALUE = -7
    FILE = -8
    BAD_MASK = -9
    BAD_COUNT = -10
    BAD_HANDLE = -11
    BAD_STATE = -12
    BAD_PATTERN = -13
    NO_MEMORY = -100
    INTERNAL = -101


class Flag(enum.IntFlag):
    """Bits of result["flags"]."""
    CONTACT = 1
    OUTSIDE = 2
    FAR_SIDE = 4
    SEARCHED = 8
    STICK = 16
    SLIP = 32
    SHEAR_LIMIT = 64
    AMBIGUOUS = 256
    BEHIND_EDGE = 512
    LEFT = 1024
    NO_BEGIN = 2048
    CROSSED = 4096
    CHANGED = 128


class Need(enum.IntFlag):
    """Bits of Model.layout.needs: what the elements of a model need. What they do not need is not computed."""
    HEIGHT = 1
    SLOPE = 2
    CURVED = 4
    ITERATION = 8
    MASTER = 16
    FRICTION = 32
    HISTORY = 64
    MULTIPLIERS = 128
    ONE_BY_ONE = 256
    TEMPERATURES = 512
    FIRST_STATE = 1024


class Shared(enum.IntFlag):
    """Bits of Input.shared: arrays of Model.assemble that all elements share."""
    SLAVE = 1
    SEGMENT = 2
    AREA = 4
    STATE = 8
    MULTIPLIER = 16
    NO_STATE = 32
    SLAVE_VALUES = 64
    TEMPERATURE = 128


# Results of elements: bit of `wanted`, type of the numbers, shape (without sizes that are 1).
RESULTS = {
    "xi": (1, "float64", ("d-1",)),
    "gap": (2, "float64", ()),
    "normal_gap": (4, "float64", ()),
    "normal": (8, "float64", ("d",)),
    "point": (16, "float64", ("d",)),
    "gap_gradient": (32, "float64", ("n",)),
    "gap_hessian": (64, "float64", ("n", "n")),
    "xi_gradient": (128, "float64", ("d-1", "n")),
    "xi_hessian": (256, "float64", ("d-1", "n", "n")),
    "energy": (512, "float64", ()),
    "pressure": (1024, "float64", ()),
    "residual": (2048, "float64", ("dofs",)),
    "tangent": (4096, "float64", ("dofs", "tangent_leading_dimension")),
    "state_end": (8192, "float64", ("state_size",)),
    "flags": (16384, "int32", ()),
    "iterations": (32768, "int32", ()),
    "traction": (65536, "float64", ("d",)),
    "slip": (131072, "float64", ()),
    "age": (262144, "float64", ()),
    "dissipation": (524288, "float64", ()),
    "friction_energy": (1048576, "float64", ()),
    "heat": (2097152, "float64", ("2",)),
}
QUANTITIES = {name: bit for name, (bit, _, _) in RESULTS.items()}

# Inputs of elements: the shape of one element's.
INPUTS = {
    "slave": ("d",),
    "master": ("m", "d"),
    "surface_coordinates": ("m", "d-1"),
    "start": ("d-1",),
    "area": (),
    "state_begin": ("state_size",),
    "multiplier": ("multipliers",),
    "slave_values": ("slave_values",),
    "slave_temperature": (),
    "master_temperature": ("m",),
}

# Places in the arrays of SurfaceAdmissibility.
CONDITIONS = ("continuity", "fold", "edge", "jump", "kink", "wedge", "projection", "shadow", "occlusion", "crossing")


class Report(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("status", ctypes.c_int32),
        ("element", ctypes.c_int64),
        ("step_factor", ctypes.c_double),
        ("message", ctypes.c_char * 512),
    ]


class Data(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("name", ctypes.c_char_p),
        ("values", ctypes.c_void_p),
        ("rows", ctypes.c_int64),
        ("columns", ctypes.c_int64),
    ]


class Layout(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("dimension", ctypes.c_int32),
        ("nodes", ctypes.c_int32),
        ("parameters", ctypes.c_int32),
        ("dofs", ctypes.c_int32),
        ("state_size", ctypes.c_int32),
        ("symmetric_tangent", ctypes.c_int32),
        ("own_surface_coordinates", ctypes.c_int32),
        ("multipliers", ctypes.c_int32),
        ("friction", ctypes.c_int32),
        ("augmentable", ctypes.c_int32),
        ("needs", ctypes.c_int32),
        ("instruction_set", ctypes.c_char_p),
        ("named_parameters", ctypes.c_int32),
        ("fields", ctypes.c_int32),
        ("worn", ctypes.c_int32),
        ("slave_values", ctypes.c_int32),
        ("node_dofs", ctypes.c_int32),
        ("heat", ctypes.c_int32),
    ]


class MasterMesh(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("segments", ctypes.c_int64),
        ("connectivity", ctypes.c_void_p),
        ("nodes", ctypes.c_int64),
        ("positions", ctypes.c_void_p),
        ("surface_coordinates", ctypes.c_void_p),
        ("temperature", ctypes.c_void_p),
    ]


class Detection(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("slave", ctypes.c_void_p),
        ("reach", ctypes.c_double),
        ("segment", ctypes.c_void_p),
        ("xi", ctypes.c_void_p),
        ("gap", ctypes.c_void_p),
        ("flags", ctypes.c_void_p),
        ("other", ctypes.c_void_p),
        ("slave_node", ctypes.c_void_p),
        ("permitted", ctypes.c_int64),
        ("slave_begin", ctypes.c_void_p),
        ("positions_begin", ctypes.c_void_p),
        ("slave_normal", ctypes.c_void_p),
        ("slave_segment", ctypes.c_void_p),
        ("depth", ctypes.c_void_p),
        ("slave_side", ctypes.c_void_p),
        ("segment_side", ctypes.c_void_p),
    ]


class Input(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("slave", ctypes.c_void_p),
        ("slave_stride", ctypes.c_int64),
        ("master", ctypes.c_void_p),
        ("master_stride", ctypes.c_int64),
        ("surface_coordinates", ctypes.c_void_p),
        ("surface_coordinates_stride", ctypes.c_int64),
        ("start", ctypes.c_void_p),
        ("start_stride", ctypes.c_int64),
        ("area", ctypes.c_void_p),
        ("area_stride", ctypes.c_int64),
        ("state_begin", ctypes.c_void_p),
        ("state_begin_stride", ctypes.c_int64),
        ("multiplier", ctypes.c_void_p),
        ("multiplier_stride", ctypes.c_int64),
        ("mesh", ctypes.c_void_p),
        ("segment", ctypes.c_void_p),
        ("segment_stride", ctypes.c_int64),
        ("positions_begin", ctypes.c_void_p),
        ("shared", ctypes.c_int64),
        ("slave_values", ctypes.c_void_p),
        ("slave_values_stride", ctypes.c_int64),
        ("slave_begin", ctypes.c_void_p),
        ("slave_temperature", ctypes.c_void_p),
        ("slave_temperature_stride", ctypes.c_int64),
        ("master_temperature", ctypes.c_void_p),
        ("master_temperature_stride", ctypes.c_int64),
        ("time_increment", ctypes.c_double),
    ]


class Output(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("wanted", ctypes.c_int32),
        ("status", ctypes.c_void_p),
        ("status_stride", ctypes.c_int64),
        ("xi", ctypes.c_void_p),
        ("xi_stride", ctypes.c_int64),
        ("gap", ctypes.c_void_p),
        ("gap_stride", ctypes.c_int64),
        ("normal_gap", ctypes.c_void_p),
        ("normal_gap_stride", ctypes.c_int64),
        ("normal", ctypes.c_void_p),
        ("normal_stride", ctypes.c_int64),
        ("point", ctypes.c_void_p),
        ("point_stride", ctypes.c_int64),
        ("gap_gradient", ctypes.c_void_p),
        ("gap_gradient_stride", ctypes.c_int64),
        ("gap_hessian", ctypes.c_void_p),
        ("gap_hessian_stride", ctypes.c_int64),
        ("xi_gradient", ctypes.c_void_p),
        ("xi_gradient_stride", ctypes.c_int64),
        ("xi_hessian", ctypes.c_void_p),
        ("xi_hessian_stride", ctypes.c_int64),
        ("energy", ctypes.c_void_p),
        ("energy_stride", ctypes.c_int64),
        ("pressure", ctypes.c_void_p),
        ("pressure_stride", ctypes.c_int64),
        ("residual", ctypes.c_void_p),
        ("residual_stride", ctypes.c_int64),
        ("tangent", ctypes.c_void_p),
        ("tangent_stride", ctypes.c_int64),
        ("tangent_leading_dimension", ctypes.c_int64),
        ("state_end", ctypes.c_void_p),
        ("state_end_stride", ctypes.c_int64),
        ("flags", ctypes.c_void_p),
        ("flags_stride", ctypes.c_int64),
        ("iterations", ctypes.c_void_p),
        ("iterations_stride", ctypes.c_int64),
        ("traction", ctypes.c_void_p),
        ("traction_stride", ctypes.c_int64),
        ("slip", ctypes.c_void_p),
        ("slip_stride", ctypes.c_int64),
        ("age", ctypes.c_void_p),
        ("age_stride", ctypes.c_int64),
        ("dissipation", ctypes.c_void_p),
        ("dissipation_stride", ctypes.c_int64),
        ("friction_energy", ctypes.c_void_p),
        ("friction_energy_stride", ctypes.c_int64),
        ("heat", ctypes.c_void_p),
        ("heat_stride", ctypes.c_int64),
    ]


class Derivatives(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("gap", ctypes.c_void_p),
        ("energy", ctypes.c_void_p),
        ("residual", ctypes.c_void_p),
        ("adjoint", ctypes.c_void_p),
        ("product", ctypes.c_void_p),
    ]


class Area(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("surface", ctypes.c_double),
        ("counted", ctypes.c_double),
        ("border_corrected", ctypes.c_double),
        ("zero_line", ctypes.c_double),
        ("estimate", ctypes.c_double),
        ("error", ctypes.c_double),
        ("peak_pressure", ctypes.c_double),
        ("peak_drop", ctypes.c_double),
    ]


class Resultants(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("normal", ctypes.c_double * 3),
        ("tangential", ctypes.c_double * 3),
        ("moment", ctypes.c_double * 3),
        ("centre", ctypes.c_double * 3),
        ("area", ctypes.c_double),
        ("largest_pressure", ctypes.c_double),
        ("deepest", ctypes.c_int64),
        ("open", ctypes.c_int64),
        ("contact", ctypes.c_int64),
        ("stick", ctypes.c_int64),
        ("slip", ctypes.c_int64),
    ]


class Suggestion(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("normal_stiffness", ctypes.c_double),
        ("tangential_stiffness", ctypes.c_double),
        ("time_step", ctypes.c_double),
    ]


class Combination(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("points", ctypes.c_int64),
        ("begin", ctypes.c_void_p),
        ("nodes", ctypes.c_void_p),
        ("weights", ctypes.c_void_p),
        ("reflected", ctypes.c_void_p),
        ("shifts", ctypes.c_void_p),
        ("heights", ctypes.c_void_p),
        ("slopes", ctypes.c_void_p),
    ]


class Mirror(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("planes", ctypes.c_int32),
        ("axes", ctypes.c_void_p),
        ("places", ctypes.c_void_p),
        ("positions", ctypes.c_void_p),
    ]


class Pose(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("point", ctypes.c_double * 3),
        ("turn", ctypes.c_double * 9),
    ]


class System(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("index_size", ctypes.c_int32),
        ("slave", ctypes.c_void_p),
        ("master", ctypes.c_void_p),
        ("slave_nodes", ctypes.c_int64),
        ("slave_equations", ctypes.c_void_p),
        ("master_nodes", ctypes.c_int64),
        ("master_equations", ctypes.c_void_p),
        ("multiplier_equations", ctypes.c_void_p),
        ("rows", ctypes.c_int64),
        ("residual", ctypes.c_void_p),
        ("row_begin", ctypes.c_void_p),
        ("columns", ctypes.c_void_p),
        ("values", ctypes.c_void_p),
        ("places", ctypes.c_void_p),
        ("places_size", ctypes.c_int64),
        ("pose", ctypes.c_void_p),
        ("body_equations", ctypes.c_void_p),
        ("slave_positions", ctypes.c_void_p),
    ]


class Surface(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("master", ctypes.c_void_p),
        ("surface_coordinates", ctypes.c_void_p),
        ("xi", ctypes.c_void_p),
        ("point", ctypes.c_void_p),
        ("normal", ctypes.c_void_p),
        ("height", ctypes.c_void_p),
        ("base_point", ctypes.c_void_p),
        ("base_normal", ctypes.c_void_p),
    ]


class Admissibility(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("samples", ctypes.c_int32),
        ("continuity", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("fold", ctypes.c_double),
        ("fold_xi", ctypes.c_double * 2),
        ("edge_height", ctypes.c_double),
        ("edge_height_xi", ctypes.c_double * 2),
        ("reach", ctypes.c_double),
        ("reach_xi", ctypes.c_double * 2),
        ("shadow", ctypes.c_double),
        ("shadow_xi", ctypes.c_double * 2),
        ("height_min", ctypes.c_double),
        ("height_max", ctypes.c_double),
    ]


class SurfaceAdmissibility(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_int32),
        ("samples", ctypes.c_int32),
        ("reach", ctypes.c_double),
        ("kink", ctypes.c_double),
        ("violations", ctypes.c_void_p),
        ("judged", ctypes.c_int64),
        ("violated", ctypes.c_int64),
        ("value", ctypes.c_double * 16),
        ("bound", ctypes.c_double * 16),
        ("missing", ctypes.c_double * 16),
        ("segment", ctypes.c_int64 * 16),
        ("xi", ctypes.c_double * 2 * 16),
        ("point", ctypes.c_double * 3 * 16),
        ("other", ctypes.c_int64 * 16),
        ("other_xi", ctypes.c_double * 2 * 16),
        ("height_min", ctypes.c_double),
        ("height_max", ctypes.c_double),
    ]


STRUCTS = {
    "ents_report": Report,
    "ents_data": Data,
    "ents_layout": Layout,
    "ents_master_mesh": MasterMesh,
    "ents_detection": Detection,
    "ents_input": Input,
    "ents_output": Output,
    "ents_derivatives": Derivatives,
    "ents_area": Area,
    "ents_resultants": Resultants,
    "ents_suggestion": Suggestion,
    "ents_combination": Combination,
    "ents_mirror": Mirror,
    "ents_pose": Pose,
    "ents_system": System,
    "ents_surface": Surface,
    "ents_admissibility": Admissibility,
    "ents_surface_admissibility": SurfaceAdmissibility,
}

# Type of the result, types of the arguments.
FUNCTIONS = {
    "ents_status_text": (ctypes.c_char_p, (ctypes.c_int32,)),
    "ents_version": (ctypes.c_char_p, ()),
    "ents_check_contract": (ctypes.c_int32, (ctypes.c_int32, ctypes.c_int32, ctypes.c_void_p)),
    "ents_height_register": (ctypes.c_int32, (ctypes.c_char_p, ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_model_create": (ctypes.c_int32, (ctypes.c_char_p, ctypes.c_int64, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_model_create_from_file": (ctypes.c_int32, (ctypes.c_char_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_model_destroy": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p)),
    "ents_model_layout": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_model_bind": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_parameter_place": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_field_size": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_field_init": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p)),
    "ents_field_sample": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_tree_size": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_tree_build": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p)),
    "ents_tree_refit": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p)),
    "ents_surface_boxes": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_detect": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_thickness": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_evaluate": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_state_init": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p)),
    "ents_state_augment": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p)),
    "ents_state_transfer": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_wear_collect": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p, ctypes.c_int64, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_parameter_derivatives": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_tributary_areas": (ctypes.c_int32, (ctypes.c_char_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_contact_area": (ctypes.c_int32, (ctypes.c_char_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_contact_resultants": (ctypes.c_int32, (ctypes.c_int32, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_suggest": (ctypes.c_int32, (ctypes.c_double, ctypes.c_double, ctypes.c_double, ctypes.c_double, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_combine": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_int32, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_sampling_points": (ctypes.c_int32, (ctypes.c_char_p, ctypes.c_int32, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_raise_points": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_wear_collect_slave": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_smooth_size": (ctypes.c_int32, (ctypes.c_char_p, ctypes.c_char_p, ctypes.c_int32, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_smooth": (ctypes.c_int32, (ctypes.c_char_p, ctypes.c_char_p, ctypes.c_int32, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_smooth_mirrored_size": (ctypes.c_int32, (ctypes.c_char_p, ctypes.c_char_p, ctypes.c_int32, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_smooth_mirrored": (ctypes.c_int32, (ctypes.c_char_p, ctypes.c_char_p, ctypes.c_int32, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_pose_init": (ctypes.c_int32, (ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_pose_move": (ctypes.c_int32, (ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_pose_to_body": (ctypes.c_int32, (ctypes.c_int32, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_pose_to_space": (ctypes.c_int32, (ctypes.c_int32, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_pose_element": (ctypes.c_int32, (ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_assemble": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_iterate": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_surface_evaluate": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_model_check": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
    "ents_surface_check": (ctypes.c_int32, (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)),
}
