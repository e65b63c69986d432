"""Writes testdata/golden/inelastic_paths.json: stresses of solids with internal variables along paths of deformation.

The differential equations of the inelastic deformation are integrated by Gragg's method with extrapolation at 50 digits, in two ways: the
explicit rates of F_i at twice the number of steps must agree. Stresses are first Piola's. Nothing of Piola is used. Inputs are exact doubles.

    python3 testdata/scripts/inelastic_paths.py > testdata/golden/inelastic_paths.json
"""

import json
import sys

from mpmath import diag, eigsy, erf, exp, eye, log, matrix, mp, mpf, nstr, sqrt

mp.dps = 50

R = range(3)


def det(a):
    return (a[0, 0] * (a[1, 1] * a[2, 2] - a[1, 2] * a[2, 1]) - a[0, 1] * (a[1, 0] * a[2, 2] - a[1, 2] * a[2, 0])
            + a[0, 2] * (a[1, 0] * a[2, 1] - a[1, 1] * a[2, 0]))


def inv(a):
    d = det(a)
    out = matrix(3, 3)
    for i in R:
        for j in R:
            r, c = [k for k in R if k != j], [k for k in R if k != i]
            out[i, j] = (-1) ** (i + j) * (a[r[0], c[0]] * a[r[1], c[1]] - a[r[0], c[1]] * a[r[1], c[0]]) / d
    return out


def trace(a):
    return a[0, 0] + a[1, 1] + a[2, 2]


def dev(a):
    return a - eye(3) * (trace(a) / 3)


def norm(a):
    return sqrt(sum(a[i, j] ** 2 for i in R for j in R))


class NeoHookean:
    """mu/2 (I1 - 3 - 2 ln J) + lambda/4 (J^2 - 1 - 2 ln J)"""

    def __init__(self, mu, lam):
        self.mu, self.lam = mpf(mu), mpf(lam)

    def first_piola(self, f):
        j = det(f)
        return self.mu * f + (self.lam / 2 * (j**2 - 1) - self.mu) * inv(f).T

    def mandel(self, f):
        return f.T * self.first_piola(f)

    def energy(self, f):
        j = det(f)
        return self.mu / 2 * (trace(f.T * f) - 3 - 2 * log(j)) + self.lam / 4 * (j**2 - 1 - 2 * log(j))


class Hencky:
    """mu tr (ln U)^2 + lambda/2 (ln J)^2"""

    def __init__(self, lam, mu):
        self.mu, self.lam = mpf(mu), mpf(lam)

    def mandel(self, f):
        values, q = eigsy(f.T * f)
        logs = [log(x) / 2 for x in values]
        total = sum(logs)
        return q * diag([2 * self.mu * x + self.lam * total for x in logs]) * q.T

    def first_piola(self, f):
        return inv(f).T * self.mandel(f)


def path(start, end, t, duration):
    return start + (end - start) * (t / duration)


def midpoint(rate, t, y, width, steps):
    """Gragg's modified midpoint rule over one width."""
    h = width / steps
    before, now = y, [a + h * b for a, b in zip(y, rate(t, y))]
    for k in range(1, steps):
        slope = rate(t + k * h, now)
        before, now = now, [a + 2 * h * b for a, b in zip(before, slope)]
    slope = rate(t + width, now)
    return [(a + b + h * c) / 2 for a, b, c in zip(before, now, slope)]


def integrate(rate, y, duration, parts, columns=12):
    """Extrapolated midpoint rule in equal parts."""
    t, width = mpf(0), mpf(duration) / parts
    for part in range(parts):
        t = width * part
        table, counts = [], [2 * (k + 1) for k in range(columns)]
        for j, n in enumerate(counts):
            row = [midpoint(rate, t, y, width, n)]
            for k in range(1, j + 1):
                ratio = mpf(counts[j]) ** 2 / mpf(counts[j - k]) ** 2
                row.append([a + (a - b) / (ratio - 1) for a, b in zip(row[k - 1], table[j - 1][k - 1])])
            table.append(row)
        y = table[-1][-1]
    return y


def rows(values):
    return matrix([[mpf(x) for x in row] for row in values])


def of(y):
    return matrix([[y[3 * i + j] for j in R] for i in R])


def flat(a):
    return [a[i, j] for i in R for j in R]


