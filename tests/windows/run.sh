#!/bin/sh
# The library as a Windows DLL: build it and its tests with MinGW, run them with wine.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$root/build-windows

usage() {
  cat <<'HELP'
usage: sh tests/windows/run.sh [-DNAME=VALUE ...]

Builds libents.dll, the tests of core, of the model's reader, of mechanics and laws, and the clients for Windows (x86-64) in
build-windows/ and runs them with wine; the clients' output is compared with that of the same programs in build/.
Needs (Debian): g++-mingw-w64-x86-64-posix gfortran-mingw-w64-x86-64-posix googletest wine64 wine, and what examples/setup.sh installs.
Afterwards some of them, by name:
  WINEPREFIX=$PWD/build-windows/wine ctest --test-dir build-windows -R OrdinaryElements --output-on-failure

exit status: 0 all tests passed; 1 a test or the build failed; 2 a program is missing, or the command line is wrong
HELP
}

for option; do
  case $option in
    -h | --help) usage; exit 0 ;;
    -D?*) ;;
    *) echo "run.sh: unknown option '$option'" >&2; usage >&2; exit 2 ;;
  esac
done
for program in x86_64-w64-mingw32-g++-posix x86_64-w64-mingw32-gfortran-posix wine cmake ninja; do
  command -v $program >/dev/null || { echo "run.sh: $program is missing (see --help)" >&2; exit 2; }
done
for file in /usr/src/googletest/CMakeLists.txt /usr/include/nlohmann/json.hpp /usr/share/cmake/nlohmann_json /usr/include/tao/pegtl.hpp; do
  [ -e $file ] || { echo "run.sh: $file is missing (see --help)" >&2; exit 2; }
done

toolchain=-DCMAKE_TOOLCHAIN_FILE=$root/tests/windows/mingw.cmake
export WINEDEBUG=-all WINEPREFIX="$build/wine"
prefix=$build/prefix
if [ ! -e "$prefix/lib/libgtest.a" ]; then
  echo "== GoogleTest for Windows"
  cmake -S /usr/src/googletest -B "$build/googletest" -G Ninja "$toolchain" -DCMAKE_BUILD_TYPE=Release -DBUILD_GMOCK=OFF \
    -DCMAKE_INSTALL_PREFIX="$prefix" >/dev/null
  cmake --build "$build/googletest" --target install >/dev/null
fi
# Headers beside those of this machine's C library cannot be used.
mkdir -p "$prefix/include" "$prefix/share/cmake"
cp -r /usr/include/nlohmann /usr/include/tao "$prefix/include"
cp -r /usr/share/cmake/nlohmann_json "$prefix/share/cmake"

echo "== building"
cmake -S "$root" -B "$build" -G Ninja "$toolchain" -DCMAKE_PREFIX_PATH="$prefix" -DENTS_BUILD_HOST=OFF -DENTS_BUILD_BENCH=OFF \
  -DENTS_BUILD_ADAPTERS=OFF "$@" >/dev/null
cmake --build "$build" --parallel "$(nproc)"

echo "== testing"
wine wineboot >/dev/null 2>&1 || true
# One server for all: a program that starts while the last one's server ends finds none.
server=$(command -v wineserver || echo /usr/lib/wine/wineserver)
"$server" -p 2>/dev/null && trap '"$server" -k 2>/dev/null' EXIT
ctest --test-dir "$build" --parallel "$(nproc)" --output-on-failure --no-tests=error || exit 1

for program in first_c first_cpp first_f90 client_c client_cpp client_f90; do
  [ -x "$root/build/bin/$program" ] || { echo "== build/bin/$program is not built: nothing to compare with"; continue; }
  "$root/build/bin/$program" >"$build/$program.here"
  wine "$build/bin/$program.exe" | tr -d '\r' >"$build/$program.windows"
  cmp "$build/$program.here" "$build/$program.windows"
  echo "== $program: the bits are those of Linux"
done
