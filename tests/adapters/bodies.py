"""Elastic bodies for tests of ents.Contact: elements of four nodes in the plane, of eight in space, assembled with NumPy. A node that is named
twice makes a triangle or a wedge of them."""
import numpy as np
import scipy.sparse as sparse


def stiffness(x, cells, young=1.0, poisson=0.3):
    """csr_matrix of linear elasticity (plane strain)."""
    d = x.shape[1]
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) if d == 2 else np.array(
        [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
    mu, la = young / (2 + 2 * poisson), young * poisson / (1 + poisson) / (1 - 2 * poisson)
    pairs = [(0, 0), (1, 1), (0, 1)] if d == 2 else [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]
    C = np.diag([2 * mu] * d + [mu] * (len(pairs) - d))
    C[:d, :d] += la
    Ke = np.zeros((len(cells), d * len(signs), d * len(signs)))
    for point in signs / np.sqrt(3):
        factors = (1 + signs * point) / 2
        dN = np.stack([signs[:, c] / 2 * np.prod(np.delete(factors, c, axis=1), axis=1) for c in range(d)])
        J = np.einsum("cn,enk->eck", dN, x[cells])
        g = np.linalg.solve(J, np.broadcast_to(dN, (len(cells), *dN.shape)))
        B = np.zeros((len(cells), len(pairs), d * len(signs)))
        for row, (i, j) in enumerate(pairs):
            B[:, row, i::d] = g[:, j]
            if i != j:
                B[:, row, j::d] = g[:, i]
        Ke += np.linalg.det(J)[:, None, None] * (B.transpose(0, 2, 1) @ C @ B)
    dofs = (d * cells[:, :, None] + np.arange(d)).reshape(len(cells), -1)
    i, j = np.broadcast_arrays(dofs[:, :, None], dofs[:, None, :])
    return sparse.coo_matrix((Ke.ravel(), (i.ravel(), j.ravel())), (x.size, x.size)).tocsr()


def block(low, high, cells):
    """Nodes [n][2], cells and numbers of the nodes [rows][columns] of a rectangle."""
    x, y = (np.linspace(a, b, n + 1) for a, b, n in zip(low, high, cells))
    n = np.arange(len(x) * len(y)).reshape(len(y), len(x))
    return (np.stack(np.meshgrid(x, y), -1).reshape(-1, 2), np.stack([n[:-1, :-1], n[:-1, 1:], n[1:, 1:], n[1:, :-1]], -1).reshape(-1, 4), n)


def two_blocks(lower, upper, widths=((0.0, 1.0), (0.0, 1.0)), height=0.5, gap=0.0, young=(1.0, 1.0)):
    """An upper rectangle on a lower one: positions, stiffness, rows of nodes of both (upper's are counted on)."""
    a, cells_a, n = block((widths[0][0], -height), (widths[0][1], 0.0), lower)
    b, cells_b, m = block((widths[1][0], gap), (widths[1][1], height + gap), upper)
    K = sparse.block_diag([stiffness(a, cells_a, young[0]), stiffness(b, cells_b, young[1])], "csr")
    return np.vstack([a, b]), K, n, len(a) + m


def chain(nodes):
    """Facets of two nodes along a row."""
    return np.column_stack([nodes[:-1], nodes[1:]])


def newton(contact, K, u, free, force=0.0, tolerance=1e-12, most=30):
    """Plain Newton iterations on the free dofs; returns u and how many there were."""
    from scipy.sparse.linalg import spsolve
    for iteration in range(most):
        residual, tangent = contact.update(u)
        r = (K @ u + residual - force)[free]
        if iteration and np.abs(r).max() <= tolerance:
            return u, iteration
        u = u.copy()
        u[free] -= spsolve((K + tangent)[free][:, free].tocsc(), r)
    raise AssertionError(f"no convergence: {np.abs(r).max()}")


def mixed_sheet(n=4, seed=0):
    """Nodes [k][2] of the unit square and facets: quadrilaterals, and in a chequered pattern pairs of triangles; inner nodes are moved."""
    a = np.linspace(0, 1, n + 1)
    x = np.stack(np.meshgrid(a, a), -1).reshape(-1, 2)
    inner = ((x > 0) & (x < 1)).all(axis=1)
    x[inner] += 0.1 / n * np.random.default_rng(seed).uniform(-1, 1, (inner.sum(), 2))
    k = np.arange(len(x)).reshape(n + 1, n + 1)
    facets = []
    for i, j in np.ndindex(n, n):
        q = [k[i, j], k[i, j + 1], k[i + 1, j + 1], k[i + 1, j]]
        facets += [q] if (i + j) % 2 else [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]
    return x, [[int(node) for node in facet] for facet in facets]
