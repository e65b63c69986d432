"""Writes testdata/golden/principal_stretches.json: stretches of deformations with one long stretch and two short ones close together.

Singular values by one-sided rotations of Jacobi at 80 digits; mpmath's own decomposition must agree. Nothing of Piola is used. Inputs are
exact doubles.

    python3 testdata/scripts/principal_stretches.py > testdata/golden/principal_stretches.json
"""

import json
import math
import random

from mpmath import log, matrix, mp, mpf, nstr, sqrt, svd_r

mp.dps = 80
random.seed(20)

REPORTED = [
    [115.97858815877414, 63.76009266919063, -39.3495054824248],
    [1235.2499091131679, 674.2410890162365, -418.21553125047876],
    [2000.3031374192146, 1091.864272570382, -678.0320633921481],
]


def rotation():
    """Of a random unit quaternion."""
    w, x, y, z = (random.gauss(0, 1) for _ in range(4))
    s = 2 / (w * w + x * x + y * y + z * z)
    return [
        [1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
        [s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)],
        [s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)],
    ]


def with_stretches(stretches):
    """P diag(stretches) Q at 80 digits, rounded to doubles."""
    p, q = (matrix([[mpf(x) for x in row] for row in rotation()]) for _ in range(2))
    f = p * matrix([[stretches[0], 0, 0], [0, stretches[1], 0], [0, 0, stretches[2]]]) * q
    return [[float(f[i, j]) for j in range(3)] for i in range(3)]


def stretches(rows):
    """Lengths of the columns after they have been rotated until they are orthogonal, descending."""
    b = [[mpf(rows[i][j]) for i in range(3)] for j in range(3)]
    dot = lambda u, v: sum(x * y for x, y in zip(u, v))
    for _ in range(30):
        worst = mpf(0)
        for i, j in [(0, 1), (0, 2), (1, 2)]:
            alpha, beta, gamma = dot(b[i], b[i]), dot(b[j], b[j]), dot(b[i], b[j])
            worst = max(worst, abs(gamma) / sqrt(alpha * beta))
            if gamma == 0:
                continue
            zeta = (beta - alpha) / (2 * gamma)
            t = (1 if zeta >= 0 else -1) / (abs(zeta) + sqrt(1 + zeta**2))
            c = 1 / sqrt(1 + t**2)
            b[i], b[j] = [c * x - c * t * y for x, y in zip(b[i], b[j])], [c * t * x + c * y for x, y in zip(b[i], b[j])]
        if worst < mpf(10) ** -70:
            break
    return sorted((sqrt(dot(column, column)) for column in b), reverse=True)


def main():
    worst = mpf(0)
    inputs = [("reported", REPORTED)]
    for ratio in [1e1, 1e2, 1e3, 3e3, 1e4, 1e5]:
        for gap in [0.0, 1e-13, 1e-11, 1e-9, 3e-8, 1e-6, 1e-3]:
            for number in range(2):
                short = mpf(math.exp(random.uniform(-1, 1)))
                rows = with_stretches([short * mpf(ratio), short * (1 + mpf(gap)), short])
                inputs.append((f"ratio {ratio:g}, gap {gap:g}, {number}", rows))
    cases = []
    for identity, rows in inputs:
        values = stretches(rows)
        other = sorted(svd_r(matrix(rows), compute_uv=False), reverse=True)
        worst = max([worst] + [abs(a / b - 1) for a, b in zip(values, other)])
        cases.append({"id": identity, "input": {"F": rows},
                      "output": {"principal_stretches": [nstr(x, 30) for x in values],
                                 "log_principal_stretches": [nstr(log(x), 30) for x in values]}})
    meta = {
        "what": "principal stretches of deformations with a long stretch and two short ones close together, and their logarithms",
        "source_equations": {"principal_stretches": "roots of det(F^T F - x^2 1), descending"},
        "generator": "testdata/scripts/principal_stretches.py (mpmath, 80 digits)",
        "digits": 30,
        "verified_by": "mpmath's singular values, worst relative difference " + nstr(worst, 3),
    }
    lines = ",\n  ".join(json.dumps(case) for case in cases)
    print('{\n "meta": %s,\n "cases": [\n  %s\n ]\n}' % (json.dumps(meta, indent=1).replace("\n", "\n "), lines))


main()
