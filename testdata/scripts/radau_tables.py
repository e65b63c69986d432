"""Tables of the Radau IIA methods of 3, 5 and 7 stages, with 50 digits: crates/integrators/src/radau_iia/tables.rs.

    pip install mpmath
    python3 testdata/scripts/radau_tables.py > crates/integrators/src/radau_iia/tables.rs

The nodes are the zeros of the right Radau polynomial P_s - P_{s-1} on [0, 1]; A integrates the Lagrange polynomials on them.
T brings the inverse of A to one real eigenvalue and pairs alpha +- i beta, the last entry of each eigenvector being one.
"""

from mpmath import binomial, eig, inverse, matrix, mp, mpf, polyroots

mp.dps = 60


def times(p, q):
    """The product of two polynomials, lowest power first."""
    out = [mpf(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            out[i + j] += a * b
    return out


def shifted_legendre(n):
    """Coefficients of P_n(2x - 1), lowest power first."""
    return [(-1) ** (n + k) * binomial(n, k) * binomial(n + k, k) for k in range(n + 1)]


def basis(c, i):
    """The Lagrange polynomial that is one at c[i]."""
    out = [mpf(1)]
    for k, node in enumerate(c):
        if k != i:
            out = times(out, [-node / (c[i] - node), 1 / (c[i] - node)])
    return out


def value(p, x):
    return sum(a * x ** k for k, a in enumerate(p))


def table(s):
    p, q = shifted_legendre(s), shifted_legendre(s - 1) + [0]
    c = sorted(polyroots([a - b for a, b in zip(p, q)][::-1], maxsteps=500, extraprec=400), key=lambda z: z.real)
    c = [node.real for node in c]
    c[-1] = mpf(1)
    lagrange = [basis(c, j) for j in range(s)]
    a = matrix(s, s)
    for i in range(s):
        for j in range(s):
            a[i, j] = sum(x * c[i] ** (k + 1) / (k + 1) for k, x in enumerate(lagrange[j]))
    inverse_a = inverse(a)
    values, vectors = eig(inverse_a)
    real = min(range(s), key=lambda k: abs(values[k].imag))
    pairs = sorted((k for k in range(s) if k != real and 0 < values[k].imag), key=lambda k: values[k].imag)
    columns, rates = [], []
    for k in [real] + pairs:
        v = [vectors[i, k] / vectors[s - 1, k] for i in range(s)]
        columns.append([x.real for x in v])
        if k != real:
            columns.append([x.imag for x in v])
            rates.append((values[k].real, values[k].imag))
    t = matrix(s, s)
    for j, column in enumerate(columns):
        for i in range(s):
            t[i, j] = column[i]
    back = inverse(t)
    at_zero = matrix([value(p, 0) for p in lagrange])
    defect = [-sum(at_zero[i] * inverse_a[i, j] for i in range(s)) for j in range(s)]
    return c, a, values[real].real, rates, t, back, defect


def number(x):
    if x == 0:
        return "0.0"
    text = mp.nstr(x, 17, strip_zeros=True, min_fixed=-mp.inf, max_fixed=mp.inf)
    return text if "." in text else text + ".0"


def rows(name, m, s):
    print(f"    {name}: &[")
    for i in range(s):
        print("        " + ", ".join(number(m[i, j]) for j in range(s)) + ",")
    print("    ],")


print("""//! The coefficients of three, five and seven stages, rounded from fifty digits.
//!
//! Made by `testdata/scripts/radau_tables.py` from the Radau polynomials; the tests compare them with the conditions that
//! define them, in 31 digits.

use super::tableau::Tableau;
""")
for s, name in ((3, "THREE"), (5, "FIVE"), (7, "SEVEN")):
    c, a, real, rates, t, back, defect = table(s)
    print(f"pub(super) const {name}: Tableau = Tableau {{")
    print("    nodes: &[" + ", ".join(number(x) for x in c) + "],")
    print(f"    real: {number(real)},")
    print("    pairs: &[" + ", ".join(f"[{number(a)}, {number(b)}]" for a, b in rates) + "],")
    rows("matrix", a, s)
    rows("transformation", t, s)
    rows("inverse", back, s)
    print("    defect: &[" + ", ".join(number(x) for x in defect) + "],")
    print("};")
