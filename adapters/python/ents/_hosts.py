# SPDX-License-Identifier: BSD-3-Clause
"""usage: python3 -m ents hosts MODEL.json [--slave-nodes N]

Prints what a model file wants of an element of each host: nodes, history variables, and the line of the deck that declares them.

  --slave-nodes N  the slave is a point inside a face of N nodes [1]

A rigid body (lines "body" in ents_k.txt) takes the place of the master nodes: see adapters/README.md.

exit status: 0 done; 1 the model is refused; 2 wrong command line"""
import sys

import ents


def lines(model, slave_nodes=1):
    """[(host, line of its deck)] of an ents.Model."""
    layout = model.layout
    d, nodes, states = layout.dimension, slave_nodes + layout.nodes + (layout.multipliers > 0), layout.state_size
    unsymmetric = "" if layout.symmetric_tangent else ", UNSYMM"
    element = f"NODES={nodes}, COORDINATES={d}, PROPERTIES=3, VARIABLES={states}"
    temperatures = "; below it " + ", ".join(map(str, [*range(1, d + 1), 11])) if layout.heat else ""
    found = [("Abaqus/Standard, UEL", f"*USER ELEMENT, TYPE=U101, {element}{unsymmetric}{temperatures}")]
    if layout.nodes == 2 * (d - 1) and not layout.multipliers:
        found.append(("Abaqus/Standard, UINTER", f"*SURFACE INTERACTION, NAME=ENTS, USER, DEPVAR={3 + states}, PROPERTIES=3{unsymmetric}"))
    calculix = ("CalculiX", f"*DEPVAR {states}" + ("" if nodes <= 20 else "; 20 nodes an element is ccx's limit"))
    if layout.heat:
        return found + [calculix, ("other hosts", "refused: their elements carry no temperatures")]
    if not layout.multipliers:
        found.append(("Abaqus/Explicit", f"*USER ELEMENT, TYPE=VU101, {element}"))
    found.append(calculix)
    found.append(("Ansys", f"USRELEM,{nodes},{d},ANYSHAPE,3,{states},0,0,1,0,{0 if layout.symmetric_tangent else 1}"))
    found.append(("Marc", f"STATE VARS, {states}"))
    if d == 3 and nodes <= 8 and not layout.multipliers:
        found.append(("LS-DYNA", f"NIP = 0, NXDOF = 0, LMC = 3, NHSV = {states}"))
    return found + [("FEAP, OpenSees", "they ask the model")]


def main(arguments):
    if arguments in (["-h"], ["--help"]):
        print(__doc__)
        return 0
    slave_nodes = 1
    if len(arguments) == 3 and arguments[1] == "--slave-nodes" and arguments[2].isdigit() and int(arguments[2]):
        slave_nodes = int(arguments[2])
    elif len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        model = ents.Model(arguments[0])
    except (ents.Error, OSError) as error:
        print(f"{arguments[0]}: {error}", file=sys.stderr)
        return 1
    layout = model.layout
    print(f"{layout.dimension}D, {layout.nodes} master nodes, {layout.state_size} history variables, {layout.multipliers} multipliers as unknowns, "
          f"{'symmetric' if layout.symmetric_tangent else 'unsymmetric'} stiffness")
    for host, line in lines(model, slave_nodes):
        print(f"{host:24} {line}")
    return 0
