# SPDX-License-Identifier: BSD-3-Clause
"""Normals, distances, derivatives, frames, and a start that is too deep."""
import ents
import numpy as np

from fem import Problem, block, dofs, face_loads
from rows import row

# Weights of a uniform cubic segment: rows of coefficients of 1, t, t^2, t^3 for each of four points, t = 0 .. 1.
CUBIC = {"bspline4": np.array([[1, -3, 3, -1], [4, 0, -6, 3], [1, 3, 3, -3], [0, 0, 0, 1]]) / 6,
         "catmull_rom4": np.array([[0, -1, 2, -1], [2, 0, -5, 3], [0, 1, 4, -3], [0, 0, -1, 1]]) / 2}
AMPLITUDE, WAVE = 0.03, np.array([0.7, 0.4])


def powers(t, order):
    """Derivative of (1, t, t^2, t^3)."""
    return [np.array([1, t, t**2, t**3]), np.array([0, 1, 2 * t, 3 * t**2]), np.array([0, 0, 2, 6 * t])][order]


def enriched_tangents(kind, nodes, s, xi):
    """d rho_e / d xi_k of a smoothed segment with the height AMPLITUDE sin(2 pi WAVE . s), written out here: [d-1][d]."""
    d = nodes.shape[1]
    t = (np.asarray(xi) + 1) / 2
    weights = [[CUBIC[kind] @ powers(t[i], order) / 2**order for order in range(3)] for i in range(d - 1)]  # [direction][order][4]; dt/dxi = 1/2

    def at(values, *orders):
        if d == 2:
            return weights[0][orders[0]] @ values
        return np.einsum("j,i,ji...->...", weights[1][orders[1]], weights[0][orders[0]], values.reshape(4, 4, *values.shape[1:]))
    unit = np.eye(d - 1, dtype=int)
    first = [at(nodes, *unit[k]) for k in range(d - 1)]
    second = [[at(nodes, *(unit[j] + unit[k])) for k in range(d - 1)] for j in range(d - 1)]
    if d == 2:
        turn = np.array([[0, -1], [1, 0]])
        raw, raw_k = turn @ first[0], [turn @ second[0][0]]
    else:
        raw = np.cross(*first)
        raw_k = [np.cross(second[0][k], first[1]) + np.cross(first[0], second[1][k]) for k in range(2)]
    size = np.linalg.norm(raw)
    n = raw / size
    n_k = [(one - n * (n @ one)) / size for one in raw_k]
    wave = 2 * np.pi * WAVE[:d - 1]
    phase = wave @ at(s, *(0 * unit[0]))
    h, h_k = AMPLITUDE * np.sin(phase), [AMPLITUDE * np.cos(phase) * (wave @ at(s, *unit[k])) for k in range(d - 1)]
    return np.array([first[k] + h_k[k] * n + h * n_k[k] for k in range(d - 1)])


@row("smoothed_normal", wrong="on a smoothed surface the normal is that of the facet", source="FrontISTR #808, !583",
     right="n_e . rho_e,k = 0 to 1e-15 of the length of rho_e,k, with and without a height")
