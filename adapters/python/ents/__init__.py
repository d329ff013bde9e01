# SPDX-License-Identifier: BSD-3-Clause
"""Contact elements of libents.so in Python: abi/ents.h through ctypes, with NumPy arrays. Nothing is compiled.

    import ents
    model = ents.Model({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 5e3}}})
    result = model.evaluate(slave, master, want="gap residual tangent")     # arrays by name: single elements
    contact = ents.Contact(model, positions, slave_facets, master_facets)   # two surfaces of your mesh (needs SciPy)
    residual, tangent = contact.update(u)

Conventions are those of ents.h: current positions, indices from 0, dofs node by node (slave, then master nodes, then multipliers), units of
the host. Matrices here are ordinary ones: tangent[e, i, j] = dR_i / du_j of element e. Arrays are converted to float64 / int64 and copied where they are
not so already; indices may be floating point numbers if they are whole. Calls release the interpreter's lock: threads that evaluate the same model run at the same time.

Mistakes raise ents.Error with the library's own message. What a cut of the step can cure (0 < status < 100) is in the "status" of a result that has
one entry for each element, with "step_factor" and "message"; all other functions raise ents.CutStep. No status is dropped.
"""
try:
    import numpy  # noqa: F401
except ModuleNotFoundError as error:
    raise ModuleNotFoundError("ents needs NumPy: apt-get install python3-numpy, or python3 -m pip install numpy") from error

from . import _structs
from ._arrays import CutStep, Error, _new  # noqa: F401
from ._library import Library, library
from ._model import Model
from ._structs import *  # noqa: F401,F403
from ._pose import Pose
from ._surface import Tree
from ._system import System
from .contact import Contact
from ._distributed import DistributedContact, Tangent

__version__: str
__all__ = ["Contact", "CutStep", "DistributedContact", "Error", "Library", "Model", "Pose", "System", "Tangent", "Tree", "library",
           "CONTRACT_MAJOR", "CONTRACT_MINOR", "ENDS_STRAIGHT", "ENDS_REPEATED", "ENDS_QUASI_CUBIC",
           "ENDS_QUASI_PARABOLIC", "Flag", "Need", "Shared", "Status", "QUANTITIES", "CONDITIONS"]


def __getattr__(name: str) -> str:
    if name == "__version__":  # that of the library, which is loaded at the first use
        return library().version()
    raise AttributeError(f"module 'ents' has no attribute '{name}'")
