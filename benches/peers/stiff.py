"""Runs the stiff problems of testdata/golden/stiff.json by SciPy's Radau and BDF; prints one table.

    pip install numpy scipy
    python3 benches/peers/stiff.py

Tolerances, problems and columns are those of `cargo run --release -p piola-stiff --example stiff`; Jacobians are exact.
The error is the largest of a component at the end, relative to that component. The time is the least of three runs.
"""

import json
import pathlib
import time

import numpy as np
from scipy.integrate import solve_ivp

ROOT = pathlib.Path(__file__).resolve().parents[2]
RUNS = 3


def van_der_pol(t, y):
    return [y[1], ((1.0 - y[0] * y[0]) * y[1] - y[0]) / 1e-6]


def van_der_pol_jacobian(t, y):
    return [[0.0, 1.0], [(-2.0 * y[0] * y[1] - 1.0) / 1e-6, (1.0 - y[0] * y[0]) / 1e-6]]


def robertson(t, y):
    slow, back, fast = 0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] * y[1]
    return [back - slow, slow - back - fast, fast]


def robertson_jacobian(t, y):
    return [
        [-0.04, 1e4 * y[2], 1e4 * y[1]],
        [0.04, -1e4 * y[2] - 6e7 * y[1], -1e4 * y[1]],
        [0.0, 6e7 * y[1], 0.0],
    ]


def hires(t, y):
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


def hires_jacobian(t, y):
    j = np.zeros((8, 8))
    j[0, :3] = -1.71, 0.43, 8.32
    j[1, :2] = 1.71, -8.75
    j[2, 2:5] = -10.03, 0.43, 0.035
    j[3, 1:4] = 8.32, 1.71, -1.12
    j[4, 4:7] = -1.745, 0.43, 0.43
    j[5, 3:] = 0.69, 1.71, -280.0 * y[7] - 0.43, 0.69, -280.0 * y[5]
    j[6, 5:] = 280.0 * y[7], -1.81, 280.0 * y[5]
    j[7] = -j[6]
    return j


def oregonator(t, y):
    return [
        77.27 * (y[1] + y[0] * (1.0 - 8.375e-6 * y[0] - y[1])),
        (y[2] - (1.0 + y[0]) * y[1]) / 77.27,
        0.161 * (y[0] - y[2]),
    ]


def oregonator_jacobian(t, y):
    return [
        [77.27 * (1.0 - 2.0 * 8.375e-6 * y[0] - y[1]), 77.27 * (1.0 - y[0]), 0.0],
        [-y[1] / 77.27, -(1.0 + y[0]) / 77.27, 1.0 / 77.27],
        [0.161, 0.0, -0.161],
    ]


def spring_pendulum(t, y):
    length = np.hypot(y[0], y[1])
    pull = (1e6 * (length - 1.0) + 2e3 * (y[0] * y[2] + y[1] * y[3]) / length) / length
    return [y[2], y[3], -pull * y[0], -pull * y[1] - 1.0]


def spring_pendulum_jacobian(t, y):
    length = np.hypot(y[0], y[1])
    away = np.array([y[0], y[1]]) / length
    velocity = np.array([y[2], y[3]])
    stretching = away @ velocity
    across = np.eye(2) - np.outer(away, away)
    tension = 1e6 * (length - 1.0) + 2e3 * stretching
    in_place = np.outer(away, 1e6 * away + 2e3 * across @ velocity / length) + tension * across / length
    return np.block([[np.zeros((2, 2)), np.eye(2)], [-in_place, -2e3 * np.outer(away, away)]])


PROBLEMS = [
    ("van der Pol", van_der_pol, van_der_pol_jacobian, 1e-3),
    ("Robertson", robertson, robertson_jacobian, 1e-8),
    ("HIRES", hires, hires_jacobian, 1e-4),
    ("Oregonator", oregonator, oregonator_jacobian, 1e-6),
    # Relative to positions and velocities of size one.
    ("spring pendulum", spring_pendulum, spring_pendulum_jacobian, 1.0),
]


def main():
    golden = json.loads((ROOT / "testdata/golden/stiff.json").read_text())
    cases = {case["name"]: case for case in golden["cases"]}
    print("| problem | tolerance | method | steps | evaluations | Jacobians | factorisations | time, µs | error |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name, rate, jacobian, absolute in PROBLEMS:
        case = cases[name]
        exact = np.array([float(x) for x in case["values"]])
        for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
            for method in ("Radau", "BDF"):
                least = np.inf
                for _ in range(RUNS):
                    clock = time.perf_counter()
                    run = solve_ivp(rate, (0.0, case["end"]), case["start"], method=method, rtol=tolerance,
                                    atol=absolute * tolerance, jac=jacobian)
                    least = min(least, time.perf_counter() - clock)
                error = f"{np.max(np.abs((run.y[:, -1] - exact) / exact)):.1e}" if run.success else f"stops at {run.t[-1]:.4g}"
                print(f"| {name} | {tolerance:.0e} | {method} | {run.t.size - 1} | {run.nfev} | {run.njev} | {run.nlu} "
                      f"| {1e6 * least:.0f} | {error} |", flush=True)


if __name__ == "__main__":
    main()
