"""petsc_test.py PROGRAM MPIRUN: petsc_sheets, whose surfaces are distributed, finds the same forces with 1, 2, 3 and 4 processes, each with a part of the
surfaces. Exit status 3: the program was not built, or there is no mpirun."""
import os
import re
import subprocess
import sys
import unittest

PROGRAM, MPIRUN = sys.argv[1:3]
SAME = 1e-10  # of the largest force: Newton's iteration ends at 1e-11, the forces are about 20
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def run(processes, *options):
    return started("-n", str(processes), PROGRAM, *options)


def started(*arguments):
    command = [MPIRUN, "--oversubscribe", *arguments]
    return subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, timeout=200)


def answer(processes, *options):
    """Forces [increment][3], iterations [increment], the last line's numbers."""
    done = run(processes, *options)
    if done.returncode:
        raise AssertionError(f"{processes} processes: exit status {done.returncode}\n{done.stdout}{done.stderr}")
    lines = [line.split() for line in done.stdout.splitlines() if line.startswith("time")]
    sizes = [int(number) for number in re.findall(r"\d+", done.stdout.splitlines()[-1])]
    return [[float(word) for word in line[5:8]] for line in lines], [line[3] for line in lines], sizes


def difference(forces, wanted):
    return max(abs(a - b) for x, y in zip(forces, wanted) for a, b in zip(x, y)) / max(abs(a) for x in wanted for a in x)


class Sheets(unittest.TestCase):
    def test_numbers_of_processes(self):
        wanted, iterations, (nodes, facets, near, searches) = answer(1)
        self.assertGreaterEqual(len(wanted), 10)
        self.assertGreater(wanted[-1][0], 0.25 * -wanted[-1][2])  # it slides: friction is 0.3
        self.assertGreater(searches, 2)
        for processes in (2, 3, 4):  # the upper sheet slides by 0.7 from 0.55 .. 1.75: over the borders of strips of 1.5, 1, 0.75
            with self.subTest(processes=processes):
                forces, needed, sizes = answer(processes)
                self.assertEqual(len(forces), len(wanted))
                self.assertLess(difference(forces, wanted), SAME)
                self.assertEqual(needed, iterations)
                self.assertLess(sizes[0], nodes * 1.6 / processes)
                self.assertLess(sizes[1], facets * 1.6 / processes)
                self.assertLess(sizes[2], near)

    def test_ghosts_that_come_late(self):
        """Against one process that knows all facets from the first search on."""
        (wanted, _, all_at_once), (forces, _, later) = answer(1, "-n", "2", "-margin", "10"), answer(3, "-n", "2", "-margin", "0.07")
        self.assertLess(difference(forces, wanted), SAME)
        self.assertEqual((all_at_once[2], all_at_once[3]), (24 * 16, 1))
        self.assertGreater(later[3], 5)
        self.assertLess(later[2], all_at_once[2] / 2)

    def test_mistakes_end_all_processes(self):
        done = run(2, "-steps", "0")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("-n and -steps are at least 1", done.stderr)
        self.assertIn("usage: mpirun -n P petsc_sheets", run(1, "-help").stdout)

    def test_a_process_that_fails_alone_ends_all(self):
        """The other would wait for it: until this test's limit of time."""
        done = started("-n", "1", PROGRAM, ":", "-n", "1", PROGRAM, "-steps", "0")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("process 1: -n and -steps are at least 1", done.stderr)


if __name__ == "__main__":
    if not os.access(PROGRAM, os.X_OK) or not MPIRUN or not os.access(MPIRUN, os.X_OK):
        print("no PETSc or MPI here (Debian: libpetsc-real-dev openmpi-bin)")
        sys.exit(3)
    unittest.main(argv=sys.argv[:1])
