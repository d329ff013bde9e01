#!/bin/sh
# dependencies.sh libents.so: what a host must have for the library to load.
set -eu
library=$1
fail() { echo "$*" >&2; exit 1; }

needed=$(readelf -dW "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
[ -n "$needed" ] || fail "no NEEDED entry found in $library"
for name in $needed; do
  case $name in
    libc.so.6 | libm.so.6 | libstdc++.so.6 | libgcc_s.so.1 | ld-linux-*.so.*) ;;
    *) fail "the library needs $name; allowed are the C, C++ and mathematics runtimes" ;;
  esac
done

readelf -dW "$library" | grep -qE '\((RPATH|RUNPATH)\)' && fail "the library carries a search path of the build machine"
readelf -dW "$library" | grep -q TEXTREL && fail "the library is not position independent"
readelf -lW "$library" | grep GNU_STACK | grep -q RWE && fail "the library asks for an executable stack"

# The oldest systems that can load it. Debian 12, the reference, has 2.36; RHEL 9 and its kin have 2.34.
newest() { readelf -VW "$library" | grep -oE "$1_[0-9.]+" | sort -uV | tail -n 1; }
glibc=$(newest GLIBC)
limit=GLIBC_2.34
[ -n "$glibc" ] || fail "no GLIBC version found in $library"
[ "$(printf '%s\n' "$glibc" $limit | sort -V | tail -n 1)" = $limit ] || fail "the library needs $glibc; the promise is $limit"
echo "needs: $(echo $needed); newest symbols: $glibc, $(newest GLIBCXX), $(newest CXXABI)"
