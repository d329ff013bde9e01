#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The schema of the heights that are formulas, from the tables of their files.

usage: schema.py core/height abi/model.schema.json > model.schema.json

Prints the schema with the entries of the formulas that core/height/formulas.hpp lists, made from what each says of itself (type, formula,
table); all else is copied. A test compares the committed file with it: after a change of a table run this and commit both.

exit status: 0 done; 1 a table or the schema has something that this program cannot read; 2 wrong command line"""
import pathlib
import re
import sys

STRING = r'((?:"(?:[^"\\]|\\.)*"\s*)+)'
KINDS = {("any", False): "number", ("any", True): "bound_number", ("positive", False): "positive", ("positive", True): "bound_positive",
         ("vector", False): "surface_vector", ("vector", True): "bound_vector"}


def text_of(literals):
    """The text of string literals side by side."""
    return "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', literals))


def described(text):
    return f'"description": "{text}", ' if text else ""


def entry_of(source, name):
    """The schema of one formula: its name, and lines."""
    said = re.search(r"struct " + name + r" \{\s*static constexpr char\s+type\[\] = " + STRING + r",\s*formula\[\] = " + STRING
                     + r";\s*static constexpr FormulaNumber table\[\] = \{(.*?)\};", source, re.S)
    if not said:
        sys.exit(f"schema.py: no type, formula and table of {name}")
    word, formula, table = text_of(said[1]), text_of(said[2]), said[3]
    row = r"\{\s*" + STRING + r",\s*" + STRING + r"(?:,\s*FormulaNumber::(\w+))?(?:,\s*(true|false))?(?:,\s*([-+.\de]+))?\s*\}"
    rows = re.findall(row, table)
    if not rows or re.sub(row, "", table).strip(" ,\n"):
        sys.exit(f"schema.py: the table of {name} is not rows of {{key, meaning, kind, named, otherwise}}")
    required = ", ".join(f'"{text_of(key)}"' for key, *_, otherwise in rows if not otherwise)
    lines = [f'            "{text_of(key)}": {{ {described(text_of(meaning))}"$ref": "#/$defs/{KINDS[kind or "any", named == "true"]}" }}'
             for key, meaning, kind, named, otherwise in rows]
    return word, "\n".join([
        "        {", *([f'          {described(formula)[:-1]}'] if formula else []), '          "type": "object",',
        f'          "required": ["type", {required}],', '          "additionalProperties": false,', '          "properties": {',
        ",\n".join([f'            "type": {{ "const": "{word}" }}', *lines]), "          }", "        }"])


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, schema = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).read_text()
    listed = re.findall(r"X\((\w+), (\w+)\)", (folder / "formulas.hpp").read_text().split("#define", 1)[1])
    head, heights = schema.split('    "height": {\n      "oneOf": [\n', 1)
    blocks = re.findall(r"^        \{\n.*?^        \}", heights, re.S | re.M)
    rest = heights.split(blocks[-1], 1)[1]
    source = "\n".join(path.read_text() for path in sorted(folder.glob("*.hpp")))
    entries = [entry_of(source, name) for _, name in listed]
    formulas = {word for word, _ in entries}
    type_of = r'"type": \{ "const": "(\w+)" \}'
    others = [b for b in blocks if not formulas.intersection(re.findall(type_of, b))]
    sys.stdout.write(head + '    "height": {\n      "oneOf": [\n' + ",\n".join([text for _, text in entries] + others) + rest)


if __name__ == "__main__":
    main()
