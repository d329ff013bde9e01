#!/bin/sh
# quickstart_builds.sh NINJA BUILD ROOT: what examples/quickstart.sh builds is the library, the reading of decks and ents-host.
set -eu
target=$(sed -n 's/^sh examples\/setup.sh --configuration quick --target \([a-z-]*\).*/\1/p' "$3/examples/quickstart.sh")
objects=$("$1" -C "$2" -t commands "$target" | sed -n 's/.* -o \([^ ]*\.o\) .*/\1/p')
count() { printf '%s\n' "$objects" | grep -c "$1" || true; }
echo "$target: $(count .) objects; core $(count ^core/), abi $(count ^abi/), host $(count ^examples/)"
[ "$(count ^core/)" -gt 30 ] && [ "$(count ^abi/)" -gt 2 ] && [ "$(count ^examples/)" -gt 1 ] || exit 1
more=$(printf '%s\n' "$objects" | grep -e ^adapters/ -e feap -e ^examples/laboratory/ | grep -v ents_deck_reader.dir || true)
[ -z "$more" ] || { printf 'not needed for the picture:\n%s\n' "$more" >&2; exit 1; }