def smoothed_normal(check):
    rng = np.random.default_rng(3)
    for base in ("bspline4", "catmull_rom4"):
        for d in (2, 3):
            kind = base if d == 2 else base[:-1] + "16"
            axes = np.stack(np.meshgrid(*[np.arange(4.0)] * (d - 1)), -1).reshape(-1, d - 1)
            worst, facet = {}, 0.0
            for with_height in (False, True):
                global AMPLITUDE
                kept, AMPLITUDE = AMPLITUDE, AMPLITUDE if with_height else 0.0
                wave = {"height": {"type": "sine", "amplitude": AMPLITUDE, "wave_vector": WAVE[:d - 1].tolist()}} if with_height else {}
                model, all_errors = ents.Model({"segment": kind, **wave}), []
                for _ in range(50):
                    nodes = np.column_stack([axes, np.zeros(len(axes))]) + rng.uniform(-0.15, 0.15, (len(axes), d))
                    xi = rng.uniform(-1, 1, (4, d - 1))
                    normals = model.surface(nodes, xi, axes)["normal"]
                    for n, place in zip(normals, xi):
                        tangents = enriched_tangents(base, nodes, axes, place)
                        all_errors += (np.abs(tangents @ n) / np.linalg.norm(tangents, axis=1)).tolist()
                        if d == 2 and not with_height:
                            chord = nodes[2] - nodes[1]
                            facet = max(facet, abs(n @ chord) / np.linalg.norm(chord))
                worst[with_height] = max(all_errors)
                AMPLITUDE = kept
            # A tangent is a sum of 4 or 16 products that are up to 4 times as large as it: 4 x 2^-53 here, in the test, and as much in the library.
            check.near(f"{kind}", 0, worst[False], 1e-15)
            check.near(f"{kind} with a wave", 0, worst[True], 1e-15)
            if d == 2:
                check.true(f"{kind}, n . facet", "not 0: the facet's normal is another one", f"{facet:.2g}", facet > 0.01)


@row("true_distance", wrong="penetration is reported where strongly curved bodies do not touch", source="CalculiX #177",
     right="the gap is the distance to the true curve")
def true_distance(check):
    from scipy.optimize import minimize_scalar
    # A wave of amplitude 0.3 and length 1 (radius 0.084 in its valleys) as a height on one segment, points above it.
    model = {"segment": "line2", "master": "rigid", "height": {"type": "sine", "amplitude": 0.3, "wave_vector": [1.0]},
             "contact": {"normal": {"type": "penalty", "stiffness": 1e3}}}
    rng = np.random.default_rng(5)
    x = np.column_stack([np.linspace(0.6, 3.4, 57), np.zeros(57)])
    x[:, 1] = 0.3 * np.sin(2 * np.pi * x[:, 0]) + rng.uniform(0.02, 0.4, 57)
    chain = np.column_stack([np.arange(1, 57), np.arange(56)])
    contact = ents.Contact(model, x, chain, [[0, 1]], master_positions=[[-1, 0], [5, 0]], surface_coordinates="x", reach=1.0)
    residual, _ = contact.update(np.zeros(x.size))

    def squared(s, point):
        return (s - point[0])**2 + (0.3 * np.sin(2 * np.pi * s) - point[1])**2
    exact = []
    for point in x:
        grid = np.linspace(point[0] - 0.7, point[0] + 0.7, 1401)
        best = grid[np.argmin(squared(grid, point))]
        found = minimize_scalar(squared, bounds=(best - 1e-3, best + 1e-3), args=(point,), method="bounded", options={"xatol": 1e-12})
        exact.append(found.fun**0.5)
    # The minimum's place is known to sqrt(2^-52), which is squared in its value; the least distance here is 0.005: 2^-52 / 0.005.
    check.near("wave: gap", exact, contact.gap, 1e-13)
    check.near("wave: largest force", 0, np.abs(residual).max(), 0)
    # A ring of 24 facets, radius 1.1, round a circle of radius 1. Of Catmull and Rom's curve the middle of a facet is at (9 cos a - cos 3a) / 8 of the
    # radius, a = pi / 24, its largest error.
    ring = lambda n, r, way: r * np.column_stack([np.cos(way * 2 * np.pi * np.arange(n) / n), np.sin(way * 2 * np.pi * np.arange(n) / n)])
    outer, inner = ring(24, 1.1, -1), ring(100, 1.0, 1)
    inner = inner @ [[np.cos(0.01), np.sin(0.01)], [-np.sin(0.01), np.cos(0.01)]]
    closed = lambda n: np.column_stack([np.arange(n), np.roll(np.arange(n), -1)])
    a = np.pi / 24
    bound = 1.1 * (1 - (9 * np.cos(a) - np.cos(3 * a)) / 8)
    turn = 1 if _points_inwards(outer) else -1
    for kind in ("line2", "catmull_rom4"):  # facets themselves lie 0.0094 inside of the ring: their gap is smaller, and no contact either
        contact = ents.Contact({"segment": kind, "master": "rigid", "contact": {"normal": {"type": "penalty", "stiffness": 1e3}}}, inner, closed(100)[:, ::-1],
                               closed(24)[:, ::turn], master_positions=outer, reach=0.5)
        residual, _ = contact.update(np.zeros(inner.size))
        if kind == "catmull_rom4":
            check.near(f"ring of 24 facets, {kind}: gap", 0.1, contact.gap, bound * (1 + 1e-9))
        check.near(f"ring of 24 facets, {kind}: largest force", 0, np.abs(residual).max(), 0)


