#!/bin/sh
# shown.sh README FILE ...: every file is in README, whole and unchanged, as a fenced block of code.
set -eu
readme=$1
shift
for file; do
  awk '
    FNR == NR { wanted[++lines] = $0; next }
    /^```/ { if (inside && count == lines && same) found = 1; inside = !inside; count = 0; same = 1; next }
    inside { ++count; if ($0 != wanted[count]) same = 0 }
    END { exit !found }
  ' "$file" "$readme" || { echo "$readme does not show $file as it is: copy the file into a fenced block" >&2; exit 1; }
done
echo "$# programs are shown as they are"
