#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""doxygen_filter.py ents.h: the header with its comments as Doxygen wants them.

Comments in front of what they document begin with /**, those behind it with /**<. Within a comment an indented line "   name   text" is an item of
a list, and what is indented more belongs to it."""
import re
import sys

text = open(sys.argv[1], encoding="utf-8").read()
text = re.sub(r"(?m)^/\* ---- .*?---- *-*\*/\n", "", text)
text = re.sub(r"(?m)^/\*(?!\*)", "/**", text)
text = re.sub(r"(?m)^( *\S[^\n]*?\S) +/\*(?![*<])", r"\1 /**<", text)
lines, inside = [], False
for line in text.splitlines():
    item = re.match(r" \*   (\S.*?)(?:  +(\S.*))?$", line)
    if item and not inside:
        lines.append(" *")
    if item:
        line = f" * - `{item[1]}` {item[2]}" if item[2] else f" * - {item[1]}"
    more = bool(re.match(r" \*      ", line))
    if inside and not item and not more:
        lines.append(" *")
    inside = (bool(item) or (inside and more)) and not line.endswith("*/")
    lines.append(line)
print("\n".join(lines))
