"""host_heat.py ENTS-HOST: two bars with temperatures, one on the other, against their exact solution in one dimension: a conductance that is constant, and
one that depends on the pressure that thermal expansion makes. And a block that is dragged: friction heats it and what it lies on by mu N v."""
import base64
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

LENGTHS, CONDUCTIVITIES, WARM, COLD, START = (1.0, 0.5), (2.0, 5.0), 120.0, 20.0, 30.0
YOUNG, EXPANSION, STIFFNESS = 1000.0, 1e-3, 1e5
failures, worst = [], {}


def scene(dimension, heat, master):
    def axis(low, high, n):
        return {"from": low, "pieces": [{"to": high, "divisions": n}]}

    def part(name, low, high, across, along):
        axes = {"x": axis(0, 1, across), "y": axis(low, high, along)} if dimension == 2 else {
            "x": axis(0, 1, across), "y": axis(0, 1, across + 1), "z": axis(low, high, along)}
        return {"name": name, "material": name, "element": "quad4" if dimension == 2 else "hex8", **axes}
    up = "xyz"[dimension - 1]
    body = {"law": "linear_elastic", "young": YOUNG, "poisson": 0, "expansion": EXPANSION}
    held = {name: 0 for name in "xyz"[:dimension - 1]}
    rigid = {"nodes": [[1.5, 0], [-0.5, 0]] if dimension == 2 else [[-1, -1, 0], [-1, 2, 0], [2, 2, 0], [2, -1, 0]], "direction": [0] * (dimension - 1) + [-1],
             "temperature": COLD}
    parts = [part("low", -LENGTHS[0], 0, 2, 4)] + ([] if master == "rigid" else [part("high", 0, LENGTHS[1], 2, 2)])
    contact = {"slave": f"low.{up}_max", "master": rigid if master == "rigid" else {"faces": f"high.{up}_min"},
               "model": {"segment": "line2" if dimension == 2 else "quad4", "contact": {"normal": {"type": "penalty", "stiffness": STIFFNESS}, "heat": heat}}}
    supports = [{"nodes": f"low.{up}_min", up: 0, "temperature": WARM}]
    for one in parts:
        supports.append({"nodes": one["name"], **held})
    if master != "rigid":
        supports.append({"nodes": f"high.{up}_max", up: 0, "temperature": COLD})
        contact["sampling"] = 2
    return {"dimension": dimension, **({"formulation": "plane_strain"} if dimension == 2 else {}), "temperature": START,
            "materials": {"low": {**body, "conductivity": CONDUCTIVITIES[0]}, "high": {**body, "conductivity": CONDUCTIVITIES[1]}}, "parts": parts,
            "supports": supports, "contact": contact, "steps": {"control": "load_factor", "values": [1]}}


def exact(conductance, bars):
    """Power and pressure per area of bars between walls: T is linear in each, the sum of all lengths stays."""
    def state(pressure):
        resistance = sum(LENGTHS[i] / CONDUCTIVITIES[i] for i in range(bars)) + 1 / conductance(pressure)
        flow = (WARM - COLD) / resistance
        first = WARM - flow * LENGTHS[0] / CONDUCTIVITIES[0]
        means = [(WARM + first) / 2, (first - flow / conductance(pressure) + COLD) / 2]
        grown = sum(EXPANSION * (means[i] - START) * LENGTHS[i] for i in range(bars))
        return flow, grown / (sum(LENGTHS[:bars]) / YOUNG + 1 / STIFFNESS)
    low, high = 1e-9, 1e3
    for _ in range(200):  # the pressure that the state makes falls or rises less than it does
        middle = (low + high) / 2
        low, high = (middle, high) if state(middle)[1] > middle else (low, middle)
    return state(low)[0], low


SHARE, TO_SLAVE, MU, WAY, PRESSED, DURATIONS = 0.9, 0.3, 0.2, 0.3, 0.01, (1.0, 0.5, 0.5, 2.0)


