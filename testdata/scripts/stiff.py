"""Writes testdata/golden/stiff.json: the ends of stiff problems.

    pip install mpmath gmpy2 numpy scipy
    python3 testdata/scripts/stiff.py > testdata/golden/stiff.json

Van der Pol, Robertson to 1e11, HIRES and the Oregonator: the published values, to 16 digits.
Robertson to 40: collocation on the eleven nodes of Radau (order 21) with 140 bits (MPFR), Newton's iteration preconditioned in
double precision, the mesh that of SciPy's Radau at a relative tolerance of 1e-7; a run with every step halved gives the digits
that hold. The spring pendulum: SciPy's DOP853, an explicit method, at 1e-13, beside its Radau.
Inputs are exact doubles; nothing of Piola is used. With the argument `check` the published values are computed by collocation,
too, and the distance is printed: minutes to an hour, on one core.
"""

import json
import sys

import gmpy2
import numpy as np
from gmpy2 import mpfr
from mpmath import binomial, matrix, mp, nstr, polyroots
from scipy.integrate import solve_ivp

mp.dps = 60
BITS = 140
STAGES = 11


def van_der_pol(y):
    return [y[1], ((1 - y[0] * y[0]) * y[1] - y[0]) / type(y[0])(1e-6)]


def robertson(y):
    slow, back, fast = y[0] * 0.04, y[1] * 1e4 * y[2], y[1] * y[1] * 3e7
    return [back - slow, slow - back - fast, fast]


def hires(y):
    binding = 280.0 * y[5] * y[7]
    seventh = binding - 1.81 * y[6]
    return [
        -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007,
        1.71 * y[0] - 8.75 * y[1],
        -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4],
        8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3],
        -1.745 * y[4] + 0.43 * (y[5] + y[6]),
        -binding + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6],
        seventh,
        -seventh,
    ]


def oregonator(y):
    return [
        77.27 * (y[1] + y[0] * (1 - 8.375e-6 * y[0] - y[1])),
        (y[2] - (1 + y[0]) * y[1]) / 77.27,
        0.161 * (y[0] - y[2]),
    ]


def spring_pendulum(y):
    length = (y[0] * y[0] + y[1] * y[1]) ** type(y[0])(0.5)
    pull = (1e6 * (length - 1) + 2e3 * (y[0] * y[2] + y[1] * y[3]) / length) / length
    return [y[2], y[3], -pull * y[0], -pull * y[1] - 1]


TEST_SET = "Test Set for Initial Value Problem Solvers, release 2.4 (Mazzia, Magherini; Bari 2008), "
PROBLEMS = [
    ("van der Pol", van_der_pol, [2.0, 0.0], 2.0, TEST_SET + "vdpol",
     ["0.1706167732170483e1", "-0.8928097010247975e0"]),
    ("Robertson", robertson, [1.0, 0.0, 0.0], 1e11, TEST_SET + "rober",
     ["0.2083340149701255e-7", "0.8333360770334713e-13", "0.9999999791665050"]),
    ("Robertson to 40", robertson, [1.0, 0.0, 0.0], 40.0, None, None),
    ("HIRES", hires, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0057], 321.8122, TEST_SET + "hires",
     ["0.7371312573325668e-3", "0.1442485726316185e-3", "0.5888729740967575e-4", "0.1175651343283149e-2",
      "0.2386356198831331e-2", "0.6238968252742796e-2", "0.2849998395185769e-2", "0.2850001604814231e-2"]),
    ("Oregonator", oregonator, [1.0, 2.0, 3.0], 360.0, TEST_SET + "orego",
     ["0.1000814870318523e1", "0.1228178521549917e4", "0.1320554942846706e3"]),
    ("spring pendulum", spring_pendulum, [1.0, 0.0, 0.0, 0.0], 10.0, None, None),
]

# The absolute tolerances of the meshes that need another than 1e-12.
ABSOLUTE = {"Robertson": 1e-18, "Robertson to 40": 1e-16, "spring pendulum": 1e-8}


def runge_kutta_matrix(s):
    """A: the integrals of the Lagrange polynomials on the zeros of P_s - P_{s-1} in [0, 1]."""
    def legendre(n):
        return [(-1) ** (n + k) * binomial(n, k) * binomial(n + k, k) for k in range(n + 1)]
    p = [a - b for a, b in zip(legendre(s), legendre(s - 1) + [0])]
    c = sorted((z.real for z in polyroots(p[::-1], maxsteps=500, extraprec=500)))
    powers = matrix(s, s)
    integrals = matrix(s, s)
    for i in range(s):
        for k in range(s):
            powers[i, k] = c[i] ** k
            integrals[i, k] = c[i] ** (k + 1) / (k + 1)
    a = integrals * powers ** -1
    return np.array([[mpfr(nstr(a[i, j], 50)) for j in range(s)] for i in range(s)])


