"""Writes testdata/golden/tops.json: attitudes and angular velocities of tops, free and heavy, at given times.

    q' = 1/2 q (0, W),    J W' = (J W) x W + m g X x (R^T e),    e = (0, 0, -1)

with the unit quaternion q = (w, x, y, z), body to space, the angular velocity W and the arm X in body components, and the inertia
J = diag about the point that is held. Taylor series with 80 digits; steps and order differ between two runs, and the digits written
are those of the first, which agree with the second to 40. Checks besides: the length of q, the energy, the angular momentum in space
(of the heavy tops: its vertical part), and Jacobi's elliptic functions for the angular velocity of the free top. Inputs are exact
doubles. Nothing of Piola is used.

    python3 testdata/scripts/tops.py > testdata/golden/tops.json
"""

import json
import sys

from mpmath import ellipfun, mp, mpf, nstr, sqrt

mp.dps = 80

# Name, J, m g X, q, W, times.
CASES = [
    ("free asymmetric top", [1.0, 2.0, 3.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.5, 0.0, 0.75], [0.5, 1.0, 5.0, 20.0]),
    ("free top about its middle axis", [1.0, 2.0, 3.0], [0.0, 0.0, 0.0], [0.5, 0.5, -0.5, 0.5], [0.0009765625, 1.0, 0.0], [1.0, 10.0, 20.0]),
    ("heavy top, asymmetric", [1.0, 1.25, 0.5], [0.25, 0.0, 1.0], [0.75, 0.5, 0.25, 0.3535533905932738], [0.5, -0.25, 2.0], [0.5, 1.0, 2.0, 5.0]),
    # J = diag(0.234375, 0.46875, 0.234375) about the centre of mass, m = 15, g = 9.81, X = (0, 1, 0), about the tip.
    ("heavy top of the test set", [15.234375, 0.46875, 15.234375], [0.0, 15.0 * 9.81, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 150.0, -4.61538], [0.25, 0.5, 1.0, 2.0]),
]


def series(q, w, inertia, weight, order):
    """Taylor coefficients of the quaternion and the angular velocity, [component][power]."""
    q, w = [[c] for c in q], [[c] for c in w]
    e = [[], [], []]
    difference = [(inertia[1] - inertia[2]) / inertia[0], (inertia[2] - inertia[0]) / inertia[1], (inertia[0] - inertia[1]) / inertia[2]]
    for n in range(order):
        def product(a, b):
            return sum((a[k] * b[n - k] for k in range(n + 1)), mpf(0))
        # Minus the third row of R: the direction of gravity in the body.
        e[0].append(-2 * (product(q[1], q[3]) - product(q[0], q[2])))
        e[1].append(-2 * (product(q[2], q[3]) + product(q[0], q[1])))
        e[2].append(-(product(q[0], q[0]) - product(q[1], q[1]) - product(q[2], q[2]) + product(q[3], q[3])))
        moment = [weight[1] * e[2][n] - weight[2] * e[1][n], weight[2] * e[0][n] - weight[0] * e[2][n], weight[0] * e[1][n] - weight[1] * e[0][n]]
        rates = [
            -(product(q[1], w[0]) + product(q[2], w[1]) + product(q[3], w[2])) / 2,
            (product(q[0], w[0]) + product(q[2], w[2]) - product(q[3], w[1])) / 2,
            (product(q[0], w[1]) + product(q[3], w[0]) - product(q[1], w[2])) / 2,
            (product(q[0], w[2]) + product(q[1], w[1]) - product(q[2], w[0])) / 2,
        ]
        accelerations = [difference[i] * product(w[(i + 1) % 3], w[(i + 2) % 3]) + moment[i] / inertia[i] for i in range(3)]
        for component, rate in zip(q + w, rates + accelerations):
            component.append(rate / (n + 1))
    return q, w


def radius(components, order):
    size = max(abs(c[order]) for c in components)
    return size ** (-mpf(1) / order) if size > 0 else mpf(10)


def run(inertia, weight, q, w, times, order, part):
    t, states, steps = mpf(0), [], 0
    for end in times:
        while t < end:
            qs, ws = series(q, w, inertia, weight, order)
            h = min(radius(qs + ws, order) * part, end - t)
            q, w = [[sum(c * h**k for k, c in enumerate(component)) for component in group] for group in (qs, ws)]
            t, steps = t + h, steps + 1
        states.append((q, w))
    print(order, part, steps, file=sys.stderr)
    return states


