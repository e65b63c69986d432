"""Writes testdata/golden/rubber_laws.json: energies, stresses and tangents of the laws of piola_laws::rubber.

Energies are those of the literature, as printed. Stress and tangent are central differences of the energy at 120 digits; slopes by
the invariants that were derived by hand must agree with them. Nothing of Piola is used. Inputs are exact doubles.

    python3 testdata/scripts/rubber_laws.py > testdata/golden/rubber_laws.json
"""

import json
import sys

from mpmath import eigsy, ln, matrix, mp, mpf, nstr, sqrt

mp.dps = 120
STEP = mpf(10) ** -28
NINE = [(i, j) for i in range(3) for j in range(3)]
WORST = [mpf(0)]


def det(a):
    return (a[0, 0] * (a[1, 1] * a[2, 2] - a[1, 2] * a[2, 1]) - a[0, 1] * (a[1, 0] * a[2, 2] - a[1, 2] * a[2, 0])
            + a[0, 2] * (a[1, 0] * a[2, 1] - a[1, 1] * a[2, 0]))


def trace(a):
    return a[0, 0] + a[1, 1] + a[2, 2]


def isochoric(f):
    """I1, I2 of J^(-2/3) C, and J."""
    c, j = f.T * f, det(f)
    first = trace(c)
    second = (first**2 - trace(c * c)) / 2
    return first * j ** (mpf(-2) / 3), second * j ** (mpf(-4) / 3), j


def stretches(f):
    return [sqrt(x) for x in eigsy(f.T * f, eigvals_only=True)]


class OfInvariants:
    """w(I1, I2) + kappa/2 (J - 1)^2 of the isochoric invariants."""

    def energy(self, f):
        first, second, j = isochoric(f)
        return self.shape(first, second) + self.kappa / 2 * (j - 1) ** 2

    def slopes_agree(self, name, f):
        first, second, _ = isochoric(f)
        by_first = (self.shape(first + STEP, second) - self.shape(first - STEP, second)) / (2 * STEP)
        by_second = (self.shape(first, second + STEP) - self.shape(first, second - STEP)) / (2 * STEP)
        agree(name, [by_first, by_second], self.slopes(first, second))


class Carroll(OfInvariants):
    """A I1 + B I1^4 + C sqrt(I2), less its value at rest, + kappa/2 (J - 1)^2"""

    def __init__(self, a, b, c, kappa):
        self.a, self.b, self.c, self.kappa = [mpf(x) for x in (a, b, c, kappa)]

    def shape(self, first, second):
        def whole(x, y):
            return self.a * x + self.b * x**4 + self.c * sqrt(y)
        return whole(first, second) - whole(mpf(3), mpf(3))

    def slopes(self, first, second):
        return [self.a + 4 * self.b * first**3, self.c / (2 * sqrt(second))]


class LopezPamies(OfInvariants):
    """sum 3^(1-a)/(2a) mu (I1^a - 3^a) + kappa/2 (J - 1)^2"""

    def __init__(self, mu1, alpha1, mu2, alpha2, kappa):
        self.terms, self.kappa = [(mpf(mu1), mpf(alpha1)), (mpf(mu2), mpf(alpha2))], mpf(kappa)

    def shape(self, first, _):
        return sum(mpf(3) ** (1 - a) / (2 * a) * mu * (first**a - mpf(3) ** a) for mu, a in self.terms)

    def slopes(self, first, _):
        return [sum(mpf(3) ** (1 - a) / 2 * mu * first ** (a - 1) for mu, a in self.terms), mpf(0)]


class VanDerWaals(OfInvariants):
    """mu (-(lm^2 - 3)(ln(1 - eta) + eta) - 2/3 a (x/2)^(3/2)), x = (1 - b) I1 + b I2 - 3, eta = sqrt(x/(lm^2 - 3)), + kappa/2 (J - 1)^2"""

    def __init__(self, mu, locking, a, beta, kappa):
        self.mu, self.a, self.beta, self.kappa = [mpf(x) for x in (mu, a, beta, kappa)]
        self.limit = mpf(locking) ** 2 - 3

    def shape(self, first, second):
        x = (1 - self.beta) * first + self.beta * second - 3
        eta = sqrt(x / self.limit)
        return self.mu * (-self.limit * (ln(1 - eta) + eta) - 2 * self.a / 3 * (x / 2) ** (mpf(3) / 2))

    def slopes(self, first, second):
        x = (1 - self.beta) * first + self.beta * second - 3
        slope = self.mu / 2 * (1 / (1 - sqrt(x / self.limit)) - self.a * sqrt(x / 2))
        return [(1 - self.beta) * slope, self.beta * slope]


class ExtendedTube(OfInvariants):
    """Gc/2 ((1 - d^2) x/(1 - d^2 x) + ln(1 - d^2 x)) + 2 Ge/b^2 sum (l^-b - 1), x = I1 - 3, l of J^(-1/3) F, + kappa/2 (J - 1)^2"""

    def __init__(self, gc, delta, ge, beta, kappa):
        self.gc, self.d, self.ge, self.b, self.kappa = mpf(gc), mpf(delta) ** 2, mpf(ge), mpf(beta), mpf(kappa)

    def shape(self, first, _):
        x = first - 3
        return self.gc / 2 * ((1 - self.d) * x / (1 - self.d * x) + ln(1 - self.d * x))

    def slopes(self, first, _):
        left = 1 - self.d * (first - 3)
        return [self.gc / 2 * ((1 - self.d) / left**2 - self.d / left), mpf(0)]

    def energy(self, f):
        scale = det(f) ** (mpf(-1) / 3)
        tubes = 2 * self.ge / self.b**2 * sum((x * scale) ** -self.b - 1 for x in stretches(f))
        return super().energy(f) + tubes


