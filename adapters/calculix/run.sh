#!/bin/sh
# Build ccx with ents from Debian's source package, solve the examples with it and with ents-lab, compare.
set -eu

usage() {
  cat <<'HELP'
usage: sh adapters/calculix/run.sh [--build DIR] [--only-build] [--quick]

  --build DIR   this project's build folder (default: build, with --quick: build-quick); ccx goes to DIR/calculix
  --only-build  leave the program DIR/calculix/ccx_ents, and DIR/bin/ents-deck, which makes jobs for it, and stop
  --quick       the same, built in less than half the time, for a first job: ccx is not optimized (a job takes 1.4 to 2.3 times as long),
                the library evaluates elements one by one; no tests, no ents-host

Fetches the source package calculix-ccx with apt-get (no system file is changed), installs the libraries that ccx needs (as root, or
through sudo when it asks for no password), compiles ccx 2.20 once (1 to 3 minutes) and links it with libents_calculix.so. CCX_OPTIMIZE in the environment: how the compilers
optimize it (default -O2; with -O0 it is built sooner and solves more slowly).

exit status: 0 done; 1 failed, or the answers differ; 2 wrong command line or a package is missing; 3 the source package cannot be had here
HELP
}

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build='' only_build='' quick=''
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --build) [ $# -ge 2 ] || { usage >&2; exit 2; }; build=$2; shift ;;
    --only-build) only_build=yes ;;
    --quick) only_build=yes quick=yes ;;
    *) echo "run.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
  esac
  shift
done
build=${build:-$root/build${quick:+-quick}}
mkdir -p "$build/calculix"
build=$(cd "$build" && pwd)
work=$build/calculix
log=$work/log
exec 3>&1
step() { echo "== $*" >&3; }
failed() { tail -n 30 "$log" >&2; echo "run.sh: $* (whole output: $log)" >&2; exit 1; }

# 1. Libraries and tools.
packages='g++ gfortran make python3-minimal libspooles-dev libarpack2-dev liblapack-dev dpkg-dev'
command -v apt-get >/dev/null 2>&1 || { echo "run.sh: no apt-get here, so no Debian source package of ccx"; exit 3; }
wanted=$(for package in $packages; do
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" = installed ] || printf '%s ' "$package"
done)
if [ -n "$wanted" ]; then
  as_root=
  if [ "$(id -u)" -ne 0 ]; then
    sudo -n true 2>/dev/null || { echo "run.sh: as root: apt-get install $wanted" >&2; exit 2; }
    as_root='sudo -n'
  fi
  step "installing: $wanted"
  # shellcheck disable=SC2086 # the list is words
  if ! { $as_root apt-get -qq update && $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends $wanted; } >"$log" 2>&1; then
    tail -n 5 "$log" >&2
    echo "run.sh: missing and cannot be installed: $wanted" >&2
    exit 2
  fi
fi

# 2. Sources: the machine's own package sources, as deb-src, with lists of their own.
sources() { find "$work" -name ccx_2.20.c -exec dirname {} \; | head -n 1; }
if [ -z "$(sources)" ]; then
  step "fetching the source package calculix-ccx"
  mkdir -p "$work/apt/lists/partial" "$work/apt/parts"
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ -f "$file" ] && sed -n 's/^deb /deb-src /p' "$file"
  done >"$work/apt/sources.list"
  for file in /etc/apt/sources.list.d/*.sources; do
    [ -f "$file" ] && sed 's/^Types:.*/Types: deb-src/' "$file" >"$work/apt/parts/$(basename "$file")"
  done
  from="-o Dir::Etc::SourceList=$work/apt/sources.list -o Dir::Etc::SourceParts=$work/apt/parts -o Dir::State::Lists=$work/apt/lists"
  # shellcheck disable=SC2086 # the options are words
  (cd "$work" && apt-get $from update && apt-get $from source calculix-ccx=2.20-1) >"$log" 2>&1 || {
    tail -n 5 "$log"
    echo "run.sh: the source package calculix-ccx 2.20-1 cannot be had here (no network?)"
    exit 3
  }
fi
ccx=$(sources)
[ -n "$ccx" ] || { echo "run.sh: the source package has no ccx_2.20.c" >&2; exit 1; }

