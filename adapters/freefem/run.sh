#!/bin/sh
# Build FreeFEM's plugin, solve the block problem with it and with ents-lab, compare.
set -eu

usage() {
  cat <<'HELP'
usage: sh adapters/freefem/run.sh [--build DIR] [--only-build]

  --build DIR   this project's build folder (default: build); the plugin goes to DIR/freefem
  --only-build  leave the plugin DIR/freefem/ents.so and stop

exit status: 0 done; 1 failed, or the answers differ; 2 wrong command line; 3 no FreeFEM here (Debian: freefem++ libfreefem++-dev, 70 MB)
HELP
}

here=$(cd "$(dirname "$0")" && pwd)
build=$here/../../build only_build=
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --build) [ $# -ge 2 ] || { usage >&2; exit 2; }; build=$2; shift ;;
    --only-build) only_build=yes ;;
    *) echo "run.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
  esac
  shift
done
for program in ff-c++ FreeFem++-nw; do
  command -v $program >/dev/null 2>&1 || { echo "run.sh: no $program here: apt-get install freefem++ libfreefem++-dev"; exit 3; }
done
[ -f "$build/lib/libents.so" ] && [ -x "$build/bin/ents-lab" ] || { echo "run.sh: build this project first: sh examples/setup.sh" >&2; exit 1; }
build=$(cd "$build" && pwd)
mkdir -p "$build/freefem"
cd "$build/freefem"
failed() { tail -n 30 "$1" >&2; echo "run.sh: $2 (whole output: $build/freefem/$1)" >&2; exit 1; }

if [ ! -f ents.so ] || [ -n "$(find "$here" "$here/../../abi/ents.h" "$here/../../abi/ents.hpp" -name '*.[hc]*' -newer ents.so)" ]; then
  echo "== building the plugin"
  ff-c++ "$here/ents_freefem.cpp" "$here/border_contact.cpp" "-I$here" "-I$here/../../abi" "-L$build/lib" -lents "-Wl,-rpath,$build/lib" \
    -o ents >build.log 2>&1 || failed build.log "the plugin did not compile"
fi
[ -z "$only_build" ] || exit 0

# 1. The same forces as ents-lab's, with and without friction.
solve() { FreeFem++-nw -nw -v 0 "$here/block.edp" "$@"; }
for variant in textured flat friction bumps_friction; do
  echo "== $variant"
  name=$variant option="--variant $variant" more=''
  case $variant in
    textured) name='' option='' ;;
    friction) more='-shift 0.2' ;;
    bumps_friction) more='-coordinate -1 -shift 0.5 -steps 8' ;; # slave nodes take their history to other facets
  esac
  # shellcheck disable=SC2086 # none or one word
  python3 "$here/../python/block.py" model "$here/../block.json" $name >$variant.json
  # shellcheck disable=SC2086 # none or two words
  "$build/bin/ents-lab" run "$here/../block.json" $option --out host_$variant >host.log 2>&1 || failed host.log "ents-lab failed"
  # shellcheck disable=SC2086 # words
  solve -model $variant.json $more >$variant.log 2>&1 || failed $variant.log "FreeFEM failed"
  grep '^step' $variant.log
  python3 "$here/../python/block.py" compare $variant.log host_$variant/result.json
done

# 2. Four times finer (n = 32), slave nodes often change their segments: a smoothed surface converges all the same. Plain facets are shown, not judged.
python3 "$here/../python/block.py" model "$here/../block.json" flat_facets >flat_facets.json
for variant in textured flat flat_facets; do
  echo "== n = 32, $variant"
  code=0
  solve -model $variant.json -refine 4 >fine_$variant.log 2>&1 || code=$?
  grep '^step' fine_$variant.log
  [ $code -eq 0 ] || [ $variant = flat_facets ] || failed fine_$variant.log "no convergence"
done

# 3. A mistake reaches the user as FreeFEM's own errors do.
echo "== a mistake"
code=0
solve -model nowhere.json >mistake.log 2>&1 || code=$?
grep 'ents: .*nowhere.json' mistake.log && [ $code -ne 0 ] || failed mistake.log "no message, or exit status 0"
