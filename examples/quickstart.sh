#!/bin/sh
# Set up, build, press the measured rough surface into an elastic layer, and name the pictures.
set -eu
cd "$(dirname "$0")/.."

deck=''
case ${1-} in
  -h | --help)
    cat <<'HELP'
usage: sh examples/quickstart.sh [--deck]

Installs what is missing and builds the library and ents-lab in build/ (see sh examples/setup.sh --help), then solves
examples/rough_afm, a surface measured by atomic force microscopy on ONE contact segment, pressed into an elastic layer. The results go
to out/rough_afm. With --deck it builds ents-deck, too, which converts CalculiX's and Abaqus's decks.

exit status: 0 done; 1 the build or the solution failed; 2 a package is missing, or the command line is wrong
HELP
    exit 0
    ;;
  --deck) deck='--target ents-deck' ;;
  ?*) echo "quickstart.sh: unknown option '$1'; try --help" >&2; exit 2 ;;
esac

# shellcheck disable=SC2086 # words
sh examples/setup.sh --target ents-lab $deck
echo "== build/bin/ents-lab run examples/rough_afm/scene.json --out out/rough_afm"
build/bin/ents-lab run examples/rough_afm/scene.json --out out/rough_afm
echo "== pictures (each also as .svg); ParaView opens out/rough_afm/result.pvd"
picture() { [ ! -f "out/rough_afm/$1.png" ] || printf '%-34s %s\n' "out/rough_afm/$1.png" "$2"; }
picture pressure_map "height of the scan, contact pressure and its difference to boundary elements, last step"
picture contact_fraction "contact area against mean pressure"
picture mean_gap "mean gap against mean pressure"
picture residuals "Newton's iteration, every step"