# 3. ccx itself, once.
default=-O2
[ -z "$quick" ] || default=-O0
optimize=${CCX_OPTIMIZE:-$default}
fortran="$optimize -w -fallow-argument-mismatch"
if [ "$(cat "$work/optimize" 2>/dev/null)" != "$optimize" ]; then
  step "compiling ccx 2.20"
  rm -f "$ccx"/*.o "$ccx"/*.a
  # Its own link step may miss libraries; what counts are the objects.
  (cd "$ccx" && make -j"$(nproc)" "CFLAGS=$optimize"' -w -I/usr/include/spooles -DARCH="Linux" -DSPOOLES -DARPACK -DMATRIXSTORAGE -DUSE_MT=1' \
    "FFLAGS=$fortran") >"$log" 2>&1 || true
  [ -f "$ccx/ccx_2.20.a" ] && [ -f "$ccx/ccx_2.20.o" ] || failed "ccx did not compile"
  echo "$optimize" >"$work/optimize"
fi

# 4. The adapter, the changed routines, and the program.
targets='ents_calculix ents_abaqus ents-lab' needed='lib/libents_calculix.so lib/libents_abaqus.so bin/ents-lab'
if [ -n "$only_build" ]; then
  targets=ents_calculix needed=lib/libents_calculix.so
  if [ -f "$root/CMakeLists.txt" ]; then targets="$targets ents-deck" needed="$needed bin/ents-deck"; fi # a clone, no package
fi
for file in $needed; do
  [ -f "$build/$file" ] && continue
  step "building ents: $targets"
  [ -f "$build/CMakeCache.txt" ] || cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release \
    ${quick:+-C "$root/tests/configurations/quick.cmake"} >"$log" 2>&1 || failed "cmake failed; sh examples/setup.sh installs what is missing"
  # shellcheck disable=SC2086 # words
  cmake --build "$build" --target $targets --parallel "$(nproc)" >"$log" 2>&1 || failed "build this project first: sh examples/setup.sh"
  break
done
step "linking ccx with libents_calculix.so"
rm -rf "$work/patched"
python3 "$here/patch.py" "$ccx" "$work/patched"
cd "$work/patched"
c="$optimize -w -I/usr/include/spooles -I$ccx -DARCH=Linux -DSPOOLES -DARPACK -DMATRIXSTORAGE -DUSE_MT=1"
libraries='-lspooles -lpthread -larpack -llapack -lblas -lm'
# shellcheck disable=SC2086 # words
{
  for file in *.c; do gcc $c -c "$file"; done &&
    for file in *.f; do gfortran $fortran -I"$ccx" -c "$file"; done &&
    gfortran -O2 -fopenmp -o ../ccx_ents "$ccx/ccx_2.20.o" ./*.o "$ccx/ccx_2.20.a" \
      -L"$build/lib" -lents_calculix -lents -Wl,-rpath,"$build/lib" $libraries
} >"$log" 2>&1 || failed "ccx did not link"
if [ -n "$quick" ]; then step "built in $build for a first job; for large ones: sh adapters/calculix/run.sh --only-build, into build/"; fi
[ -z "$only_build" ] || exit 0

# 5. The same problems in ccx and in the reference host.
status=0
export CCX_UEL="$build/lib/libents_abaqus.so" # what U1A loads
by_one_and_two_threads() { # in the folder $1
  for threads in 1 2; do
    (cd "$1" && OMP_NUM_THREADS=$threads "$work/ccx_ents" job) >"$log" 2>&1 || failed "ccx stopped in $1"
    [ $threads -eq 1 ] && mv "$1/job.dat" "$1/one_thread.dat"
    cp "$log" "$1/ccx.log"
  done
}
for name in sphere texture friction turned; do for element in U1E U1A; do
  step "$name, $element"
  rm -rf "${work:?}/$name"
  python3 "$here/example/make.py" "$name" $element "$work/$name"
  by_one_and_two_threads "$work/$name"
  "$build/bin/ents-lab" run "$work/$name/scene.json" --out "$work/$name/host" >"$log" 2>&1 || failed "ents-lab failed"
  python3 "$here/example/compare.py" "$work/$name" || status=1
done; done

# 6. ccx's own contact on a flat master, same penalty.
step "U1E and ccx's own node-to-surface contact"
rm -rf "${work:?}/native"
python3 "$here/example/native.py" write "$work/native"
for folder in "$work"/native/*; do (cd "$folder" && OMP_NUM_THREADS=2 "$work/ccx_ents" job) >"$log" 2>&1 || failed "ccx stopped in $folder"; done
python3 "$here/example/native.py" compare "$work/native" || status=1

# 7. Temperatures: exact values, and ccx's own contact.
step "heat through U1E and through ccx's own contact"
rm -rf "${work:?}/heat"
python3 -B "$here/example/heat.py" write "$work/heat"
for folder in "$work"/heat/*; do (cd "$folder" && OMP_NUM_THREADS=2 "$work/ccx_ents" job) >"$log" 2>&1 || failed "ccx stopped in $folder"; done
python3 -B "$here/example/heat.py" compare "$work/heat" || status=1

step "friction that heats, in a coupled step: forces and displacements as without temperatures"
rm -rf "${work:?}/rubbed"
python3 "$here/example/make.py" friction U1E "$work/rubbed"
sed -i -e 's/^\*STATIC/*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE/' -e '0,/^\*ELASTIC/s//*CONDUCTIVITY\n10.\n*ELASTIC/' \
  -e 's/^\*STEP/*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 0.\nMASTER, 50.\n&/' \
  -e 's/^\*BOUNDARY$/&\nBOTTOM, 11, 11, 0.\nMASTER, 11, 11, 50./' "$work/rubbed/job.inp"
sed -i 's/"friction": {/"heat": {"table": {"pressures": [0, 100], "conductances": [10, 200]}, "friction": {}},\n  &/' "$work/rubbed/ents_1.json"
cp -r "$work/friction/host" "$work/rubbed"
by_one_and_two_threads "$work/rubbed"
python3 "$here/example/compare.py" "$work/rubbed" || status=1

# 8. A deck without U1E and U1A: ccx as it was, iterations included.
step "ccx's own contact with friction, and with heat, in ccx without the changes, too"
# shellcheck disable=SC2086 # words
gfortran -O2 -fopenmp -o "$work/ccx_plain" "$ccx/ccx_2.20.o" "$ccx/ccx_2.20.a" $libraries >"$log" 2>&1 || failed "ccx did not link"
for folder in native/friction heat/native; do
  cd "$work/$folder"
  for program in ccx_plain ccx_ents; do
    OMP_NUM_THREADS=1 "$work/$program" job >"$log" 2>&1 || failed "$program stopped"
    mv job.dat $program.dat
    mv job.sta $program.sta
  done
  cmp ccx_plain.dat ccx_ents.dat && cmp ccx_plain.sta ccx_ents.sta || { echo "run.sh: $PWD: ccx is another one for decks without U1E" >&2; status=1; }
done

# 9. Mistakes reach the user as ccx's own errors do.
step "mistakes"
# shellcheck disable=SC2086 # words
if gcc $c -DLONGLONG -fsyntax-only "$work/patched/nonlingeo.c" >"$log" 2>&1 || ! grep 'error: .*LONGLONG' "$log"; then
  echo "run.sh: integers of 8 bytes were not refused" >&2
  status=1
fi
cd "$work/sphere"
refused() { # by the element $1, with the words $2
  code=0
  OMP_NUM_THREADS=2 "$work/ccx_ents" job >"$log" 2>&1 || code=$?
  grep "ERROR in $1.*$2" "$log" && [ $code -eq 201 ] || { echo "run.sh: no message, or exit status $code instead of 201" >&2; status=1; }
}
for element in U1E U1A; do for procedure in BUCKLE FREQUENCY; do
  python3 "$here/example/make.py" sphere $element .
  sed -i -e '/^\*STATIC/{n;d}' -e '/^\*CONTROLS/{N;d}' -e 's/, NLGEOM//' -e 's/^\*ELASTIC/*DENSITY\n1.\n*ELASTIC/' job.inp
  sed -i "s/^\*STATIC/*$procedure\\n2/" job.inp
  refused $element 'this step is linear'
done; done
python3 "$here/example/make.py" sphere U1E .
rm ents_1.json
refused U1E ents_1.json
cd "$work/heat/conducts"
with() { sed "s/^\*HEAT TRANSFER.*/$1/" given.inp >job.inp; } # another procedure
mv job.inp given.inp
with '*STATIC, DIRECT'
refused U1E 'has "heat".*write \*HEAT TRANSFER or \*COUPLED'
with '*UNCOUPLED TEMPERATURE-DISPLACEMENT'
refused U1E 'write \*COUPLED'
mv given.inp job.inp
cd "$work/sphere"

