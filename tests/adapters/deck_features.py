# SPDX-License-Identifier: BSD-3-Clause
"""Small decks in Abaqus' syntax, one for each feature of contact: DECKS[name] = text, what comes of it, whether ccx reads it as well.

What comes of it: "" translated, else a part of the reason for which it is refused."""

FLAT = """** two cubes, the upper one pressed by 0.01 and moved by 0.02, 0.08 from its edge
*NODE, NSET=NALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
11, 0.1, 0.1, 1.
12, 0.9, 0.1, 1.
13, 0.9, 0.9, 1.
14, 0.1, 0.9, 1.
15, 0.1, 0.1, 2.
16, 0.9, 0.1, 2.
17, 0.9, 0.9, 2.
18, 0.1, 0.9, 2.
*ELEMENT, TYPE=C3D8, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=UPPER
2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=BOTTOM
1, 2, 3, 4
*NSET, NSET=TOP
15, 16, 17, 18
*SURFACE, NAME=SLAVE, TYPE=ELEMENT
UPPER, S1
*SURFACE, NAME=MASTER, TYPE=ELEMENT
LOWER, S2
*MATERIAL, NAME=STEEL
*ELASTIC
1000., 0.
*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL
*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL
*SURFACE INTERACTION, NAME=I1
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
20000.
*FRICTION
0.3
*CONTACT PAIR, INTERACTION=I1, TYPE=SURFACE TO SURFACE
SLAVE, MASTER
*BOUNDARY
BOTTOM, 1, 3
TOP, 2, 2
*STEP, NLGEOM
*STATIC
0.1, 1., 1e-5, 0.1
*BOUNDARY
TOP, 3, 3, -0.01
TOP, 1, 1, 0.02
*NODE PRINT, NSET=BOTTOM, TOTALS=ONLY
RF
*END STEP
"""

PARTS = """*Heading
** Two instances of one part, as Abaqus/CAE writes them.
*Part, name=Block
*Node
      1,           0.,           0.,           0.
      2,           1.,           0.,           0.
      3,           1.,           1.,           0.
      4,           0.,           1.,           0.
      5,           0.,           0.,           1.
      6,           1.,           0.,           1.
      7,           1.,           1.,           1.
      8,           0.,           1.,           1.
*Element, type=C3D8R
1, 1, 2, 3, 4, 5, 6, 7, 8
*Elset, elset=Set-1
 1,
*Solid Section, elset=Set-1, material=Steel
,
*End Part
*Assembly, name=Assembly
*Instance, name=Block-1, part=Block
*End Instance
*Instance, name=Block-2, part=Block
          0.,           0.,           1.
*End Instance
*Nset, nset=Fix, instance=Block-1
 1, 2, 3, 4
*Nset, nset=Press, instance=Block-2
 5, 6, 7, 8
*Elset, elset=_Top_S2, internal, instance=Block-1
 1,
*Surface, type=ELEMENT, name=Top
_Top_S2, S2
*Elset, elset=_Low_S1, internal, instance=Block-2
 1,
*Surface, type=ELEMENT, name=Low
_Low_S1, S1
*End Assembly
*Amplitude, name=Amp-1
 0., 0., 1., 1.
*Time Points, name=T, GENERATE
0., 1., 0.5
*Material, name=Steel
*Elastic
1000., 0.3
*Surface Interaction, name="Int Prop-1"
1.,
*Friction, slip tolerance=0.005
 0.3,
*Surface Behavior, pressure-overclosure=HARD
*Contact Pair, interaction="Int Prop-1", small sliding, type=SURFACE TO SURFACE, adjust=0.0
Low, Top
*Step, name=Step-1, nlgeom=YES, unsymm=YES
*Static
0.1, 1., 1e-05, 1.
*Boundary, amplitude=Amp-1
Fix, ENCASTRE
*Boundary, amplitude=Amp-1
Press, 3, 3, -0.01
*Restart, write, frequency=0
*Output, field, time points=T
*Node Output
U, RF
*Contact Output
CSTRESS, CDISP
*End Step
"""

PAIR = ", TYPE=SURFACE TO SURFACE"
LAW = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n20000.\n"
FRICTION = "*FRICTION\n0.3\n"
STATIC = "*STATIC\n0.1, 1., 1e-5, 0.1\n"
SLAVE = "*SURFACE, NAME=SLAVE, TYPE=ELEMENT\nUPPER, S1\n"
MASTER = "*SURFACE, NAME=MASTER, TYPE=ELEMENT\nLOWER, S2\n"
MOVED = "*BOUNDARY\nTOP, 3"

