#!/bin/sh
# abidiff.sh COMMIT: functions and structs of ents.h at COMMIT against those of the working tree, by abidiff (Debian: abigail-tools). Allowed
# are new functions and new members at the end of a struct. Only the C interface (abi/) is compiled, with debugging information; what it
# calls of core/ stays undefined in the two shared libraries. Takes a minute or two.
# Exit status: 0 nothing but additions; 2 wrong command line or a program is missing; else something was changed or removed.
set -eu
[ $# -eq 1 ] || { echo "usage: sh tests/package/abidiff.sh COMMIT" >&2; exit 2; }
root=$(cd "$(dirname "$0")/../.." && pwd)
command -v abidiff >/dev/null || { echo "abidiff.sh: apt-get install abigail-tools" >&2; exit 2; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/old"
git -C "$root" archive "$1" abi core | tar -x -C "$scratch/old"
library() { # SOURCES OUT
  find "$1/abi" -name '*.cpp' | while read -r source; do
    ${CXX:-g++} -std=c++20 -g -O0 -w -fPIC -fvisibility=hidden -fvisibility-inlines-hidden -DENTS_BUILD '-DENTS_LIBRARY_VERSION="0"' \
      -I "$1" -I "$1/abi" -c "$source" -o "$2.$(basename "$source").o"
  done
  ${CXX:-g++} -shared -o "$2" "$2".*.o -Wl,--unresolved-symbols=ignore-all -Wl,--version-script="$(find "$1/abi" -name exports.map)"
}
library "$scratch/old" "$scratch/old.so"
library "$root" "$scratch/new.so"
printf '[suppress_type]\n  type_kind = struct\n  has_data_member_inserted_at = end\n' >"$scratch/ends"
compare() { abidiff "$@" --suppressions "$scratch/ends" --drop-private-types --hf1 ents.h --hf2 ents.h "$scratch/old.so" "$scratch/new.so"; }
compare --no-added-syms >"$scratch/changes" || { status=$?; cat "$scratch/changes"; exit $status; }
compare || true
echo "additions only"
