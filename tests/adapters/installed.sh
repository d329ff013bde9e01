#!/bin/sh
# installed.sh LIBRARY-FOLDER SCRATCH ADAPTER...: an installed adapter that is copied, under a host's own name for it, into another folder with
# libents.so.1 beside it loads that one, whatever the library path.
set -eu
folder=$1 scratch=$2
shift 2
rm -rf "$scratch"
mkdir -p "$scratch"
cp "$folder/libents.so.1" "$scratch"
for name; do
  file=$folder/lib$name.so
  [ -f "$file" ] || file=$folder/$name.so
  cp "$file" "$scratch/user_library.so"
  found=$(unset LD_LIBRARY_PATH; ldd "$scratch/user_library.so" | grep 'libents\.so')
  case $found in
    *"=> $scratch/libents.so.1 "*) ;;
    *) echo "$file copied to $scratch finds:$found" >&2; exit 1 ;;
  esac
  path=$(readelf -dW "$file" | sed -n 's/.*(RUNPATH).*\[\(.*\)\]/\1/p')
  [ "$path" = '$ORIGIN' ] || { echo "$file looks for libraries in '$path'" >&2; exit 1; }
done
echo "$# adapters"
