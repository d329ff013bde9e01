# SPDX-License-Identifier: BSD-3-Clause
"""Friction: symmetrised tangents, augmentation, cuts, no friction at all, a cylinder, a skew stack."""
import ents
import numpy as np

from fem import Problem, block, dofs, face_loads
from rows import row, target


def law(coefficient=0.3, stiffness=2e3, normal="penalty", normal_stiffness=1e4, **more):
    friction = {} if coefficient is None else {"friction": {"type": "coulomb", "coefficient": coefficient, "stiffness": stiffness}}
    return {"normal": {"type": normal, "stiffness": normal_stiffness}, **friction, **more}


class Slider:
    """A block of 1 x 0.5 on a rigid wavy line; its top goes down and to the right. E = 1000."""

    def __init__(self, contact_law, **more):
        body = block("quad4", [10, 5], [0, 0], [1, 0.5])
        model = {"segment": "line2", "master": "rigid", "contact": contact_law, "height": {"type": "sine", "amplitude": 0.01, "wave_vector": [0.9]}, **more}
        self.contact = ents.Contact(model, body.positions, body.faces(1, 0), [[0, 1]], master_positions=[[-2, 0], [4, 0]], surface_coordinates="x", reach=0.2)
        self.top = body.where(1, 0.5)
        self.problem = Problem(body.stiffness(1000, 0.3), dofs(self.top, 2), self.contact)

    def step(self, right, down, **options):
        values = np.tile([right, -down], len(self.top))
        return self.problem.solve(values=values, **options)


@row("symmetrised", wrong="the unsymmetric matrix of friction is factorised as a symmetric one", source="FrontISTR #836, !610",
     right='"symmetrised" true and false end in the same solution to 1e-10; K is symmetric in the first case')
def symmetrised(check):
    ends, iterations, skew = [], [], []
    for symmetric in (False, True):
        slider = Slider(law(symmetrised=symmetric))
        for k in range(1, 6):
            slider.step(0.006 * k, 0.012, most=200, tolerance=1e-13)
        k = slider.contact.tangent
        skew.append(abs(k - k.T).max() / abs(k).max())
        ends.append(slider.problem.u.copy())
        iterations.append(slider.problem.iterations)
        on = slider.contact.flags & ents.Flag.CONTACT != 0
        slipping = np.count_nonzero(slider.contact.flags[on] & ents.Flag.SLIP)
    # Both residuals end below 1e-13 of the forces; the smallest eigenvalue of the system is 1e-2 of the largest entry or more.
    check.near("difference of the displacements / largest", 0, np.abs(ends[0] - ends[1]).max() / np.abs(ends[0]).max(), 1e-10)
    check.near("K - K^T, symmetrised", 0, skew[1], 0)
    check.true("K - K^T, not symmetrised", "> 0: friction slips", f"{skew[0]:.2g} of K; {slipping} of {np.count_nonzero(on)} nodes slip", skew[0] > 1e-3)
    check.true("iterations of five steps", "both converge", f"{iterations[0]}; symmetrised {iterations[1]}", True)


@row("cone_of_the_new_pressure", wrong="the friction cone is frozen while the multipliers are augmented", source="FrontISTR !652, #872",
     right="friction is mu p of the present p on every slipping node after every augmentation; Newton's iteration doubles the digits")