def _points_inwards(ring):
    """The normal is on the left of the direction from the first node to the second."""
    t = ring[1] - ring[0]
    return np.array([-t[1], t[0]]) @ ring[0] < 0


@row("derivative_of_the_gap", wrong="the derivative of the gap has the wrong sign, and a second wrong sign hides it", source="Kratos PR 5077",
     right="gap, residual and tangent agree with differences to 1e-8, with both projections")
def derivative_of_the_gap(check):
    rng = np.random.default_rng(7)
    segments = {"line2": (2, [[-1, 0], [1, 0.1]]), "bspline4": (2, [[-3, 0.2], [-1, 0], [1, 0.1], [3, -0.2]]),
                "quad4": (3, [[-1, -1, 0], [1, -1, 0.1], [1, 1, 0], [-1, 1, -0.1]]), "tri3": (3, [[-1, -1, 0], [2, -1, 0.1], [-1, 2, 0]])}
    for projection in ("normal", "shadow_direction"):
        worst, along = {"gap": 0.0, "tangent": 0.0}, np.inf
        for kind, (d, nodes) in segments.items():
            shadow = {"projection": {"type": projection, **({"direction": [0.1] * (d - 1) + [1]} if "shadow" in projection else {})}}
            model = ents.Model({"segment": kind, **shadow, "height": {"type": "sine", "amplitude": 0.05, "wave_vector": [0.5, 0.25][:d - 1]},
                                "contact": {"normal": {"type": "penalty", "stiffness": 1.0}}})
            for _ in range(5):
                slave = np.r_[rng.uniform(-0.3, 0.3, d - 1), -0.08]
                q = np.concatenate([slave, np.ravel(nodes)])
                at = lambda v, want: model.evaluate(v[None, :d], v[d:].reshape(-1, d), want)
                here = at(q, "gap gap_gradient residual tangent normal")
                numbers = {"gap": lambda v: at(v, "gap")["gap"], "tangent": lambda v: at(v, "residual")["residual"][0]}
                exact = {"gap": here["gap_gradient"][0][None, :], "tangent": here["tangent"][0]}
                for name, function in numbers.items():
                    found = np.stack([richardson(function, q, k) for k in range(len(q))], -1).reshape(exact[name].shape)
                    worst[name] = max(worst[name], np.abs(found - exact[name]).max() / np.abs(exact[name]).max())
                along = min(along, here["gap_gradient"][0][:d] @ here["normal"][0])
        # Differences of order 4 with h = 2e-3: error h^4 x (2 pi 0.5)^4 / 30 = 5e-11, rounding 2^-52 / h = 1e-13.
        for name in worst:
            check.near(f"{projection}: {name}", 0, worst[name], 1e-8)
        check.true(f"{projection}: dg/du_slave . n_e", "> 0: moving out opens", f"{along:.4g} or more", along > 0)


def richardson(function, q, k, h=2e-3):
    e = h * np.eye(len(q))[k]
    return (8 * (function(q + e) - function(q - e)) - (function(q + 2 * e) - function(q - 2 * e))) / (12 * h)


