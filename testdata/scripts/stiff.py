"""Writes testdata/golden/stiff.json: the ends of stiff problems, to 20 digits.

    pip install mpmath gmpy2 numpy scipy
    python3 testdata/scripts/stiff.py > testdata/golden/stiff.json

Collocation on the eleven nodes of Radau (order 21) with 40 digits; Newton's iteration is preconditioned in double precision.
The mesh is that of SciPy's Radau at a relative tolerance of 1e-8. A run on the mesh with every step halved gives the digits
that hold. Inputs are exact doubles; nothing of Piola is used.
"""

import json
import sys
from multiprocessing import Pool

import numpy as np
from mpmath import binomial, matrix, mp, mpf, nstr, polyroots
from scipy.integrate import solve_ivp

mp.dps = 40
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


def nodes_and_matrix(s):
    """The zeros of P_s - P_{s-1} on [0, 1], and the integrals of the Lagrange polynomials up to them."""
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
    return c, [[a[i, j] for j in range(s)] for i in range(s)]


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
    small = np.array([[float(x) for x in row] for row in a])
    y = [mpf(x) for x in start]
    for t0, t1 in zip(mesh[:-1], mesh[1:]):
        h = mpf(t1) - mpf(t0)
        j = jacobian(f, [float(x) for x in y])
        # Scaled rows and columns, so that double precision suffices for the preconditioner.
        inverse = np.linalg.inv(np.eye(s * n) - float(h) * np.kron(small, j))
        z = [[mpf(0)] * n for _ in range(s)]
        best, idle = mpf("inf"), 0
        for sweep in range(200):
            rates = [f([y[k] + z[i][k] for k in range(n)]) for i in range(s)]
            residual = [[h * sum(a[i][l] * rates[l][k] for l in range(s)) - z[i][k] for k in range(n)] for i in range(s)]
            size = max(abs(x) for row in residual for x in row)
            if size == 0:
                break
            scaled = np.array([float(x / size) for row in residual for x in row])
            change = inverse @ scaled
            largest = mpf(0)
            for i in range(s):
                for k in range(n):
                    step = size * mpf(change[i * n + k])
                    z[i][k] += step
                    largest = max(largest, abs(step) / (abs(y[k]) + abs(z[i][k]) + mpf(10) ** -30))
            if largest < mpf(10) ** -30:
                break
            idle = 0 if largest < best else idle + 1
            best = min(best, largest)
            if 4 < idle:
                if best > mpf(10) ** -26:
                    raise RuntimeError(f"{f.__name__}: no convergence at t = {t0}: {best}")
                break
        y = [y[k] + z[-1][k] for k in range(n)]
    return y


def solve(number):
    name, f, start, end, source, published = PROBLEMS[number]
    _, a = nodes_and_matrix(STAGES)
    rough = solve_ivp(lambda t, y: f(list(map(np.float64, y))), (0.0, end), start, method="Radau", rtol=1e-8, atol=ABSOLUTE.get(name, 1e-12),
                      jac=lambda t, y: jacobian(f, y))
    mesh = list(rough.t)
    mesh[-1] = end
    halved = [mesh[0]]
    for t in mesh[1:]:
        halved += [0.5 * (halved[-1] + t), t]
    once, twice = follow(f, start, mesh, a), follow(f, start, halved, a)
    agreement = max(abs((p - q) / q) for p, q in zip(once, twice))
    case = {
        "name": name, "start": start, "end": end, "values": [nstr(x, 20) for x in twice],
        "agreement_with_coarser_mesh": nstr(agreement, 2),
    }
    if published:
        distance = max(abs((mpf(p) - q) / q) for p, q in zip(published, twice))
        case |= {"published": published, "published_in": source, "distance_from_published": nstr(distance, 2)}
    print(name, len(mesh) - 1, "steps", case["agreement_with_coarser_mesh"], file=sys.stderr, flush=True)
    return case


if __name__ == "__main__":
    with Pool(2) as pool:
        cases = pool.map(solve, range(len(PROBLEMS)), chunksize=1)
    meta = {
        "what": "the ends of stiff problems",
        "source": "equations as in testdata/scripts/stiff.py; van der Pol, Robertson, HIRES and the Oregonator are those of the "
                  "Test Set for Initial Value Problem Solvers, whose published values stand beside our own",
        "generator": "testdata/scripts/stiff.py (mpmath, 40 digits; Radau collocation of order 21)",
        "digits": 20,
        "verified_by": "a mesh with steps of half the length (agreement_with_coarser_mesh), and the published values "
                       "(distance_from_published), both relative to each component",
    }
    json.dump({"meta": meta, "cases": cases}, sys.stdout, indent=1)
    print()