def cone_of_the_new_pressure(check):
    slider = Slider(law(normal="augmented"))
    worst, augmentations, changes = 0.0, 0, []
    for k in range(1, 5):
        last = None
        for _ in range(60):
            slider.step(0.02 * k, 0.015, tolerance=1e-13, commit=False)
            contact = slider.contact
            slips = contact.flags & ents.Flag.SLIP != 0
            p, t = contact.pressure[slips], np.linalg.norm(contact.traction[slips], axis=1)
            worst = max(worst, np.abs(t - 0.3 * p).max(initial=0) / max(p.max(initial=0), 1))
            if last is not None:
                changes.append(np.abs(contact.pressure - last).max() / contact.pressure.max())
            last = contact.pressure.copy()
            if np.abs(contact.gap[contact.flags & ents.Flag.CONTACT != 0]).max() < 1e-10:
                break
            contact.augment()
            augmentations += 1
        slider.contact.commit()
    # t is mu p times a unit vector: rounding of a few operations.
    check.near("| |t| - mu p | / p", 0, worst, 1e-14)
    check.near("deepest node after the last augmentation", 0, np.abs(contact.gap[contact.flags & ents.Flag.CONTACT != 0]).max(), 1e-10)
    check.true("pressure changes by augmentation", "> 1 %: a frozen cone shows", f"{max(changes):.2g}, {augmentations} augmentations", max(changes) > 0.01)
    # Above 0.01 nodes still open, close, stick or slip. Forces here are about 10; a factor of 0.01, which a frozen cone has at best, would give
    # residuals that are 10 times the square of 1e-3.
    steps = [(before, after) for norms in slider.problem.norms for before, after in zip(norms, norms[1:]) if before < 0.01]
    slow = [pair for pair in steps if pair[1] > pair[0]**2 + 1e-12]
    check.near(f"of {len(steps)} last iterations, without doubled digits", 0, len(slow), 0)


@row("cut_after_separation", wrong="a step that is cut after the bodies have separated keeps the matrix of the step before", source="FrontISTR !635, #845",
     right="the same path with and without the cut; no entry of K from open nodes")
def cut_after_separation(check):
    paths = []
    for cut in (False, True):
        slider, path = Slider(law(), penetration_limit=0.1), []
        for right, down in ((0.0, 0.012), (0.02, 0.014), (0.05, -0.03), (0.3, -0.03), (0.32, 0.012), (0.34, 0.014)):
            if cut and right in (0.05, 0.3, 0.32):
                before = slider.problem.u.copy()
                deep = before.copy()
                deep[1::2] -= 0.15
                raised = False
                try:
                    slider.contact.update(deep)
                except ents.CutStep:
                    raised = True
                slider.problem.u = before
                path_raised = raised
            residual = slider.step(right, down)
            path += [slider.problem.u.copy(), residual.copy(), slider.contact.tangent.toarray().ravel()]
            if (right, down) == (0.05, -0.03):
                open_entries = slider.contact.tangent.count_nonzero()
        paths.append(np.concatenate(path))
    check.true("a step that is too deep", "CutStep", "CutStep" if path_raised else "accepted", path_raised)
    check.near("entries of K after the separation", 0, open_entries, 0)
    check.near("displacements, forces and K of 6 steps", paths[0], paths[1], 0)


@row("no_friction_is_mu_0", wrong="with mu = 0 contact is lost", source="WeldForm #357, the test of mu = 0 of Kratos",
     right="the same bits as without friction")
def no_friction_is_mu_0(check):
    paths = []
    for coefficient in (None, 0.0):
        slider = Slider(law(coefficient=coefficient))
        path = []
        for k in range(1, 4):
            residual = slider.step(0.02 * k, 0.012)
            path += [slider.problem.u.copy(), residual, slider.contact.pressure, slider.contact.tangent.toarray().ravel()]
        paths.append(np.concatenate(path))
    check.true("largest pressure", "> 0", f"{slider.contact.pressure.max():.6g}", slider.contact.pressure.max() > 0)
    check.near("displacements, forces, pressures and K of 3 steps", paths[0], paths[1], 0)
    # A ramp that starts at zero: the parameter of a bound model.
    model = ents.Model({"segment": "line2", "master": "rigid", "parameters": {"mu": 0.1}, "contact": law(coefficient="mu")})
    model.bind(mu=0.0)
    result = model.evaluate([[0.2, -0.01]], [[-1, 0], [1, 0]], "pressure traction")
    check.near("bound to mu = 0: pressure, traction", [100, 0, 0], [*result["pressure"], *result["traction"][0]], 1e-12)


@row("frictional_cylinder", wrong="the tangential force oscillates along the contact of a cylinder", source="MOOSE #24632",
     right="antisymmetric, one sign and one extremum on each side")
