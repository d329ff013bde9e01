"""distributed_contact.py: what tests of a distributed ents.Contact share. Surfaces that every process makes as a whole, and of which each gives its part."""
import numpy as np

PENALTY = {"normal": {"type": "penalty", "stiffness": 800.0}}
FRICTION = {**PENALTY, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 700.0}}


def chain(rng, cells, low, high, y):
    """Positions and facets of a row of nodes from left to right: the normal is +y."""
    x = np.column_stack([np.linspace(low, high, cells + 1), y + 0.2 / cells * rng.uniform(-1, 1, cells + 1)])
    return x, np.column_stack([np.arange(cells), np.arange(1, cells + 1)])


def sheet(rng, cells, low, high, z):
    """Positions and facets of a plane of quadrilaterals, counter-clockwise seen from above."""
    a = [np.linspace(low[i], high[i], cells[i] + 1) for i in (0, 1)]
    x = np.stack([*np.meshgrid(*a), np.zeros((cells[1] + 1, cells[0] + 1))], -1).reshape(-1, 3)
    x[:, 2] = z + 0.01 * rng.uniform(-1, 1, len(x))
    k = np.arange(len(x)).reshape(cells[1] + 1, cells[0] + 1)
    return x, np.stack([k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]], -1).reshape(-1, 4)


def flat(cells=12):
    """In the plane: the slave above the master."""
    rng = np.random.default_rng(3)
    (master, facets), (slave, above) = chain(rng, 3 * cells // 2, 0, 6, 0.0), chain(rng, cells, 1.2, 4.1, 0.03)
    return np.vstack([master, slave]), len(master) + above[:, ::-1], facets


def sheets(cells=7):
    """In space."""
    rng = np.random.default_rng(4)
    (master, facets), (slave, above) = sheet(rng, (12, 6), (0, 0), (6, 3), 0.0), sheet(rng, (cells, cells - 2), (0.9, 0.4), (3.8, 2.5), 0.015)
    return np.vstack([master, slave]), len(master) + above[:, ::-1], facets


def triangles():
    """In space, of triangles."""
    x, slave, master = sheets()
    cut = lambda quads: np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return x, cut(slave), cut(master)


class Part:
    """The part of a process: nodes and facets by `owner` [nodes], a function of positions; nodes in an order of its own."""

    def __init__(self, comm, x, slave, master, owner, **extra):
        who = owner(x) % comm.size
        mine = lambda facets: facets[who[facets].min(axis=1) == comm.rank]
        self.slave, self.master = mine(slave), mine(master)
        known = np.unique(np.concatenate([np.flatnonzero(who == comm.rank), self.slave.ravel(), self.master.ravel()]))
        self.nodes = np.random.default_rng(comm.rank).permutation(known)
        place = np.full(len(x), -1)
        place[self.nodes] = np.arange(len(self.nodes))
        self.arguments = dict(positions=x[self.nodes], slave=place[self.slave], master=place[self.master], numbers=self.nodes, owners=who[self.nodes], comm=comm)

    def give(self, u):
        """The part of displacements [nodes][d]; rubbish where another process owns the node."""
        mine = u[self.nodes].copy()
        mine[self.arguments["owners"] != self.arguments["comm"].rank] = np.nan
        return mine


def total(comm, rows, residual, tangent=None):
    """The sums of all processes, dense."""
    r = np.zeros(rows)
    np.add.at(r, residual[0], residual[1])
    k = None
    if tangent is not None:
        k = np.zeros((rows, rows))
        i, j, values = tangent.triplets()
        np.add.at(k, (i, j), values)
        k = comm.allreduce(k)
    return comm.allreduce(r), k
