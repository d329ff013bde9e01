"""mpirun -n P python3 -m mpi4py distributed_contact_test.py FOLDER-OF-ents: ents.Contact(..., comm=comm) against one that knows the whole surfaces.
The library is the one of the environment's ENTS_LIBRARY. Exit status 3: no NumPy, SciPy or mpi4py here."""
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy  # noqa: F401
    from mpi4py import MPI
except ModuleNotFoundError as error:
    print(f"distributed_contact_test.py: skipped: {error} (Debian: python3-numpy, python3-scipy, python3-mpi4py)")
    sys.exit(3)
sys.path.insert(0, sys.argv[1])
import ents  # noqa: E402
from counting import Counting  # noqa: E402
from distributed_contact import FRICTION, PENALTY, Part, flat, sheets, total, triangles  # noqa: E402

COMM = MPI.COMM_WORLD
WAVE, WAVES = ({"type": "sine", "amplitude": 0.02, "wave_vector": wave} for wave in ([0.7], [0.7, 0.3]))
CASES = {  # name: mesh, model, options
    "height, friction": (flat, {"segment": "line2", "height": WAVE, "contact": FRICTION}, {"surface_coordinates": "x"}),
    "bspline4": (flat, {"segment": "bspline4", "height": WAVE, "contact": FRICTION}, {"surface_coordinates": "x"}),
    "quasi": (flat, {"segment": "bspline4", "height": WAVE, "contact": FRICTION}, {"surface_coordinates": "x", "ends": ents.ENDS_QUASI_CUBIC}),
    "points inside facets": (flat, {"segment": "line2", "contact": FRICTION}, {"sampling": 3}),
    "offset": (flat, {"segment": "line2", "contact": {**PENALTY, "offset": 0}}, {"offset": -0.02}),
    "quad4, height, friction": (sheets, {"segment": "quad4", "height": WAVES, "contact": FRICTION}, {"surface_coordinates": "xy"}),
    "tri3": (triangles, {"segment": "tri3", "contact": FRICTION}, {}),
    "bspline16": (sheets, {"segment": "bspline16", "height": WAVES, "contact": FRICTION}, {"surface_coordinates": "xy"}),
}
STRIPS = lambda x: np.floor(x[:, 0] * COMM.size / 6.0001).astype(int)
SCATTERED = lambda x: np.floor(1e4 * np.abs(np.sin(1e3 * x).sum(axis=1))).astype(int)
# Sums over up to 12 contributions in another order: some roundings of 1.1e-16 of the largest force; the tangents of slip hold differences of these.
SAME = 1e-13
differences = {"forces": 0.0, "tangents": 0.0}  # the largest ones, over the largest entry; printed at the end


class Comparison:
    """One contact that knows all, one that is distributed, on the same displacements."""

    def __init__(self, mesh, model, options, owner, reach=0.5, margin=0.3):
        self.x, self.slave, self.master = mesh()
        self.whole = ents.Contact(model, self.x, self.slave, self.master, reach=reach, **options)
        self.part = Part(COMM, self.x, self.slave, self.master, owner)
        self.contact = ents.Contact(model, **self.part.arguments, reach=reach, margin=margin, **options)

    def update(self, test, u):
        r, k = self.whole.update(u)
        residual, tangent = total(COMM, u.size, *self.contact.update(self.part.give(u)))
        for name, difference, largest in (("forces", residual - r, np.abs(r).max()), ("tangents", tangent - k.toarray(), np.abs(k).max())):
            differences[name] = max(differences[name], np.abs(difference).max() / (largest + 1e-300))
        test.assertLess(np.abs(residual - r).max(), SAME * np.abs(r).max() + 1e-300)
        test.assertLess(np.abs(tangent - k.toarray()).max(), SAME * np.abs(k).max() + 1e-300)
        pressed = COMM.allreduce(float(self.contact.pressure @ self.contact.areas))
        test.assertAlmostEqual(pressed, self.whole.pressure @ self.whole.areas, delta=SAME * max(pressed, 1))
        return r

    def commit(self):
        self.whole.commit()
        self.contact.commit()

    def slide(self, step, iteration=0):
        """Displacements: the slave slides to the right, 1.5 in 12 steps, the master stretches."""
        u, top = np.zeros(self.x.shape), np.unique(self.slave)
        u[:, 0] += 0.01 * np.sin(self.x[:, 0])
        u[top, 0] += 0.13 * step + 0.01 * iteration
        u[top, -1] -= 0.03 + 0.002 * step
        return u


