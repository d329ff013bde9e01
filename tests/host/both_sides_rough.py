"""both_sides_rough.py ENTS-LAB EXAMPLES: a sine divided between master and slave, in several phases, presses as the composite sine does (Westergaard;
K. L. Johnson, Contact Mechanics, 1985, section 13.2): peak pressure 2 p / sin(pi a / L) with the mean pressure p = p* sin^2(pi a / L), mean gap."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

FULL = math.pi * 1000 / (1 - 0.3 ** 2) * 0.0005  # p* = pi E* amplitude / wavelength
LOADS = ((0.2, None), (0.5, 0.153426))  # mean pressure / p*, mean gap / amplitude
failures = []


def expect(name, value, exact, bound=0.005):
    print(f"{name}: {value:.6g}, exact {exact:.6g}, error {value / exact - 1:+.2e}, bound {bound}")
    if not abs(value / exact - 1) < bound:
        failures.append(f"{name}: {value:.6g}, exact {exact:.6g}")


def main():
    program, examples = (pathlib.Path(argument) for argument in sys.argv[1:3])
    text = json.loads((examples / "westergaard" / "scene.json").read_text())
    text["steps"] = {"control": "mean_pressure", "values": [part * FULL for part, _ in LOADS]}
    variants = [name for name, change in text["variants"].items() if "slave_height" in change.get("contact", {})]
    if len(variants) < 4:
        failures.append(f"variants with two rough sides: {variants}")
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "scene.json").write_text(json.dumps(text))
        for name in variants:
            done = subprocess.run([program, "run", folder / "scene.json", "--variant", name, "--out", folder / "out", "--no-pictures"], capture_output=True, text=True,
                                  check=False)
            if done.returncode:
                failures.append(f"{name}: {done.stderr}")
                continue
            for step, (part, gap) in zip(json.loads((folder / "out" / "result.json").read_text())["steps"], LOADS):
                expect(f"{name}, {part} p*: peak pressure", step["peak_pressure"], 2 * math.sqrt(part) * FULL)
                if gap:
                    expect(f"{name}, {part} p*: mean gap", step["mean_gap"], gap * 0.0005)
    for line in failures:
        print(line, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
