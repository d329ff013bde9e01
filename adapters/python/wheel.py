#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write a wheel: the Python package ents with libents.so inside.

usage: wheel.py --library libents.so.1 --version X.Y.Z --out FOLDER

The wheel is for every Python 3 (ctypes; nothing is compiled for it) on Linux with the processor of this machine and glibc 2.36 or later.
pip installs it with --no-index. The library is stripped; where Debian's advancecomp is installed the wheel is packed more tightly (30 s).
The same files give the same bytes.

exit status: 0 done; 1 the library is not one that a wheel may hold; 2 wrong command line"""
import argparse
import base64
import hashlib
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
GLIBC = (2, 36)
DEPENDENCIES = {"libc.so.6", "libm.so.6", "libstdc++.so.6", "libgcc_s.so.1"}  # of the manylinux policies
METADATA = """Metadata-Version: 2.1
Name: ents
Version: {version}
Summary: Enriched node-to-segment contact elements for finite element codes
License: BSD-3-Clause
Requires-Python: >=3.9
Requires-Dist: numpy
Provides-Extra: contact
Requires-Dist: scipy; extra == "contact"
Provides-Extra: plot
Requires-Dist: matplotlib; extra == "plot"
Description-Content-Type: text/markdown

{readme}"""
README = """# ents

Contact elements whose master surface carries geometry finer than the mesh: measured roughness, waves, threads, grooves, a sphere.
The library libents.so is inside. `python3 -m ents` says its version and checks it; `help(ents)` documents the package.
"""


def checked_library(path, scratch):
    """A stripped copy; SystemExit if it needs what a manylinux wheel may not expect."""
    text = subprocess.run(["readelf", "-dVW", path], check=True, capture_output=True, text=True).stdout
    needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", text)) - DEPENDENCIES
    needed = {name for name in needed if not name.startswith("ld-linux")}
    newest = max((tuple(map(int, v.split("."))) for v in re.findall(r"GLIBC_([0-9.]+)", text)), default=(0, 0))
    if needed or newest > GLIBC or re.search(r"\((RPATH|RUNPATH)\)", text):
        sys.exit(f"wheel.py: {path} needs {needed or ''} glibc {newest}, or has a search path: no wheel for glibc {GLIBC} may hold it")
    copy = scratch / "libents.so.1"
    subprocess.run(["strip", "--strip-unneeded", "-o", copy, path], check=True)
    return copy


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--library", required=True, type=pathlib.Path)
    parser.add_argument("--version", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    given = parser.parse_args()
    tag = f"py3-none-manylinux_{GLIBC[0]}_{GLIBC[1]}_{platform.machine()}"
    wheel = given.out / f"ents-{given.version}-{tag}.whl"
    info = f"ents-{given.version}.dist-info"
    given.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        library = checked_library(given.library, pathlib.Path(folder))
        files = {f"ents/{file.name}": file.read_bytes() for file in sorted([*(HERE / "ents").glob("*.py"), HERE / "ents" / "py.typed"])}
        files["ents/libents.so.1"] = library.read_bytes()
        files[f"{info}/LICENSE"] = (HERE.parents[1] / "LICENSE").read_bytes()
        files[f"{info}/METADATA"] = METADATA.format(version=given.version, readme=README).encode()
        files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: ents wheel.py\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
        digest = lambda data: base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("=")
        record = [f"{name},sha256={digest(data)},{len(data)}\n" for name, data in files.items()] + [f"{info}/RECORD,,\n"]
        files[f"{info}/RECORD"] = "".join(record).encode()
        packed = pathlib.Path(folder) / wheel.name
        with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
            for name, data in files.items():
                entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
                entry.external_attr, entry.compress_type = 0o644 << 16, zipfile.ZIP_DEFLATED
                archive.writestr(entry, data)
        if shutil.which("advzip"):
            subprocess.run(["advzip", "--recompress", "--quiet", "-4", "--iter=3", packed], check=True)
        shutil.copyfile(packed, wheel)
    print(f"{wheel}: {wheel.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
