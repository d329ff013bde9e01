#!/bin/sh
# header_includes.sh ents.h: the header asks for <stddef.h> and <stdint.h>, nothing else.
set -eu
includes=$(sed -n 's/^ *# *include *//p' "$1" | sort | tr '\n' ' ')
[ "$includes" = "<stddef.h> <stdint.h> " ] || {
  echo "$1 includes $includes; the contract allows <stddef.h> and <stdint.h> only" >&2
  exit 1
}
