"""Writes testdata/golden/symmetric_tops.json: attitudes and angular velocities of heavy symmetric tops, as testdata/golden/tops.json.

Taylor series with 46 digits by the functions of tops.py; 30 digits are written. `sensitivity` is the largest change of the state
by a change of the start, over the latter: two starts that differ by 1e-25. Inputs are exact doubles. Nothing of Piola is used.

    python3 testdata/scripts/symmetric_tops.py > testdata/golden/symmetric_tops.json
"""

import json
import random

from mpmath import mp, mpf, nstr

from tops import run

mp.dps = 46

# Name, J, m g X, q, W, times.
TIMES = [0.5, 2.0, 10.0, -3.0]
CASES = [
    ("nutation and precession", [1.0, 1.0, 0.5], [0.0, 0.0, 1.0], [0.75, 0.5, 0.25, 0.3535533905932738], [0.5, -0.25, 2.0]),
    ("flat body, axis downward", [1.0, 1.0, 1.75], [0.0, 0.0, -2.0], [0.75, 0.5, 0.25, 0.3535533905932738], [1.5, 0.25, 4.0]),
    ("pendulum that swings", [1.0, 1.0, 0.5], [0.0, 0.0, 1.0], [0.6, 0.8, 0.0, 0.0], [0.25, 0.0, 0.0]),
    ("pendulum that turns over", [1.0, 1.0, 0.5], [0.0, 0.0, 1.0], [0.6, 0.8, 0.0, 0.0], [3.0, 0.0, 0.0]),
    ("pendulum with a spin", [1.0, 1.0, 0.5], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 2.0]),
    ("from the top, disturbed", [1.0, 1.0, 0.5], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0], [0.125, 0.25, 1.0]),
    ("sleeping, disturbed", [1.0, 1.0, 0.5], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0], [0.0009765625, 0.0, 8.0]),
    ("past the highest place", [1.0, 1.0, 0.5], [0.0, 0.0, 1.0], [0.8, 0.6, 0.0, 0.0], [3.0, 0.0009765625, 0.0]),
    ("past the lowest place", [1.0, 1.0, 0.5], [0.0, 0.0, 1.0], [0.8, 0.6, 0.0, 0.0], [0.5, 9.5367431640625e-07, 0.0]),
    ("nearly steady", [1.0, 1.0, 0.5], [0.0, 0.0, 1.0], [0.8, 0.6, 0.0, 0.0], [0.0, 0.96, 2.364583333333333]),
    ("without weight", [1.0, 1.0, 0.5], [0.0, 0.0, 0.0], [0.75, 0.5, 0.25, 0.3535533905932738], [0.5, -0.25, 2.0]),
    ("arm along the first axis", [0.25, 2.0, 2.0], [3.0, 0.0, 0.0], [0.5, 0.5, -0.5, 0.5], [5.0, 0.25, -0.5]),
]


def states(inertia, weight, q, w):
    forward, backward = [t for t in TIMES if 0 < t], [t for t in TIMES if t < 0]
    # Backwards: the motion with the opposite angular velocity, reversed.
    found = run(inertia, weight, q, w, forward, 38, mpf(1) / 12)
    back = run(inertia, weight, q, [-c for c in w], [-t for t in backward], 38, mpf(1) / 12)
    return found + [(q, [-c for c in w]) for q, w in back]


random.seed(5)
cases = []
for name, inertia, weight, q, w in CASES:
    exact = [[mpf(x) for x in group] for group in (inertia, weight, q, w)]
    size = sum(c * c for c in exact[2]) ** mpf("0.5")
    exact[2] = [c / size for c in exact[2]]
    reference = states(*exact)
    change = mpf(10) ** -25
    sensitivity = [mpf(0)] * len(reference)
    for _ in range(2):
        moved = [[c + change * random.choice((-1, 1)) for c in group] for group in exact[2:]]
        for index, (a, b) in enumerate(zip(reference, states(*exact[:2], *moved))):
            most = max(abs(x - y) for x, y in zip(a[0] + a[1], b[0] + b[1]))
            sensitivity[index] = max(sensitivity[index], most / change)
    cases.append({
        "name": name, "inertia": inertia, "weight_times_arm": weight, "attitude": q, "angular_velocity": w,
        "states": [
            {"t": t, "attitude": [nstr(c, 30) for c in q], "angular_velocity": [nstr(c, 30) for c in w], "sensitivity": float(s)}
            for t, (q, w), s in zip(TIMES, reference, sensitivity)
        ],
    })
meta = {
    "what": "motion of symmetric tops under their weight: unit quaternions (w, x, y, z), body to space, and angular velocities in body components (rad/s) at given times",
    "source_equations": "q' = q (0, W)/2, J W' = (J W) x W + (weight_times_arm) x (R^T (0, 0, -1)); SI units",
    "generator": "testdata/scripts/symmetric_tops.py",
    "digits": 30,
    "verified_by": "tests of piola-kinematics: the closed form in elliptic functions, which shares nothing with the Taylor series, agrees within rounding",
}
print(json.dumps({"meta": meta, "cases": cases}, indent=1))
