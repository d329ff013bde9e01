#!/bin/sh
# fortran_host.sh FORTRAN_HOST ENTS_HOST SCENE PYTHON BLOCK_PY OUT: the Fortran host and ents-host find the same forces.
set -eu
fortran=$1 host=$2 scene=$3 python=$4 compare=$5 out=$6
if [ ! -x "$fortran" ]; then echo "no Fortran compiler or no LAPACK here (Debian: gfortran liblapack-dev)"; exit 3; fi
mkdir -p "$out"
"$fortran" "$scene" >"$out/forces"
cat "$out/forces"
"$host" run "$scene" --out "$out/host" >"$out/host.log"
"$python" -B "$compare" compare "$out/forces" "$out/host/result.json"

# Mistakes end it with a message.
if "$fortran" "$out/no_such_scene.json" >"$out/mistake" 2>&1; then echo "no error for a scene that is not there"; exit 1; fi
sed 's/"bspline4"/"bspline4", "wrong": 1/' "$scene" >"$out/wrong.json"
if "$fortran" "$out/wrong.json" >"$out/mistake" 2>&1; then echo "no error for a wrong model"; exit 1; fi
grep 'ents: /wrong' "$out/mistake"
