#!/bin/sh
# tests/not_run.sh over a project of tests that are skipped with and without a reason, fail and pass.
#   sh not_run.sh FOLDER CTEST
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$1 ctest=$2
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
cat > CTestTestfile.cmake <<'END'
add_test(good "/bin/sh" "-c" "echo 'no NumPy'")
add_test(freefem "/bin/sh" "-c" "echo first; echo 'no ff-c++ (Debian: freefem++)'; echo; exit 3")
add_test(python "/bin/sh" "-c" "echo 'no NumPy'; exit 3")
add_test(python_2 "/bin/sh" "-c" "echo '[----------] noise'; echo 'no NumPy'; echo '[  SKIPPED ] noise'; exit 3")
add_test(silent "/bin/sh" "-c" "exit 3")
add_test(bad "/bin/sh" "-c" "echo 'no NumPy'; exit 1")
set_tests_properties(freefem python python_2 silent bad PROPERTIES SKIP_RETURN_CODE 3)
END
"$ctest" --output-on-failure --output-log output.log >/dev/null 2>&1 && { echo "a test fails, and ctest does not"; exit 1; }
said=$(sh "$here/../not_run.sh" output.log Testing/Temporary/LastTest.log)
emulated="Abaqus, Ansys, FEAP, LS-DYNA, Marc, MOOSE, OOFEM, OpenSees are emulated"
wanted="not run: python, python_2 (no NumPy); freefem (no ff-c++ (Debian: freefem++)); silent (no reason given); $emulated"
[ "$said" = "$wanted" ] || { printf '%s\n%s\n' "wanted: $wanted" "got:    $said"; exit 1; }
: > empty.log # as another ctest in the same folder leaves it
said=$(sh "$here/../not_run.sh" output.log empty.log)
case $said in "not run: "*freefem*"(the log does not say why); $emulated") ;; *) echo "reasons are lost, and got: $said"; exit 1 ;; esac
"$ctest" -R good --output-log output.log >/dev/null 2>&1
said=$(sh "$here/../not_run.sh" output.log Testing/Temporary/LastTest.log)
[ "$said" = "not run: $emulated" ] || { echo "nothing was skipped, and got: $said"; exit 1; }