def flowing(spring, flow, legs, extra, parts):
    """F_i along legs (start, end, duration); `flow` gives D_i and the rates of further variables."""
    y = flat(eye(3)) + list(extra)
    states = []
    for start, end, duration in legs:
        def rate(t, y):
            f_i = of(y)
            d, more = flow(spring.mandel(path(start, end, t, mpf(duration)) * inv(f_i)), f_i, y[9:])
            return flat(d * f_i) + list(more)
        y = integrate(rate, y, duration, parts)
        states.append((end, y))
    return states


def stress(rest, spring, f, y):
    f_i = inv(of(y))
    p = spring.first_piola(f * f_i) * f_i.T
    return p if rest is None else rest.first_piola(f) + p


F0 = eye(3)
F1 = [[1.25, 0.25, 0.0], [0.0, 0.875, 0.125], [0.0625, 0.0, 1.0]]
F2 = [[0.9375, -0.25, 0.0625], [0.125, 1.125, 0.0], [0.0, 0.1875, 0.9375]]
LEGS = [(F0, rows(F1), 0.5), (rows(F1), rows(F2), 0.75)]


def bergstrom_boyce():
    rest, spring = NeoHookean(1.0, 5.0), NeoHookean(2.0, 8.0)
    rate, scale, m, c, xi = mpf("0.25"), mpf("0.5"), mpf(3), mpf("-0.5"), mpf("0.0625")

    def flow(mandel, f_i, _):
        s = dev(mandel)
        tau = norm(s)
        stretch = sqrt(trace(f_i.T * f_i) / 3) - 1 + xi
        speed = rate * stretch**c * (tau / scale) ** m
        return (s * (speed / tau) if tau > 0 else s), []

    # An odd exponent: the flow is smooth where the stress changes its sign.
    parameters = {"mu": [1.0, 2.0], "lambda": [5.0, 8.0], "rate": 0.25, "stress": 0.5, "stress_exponent": 3.0,
                  "stretch_exponent": -0.5, "perturbation": 0.0625}
    return "bergstrom_boyce", parameters, rest, spring, flow, LEGS, []


def reese_govindjee():
    rest, spring = NeoHookean(1.0, 5.0), NeoHookean(2.0, 8.0)
    eta, zeta = mpf("0.75"), mpf(3)

    def flow(mandel, _f_i, _more):
        return dev(mandel) / (2 * eta) + eye(3) * (trace(mandel) / (9 * zeta)), []

    parameters = {"mu": [1.0, 2.0], "lambda": [5.0, 8.0], "viscosity": 0.75, "bulk_viscosity": 3.0}
    return "reese_govindjee", parameters, rest, spring, flow, LEGS, []


def viscoplastic():
    spring = Hencky(3.0, 2.0)
    sigma0, linear, saturation, delta, eta = mpf("0.25"), mpf("0.125"), mpf("0.5"), mpf(4), mpf("0.5")

    def flow(mandel, _f_i, more):
        s = dev(mandel)
        sigma = sqrt(mpf(3) / 2) * norm(s)
        hardened = sigma0 + linear * more[0] + (saturation - sigma0) * (1 - exp(-delta * more[0]))
        speed = (sigma - hardened) / eta
        assert speed > 0, "the path must stay beyond the yield stress"
        return s * (speed * 3 / 2 / sigma), [speed]

    # The first leg starts from a deformed body, beyond its yield stress.
    far = rows([[1.5, 0.75, 0.0], [0.0, 0.75, 0.25], [0.125, 0.0, 1.0]])
    legs = [(rows(F1), far, 0.5)]
    parameters = {"lambda": 3.0, "mu": 2.0, "yield_stress": 0.25, "linear": 0.125, "saturation": 0.5,
                  "saturation_exponent": 4.0, "viscosity": 0.5}
    return "viscoplastic", parameters, None, spring, flow, legs, [mpf(0)]


def driven_growth():
    law = NeoHookean(1.0, 5.0)
    rate, low, high, gamma = mpf("0.5"), mpf("0.5"), mpf(2), mpf(2)

    def speed(f, theta):
        pull = trace(law.mandel(f / theta))
        share = (high - theta) / (high - 1) if pull > 0 else (theta - low) / (1 - low)
        return rate * share**gamma * pull

    y, states = [mpf(1)], []
    legs = [(rows(F1), rows([[1.5, 0.25, 0.0], [0.0, 1.125, 0.125], [0.0625, 0.0, 1.25]]), 1.0)]
    for start, end, duration in legs:
        rate_of = lambda t, y: [speed(path(start, end, t, mpf(duration)), y[0])]
        again = integrate(rate_of, y, duration, 32)
        y = integrate(rate_of, y, duration, 24)
        print("driven_growth", nstr(abs(y[0] - again[0]), 3), file=sys.stderr)
        states.append((end, y))
    parameters = {"mu": 1.0, "lambda": 5.0, "rate": 0.5, "bounds": [0.5, 2.0], "exponent": 2.0}
    stresses = [law.first_piola(f / y[0]) * y[0] ** 2 for f, y in states]
    return "driven_growth", parameters, legs, states, stresses


