"""host_heat.py ENTS-HOST: two bars with temperatures, one on the other, against their exact solution in one dimension: a conductance that is constant, and
one that depends on the pressure that thermal expansion makes."""
import json
import pathlib
import subprocess
import sys
import tempfile

LENGTHS, CONDUCTIVITIES, WARM, COLD, START = (1.0, 0.5), (2.0, 5.0), 120.0, 20.0, 30.0
YOUNG, EXPANSION, STIFFNESS = 1000.0, 1e-3, 1e5
failures = []


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


def expect(holds, text):
    if not holds:
        failures.append(text)


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
                    # residuals end at 1e-10 of the forces and flows present
                    expect(abs(step["heat"] / flow - 1) < 1e-8, f"{name}: power {step['heat']}, exact {flow}")
                    expect(abs(step["peak_pressure"] / pressure - 1) < 1e-8, f"{name}: pressure {step['peak_pressure']}, exact {pressure}")
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
        rubbed = scene(2, {"conductance": 1, "friction": {"share": 1}}, "faces")
        rubbed["contact"]["model"]["contact"]["friction"] = {"type": "coulomb", "coefficient": 0.1, "stiffness": 10}
        done = run(host, rubbed, folder)
        expect(done.returncode == 2 and "friction heats in time" in done.stderr, done.stderr)
    for text in failures:
        print(text, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
