#!/bin/sh
# One line: which tests were skipped, and why; and the programs that cannot be had without a licence or are left to their users.
#   sh tests/not_run.sh OUTPUT LOG     ctest's output (--output-log), Testing/Temporary/LastTest.log of the build
set -eu
export LC_ALL=C
output=$1 log=$2
emulated="Abaqus, Ansys, FEAP, LS-DYNA, Marc, MOOSE, OOFEM, OpenSees are emulated"

# Skipped tests, one a line, then the last line that each has printed: "REASON<tab>NAME".
awk '
  NR == FNR { if (/^The following tests did not run:/) list = 1
              else if (list && /\(Skipped\)/) skipped[$3] = 1
              else if (list && !/^[ \t]/) list = 0
              next }
  /^[0-9]+\/[0-9]+ Testing: / { name = $3; last = "no reason given" }
  /^Output:$/ { inside = 1; getline; next }
  /^<end of output>$/ { if (inside && name in skipped) { print last "\t" name; delete skipped[name] }; inside = 0 }
  inside && NF && !/^\[/ { last = $0 }
  END { for (name in skipped) print "the log does not say why\t" name }
' "$output" "$log" | sort -u | awk -F '\t' -v emulated="$emulated" '
  $1 != reason { if (NR > 1) line = line " (" reason "); "; reason = $1; line = line $2; next }
  { line = line ", " $2 }
  END { print "not run: " (NR ? line " (" reason "); " : "") emulated }
'
