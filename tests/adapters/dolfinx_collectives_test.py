"""mpirun -n P python3 -m mpi4py dolfinx_collectives_test.py FOLDER-OF-ents: bytes of collectives of the contact in dolfinx_block.py do not grow with the mesh.
The library is the one of the environment's ENTS_LIBRARY. Exit status 3: no dolfinx here."""
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import block  # noqa: E402
import dolfinx_block  # noqa: E402  exit status 3 without dolfinx
from counting import Counting  # noqa: E402
from mpi4py import MPI  # noqa: E402

CONTACT, SCENE = dolfinx_block.ents.Contact, pathlib.Path(sys.argv[1]) / "block.json"


class Collectives(unittest.TestCase):
    def bytes(self, refine):
        """Of one evaluation, in collectives."""
        counted = []

        def contact(*arguments, **options):
            if "comm" in options:
                counted.append(Counting(options["comm"]))
                options["comm"] = counted[0]
            return CONTACT(*arguments, **options)
        dolfinx_block.ents.Contact = contact
        try:
            host = dolfinx_block.Host(block.variant_of(SCENE, None), refine)
        finally:
            dolfinx_block.ents.Contact = CONTACT
        host.comm = Counting(host.comm)
        before = sum(counting.collective for counting in counted)
        host.contact_part()
        return sum(counting.collective for counting in [*counted, host.comm]) - before

    def test_they_do_not_grow_with_the_surface(self):
        few, many = self.bytes(1), self.bytes(4)
        if MPI.COMM_WORLD.rank == 0:
            print(f"bytes in collectives of an evaluation: {few}, with four times as many facets {many}")
        self.assertLessEqual(many, 1.2 * few)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
