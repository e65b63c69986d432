"""Coefficients of Blanes and Moan's splittings for Hamiltonians with quadratic kinetic energy, to 34 digits.

S. Blanes & P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313, table 3, print fifteen digits. This script takes them as the start
of Newton's method on all order conditions of Nystrom's trees up to the order, in 60 digits, with the smallest correction (the
conditions depend on one another, and the coefficients are not all determined).

    python3 testdata/scripts/nystrom_splittings.py
"""

from functools import lru_cache

from mpmath import mp, mpf, nstr

mp.dps = 60


@lru_cache(maxsize=None)
def forests(order, most):
    """Multisets of children that fill `order`: a velocity (order 1) or a tree of order r (r + 1), none above `most` in the list."""
    if order == 0:
        return [()]
    children = [(1, "v")] + [(r + 1, t) for r in range(1, order) for t in trees(r)]
    found = []
    for index, (size, child) in enumerate(children):
        if size <= order and index <= most:
            found += [rest + (child,) for rest in forests(order - size, index)]
    return found


@lru_cache(maxsize=None)
def trees(order):
    """Nystrom's trees with roots f, as tuples of children."""
    return forests(order - 1, 10**9)


def size(tree):
    return 1 + sum(1 if child == "v" else size(child) + 1 for child in tree)


def exact(tree):
    """The tree's derivative at time s is this times s to the power size - 1."""
    value = mpf(1)
    for child in tree:
        if child != "v":
            value *= exact(child) / (size(child) * (size(child) + 1))
    return value


def conditions(drifts, kicks, order):
    """Sums of b times the elementary weights, less their exact values. Drift i comes before kick i; one more follows."""
    nodes, at = [], mpf(0)
    for drift in drifts[: len(kicks)]:
        at += drift
        nodes.append(at)

    @lru_cache(maxsize=None)
    def weights(tree):
        values = [mpf(1)] * len(kicks)
        for child in tree:
            if child == "v":
                values = [v * c for v, c in zip(values, nodes)]
                continue
            inner = weights(child)
            for i in range(len(kicks)):
                values[i] *= sum(kicks[j] * (nodes[i] - nodes[j]) * inner[j] for j in range(i))
        return values

    residuals = [sum(drifts) - 1]
    for r in range(1, order + 1):
        for tree in trees(r):
            found = sum(b * w for b, w in zip(kicks, weights(tree)))
            residuals.append(found - exact(tree) / r)
    return residuals


def polish(free, scheme, order):
    """Newton's method with the smallest correction, by the normal equations of the transposed Jacobian with a pseudo-inverse."""
    for _ in range(6):
        residuals = conditions(*scheme(free), order)
        step = mpf(10) ** -30
        columns = []
        for k in range(len(free)):
            moved = list(free)
            moved[k] += step
            columns.append([(a - b) / step for a, b in zip(conditions(*scheme(moved), order), residuals)])
        # Independent rows by Gram-Schmidt; dependent conditions have dependent residuals.
        basis, right = [], []
        for i, residual in enumerate(residuals):
            row, value = [column[i] for column in columns], residual
            for other, known in zip(basis, right):
                part = sum(x * y for x, y in zip(row, other))
                row = [x - part * y for x, y in zip(row, other)]
                value -= part * known
            length = mp.sqrt(sum(x * x for x in row))
            if length > mpf(10) ** -9:
                basis.append([x / length for x in row])
                right.append(value / length)
        free = [x - sum(b[k] * v for b, v in zip(basis, right)) for k, x in enumerate(free)]
    return free, max(abs(x) for x in conditions(*scheme(free), order)), len(basis)


def drifts_first(free):
    a, b = list(free[:7]), list(free[7:])
    half = b + [mpf(1) / 2 - sum(b)]
    return a + [1 - 2 * sum(a)] + a[::-1], half + half[::-1]


def show(name, scheme, free, order):
    start = [mpf(x) for x in free]
    found, residual, rank = polish(start, scheme, order)
    moved = max(abs(x - y) for x, y in zip(found, start))
    print(f"{name}: residual {nstr(residual, 3)}, moved by {nstr(moved, 3)}, {rank} independent conditions")
    drifts, kicks = scheme(found)
    print("  drifts", [nstr(x, 34) for x in drifts[: (len(drifts) + 1) // 2]])
    print("  kicks ", [nstr(x, 34) for x in kicks[: (len(kicks) + 1) // 2]])


def four(free):
    b, a = list(free[:3]), list(free[3:])
    drifts = a + [mpf(1) / 2 - sum(a)]
    return [mpf(0)] + drifts + drifts[::-1] + [mpf(0)], b + [1 - 2 * sum(b)] + b[::-1]


def six(free):
    b, a = list(free[:5]), list(free[5:])
    kicks = b + [mpf(1) / 2 - sum(b)]
    return [mpf(0)] + a + [1 - 2 * sum(a)] + a[::-1] + [mpf(0)], kicks + kicks[::-1]


if __name__ == "__main__":
    show("order 4, 6 stages", four,
         ["0.0829844064174052", "0.396309801498368", "-0.0390563049223486", "0.245298957184271", "0.604872665711080"], 4)
    show("order 6, 11 stages", six,
         ["0.0414649985182624", "0.198128671918067", "-0.0400061921041533", "0.0752539843015807", "-0.0115113874206879",
          "0.123229775946271", "0.290553797799558", "-0.127049212625417", "-0.246331761062075", "0.357208872795928"], 6)
    show("order 6, 14 stages", drifts_first,
         ["0.0378593198406116", "0.102635633102435", "-0.0258678882665587", "0.314241403071447", "-0.130144459517415",
          "0.106417700369543", "-0.00879424312851058", "0.09171915262446165", "0.183983170005006", "-0.05653436583288827",
          "0.004914688774712854", "0.143761127168358", "0.328567693746804"], 6)