def dragged(conductance, master, durations):
    """A block of width 2 on another one of width 6, or on a rigid segment: the first step presses, each of the next drags by WAY."""
    def part(name, x, y):
        axes = {axis: {"from": low, "pieces": [{"to": high, "divisions": n}]} for axis, (low, high, n) in (("x", x), ("y", y))}
        return {"name": name, "material": name, "element": "quad4", **axes}
    steps = range(1, len(DURATIONS) + 1)
    body = {"law": "linear_elastic", "young": YOUNG, "poisson": 0}
    return {"dimension": 2, "formulation": "plane_strain", "temperature": COLD,
            "materials": {"block": {**body, "conductivity": CONDUCTIVITIES[0]}, "ground": {**body, "conductivity": CONDUCTIVITIES[1]}},
            "parts": [part("block", (0, 2, 4), (0, LENGTHS[0], 2)), part("ground", (-1, 5, 20), (-LENGTHS[1], 0, 2))],
            "supports": [{"nodes": "block.y_max", "y": -PRESSED, "path": [[0, 0], [1, 1]]}, {"nodes": "block.y_max", "temperature": COLD},
                         {"nodes": "block.y_max", "x": WAY, "path": [[i, i - 1] for i in steps]},
                         {"nodes": "ground", "x": 0, "y": 0}, {"nodes": "ground.y_min", "temperature": COLD}],
            "contact": {"slave": "block.y_min",
                        "master": {"faces": "ground.y_max"} if master == "faces" else {"nodes": [[-1, 0], [5, 0]], "direction": [0, 1], "temperature": COLD},
                        "model": {"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": STIFFNESS},
                                                                  "friction": {"type": "coulomb", "coefficient": MU, "stiffness": STIFFNESS},
                                                                  "heat": {"conductance": conductance, "friction": {"share": SHARE, "slave": TO_SLAVE}}}}},
            "steps": {"control": "load_factor", "values": list(steps), "duration": durations}}


def powers(folder, step):
    """Power that leaves the block through its upper and the ground through its lower side, which are cold. The mean of the temperature over a body's
    width is linear in its height, wherever heat enters the other side."""
    text = sorted((folder / "out").rglob("*bulk*.vtu"))[step].read_text()

    def array(name):
        content = base64.b64decode(re.search(rf'<DataArray[^>]*Name="{name}"[^>]*>([^<]*)<', text)[1])[8:]
        return struct.unpack(f"<{len(content) // 8}d", content)
    places, warm = array("Points"), array("temperature")
    nodes, result = [(places[3 * k], places[3 * k + 1], warm[k]) for k in range(len(warm))], []
    for own, wide, length, conductivity in zip((nodes[:15], nodes[15:]), (2.0, 6.0), LENGTHS, CONDUCTIVITIES):
        row = sorted((x, t) for x, y, t in own if y == 0)
        mean = sum(t * (0.5 if k in (0, len(row) - 1) else 1) for k, (_, t) in enumerate(row)) / (len(row) - 1)
        result.append((mean - COLD) * conductivity * wide / length)
    return result