class SameAnswer(unittest.TestCase):
    def slides(self, comparison, steps=6, pace=1):
        """Returns the segments, of all processes, that slave points of this process had, and whether friction acted."""
        segments, force = set(), 0.0
        for step in range(steps):
            for iteration in range(2):
                r = comparison.update(self, comparison.slide(pace * step, iteration))
            comparison.commit()
            force = max(force, np.abs(r.reshape(comparison.x.shape)[np.unique(comparison.slave), 0].sum()))
            segments |= set(comparison.contact.segment.tolist())
        return segments - {-1}, force

    def test_slave_points_slide_over_borders(self):
        for name, (mesh, model, options) in CASES.items():
            with self.subTest(name):
                comparison = Comparison(mesh, model, options, STRIPS)
                segments, force = self.slides(comparison, *((4, 3) if name == "bspline16" else (8, 1.6)))  # whose searches are slow
                self.assertTrue(force > 1 or "friction" not in model["contact"])
                first = COMM.allgather(len(comparison.part.master))  # facets are numbered process by process
                of_process = np.searchsorted(np.cumsum(first), sorted(segments), side="right")
                crossed = COMM.allreduce(int(len(np.unique(of_process)) > 1))
                self.assertGreaterEqual(crossed, min(COMM.size - 1, 1))
                self.assertGreater(comparison.contact.searches, 2)
                self.assertLess(comparison.contact.searches, 12)  # ghosts are kept while nothing has moved by the margin

    def test_nodes_of_all_processes_in_all_places(self):
        for name in ("height, friction", "quad4, height, friction", "bspline4"):
            with self.subTest(name):
                self.slides(Comparison(*CASES[name], SCATTERED), 4, 2)

    def test_processes_without_contact(self):
        """Neighbours alone; all on the last process, others without nodes; slave and master on two processes."""
        halves = lambda x: (x[:, 0] > 4.9).astype(int)
        last = lambda x: np.full(len(x), COMM.size - 1)
        sides = lambda x: (x[:, 1] > 0.02).astype(int)
        for name, owner in (("neighbours", halves), ("one process", last), ("one side each", sides)):
            with self.subTest(name):
                comparison = Comparison(*CASES["height, friction"], owner)
                self.slides(comparison, 4)
                if name != "neighbours" and COMM.size > 1 and COMM.rank == 0:
                    self.assertEqual(len(comparison.contact.gap), 0 if name == "one process" else comparison.contact.sizes["slave_points"])

    def test_a_surface_that_folds_onto_that_of_another_process(self):
        """One row of nodes, whose right end folds over until it touches the left end, which no process near it has known."""
        n = 61
        x = np.column_stack([np.linspace(0, 6, n), np.zeros(n)])
        chain = np.column_stack([np.arange(n - 1), np.arange(1, n)])
        comparison = Comparison(lambda: (x, chain[40:], chain[:26]), {"segment": "line2", "contact": FRICTION}, {}, STRIPS, reach=0.2, margin=0.2)
        touched = 0.0
        for step in range(4, 25):
            angle = min(step / 20, 1) * np.pi * np.clip((x[:, 0] - 2.7) / 0.9, 0, 1)  # the curvature of the middle
            s = np.diff(x[:, 0], prepend=0.0)
            now = np.column_stack([np.cumsum(s * np.cos(angle)), np.cumsum(s * np.sin(angle))])
            now[40:, 1] -= (now[60, 1] + 0.01) * max(0, min(step / 20, 1)) ** 8  # down onto it
            now[40:, 0] += 0.05 * max(0, step - 20)
            r = comparison.update(self, now - x)
            comparison.commit()
            touched = max(touched, np.abs(r).max())
        self.assertGreater(touched, 0.1)
        self.assertLess(comparison.contact.sizes["ghost_facets"], 27)

    def test_a_step_that_is_cut_leaves_no_trace(self):
        comparison = Comparison(*CASES["height, friction"], STRIPS)
        comparison.update(self, comparison.slide(0))
        comparison.commit()
        deep = comparison.slide(1)
        deep[np.unique(comparison.slave), 0] += 20
        for contact, u in ((comparison.whole, deep), (comparison.contact, comparison.part.give(deep))):
            with self.assertRaises(ents.CutStep) as caught:
                contact.update(u)
            self.assertTrue(0 < caught.exception.step_factor < 1)
        with self.assertRaises(ents.Error):
            comparison.contact.commit()
        for step in range(1, 4):
            comparison.update(self, comparison.slide(step))
            comparison.commit()


    def test_restart(self):
        comparison = Comparison(*CASES["height, friction"], STRIPS)
        for step in range(3):
            comparison.update(self, comparison.slide(step))
            comparison.commit()
        with tempfile.TemporaryDirectory() as folder:
            comparison.contact.save(f"{folder}/state.npz")
            again = Comparison(*CASES["height, friction"], STRIPS)
            again.contact.load(f"{folder}/state.npz")
            if COMM.size > 1:
                other = Comparison(*CASES["height, friction"], SCATTERED)
                with self.assertRaises(ents.Error) as caught:
                    other.contact.load(f"{folder}/state.npz")
                self.assertIn("other parts of the surfaces", str(caught.exception))
        comparison.contact = again.contact
        for step in range(3, 5):
            comparison.update(self, comparison.slide(step))
            comparison.commit()


