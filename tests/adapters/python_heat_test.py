"""python_heat_test.py FOLDER-OF-ents: ents.Contact with temperatures: bars in series, heat of friction, resultants and energies, against closed
forms. The library is the one of the environment's ENTS_LIBRARY. Exit status 3: no NumPy or SciPy here, nothing was tested.
"""
import sys
import unittest

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy.sparse as sparse
    import scipy.sparse.linalg as linalg
except ModuleNotFoundError as error:
    print(f"python_heat_test.py: {error} (Debian: python3-numpy, python3-scipy)")
    sys.exit(3)
sys.path.insert(0, sys.argv.pop(1))
import ents  # noqa: E402

NORMAL = {"type": "penalty", "stiffness": 1e5}


def block(x0, x1, y0, y1, nx, ny, first):
    """Nodes and quadrilaterals of a rectangle."""
    x, y = np.meshgrid(np.linspace(x0, x1, nx + 1), np.linspace(y0, y1, ny + 1))
    number = first + np.arange(x.size).reshape(ny + 1, nx + 1)
    cells = np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1).reshape(-1, 4)
    return np.column_stack([x.ravel(), y.ravel()]), cells, number


def cell_matrix(x, modulus, conductivity, expansion):
    """Stiffness of (u, v, T) per node of a quadrilateral: plane stress without Poisson's ratio, conduction, thermal expansion."""
    k = np.zeros((12, 12))
    g = 1 / np.sqrt(3)
    for xi, eta in ((-g, -g), (g, -g), (g, g), (-g, g)):
        n = np.array([(1 - xi) * (1 - eta), (1 + xi) * (1 - eta), (1 + xi) * (1 + eta), (1 - xi) * (1 + eta)]) / 4
        d = np.array([[-(1 - eta), 1 - eta, 1 + eta, -(1 + eta)], [-(1 - xi), -(1 + xi), 1 + xi, 1 - xi]]) / 4
        jacobian = d @ x
        slope, area = np.linalg.solve(jacobian, d), np.linalg.det(jacobian)
        b = np.zeros((3, 12))
        b[0, 0::3], b[1, 1::3], b[2, 0::3], b[2, 1::3] = slope[0], slope[1], slope[1], slope[0]
        c = modulus * np.diag([1, 1, 0.5])
        thermal = np.zeros(12)
        thermal[2::3] = expansion * n
        k += area * (b.T @ c @ (b - np.outer([1, 1, 0], thermal)))
        k[2::3, 2::3] += area * conductivity * slope.T @ slope
    return k


class Bars:
    """Two blocks on each other, of unit thickness: the lower one is the master. Fixed below and moved by `push` above, temperatures given there."""

    def __init__(self, heat, friction=None, width=1.0, heights=(1.0, 1.5), conductivity=(2.0, 5.0), master_cells=3, slave_cells=3, expansion=0.0, **more):
        below, below_cells, of_below = block(0, width, -heights[0], 0, master_cells, 2, 0)
        above, above_cells, of_above = block(0, width, 0, heights[1], slave_cells, 3, len(below))
        self.x = np.vstack([below, above])
        rows, columns, values = [], [], []
        for cells, k in ((below_cells, conductivity[0]), (above_cells, conductivity[1])):
            for cell in cells:
                dofs = (3 * cell[:, None] + np.arange(3)).ravel()
                matrix = cell_matrix(self.x[cell], 1e3, k, expansion)
                rows.append(np.repeat(dofs, 12)), columns.append(np.tile(dofs, 12)), values.append(matrix.ravel())
        n = 3 * len(self.x)
        self.bulk = sparse.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (n, n))
        self.bottom, self.top, self.interface = of_below[0], of_above[-1], (of_below[-1], of_above[0])
        contact = {"normal": NORMAL, "heat": heat, **({} if friction is None else {"friction": friction})}
        master = np.column_stack([self.interface[0][:-1], self.interface[0][1:]])
        slave = np.column_stack([self.interface[1][1:], self.interface[1][:-1]])
        self.contact = ents.Contact({"segment": "line2", "contact": contact}, self.x, slave, master, **more)

    def solve(self, push, temperatures, u=None, shift=0.0, time_increment=None, tolerance=1e-11):
        """Displacements and temperatures, and the residuals of Newton's iteration."""
        u = np.zeros(3 * len(self.x)) if u is None else u.copy()
        fixed = {}
        for nodes, values in ((self.bottom, (0.0, 0.0, temperatures[0])), (self.top, (shift, -push, temperatures[1]))):
            for c in range(3):
                fixed.update(zip(3 * nodes + c, np.full(len(nodes), values[c])))
        free = np.setdiff1d(np.arange(len(u)), list(fixed))
        u[list(fixed)] = list(fixed.values())
        sizes = []
        for _ in range(20):
            residual, tangent = self.contact.update(u, time_increment=time_increment)
            residual = residual + self.bulk @ u
            sizes.append(np.abs(residual[free]).max())
            if sizes[-1] < tolerance:
                break
            k = (tangent + self.bulk).tocsc()[free][:, free]
            u[free] -= linalg.spsolve(k, residual[free])
        self.reactions = residual
        return u, sizes