def check_friction(host, folder):
    for master, conductance, iterations in (("faces", 0, 25), ("faces", 10, 25), ("rigid", 0, 25), ("rigid", 10, 3)):
        name = f"dragged, {master}, conductance {conductance}"
        text = dragged(conductance, master, list(DURATIONS))
        text["solver"] = {"max_iterations": iterations}
        done = run(host, text, folder)
        expect(done.returncode == 0, f"{name}: {done.stderr}")
        if done.returncode:
            continue
        steps = json.loads((folder / "out" / "result.json").read_text())["steps"]
        for i in (2, 3):  # in the step before the block shears
            made = SHARE * MU * sum(x * x for x in steps[i]["resultants"]["normal"]) ** 0.5 * WAY / DURATIONS[i]
            through, (block, ground) = steps[i]["heat"], powers(folder, i)
            wanted = [(steps[i]["friction_heat"], made, "friction_heat"), (block, TO_SLAVE * made - through, "the block")]
            if master == "faces":
                wanted.append((ground, (1 - TO_SLAVE) * made + through, "the ground"))
            expect(made > 0.3 and (through > 0.1 * made if conductance else through == 0), f"{name}: powers {made}, {through}")
            expect(bool(steps[i]["cuts"]) == (iterations == 3), f"{name}: parts of steps were tried: {steps[i]['cuts']}")
            for value, exact_value, what in wanted:
                measure("a dragged block, powers", abs(value - exact_value) / made, 1e-10, f"{name}, step {i + 1}, {what}: {value}, exact {exact_value}")
    for durations, words in (([1, 1, 0, 1], "/steps/duration: times above 0"), ([1, 1], "/steps/duration")):
        done = run(host, dragged(1, "rigid", durations), folder)
        expect(done.returncode == 2 and words in done.stderr, f"{done.returncode}: {done.stderr} (wanted: {words})")


def expect(holds, text):
    if not holds:
        failures.append(text)


def measure(what, error, bound, text):
    worst[what] = (max(error, worst.get(what, (0, 0))[0]), bound)
    expect(error < bound, text)


def run(host, text, folder):
    (folder / "scene.json").write_text(json.dumps(text))
    return subprocess.run([host, "run", folder / "scene.json", "--out", folder / "out"], capture_output=True, text=True, check=False)


def main():
    host = pathlib.Path(sys.argv[1])
    laws = (({"conductance": 10}, lambda p: 10.0), ({"power": {"coefficient": 8, "pressure": 20, "exponent": 0.95}}, lambda p: 8 * (p / 20) ** 0.95))
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for dimension in (2, 3):
            for master in ("faces", "rigid"):
                for heat, conductance in laws:
                    name = f"{dimension}D, {master}, {next(iter(heat))}"
                    done = run(host, scene(dimension, heat, master), folder)
                    expect(done.returncode == 0, f"{name}: {done.stderr}")
                    if done.returncode:
                        continue
                    step = json.loads((folder / "out" / "result.json").read_text())["steps"][-1]
                    flow, pressure = exact(conductance, 2 if master == "faces" else 1)
                    measure(f"two bars, {next(iter(heat))}, power", abs(step["heat"] / flow - 1), 1e-10, f"{name}: power {step['heat']}, exact {flow}")
                    measure(f"two bars, {next(iter(heat))}, pressure", abs(step["peak_pressure"] / pressure - 1), 1e-10,
                            f"{name}: pressure {step['peak_pressure']}, exact {pressure}")
                    if name.endswith("conductance"):
                        expect(step["iterations"] <= 2, f"{name}: a linear problem takes {step['iterations']} iterations")
        for change, words in (({"materials": {"low": {"law": "linear_elastic", "young": 1, "poisson": 0}}}, "give each of /materials a \"conductivity\""),
                              ({"materials": {"low": {"law": "neo_hooke", "young": 1, "poisson": 0, "conductivity": 1, "expansion": 1}}}, "expansion is for linear_elastic"),
                              ({"materials": {"low": {"law": "linear_elastic", "young": 1, "poisson": 0, "expansion": 1}}}, "give its \"conductivity\"")):
            wrong = scene(2, {"conductance": 1}, "rigid")
            wrong.pop("temperature")
            wrong["supports"] = [{"nodes": "low", "x": 0, "y": 0}]
            wrong["contact"]["master"].pop("temperature")
            done = run(host, {**wrong, **change}, folder)
            expect(done.returncode == 2 and words in done.stderr, f"{done.returncode}: {done.stderr} (wanted: {words})")
        check_friction(host, folder)
    for what, (error, bound) in worst.items():
        print(f"{what}: {error:.1e}, bound {bound:.0e}")
    for text in failures:
        print(text, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
