#!/bin/sh
# install.sh CMAKE BUILD_DIR SCRATCH: install the build, then move the installed tree: what is built against it later can only find
# it where it now is. No installed file may name the places it came from.
set -eu
cmake=$1 build=$2 scratch=$3
source=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")

rm -rf "$scratch"
mkdir -p "$scratch"
"$cmake" --install "$build" --prefix "$scratch/first" >"$scratch/install.log" || { cat "$scratch/install.log" >&2; exit 1; }
mv "$scratch/first" "$scratch/prefix"

for file in include/ents.h include/ents.hpp include/ents.f90 share/ents/model.schema.json share/ents/python/ents/__init__.py; do
  [ -s "$scratch/prefix/$file" ] || { echo "not installed: $file" >&2; exit 1; }
done
for name in libents.so ents.pc ents-config.cmake; do
  find "$scratch/prefix" -name "$name" | grep -q . || { echo "not installed: $name" >&2; exit 1; }
done
for program in "$scratch"/prefix/bin/*; do
  [ ! -e "$program" ] || env -u LD_LIBRARY_PATH "$program" --help >"$scratch/help" 2>&1 || { cat "$scratch/help" >&2; exit 1; }
done
if grep -rlF -e "$source" -e "$build" -e "$scratch" "$scratch/prefix"; then
  echo "the files above name a path of this machine" >&2
  exit 1
fi
(cd "$scratch/prefix" && find . ! -type d | sort)
