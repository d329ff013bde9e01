#!/bin/sh
# wheel.sh PYTHON FOLDER EXPECTED SCRATCH: the wheel in FOLDER is installed with pip, without an index, into a fresh venv, without a compiler
# and without an environment variable, and prints what the C program EXPECTED prints. Nothing of ours is left after it is removed.
# Exit status 3: this Python has no venv, pip or NumPy.
set -eu
python=$1 folder=$2 expected=$3 scratch=$4
unset ENTS_LIBRARY PYTHONPATH LD_LIBRARY_PATH
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
# NumPy is Debian's: pip is not to fetch anything here.
if ! { "$python" -c 'import numpy' && "$python" -m venv --system-site-packages venv; } >log 2>&1; then
  cat log
  echo "not run: this needs python3-venv and python3-numpy"
  exit 3
fi
begin=$(date +%s%N)
venv/bin/pip install --no-index --no-cache-dir "$folder"/ents-*-py3-none-manylinux_*.whl >log 2>&1 || { cat log >&2; exit 1; }
end=$(date +%s%N)
cat >first.py <<'PYTHON'
import ents
model = ents.Model({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.05, "wave_vector": [0.5, 0.25]},
                    "contact": {"normal": {"type": "penalty", "stiffness": 1000}}})
r = model.evaluate([[-0.4, 0.3, -0.1]], [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], "gap residual tangent")
for i in range(15):
    print("%24.16E%24.16E%24.16E" % (r["gap"][0], r["residual"][0, i], r["tangent"][0, i, 2]))
PYTHON
env PATH=/nonexistent "$PWD/venv/bin/python" first.py >output
"$expected" >expected
diff -u expected output
venv/bin/python -m ents >doctor || { cat doctor >&2; exit 1; }
grep -q "$PWD/venv/lib.*/ents/libents.so.1" doctor || { echo "not the library of the wheel:" >&2; cat doctor >&2; exit 1; }
venv/bin/pip uninstall --yes ents >log 2>&1 || { cat log >&2; exit 1; }
left=$(find venv -path '*ents*' -not -path '*/pip/*' -name '*ents*' -not -name '*comments*' -not -name '*agents*' | grep -E '/ents([-/.]|$)' || true)
[ -z "$left" ] || { echo "left after pip uninstall: $left" >&2; exit 1; }
echo "$(du -b "$folder"/ents-*.whl | cut -f1) bytes, installed in $(((end - begin) / 1000000)) ms, the bits of C, removed"