# name: what is replaced, by what, what comes of it ("": translated), whether ccx reads it as well and means the same: its exponential
# law is another one, it has no line that goes on, no TAUMAX, no clearance.
FEATURES = {
    "as_it_is": ("", "", "", True),
    "frictionless": (FRICTION, "", "", True),
    "friction_zero": (FRICTION, "*FRICTION\n0.,\n", "", False),
    # *CONTACT PAIR
    "pair_without_type": (PAIR, "", "", False),
    "pair_nodes": (PAIR, ", TYPE=NODE TO SURFACE", "", True),
    "pair_small_sliding": (PAIR, PAIR + ", SMALL SLIDING", "", False),
    "pair_adjust": (PAIR, PAIR + ", ADJUST=0.1", "", True),
    "pair_adjust_set": (PAIR, PAIR + ", ADJUST=TOP", "", False),
    "pair_tracking": (PAIR, PAIR + ", TRACKING=STATE, NO THICKNESS", "", False),
    "pair_supplementary": (PAIR, PAIR + ", SUPPLEMENTARY CONSTRAINTS=NO", "", False),
    "pair_smooth": (PAIR, ", TYPE=NODE TO SURFACE, SMOOTH=0.2", "", False),
    "pair_tied": (PAIR, PAIR + ", TIED, ADJUST=0.1", "ties the surfaces", False),
    "pair_hcrit": (PAIR, PAIR + ", HCRIT=0.1", "penetration_limit", False),
    "pair_extension": (PAIR, PAIR + ", EXTENSION ZONE=0.1", "border", False),
    "pair_geometric": (PAIR, PAIR + ", GEOMETRIC CORRECTION=ROUND", "true shape", False),
    "pair_explicit": (PAIR, ", MECHANICAL CONSTRAINT=PENALTY, WEIGHT=0.5", "is not known, and what it changes would be lost", False),
    "pair_itself": ("SLAVE, MASTER\n", "SLAVE,\n", "contact of a surface with itself", False),
    "pair_directions": ("SLAVE, MASTER\n", "SLAVE, MASTER, OR1, OR2\n", "same in all directions", False),
    "pair_of_a_step": (STATIC, STATIC + "*CONTACT PAIR, INTERACTION=I1\nSLAVE, MASTER\n", "stands behind *STEP", False),
    "pair_abbreviated": (PAIR, PAIR + ", SMALL", "is not known", False),
    "pair_quoted": ("NAME=I1", 'NAME="I1"', "", False),
    "pair_continued": (PAIR, ",\n TYPE=SURFACE TO SURFACE", "", False),
    "pair_spelled": ("*CONTACT PAIR, INTERACTION=I1", "*contactpair , interaction = i1", "", True),
    "general_contact": ("*CONTACT PAIR, INTERACTION=I1" + PAIR + "\nSLAVE, MASTER\n",
                        "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n, , I1\n", "*CONTACT: general contact", False),
    # *SURFACE
    "surface_free_faces": (SLAVE, SLAVE.replace("UPPER, S1", "UPPER,"), "", False),
    "surface_of_nodes": (SLAVE, "*SURFACE, NAME=SLAVE, TYPE=NODE\n11, 0.16\n12, 0.16\n13, 0.16\n14, 0.16\n", "", False),
    "surface_of_a_node_set": (SLAVE, "*NSET, NSET=LOW\n11, 12, 13, 14\n*SURFACE, NAME=SLAVE, TYPE=NODE\nLOW,\n", "", False),
    "surface_trimmed": (SLAVE, SLAVE.replace("\nUPPER", ", TRIM=YES, MAX RATIO=2.\nUPPER"), "", False),
    "surface_combined": (SLAVE, SLAVE.replace("SLAVE", "S") + "*SURFACE, NAME=SLAVE, COMBINE=UNION\nS\n", "COMBINE", False),
    "surface_cropped": (SLAVE, SLAVE.replace("SLAVE", "S") + "*SURFACE, NAME=SLAVE, CROP\nS\n0., 0., 0., 1., 1., 1.\n", "CROP", False),
    "surface_analytical": (MASTER, "*SURFACE, NAME=MASTER, TYPE=CYLINDER\n0., 0., 1., 1., 0., 1.\nSTART, -1., 1.\nLINE, 2., 1.\n", "analytical", False),
    "surface_edges": (SLAVE, SLAVE.replace("S1", "EDGE"), "expected a face S1 .. S6", False),
    "surface_entry": (SLAVE, SLAVE.replace("S1", "S1, 0.5"), "entry 3", False),
    "surface_of_pores": ("TYPE=C3D8, ELSET=UPPER", "TYPE=C3D8P, ELSET=UPPER", "pore pressure", False),
    "surface_of_shells": ("*ELEMENT, TYPE=C3D8, ELSET=UPPER\n2, 11, 12, 13, 14, 15, 16, 17, 18",
                          "*ELEMENT, TYPE=S4, ELSET=UPPER\n2, 11, 12, 13, 14", "half a thickness", False),
    "surface_of_cohesives": ("TYPE=C3D8, ELSET=UPPER", "TYPE=COH3D8, ELSET=UPPER", "no faces that are known", False),
    "hybrid_elements": ("TYPE=C3D8, ELSET=UPPER", "TYPE=C3D8RH, ELSET=UPPER", "", False),
    "sets_abbreviated": ("*NSET, NSET=TOP\n15, 16, 17, 18", "*NSET, NSET=TOP, GEN\n15, 18, 1", "is GENERATE meant?", False),
    "sets_generated": ("*NSET, NSET=TOP\n15, 16, 17, 18", "*NSET, NSET=TOP, GENERATE\n15, 18, 1", "", True),
    "nodes_copied": ("*MATERIAL", "*NCOPY, OLD SET=NALL, NEW SET=N2, CHANGE NUMBER=100, SHIFT\n0., 0., 2.\n*MATERIAL", "changes the mesh", False),
    # *SURFACE INTERACTION and what is below it
    "interaction_area": ("NAME=I1\n", "NAME=I1\n1.,\n", "", False),
    "interaction_other_area": ("NAME=I1\n", "NAME=I1\n0.5,\n", "thickness or area", False),
    "interaction_user": ("NAME=I1\n", "NAME=I1, USER, PROPERTIES=2\n", "subroutine of your own", False),
    "interaction_padded": ("NAME=I1\n", "NAME=I1, PAD THICKNESS=0.1\n", "constant \"height\"", False),
    "law_hard": (LAW, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n", "", True),
    "law_missing": (LAW, "", "", False),
    "law_direct": (LAW, "*SURFACE BEHAVIOR, DIRECT\n", "", False),
    "law_penalty": (LAW, "*SURFACE BEHAVIOR, PENALTY\n20000.\n", "", False),
    "law_penalty_clearance": (LAW, "*SURFACE BEHAVIOR, PENALTY=LINEAR\n20000., 0.001\n", "", False),
    "law_penalty_factor": (LAW, "*SURFACE BEHAVIOR, PENALTY\n, , 0.5\n", "", False),
    "law_penalty_nonlinear": (LAW, "*SURFACE BEHAVIOR, PENALTY=NONLINEAR\n", "grows with the penetration", False),
    "law_augmented": (LAW, "*SURFACE BEHAVIOR, AUGMENTED LAGRANGE\n", "", False),
    "law_no_separation": (LAW, "*SURFACE BEHAVIOR, NO SEPARATION\n", "", False),
    "law_exponential": (LAW, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n0.001, 5.\n", "", False),
    "law_straight_table": (LAW, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n0., 0.\n20., 0.001\n", "", False),
    "law_bent_table": (LAW, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n0., 0.\n1., 0.001\n20., 0.002\n", "not a straight line", False),
    "law_scale_factor": (LAW, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=SCALE FACTOR\n0.1\n", "SCALE FACTOR", False),
    "law_depends": (LAW, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR, DEPENDENCIES=1\n20000.\n", "DEPENDENCIES", False),
    "law_abbreviated": ("*SURFACE BEHAVIOR", "*SURFACE BEHAV", "is *SURFACE BEHAVIOR meant?", False),
    "law_expression": ("20000.", "<k>", "expected a number", False),
    "friction_rough": (FRICTION, "*FRICTION, ROUGH\n", "", False),
    "friction_taumax": (FRICTION, "*FRICTION, TAUMAX=1.\n0.3\n", "", False),
    "friction_slip_tolerance": (FRICTION, "*FRICTION, SLIP TOLERANCE=0.005\n0.3,\n", "", False),
    "friction_elastic_slip": (FRICTION, "*FRICTION, ELASTIC SLIP=1e-3\n0.3\n", "", False),
    "friction_lagrange": (FRICTION, "*FRICTION, LAGRANGE\n0.3\n", "stick by a penalty", False),
    "friction_slope": (FRICTION, "*FRICTION, SHEAR TRACTION SLOPE=500.\n0.3\n", "\"stiffness\" of \"friction\"", False),
    "friction_of_rate": (FRICTION, "*FRICTION\n0.3, 0.\n0.2, 1.\n", "", False),
    "friction_of_pressure": (FRICTION, "*FRICTION\n0.3, , 0.\n0.2, , 10.\n", "", False),
    "friction_of_temperature": (FRICTION, "*FRICTION\n0.3, , , 20.\n", "temperature (entry 4)", False),
    "friction_of_fields": (FRICTION, "*FRICTION, DEPENDENCIES=1\n0.3\n", "depends on fields", False),
    "friction_decay": (FRICTION, "*FRICTION, EXPONENTIAL DECAY\n0.3, 0.2, 1.\n", "", False),
    "friction_anisotropic": (FRICTION, "*FRICTION, ANISOTROPIC\n0.3, 0.2\n", "same in all directions", False),
    "friction_user": (FRICTION, "*FRICTION, USER\n", "subroutine of your own", False),
    "friction_twice": (FRICTION, FRICTION + FRICTION, "a second time", False),
    "friction_abbreviated": ("*FRICTION", "*FRIC", "is *FRICTION meant?", False),
    "below_damping": (FRICTION, FRICTION + "*CONTACT DAMPING\n0.1\n", "cannot be had", False),
    "below_cohesion": (FRICTION, FRICTION + "*COHESIVE BEHAVIOR\n", "needs a stiffness K_nn", False),
    "below_cohesion_of_opening": (FRICTION, "*COHESIVE BEHAVIOR\n20000., 0., 0.\n*DAMAGE INITIATION, CRITERION=MAXS\n1., 1., 1.\n"
                                  "*DAMAGE EVOLUTION, TYPE=ENERGY\n0.001\n", "", False),
    "below_cohesion_of_shear": (FRICTION, "*COHESIVE BEHAVIOR\n20000., 100., 100.\n", "K_ss and K_tt", False),
    "below_heat": (FRICTION, FRICTION + "*GAP CONDUCTANCE\n10., 0.\n0., 0.1\n", "COUPLED TEMPERATURE-DISPLACEMENT", False),
    "below_heat_short": (FRICTION, FRICTION + "*GAP CONDUCTANCE\n10., 0.\n", "needs two lines", False),
    "below_current": (FRICTION, FRICTION + "*GAP ELECTRICAL CONDUCTANCE\n10., 0.\n", "cannot be had", False),
    "below_crack": (FRICTION, FRICTION + "*FRACTURE CRITERION, TYPE=VCCT\n1., 1., 1., 1.\n", "cannot be had", False),
    # gaps, initial state
    "clearance": ("*STEP", "*CLEARANCE, SLAVE=SLAVE, MASTER=MASTER, VALUE=0.1\n*STEP", "the gap of a contact element is that of the mesh", False),
    "interference": (STATIC, STATIC + "*CONTACT INTERFERENCE, SHRINK\nSLAVE, MASTER\n", "the gap of a contact element is that of the mesh", False),
    "bonded": ("*STEP", "*INITIAL CONDITIONS, TYPE=CONTACT\nSLAVE, MASTER, TOP\n*STEP", "bonded part", False),
    "debonding": (STATIC, STATIC + "*DEBOND, SLAVE=SLAVE, MASTER=MASTER\n", "not bonded", False),
    "initial_stress": ("*STEP", "*INITIAL CONDITIONS, TYPE=STRESS\nLOWER, 0., 0., 0., 0., 0., 0.\n*STEP", "", False),
    "tied_beside": ("*STEP", "*TIE, NAME=T\nSIDE1, SIDE2\n*STEP", "", False),
    # steps
    "step_dynamic": (STATIC, "*DYNAMIC\n0.1, 1.\n", "", False),
    "step_explicit": (STATIC, "*DYNAMIC, EXPLICIT\n, 1.\n", "Abaqus/Standard", False),
    "step_explicit_heat": (STATIC, "*DYNAMIC TEMPERATURE-DISPLACEMENT, EXPLICIT\n, 1.\n", "Abaqus/Standard", False),
    "step_visco": (STATIC, "*VISCO, CETOL=1e-3\n0.1, 1.\n", "", False),
    "step_riks": (STATIC, "*STATIC, RIKS\n0.1, 1.\n", "arc length", False),
    "step_stabilized": (STATIC, "*STATIC, STABILIZE=1e-6\n0.1, 1.\n", "", False),
    "step_frequency": (STATIC, "*FREQUENCY\n5,\n", "linear step", False),
    "step_buckling": (STATIC, "*BUCKLE\n5,\n", "linear step", False),
    "step_perturbation": ("*STEP, NLGEOM", "*STEP, PERTURBATION", "linear step", False),
    "step_random": (STATIC, "*RANDOM RESPONSE\n1., 10.\n", "linear step", False),
    "step_spectrum": (STATIC, "*RESPONSE SPECTRUM\n", "linear step", False),
    "step_cyclic": (STATIC, "*DIRECT CYCLIC\n0.1, 1.\n", "increments in their order", False),
    "step_rolling": (STATIC, "*STEADY STATE TRANSPORT\n0.1, 1.\n", "increments in their order", False),
    "step_heat": (STATIC, "*COUPLED TEMPERATURE-DISPLACEMENT\n0.1, 1.\n", "", False),
    "step_geostatic": (STATIC, "*GEOSTATIC\n0.1, 1.\n", "", False),
    "step_controls": (STATIC, STATIC + "*CONTACT CONTROLS, STABILIZE\n", "", False),
    "step_output": (STATIC, STATIC + "*OUTPUT, FIELD\n*CONTACT OUTPUT\nCSTRESS\n", "", False),
    "step_pressure": (STATIC, STATIC + "*PRESSURE PENETRATION, SLAVE=SLAVE, MASTER=MASTER\n11, 5, 1.\n", "pressure of a fluid", False),
    "step_remesh": (STATIC, STATIC + "*ADAPTIVE MESH, ELSET=LOWER\n", "nodes that move through the material", False),
    "step_friction_changes": (STATIC, STATIC + "*CHANGE FRICTION, INTERACTION=I1\n*FRICTION\n0.1\n", "for the whole job", False),
    "step_pair_removed": (STATIC, STATIC + "*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\nSLAVE, MASTER\n", "stay for the whole job", False),
    "step_body_removed": (STATIC, STATIC + "*MODEL CHANGE, REMOVE\nUPPER\n", "whose faces are in contact", False),
    "second_step": ("*END STEP\n", "*END STEP\n*STEP, NLGEOM\n*STATIC\n0.1, 1., 1e-5, 0.1\n*BOUNDARY\nTOP, 1, 1, -0.02\n*NODE PRINT, NSET=BOTTOM, TOTALS=ONLY\n"
                    "RF\n*END STEP\n", "", True),
    # motions
    "amplitude": (MOVED, "*AMPLITUDE, NAME=A\n0., 0., 0.5, 0.5, 1., 1.\n*BOUNDARY, AMPLITUDE=A\nTOP, 3", "", False),
    "amplitude_missing": (MOVED, "*BOUNDARY, AMPLITUDE=A\nTOP, 3", "there is no *AMPLITUDE", False),
    "velocity": (MOVED, "*BOUNDARY, TYPE=VELOCITY\nTOP, 3", "", False),
    "motion_expression": ("TOP, 3, 3, -0.01", "TOP, 3, 3, <depth>", "expected a number", False),
}


def changed(name):
    before, after, expected, in_ccx = FEATURES[name]
    if before and FLAT.count(before) < 1:
        raise ValueError(f"{name}: the deck has no {before!r}")
    text = FLAT.replace(before, after, 1) if before else FLAT
    if name == "pair_quoted":
        text = text.replace("INTERACTION=I1", 'INTERACTION="i1"')
    return text, expected, in_ccx


DECKS = {name: changed(name) for name in FEATURES}
DECKS["parts"] = PARTS, "", False
DECKS["parts_of_a_library"] = PARTS.replace("part=Block\n*End", "library=block, instance=Block-1\n*End", 1), "the mesh is in another job", False
DECKS["parts_adjusted"] = PARTS.replace("adjust=0.0", "adjust=0.1").replace("0.,           1.\n*End Instance", "0.,           1.01\n*End Instance"), \
    "whose line belongs to a part", False
