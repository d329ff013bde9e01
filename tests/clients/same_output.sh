#!/bin/sh
# same_output.sh PROGRAM PROGRAM ...: all programs succeed and print the same text, at least one line.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

first=$1
"$first" >"$scratch/first"
lines=$(wc -l <"$scratch/first")
[ "$lines" -gt 0 ] || { echo "$first prints nothing" >&2; exit 1; }
shift
for program; do
  "$program" >"$scratch/other"
  diff -u --label "$first" --label "$program" "$scratch/first" "$scratch/other" || exit 1
done
echo "$lines lines agree"