class Failures(unittest.TestCase):
    """One process fails: all raise. Where one does not, this test ends by its limit of time."""

    def each(self, call, kind, words):
        for who in {0, COMM.size - 1}:
            with self.assertRaises(kind) as caught:
                call(COMM.rank == who)
            self.assertIn(words, str(caught.exception))
            if COMM.size > 1 and COMM.rank != who:
                self.assertIn(f"process {who} of {COMM.size}", str(caught.exception))

    def test_updates(self):
        comparison = Comparison(*CASES["height, friction"], SCATTERED)
        contact, part = comparison.contact, comparison.part
        good = part.give(comparison.slide(0))

        def broken(value):
            u = good.copy()
            u[part.arguments["owners"] == COMM.rank] = value
            return u
        self.each(lambda here: contact.update(broken(np.nan) if here else good), ents.CutStep, "singular matrix")
        self.each(lambda here: contact.update(good[1:] if here else good), ents.Error, "the shape")
        comparison.update(self, comparison.slide(0))

        def raises(*arguments, **options):
            raise MemoryError("no room")

        def failing(here):  # in the middle of a search
            contact.search()
            if here:
                contact._own.points = raises
            try:
                contact.update(good)
            finally:
                contact._own.__dict__.pop("points", None)
        self.each(failing, Exception, "no room")
        comparison.update(self, comparison.slide(0))

    def test_constructors(self):
        x, slave, master = flat()
        part = Part(COMM, x, slave, master, SCATTERED)
        model = {"segment": "line2", "contact": PENALTY}

        def wrong(**others):
            return lambda here: ents.Contact(model, **{**part.arguments, **(others if here else {})})
        self.each(wrong(slave=[[0, 999]]), ents.Error, "node 999 does not exist")
        self.each(wrong(positions=part.arguments["positions"] + np.inf), ents.Error, "not finite")
        self.each(wrong(owners=np.full(len(part.nodes), 99)), ents.Error, "owners: from")
        self.each(wrong(numbers=np.zeros(len(part.nodes), int)), ents.Error, "twice")
        with self.assertRaises(ents.Error) as caught:
            ents.Contact(model, **{**part.arguments, "slave": part.arguments["slave"][:, ::-1]}).update(np.zeros(part.arguments["positions"].shape))
        self.assertIn("look the same way", str(caught.exception))
        with self.assertRaises(ents.Error) as caught:
            ents.Contact({"segment": "line2", "contact": {**PENALTY, "heat": {"conductance": 1.0}}}, **part.arguments)
        self.assertIn("no temperatures yet", str(caught.exception))

    def test_reach_is_the_same_everywhere(self):
        if COMM.size > 1:
            part = Part(COMM, *flat(), STRIPS)
            with self.assertRaises(ents.Error) as caught:
                ents.Contact({"segment": "line2", "contact": PENALTY}, **part.arguments, reach=1.0 + COMM.rank)
            self.assertIn("give the same on all processes", str(caught.exception))
            with self.assertRaises(ents.Error) as caught:
                ents.Contact({"segment": "line3" if COMM.rank else "line2", "contact": PENALTY}, **part.arguments)
            self.assertIn("differ between processes", str(caught.exception))


