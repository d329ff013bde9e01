#!/bin/sh
# debian.sh CPACK BUILD SCRATCH FIRST SLIDE: the Debian packages of BUILD, installed in a fresh Debian, without the sources and the build.
#   1. CPack warns if nobody is named as maintainer; lintian, where it is installed, finds no error
#   2. without a compiler: ents-lab solves the scan and draws its picture, the Python module computes the bits of C, Hertz is right
#   3. with compilers: C, C++ (find_package) and Fortran programs, built from libents-dev alone, print what FIRST and SLIDE of BUILD print
#   4. ents-ccx builds CalculiX with the adapter, and a job of it gives the forces of ents-lab
#   5. removed, the packages leave no file
# Prints the seconds of each. Exit status 3: not run, for this needs root, debootstrap and a network.
set -eu
cpack=$1 build=$2 scratch=$3 first=$4 slide=$5
say() { echo "== $*"; }
not_run() { echo "not run: $*"; exit 3; }
[ "$(id -u)" -eq 0 ] || not_run "debootstrap needs root"
command -v debootstrap >/dev/null || not_run "no debootstrap here (apt-get install debootstrap)"
release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
[ -n "$release" ] || not_run "no Debian here"

now() { date +%s%N; }
since() { awk "BEGIN { printf \"%.1f s\", ($(now) - $1) / 1e9 }"; }
rm -rf "$scratch"
mkdir -p "$scratch"
root=$scratch/root
log=$scratch/log
trap 'umount "$root/proc" 2>/dev/null || true; rm -rf "$root"' EXIT
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C DEBIAN_FRONTEND=noninteractive "$@"; }
must() { "$@" >"$log" 2>&1 || { tail -n 40 "$log" >&2; echo "debian.sh: failed: $*" >&2; exit 1; }; }