@row("along_any_axis", wrong="contact along one axis is right, along another one not", source="MOOSE PR 33802",
     right="Hertz along x, y, z and (1,1,1): forces and displacements equal to 1e-12 of the largest")
def along_any_axis(check):
    results = {}
    z = np.array([0.0, 0, 1])
    for name, axis in (("z", z), ("x", np.array([1.0, 0, 0])), ("y", np.array([0, 1.0, 0])), ("(1,1,1)", np.ones(3) / 3**0.5)):
        # The rotation that takes z to the axis: two mirrors.
        v = axis + z
        turn = 2 * np.outer(v, v) / (v @ v) - np.eye(3)
        body = block("hex8", [6, 6, 4], [-1, -1, -1], [1, 1, 0])
        faces, bottom = body.faces(2, 0), body.where(2, -1)
        body.positions = body.positions @ turn.T
        master = np.array([[-1.5, -1.5, 0], [-1.5, 1.5, 0], [1.5, 1.5, 0], [1.5, -1.5, 0]])
        model = {"segment": "quad4", "master": "rigid", "surface_coordinates": (master[:, :2]).tolist(),
                 "height": {"type": "polynomial", "coefficients": [[0, 0, -0.125], [0], [-0.125]]},
                 "contact": {"normal": {"type": "penalty", "stiffness": 1e4}}}
        contact = ents.Contact(model, body.positions, faces, [[0, 1, 2, 3]], master_positions=master @ turn.T, reach=0.7)
        problem = Problem(body.stiffness(1000, 0.3), dofs(bottom, 3), contact)
        contact.move((master - [0, 0, 0.06]) @ turn.T)
        residual = problem.solve(tolerance=1e-14)
        turned = [(v.reshape(-1, 3) @ turn).ravel() for v in (problem.u, residual)]
        results[name] = np.concatenate([v / np.abs(v).max() for v in turned])
    for name in ("x", "y", "(1,1,1)"):
        # The equations' condition number is about 1e3: rounding of 1e3 x 2^-53 x some 10 in the solution.
        check.near(f"along {name} against z", results["z"], results[name], 1e-12)
    check.true("closed nodes", "more than 4", str(np.count_nonzero(contact.pressure)), np.count_nonzero(contact.pressure) > 4)


@row("starts_too_deep", wrong="a start with an overlap of 1e-4 diverges", source="WeldForm #313",
     right="converges; an offset of 1e-4 in the law removes the overlap and its pressure")
def starts_too_deep(check):
    """A block of 1 x 1, E = 2e5, whose lower side lies 1e-4 inside of a rigid plane; its upper side is held."""
    for offset, right in ((None, 1), (1e-4, 0)):
        body = block("quad4", [6, 6], [0, -1e-4], [1, 1 - 1e-4])
        stiffness = 1e8
        more = {} if offset is None else {"offset": offset}
        contact = ents.Contact({"segment": "line2", "master": "rigid", "contact": {"normal": {"type": "penalty", "stiffness": stiffness}, **more}},
                               body.positions, body.faces(1, -1e-4), [[0, 1]], master_positions=[[-5, 0], [5, 0]], reach=0.1)
        held = np.concatenate([dofs(body.where(1, 1 - 1e-4), 2), dofs(np.r_[body.where(0, 0), body.where(0, 1)], 2, 0)])
        problem = Problem(body.stiffness(2e5, 0), np.unique(held), contact)
        problem.solve(tolerance=1e-11)
        # Springs in a row: of the block, E, and of the penalty. Newton's tolerance is 1e-11 of forces on nodes, of which the least is a twelfth.
        pressure = right * 1e-4 / (1 / 2e5 + 1 / stiffness)
        check.near("pressure without an offset" if offset is None else "pressure with the offset", pressure, contact.pressure, max(pressure, 1) * 1e-8)
        check.true("iterations", "1 or 2: linear", str(problem.iterations[0]), problem.iterations[0] <= 2)
