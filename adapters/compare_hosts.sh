#!/bin/sh
# One problem through every real host that is installed here, and through the reference host: a table.
set -eu

usage() {
  cat <<'HELP'
usage: sh adapters/compare_hosts.sh [--build DIR]

  --build DIR   this project's build folder (default: build); what the hosts write goes to DIR/compare_hosts

Solves two variants of adapters/block.json, two blocks of triangles, St. Venant-Kirchhoff, finite strain: "bumps", a height on each facet of the master;
"bumps_friction", the same with friction and a slave that slides over several facets. Hosts:
ents-lab; GetFEM (python3-getfem++), dolfinx with one and two processes (python3-dolfinx-real), FreeFEM (freefem++ libfreefem++-dev), CalculiX
(its source package, see adapters/calculix/run.sh). A host that is not installed is left out, and the table says so.

exit status: 0 all of them agree; 1 a host failed, or has other forces; 2 wrong command line; 3 only ents-lab is here
HELP
}

here=$(cd "$(dirname "$0")" && pwd)
build=$here/../build
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --build) [ $# -ge 2 ] || { usage >&2; exit 2; }; build=$2; shift ;;
    *) echo "compare_hosts.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
  esac
  shift
done
[ -f "$build/lib/libents.so" ] && [ -x "$build/bin/ents-lab" ] || { echo "compare_hosts.sh: build this project first: sh examples/setup.sh" >&2; exit 1; }
build=$(cd "$build" && pwd)
export ENTS_LIBRARY="$build/lib/libents.so"
python=/usr/bin/python3 # the one that sees Debian's packages
[ -x $python ] || python=python3
found=0 status=0

version() { dpkg-query -W -f='${Version}' "$1" 2>/dev/null | sed 's/^[0-9]*://; s/[-+].*//'; }
failed() { tail -n 20 "$1" >&2; echo "compare_hosts.sh: $2 (whole output: $1)" >&2; exit 1; }
row() { # name, output, bound
  found=$((found + 1))
  $python -B "$here/python/block.py" row "$1" "$2" "$out/ents-lab/result.json" ${3-} || status=1
}
absent() { echo "| $1 | not installed | | |"; }

# What has to be built: FreeFEM's plugin, and ccx.
out=$build/compare_hosts
mkdir -p "$out"
freefem=0 ccx=0
sh "$here/freefem/run.sh" --build "$build" --only-build >"$out/freefem.txt" 2>&1 || freefem=$?
[ $freefem -eq 0 ] || [ $freefem -eq 3 ] || failed "$out/freefem.txt" "FreeFEM's plugin was not built"
sh "$here/calculix/run.sh" --build "$build" --only-build >"$out/ccx.txt" 2>&1 || ccx=$?
[ $ccx -eq 0 ] || [ $ccx -eq 3 ] || failed "$out/ccx.txt" "ccx was not built"

for variant in bumps bumps_friction; do
  out=$build/compare_hosts/$variant
  mkdir -p "$out"
  scene="$here/block.json --variant $variant"
  motion='-steps 5'
  [ $variant = bumps ] || motion='-shift 0.5 -steps 8'
  echo "$variant"
  echo
  # shellcheck disable=SC2086 # the scene is words
  "$build/bin/ents-lab" run $scene --out "$out/ents-lab" >"$out/ents-lab.txt" 2>&1 || failed "$out/ents-lab.txt" "ents-lab failed"
  echo "| host | force on the support, last step | largest difference from ents-lab | iterations |"
  echo "|---|---|---:|---|"
  $python - "$out/ents-lab/result.json" <<'PYTHON'
import json, sys
steps = json.load(open(sys.argv[1]))["steps"]
print(f"| ents-lab | {' '.join(f'{-x:.15g}' for x in steps[-1]['contact_force'])} | | {' '.join(str(s['iterations']) for s in steps)} |", flush=True)
PYTHON

  if $python -c 'import getfem, numpy, scipy' 2>/dev/null; then
    # shellcheck disable=SC2086
    $python -B "$here/python/getfem_block.py" $scene >"$out/getfem.txt" 2>&1 || failed "$out/getfem.txt" "GetFEM failed"
    row "GetFEM $(version python3-getfem)" "$out/getfem.txt"
  else
    absent GetFEM
  fi

  if $python -c 'import dolfinx, scipy' 2>/dev/null; then
    name="dolfinx $(version python3-dolfinx-real), PETSc $(version python3-petsc4py-real)"
    # shellcheck disable=SC2086
    $python -B "$here/python/dolfinx_block.py" $scene >"$out/dolfinx.txt" 2>&1 || failed "$out/dolfinx.txt" "dolfinx failed"
    row "$name" "$out/dolfinx.txt"
    if command -v mpirun >/dev/null 2>&1; then
      # A process that fails alone leaves the others waiting.
      # shellcheck disable=SC2086
      timeout 300 mpirun --allow-run-as-root --oversubscribe -n 2 $python -B -m mpi4py "$here/python/dolfinx_block.py" $scene >"$out/dolfinx_2.txt" 2>&1 ||
        failed "$out/dolfinx_2.txt" "dolfinx with two processes failed"
      row "the same, two processes" "$out/dolfinx_2.txt"
    fi
  else
    absent dolfinx
  fi

  if [ $freefem -eq 0 ]; then
    $python -B "$here/python/block.py" model "$here/block.json" "$variant" >"$out/model.json"
    # shellcheck disable=SC2086 # words
    (cd "$build/freefem" && FreeFem++-nw -nw -v 0 "$here/freefem/block.edp" -model "$out/model.json" -coordinate -1 $motion) >"$out/freefem.txt" 2>&1 ||
      failed "$out/freefem.txt" "FreeFEM failed"
    row "FreeFEM $(version freefem++)" "$out/freefem.txt"
  else
    absent FreeFEM
  fi

  # ccx prints seven digits: half a unit of the seventh of a number that begins with 1 is 5e-7 of it.
  if [ $ccx -eq 0 ]; then
    rm -rf "$out/ccx"
    $python -B "$here/calculix/example/layer.py" write "$here/block.json" "$variant" "$out/ccx"
    (cd "$out/ccx" && "$build/calculix/ccx_ents" job) >"$out/ccx.log" 2>&1 || failed "$out/ccx.log" "ccx failed"
    $python -B "$here/calculix/example/layer.py" print "$out/ccx" >"$out/ccx.txt"
    row "CalculiX 2.20, a layer of C3D6" "$out/ccx.txt" 5e-7
  else
    absent CalculiX
  fi
  echo
done
[ $found -gt 0 ] || exit 3
exit $status