class Messages(unittest.TestCase):
    def counted(self, cells):
        """Bytes of collectives, and of messages, of 8 updates on a surface of 3 cells / 2 facets."""
        counting = Counting(COMM)
        part = Part(COMM, *flat(cells), STRIPS)
        contact = ents.Contact({"segment": "line2", "contact": FRICTION}, **{**part.arguments, "comm": counting}, reach=0.3)
        for step in range(8):
            u = np.zeros(part.arguments["positions"].shape)
            u[part.nodes > 3 * cells // 2] = [0.1 * step, -0.03]
            contact.update(u)
            contact.commit()
        return counting, contact, part

    def test_no_collective_grows_with_the_surface(self):
        (few, *_), (many, contact, _) = self.counted(12), self.counted(96)
        if COMM.rank == 0:
            print(f"bytes of a collective: {few.collective / few.calls:.1f} with 18 facets, {many.collective / many.calls:.1f} with 144")
        self.assertGreater(few.collective, 0)
        self.assertLess(many.collective, 200 * 8 * (12 + COMM.size))  # numbers of processes, in some 100 calls
        self.assertLessEqual(many.collective / many.calls, 1.5 * few.collective / few.calls)
        if COMM.size > 1:
            self.assertGreater(COMM.allreduce(many.sent), 0)
            self.assertEqual(COMM.allreduce(many.sent), COMM.allreduce(contact.sizes["bytes_sent"]))

    def test_the_counter_sees_positions_that_go_to_all(self):
        """What a program does that sends all positions to all processes."""
        few, many = Counting(COMM), Counting(COMM)
        for counting, nodes in ((few, 20), (many, 320)):
            x = np.zeros((nodes, 2))
            counting.Allreduce(x, np.empty_like(x), op=MPI.SUM)
        if COMM.rank == 0:
            print(f"the same, an Allreduce of all positions: {few.collective / few.calls:.1f} with 20 nodes, {many.collective / many.calls:.1f} with 320")
        self.assertGreater(many.collective / many.calls, 1.5 * few.collective / few.calls)


if __name__ == "__main__":
    result = unittest.main(argv=[sys.argv[0], *sys.argv[2:]], exit=False, verbosity=1 if COMM.rank == 0 else 0).result
    if COMM.rank == 0:
        print("largest difference from one contact that knows all:", *(f"{name} {value:.1e}" for name, value in differences.items()))
    sys.exit(not COMM.allreduce(result.wasSuccessful(), op=MPI.LAND))
