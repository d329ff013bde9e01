#!/bin/sh
# slide.sh MODEL PROGRAM ...: examples/slide, the folder of MODEL, prints the same forces in every language, whatever the number of
# segments: the history of friction goes with a slave node from segment to segment. No model, or one that does not exist: an exit status
# that is not 0. Its README says how many lines the programs have.
set -eu
model=$1
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$1" "$model" 1 >"$scratch/one"
[ "$(wc -l <"$scratch/one")" -eq 60 ] || { echo "$1 prints no 60 steps" >&2; exit 1; }
for program; do
  for segments in 1 7 50 333; do
    "$program" "$model" $segments >"$scratch/many"
    diff -u --label "1 segment" --label "$program, $segments segments" "$scratch/one" "$scratch/many" || exit 1
  done
  ! "$program" >/dev/null 2>&1 || { echo "$program without a model does not fail" >&2; exit 1; }
  ! "$program" "$scratch/none" >/dev/null 2>&1 || { echo "$program with a model that does not exist does not fail" >&2; exit 1; }
done
lines() { grep -vcE '^ *(!|/\*|\*|$)' "$(dirname "$model")/$1"; }
said="$(lines slide.c) in C, $(lines slide.f90) in Fortran"
grep -q "^comments: $said\.$" "$(dirname "$model")/README.md" || { echo "slide: lines without comments: $said; the README says another" >&2; exit 1; }
echo "$# programs print the same forces on 1, 7, 50 and 333 segments"