def mullins():
    law = NeoHookean(1.0, 5.0)
    r, m, beta = mpf(2), mpf("0.25"), mpf("0.125")
    worst, stresses = mpf(0), []
    near = [[1.0625, 0.125, 0.0], [0.0, 0.9375, 0.0625], [0.03125, 0.0, 1.0]]
    turns = [F1, near, [[1.5, 0.25, 0.0], [0.0, 0.875, 0.125], [0.0625, 0.0, 0.875]], near]
    for turn in turns:
        f = rows(turn)
        worst = max(worst, law.energy(f))
        stresses.append(law.first_piola(f) * (1 - erf((worst - law.energy(f)) / (m + beta * worst)) / r))
    return "mullins", {"mu": 1.0, "lambda": 5.0, "softening": 2.0, "energy": 0.25, "share": 0.125}, turns, stresses


def numbers(values):
    return [nstr(x, 30) for x in values]


def floats(a):
    return [[float(a[i, j]) for j in R] for i in R]


def main():
    cases, worst = [], mpf(0)
    for build in [bergstrom_boyce, reese_govindjee, viscoplastic]:
        name, parameters, rest, spring, flow, legs, extra = build()
        states = flowing(spring, flow, legs, extra, 36)
        again = flowing(spring, flow, legs, extra, 48)
        for number, ((start, end, duration), (f, y), (_, z)) in enumerate(zip(legs, states, again)):
            difference = max(abs(a - b) for a, b in zip(y, z))
            print(name, number, nstr(difference, 3), file=sys.stderr)
            worst = max(worst, difference)
            cases.append({"id": f"{name}/{number}", "law": name, "params": parameters,
                          "input": {"from": floats(start), "to": floats(end), "duration": duration},
                          "output": {"state": numbers(y), "P": numbers(flat(stress(rest, spring, f, y)))}})
    name, parameters, legs, states, stresses = driven_growth()
    for number, ((start, end, duration), (_, y), p) in enumerate(zip(legs, states, stresses)):
        cases.append({"id": f"{name}/{number}", "law": name, "params": parameters,
                      "input": {"from": floats(start), "to": floats(end), "duration": duration},
                      "output": {"state": numbers(y), "P": numbers(flat(p))}})
    name, parameters, turns, stresses = mullins()
    before = floats(F0)
    for number, (turn, p) in enumerate(zip(turns, stresses)):
        cases.append({"id": f"{name}/{number}", "law": name, "params": parameters,
                      "input": {"from": before, "to": turn, "duration": 1.0}, "output": {"P": numbers(flat(p))}})
        before = turn
    meta = {
        "what": "first Piola stresses and internal variables of solids with internal variables, F changing in proportion to time",
        "source_equations": {
            "bergstrom_boyce": "D_i = rate (stretch - 1 + perturbation)^c (|dev M|/stress)^m dev M/|dev M|, stretch = sqrt(tr(F_i^T F_i)/3)",
            "reese_govindjee": "D_i = dev M/(2 viscosity) + tr M/(9 bulk_viscosity) 1",
            "viscoplastic": "D_i = 3/2 dev M/sigma <sigma - sigma(a)>/viscosity, sigma = sqrt(3/2) |dev M|; elastic: " + Hencky.__doc__,
            "driven_growth": "F_g = t 1, dt = rate ((t+ - t)/(t+ - 1))^exponent tr M",
            "mullins": "P (1 - erf((Wmax - W)/(energy + share Wmax))/softening)",
            "springs": NeoHookean.__doc__,
        },
        "generator": "testdata/scripts/inelastic_paths.py (mpmath, 50 digits)",
        "digits": 30,
        "verified_by": "integration in a third more parts, largest difference " + nstr(worst, 3),
    }
    lines = ",\n  ".join(json.dumps(case) for case in cases)
    print('{\n "meta": %s,\n "cases": [\n  %s\n ]\n}' % (json.dumps(meta, indent=1).replace("\n", "\n "), lines))


if __name__ == "__main__":
    main()