# 10. A master that is pulled away below the block: a slave that leaves its segment in contact ends the job.
step "a slave that leaves its segment"
python3 "$here/example/make.py" texture U1E .
sed -i -e 's/^MASTER, 1, 1, .*/MASTER, 1, 1, 2.4/' -e 's/^0.2, 1., 1e-5, 0.2/0.02, 1., 1e-3, 0.02/' job.inp
code=0
OMP_NUM_THREADS=2 "$work/ccx_ents" job >"$log" 2>&1 || code=$?
if ! grep -m 1 'has left its segments' "$log" || [ $code -eq 0 ]; then
  echo "run.sh: the contact was lost without a word, exit status $code" >&2
  status=1
fi

# 11. Elements of two dimensions in the same deck (CalculiX issue 170: a crash): the block's forces stay what they are.
step "a shell in the same deck"
python3 "$here/example/make.py" sphere U1E .
OMP_NUM_THREADS=2 "$work/ccx_ents" job >"$log" 2>&1 || failed "ccx stopped"
mv job.dat without.dat
sed -i 's/^\*STEP/*NODE, NSET=PLATE\n9001, 9., 0., 0.\n9002, 10., 0., 0.\n9003, 10., 1., 0.\n9004, 9., 1., 0.\n*ELEMENT, TYPE=S4, ELSET=PLATE\n9001, 9001, 9002, 9003, 9004\n*SHELL SECTION, ELSET=PLATE, MATERIAL=RUBBER\n0.1\n*BOUNDARY\nPLATE, 1, 6\n&/' job.inp
code=0
OMP_NUM_THREADS=2 "$work/ccx_ents" job >"$log" 2>&1 || code=$?
forces() { awk '/total force/ { getline; getline; print $3 }' "$1"; } # along the load: the others are zero but for rounding
if [ $code -ne 0 ] || [ "$(forces job.dat)" != "$(forces without.dat)" ]; then
  echo "run.sh: a shell beside the contact elements changes their forces, or ccx stops (exit status $code)" >&2
  status=1
fi
exit $status
