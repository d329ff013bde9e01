#!/bin/sh
# client.sh LANGUAGE PREFIX CLIENTS SCRATCH EXPECTED: build the client of this language as a user would, against the installed tree
# under PREFIX alone, run it, and compare its text with what the program EXPECTED of the build tree prints.
#   c        cc and pkg-config
#   cpp      CMake and find_package(ents)
#   fortran  the installed module source, compiled first, and pkg-config
# CC, CXX, FC, CMAKE and CMAKE_GENERATOR name the tools.
set -eu
language=$1 prefix=$2 clients=$3 scratch=$4/$1 expected=$5
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"

PKG_CONFIG_LIBDIR=$(dirname "$(find "$prefix" -name ents.pc)")
export PKG_CONFIG_LIBDIR
library=$(pkg-config --variable=libdir ents)

case $language in
  c)
    $CC -std=c99 -Wall -Wextra -Wpedantic -Werror $(pkg-config --cflags ents) "$clients/client.c" -o client \
      $(pkg-config --libs ents)
    ;;
  cpp)
    cat >CMakeLists.txt <<CMAKE
cmake_minimum_required(VERSION 3.16)
project(client CXX)
set(CMAKE_CXX_STANDARD 20)
find_package(ents 0.1 REQUIRED CONFIG)
foreach(file IN ITEMS \${ents_FORTRAN_MODULE} \${ents_MODEL_SCHEMA})
  if(NOT EXISTS \${file})
    message(FATAL_ERROR "ents-config.cmake names \${file}, which does not exist")
  endif()
endforeach()
add_executable(client $clients/client.cpp)
target_link_libraries(client PRIVATE ents::ents)
CMAKE
    { "$CMAKE" -S . -B build -DCMAKE_CXX_COMPILER="$CXX" -DCMAKE_PREFIX_PATH="$prefix" && "$CMAKE" --build build; } >log 2>&1 ||
      { cat log >&2; exit 1; }
    cp build/client .
    ;;
  fortran)
    $FC -c "$(pkg-config --variable=fortran_module ents)" -o ents.o
    $FC "$clients/client.f90" ents.o -o client $(pkg-config --libs ents)
    ;;
  *)
    echo "client.sh: unknown language $language" >&2
    exit 2
    ;;
esac

LD_LIBRARY_PATH=$library ldd ./client | grep -qF "=> $library/libents.so" ||
  { echo "the client does not use the installed library" >&2; LD_LIBRARY_PATH=$library ldd ./client >&2; exit 1; }
LD_LIBRARY_PATH=$library ./client >output
"$expected" >expected
diff -u expected output
echo "$(wc -l <output) lines agree with the build tree"
