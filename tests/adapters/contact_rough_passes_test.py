"""contact_rough_passes_test.py FOLDER-OF-ents: two passes of ents.Contact over two sides with one height. Exit status 3: no NumPy or SciPy here."""
import sys
import unittest

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy  # noqa: F401
    from bodies import chain, newton, two_blocks
except ModuleNotFoundError as error:
    print(f"contact_rough_passes_test.py: {error} (Debian: python3-numpy, python3-scipy)")
    sys.exit(3)
sys.path.insert(0, sys.argv[1])
import ents  # noqa: E402


def model(stiffness=50.0):
    return {"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": stiffness}}}


class RoughPasses(unittest.TestCase):
    WAVE = {"type": "sine", "amplitude": 0.003, "wave_vector": [2], "phase": 0.6}

    def rough_blocks(self, n, two_pass, shift=0.0):
        """Blocks of n and 5 n / 4 cells; waves on both, the upper ones moved by `shift`. Positions, stiffness, free dofs, nodes above, and the contact."""
        x, k, below, above = two_blocks((n, n // 2), (n + n // 4, n // 2), gap=0.006)
        s = x[:, :1] + shift
        contact = ents.Contact({**model(stiffness=300.0), "height": self.WAVE}, x, chain(above[0][::-1]), chain(below[-1]), surface_coordinates="x", reach=0.05, sampling=4,
                               slave_height=self.WAVE, slave_surface_coordinates=s, two_pass=two_pass)
        held = np.zeros(x.shape, bool)
        held[below[0]] = held[above[-1]] = held[np.abs(x[:, 0] - 0.5) > 0.5 - 1e-9, 0] = True
        return x, k, np.flatnonzero(~held.ravel()), above[-1], contact

    def test_waves_on_waves_are_those_of_one_pass(self):
        """Forces of one and of two passes, with 8, 16 and 32 cells: crests on crests they differ by 1.4e-3, 5.9e-4, 2.8e-5, beside them by 2.4e-3, 3.0e-5, 2.9e-5:
        within the discretisation, of second order over both refinements."""
        for shift in (0.0, 0.1):
            apart = []
            for n in (8, 16, 32):
                forces = []
                for two_pass in (False, True):
                    x, k, free, top, contact = self.rough_blocks(n, two_pass, shift)
                    u = np.zeros(x.shape)
                    for depth in np.arange(1, 9) * 1.25e-3:
                        u[top, 1] = -depth
                        u = newton(contact, k, u.ravel(), free)[0].reshape(x.shape)
                        contact.commit()
                    self.assertTrue(0.1 < (contact.pressure > 0).mean() < 0.6)
                    sums = contact.residual.reshape(-1, 2).sum(axis=0)
                    self.assertLess(np.abs(sums).max(), 1e-14)
                    forces.append((k @ u.ravel()).reshape(x.shape)[top, 1].sum())
                apart.append(abs(forces[0] / forces[1] - 1))
            print(f"waves moved by {shift}: one and two passes differ by " + ", ".join(f"{a:.1e}" for a in apart))
            self.assertLess(apart[0], 3e-3)
            self.assertLess(apart[1], 8e-4)
            self.assertLess(apart[2], apart[0] / 16)

    def test_tangent_of_waves_on_waves(self):
        x, k, free, top, contact = self.rough_blocks(8, True, 0.1)
        contact.update(np.zeros(contact.rows))
        contact.commit()
        rng = np.random.default_rng(5)
        u = rng.uniform(-3e-4, 3e-4, x.shape)
        u[len(x) - len(x) * 3 // 5:, 1] -= 2e-3
        v, t = rng.uniform(-1, 1, contact.rows), 1e-6
        residual, tangent = contact.update(u.ravel())
        self.assertTrue((contact.pressure > 0)[contact._both.of_points == 0].any() and (contact.pressure > 0)[contact._both.of_points == 1].any())
        ahead = [contact.update(u.ravel() + k * t * v, tangent=False)[0] for k in (-2, -1, 1, 2)]
        slope = (8 * (ahead[2] - ahead[1]) - (ahead[3] - ahead[0])) / (12 * t)
        self.assertLess(np.abs(slope - tangent @ v).max(), 1e-8 * np.abs(tangent).max())
        self.assertLess(np.abs(residual.reshape(-1, 2).sum(axis=0)).max(), 1e-14)
        moments = (x[:, 0] + u[:, 0]) * residual.reshape(-1, 2)[:, 1] - (x[:, 1] + u[:, 1]) * residual.reshape(-1, 2)[:, 0]
        self.assertLess(abs(moments.sum()), 1e-14)

    def test_heights_of_two_passes_are_one(self):
        x, _, below, above = two_blocks((8, 4), (11, 4))
        slave, master = chain(above[0][::-1]), chain(below[-1])
        law = {**model(), "height": self.WAVE}
        for options, words in (({"slave_height": {**self.WAVE, "phase": 0.0}}, "side by side in one map"), ({"slave_height": self.WAVE, "surface_coordinates": "x"}, "or none of them"),
                               ({"slave_height": self.WAVE, "slave_surface_coordinates": "x"}, "or none of them"),
                               ({"slave_height": self.WAVE, "surface_coordinates": "x", "slave_surface_coordinates": "xy"}, "wanted are 1"),
                               ({"slave_height": self.WAVE, "sampling": 0}, "sampling: 0")):
            with self.subTest(words), self.assertRaisesRegex(ents.Error, words):
                ents.Contact(law, x, slave, master, two_pass=True, **options)
        with self.assertRaisesRegex(ents.Error, "write the same height into the model"):
            ents.Contact(model(), x, slave, master, two_pass=True, slave_height=self.WAVE)
        varying = {**law, "parameters": {"top": 0.1}, "height": {**self.WAVE, "amplitude": "top"}}
        with self.assertRaisesRegex(ents.Error, "varies"):
            ents.Contact(varying, x, slave, master, two_pass=True, slave_height=ents.Model(varying))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
