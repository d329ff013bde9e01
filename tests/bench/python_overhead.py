#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""python_overhead.py: what Python adds to a batch of 10000 elements, over the time inside the library. From the top folder:

    ENTS_LIBRARY=build/lib/libents.so /usr/bin/python3 tests/bench/python_overhead.py"""
import statistics
import sys
import time

sys.path.insert(0, "adapters/python")
import numpy as np

import ents

m = ents.Model({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.5, 0.5]}, "contact": {"normal": {"type": "penalty", "stiffness": 1e5}}})
n = 10000; r = np.random.default_rng(1)
slave = np.c_[r.uniform(-.9, .9, (n, 2)), r.uniform(-.05, 0, n)]
master = np.tile(np.array([[-1., -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]), (n, 1, 1))
start = slave[:, :2].copy()
inside = [0.0]; call = type(m.library).call
def timed(self, *a, **k):
    t = time.perf_counter(); x = call(self, *a, **k); inside[0] += time.perf_counter() - t; return x
type(m.library).call = timed
out = m.evaluate(slave, master, start=start); shares = []
for _ in range(31):
    inside[0] = 0; t = time.perf_counter(); m.evaluate(slave, master, start=start, out=out); shares.append((time.perf_counter() - t) / inside[0] - 1)
print("overhead of Python, median of 31:", statistics.median(shares))