must "$cpack" -G DEB --config "$build/CPackConfig.cmake" -B "$scratch/packages"
case $(dpkg-deb -f "$(ls "$scratch"/packages/libents1_*.deb)" Maintainer) in *example.org*) nobody=1 ;; *) nobody=0 ;; esac
[ "$(grep -c 'no real maintainer' "$log" || true)" -eq $nobody ] || { echo "debian.sh: CPack's warning of a maintainer who is nobody" >&2; exit 1; }
if command -v lintian >/dev/null; then
  lintian --allow-root --tag-display-limit 0 "$scratch"/packages/*.deb >"$scratch/lintian" 2>&1 || true
  ! grep '^E: ' "$scratch/lintian" || { echo "debian.sh: lintian finds errors" >&2; exit 1; }
  say "lintian: no error, $(grep -c '^W: ' "$scratch/lintian" || true) warnings"
else
  say "lintian: not run, it is not installed"
fi

begin=$(now)
debootstrap --variant=minbase "$release" "$root" >"$log" 2>&1 || { tail -n 3 "$log"; not_run "debootstrap failed; is there a network?"; }
for file in /etc/apt/sources.list /etc/apt/sources.list.d /etc/apt/apt.conf.d /etc/resolv.conf; do
  if [ -e $file ]; then rm -rf "${root:?}$file" && cp -r $file "$root$file"; fi
done
rm -f "$root/etc/apt/apt.conf.d/docker-clean"
mount -t proc proc "$root/proc" || not_run "no /proc can be mounted in a chroot here"
must inside apt-get -qq update
say "a fresh Debian $release: $(since "$begin")"
mkdir "$root/packages"
cp "$scratch"/packages/*.deb "$root/packages"
install='apt-get -qq install -y --no-install-recommends'

begin=$(now)
must inside $install python3-matplotlib libopenblas0-serial $(cd "$root" && ls packages/libents1_*.deb packages/ents-*.deb | sed "s|^|/|")
say "the packages, with all that they need: $(since "$begin")"

! inside sh -c 'command -v cc c++ gfortran' >/dev/null || { echo "debian.sh: there is a compiler, which this is to do without" >&2; exit 1; }
begin=$(now)
must inside ents-lab run /usr/share/ents/examples/rough_afm/scene.json --out /tmp/out
[ -s "$root/tmp/out/pressure_map.png" ] || { echo "debian.sh: no picture" >&2; exit 1; }
say "one command to the first picture: $(since "$begin")"
must inside ents-deck --help
must inside ents-lab check /usr/share/ents/examples/rough_afm/model.json
must inside $install python3-scipy $(cd "$root" && ls packages/python3-ents_*.deb | sed "s|^|/|") # SciPy brings g++
must inside python3 -m ents doctor
grep -q '^check  *passed' "$log" || { cat "$log" >&2; exit 1; }
begin=$(now)
must inside python3 /usr/share/doc/python3-ents/examples/hertz.py
say "Hertz in Python: $(since "$begin")"
must inside ldd "/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)/ents/lib/libents_abaqus.so"
! grep 'not found' "$log" || exit 1

begin=$(now)
must inside $install gcc g++ gfortran pkg-config cmake make
say "compilers: $(since "$begin")"
must inside dpkg -i "/packages/$(basename "$scratch"/packages/libents-dev_*.deb)"
cat >"$root/tmp/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.16)
project(client CXX)
find_package(ents 0.1 REQUIRED CONFIG)
add_executable(first_cpp /usr/share/doc/libents-dev/examples/first.cpp)
target_link_libraries(first_cpp PRIVATE ents::ents)
CMAKE
cat >"$root/tmp/build.sh" <<'SH'
set -eu
cd /tmp
examples=/usr/share/doc/libents-dev/examples
for program in first slide; do
  cc -std=c99 $examples/$program.c $(pkg-config --cflags --libs ents) -lm -o ${program}_c
  gfortran $(pkg-config --variable=fortran_module ents) $examples/$program.f90 $(pkg-config --libs ents) -o ${program}_f90
done
cmake -S . -B build && cmake --build build && cp build/first_cpp .
for program in first_c first_cpp first_f90; do ./$program >$program.out; done
for program in slide_c slide_f90; do ./$program $examples/model.json >$program.out; done
SH
begin=$(now)
must inside sh /tmp/build.sh
say "programs in C, C++ and Fortran, built and run: $(since "$begin")"
"$first" >"$scratch/first"
"$slide" "$(dirname "$0")/../../examples/slide/model.json" >"$scratch/slide"
for language in c cpp f90; do diff -u "$scratch/first" "$root/tmp/first_$language.out"; done
for language in c f90; do diff -u "$scratch/slide" "$root/tmp/slide_$language.out"; done

# CalculiX: one command, and the block of adapters/calculix/example as a job of user elements.
begin=$(now)
status=0
inside sh -c 'cd /tmp && CCX_OPTIMIZE=-O0 ents-ccx' >"$log" 2>&1 || status=$?
if [ $status -eq 3 ]; then
  say "CalculiX: not run, its source package cannot be had here"
else
  [ $status -eq 0 ] || { tail -n 20 "$log" >&2; echo "debian.sh: ents-ccx fails" >&2; exit 1; }
  say "one command to ccx with ents: $(since "$begin")"
  begin=$(now)
  must inside python3 /usr/share/ents/calculix/example/make.py texture U1E /tmp/texture
  must inside sh -c 'cd /tmp/texture && OMP_NUM_THREADS=1 /tmp/ccx_ents/calculix/ccx_ents job && cp job.dat one_thread.dat && ents-lab run scene.json --out host'
  must inside python3 /usr/share/ents/calculix/example/compare.py /tmp/texture
  say "a job in CalculiX, the same forces as ents-lab: $(since "$begin")"
fi

for package in "$scratch"/packages/*.deb; do dpkg-deb -c "$package" | awk '{ print $6 }'; done | sort -u >"$scratch/files"
must inside dpkg --purge ents-tools ents-adapters python3-ents libents-dev libents1
left=$(while read -r file; do
  case $file in
    */) case $file in */ents/* | */*-ents/ | */*ents1/ | */ents-*/ | */libents-dev/) [ ! -d "$root/$file" ] || echo "$file" ;; esac ;;
    *) [ ! -e "$root/$file" ] && [ ! -L "$root/$file" ] || echo "$file" ;;
  esac
done <"$scratch/files")
[ -z "$left" ] || { echo "debian.sh: left after removal:" >&2; echo "$left" >&2; exit 1; }
say "removed: none of $(grep -vc '/$' "$scratch/files") files is left"