def frictional_cylinder(check):
    """A rigid cylinder of radius 1 on a block of 2 x 1 in plane strain, pressed without a tangential motion."""
    grade = lambda x: np.column_stack([np.sign(x[:, 0]) * np.abs(x[:, 0]) ** 1.8, -np.abs(x[:, 1]) ** 1.8])
    body = block("quad4", [80, 24], [-1, -1], [1, 0], grade)
    model = {"segment": "line2", "master": "rigid", "surface_coordinates": [[1], [-1]], "height": {"type": "polynomial", "coefficients": [0, 0, -0.5]},
             "contact": law(coefficient=0.1, stiffness=1e5, normal_stiffness=1e5)}
    contact = ents.Contact(model, body.positions, body.faces(1, 0), [[0, 1]], master_positions=[[1, 0], [-1, 0]], reach=0.3)
    problem = Problem(body.stiffness(1000, 0.3), dofs(body.where(1, -1), 2), contact)
    for k in range(1, 9):
        contact.move([[1, -0.001 * k], [-1, -0.001 * k]])
        problem.solve()
    rank = np.argsort(contact.points[:, 0])
    t, p, on = contact.traction[rank, 0], contact.pressure[rank], contact.pressure[rank] > 0
    t, p = t[on], p[on]
    n = len(t)
    check.true("closed nodes; of them slip", "both states occur", f"{n}; {np.count_nonzero(contact.flags & ents.Flag.SLIP)}",
               0 < np.count_nonzero(contact.flags & ents.Flag.SLIP) < n)
    # Newton's iteration ends below 1e-12 of the largest force; pressures are forces over areas that are 1e-2 of the largest area.
    check.near("t(x) + t(-x), over the largest t", 0, (t + t[::-1]) / np.abs(t).max(), 1e-9)
    half = t[n // 2 + 1:] if n % 2 else t[n // 2:]
    signs, turns = len(set(np.sign(half))), np.count_nonzero(np.diff(np.sign(np.diff(half))))
    check.near("signs on one side", 1, signs, 0)
    check.near("extrema on one side", 1, turns, 0)
    check.near("largest |t| / (mu p)", 1, (np.linalg.norm(contact.traction[rank][on], axis=1) / (0.1 * p)).max(), 1e-12)


@row("skew_stack", wrong="a stack of blocks without friction slides on skew meshes", source="C-IPC #9", right="lateral force 1e-15 of the weight")
def skew_stack(check):
    """Three blocks on a rigid plane of skew facets. Their facets are skew, and node lies on node: the pressure is uniform. Inside the nodes are moved."""
    rng = np.random.default_rng(11)
    slant = lambda x: x + np.column_stack([0.21 * x[:, 1], -0.17 * x[:, 0], 0 * x[:, 0]])

    def skew(x):
        inside = np.all((x[:, :2] > 0) & (x[:, :2] < 1), axis=1) & (x[:, 2] % 1 > 0)
        return slant(x + inside[:, None] * rng.uniform(-0.08, 0.08, x.shape))
    blocks = [block("hex8", [3, 3, 2], [0, 0, z], [1, 1, z + 1], skew) for z in range(3)]
    stack = blocks[0].joined(blocks[1]).joined(blocks[2])
    n = len(blocks[0].positions)
    floor = slant(np.array([[-2.0, -2, 0], [1.3, -2, 0], [1.3, 3, 0], [-2, 3, 0]]))
    pairs = Pairs([ents.Contact({"segment": "quad4", "master": "rigid", "contact": law(coefficient=0.0)}, stack.positions, blocks[0].faces(2, 0),
                                [[0, 1, 2, 3]], master_positions=floor, reach=0.3)]
                  + [ents.Contact({"segment": "quad4", "border": 0.01, "contact": law(coefficient=0.0)}, stack.positions,
                                  [[i + k * n for i in face] for face in blocks[k].faces(2, k)],
                                  [[i + (k - 1) * n for i in face] for face in blocks[k - 1].faces(2, k)], reach=0.3) for k in (1, 2)])
    # One node of each block is held sideways: reactions there are the lateral forces.
    corner = [int(np.argmin(np.abs(b.positions - [0, 0, 0]).sum(axis=1))) + k * n for k, b in enumerate(blocks)]
    other = [int(np.argmax(b.positions[:, 0] - 10 * b.positions[:, 2])) + k * n for k, b in enumerate(blocks)]
    held = np.concatenate([dofs(corner, 3, 0, 1), dofs(other, 3, 1)])
    problem = Problem(stack.stiffness(1000, 0), held, pairs)
    problem.u[2::3] = np.repeat([-1e-4, -2e-4, -3e-4], n)  # the depths that a pressure of 1 has
    top = [[i + 2 * n for i in face] for face in blocks[2].faces(2, 3)]
    load = face_loads(stack.positions, top, [0, 0, -1])
    problem.solve(load)
    weight = -load.sum()
    lateral = [np.abs(pair.residual.reshape(-1, 3)[k * n:(k + 1) * n, :2].sum(axis=0)).max() / weight for k, pair in enumerate(pairs.pairs)]
    # The pressure is uniform to rounding, so heights of the corners of a facet differ by 2^-53 of a depth of 1e-4: its normal leans by less than 1e-16.
    check.near("lateral force / weight, each interface", 0, lateral, 1e-15)
    check.near("pressures", 1, np.concatenate([pair.pressure for pair in pairs.pairs]), 4e-11)


class Pairs:
    """Several contacts that are one for Problem."""

    def __init__(self, pairs):
        self.pairs = pairs

    def update(self, u):
        results = [pair.update(u) for pair in self.pairs]
        self.residual, self.tangent = sum(r for r, _ in results), sum(k for _, k in results)
        return self.residual, self.tangent

    def commit(self):
        for pair in self.pairs:
            pair.commit()


@target("wedge", case="a block on a plane of slope t = 0.1, weight G, pushed up by a horizontal force F; mu 0, 0.1, 0.2, 0.3",
        source="NAFEMS CGS-4, FrontISTR !599", right="F / G = (t + mu) / (1 - mu t) = 0.1, 0.202020, 0.306122, 0.412371; "
        "N / G = (1 + t^2)^(1/2) / (1 - mu t) = 1.004988, 1.015139, 1.025497, 1.036070")
def wedge(check):
    slope = 0.1
    up = np.array([[1, -slope], [slope, 1]]) / np.hypot(1, slope)
    for mu, right, across in ((0.0, 0.1, 1.004988), (0.1, 0.202020, 1.015139), (0.2, 0.306122, 1.025497), (0.3, 0.412371, 1.036070)):
        body = block("quad4", [8, 4], [0, -1e-4], [2, 1 - 1e-4])
        faces, side = body.faces(1, -1e-4), body.where(0, 0)
        body.positions = body.positions @ up.T
        plane = np.array([[-9.0, 0], [9, 0]]) @ up.T
        contact = ents.Contact({"segment": "line2", "master": "rigid", "contact": law(coefficient=mu)}, body.positions, faces, [[0, 1]], master_positions=plane,
                               reach=0.2)
        problem = Problem(body.stiffness(1e4, 0.3), dofs(side, 2, 0), contact)
        weight = np.zeros(body.positions.shape)
        np.add.at(weight[:, 1], body.cells.ravel(), -1 / body.cells.size)
        # Pushed far beyond the elastic slip mu p / 2e3 and the block's own shortening: all of it slips.
        for push in np.linspace(0.005, 0.04, 8):
            problem.solve(weight.ravel(), values=push)
        sideways = (problem.k @ problem.u + contact.residual - weight.ravel())[problem.held].sum()
        slips = np.count_nonzero(contact.flags & ents.Flag.SLIP) == len(contact.flags)
        # Balance holds to Newton's tolerance, 1e-12 of forces of 1e-2 on 50 nodes; mu p is exact on a flat plane. The target has six digits.
        check.near(f"mu = {mu}: F / G", (slope + mu) / (1 - mu * slope), sideways, 1e-9)
        check.near(f"mu = {mu}: the published value", right, sideways, 6e-7)
        check.near(f"mu = {mu}: N / G", np.hypot(1, slope) / (1 - mu * slope), contact.pressure @ contact.areas, 1e-9)
        check.near(f"mu = {mu}: the published N / G", across, contact.pressure @ contact.areas, 6e-7)
        check.true(f"mu = {mu}: slipping nodes", "all (none without friction)", f"{np.count_nonzero(contact.flags & ents.Flag.SLIP)}", slips or mu == 0)
