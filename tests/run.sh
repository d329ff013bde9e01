#!/bin/sh
# Set up, build, run every test.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)

usage() {
  cat <<'HELP'
usage: sh tests/run.sh [-DNAME=VALUE ...]

Installs what is missing, builds in build/ (see sh examples/setup.sh --help for both, and for the options) and runs every test.
Afterwards some of them, by name:
  ctest --test-dir build -R clients --output-on-failure

The last line names the tests that were skipped, with the reason, and the programs that are emulated.

exit status: 0 all tests passed; 1 a test or the build failed; 2 a package is missing, or the command line is wrong
HELP
}

for option; do
  case $option in
    -h | --help) usage; exit 0 ;;
    -D?*) ;;
    *) echo "run.sh: unknown option '$option'" >&2; usage >&2; exit 2 ;;
  esac
done

# A browser opens the page of charts; ents.Contact makes SciPy's matrices; the wheel is installed into a venv; ents-deck reads ccx's own tests.
sh "$root/examples/setup.sh" --with chromium --with python3-scipy --with python3-venv --with calculix-ccx-test "$@"
echo "== testing"
temporary=$root/build/Testing/Temporary
status=0
ctest --test-dir "$root/build" --parallel "$(nproc)" --output-on-failure --no-tests=error --output-log "$temporary/output.log" || status=1
sh "$root/tests/not_run.sh" "$temporary/output.log" "$temporary/LastTest.log"
exit $status
