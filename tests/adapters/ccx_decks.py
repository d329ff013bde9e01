"""What tests of decks in ccx share: the command line, a folder of its own for each deck, ents-deck run, the forces that ccx has printed."""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys


def parser(doc):
    out = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    out.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build"))
    return out


class Programs:
    """ents-deck and ccx_ents of a build folder; ends the program with status 3 where ccx is not built."""

    def __init__(self, build):
        self.build = build.resolve()
        self.ccx, self.deck = self.build / "calculix/ccx_ents", self.build / "bin/ents-deck"
        if not self.ccx.exists():
            print(f"{self.ccx} is not here: sh adapters/calculix/run.sh --only-build")
            sys.exit(3)

    def folder(self, *names):
        """An empty folder below the build folder."""
        out = self.build.joinpath(*names)
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir(parents=True)
        return out

    def run(self, folder, deck, *options):
        """ents-deck run. Returns (what it printed, None), or (None, its message)."""
        ran = subprocess.run([self.deck, "run", deck, "--ccx", self.ccx, "--no-pictures", *options], cwd=folder, capture_output=True, text=True)
        (folder / "ents-deck.log").write_text(ran.stdout + ran.stderr)
        return (ran.stdout, None) if ran.returncode == 0 else (None, ran.stderr.strip() + ran.stdout[-600:])


def total(dat):
    """The last total force that ccx has printed, where Fortran leaves the E of 1E-100 out."""
    found = re.findall(r"total force.*\n\s*\n\s*(\S+)\s+(\S+)\s+(\S+)", dat.read_text())[-1]
    return tuple(float(re.sub(r"(\d)([+-]\d{3})$", r"\1e\2", x)) for x in found)
