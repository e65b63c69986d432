"""Writes testdata/golden/grown_paths.json: stresses and tangents of an elastic law behind growth and behind thermal expansion.

The body is led along a path while its growth G, or its temperature, changes from point to point. Its energy is det G W(F G^-1), thermal
expansion being G = exp(a (T - T0)) 1. P and dP/dF are central differences of this energy at 100 digits; nothing of Piola, and no formula of a
stress, is used. Inputs are exact doubles. Halving the width of the differences shows the digits.

    python3 testdata/scripts/grown_paths.py > testdata/golden/grown_paths.json
"""

import json
import sys

from inelastic_paths import F0, F1, F2, NeoHookean, det, floats, inv, numbers, path, rows
from mpmath import exp, eye, mp, mpf, nstr

mp.dps = 100

LAW = NeoHookean(1.0, 5.0)
COEFFICIENT, REFERENCE = mpf("0.0009765625"), mpf(300)  # 1/1024 1/K
GROWTHS = [
    [[1.25, 0.125, 0.0], [0.0, 1.0, 0.25], [0.0, 0.0, 0.875]],
    [[0.75, 0.0, 0.125], [-0.25, 1.5, 0.0], [0.0, 0.375, 1.125]],
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[1.5, -0.25, 0.0], [0.25, 1.5, 0.0], [0.0, 0.0, 0.5]],
]
TEMPERATURES = [420.0, 250.0, 300.0, 812.0]


def energy(f, growth):
    return det(growth) * LAW.energy(f * inv(growth))


def moved(f, place, h):
    g = f.copy()
    g[place // 3, place % 3] += h
    return g


def stress(f, growth, h):
    return [(energy(moved(f, k, h), growth) - energy(moved(f, k, -h), growth)) / (2 * h) for k in range(9)]


def tangent(f, growth, h):
    up_and_down = [(stress(moved(f, k, h), growth, h), stress(moved(f, k, -h), growth, h)) for k in range(9)]
    return [(up[r] - down[r]) / (2 * h) for r in range(9) for up, down in up_and_down]


def main():
    ends = [rows(F0.tolist()), rows(F1), rows(F2), path(rows(F2), rows(F1), mpf(1), mpf(2))]
    cases, worst = [], mpf(0)
    for number, end in enumerate(ends):
        expansion = eye(3) * exp(COEFFICIENT * (mpf(TEMPERATURES[number]) - REFERENCE))
        for name, growth, what in [
            ("given_growth", rows(GROWTHS[number]), {"growth": GROWTHS[number]}),
            ("thermal", expansion, {"temperature": TEMPERATURES[number]}),
        ]:
            h = mpf(10) ** -20
            p, a = stress(end, growth, h), tangent(end, growth, h)
            again = stress(end, growth, h / 2) + tangent(end, growth, h / 2)
            worst = max([worst] + [abs(x - y) for x, y in zip(p + a, again)])
            cases.append({"id": f"{name}/{number}", "law": name, "input": {"to": floats(end), **what},
                          "output": {"P": numbers(p), "tangent": numbers(a)}})
    print(nstr(worst, 3), file=sys.stderr)
    meta = {
        "what": "first Piola stresses and their tangents of an elastic law behind growth and behind thermal expansion",
        "source_equations": {
            "energy": "det G W(F G^-1), W = " + NeoHookean.__doc__,
            "thermal": "G = exp(coefficient (temperature - reference_temperature)) 1",
        },
        "params": {"mu": 1.0, "lambda": 5.0, "coefficient": float(COEFFICIENT), "reference_temperature": float(REFERENCE)},
        "generator": "testdata/scripts/grown_paths.py (mpmath, 100 digits)",
        "digits": 30,
        "verified_by": "central differences of half the width, largest difference " + nstr(worst, 3),
    }
    cases.sort(key=lambda case: case["law"])
    lines = ",\n  ".join(json.dumps(case) for case in cases)
    print('{\n "meta": %s,\n "cases": [\n  %s\n ]\n}' % (json.dumps(meta, indent=1).replace("\n", "\n "), lines))


if __name__ == "__main__":
    main()
