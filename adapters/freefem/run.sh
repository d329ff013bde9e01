#!/bin/sh
# Build FreeFEM's plugin, solve the block problem with it and with ents-lab, compare; two bars with heat, mistakes.
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

# 3. Heat: the script compares with the closed form, and fails beyond 1e-10.
echo "== two bars, heat"
FreeFem++-nw -nw -v 0 "$here/two_bars.edp" >two_bars.log 2>&1 || failed two_bars.log "the flow is another one"
grep '^flow' two_bars.log

# 4. A mistake reaches the user as FreeFEM's own errors do.
echo "== mistakes"
small() { # components, more arguments of entsForces: a square whose upper side is the slave of its lower one, with heat of friction
  cat >small.edp <<EDP
load "ents"
mesh Th = square(2, 2);
fespace Vh(Th, $1);
string heat = "\"friction\": {\"type\": \"coulomb\", \"coefficient\": 0.3, \"stiffness\": 50}, \"heat\": {\"friction\": {}}";
EntsContact contact(Th, 3, 1, "{\"segment\": \"line2\", \"contact\": {\"normal\": {\"type\": \"penalty\", \"stiffness\": 100}, " + heat + "}}");
int[int] I(1), J(1);
real[int] C(1), r(Vh.ndof), x(Vh.ndof);
x = 0;
r = 0;
entsForces(contact, x, r, I, J, C$2);
EDP
  FreeFem++-nw -nw -v 0 small.edp >mistake.log 2>&1
}
refused() { # words of the message, command
  words=$1
  shift
  code=0
  "$@" >mistake.log 2>&1 || code=$?
  grep "ents: .*$words" mistake.log && [ $code -ne 0 ] || failed mistake.log "no message, or exit status 0"
}
refused 'nowhere.json' solve -model nowhere.json
refused 'write u\[\] of a space \[P1, P1, P1\]' small '[P1, P1]' ', dt=0.1'
refused 'write entsForces(..., dt=...)' small '[P1, P1, P1]' ''
small '[P1, P1, P1]' ', dt=0.1' || failed mistake.log "refused without a mistake"
