"""Optima of the laws of rubber on Treloar's data by SciPy, beside `piola fit`.

The sum of squares is that of `piola fit`: stress residuals over the largest stress of their test, rows at rest left out. SciPy's bounded
trust-region search starts from random points; the least sum of all is printed with its parameters and the time of all starts.

    python3 benches/peers/rubber_fits.py data/rubber/treloar-1944.csv
"""

import csv
import sys
import time

import numpy as np
from scipy.optimize import least_squares

STARTS = 60


def read(path):
    with open(path) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    tests = {}
    for row in rows:
        stretch, stress = float(row["F11"]), float(row["S11"])
        if stretch != 1.0:
            tests.setdefault(row["mode"], []).append((stretch, stress))
    return {mode: np.array(points).T for mode, points in tests.items()}


# Principal stretches 1, 2, 3 of the stretch l; the third side carries nothing.
MODES = {
    "UT": lambda l: (l, l**-0.5, l**-0.5),
    "ET": lambda l: (l, l, l**-2.0),
    "PS": lambda l: (l, np.ones_like(l), 1 / l),
}


def of_invariants(slopes):
    def stress(theta, a, b, c):
        first = a**2 + b**2 + c**2
        second = 1 / a**2 + 1 / b**2 + 1 / c**2
        one, two = slopes(theta, first, second)
        return 2 * (a**2 - c**2) * (one + two * b**2) / a
    return stress


def carroll(t, i, j):
    return t[0] + 4 * t[1] * i**3, t[2] / (2 * np.sqrt(j))


def lopez_pamies(t, i, j):
    return 0.5 * (t[0] * (i / 3) ** (t[1] - 1) + t[2] * (i / 3) ** (t[3] - 1)), 0


def van_der_waals(t, i, j):
    mu, locking, a, beta = t
    x = (1 - beta) * (i - 3) + beta * (j - 3)
    share = np.sqrt(x / (locking**2 - 3))
    slope = np.where(share < 1, mu / 2 * (1 / np.maximum(1 - share, 1e-9) - a * np.sqrt(x / 2)), 1e6)
    return (1 - beta) * slope, beta * slope


def network(t, i, j):
    left = 1 - t[1] ** 2 * (i - 3)
    left = np.maximum(left, 1e-9)
    return 0.5 * t[0] * ((1 - t[1] ** 2) / left**2 - t[1] ** 2 / left), 0


def extended_tube(t, a, b, c):
    return of_invariants(network)(t, a, b, c) - 2 * t[2] / t[3] * (a ** -t[3] - c ** -t[3]) / a


# Stress, lower and upper bounds, and a box of logarithms or values for random starts.
def laws(reach):
    most = 1 / np.sqrt(reach - 3)
    inf = np.inf
    return {
        "carroll": (of_invariants(carroll), [0, 0, 0], [inf] * 3, [(0, 1), (0, 1e-5), (0, 1)]),
        "lopez-pamies": (of_invariants(lopez_pamies), [0, 0.5, 0, 0.5], [inf, 30, inf, 30],
                         [(0, 0.1), (1, 8), (0, 1), (0.5, 1.5)]),
        "van-der-waals": (of_invariants(van_der_waals), [0, 1.733, 0, 0], [inf, inf, inf, 1],
                          [(0, 1), (np.sqrt(reach), 3 * np.sqrt(reach)), (0, 1), (0, 0.5)]),
        "extended-tube": (extended_tube, [0, 0, 0, 1e-3], [inf, most, inf, 1],
                          [(0, 1), (0.1 * most, 0.99 * most), (0, 1), (0.01, 1)]),
    }


def main():
    tests = read(sys.argv[1])
    reach = max(float(np.max(sum(x**2 for x in MODES[mode](points[0])))) for mode, points in tests.items())
    random = np.random.default_rng(1)
    for name, (stress, low, high, box) in laws(reach).items():
        def residuals(theta, stress=stress):
            parts = [(stress(theta, *MODES[mode](l)) - p) / np.max(np.abs(p)) for mode, (l, p) in tests.items()]
            return np.concatenate(parts)

        begin, found = time.process_time(), []
        for _ in range(STARTS):
            start = np.array([random.uniform(a, b) for a, b in box])
            try:
                end = least_squares(residuals, start, bounds=(low, high), x_scale="jac",
                                    ftol=1e-15, xtol=1e-15, gtol=1e-15, max_nfev=4000)
            except ValueError:
                continue
            found.append((2 * end.cost, end.x))
        spent = time.process_time() - begin
        squares, theta = min(found, key=lambda pair: pair[0])
        agree = sum(1 for other, _ in found if other < squares * (1 + 1e-6))
        print(f"{name:14} S = {squares:.15e}  {agree}/{STARTS}  {spent:.2f} s  {[float(f'{x:.8g}') for x in theta]}")


main()
