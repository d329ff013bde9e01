#!/bin/sh
# Install what is missing and build in build/. quickstart.sh, gallery.sh and tests/run.sh begin with this.
set -eu

usage() {
  cat <<'HELP'
usage: sh examples/setup.sh [--configuration NAME] [--target NAME ...] [--with PACKAGE] [--try PACKAGE] [-DNAME=VALUE ...]

Installs what is missing from Debian's packages (as root, or through sudo when it asks for no password), configures and builds the
library, the reference host, the benchmark and the tests in build/; with --target, only that and what it needs; with --with, that
package, too; with --try, that package, too, if it can be had. A configuration is an initial cache of CMake, and has a folder of its own;
tests/configurations/README.md says what each costs:
  --configuration native                 build/: what is built without this option
  --configuration quick                  build-quick/: sooner, for a first picture or a first job; slower elements, no tests
  --configuration dev                    build-dev/: to change the sources
  --configuration release                build-release/: for every processor of this family, without tests; what packages are made of
  --configuration asan                   build-asan/: under the address and undefined-behaviour sanitizers
-D... goes to CMake:
  -DENTS_WERROR=ON                       warnings are errors
  -DCMAKE_BUILD_TYPE=Debug               instead of Release
  -DENTS_INSTRUCTION_SETS=all            kernels for every processor of this family, as in packages; default: for this processor, in
                                         about half the time
  -DENTS_GROUPED=OFF                     every source file of library, ents-lab and tests on its own: sooner built after a change of
                                         one, in twice the time from nothing
They stay in force until changed or until the folder is removed. Packages that are used where they are installed:
  --with libtrilinos-sacado-dev          Sacado, which ents-bench --differentiation compares with

exit status: 0 built; 1 the build failed; 2 a package is missing and cannot be installed, or the command line is wrong
HELP
}

targets='' with='' try='' configuration=native
while [ $# -ge 2 ]; do
  case $1,$2 in
    *,-*) break ;;
    --configuration,*) configuration=$2 ;;
    --target,*) targets="$targets $2" ;;
    --with,*) with="$with $2" ;;
    --try,*) try="$try $2" ;;
    *) break ;;
  esac
  shift 2
done
for option; do
  case $option in
    -h | --help) usage; exit 0 ;;
    -D?*) ;;
    --target | --configuration) echo "setup.sh: $option needs a NAME and stands before -D..." >&2; exit 2 ;;
    --with | --try) echo "setup.sh: $option needs a PACKAGE and stands before -D..." >&2; exit 2 ;;
    *) echo "setup.sh: unknown option '$option'" >&2; usage >&2; exit 2 ;;
  esac
done

cd "$(dirname "$0")/.."
cache=tests/configurations/$configuration.cmake
if [ ! -f "$cache" ]; then
  echo "setup.sh: there is no configuration '$configuration'; write one of:" \
    "$(cd tests/configurations && echo *.cmake | sed 's/\.cmake//g')" >&2
  exit 2
fi
build=build
[ "$configuration" = native ] || build=build-$configuration
log=$(mktemp)
trap 'rm -f "$log"' EXIT

# Compilers and build tools; libraries; pictures, and what the programs in Python import (tests/clients/commands.py compares).
packages='g++ gfortran cmake ninja-build pkg-config
  libeigen3-dev nlohmann-json3-dev tao-pegtl-dev libcli11-dev libgtest-dev libbenchmark-dev libsuitesparse-dev libmumps-seq-dev libopenblas0-serial
  python3-numpy python3-scipy python3-matplotlib'$with

missing() { # PACKAGES
  for package in $1; do
    state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$state" = installed ] || printf '%s ' "$package"
  done
}

if command -v dpkg-query >/dev/null 2>&1; then
  if [ "$(id -u)" -eq 0 ]; then
    as_root='env DEBIAN_FRONTEND=noninteractive'
  elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then
    as_root='sudo -n env DEBIAN_FRONTEND=noninteractive'
  else
    as_root=''
  fi
  install() { # PACKAGES
    # shellcheck disable=SC2086 # the lists are words
    { $as_root apt-get -qq update && $as_root apt-get -qq install -y --no-install-recommends $1; } >"$log" 2>&1
  }
  wanted=$(missing "$packages")
  if [ -n "$wanted" ]; then
    if [ -z "$as_root" ]; then
      echo "setup.sh: these packages are missing and this user may not install them. As root:" >&2
      echo "  apt-get install $wanted" >&2
      exit 2
    fi
    echo "== installing (this can take minutes): $wanted"
    if ! install "$wanted"; then
      cat "$log" >&2
      echo "setup.sh: apt-get failed (above); is there a network? Still missing: $(missing "$packages")" >&2
      exit 2
    fi
  fi
  for package in $(missing "$try"); do
    echo "== installing, if it can be had: $package"
    [ -n "$as_root" ] && install "$package" || echo "== not installed: $package"
  done
else
  echo "== no dpkg here: assuming that the equivalents of these Debian packages are installed:" $packages
fi

if [ -f $build/CMakeCache.txt ]; then echo "== building in $build/"; else echo "== building in $build/ (the first time takes some minutes)"; fi
[ -f $build/CMakeCache.txt ] || set -- -G Ninja -C "$cache" "$@"
cmake -S . -B $build "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
# shellcheck disable=SC2086 # words
cmake --build $build --target ${targets:-all} --parallel "$(nproc)" || exit 1
