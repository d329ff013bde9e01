#!/bin/sh
# header_layout.sh PYTHON ents.h layout.c layout.f90: write the same program twice, in C over ents.h and in Fortran over ents.f90. It
# prints every constant, and the offset and size of every field of every struct; the lists of both are taken from the header, so a
# constant or field that ents.f90 lacks does not compile, and one that it has in excess changes the size of its struct.
set -eu
python=$1 header=$2 c=$3 fortran=$4

facts=$("$python" "$(dirname "$header")/bindings/bindings.py" facts "$header")
fields=$(printf '%s\n' "$facts" | awk '$1 == "struct" { print $2, $5 }')
structs=$(printf '%s\n' "$fields" | cut -d' ' -f1 | uniq)
constants=$(printf '%s\n' "$facts" | awk '$1 == "constant" { print $2 }')
[ -n "$fields" ] && [ -n "$constants" ] || { echo "header_layout.sh: nothing found in $header" >&2; exit 1; }

{
  cat <<'C'
#include "ents.h"
#include <stdio.h>
static void number(const char *name, int value) { printf("%s %d\n", name, value); }
static void field(const char *name, size_t offset, size_t size) { printf("%s %d %d\n", name, (int)offset, (int)size); }
int main(void) {
C
  for name in $constants; do echo "  number(\"$name\", $name);"; done
  for struct in $structs; do echo "  number(\"$struct\", (int)sizeof($struct));"; done
  printf '%s\n' "$fields" | while read -r struct field; do
    echo "  field(\"$struct%$field\", offsetof($struct, $field), sizeof((($struct *)0)->$field));"
  done
  echo '  return 0;'
  echo '}'
} >"$c"

{
  cat <<'FORTRAN'
program layout
  use, intrinsic :: iso_c_binding, only: c_int8_t, c_int32_t, c_intptr_t, c_loc, c_ptr
  use ents
  implicit none
FORTRAN
  for struct in $structs; do echo "  type($struct), target :: x_$struct"; done
  for name in $constants; do echo "  call number(\"$name\", $name)"; done
  for struct in $structs; do echo "  call number(\"$struct\", x_$struct%struct_size)"; done
  printf '%s\n' "$fields" | while read -r struct field; do
    echo "  call field(\"$struct%$field\", &"
    echo "    c_loc(x_$struct), c_loc(x_$struct%$field), &"
    echo "    size(transfer(x_$struct%$field, [0_c_int8_t])))"
  done
  cat <<'FORTRAN'
contains
  subroutine number(name, value)
    character(*), intent(in) :: name
    integer(c_int32_t), intent(in) :: value
    write (*, '(a,1x,i0)') name, value
  end subroutine number

  subroutine field(name, start, place, bytes)
    character(*), intent(in) :: name
    type(c_ptr), intent(in) :: start, place
    integer, intent(in) :: bytes
    write (*, '(a,1x,i0,1x,i0)') name, transfer(place, 0_c_intptr_t) - transfer(start, 0_c_intptr_t), bytes
  end subroutine field
end program layout
FORTRAN
} >"$fortran"
