#!/bin/sh
# arrows.sh ROOT: who may include whom. core knows mechanics and nothing of C, JSON, files or hosts; it is reached through abi only;
# examples and adapters see ents.h, or ents.hpp over it, and nothing else of ours.
set -eu
cd "$1"
bad=0

# includes FOLDER: file:line:<header> or "header" of every source file below it
includes() {
  [ -d "$1" ] || return 0
  grep -rnoE --include='*.[ch]' --include='*.[ch]pp' '^ *# *include *[<"][^>"]*[>"]' "$1" | sed 's/# *include *//; s/: */:/g'
}

# forbid "why" 'pattern' folders ...: no include of these folders matches
forbid() {
  why=$1 pattern=$2
  shift 2
  for folder; do
    found=$(includes "$folder" | grep -E ":$pattern\$" || true)
    [ -z "$found" ] && continue
    printf '%s\n' "$found" | sed "s|\$|  -- $why|" >&2
    bad=1
  done
}

for folder in core abi; do
  [ -n "$(includes $folder)" ] || { echo "no include found below $folder" >&2; exit 1; }
done
forbid "core does not know the C ABI or hosts" '["<](.*/)?(ents\.h(pp)?|(abi|adapters|examples|tests)/.*)[">]' core
forbid "core does not know JSON" '["<].*json.*[">]' core
forbid "core does not read or write" '<(fstream|iostream|ostream|istream|sstream|filesystem|cstdio|stdio\.h|clocale|locale)>' core
forbid "core takes no lock and starts no thread" '<(thread|mutex|shared_mutex|atomic|future|condition_variable)>' core
forbid "POSIX is not portable C++" '<(unistd|fcntl|dlfcn|pthread|signal|sys/.*)\.?h?>' core abi
forbid "ents.hpp is for programs" '["<](.*/)?ents\.hpp[">]' abi
forbid "abi does not know hosts or tests" '["<](.*/)?(adapters|examples|tests)/.*[">]' abi
forbid "only abi may see core" '["<](.*/)?core/.*[">]' examples adapters
forbid "the interface is ents.h" '["<](.*/)?abi/.*\.hpp[">]' examples adapters core

# A folder of core includes only those before it. core/README.md has them in this order.
before=
for folder in numbers body height surface law model projection tangent element search slave smoothing admissibility; do
  [ -n "$(includes core/$folder)" ] || { echo "no include found below core/$folder" >&2; exit 1; }
  before="$before${before:+|}$folder"
  found=$(includes core/$folder | grep -E ':"core/' | grep -vE ":\"core/($before)/" || true)
  [ -z "$found" ] || { printf '%s\n' "$found" | sed "s|\$|  -- core/$folder comes before it|" >&2; bad=1; }
done
for folder in core/*/; do
  case "|$before|" in *"|$(basename "$folder")|"*) ;; *) echo "$folder is not in the order above" >&2; bad=1 ;; esac
done

# The laboratory stands on the reference host, and both on the toolbox, never the other way.
for folder in toolbox host; do
  includes examples/$folder | grep -oE '"[^"]*"$' | tr -d '"' | sort -u | while read -r header; do
    case "$folder $header" in "host deck/"*) continue ;; *" toolbox/"*) file=examples/$header ;; *) file=examples/$folder/$header ;; esac
    [ -f "$file" ] || echo "examples/$folder includes \"$header\", which is not its own"
  done
done | sort | { ! grep . >&2; } || bad=1
forbid "the toolbox knows no contact" '[<"](.*/)?ents\.h(pp)?[>"]' examples/toolbox

# The reader of decks serves ents-deck and the reference host: it knows neither the library nor a host.
reader=$(cd adapters/deck && ls source.?pp spelling.cpp element_types.?pp scopes.?pp mesh.?pp faces.?pp facet_tree.?pp)
for file in $reader; do
  own=$(grep -oE '^#include "[^"]*"' "adapters/deck/$file" | sed 's/#include "//; s/"//')
  for header in $own; do
    case " $(echo $reader) " in *" $header "*) ;; *) echo "adapters/deck/$file includes \"$header\", which is not the reader's" >&2; bad=1 ;; esac
  done
done

# No detour either: a name without a folder that exists only in core or in abi.
for folder in examples adapters; do
  includes $folder | grep -oE '"[^"]*"$' | tr -d '"' | sort -u | while read -r header; do
    name=$(basename "$header")
    case $name in ents.h | ents.hpp) continue ;; esac
    [ -n "$(find $folder -name "$name")" ] && continue
    # The reference host and the laboratory read decks by ents-deck's reader, whose shapes of elements they take.
    case "$folder $header" in "examples deck/mesh.hpp" | "examples deck/faces.hpp" | "examples deck/element_types.hpp") continue ;; esac
    echo "$folder includes \"$header\", which is not its own"
  done
done | sort | { ! grep . >&2; } || bad=1

[ $bad -eq 0 ] || exit 1
echo "$(includes core | wc -l) includes of core, $(includes abi | wc -l) of abi, $(includes examples | wc -l) of examples"