def to_space(q, v):
    a, b, c, d = q
    return [
        (1 - 2 * (c * c + d * d)) * v[0] + 2 * (b * c - a * d) * v[1] + 2 * (b * d + a * c) * v[2],
        2 * (b * c + a * d) * v[0] + (1 - 2 * (b * b + d * d)) * v[1] + 2 * (c * d - a * b) * v[2],
        2 * (b * d - a * c) * v[0] + 2 * (c * d + a * b) * v[1] + (1 - 2 * (b * b + c * c)) * v[2],
    ]


def kept(q, w, inertia, weight):
    """What the motion keeps: |q|^2, the energy, the angular momentum in space, all or its vertical part."""
    momentum = to_space(q, [i * x for i, x in zip(inertia, w)])
    energy = sum(i * x * x for i, x in zip(inertia, w)) / 2 + to_space(q, weight)[2]
    length = sum(x * x for x in q)
    return [length, energy, momentum[2]] + (momentum[:2] if not any(weight) else [])


def elliptic(inertia, w, t):
    """The angular velocity of a free top that starts with W2 = 0 and 2 T J2 < L^2: rotation about the third axis."""
    j1, j2, j3 = inertia
    twice_energy = sum(i * x * x for i, x in zip(inertia, w))
    square = sum((i * x) ** 2 for i, x in zip(inertia, w))
    assert twice_energy * j2 < square
    rate = sqrt((j3 - j2) * (square - twice_energy * j1) / (j1 * j2 * j3))
    m = (j2 - j1) * (twice_energy * j3 - square) / ((j3 - j2) * (square - twice_energy * j1))
    sn, cn, dn = (ellipfun(kind, rate * t, m=m) for kind in ("sn", "cn", "dn"))
    a1 = sqrt((twice_energy * j3 - square) / (j1 * (j3 - j1)))
    a2 = sqrt((twice_energy * j3 - square) / (j2 * (j3 - j2)))
    a3 = sqrt((square - twice_energy * j1) / (j3 * (j3 - j1)))
    # The signs: J2 W2' = (J3 - J1) W3 W1 > 0 at the start.
    return [a1 * cn, a2 * sn, a3 * dn]


def main():
    cases = []
    for name, inertia, weight, q, w, times in CASES:
        exact = [[mpf(x) for x in values] for values in (inertia, weight, q, w)]
        # The start is normalised here as a program would, with all digits.
        length = sqrt(sum(x * x for x in exact[2]))
        exact[2] = [x / length for x in exact[2]]
        first, second = run(*exact, times, 60, mpf(1) / 10), run(*exact, times, 54, mpf(1) / 16)
        before = kept(exact[2], exact[3], exact[0], exact[1])
        states, agreement = [], mpf(0)
        for t, (a, b), (c, d) in zip(times, first, second):
            agreement = max([agreement] + [abs(x - y) for x, y in zip(a + b, c + d)])
            for x, y in zip(kept(a, b, exact[0], exact[1]), before):
                assert abs(x - y) < mpf(10) ** -38, (name, t, x - y)
            if name == "free asymmetric top":
                for x, y in zip(elliptic(exact[0], exact[3], mpf(t)), b):
                    assert abs(x - y) < mpf(10) ** -38, (name, t, x, y)
            states.append({"t": t, "attitude": [nstr(x, 36) for x in a], "angular_velocity": [nstr(x, 36) for x in b]})
        assert agreement < mpf(10) ** -40, (name, agreement)
        cases.append({
            "name": name,
            "inertia": inertia,
            "weight_times_arm": weight,
            "attitude": q,
            "angular_velocity": w,
            "states": states,
            "agreement": nstr(agreement, 2),
        })
    meta = {
        "what": "motion of free and heavy tops about a fixed point: unit quaternions (w, x, y, z), body to space, and angular velocities in body components (rad/s) at given times",
        "source_equations": "q' = q (0, W)/2, J W' = (J W) x W + (weight_times_arm) x (R^T (0, 0, -1)); SI units",
        "source": "heavy top of the test set: O. Bruels, A. Cardona & M. Arnold, Mech. Mach. Theory 48 (2012) 121; M. Geradin & A. Cardona, Flexible Multibody Dynamics (2001). Its inertia is that about the tip, diag(0.234375, 0.46875, 0.234375) + 15 diag(1, 0, 1).",
        "generator": "testdata/scripts/tops.py",
        "digits": 36,
        "verified_by": "a second run with another order and other steps; energy and angular momentum; Jacobi's elliptic functions for the free asymmetric top",
    }
    print(json.dumps({"meta": meta, "cases": cases}, indent=1))


if __name__ == "__main__":
    main()
