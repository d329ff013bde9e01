#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""ents.h, read once for every language that repeats it.

usage: bindings.py fortran ents.h ents.f90.in > ents.f90
       bindings.py python ents.h > ../adapters/python/ents/_structs.py
       bindings.py facts FILE

fortran  the Fortran module: the template's lines, and for @constants, @types, @init and @interfaces what follows from the header
python   constants, ctypes structs and argument types of the functions
facts    constants, structs and functions of ents.h, or of the prototypes that gfortran writes for ents.f90, one fact a line:
             constant ENTS_GAP
             struct ents_report 2 int64 element          place, kind and name of a field; char[512] and int32 are kinds, too
             function ents_state_init 0 int32 -          place 0 is what the function returns

A test compares the committed files with what this program writes: change ents.h, run the first two lines, commit all three files.
The header has to keep to its form: a comment in front of what it explains, or at the end of the line of a field or constant, where it
begins with the array's shape ("[segments][m]"); results name their array and shape at their bit of `wanted`.

exit status: 0 done; 1 the header has something that this program cannot translate; 2 wrong command line"""
import math
import pathlib
import re
import sys

# Argument types of functions that take null; the header says so in words. Fortran passes c_loc of them, or c_null_ptr.
NULLABLE = {"ents_model_create": ("directory", "data"), "ents_assemble": ("output",), "ents_iterate": ("output", "system"),
            "ents_model_bind": ("parameters", "fields"), "ents_field_init": ("samples",), "ents_wear_collect": ("volume",),
            "ents_wear_collect_slave": ("coordinates", "volume"),
            "ents_model_check": ("master", "surface_coordinates"), "ents_raise_points": ("coordinates",), "ents_contact_resultants": ("traction", "about"),
            "ents_state_transfer": ("old_surface_coordinates", "new_surface_coordinates")}
FORTRAN = {"int32_t": ("integer(c_int32_t)", "0"), "int64_t": ("integer(c_int64_t)", "0"), "double": ("real(c_double)", "0"),
           "char": ("character(kind=c_char)", "c_null_char"), "ents_height_function": ("type(c_funptr)", "c_null_funptr")}
PYTHON = {"int32_t": "ctypes.c_int32", "int64_t": "ctypes.c_int64", "double": "ctypes.c_double", "char": "ctypes.c_char",
          "ents_height_function": "ctypes.c_void_p"}
BYTES = {"int32_t": 4, "int64_t": 8, "double": 8, "char": 1}
KINDS = {"int32_t": "int32", "int": "int32", "int64_t": "int64", "long": "int64", "double": "float64", "char": "char",
         "ents_height_function": "function", "function_pointer": "function"}


def shape_of(text):
    """["segments", "m"] of "[segments][m] nodes ..."."""
    extent = r"\[((?:[^][]|\[[^]]*\])*)\]"
    return re.findall(extent, (re.match(f"(?:{extent})+", text) or [""])[0])


class Variable:
    """A field or an argument: its type without `const` and stars, how many stars, whether what they point to is const, its extents, its
    comment."""

    def __init__(self, declaration, comment=""):
        words = re.fullmatch(r"(.*?)(\w*)((?:\[\d+\])*)", declaration.strip(), re.S)
        head, self.name, extents = words.groups()
        self.extents = [int(e) for e in re.findall(r"\d+", extents)]
        self.stars, self.const = head.count("*"), "const" in head.split()
        self.type = head.replace("*", " ").replace("const", " ").split()[-1]
        self.comment = " ".join(comment.split())
        self.shape = shape_of(self.comment)

    @property
    def count(self):
        return math.prod(self.extents)

    @property
    def kind(self):
        return "pointer" if self.stars else KINDS[self.type] + (f"[{self.count}]" if self.extents else "")


class Header:
    """constants: {name: (value, comment)}, structs: {name: [Variable]}, functions: {name: (Variable returned, [Variable], comment)}"""

    def __init__(self, text):
        self.constants = {}
        for name, value, comment in re.findall(r"^#define (ENTS_[A-Z0-9_]+) +([-\d(][^/\n]*?) *(?:/\*(.*))?$", text, re.M):
            self.constants[name] = eval(value), comment  # "(1 << 3)", "12"
        for place, name, value in ((m.start(), *m.groups()) for m in re.finditer(r"^ *X\((ENTS_\w+), (-?\d+),", text, re.M)):
            self.constants[name] = int(value), ""
        order = {name: re.search(rf"(#define|X\() ?{name}\b", text).start() for name in self.constants}
        self.constants = {name: self.constants[name] for name in sorted(self.constants, key=order.get)}
        code = re.sub(r"^#(?:[^\n]*\\\n)*[^\n]*$", "", text, flags=re.M)  # without directives
        code = re.sub(r"\w+ \(\*(\w+)\) ?\(\)", r"function_pointer \1", code)  # as gfortran writes them
        self.structs = {name: [v for part in re.findall(r"([^;]+);[ \t]*(?:/\*(.*?)\*/)?", re.sub(r"^\s*/\*.*?\*/", "", body, flags=re.S), re.S)
                               for v in self._declared(*part)]
                        for name, body in re.findall(r"typedef struct (ents_\w+) \{(.*?)\} \1;", code, re.S)}
        self.functions = {}
        for comment, result, name, arguments in re.findall(
                r"(?:/\*((?:(?!\*/).)*)\*/\s*)?^(?:ENTS_API )?(\w[\w ]*?[\s*]+)(ents_\w+) ?\(([^)]*)\);", code, re.S | re.M):
            listed = [a for a in arguments.split(",") if a.strip() not in ("", "void")]
            self.functions[name] = Variable(result + name), [Variable(a) for a in listed], " ".join(comment.replace("\n *", "\n").split())
        if not (self.constants or self.functions):
            sys.exit("bindings.py: no constant and no function was found: give ents.h")

    @staticmethod
    def _declared(declaration, comment):
        """"double a, b[2]" is two fields."""
        first, *others = declaration.split(",")
        head = re.match(r"(.*?)\w+(\[\d+\])*$", first.strip(), re.S)[1]
        return [Variable(first, comment)] + [Variable(head + other, comment) for other in others]

    def results(self):
        """{name of a result: (its constant, its field of ents_output, its shape)}, in the order of the bits of `wanted`."""
        fields = {field.name: field for field in self.structs["ents_output"]}
        found = {}
        for constant, (_, comment) in self.constants.items():
            name, _, rest = comment.strip().partition(" ")
            if name in fields and shape_of(rest.strip()):
                found[name] = constant, fields[name], shape_of(rest.strip())
        return found


def wrapped(words, indent, separator=", ", width=132, continued=" &"):
    """Lines of words up to `width` characters, those after the first indented by two more."""
    lines = [" " * indent]
    for i, word in enumerate(words):
        piece = word + (separator if i + 1 < len(words) else "")
        if len(lines[-1]) + len(piece.rstrip()) > width - len(continued) and lines[-1].strip():
            lines[-1] = lines[-1].rstrip() + continued
            lines.append(" " * (indent + 2))
        lines[-1] += piece
    return "\n".join(lines)


# ---- Fortran

def fortran_constants(header):
    return "\n".join(f"  integer(c_int32_t), parameter :: {name} = {value}" for name, (value, _) in header.constants.items())


def fortran_shape(header, struct, fields, field):
    """What a pointer of a struct leads to, as a comment."""
    if field.type in header.structs:
        return f"c_loc of an {field.type}"
    if field.type == "char":
        return "a text that ends with c_null_char"
    shape = list(header.results()[field.name][2]) if struct == "ents_output" and field.name in header.results() else list(field.shape)
    if any(other.name == field.name + "_stride" for other in fields):
        shape.insert(0, "elements")
    shape = [extent for extent in reversed(shape) if extent != "1" or len(shape) == 1]
    said = ["(" + ", ".join(shape) + ")"] if shape else []
    return ", ".join(said + ([] if field.type in ("double", "void") else [field.type[:-2]]))


def fortran_types(header):
    out = []
    for name, fields in header.structs.items():
        pointers = sum(field.stars > 0 for field in fields)
        size = str(sum(field.count * BYTES[field.type] for field in fields if not field.stars))
        size += f" + {pointers}*pointer_bytes" if pointers else ""
        out.append(f"  type, bind(c) :: {name}")
        for field in fields:
            if field.stars:
                comment = fortran_shape(header, name, fields, field)
                out.append(f"    type(c_ptr) :: {field.name} = c_null_ptr" + (f" ! {comment}" if comment else ""))
            else:
                kind, zero = FORTRAN[field.type] if field.name != "struct_size" else (FORTRAN[field.type][0], size)
                extents = "(" + ", ".join(map(str, reversed(field.extents))) + ")" if field.extents else ""
                out.append(f"    {kind} :: {field.name}{extents} = {zero}")
        out.append(f"  end type {name}\n")
    return "\n".join(out).rstrip("\n")


def fortran_init(header):
    names = ["init_" + name[len("ents_"):] for name in header.structs]
    interface = "  interface ents_init\n" + wrapped(["module procedure " + names[0], *names[1:]], 4) + "\n  end interface ents_init\n"
    return interface + wrapped(["private :: " + names[0], *names[1:]], 2)


def fortran_init_procedures(header):
    return "\n\n".join(f"  subroutine init_{name[len('ents_'):]}(x)\n    type({name}), intent(out) :: x\n"
                       f"    x = {name}()\n  end subroutine init_{name[len('ents_'):]}"
                       for name in header.structs)


def fortran_argument(header, function, v):
    """Its declaration without the name, and what follows the name."""
    handle = v.type not in header.structs and v.type not in FORTRAN
    if not v.stars:
        return FORTRAN[v.type][0] + ", value", ""
    if v.name in NULLABLE.get(function, ()) or (handle and v.stars == 1):
        return "type(c_ptr), value", ""
    if handle:
        return f"type(c_ptr), intent({'inout' if function.endswith(('_destroy', '_bind')) else 'out'})", ""
    if v.type == "ents_report":
        return "type(ents_report), intent(inout)", ""
    intent = "intent(in)" if v.const else "intent(inout)"
    if v.type in header.structs:
        return f"type({v.type}), {intent}, target", ""
    return f"{FORTRAN[v.type][0]}, {intent}", "" if function.endswith(("_size", "_place")) and not v.const else "(*)"


def fortran_interfaces(header):
    out = []
    for name, (result, arguments, comment) in header.functions.items():
        # Fortran does not tell ents_version from ENTS_VERSION.
        own = name if name.upper() not in header.constants else name.replace("ents_", "ents_library_")
        returned = "text" if result.stars else "status"
        declared = [(*fortran_argument(header, name, v), v.name) for v in arguments]
        declared.append(("type(c_ptr)" if result.stars else FORTRAN[result.type][0], "", returned))
        lines = []
        for kind, extent, argument in declared:
            if lines and lines[-1][0] == kind:
                lines[-1][1].append(argument + extent)
            else:
                lines.append([kind, [argument + extent]])
        imported = sorted(set(re.findall(r"\b(?:c_\w+|ents_\w+)(?=\))", " ".join(kind.replace("kind=", "") for kind, _ in lines))))
        sentence = re.match(r"(?!Errors|Detection)(.*?[^. ])([.:?])(?= |$)", comment)
        if sentence:
            words = ["!", *sentence[1].split()]
            words[-1] += "?" if sentence[2] == "?" else "."
            out.append(wrapped(words, 4, " ", continued="").replace("\n      ", "\n    ! "))
        head = [f"function {own}(" + (arguments[0].name if arguments else ""), *(v.name for v in arguments[1:])]
        head[-1] += ")"
        out.append(wrapped(", ".join(head).split(" ") + [f"result({returned})", f'bind(c, name="{name}")'], 4, " "))
        out.append(wrapped(["import :: " + imported[0], *imported[1:]], 6))
        out += [wrapped([f"{kind} :: {names[0]}", *names[1:]], 6) for kind, names in lines]
        out.append(f"    end function {own}\n")
    return "  interface\n" + "\n".join(out).rstrip("\n") + "\n  end interface"


def fortran(header, template):
    parts = {"constants": fortran_constants, "types": fortran_types, "init": fortran_init, "interfaces": fortran_interfaces,
             "init_procedures": fortran_init_procedures}
    return re.sub(r"^@(\w+)$", lambda match: parts[match[1]](header), template, flags=re.M)


# ---- Python

def python_type(v):
    if v.stars:
        return "ctypes.c_char_p" if v.type == "char" and v.stars == 1 else "ctypes.c_void_p"
    return " * ".join([PYTHON[v.type], *map(str, reversed(v.extents))])


def tuple_of(names):
    """A tuple of texts."""
    names = [f'"{name}"' for name in names if name != "1"]
    return "(" + ", ".join(names) + ("," if len(names) == 1 else "") + ")"


def python(header):
    out = ["# SPDX-License-Identifier: BSD-3-Clause",
           '"""Constants, structs and functions of ents.h. Written by abi/bindings/bindings.py: change ents.h, not this file."""', "import ctypes", "import enum", ""]
    enums = {"Status": "Statuses of ents.h. 1 .. 99: cut the step; negative: raised as Error.", "Flag": 'Bits of result["flags"].',
             "Need": "Bits of Model.layout.needs: what the elements of a model need. What they do not need is not computed.",
             "Shared": "Bits of Input.shared: arrays of Model.assemble that all elements share."}
    of_prefix = {"NEEDS": "Need", "FLAG": "Flag", "SHARED": "Shared"}
    members, plain, conditions = {name: [] for name in enums}, [], []
    results = header.results()
    of_results = {constant for constant, _, _ in results.values()}
    for constant, (value, _) in header.constants.items():
        name = constant[len("ENTS_"):]
        prefix = name.split("_")[0]
        if prefix == "CHECK":
            conditions.append((value, name[len("CHECK_"):].lower()))
        elif prefix in of_prefix:
            members[of_prefix[prefix]].append(f"    {name[len(prefix) + 1:]} = {value}")
        elif prefix in ("CONTRACT", "ENDS"):
            plain.append(f"{name} = {value}")
        elif constant not in of_results:
            members["Status"].append(f"    {name} = {value}")
    out += plain
    for name, text in enums.items():
        out += ["", "", f"class {name}(enum.{'IntEnum' if name == 'Status' else 'IntFlag'}):", f'    """{text}"""', *members[name]]
    out += ["", "", "# Results of elements: bit of `wanted`, type of the numbers, shape (without sizes that are 1).", "RESULTS = {"]
    out += [f'    "{name}": ({header.constants[constant][0]}, "{KINDS[field.type]}", {tuple_of(shape)}),'
            for name, (constant, field, shape) in results.items()]
    out += ["}", 'QUANTITIES = {name: bit for name, (bit, _, _) in RESULTS.items()}', "",
            "# Inputs of elements: the shape of one element's.", "INPUTS = {"]
    inputs = header.structs["ents_input"]
    strides = {v.name for v in inputs if v.name.endswith("_stride")}
    out += [f'    "{v.name}": {tuple_of(v.shape)},' for v in inputs if v.type == "double" and v.name + "_stride" in strides]
    out += ["}", "", "# Places in the arrays of SurfaceAdmissibility.", f"CONDITIONS = {tuple_of(name for _, name in sorted(conditions))}", ""]
    names = {}
    for struct, fields in header.structs.items():
        names[struct] = "".join(word.capitalize() for word in struct.split("_")[1:])
        out += ["", f"class {names[struct]}(ctypes.Structure):", "    _fields_ = [",
                *(f'        ("{v.name}", {python_type(v)}),' for v in fields), "    ]", ""]
    out += ["", "STRUCTS = {"] + [f'    "{struct}": {name},' for struct, name in names.items()] + ["}", ""]
    out += ["# Type of the result, types of the arguments.", "FUNCTIONS = {"]
    for name, (result, arguments, _) in header.functions.items():
        out += [f'    "{name}": ({python_type(result)}, ({", ".join(map(python_type, arguments))}{"," if len(arguments) == 1 else ""})),']
    return "\n".join(out + ["}"]) + "\n"


def facts(header):
    out = [f"constant {name}" for name in header.constants]
    out += [f"struct {name} {i} {v.kind} {v.name}" for name, fields in header.structs.items() for i, v in enumerate(fields)]
    for name, (result, arguments, _) in header.functions.items():
        out += [f"function {name} 0 {result.kind} -"] + [f"function {name} {i} {v.kind} {v.name}" for i, v in enumerate(arguments, 1)]
    return "\n".join(out) + "\n"


def main(arguments):
    if arguments in (["--help"], ["-h"]):
        return print(__doc__)
    files = {"fortran": 2, "python": 1, "facts": 1}
    if not arguments or files.get(arguments[0]) != len(arguments) - 1:
        print(__doc__, file=sys.stderr)
        return sys.exit(2)
    header, *template = (pathlib.Path(name).read_text(encoding="utf-8") for name in arguments[1:])
    sys.stdout.write({"fortran": fortran, "python": python, "facts": facts}[arguments[0]](Header(header), *template))


if __name__ == "__main__":
    main(sys.argv[1:])
