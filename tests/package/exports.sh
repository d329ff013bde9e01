#!/bin/sh
# exports.sh libents.so ents.h: the library exports the functions of the header, as strong functions, and nothing else.
# A weak C++ symbol here could be taken over by, or take over, one of the host's.
set -eu
library=$1 header=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

sed -n 's/^ENTS_API .*[ *]\(ents_[a-z_]*\)(.*/\1/p' "$header" | sort >"$scratch/header"
nm -D --defined-only "$library" | awk '{ print $2, $3 }' | sort >"$scratch/library"
sed 's/^/T /' "$scratch/header" >"$scratch/expected"

[ "$(grep -c '^ENTS_API' "$header")" -eq "$(wc -l <"$scratch/header")" ] || { echo "a function of $header was not found" >&2; exit 1; }
[ -s "$scratch/header" ] || { echo "no function found in $header" >&2; exit 1; }
diff -u "$scratch/expected" "$scratch/library" || { echo "the exports of the library (+) differ from ents.h (-)" >&2; exit 1; }
echo "$(wc -l <"$scratch/header") functions, all strong, nothing else"
