#!/bin/sh
# header_bindings.sh PYTHON SOURCES: ents.f90 and the Python module's _structs.py are what bindings.py writes from ents.h.
set -eu
python=$1
cd "$2/abi"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

compare() { # COMMITTED ARGUMENTS...
  committed=$1
  shift
  "$python" bindings.py "$@" >"$scratch/written"
  diff -u "$committed" "$scratch/written" ||
    { echo "$committed is not what ents.h says now: in abi, run python3 bindings.py $* > $committed" >&2; exit 1; }
}
compare ents.f90 fortran ents.h ents.f90.in
compare ../adapters/python/ents/_structs.py python ents.h
