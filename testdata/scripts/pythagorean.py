"""Writes testdata/reference/pythagorean.json: Burrau's problem of three bodies, to the escape of one.

Masses 3, 4 and 5 start from rest at the corners of a triangle whose sides are 3, 4 and 5, each opposite its own mass. Taylor series
of order 50 in 70 digits, by gmpy2; steps of a fixed part of the radius of convergence that the last coefficients show. Each run is
made twice, with other steps and another order: the digits written are those that agree. Nothing of Piola is used.

    pip install gmpy2
    python3 testdata/scripts/pythagorean.py > testdata/reference/pythagorean.json
"""

import json
import sys

import gmpy2
from gmpy2 import mpfr

gmpy2.get_context().precision = 240
MASSES = [mpfr(3), mpfr(4), mpfr(5)]
PLACES = [(1, 3), (-2, -1), (1, -1)]
TIMES = [10, 30, 60, 70]
PAIRS = [(0, 1), (0, 2), (1, 2)]


def series(x, v, order):
    """Taylor coefficients of the places, [body][axis][power]."""
    c = [[[x[i][k], v[i][k]] for k in range(2)] for i in range(3)]
    d = {pair: [[], []] for pair in PAIRS}
    square, power = {pair: [] for pair in PAIRS}, {pair: [] for pair in PAIRS}
    for n in range(order - 1):
        force = [[mpfr(0)] * 2 for _ in range(3)]
        for pair in PAIRS:
            i, j = pair
            for k in range(2):
                d[pair][k].append(c[j][k][n] - c[i][k][n])
            a, b = d[pair]
            square[pair].append(sum((a[m] * a[n - m] + b[m] * b[n - m] for m in range(n + 1)), mpfr(0)))
            s, p = square[pair], power[pair]
            # p = s^(-3/2): n s0 p_n = sum over m of (-3/2 m - (n - m)) s_m p_(n-m), m = 1...n.
            if n == 0:
                p.append(1 / (s[0] * gmpy2.sqrt(s[0])))
            else:
                total = sum(((-mpfr(3) / 2 * m - (n - m)) * s[m] * p[n - m] for m in range(1, n + 1)), mpfr(0))
                p.append(total / (n * s[0]))
            for k in range(2):
                f = sum((p[m] * d[pair][k][n - m] for m in range(n + 1)), mpfr(0))
                force[i][k] += MASSES[j] * f
                force[j][k] -= MASSES[i] * f
        for i in range(3):
            for k in range(2):
                c[i][k].append(force[i][k] / ((n + 1) * (n + 2)))
    return c


def radius(c, order):
    found = None
    for power in (order - 1, order):
        size = max(abs(c[i][k][power]) for i in range(3) for k in range(2))
        if size > 0:
            r = size ** (-mpfr(1) / power)
            found = r if found is None else min(found, r)
    return found


def run(order, part):
    x = [[mpfr(a) for a in place] for place in PLACES]
    v = [[mpfr(0)] * 2 for _ in range(3)]
    t, states, steps = mpfr(0), [], 0
    for end in TIMES:
        while t < end:
            c = series(x, v, order)
            h = min(radius(c, order) * part, end - t)
            for i in range(3):
                for k in range(2):
                    place, speed = mpfr(0), mpfr(0)
                    for power in range(order, -1, -1):
                        place = place * h + c[i][k][power]
                        if power:
                            speed = speed * h + power * c[i][k][power]
                    x[i][k], v[i][k] = place, speed
            t, steps = t + h, steps + 1
        states.append([a for i in range(3) for a in x[i]] + [a for i in range(3) for a in v[i]])
    print(order, part, steps, file=sys.stderr)
    return states


def main():
    first, second = run(50, mpfr(1) / 24), run(44, mpfr(1) / 32)
    states = []
    for t, a, b in zip(TIMES, first, second):
        worst = max(abs(p - q) for p, q in zip(a, b))
        assert worst < mpfr(10) ** -32, (t, worst)
        states.append({"t": t, "state": ["{0:.30e}".format(p) for p in a], "agreement": "{0:.1e}".format(worst)})
    print(json.dumps({
        "problem": "three bodies of masses 3, 4, 5 from rest at the corners of a right triangle, plane, G = 1",
        "masses": [3, 4, 5],
        "positions": PLACES,
        "states": states,
        "order_of_components": "x, y of each body, then velocities",
        "provenance": "C. Burrau, Astron. Nachr. 195 (1913) 113; V. Szebehely & C. F. Peters, Astron. J. 72 (1967) 876; digits by testdata/scripts/pythagorean.py",
    }, indent=1))


main()
