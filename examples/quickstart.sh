#!/bin/sh
# Set up, build, press the measured rough surface into an elastic block, and draw it.
set -eu
cd "$(dirname "$0")/.."

deck=''
case ${1-} in
  -h | --help)
    cat <<'HELP'
usage: sh examples/quickstart.sh [--deck]

Installs what is missing and builds the library and ents-host in build-quick/ (configuration quick of sh examples/setup.sh, which takes
elements one by one), then solves examples/rough_afm, variant block: a surface measured by atomic force microscopy on ONE contact segment, pressed into a
block of hex8. The results go to out/rough_afm. With --deck it builds ents-deck, too, which converts CalculiX's and Abaqus's decks.

exit status: 0 done; 1 the build or the solution failed; 2 a package is missing, or the command line is wrong
HELP
    exit 0
    ;;
  --deck) deck='--target ents-deck' ;;
  ?*) echo "quickstart.sh: unknown option '$1'; try --help" >&2; exit 2 ;;
esac

# shellcheck disable=SC2086 # words
sh examples/setup.sh --configuration quick --target ents-host $deck
echo "== build-quick/bin/ents-host run examples/rough_afm/scene.json --variant block --out out/rough_afm"
build-quick/bin/ents-host run examples/rough_afm/scene.json --variant block --out out/rough_afm
/usr/bin/python3 -B examples/rough_afm/picture.py out/rough_afm
echo "== more: sh examples/gallery.sh builds ents-lab and fast kernels of this processor in build/ and solves all scenes, with exact answers"
