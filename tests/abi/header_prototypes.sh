#!/bin/sh
# header_prototypes.sh PYTHON FC ents.h ents.f90: the compiler's own C prototypes of the Fortran module (gfortran -fc-prototypes) name the
# same structs with the same fields and the same functions with the same arguments, passed the same way, as the header.
set -eu
python=$1 fortran_compiler=$2 header=$3 module=$4
facts() { "$python" "$(dirname "$header")/bindings/bindings.py" facts "$1" | grep -v ^constant | sort; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

facts "$header" >"$scratch/c"
(cd "$scratch" && "$fortran_compiler" -fsyntax-only -fc-prototypes "$module") >"$scratch/prototypes.h"
facts "$scratch/prototypes.h" >"$scratch/fortran"

lines=$(wc -l <"$scratch/c")
[ "$lines" -gt 0 ] || { echo "nothing found in $header" >&2; exit 1; }
diff -u "$scratch/c" "$scratch/fortran" || { echo "ents.f90 (+) differs from ents.h (-)" >&2; exit 1; }
echo "$lines facts about structs and functions agree"
