#!/bin/sh
# header_bindings.sh PYTHON SOURCES: ents.f90 and the Python module's _structs.py are what bindings.py writes from ents.h, the schema of
# models is what schema.py writes from the tables of heights and laws.
set -eu
python=$1
cd "$2/abi"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

compare() { # COMMITTED PROGRAM ARGUMENTS...
  committed=$1
  shift
  "$python" "$@" >"$scratch/written"
  diff -u "$committed" "$scratch/written" ||
    { echo "$committed is not what its source says now: in abi, run python3 $* > /tmp/written and copy that to $committed" >&2; exit 1; }
}
compare ents.f90 bindings/bindings.py fortran ents.h bindings/ents.f90.in
compare ../adapters/python/ents/_structs.py bindings/bindings.py python ents.h
compare model.schema.json bindings/schema.py ../core model.schema.json