class Heat(unittest.TestCase):
    def test_two_bars_in_series(self):
        # T_out = T_in + q R, R = sum L / (k A) + 1 / (h A)
        for sampling in (0, 3):
            bars = Bars({"conductance": 10.0}, sampling=sampling)
            u, sizes = bars.solve(0.0, (0.0, 7.0))
            flow = 7.0 / (1.0 / 2.0 + 1.5 / 5.0 + 1 / 10.0)
            self.assertEqual(len(sizes), 2, sizes)  # it is linear
            self.assertLess(abs(bars.reactions[3 * bars.top + 2].sum() - flow), 1e-10 * flow)
            self.assertLess(abs(bars.contact.heat[:, 0].sum() - flow), 1e-10 * flow)
            self.assertLess(np.abs(u[3 * bars.interface[1] + 2] - (7.0 - flow * 1.5 / 5.0)).max(), 1e-10)
            self.assertLess(np.abs(u[3 * bars.interface[0] + 2] - flow * 0.5).max(), 1e-10)
            print(f"two bars, {len(sizes) - 1} iteration: flow {bars.contact.heat[:, 0].sum() / flow - 1:.1e}, bound 1e-10")

    def test_temperatures_beside_those_of_u(self):
        bars = Bars({"conductance": 10.0}, temperature=20.0)
        bars.solve(0.0, (0.0, 7.0))
        self.assertLess(abs(bars.contact.heat[:, 0].sum() - 7.0 / 0.9), 1e-9)

    def test_conductance_of_the_pressure(self):
        bars = Bars({"power": {"coefficient": 10.0, "pressure": 5.0, "exponent": 0.95}}, expansion=1e-4)
        u, sizes = bars.solve(0.02, (0.0, 7.0))
        self.assertLess(sizes[-1], 1e-11)
        self.assertLess(len(sizes), 8)  # quadratic: conductance depends on pressure, pressure on temperatures
        top = bars.reactions[3 * bars.top + 1].sum()
        h = 10.0 * (-top / 5.0) ** 0.95
        flow = 7.0 / (0.5 + 0.3 + 1 / h)
        self.assertLess(abs(bars.reactions[3 * bars.top + 2].sum() / flow - 1), 2e-3)  # the ends are held: pressure is not uniform

    def test_an_open_gap_conducts(self):
        bars = Bars({"gas": {"conductivity": 0.3, "jump": 0.01}})
        bars.solve(-0.05, (0.0, 7.0))
        self.assertEqual(bars.contact.pressure.max(), 0.0)
        self.assertLess(abs(bars.contact.heat[:, 0].sum() / (7.0 / (0.5 + 0.3 + 0.06 / 0.3)) - 1), 1e-9)

    def test_friction_heats_a_dragged_block(self):
        # the slave side slides by `shift` of its own as a rigid block would: power mu N v, a third of it into the slave
        bars = Bars({"friction": {"slave": 1 / 3}}, {"type": "coulomb", "coefficient": 0.2, "stiffness": 1e5}, width=0.5, master_cells=1, slave_cells=1)
        with self.assertRaises(ents.Error) as raised:
            bars.solve(0.01, (0.0, 0.0))
        self.assertIn("time_increment", str(raised.exception))
        rigid = ents.Contact({"segment": "line2", "master": "rigid", "contact": {"normal": NORMAL, "heat": {"friction": {"slave": 1 / 3}, "conductance": 4.0},
                              "friction": {"type": "coulomb", "coefficient": 0.2, "stiffness": 1e5}}}, [[0, 0], [1, 0]], [[1, 0]], [[0, 1]],
                             master_positions=[[-5, 0], [5, 0]], master_temperature=3.0)
        u, step, dt = np.zeros((2, 3)), 0.01, 0.25
        u[:, 1] = -1e-4
        for i in range(6):
            residual, _ = rigid.update(u.ravel(), time_increment=dt)
            if i > 1:
                power = 0.2 * rigid.resultants()["normal"][1] * step / dt
                self.assertLess(abs(rigid.heat[:, 1].sum() / power - 1), 1e-10)
                print(f"a dragged block: power {rigid.heat[:, 1].sum() / power - 1:.1e}, bound 1e-10")
                self.assertLess(abs(residual[2::3].sum() - (4.0 * (0 - 3.0) - power / 3)), 1e-10 * power)
                self.assertLess(abs(rigid.energies["dissipated"] / (power * dt) - 1), 1e-10)
            rigid.commit()
            u[:, 0] += step

    def test_tangent_is_the_derivative(self):
        for segment in ("line2", "bspline4"):
            bars = Bars({"power": {"coefficient": 10.0, "pressure": 5.0, "exponent": 0.95}, "gas": {"conductivity": 0.3, "jump": 0.01},
                         "friction": {}}, {"type": "coulomb", "coefficient": 0.2, "stiffness": 1e5})
            contact = bars.contact
            if segment != "line2":
                mesh = np.column_stack([bars.interface[0][:-1], bars.interface[0][1:]])
                contact = ents.Contact({"segment": segment, "contact": {"normal": NORMAL, "heat": {"gas": {"conductivity": 0.3, "jump": 0.01}}}}, bars.x,
                                       np.column_stack([bars.interface[1][1:], bars.interface[1][:-1]]), mesh, sampling=2, mirror=[("x", 0.0)])
            rng = np.random.default_rng(3)
            u = 1e-3 * rng.normal(size=(len(bars.x), 3)) * [1, 1, 1000]
            u[bars.interface[1], 1] -= 5e-3
            contact.update(u.ravel(), time_increment=0.1), contact.commit()
            u[bars.interface[1], 0] += 0.1 * (0.45 - bars.x[bars.interface[1], 0])  # all of them slip, away from the ends
            v = rng.normal(size=u.shape) * [1, 1, 100]
            _, tangent = contact.update(u.ravel(), time_increment=0.1)
            t = 1e-6
            values = [contact.update((u + f * t * v).ravel(), tangent=False, time_increment=0.1)[0] for f in (-2, -1, 1, 2)]
            numeric = (8 * (values[2] - values[1]) - (values[3] - values[0])) / (12 * t)
            for part in (slice(2, None, 3), slice(0, None, 3), slice(1, None, 3)):
                self.assertLess(np.abs(numeric - tangent @ v.ravel())[part].max(), 1e-7 * np.abs(numeric[part]).max(), (segment, part))

    def test_resultants(self):
        bars = Bars({"conductance": 1.0}, {"type": "coulomb", "coefficient": 0.2, "stiffness": 1e5})
        u, _ = bars.solve(0.0, (0.0, 0.0), time_increment=1.0)
        bars.contact.commit()
        u, _ = bars.solve(0.02, (0.0, 0.0), u, shift=0.001, time_increment=1.0)
        got = bars.contact.resultants(about=(0.5, 0.0))
        force = -bars.reactions.reshape(-1, 3)[bars.top][:, :2].sum(axis=0)  # of the contact on the upper block
        self.assertLess(np.abs(got["normal"] + got["tangential"] - force).max(), 1e-6 * np.abs(force).max())
        self.assertEqual(got["contact"] + got["open"], len(bars.contact.areas))
        self.assertEqual(got["stick"] + got["slip"], got["contact"])
        self.assertLess(abs(got["area"] - 1.0), 1e-12)
        self.assertEqual(got["largest_pressure"], bars.contact.pressure[got["deepest"]])
        self.assertLess(abs(got["centre"][0] - 0.5 - got["moment"] / got["normal"][1]), 1e-3)
        self.assertGreater(bars.contact.energies["elastic_slip"], 0.0)

    def test_suggested_numbers(self):
        # two masses on a spring: central differences are stable up to the suggested step, and not beyond it
        got = ents.library().suggest(200.0, 0.5, 2.0, 3.0, 5.0)
        self.assertEqual(got["normal_stiffness"], 30 * 200 / 0.5)
        self.assertEqual(got["tangential_stiffness"], got["normal_stiffness"])
        for factor, bounded in ((0.99, True), (1.01, False)):
            dt, x, before = factor * got["time_step"], np.array([1.0, 0.0]), np.array([1.0, 0.0])
            for _ in range(2000):
                force = 2.0 * got["normal_stiffness"] * (x[1] - x[0])
                x, before = 2 * x - before + dt ** 2 * np.array([force / 3.0, -force / 5.0]), x
            self.assertEqual(bool(np.abs(x[0] - x[1]) < 1e3), bounded)
        self.assertEqual(ents.library().suggest(1.0, 1.0)["time_step"], 0.0)
        with self.assertRaises(ents.Error) as raised:
            ents.library().suggest(-1.0, 1.0)
        self.assertIn("modulus = -1", str(raised.exception))

    def test_bad_input(self):
        x, slave, master = [[0, 1], [1, 1], [0, 0], [1, 0]], [[1, 0]], [[2, 3]]
        warm = {"segment": "line2", "contact": {"normal": NORMAL, "heat": {"conductance": 1.0}}}
        cold = {"segment": "line2", "contact": {"normal": NORMAL}}
        for model, more, words in ((cold, {"temperature": 1.0}, "temperature is given"), (warm, {"temperature": [1.0]}, "temperature: the shape"),
                                   (warm, {"temperature": np.nan}, "temperature"), (warm, {"master_temperature": 1.0}, "master_temperature"),
                                   (warm, {"dofs": np.arange(8).reshape(4, 2)}, "dofs: the shape")):
            with self.assertRaises(ents.Error) as raised:
                ents.Contact(model, x, slave, master, **more)
            self.assertIn(words, str(raised.exception))
        contact = ents.Contact(warm, x, slave, master)
        with self.assertRaises(ents.Error) as raised:
            contact.update(np.zeros(8))
        self.assertIn("(12,) or (4, 3)", str(raised.exception))
        with self.assertRaises(ents.Error) as raised:
            contact.update(np.zeros(12), time_increment=-1.0)
        self.assertIn("time_increment", str(raised.exception))


if __name__ == "__main__":
    unittest.main()
