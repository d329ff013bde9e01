#!/bin/sh
# Set up, build, run every test.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)

usage() {
  cat <<'HELP'
usage: sh tests/run.sh [--hosts] [-DNAME=VALUE ...]

Installs what is missing, builds in build/ (see sh examples/setup.sh --help for both, and for the options) and runs every test.
With --hosts it installs the finite element programs that Debian has, too, if they can be had (about 450 MB): GetFEM, dolfinx, FreeFEM, PETSc;
and a compiler for Windows.
Their tests are skipped where they are not installed. Afterwards some of them, by name:
  ctest --test-dir build -R clients --output-on-failure

The last line names the tests that were skipped, with the reason, and the programs that are emulated.

exit status: 0 all tests passed; 1 a test or the build failed; 2 a package is missing, or the command line is wrong
HELP
}

hosts=''
if [ "${1-}" = --hosts ]; then
  hosts='--try g++-mingw-w64-x86-64-posix --try python3-getfem++ --try python3-dolfinx-real --try freefem++ --try libfreefem++-dev --try libpetsc-real-dev'
  shift
fi
for option; do
  case $option in
    -h | --help) usage; exit 0 ;;
    -D?*) ;;
    --hosts) echo "run.sh: --hosts stands before -D..." >&2; exit 2 ;;
    *) echo "run.sh: unknown option '$option'" >&2; usage >&2; exit 2 ;;
  esac
done

# The portable kernels, too, whose bits are compared; a build for all processors has them.
sets=-DENTS_INSTRUCTION_SETS="portable;native"
grep -qs '^ENTS_INSTRUCTION_SETS:STRING=all$' "$root/build/CMakeCache.txt" && sets=''
# A browser opens the page of charts; the wheel is installed into a venv; ents-deck reads ccx's own tests.
# shellcheck disable=SC2086 # words
sh "$root/examples/setup.sh" $hosts --with chromium --with python3-venv --with calculix-ccx-test ${sets:+"$sets"} "$@"
echo "== testing"
temporary=$root/build/Testing/Temporary
status=0
ctest --test-dir "$root/build" --parallel "$(nproc)" --output-on-failure --no-tests=error --output-log "$temporary/output.log" || status=1
sh "$root/tests/not_run.sh" "$temporary/output.log" "$temporary/LastTest.log"
exit $status
