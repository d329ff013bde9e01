# Structs and functions of a C header as a table, one fact per line:
#
#   struct ents_report 2 int64 element          name of the struct, place, kind and name of the field
#   struct ents_report 4 char[512] message
#   function ents_state_init 0 int32 -          place 0 is what the function returns
#   function ents_state_init 1 pointer model
#
# Reads preprocessed text (cc -E -P). Works for ents.h and for the prototypes gfortran writes for ents.f90, whose pointers are
# all void*: hence one kind for every pointer.
BEGIN { RS = ";" }

function kind(declaration) {
  if (declaration ~ /\*/) return "pointer"
  if (declaration ~ /int32_t|int /) return "int32"
  if (declaration ~ /int64_t|long /) return "int64"
  if (declaration ~ /double /) return "float64"
  if (declaration ~ /char /) return "char"
  return "unknown(" declaration ")"
}

# "[16][2]" is 32.
function product(extents,    count, sizes, i, result) {
  gsub(/[][]+/, " ", extents)
  count = split(extents, sizes, " ")
  result = 1
  for (i = 1; i <= count; i++) result *= sizes[i]
  return result
}

# "double a, b[2]" is two fields.
function add(table, owner, declaration,    type, count, names, i, name, extent) {
  type = declaration
  sub(/[^ *]+( *,.*)?$/, "", type)
  declaration = substr(declaration, length(type) + 1)
  count = split(declaration, names, ",")
  for (i = 1; i <= count; i++) {
    name = names[i]
    gsub(/ /, "", name)
    extent = ""
    if (match(name, /\[.*\]/)) {
      extent = "[" product(substr(name, RSTART)) "]" # gfortran writes [16][2] as [32]
      name = substr(name, 1, RSTART - 1)
    }
    print table, owner, place++, kind(type) extent, name
  }
}

{
  gsub(/[ \t\r\n]+/, " ")
  sub(/__attribute__\(\(visibility\("default"\)\)\)/, "")
  sub(/^ */, "")
}

/^#|extern "C"/ { sub(/.*\{ */, "") }

/typedef struct ents_[a-z_]+ \{/ {
  match($0, /typedef struct ents_[a-z_]+ \{/)
  owner = $0
  sub(/.*typedef struct /, "", owner)
  sub(/ .*/, "", owner)
  place = 0
  inside = 1
  sub(/.*\{ */, "")
}

/^\} ents_/ { inside = 0; next }

inside { add("struct", owner, $0); next }

/ents_[a-z_]+ *\(/ {
  open = index($0, "(")
  head = substr($0, 1, open - 1)
  arguments = substr($0, open + 1)
  sub(/\).*/, "", arguments)
  sub(/ *$/, "", head)
  match(head, /ents_[a-z_]+$/)
  owner = substr(head, RSTART)
  print "function", owner, 0, kind(substr(head, 1, RSTART - 1)), "-"
  place = 1
  count = split(arguments, list, ",")
  for (i = 1; i <= count; i++) {
    gsub(/^ | $/, "", list[i])
    if (list[i] != "" && list[i] != "void") add("function", owner, list[i])
  }
}
