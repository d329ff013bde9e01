#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Heat through U1E in ccx: two bars one on the other, against exact values and against ccx's own *GAP CONDUCTANCE.

usage: heat.py write OUT
       heat.py compare OUT

write    OUT/NAME/job.inp and its model, for each of
  conducts    *HEAT TRANSFER, STEADY STATE; a constant conductance
  pressed     *COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE; a conductance of the pressure
  native      the same in ccx's own contact, *GAP CONDUCTANCE; a table over the pressure
  table       the same table in U1E
  dragged     the upper bar slides under a load: heat of friction, to both sides
  equalizes   *HEAT TRANSFER: two bars that conduct well equalize their temperatures through the gap, in time
compare  temperatures and powers that ccx left there. Prints a line for each: error, bound, iterations

exit status: 0 all within their bounds, 1 not"""
import json
import math
import pathlib
import re
import sys

from native import Block

# Lengths, conductivities and areas; the power that enters on top, and the temperature of the floor
LOW, HIGH, K_LOW, K_HIGH, WIDE, DEEP, POWER, FLOOR = 0.7, 2.0, 5.0, 3.0, 1.2, 1.0, 8.0, 1.0
AREA = WIDE * DEEP
YOUNG, PENALTY = 1000.0, 400.0
H = 10.0  # conductance
POWER_LAW = {"coefficient": 4.0, "pressure": 2.0, "exponent": 0.95}
TABLE = {"pressures": [0.0, 1.0, 4.0], "conductances": [1.0, 3.0, 9.0]}
PUSHED = 0.0165  # downwards, at the top: the pressure is about 3
OVERLAP = 0.001  # where nothing moves
MU, SHARE, SLAVE, LOAD, SPEED, DRAGS = 0.3, 0.9, 0.3, 2.4, 0.001, 10  # of `dragged`: DRAGS increments of a unit of time
CAPACITY_LOW, CAPACITY_HIGH, HOT, STEP, STEPS = 0.9, 0.4, 100.0, 0.05, 8  # of `equalizes`: per volume; times
# ccx prints seven digits.
PRINTED = 1e-6
ROUNDED = 1e-13  # of a correction, as a share of the largest one: nothing is left to solve


def bars(overlap):
    """Lower bar with 2 x 2 cells, upper one with 4 x 4 on it: no strain across, and heat that flows along them."""
    lower = Block(1, [0, 0, 0], [WIDE, DEEP, LOW], [2, 2, 2])
    upper = Block(1001, [0, 0, LOW - overlap], [WIDE, DEEP, LOW + HIGH - overlap], [4, 4, 2])
    lines = ["*NODE, NSET=ALL", *(", ".join(map(repr, node)) for block in (lower, upper) for node in block.nodes)]
    for name, block, k, c in (("LOWER", lower, K_LOW, CAPACITY_LOW), ("UPPER", upper, K_HIGH, CAPACITY_HIGH)):
        lines += [f"*ELEMENT, TYPE=C3D8, ELSET={name}", *(", ".join(map(str, [e] + nodes)) for e, nodes in block.cells),
                  f"*NSET, NSET={name}NODES", *(f"{n[0]}," for n in block.nodes), f"*MATERIAL, NAME={name}", "*ELASTIC", f"{YOUNG}, 0.",
                  "*CONDUCTIVITY", f"{k!r}", "*DENSITY", "1.", "*SPECIFIC HEAT", f"{c!r}", f"*SOLID SECTION, ELSET={name}, MATERIAL={name}"]
    lines += ["*NSET, NSET=FLOOR", *(f"{n}," for n in lower.floor), "*NSET, NSET=TOP", *(f"{n}," for n in upper.top)]
    return lines, lower, upper


def contact(lower, upper, law):
    """U1E: each slave node over all 4 facets of the master. Lines, and the files of model and areas."""
    lines = [f"*USER ELEMENT, TYPE=U1E, NODES={1 + len(lower.top)}, INTEGRATION POINTS=1, MAXDOF=3", "*ELEMENT, TYPE=U1E, ELSET=CONTACT"]
    lines += [", ".join(map(str, [5001 + e, slave] + lower.top)) for e, slave in enumerate(upper.floor)]
    lines += ["*MATERIAL, NAME=CONTACT", "*ELASTIC", "1., 0.", "*DEPVAR", "16", "*USER SECTION, ELSET=CONTACT, MATERIAL=CONTACT, CONSTANTS=3", "1., 0., 0."]
    areas = [f"{5001 + e} {a!r}" for e, a in enumerate(areas_of(upper))]
    patch = [[i + 3 * j, i + 1 + 3 * j, i + 4 + 3 * j, i + 3 + 3 * j] for j in range(2) for i in range(2)]
    model = {"segment": "quad4", "patch": patch, "border": 0.05, "contact": {"normal": {"type": "penalty", "stiffness": PENALTY}, **law}}
    return lines, {"ents_1.json": json.dumps(model, indent=1) + "\n", "ents_1.txt": "\n".join(areas) + "\n"}


def native(lower, upper):
    """ccx's own contact, face to face: node to face, ccx 2.20 conducts at the pressure of the exponential law also where the law is linear
    (springforc_n2f_th.f asks elcon(1), not elcon(3))."""
    rows = zip(TABLE["conductances"], TABLE["pressures"])
    return ["*SURFACE, NAME=SLAVE, TYPE=ELEMENT", *(f"{e}, S1" for e, _ in upper.below),
            "*SURFACE, NAME=MASTER, TYPE=ELEMENT", *(f"{e}, S2" for e, _ in lower.above),
            "*SURFACE INTERACTION, NAME=LAW", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{PENALTY!r}",
            "*GAP CONDUCTANCE", *(f"{h!r}, {p!r}, 0." for h, p in rows), "*CONTACT PAIR, INTERACTION=LAW, TYPE=SURFACE TO SURFACE", "SLAVE, MASTER"]


def areas_of(block):
    """Tributary areas of the nodes of a face."""
    nx, ny = block.shape
    cell = AREA / (nx - 1) / (ny - 1)
    return [cell * (1 if 0 < i % nx < nx - 1 else 0.5) * (1 if 0 < i // nx < ny - 1 else 0.5) for i in range(nx * ny)]


def loads(keyword, block, dof, total):
    """A load that is spread evenly over the top of a bar."""
    return [keyword, *(f"{n}, {dof}, {total / AREA * a!r}" for n, a in zip(block.top, areas_of(block)))]


def step(procedure, times, lines):
    return ["*INITIAL CONDITIONS, TYPE=TEMPERATURE", f"ALL, {FLOOR!r}", "*STEP, INC=1000", procedure, times, "*CONTROLS, PARAMETERS=FIELD", "1.e-9, 1.e-9", *lines,
            "*NODE PRINT, NSET=TOP", "NT", "*NODE PRINT, NSET=FLOOR, TOTALS=ONLY", "RFL", "*NODE PRINT, NSET=TOP, TOTALS=ONLY", "RFL",
            "*NODE PRINT, NSET=UPPERNODES", "NT", "*NODE PRINT, NSET=LOWERNODES", "NT", "*END STEP"]


COUPLED, STEADY = "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE, DIRECT", "1., 1."


def write(out):
    files = {}
    heated = ["*BOUNDARY", f"FLOOR, 11, 11, {FLOOR!r}"]
    lines, lower, upper = bars(OVERLAP)
    law, more = contact(lower, upper, {"heat": {"conductance": H}})
    files["conducts"] = [*lines, *law, *step("*HEAT TRANSFER, STEADY STATE", STEADY, heated + loads("*CFLUX", upper, 11, POWER))], more

    lines, lower, upper = bars(0.0)
    pushed = [*heated, "LOWERNODES, 1, 2", "UPPERNODES, 1, 2", "FLOOR, 3, 3", f"TOP, 3, 3, {-PUSHED!r}", *loads("*CFLUX", upper, 11, POWER)]
    for name, heat in (("pressed", {"power": POWER_LAW}), ("table", {"table": TABLE})):
        law, more = contact(lower, upper, {"heat": heat})
        files[name] = [*lines, *law, *step(COUPLED, STEADY, pushed)], more
    files["native"] = [*lines, *native(lower, upper), *step(COUPLED, STEADY, pushed)], {}

    # Both ends are held at 0: what arrives there is what has entered the side. The way is short: the areas stay.
    lines, lower, upper = bars(LOAD / AREA / PENALTY)
    law, more = contact(lower, upper, {"friction": {"type": "coulomb", "coefficient": MU, "stiffness": 2e4},
                                       "heat": {"friction": {"share": SHARE, "slave": SLAVE}}})
    moved = ["*BOUNDARY", "FLOOR, 11, 11, 0.", "TOP, 11, 11, 0.", "LOWERNODES, 1, 3", "UPPERNODES, 2, 2",
             f"UPPERNODES, 1, 1, {SPEED * DRAGS!r}", *loads("*CLOAD, AMPLITUDE=ON", upper, 3, -LOAD)]
    cold = ["*AMPLITUDE, NAME=ON", f"0., 1., {float(DRAGS)!r}, 1.", "*INITIAL CONDITIONS, TYPE=TEMPERATURE", "ALL, 0."]
    files["dragged"] = [*lines, *law, *cold, *step(COUPLED, f"1., {float(DRAGS)!r}", moved)[2:]], more

    # Each bar has one temperature by equations: a lumped capacity, whatever its mesh.
    lines, lower, upper = bars(OVERLAP)
    law, more = contact(lower, upper, {"heat": {"conductance": H}})
    one = [line for block in (lower, upper) for n in block.nodes[1:] for line in ("*EQUATION", "2", f"{n[0]}, 11, 1., {block.nodes[0][0]}, 11, -1.")]
    begins = ["*INITIAL CONDITIONS, TYPE=TEMPERATURE", "LOWERNODES, 0.", f"UPPERNODES, {HOT!r}"]
    timed = step("*HEAT TRANSFER, DIRECT", f"{STEP!r}, {STEP * STEPS!r}", [])
    files["equalizes"] = [*lines, *law, *one, *begins, *timed[2:]], more

    for name, (lines, more) in files.items():
        folder = out / name
        folder.mkdir(parents=True, exist_ok=True)
        for file, text in {"job.inp": "\n".join(lines) + "\n", **more}.items():
            (folder / file).write_text(text)


def results(folder):
    """Of each print request, increment by increment: {name and set: [rows]}; a total is a row of its own. And iterations of each increment."""
    found, rows = {}, None
    for line in (folder / "job.dat").read_text().splitlines():
        head = re.match(r"\s*(.+?) for set (\w+) and time", line)
        if head:
            rows = found.setdefault((head[1].split()[0], head[2]), [])
            rows.append([])
        elif line.split() and rows is not None:
            rows[-1].append([float(word) for word in line.split()])
    table = [line.split() for line in (folder / "job.sta").read_text().splitlines()]
    return found, [int(words[3]) for words in table if len(words) >= 4 and words[0].isdigit()]


def corrections(folder):
    """Of the temperatures, in each iteration, as a share of their increment."""
    rows = [line.split() for line in (folder / "job.cvg").read_text().splitlines()]
    return [float(words[-1]) / 100 for words in rows if len(words) == 9 and words[0].isdigit()]


class Report:
    ok = True

    def line(self, what, worst, bound, iterations):
        print(f"{what:<64}  {worst:<8.1e} {'<=' if worst <= bound else '> '} {bound:.0e}   {' '.join(map(str, iterations))}")
        self.ok = self.ok and worst <= bound


def worst_of(values, exact, scale=None):
    return max(abs(value - exact) for value in values) / abs(scale or exact)


def bars_line(report, what, folder, conductance):
    found, iterations = results(folder)
    rise = POWER * (LOW / K_LOW + HIGH / K_HIGH + 1 / conductance) / AREA
    top = [row[1] for row in found["temperatures", "TOP"][-1]]
    out = found["total", "FLOOR"][-1][0][-1]
    report.line(what, max(worst_of(top, FLOOR + rise, rise), worst_of([out], -POWER)), PRINTED, iterations)
    return top, iterations


def compare(out):
    report = Report()
    print("                                                                  error       bound   iterations of each increment")
    bars_line(report, "two bars, T_in + q R, and q: *HEAT TRANSFER", out / "conducts", H)
    report.line("what its second iteration still corrects: the first one solves it", corrections(out / "conducts")[1], ROUNDED, [])
    pressure = PUSHED / ((LOW + HIGH) / YOUNG + 1 / PENALTY)
    bars_line(report, "the same, h = 4 (p / 2)^0.95: coupled", out / "pressed",
              POWER_LAW["coefficient"] * (pressure / POWER_LAW["pressure"]) ** POWER_LAW["exponent"])
    assert 1 < pressure < 4
    by_table = 3.0 + (pressure - 1) * 2.0
    mine, _ = bars_line(report, "the same, a table over the pressure", out / "table", by_table)
    theirs, iterations = bars_line(report, "the same in ccx's own contact", out / "native", by_table)
    report.line("U1E and ccx's own *GAP CONDUCTANCE", worst_of(mine, theirs[0]), PRINTED, iterations)

    found, iterations = results(out / "dragged")
    power = SHARE * MU * LOAD * SPEED
    for name, part in (("TOP", SLAVE), ("FLOOR", 1 - SLAVE)):
        report.line(f"dragged: {part:.0%} of {SHARE} mu N v enters the {'slave' if name == 'TOP' else 'master'}",
                    worst_of([found["total", name][-1][0][-1]], -part * power), PRINTED, iterations)

    # Backward Euler of two lumped capacities: the difference falls by a factor an increment.
    found, iterations = results(out / "equalizes")
    c_low, c_high = CAPACITY_LOW * AREA * LOW, CAPACITY_HIGH * AREA * HIGH
    mean = HOT * c_high / (c_low + c_high)
    factor = 1 / (1 + STEP * H * AREA * (1 / c_low + 1 / c_high))
    worst = 0.0
    for i in range(STEPS):
        difference = HOT * factor ** (i + 1)
        for name, share in (("UPPERNODES", c_low), ("LOWERNODES", -c_high)):
            worst = max(worst, worst_of([row[1] for row in found["temperatures", name][i]], mean + difference * share / (c_low + c_high), HOT))
    report.line("two bars equalize, backward Euler's factor an increment", worst, PRINTED, iterations)
    return report.ok


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("write", "compare"):
        sys.exit(__doc__)
    out = pathlib.Path(sys.argv[2])
    if sys.argv[1] == "write":
        write(out)
    elif not compare(out):
        sys.exit("heat through U1E is not what it should be")


if __name__ == "__main__":
    main()
