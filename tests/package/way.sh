#!/bin/sh
# way.sh PYTHON ROOT: core/way.svg is what abi/manual/way.py draws.
set -eu
drawn=$(mktemp)
trap 'rm -f "$drawn"' EXIT
"$1" -B "$2/abi/manual/way.py" "$2" >"$drawn"
cmp "$drawn" "$2/core/way.svg" || { echo "draw it anew: python3 abi/manual/way.py . > core/way.svg" >&2; exit 1; }
grep -c 'marker-end' "$2/core/way.svg"