def jacobian(f, y):
    """By complex steps in double precision."""
    n = len(y)
    out = np.empty((n, n))
    for j in range(n):
        point = [complex(x) for x in y]
        point[j] += 1e-30j
        out[:, j] = [complex(x).imag / 1e-30 for x in f(point)]
    return out


def follow(f, start, mesh, a):
    s, n = STAGES, len(start)
    small = a.astype(float)
    y = np.array([mpfr(x) for x in start])
    for t0, t1 in zip(mesh[:-1], mesh[1:]):
        h = mpfr(t1) - mpfr(t0)
        inverse = np.linalg.inv(np.eye(s * n) - float(h) * np.kron(small, jacobian(f, y.astype(float))))
        z = np.full((s, n), mpfr(0))
        best, idle = np.inf, 0
        for _ in range(200):
            rates = np.array([f(list(stage)) for stage in y + z])
            residual = h * (a @ rates) - z
            size = max(abs(x) for x in residual.flat)
            if size == 0:
                break
            # Scaled, so that the range of double precision suffices.
            change = inverse @ (residual / size).astype(float).ravel()
            change = np.array([size * mpfr(x) for x in change]).reshape(s, n)
            z = z + change
            largest = float(np.max(np.abs(change) / (np.abs(y + z) + mpfr("1e-30"))))
            if largest < 1e-32:
                break
            idle = 0 if largest < best else idle + 1
            best = min(best, largest)
            if 4 < idle:
                if 1e-26 < best:
                    raise RuntimeError(f"{f.__name__}: no convergence at t = {t0}: {best}")
                break
        y = y + z[-1]
    return y


def collocation(name, f, start, end):
    """The end by collocation, and its relative distance from that on the coarser mesh."""
    gmpy2.get_context().precision = BITS
    a = runge_kutta_matrix(STAGES)
    rough = solve_ivp(lambda t, y: f(list(map(np.float64, y))), (0.0, end), start, method="Radau", rtol=1e-7,
                      atol=ABSOLUTE.get(name, 1e-12), jac=lambda t, y: jacobian(f, y))
    mesh = list(rough.t)
    mesh[-1] = end
    halved = [mesh[0]]
    for t in mesh[1:]:
        halved += [0.5 * (halved[-1] + t), t]
    once, twice = follow(f, start, mesh, a), follow(f, start, halved, a)
    return twice, float(max(abs((p - q) / q) for p, q in zip(once, twice)))


def explicit(f, start, end):
    """The end by an explicit method, and its relative distance from that of an implicit one."""
    def run(method, tolerance, **more):
        return solve_ivp(lambda t, y: f(y), (0.0, end), start, method=method, rtol=tolerance, atol=tolerance, **more).y[:, -1]
    end_explicit = run("DOP853", 1e-13)
    end_implicit = run("Radau", 1e-9, jac=lambda t, y: jacobian(f, y))
    return end_explicit, float(np.max(np.abs((end_implicit - end_explicit) / end_explicit)))


def case(name, f, start, end, source, published):
    out = {"name": name, "start": start, "end": end}
    if published:
        return out | {"values": published, "source": source}
    if name == "spring pendulum":
        values, distance = explicit(f, start, end)
        return out | {"values": [f"{x:.13g}" for x in values], "source": "SciPy's DOP853 at 1e-13",
                      "distance_from_radau_at_1e-9": f"{distance:.1e}"}
    values, distance = collocation(name, f, start, end)
    return out | {"values": ["{0:.20g}".format(x) for x in values], "source": "collocation of order 21, 140 bits",
                  "distance_from_coarser_mesh": f"{distance:.1e}"}


if __name__ == "__main__":
    if sys.argv[1:] == ["check"]:
        for name, f, start, end, _, published in PROBLEMS:
            if published:
                values, distance = collocation(name, f, start, end)
                off = max(abs((mpfr(p) - q) / q) for p, q in zip(published, values))
                print(f"{name}: published values are off by {float(off):.1e}, meshes by {distance:.1e}", flush=True)
        sys.exit()
    meta = {
        "what": "the ends of stiff problems",
        "source": "the Test Set for Initial Value Problem Solvers where `source` names it; equations as in testdata/scripts/stiff.py",
        "generator": "testdata/scripts/stiff.py (MPFR, SciPy)",
        "digits": "16 of published values, 20 of Robertson to 40, 12 of the spring pendulum",
        "verified_by": "published values: runs of two orders in the tests agree with them to the tolerance of the runs; the others: the "
                       "distance that stands with each, relative to each component",
    }
    json.dump({"meta": meta, "cases": [case(*problem) for problem in PROBLEMS]}, sys.stdout, indent=1)
    print()
