#!/bin/sh
# exports.sh LIBRARY SYMBOL...: an adapter shows the host's symbols and no others, needs libents.so and the usual runtimes alone, and no function
# that only one program has (OpenSees's own are the exception: ops_*).
set -eu
library=$1
shift
expected=$(printf '%s\n' "$@" | sort)
found=$(nm -D --defined-only "$library" | awk '{ print $NF }' | sort)
[ "$found" = "$expected" ] || { printf 'exported:\n%s\nexpected:\n%s\n' "$found" "$expected" >&2; exit 1; }
for name in $(readelf -dW "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
  case $name in
    libents.so.* | libc.so.6 | libm.so.6 | libstdc++.so.6 | libgcc_s.so.1 | ld-linux-*.so.*) ;;
    *) echo "$library needs $name" >&2; exit 1 ;;
  esac
done
missing=$(ldd -r "$library" 2>&1 | sed -n 's/.*undefined symbol: \([^ \t]*\).*/\1/p' | grep -v '^ops_' || true)
[ -z "$missing" ] || { echo "$library cannot be loaded without $missing" >&2; exit 1; }
echo "$# symbols"
