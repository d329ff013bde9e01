# SPDX-License-Identifier: BSD-3-Clause
"""Decks of both models for CalculiX: materials, contact pairs, the two steps."""
from joint_parts import POISSON, YOUNG

STEPS = ("tightened", "plate embedded")
BEARINGS = [("HEAD", "PLATE_HEAD"), ("NUT", "PLATE_NUT")]
BEARING_STIFFNESS = 1e6  # N/mm^3, of all contacts that have a mesh of their own


def solids(mesh, joint):
    """Sections: the shank and the plate shrink along the axis, by one temperature each."""
    low = joint.threaded[0]
    shrink = {"SHANK": joint.stretch / (joint.grip + low), "PLATE": joint.embedding / joint.grip}
    lines = []
    for owner in sorted({owner for owner, _ in mesh.elements}):
        young = YOUNG / (1 - (joint.bolt_ridge - joint.nut_ridge) / low) if owner == "FREE" else YOUNG
        lines += [f"*MATERIAL, NAME={owner}", "*ELASTIC", f"{young:.8g}, {POISSON}", "*EXPANSION, TYPE=ORTHO, ZERO=0.", f"0., 0., {shrink.get(owner, 0.):.10g}",
                  f"*SOLID SECTION, ELSET={owner}, MATERIAL={owner}"]
    return lines


def step(name, temperatures, output):
    return ["*STEP, INC=40", f"** {name}", "*STATIC", "1., 1.", "*TEMPERATURE"] + temperatures + output + ["*END STEP"]


def deck(mesh, joint, kinds, pairs, output):
    """`pairs`: slave and master of the contacts, frictionless."""
    nodes = {}
    for (owner, _), group in mesh.elements.items():
        nodes.setdefault("PLATE" if owner == "PLATE" else "NUT" if owner == "NUT" else "BOLT", set()).update(n for _, of in group for n in of)
    mesh.sets["WARM_BOLT"], mesh.sets["WARM_PLATE"] = nodes["BOLT"], nodes["PLATE"]
    lines = [mesh.deck(kinds).rstrip("\n")] + solids(mesh, joint)
    if "CORE" in mesh.surfaces:
        lines += ["*SURFACE, NAME=INSIDE, TYPE=NODE", "INSIDE", "*TIE, NAME=CORE, POSITION TOLERANCE=0.2, ADJUST=NO", "INSIDE, CORE"]
    lines += ["*SURFACE INTERACTION, NAME=HARD", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{BEARING_STIFFNESS:g}"]
    for slave, master in pairs:
        lines += ["*CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE", f"{slave}, {master}"]
    for n in mesh.held:
        x, y, _ = mesh.nodes[n - 1]
        terms = sorted(((n, 1, -y), (n, 2, x)), key=lambda term: -abs(term[2]))
        lines += ["*EQUATION", "2", ", ".join(f"{node}, {dof}, {factor:.10g}" for node, dof, factor in terms)]
    lines += ["*BOUNDARY", "HOLD_Z, 3, 3", "*INITIAL CONDITIONS, TYPE=TEMPERATURE", "ALL, 0."]
    lines += step(STEPS[0], ["WARM_BOLT, -1."], output)
    lines += step(STEPS[1], ["WARM_PLATE, -1."], output)
    return "\n".join(lines) + "\n"


def prints(pairs):
    return [line for slave, master in pairs for line in (f"*CONTACT PRINT, SLAVE={slave}, MASTER={master}", "CF")]


def explicit_deck(mesh, joint):
    pairs = BEARINGS + [(name, "BOLT") for name in mesh.surfaces if name.startswith("PART")]
    return deck(mesh, joint, {6: "C3D6", 8: "C3D8I"}, pairs, ["*NODE FILE", "U", "*EL FILE", "S"] + prints(pairs))


def enriched_deck(mesh, joint):
    """Without the contact of the threads, which ents-deck adds."""
    return deck(mesh, joint, {6: "C3D6", 8: "C3D8I"}, BEARINGS, ["*NODE PRINT, NSET=ALL", "U", "*NODE FILE", "U", "*EL FILE", "S"] + prints(BEARINGS))
