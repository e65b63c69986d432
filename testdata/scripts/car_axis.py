"""Writes testdata/reference/car_axis.json: the car axis of the Test Set for IVP Solvers, published and in more digits.

    pip install gmpy2
    python3 testdata/scripts/car_axis.py > testdata/reference/car_axis.json

The constraints, differentiated twice, give the reactions at each time: what is left is an ordinary differential equation for the
ends of the axis. It is integrated by the extrapolated midpoint rule (2, 4, ..., 24 substeps) with 160 bits, once with 1200 and
once with 1500 equal steps; the distance of the two stands in the file. Nothing of Piola is used.
"""

import json
import sys

import gmpy2
from gmpy2 import mpfr

gmpy2.get_context().precision = 160
LENGTH, REST, MASS, AMPLITUDE, RATE, GRAVITY = mpfr(1), mpfr("0.5"), mpfr(10), mpfr("0.1"), mpfr(10), mpfr(1)
EPSILON = mpfr("0.01")
INERTIA = MASS * EPSILON * EPSILON / 2
WEIGHT = INERTIA * GRAVITY
END = 3
SUBSTEPS = list(range(2, 26, 2))
PUBLISHED = ["0.4934557842755629e-1", "0.4969894602303324", "0.1041742524885400e1", "0.3739110272652214",
             "-0.7705836840321485e-1", "0.7446866596327776e-2", "0.1755681574942899e-1", "0.7703410437794031",
             "-0.4736886750784630e-2", "-0.1104680411345730e-2"]


def road(t):
    """The right wheel: its place, velocity and acceleration, (x, y) each."""
    s, c = gmpy2.sin_cos(RATE * t)
    y = [AMPLITUDE * s, AMPLITUDE * RATE * c, -AMPLITUDE * RATE * RATE * s]
    x = gmpy2.sqrt(LENGTH * LENGTH - y[0] * y[0])
    # x^2 + y^2 = L^2, differentiated once and twice.
    first = -y[0] * y[1] / x
    second = -(y[1] * y[1] + y[0] * y[2] + first * first) / x
    return [x, first, second], y


def motion(t, y):
    """The rates of (xl, yl, xr, yr) and of their velocities, and the reactions."""
    (xb, vxb, axb), (yb, vyb, ayb) = road(t)
    xl, yl, xr, yr, vxl, vyl, vxr, vyr = y
    left = gmpy2.sqrt(xl * xl + yl * yl)
    right = gmpy2.sqrt((xr - xb) ** 2 + (yr - yb) ** 2)
    pull_left, pull_right = (REST - left) / left, (REST - right) / right
    force = [pull_left * xl, pull_left * yl - WEIGHT, pull_right * (xr - xb), pull_right * (yr - yb) - WEIGHT]
    dx, dy, dvx, dvy = xl - xr, yl - yr, vxl - vxr, vyl - vyr
    # Rows of the constraints xb xl + yb yl = 0 and dx^2 + dy^2 = L^2, and what their second derivatives hold besides.
    g = [[xb, yb, mpfr(0), mpfr(0)], [2 * dx, 2 * dy, -2 * dx, -2 * dy]]
    rest = [axb * xl + ayb * yl + 2 * (vxb * vxl + vyb * vyl), 2 * (dvx * dvx + dvy * dvy)]
    # g (force + g^T lambda) / inertia + rest = 0.
    dot = lambda a, b: sum((p * q for p, q in zip(a, b)), mpfr(0))
    right_side = [-INERTIA * rest[k] - dot(g[k], force) for k in range(2)]
    a, b, c = dot(g[0], g[0]), dot(g[0], g[1]), dot(g[1], g[1])
    determinant = a * c - b * b
    reactions = [(c * right_side[0] - b * right_side[1]) / determinant,
                 (a * right_side[1] - b * right_side[0]) / determinant]
    pull = [force[k] + g[0][k] * reactions[0] + g[1][k] * reactions[1] for k in range(4)]
    return [vxl, vyl, vxr, vyr] + [p / INERTIA for p in pull], reactions


def midpoint(t, y, big, n):
    h = big / n
    before, now = y, [a + h * f for a, f in zip(y, motion(t, y)[0])]
    for k in range(1, n):
        before, now = now, [a + 2 * h * f for a, f in zip(before, motion(t + k * h, now)[0])]
    # Smoothed, so that the error has even powers alone.
    last = motion(t + big, now)[0]
    return [(a + b + h * f) / 2 for a, b, f in zip(before, now, last)]


def run(steps):
    y = [mpfr(0), REST, LENGTH, REST, -REST / LENGTH, mpfr(0), -REST / LENGTH, mpfr(0)]
    big = mpfr(END) / steps
    for step in range(steps):
        rows = []
        for i, n in enumerate(SUBSTEPS):
            row = [midpoint(step * big, y, big, n)]
            for k in range(1, i + 1):
                ratio = mpfr(SUBSTEPS[i]) ** 2 / mpfr(SUBSTEPS[i - k]) ** 2 - 1
                row.append([a + (a - b) / ratio for a, b in zip(row[k - 1], rows[i - 1][k - 1])])
            rows.append(row)
        y = rows[-1][-1]
    return y + motion(mpfr(END), y)[1]


if __name__ == "__main__":
    one, other = run(1200), run(1500)
    distance = max(abs((a - b) / b) for a, b in zip(one, other))
    off = max(abs((mpfr(p) - q) / q) for p, q in zip(PUBLISHED, other))
    json.dump({
        "problem": "Car axis: p' = q, (M eps^2/2) q' = f(p) + G^T lambda, two constraints on p = (xl, yl, xr, yr); t in [0, 3]; "
                   "state (p, q, lambda); L = 1, L0 = 0.5, eps = 0.01, M = 10, g = 1, road 0.1 sin(10 t)",
        "end": END,
        "published_reference": PUBLISHED,
        "published_by": "Test Set for IVP Solvers, release 2.4 (Mazzia, Magherini; Bari 2008), caraxis",
        "own_reference": {
            "values": ["{0:.25g}".format(x) for x in other],
            "largest_relative_distance_of_two_runs": f"{distance:.1e}",
            "how": "extrapolated midpoint rule with 160 bits, by testdata/scripts/car_axis.py",
        },
        "largest_relative_distance_published_own": f"{off:.1e}",
    }, sys.stdout, indent=1)
    print()
