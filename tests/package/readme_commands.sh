#!/bin/sh
# readme_commands.sh ROOT PREFIX SCRATCH EXPECTED_FIRST SLIDE_C: the commands of README.md and examples/slide/README.md that compile a
# program against an installed library, run as they stand there with PREFIX put in. EXPECTED_FIRST prints what `first` has to print; SLIDE_C
# is slide of the build. The lines of C in core/README.md compile.
set -eu
root=$1 prefix=$2 scratch=$3 expected_first=$4 slide=$5
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
cp "$root"/tests/clients/first.* "$root"/examples/slide/slide.* "$root"/examples/slide/model.json .
unset PKG_CONFIG_PATH LD_LIBRARY_PATH

# commands README: its lines from `export PKG_CONFIG_PATH` to the end of that block
commands() { sed -n '/^    export PKG_CONFIG_PATH/,/^$/s/^    //p' "$root/$1" | sed "s|PREFIX|$prefix|g"; }

"$expected_first" >first.expected
"$slide" model.json >slide.expected
run() { # README, program, arguments of the program
  readme=$1 program=$2
  shift 2
  commands "$readme" >"$program.sh"
  [ "$(grep -c "$program\.[cf]" "$program.sh")" -ge 2 ] || { echo "$readme has no commands for $program in C and Fortran" >&2; exit 1; }
  # One compiler after the other: both programs have one name.
  for source in $program.c $program.f90; do
    rm -f "$program" ./*.mod
    grep -e '^export' -e "$source" "$program.sh" >one.sh
    sh -eu one.sh
    LD_LIBRARY_PATH=$(sed -n 's/.*LD_LIBRARY_PATH=\([^ ]*\).*/\1/p' one.sh) "./$program" "$@" >"$program.out"
    diff -u "$program.expected" "$program.out" || { echo "$readme: $source prints something else" >&2; exit 1; }
  done
}
run README.md first
run examples/slide/README.md slide model.json

lines=$(sed -n '/^    ents_detect(/,/^$/s/^    //p' "$root/core/README.md")
[ -n "$lines" ] || { echo "core/README.md has no lines of C" >&2; exit 1; }
{
  echo '#include "ents.h"'
  echo 'void lines(const ents_model *model, ents_master_mesh mesh, double *tree, int64_t size, int64_t count, int64_t d,'
  echo '           ents_detection detection, ents_input input, ents_report report) {'
  printf '%s\n}\n' "$lines"
} >core.c
cc -std=c99 -Wall -Werror -Wno-unused-but-set-parameter -fsyntax-only -I "$prefix/include" core.c
echo "4 programs are built by the commands of the READMEs"
