#!/bin/sh
# doctor.sh PYTHON FOLDER: python3 -m ents says library and instruction set and checks itself; what is missing it names, with the way to get it.
# ENTS_LIBRARY names libents.so. Exit status 3: no NumPy.
set -eu
python=$1 folder=$2
"$python" -c 'import numpy' 2>/dev/null || { echo "not run: no NumPy"; exit 3; }
export PYTHONPATH="$folder" PYTHONDONTWRITEBYTECODE=1

says() { # exit status, words of the output, command
  wanted=$1 words=$2 status=0
  shift 2
  output=$("$@" 2>&1) || status=$?
  [ $status -eq "$wanted" ] || { echo "exit status $status instead of $wanted: $* says: $output"; exit 1; }
  case $output in *"$words"*) ;; *) echo "$* does not say '$words' but: $output"; exit 1 ;; esac
}
says 0 "library            $ENTS_LIBRARY" "$python" -m ents
says 0 "check              passed" "$python" -m ents doctor
says 0 "usage" "$python" -m ents --help
says 2 "doctor" "$python" -m ents patient
says 1 "set ENTS_LIBRARY" env ENTS_LIBRARY=/nowhere/libents.so "$python" -m ents
# -S: a Python without packages.
says 1 "python3-numpy" "$python" -S -m ents
# A library that computes something else: the check has to see it.
says 1 "it should be" "$python" -c '
import ents.__main__ as doctor
doctor.RESIDUAL *= 1 + 1e-12
raise SystemExit(doctor.main())'
echo "the doctor says what is there and what is missing"
