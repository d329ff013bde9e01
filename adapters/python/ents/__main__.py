# SPDX-License-Identifier: BSD-3-Clause
"""usage: python3 -m ents [doctor]
       python3 -m ents generate EXPRESSION ...     a height function in C; see generate --help
       python3 -m ents hosts MODEL.json            nodes and history variables of a model in each host; see hosts --help

Prints version, file and instruction set of the library, names missing packages, and compares a contact element with its known results.

exit status: 0 all is well; 1 something that ents needs is missing or the check fails; 2 wrong command line"""
import platform
import sys

import numpy as np

import ents

# What tests/clients/first.c prints.
GAP, RESIDUAL = -0.064165188875810616, 6.8817638541031743
FIRST = {"segment": "quad4", "height": {"type": "sine", "amplitude": 0.05, "wave_vector": [0.5, 0.25]},
         "contact": {"normal": {"type": "penalty", "stiffness": 1000}}}
SQUARE = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])


def check():
    """The first call of the manual against its known numbers, and its tangent against central differences. Returns what is wrong, or None."""
    model = ents.Model(FIRST)
    x = np.vstack([[[-0.4, 0.3, -0.1]], SQUARE])
    evaluate = lambda x: model.evaluate(x[:1], x[1:], "gap residual tangent")
    r = evaluate(x)
    for name, value, wanted in (("gap", r["gap"][0], GAP), ("residual", r["residual"][0, 0], RESIDUAL)):
        if not abs(value - wanted) <= 1e-13 * abs(wanted):
            return f"{name} is {value!r}, it should be {wanted!r}"
    h, worst = 1e-6, 0.0
    for k in range(15):
        step = h * np.eye(15)[k].reshape(5, 3)
        difference = (evaluate(x + step)["residual"][0] - evaluate(x - step)["residual"][0]) / (2 * h)
        worst = max(worst, np.abs(difference - r["tangent"][0, :, k]).max() / np.abs(r["tangent"]).max())
    return None if worst < 1e-7 else f"the tangent differs from differences of the residual by {worst:.1e}"


def main():
    if sys.argv[1:2] == ["generate"]:
        from ents import _generate
        return _generate.main(sys.argv[2:])
    if sys.argv[1:2] == ["hosts"]:
        from ents import _hosts
        return _hosts.main(sys.argv[2:])
    if sys.argv[1:] in (["-h"], ["--help"]):
        print(__doc__)
        return 0
    if sys.argv[1:] not in ([], ["doctor"]):
        print(__doc__, file=sys.stderr)
        return 2
    try:
        library = ents.library()
    except ents.Error as error:
        print(f"library            missing: {error}")
        return 1
    layout = ents.Model(FIRST).layout
    print(f"ents               {library.version()}, contract {ents.CONTRACT_MAJOR}.{ents.CONTRACT_MINOR}")
    print(f"library            {library.path}")
    kernels = layout.instruction_set.decode()
    print(f"instruction set    {kernels} ({'slow: the library is built for other processors' if kernels == 'none' else 'results do not depend on it'})")
    print(f"Python, NumPy      {platform.python_version()}, {np.__version__}")
    for name, purpose, package in (("scipy", "ents.Contact", "python3-scipy"), ("matplotlib", "Contact.plot", "python3-matplotlib")):
        try:
            print(f"{name:<18} {__import__(name).__version__}")
        except ImportError as error:
            print(f"{name:<18} missing ({error}); {purpose} needs it: apt-get install {package}, or python3 -m pip install {name}")
    wrong = check()
    print(f"check              {wrong or 'passed: known numbers to 1e-13, tangent against differences to 1e-7'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
