# SPDX-License-Identifier: BSD-3-Clause
"""Constants and structs of ents.h, in its order. A test compares them with the header as a C compiler sees it."""
import ctypes
import enum

CONTRACT_MAJOR, CONTRACT_MINOR = 1, 4
ENDS_STRAIGHT, ENDS_REPEATED = 0, 1


class Status(enum.IntEnum):
    """Statuses of ents.h. 1 .. 99: cut the step; negative: raised as Error."""
    OK = 0
    NO_PROJECTION, SINGULAR_PROJECTION, AMBIGUOUS_PROJECTION, DEGENERATE_SEGMENT, GRAZING_RAY, DEEP_PENETRATION, OUT_OF_RANGE = range(1, 8)
    NULL_ARGUMENT, STRUCT_SIZE, VERSION, NON_FINITE, JSON_SYNTAX, UNKNOWN_KEY = range(-1, -7, -1)
    BAD_VALUE, FILE, BAD_MASK, BAD_COUNT, BAD_HANDLE, BAD_STATE, BAD_PATTERN = range(-7, -14, -1)
    NO_MEMORY, INTERNAL = -100, -101


class Flag(enum.IntFlag):
    """Bits of result["flags"]."""
    CONTACT, OUTSIDE, FAR_SIDE, SEARCHED, STICK, SLIP, SHEAR_LIMIT, CHANGED, AMBIGUOUS, BEHIND_EDGE = (1 << i for i in range(10))


class Need(enum.IntFlag):
    """Bits of Model.layout.needs: what the elements of a model need. What they do not need is not computed."""
    HEIGHT, SLOPE, CURVED, ITERATION, MASTER, FRICTION, HISTORY, MULTIPLIERS, ONE_BY_ONE = (1 << i for i in range(9))


# Kinds of fields, below as "kind:name" in the order of ents.h.
_KINDS = {"i": ctypes.c_int32, "l": ctypes.c_int64, "d": ctypes.c_double, "p": ctypes.c_void_p, "s": ctypes.c_char_p, "m": ctypes.c_char * 512,
          "l16": ctypes.c_int64 * 16, "d16": ctypes.c_double * 16, "d16x2": ctypes.c_double * 2 * 16, "d16x3": ctypes.c_double * 3 * 16}


def _struct(name, fields):
    pairs = [field.split(":") for field in ("i:struct_size " + fields).split()]
    return type(name, (ctypes.Structure,), {"_fields_": [(field, _KINDS[kind]) for kind, field in pairs]})


_STRIDED = [  # name of the quantity, kind of its numbers; in the order of the bits ENTS_XI, ENTS_GAP ... except `state_end`
    *((name, "d") for name in "xi gap normal_gap normal point gap_gradient gap_hessian xi_gradient xi_hessian energy pressure residual tangent "
      "state_end".split()), ("flags", "i"), ("iterations", "i"), *((name, "d") for name in "traction slip age".split())]
QUANTITIES = {name: 1 << bit for bit, (name, _) in enumerate(_STRIDED)}

Report = _struct("ents_report", "i:status l:element d:step_factor m:message")
Data = _struct("ents_data", "i:reserved p:name p:values l:rows l:columns")
Layout = _struct("ents_layout", "i:dimension i:nodes i:parameters i:dofs i:state_size i:symmetric_tangent i:own_surface_coordinates "
                 "i:multipliers i:friction i:augmentable i:needs s:instruction_set")
MasterMesh = _struct("ents_master_mesh", "i:reserved l:segments p:connectivity l:nodes p:positions p:surface_coordinates")
Detection = _struct("ents_detection", "i:reserved p:slave d:reach p:segment p:xi p:gap p:flags p:other p:slave_node")
Input = _struct("ents_input", "i:reserved " + " ".join(f"p:{name} l:{name}_stride" for name in (
    "slave", "master", "surface_coordinates", "start", "area", "state_begin", "multiplier")) + " p:mesh p:segment l:segment_stride")
Output = _struct("ents_output", "i:wanted p:status l:status_stride " + " ".join(
    f"p:{name} l:{name}_stride" + (" l:tangent_leading_dimension" if name == "tangent" else "") for name, _ in _STRIDED))
Surface = _struct("ents_surface", "i:reserved p:master p:surface_coordinates p:xi p:point p:normal p:height p:base_point p:base_normal")
Combination = _struct("ents_combination", "i:reserved l:points p:begin p:nodes p:weights")
SystemOfHost = _struct("ents_system", "i:index_size p:slave p:master l:slave_nodes p:slave_equations l:master_nodes p:master_equations "
                       "p:multiplier_equations l:rows p:residual p:row_begin p:columns p:values p:places l:places_size")
SurfaceCheck = _struct("ents_surface_admissibility", "i:samples d:reach d:kink p:violations l:judged l:violated d16:value d16:bound d16:missing "
                       "l16:segment d16x2:xi d16x3:point l16:other d16x2:other_xi d:height_min d:height_max")
STRUCTS = (Report, Data, Layout, MasterMesh, Detection, Input, Output, Surface, Combination, SystemOfHost, SurfaceCheck)
CONDITIONS = "continuity fold edge jump kink wedge projection shadow occlusion crossing".split()  # places in the arrays of SurfaceCheck
