#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The schema of the heights that are formulas and of the normal laws, from the tables of their files.

usage: schema.py core abi/model.schema.json > model.schema.json

Prints the schema with the entries of the formulas that core/height/formulas.hpp lists and of the laws that core/law/normal_kinds.hpp
lists, made from what each says of itself (type, formula, table); all else is copied. A test compares the committed file with it: after a
change of a table run this and commit both.

exit status: 0 done; 1 a table or the schema has something that this program cannot read; 2 wrong command line"""
import pathlib
import re
import sys

STRING = r'((?:"(?:[^"\\]|\\.)*"\s*)+)'
NUMBERS = '"type": "array", "minItems": 2, "maxItems": 1024, "items": { "$ref": "#/$defs/number" }'
KINDS = {("any", False): '"$ref": "#/$defs/number"', ("any", True): '"$ref": "#/$defs/bound_number"',
         ("positive", False): '"$ref": "#/$defs/positive"', ("positive", True): '"$ref": "#/$defs/bound_positive"',
         ("vector", False): '"$ref": "#/$defs/surface_vector"', ("vector", True): '"$ref": "#/$defs/bound_vector"',
         ("exponent", False): '"type": "number", "minimum": 1, "maximum": 20, "multipleOf": 0.5',
         ("rising", False): NUMBERS, ("falling", False): NUMBERS}


def text_of(literals):
    """The text of string literals side by side."""
    return "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', literals))


def described(text):
    return f'"description": "{text}", ' if text else ""


def entry_of(source, name, number, kind_of_all, indent):
    """The schema of one formula or law: its name, and lines. number: the type of a row of its table."""
    said = re.search(r"struct " + name + r"(?: : \w+)? \{\s*static constexpr char\s+type\[\] = " + STRING + r",\s*formula\[\] =\s*" + STRING
                     + r";\s*static constexpr " + number + r" table\[\] = \{(.*?)\};", source, re.S)
    inherited = re.search(r"struct " + name + r" : (\w+) \{\s*static constexpr char\s+type\[\] = " + STRING + r",\s*formula\[\] =\s*" + STRING,
                          source, re.S)
    if said:
        word, formula, table = text_of(said[1]), text_of(said[2]), said[3]
    elif inherited:
        word, formula = text_of(inherited[2]), text_of(inherited[3])
        table = re.search(r"struct " + inherited[1] + r"\b.*?" + number + r" table\[\] = \{(.*?)\};", source, re.S)[1]
    else:
        sys.exit(f"schema.py: no type, formula and table of {name}")
    row = r"\{\s*" + STRING + r",\s*" + STRING + r"(?:,\s*" + number + r"::(\w+))?(?:,\s*(true|false))?(?:,\s*([-+.\de]+))?\s*\}"
    rows = re.findall(row, table)
    if not rows or re.sub(row, "", table).strip(" ,\n"):
        sys.exit(f"schema.py: the table of {name} is not rows of {{key, meaning, kind, named, otherwise}}")
    required = ", ".join(f'"{text_of(key)}"' for key, *_, otherwise in rows if not otherwise)
    lines = [f'    "{text_of(key)}": {{ {described(text_of(meaning))}{KINDS[kind or kind_of_all, named == "true"]} }}'
             for key, meaning, kind, named, otherwise in rows]
    entry = ["{", *([f"  {described(formula)[:-1]}"] if formula else []), '  "type": "object",',
             f'  "required": ["type", {required}],', '  "additionalProperties": false,', '  "properties": {',
             *",\n".join([f'    "type": {{ "const": "{word}" }}', *lines]).split("\n"), "  }", "}"]
    return word, "\n".join(indent + line for line in entry)


def replaced(schema, key, indent, entries):
    """The schema with these entries first in the "oneOf" of the key, which is indented so far."""
    begin = f'{indent}"{key}": {{\n{indent}  "oneOf": [\n'
    head, rest = schema.split(begin, 1)
    body, end = rest.split(f"\n{indent}  ]", 1)
    blocks = re.findall(rf"^{indent}    \{{\n.*?^{indent}    \}}", body, re.S | re.M)
    types = {word for word, _ in entries}
    others = [b for b in blocks if not types.intersection(re.findall(r'"type": \{ "const": "(\w+)" \}', b))]
    return head + begin + ",\n".join([text for _, text in entries] + others) + f"\n{indent}  ]" + end


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    core, schema = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).read_text()
    for folder, file, number, kind, key, indent in (("height", "formulas.hpp", "FormulaNumber", "any", "height", "    "),
                                                    ("law", "normal_kinds.hpp", "LawNumber", "positive", "normal", "        ")):
        listed = re.findall(r"X\((\w+), (\w+)\)", (core / folder / file).read_text().split("#define", 1)[1])
        source = "\n".join(path.read_text() for path in sorted((core / folder).glob("*.hpp")))
        schema = replaced(schema, key, indent, [entry_of(source, name, number, kind, indent + "    ") for _, name in listed])
    sys.stdout.write(schema)


if __name__ == "__main__":
    main()
