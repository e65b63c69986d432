"""Writes testdata/golden/stress_measures.json: the measures of one stress in several deformations.

The polar decomposition is by Newton's iteration on F at 60 digits. Nothing of Piola is used. Inputs are exact doubles.

    python3 testdata/scripts/stress_measures.py > testdata/golden/stress_measures.json
"""

import json
import sys

from mpmath import det, eye, inverse, matrix, mnorm, mp, mpf, nstr

mp.dps = 60

STRESS = [[12.5, -3.25, 7.0], [-3.25, -40.0, 5.5], [7.0, 5.5, 21.75]]
DEFORMATIONS = {
    "general": [[1.25, 0.1875, -0.125], [-0.0625, 0.875, 0.25], [0.15625, -0.09375, 1.125]],
    "turned": [[0.125, -1.5, 0.25], [0.75, 0.0, -0.5], [0.375, 0.25, 1.75]],
    "compressed": [[0.25, 0.125, 0.0], [-0.1875, 0.3125, 0.0625], [0.03125, 0.15625, 0.5]],
    "sheared": [[1.0, 2.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    "small": [[1 + 2.0**-20, -(2.0**-21), 3 * 2.0**-22], [2.0**-22, 1 - 2.0**-20, 2.0**-21], [-(2.0**-23), 2.0**-20, 1 + 2.0**-22]],
}


def rotation(f):
    """R of F = R U: the limit of (X + X^-T)/2."""
    x = f
    for _ in range(200):
        x, before = (x + inverse(x).T) / 2, x
        if mnorm(x - before) < mpf(10) ** (4 - mp.dps):
            return x
    raise ArithmeticError(f)


def table(a):
    return [[nstr(a[i, j], 30, strip_zeros=True) for j in range(3)] for i in range(3)]


def main():
    cases, worst = [], mpf(0)
    for name, rows in DEFORMATIONS.items():
        f, t = matrix(rows), matrix(STRESS)
        j, r = det(f), rotation(f)
        u = r.T * f
        kirchhoff = j * t
        first = kirchhoff * inverse(f).T
        second = inverse(f) * first
        mandel, biot = f.T * first, r.T * first
        # The same through the other definitions: M = C S = F^T tau F^-T, T_B = U S.
        for a, b in [(mandel, f.T * f * second), (mandel, f.T * kirchhoff * inverse(f).T), (biot, u * second), (u, u.T), (r * r.T, eye(3))]:
            worst = max(worst, mnorm(a - b) / mnorm(b))
        output = {"kirchhoff": kirchhoff, "first_piola": first, "second_piola": second, "mandel": mandel, "biot": biot,
                  "biot_symmetric": (biot + biot.T) / 2}
        cases.append({"id": name, "input": {"T": STRESS, "F": rows}, "output": {key: table(value) for key, value in output.items()}})
    if worst > mpf(10) ** -50:
        sys.exit(nstr(worst, 5))
    meta = {
        "what": "the measures of a stress T in a deformation F = R U",
        "source_equations": {
            "kirchhoff": "J T",
            "first_piola": "P = J T F^-T",
            "second_piola": "S = F^-1 P",
            "mandel": "F^T P = C S",
            "biot": "R^T P = U S, not symmetric",
            "biot_symmetric": "(U S + S U)/2",
        },
        "generator": "testdata/scripts/stress_measures.py (mpmath, 60 digits)",
        "digits": 30,
        "verified_by": "each of Mandel's and Biot's measures by a second definition, worst relative difference " + nstr(worst, 3),
    }
    lines = ",\n  ".join(json.dumps(case) for case in cases)
    print('{\n "meta": %s,\n "cases": [\n  %s\n ]\n}' % (json.dumps(meta, indent=1).replace("\n", "\n "), lines))


main()
