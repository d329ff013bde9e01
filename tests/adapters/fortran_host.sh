#!/bin/sh
# fortran_host.sh FORTRAN_HOST ENTS_HOST SCENE PYTHON BLOCK_PY OUT: the Fortran host and ents-lab find the same forces.
set -eu
fortran=$1 host=$2 scene=$3 python=$4 compare=$5 out=$6
if [ ! -x "$fortran" ]; then echo "no Fortran compiler or no LAPACK here (Debian: gfortran liblapack-dev)"; exit 3; fi
mkdir -p "$out"
"$fortran" "$scene" >"$out/forces"
cat "$out/forces"
"$host" run "$scene" --out "$out/host" >"$out/host.log"
"$python" -B "$compare" compare "$out/forces" "$out/host/result.json"

# Mistakes end it with a message.
mistake() { # STATUS TEXT ARGUMENT...: the program ends with STATUS and says TEXT on stderr, without a backtrace
  wanted=$1 text=$2 status=0
  shift 2
  "$fortran" "$@" >"$out/forces" 2>"$out/mistake" || status=$?
  [ $status -eq "$wanted" ] || { echo "exit status $status instead of $wanted: fortran_host $*"; exit 1; }
  grep -qF "$text" "$out/mistake" || { echo "fortran_host $* does not say '$text' but:"; cat "$out/mistake"; exit 1; }
  if grep -i 'backtrace' "$out/mistake"; then exit 1; fi
}
mistake 2 'no_such_scene.json cannot be read: ' "$out/no_such_scene.json"
echo '{"title": "no contact"}' >"$out/no_model.json"
mistake 2 'no_model.json has no key "model"' "$out/no_model.json"
mistake 2 'usage: fortran_host SCENE'
"$fortran" --help | grep -q 'usage: fortran_host SCENE'
sed 's/"bspline4"/"bspline4", "wrong": 1/' "$scene" >"$out/wrong.json"
if "$fortran" "$out/wrong.json" >"$out/mistake" 2>&1; then echo "no error for a wrong model"; exit 1; fi
grep 'ents: /wrong' "$out/mistake"