class Hyperfoam:
    """sum 2 mu/a^2 (l1^a + l2^a + l3^a - 3 + (J^(-a b) - 1)/b), b = nu/(1 - 2 nu); the limit -a ln J for b = 0"""

    def __init__(self, terms):
        self.terms = [[mpf(x) for x in term] for term in terms]

    def energy(self, f):
        j, found, total = det(f), stretches(f), mpf(0)
        for mu, a, nu in self.terms:
            b = nu / (1 - 2 * nu)
            volume = (j ** (-a * b) - 1) / b if b else -a * ln(j)
            total += 2 * mu / a**2 * (sum(x**a - 1 for x in found) + volume)
        return total

    def slopes_agree(self, name, f):
        """tr(P F^T) = sum over the stretches of 2 mu/a (l^a - J^(-a b))."""
        j, found = det(f), stretches(f)
        by_hand = sum(2 * mu / a * (sum(x**a for x in found) - 3 * j ** (-a * nu / (1 - 2 * nu))) for mu, a, nu in self.terms)
        by_differences = sum(f[p] * (self.energy(f + unit(p)) - self.energy(f - unit(p))) / (2 * STEP) for p in NINE)
        agree(name, [by_differences], [by_hand])


def unit(place):
    e = matrix(3, 3)
    e[place] = STEP
    return e


def agree(what, a, b):
    size = max(abs(x) for x in b)
    worst = max(abs(x - y) for x, y in zip(a, b)) / (size if size else 1)
    WORST[0] = max(WORST[0], worst)
    if worst > mpf(10) ** -40:
        sys.exit(f"{what}: {nstr(worst, 5)}")


def evaluate(name, law, rows):
    f = matrix([[mpf(x) for x in row] for row in rows])
    law.slopes_agree(name, f)
    stress = [(law.energy(f + unit(p)) - law.energy(f - unit(p))) / (2 * STEP) for p in NINE]
    tangent = matrix(9, 9)
    for n, b in enumerate(NINE):
        for m, a in enumerate(NINE[: n + 1]):
            p, q = unit(a), unit(b)
            mixed = law.energy(f + p + q) - law.energy(f + p - q) - law.energy(f - p + q) + law.energy(f - p - q)
            tangent[m, n] = tangent[n, m] = mixed / (4 * STEP**2)
    return {
        "W": number(law.energy(f)),
        "P": [[number(stress[3 * i + j]) for j in range(3)] for i in range(3)],
        "dP_dF": [[number(tangent[i, j]) for j in range(9)] for i in range(9)],
    }


def number(x):
    # What is zero up to the rounding of the differences is zero.
    return nstr(x if abs(x) > mpf(10) ** -40 else mpf(0), 30, strip_zeros=True)


DEFORMATIONS = {
    "general": [[1.25, 0.1875, -0.125], [-0.0625, 0.875, 0.25], [0.15625, -0.09375, 1.125]],
    "compressed": [[0.75, 0.125, 0.0], [-0.1875, 0.9375, 0.0625], [0.03125, 0.15625, 0.8125]],
    "sheared": [[1.0, 0.75, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    "small": [[1 + 2.0**-20, -(2.0**-21), 3 * 2.0**-22], [2.0**-22, 1 - 2.0**-20, 2.0**-21], [-(2.0**-23), 2.0**-20, 1 + 2.0**-22]],
}

LAWS = [
    ("carroll", Carroll, {"a": 0.5, "b": 0.0078125, "c": 0.375, "kappa": 5.0}),
    ("lopez_pamies", LopezPamies, {"mu1": 0.5, "alpha1": 0.75, "mu2": 0.125, "alpha2": 4.5, "kappa": 5.0}),
    ("van_der_waals", VanDerWaals, {"mu": 0.75, "locking": 2.5, "a": 0.25, "beta": 0.1875, "kappa": 5.0}),
    ("extended_tube", ExtendedTube, {"gc": 0.5, "delta": 0.25, "ge": 0.375, "beta": 0.625, "kappa": 5.0}),
    ("hyperfoam", Hyperfoam, {"terms": [[0.5, 8.0, 0.25], [0.25, -2.0, 0.0], [0.125, 3.5, -0.125]]}),
]


def main():
    cases = []
    for name, kind, params in LAWS:
        law = kind(**params)
        for place, rows in DEFORMATIONS.items():
            identity = f"{name}/{place}"
            cases.append({"id": identity, "kind": "law", "law": name, "params": params, "input": {"F": rows},
                          "output": evaluate(identity, law, rows)})
    meta = {
        "what": "energy, first Piola-Kirchhoff stress and its tangent of laws of rubber and foam",
        "source_equations": {name: " ".join(kind.__doc__.split()) for name, kind, _ in LAWS}
        | {"P": "dW/dF", "dP_dF": "9x9, row (i,A) col (j,B) -> 3i+A, 3j+B"},
        "generator": "testdata/scripts/rubber_laws.py (mpmath, 120 digits)",
        "digits": 30,
        "verified_by": "differences of the energy against slopes derived by hand, worst relative difference " + nstr(WORST[0], 3),
    }
    lines = ",\n  ".join(json.dumps(case) for case in cases)
    print('{\n "meta": %s,\n "cases": [\n  %s\n ]\n}' % (json.dumps(meta, indent=1).replace("\n", "\n "), lines))


main()
