"""Writes testdata/reference/planet_encounter.json: three planets about a star, two of which meet at 0.04 Hill radii.

All numbers of the start are multiples of 2^-14, exact in double precision. Taylor series of order 40 in 60 digits, by gmpy2; steps of a
fixed part of the radius of convergence that the last coefficients show. The run is made twice, with other steps and another order:
the digits written are those that agree. Nothing of Piola is used.

    pip install gmpy2
    python3 testdata/scripts/planet_encounter.py > testdata/reference/planet_encounter.json
"""

import itertools
import json
import sys

import gmpy2
from gmpy2 import mpfr

gmpy2.get_context().precision = 200
MASSES = [1.0, 1 / 1024, 1 / 4096, 1 / 16384]
PLACES = [
    [0.0, 0.0, 0.0],
    [0.1064453125, 0.97509765625, 0.0],
    [-1.146728515625, -0.25439453125, 0.005615234375],
    [-1.43408203125, -1.992431640625, 0.002685546875],
]
VELOCITIES = [
    [0.0, 0.0, 0.0],
    [-1.012939453125, 0.11669921875, 0.0],
    [0.090576171875, -0.92041015625, -0.007568359375],
    [0.4951171875, -0.390869140625, -0.012451171875],
]
TIMES = [8, 12, 20]
BODIES, AXES = range(4), range(3)
PAIRS = list(itertools.combinations(BODIES, 2))
M = [mpfr(m) for m in MASSES]


def series(x, v, order):
    """Taylor coefficients of the places, [body][axis][power]."""
    c = [[[x[i][k], v[i][k]] for k in AXES] for i in BODIES]
    d = {pair: [[] for _ in AXES] for pair in PAIRS}
    square, power = {pair: [] for pair in PAIRS}, {pair: [] for pair in PAIRS}
    for n in range(order - 1):
        force = [[mpfr(0) for _ in AXES] for _ in BODIES]
        for pair in PAIRS:
            i, j = pair
            for k in AXES:
                d[pair][k].append(c[j][k][n] - c[i][k][n])
            square[pair].append(sum((a[m] * a[n - m] for a in d[pair] for m in range(n + 1)), mpfr(0)))
            s, p = square[pair], power[pair]
            # p = s^(-3/2): n s0 p_n = sum over m of (-3/2 m - (n - m)) s_m p_(n-m), m = 1...n.
            if n == 0:
                p.append(1 / (s[0] * gmpy2.sqrt(s[0])))
            else:
                total = sum(((-mpfr(3) / 2 * m - (n - m)) * s[m] * p[n - m] for m in range(1, n + 1)), mpfr(0))
                p.append(total / (n * s[0]))
            for k in AXES:
                f = sum((p[m] * d[pair][k][n - m] for m in range(n + 1)), mpfr(0))
                force[i][k] += M[j] * f
                force[j][k] -= M[i] * f
        for i in BODIES:
            for k in AXES:
                c[i][k].append(force[i][k] / ((n + 1) * (n + 2)))
    return c


def radius(c, order):
    found = None
    for power in (order - 1, order):
        size = max(abs(c[i][k][power]) for i in BODIES for k in AXES)
        if size > 0:
            r = size ** (-mpfr(1) / power)
            found = r if found is None else min(found, r)
    return found


def value(coefficients, h, derivative=0):
    """The sum of a Taylor series, or that of its derivative."""
    total = mpfr(0)
    for power in range(len(coefficients) - 1, derivative - 1, -1):
        total = total * h + (power if derivative else 1) * coefficients[power]
    return total


def approach(c, h):
    """The rate of the squared distance of the two that meet, halved, and the distance."""
    d = [value(c[2][k], h) - value(c[1][k], h) for k in AXES]
    u = [value(c[2][k], h, 1) - value(c[1][k], h, 1) for k in AXES]
    return sum((a * b for a, b in zip(d, u)), mpfr(0)), gmpy2.sqrt(sum((a * a for a in d), mpfr(0)))


def turning_point(c, h):
    """The least distance within a step, and its part of the step."""
    low, high = mpfr(0), h
    for _ in range(180):
        middle = (low + high) / 2
        low, high = (middle, high) if approach(c, middle)[0] < 0 else (low, middle)
    return approach(c, low)[1], low


def run(order, part):
    x = [[mpfr(a) for a in place] for place in PLACES]
    v = [[mpfr(a) for a in velocity] for velocity in VELOCITIES]
    t, states, steps = mpfr(0), [], 0
    nearest = (mpfr(10), mpfr(0))
    for end in TIMES:
        while t < end:
            c = series(x, v, order)
            h = min(radius(c, order) * part, end - t)
            if approach(c, mpfr(0))[0] < 0 < approach(c, h)[0]:
                distance, after = turning_point(c, h)
                nearest = min(nearest, (distance, t + after))
            x = [[value(c[i][k], h) for k in AXES] for i in BODIES]
            v = [[value(c[i][k], h, 1) for k in AXES] for i in BODIES]
            t, steps = t + h, steps + 1
        states.append([a for i in BODIES for a in x[i]] + [a for i in BODIES for a in v[i]])
    print(order, part, steps, *(f"{float(a):.6g}" for a in nearest), file=sys.stderr)
    return states, nearest


def main():
    (first, nearest), (second, again) = run(40, mpfr(1) / 20), run(34, mpfr(1) / 28)
    assert all(abs(a - b) < mpfr(10) ** -32 for a, b in zip(nearest, again)), (nearest, again)
    states = []
    for t, a, b in zip(TIMES, first, second):
        worst = max(abs(p - q) for p, q in zip(a, b))
        assert worst < mpfr(10) ** -32, (t, worst)
        states.append({"t": t, "state": ["{0:.30e}".format(p) for p in a], "agreement": "{0:.1e}".format(worst)})
    print(json.dumps({
        "problem": "a star of mass 1 with planets of masses 1/1024, 1/4096 and 1/16384; the first two meet at t = 9.6, G = 1",
        "masses": MASSES,
        "positions": PLACES,
        "velocities": VELOCITIES,
        "states": states,
        "closest_approach": {"distance": "{0:.30e}".format(nearest[0]), "t": "{0:.30e}".format(nearest[1])},
        "order_of_components": "x, y, z of each body, then velocities",
        "provenance": "digits by testdata/scripts/planet_encounter.py",
    }, indent=1))


main()
