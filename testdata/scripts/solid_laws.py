"""Writes testdata/golden/solid_laws.json: energies, stresses and tangents of laws of solids that hyperelastic.json lacks.

Energies are those of the literature. Stress and tangent are central differences of the energy at 160 digits; hand-derived stresses
and their differences must agree. Nothing of Piola is used. Inputs are exact doubles.

    python3 testdata/scripts/solid_laws.py > testdata/golden/solid_laws.json
"""

import json
import sys

from mpmath import coth, exp, eye, ln, matrix, mp, mpf, nstr, sinh, sqrt

mp.dps = 160
STEP = mpf(10) ** -36
VOIGT = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]
NINE = [(i, j) for i in range(3) for j in range(3)]
WORST = [mpf(0)]


def trace(a):
    return a[0, 0] + a[1, 1] + a[2, 2]


def det(a):
    return (a[0, 0] * (a[1, 1] * a[2, 2] - a[1, 2] * a[2, 1]) - a[0, 1] * (a[1, 0] * a[2, 2] - a[1, 2] * a[2, 0])
            + a[0, 2] * (a[1, 0] * a[2, 1] - a[1, 1] * a[2, 0]))


def inverse(a):
    d = det(a)
    def minor(i, j):
        r, c = [k for k in range(3) if k != j], [k for k in range(3) if k != i]
        return (-1) ** (i + j) * (a[r[0], c[0]] * a[r[1], c[1]] - a[r[0], c[1]] * a[r[1], c[0]])
    return matrix([[minor(i, j) / d for j in range(3)] for i in range(3)])


def invariants(f):
    c = f.T * f
    first = trace(c)
    return first, (first**2 - trace(c * c)) / 2, det(f)


class Isotropic:
    """W(I1, I2, J): P = 2 W_1 F + 2 W_2 (I1 F - F C) + W_J J F^-T."""

    def energy(self, f):
        return self.of(*invariants(f))

    def first_piola(self, f):
        first, second, j = invariants(f)
        w1, w2, wj = self.slopes(first, second, j)
        return 2 * w1 * f + 2 * w2 * (first * f - f * f.T * f) + wj * j * inverse(f).T


class Isochoric(Isotropic):
    """w(x) + kappa/2 (J - 1)^2, x = J^(-2/3) I1 - 3."""

    def of(self, first, second, j):
        return self.shape(first * j ** (mpf(-2) / 3) - 3) + self.kappa / 2 * (j - 1) ** 2

    def slopes(self, first, second, j):
        scale = j ** (mpf(-2) / 3)
        slope = self.slope(first * scale - 3)
        return slope * scale, 0, self.kappa * (j - 1) - slope * scale * first * 2 / (3 * j)


class Yeoh(Isochoric):
    def __init__(self, c1, c2, c3, kappa):
        self.c, self.kappa = [mpf(c1), mpf(c2), mpf(c3)], mpf(kappa)

    def shape(self, x):
        return sum(c * x ** (n + 1) for n, c in enumerate(self.c))

    def slope(self, x):
        return sum((n + 1) * c * x**n for n, c in enumerate(self.c))


class Rivlin(Isotropic):
    """sum c x^a y^b + kappa/2 (J - 1)^2, x = J^(-2/3) I1 - 3, y = J^(-4/3) I2 - 3."""

    def __init__(self, terms, kappa):
        self.terms, self.kappa = [(a, b, mpf(c)) for a, b, c in terms], mpf(kappa)

    def of(self, first, second, j):
        x, y = first * j ** (mpf(-2) / 3) - 3, second * j ** (mpf(-4) / 3) - 3
        return sum(c * x**a * y**b for a, b, c in self.terms) + self.kappa / 2 * (j - 1) ** 2

    def slopes(self, first, second, j):
        one, two = j ** (mpf(-2) / 3), j ** (mpf(-4) / 3)
        x, y = first * one - 3, second * two - 3
        wx = sum(a * c * x ** (a - 1) * y**b for a, b, c in self.terms if a)
        wy = sum(b * c * x**a * y ** (b - 1) for a, b, c in self.terms if b)
        return wx * one, wy * two, self.kappa * (j - 1) - (2 * wx * one * first + 4 * wy * two * second) / (3 * j)


class Gent(Isochoric):
    def __init__(self, mu, limit, kappa):
        self.mu, self.limit, self.kappa = mpf(mu), mpf(limit), mpf(kappa)

    def shape(self, x):
        return -self.mu * self.limit / 2 * ln(1 - x / self.limit)

    def slope(self, x):
        return self.mu / 2 / (1 - x / self.limit)


class ArrudaBoyce(Isochoric):
    def __init__(self, modulus, links, kappa):
        self.modulus, self.links, self.kappa = mpf(modulus), mpf(links), mpf(kappa)

    @staticmethod
    def beta(stretch):
        """coth b - 1/b = stretch, by Newton's method."""
        b = stretch * (3 - stretch**2) / (1 - stretch**2)
        for _ in range(400):
            step = (coth(b) - 1 / b - stretch) / (1 / b**2 - 1 / sinh(b) ** 2)
            b -= step
            if abs(step) < mpf(10) ** (5 - mp.dps) * b:
                return b
        raise ArithmeticError(stretch)

    def chain(self, stretch):
        b = self.beta(stretch)
        return b * stretch + ln(b / sinh(b))

    def shape(self, x):
        rest = 1 / sqrt(self.links)
        return self.modulus * self.links * (self.chain(sqrt((x + 3) / (3 * self.links))) - self.chain(rest))

    def slope(self, x):
        stretch = sqrt((x + 3) / (3 * self.links))
        return self.modulus * self.beta(stretch) / (6 * stretch)


class BlatzKo(Isotropic):
    def __init__(self, mu, nu, f):
        self.mu, self.f = mpf(mu), mpf(f)
        self.beta = mpf(nu) / (1 - 2 * mpf(nu))

    def of(self, first, second, j):
        b, third = self.beta, j**2
        solid = first - 3 + (third**-b - 1) / b
        foam = second / third - 3 + (third**b - 1) / b
        return self.mu / 2 * (self.f * solid + (1 - self.f) * foam)

    def slopes(self, first, second, j):
        b, solid, foam = self.beta, self.mu / 2 * self.f, self.mu / 2 * (1 - self.f)
        wj = -2 * solid * j ** (-2 * b - 1) + foam * (2 * j ** (2 * b - 1) - 2 * second / j**3)
        return solid, foam / j**2, wj


class Fung:
    """c/2 (e^Q - 1), Q = E : A : E, A given by its components over 11, 22, 33, 12, 23, 13."""

    def __init__(self, c, exponents):
        self.c, self.a = mpf(c), full(exponents)

    def energy(self, f):
        e = (f.T * f - eye(3)) / 2
        return self.c / 2 * (exp(contract(e, apply(self.a, e))) - 1)

    def first_piola(self, f):
        e = (f.T * f - eye(3)) / 2
        image = apply(self.a, e)
        return f * image * (self.c * exp(contract(e, image)))


class SaintVenantKirchhoff:
    """1/2 E : C : E."""

    def __init__(self, stiffness):
        self.a = full(stiffness)

    def energy(self, f):
        e = (f.T * f - eye(3)) / 2
        return contract(e, apply(self.a, e)) / 2

    def first_piola(self, f):
        return f * apply(self.a, (f.T * f - eye(3)) / 2)


class Holzapfel:
    """mu/2 (I1 - 3) + kappa/2 (J - 1)^2 + k1/(2 k2) sum (exp(k2 <E>^2) - 1), E = d (I1 - 3) + (1 - 3 d)(I4 - 1), I of J^(-2/3) C."""

    def __init__(self, mu, kappa, k1, k2, dispersion, fibres):
        self.mu, self.kappa, self.k1, self.k2, self.d = [mpf(x) for x in (mu, kappa, k1, k2, dispersion)]
        self.fibres = []
        for fibre in fibres:
            a = matrix([mpf(x) for x in fibre])
            self.fibres.append(a / sqrt(sum(x**2 for x in a)))

    def strains(self, f):
        c = f.T * f * det(f) ** (mpf(-2) / 3)
        along = [(a.T * c * a)[0] for a in self.fibres]
        return trace(c), [self.d * (trace(c) - 3) + (1 - 3 * self.d) * (x - 1) for x in along]

    def energy(self, f):
        first, strains = self.strains(f)
        fibres = sum(exp(self.k2 * max(e, mpf(0)) ** 2) - 1 for e in strains)
        return self.mu / 2 * (first - 3) + self.kappa / 2 * (det(f) - 1) ** 2 + self.k1 / (2 * self.k2) * fibres

    def first_piola(self, f):
        j, inverse_t = det(f), inverse(f).T
        first, strains = self.strains(f)
        scale = j ** (mpf(-2) / 3)
        stress = self.mu * (scale * f - first / 3 * inverse_t) + self.kappa * (j - 1) * j * inverse_t
        for a, e in zip(self.fibres, strains):
            if 0 < e:
                structure = self.d * eye(3) + (1 - 3 * self.d) * (a * a.T)
                slope = 2 * scale * f * structure - mpf(2) / 3 * (e + 1) * inverse_t
                stress += self.k1 * e * exp(self.k2 * e**2) * slope
        return stress


class Reinforced:
    """mu/2 (I1 - 3 - 2 ln J) + lambda/2 (ln J)^2 + k/2 (I4 - 1)^2."""

    def __init__(self, mu, lame, k, fibre):
        self.mu, self.lame, self.k = mpf(mu), mpf(lame), mpf(k)
        a = matrix([mpf(x) for x in fibre])
        self.a = a / sqrt(sum(x**2 for x in a))

    def energy(self, f):
        j, c = det(f), f.T * f
        along = (self.a.T * c * self.a)[0]
        return self.mu / 2 * (trace(c) - 3 - 2 * ln(j)) + self.lame / 2 * ln(j) ** 2 + self.k / 2 * (along - 1) ** 2

    def first_piola(self, f):
        j, inverse_t = det(f), inverse(f).T
        along = (self.a.T * f.T * f * self.a)[0]
        return self.mu * (f - inverse_t) + self.lame * ln(j) * inverse_t + 2 * self.k * (along - 1) * f * self.a * self.a.T


def full(six):
    """Components over 11, 22, 33, 12, 23, 13 by pairs of indices."""
    place = {pair: n for n, pair in enumerate(VOIGT)} | {(j, i): n for n, (i, j) in enumerate(VOIGT)}
    return {(i, j, k, l): mpf(six[place[i, j]][place[k, l]]) for i, j in NINE for k, l in NINE}


def apply(a, e):
    return matrix([[sum(a[i, j, k, l] * e[k, l] for k, l in NINE) for j in range(3)] for i in range(3)])


def contract(a, b):
    return sum(a[i, j] * b[i, j] for i, j in NINE)


def orthotropic(young, poisson, shear, axes):
    """Stiffness of E1 E2 E3, nu12 nu23 nu13, G12 G23 G13 in axes that are the columns of a rotation: the inverse of the compliance."""
    e, (n12, n23, n13) = [mpf(x) for x in young], [mpf(x) for x in poisson]
    compliance = matrix([[1 / e[0], -n12 / e[0], -n13 / e[0]], [-n12 / e[0], 1 / e[1], -n23 / e[1]], [-n13 / e[0], -n23 / e[1], 1 / e[2]]])
    normal = inverse(compliance)
    own = {key: mpf(0) for key in full([[0] * 6] * 6)}
    for i in range(3):
        for k in range(3):
            own[i, i, k, k] = normal[i, k]
    for (i, j), g in zip([(0, 1), (1, 2), (0, 2)], shear):
        for pair in [(i, j), (j, i)]:
            for other in [(i, j), (j, i)]:
                own[(*pair, *other)] = mpf(g)
    q = matrix([[mpf(x) for x in row] for row in axes])
    turned = dict(own)
    for place in range(4):
        before, turned = turned, {}
        for key in own:
            with_index = lambda m: key[:place] + (m,) + key[place + 1:]
            turned[key] = sum(q[key[place], m] * before[with_index(m)] for m in range(3))
    return [[turned[(*a, *b)] for b in VOIGT] for a in VOIGT]


def transverse(along, across, poisson_along, poisson_across, shear, direction):
    """Isotropic across a direction, which is the first axis: nu12 = nu13 = nu_at, nu23 = nu_tt, G23 = E_t/(2 (1 + nu_tt))."""
    a = matrix([mpf(x) for x in direction])
    a = a / sqrt(sum(x**2 for x in a))
    other = matrix([a[1], -a[0], 0]) / sqrt(a[0] ** 2 + a[1] ** 2)
    third = [a[1] * other[2] - a[2] * other[1], a[2] * other[0] - a[0] * other[2], a[0] * other[1] - a[1] * other[0]]
    axes = [[a[i], other[i], third[i]] for i in range(3)]
    rigid = mpf(across) / (2 * (1 + mpf(poisson_across)))
    poisson = [poisson_along, poisson_across, poisson_along]
    return orthotropic([along, across, across], poisson, [shear, rigid, shear], axes)


def unit(place):
    i, j = place
    e = matrix(3, 3)
    e[i, j] = STEP
    return e


def agree(what, a, b):
    size = max(abs(x) for x in b)
    worst = max(abs(x - y) for x, y in zip(a, b)) / (size if size else 1)
    WORST[0] = max(WORST[0], worst)
    if worst > mpf(10) ** -50:
        sys.exit(f"{what}: {nstr(worst, 5)}")


def evaluate(name, law, rows):
    f = matrix([[mpf(x) for x in row] for row in rows])
    j, back, c = det(f), inverse(f), f.T * f
    stress = matrix(3, 3)
    for place in NINE:
        stress[place] = (law.energy(f + unit(place)) - law.energy(f - unit(place))) / (2 * STEP)
    agree(name, list(law.first_piola(f)), list(stress))
    tangent, slopes = matrix(9, 9), matrix(9, 9)
    for n, b in enumerate(NINE):
        change = (law.first_piola(f + unit(b)) - law.first_piola(f - unit(b))) / (2 * STEP)
        for m, a in enumerate(NINE):
            slopes[m, n] = change[a]
            if m <= n:
                p, q = unit(a), unit(b)
                mixed = law.energy(f + p + q) - law.energy(f + p - q) - law.energy(f - p + q) + law.energy(f - p - q)
                tangent[m, n] = tangent[n, m] = mixed / (4 * STEP**2)
    agree(name + " tangent", list(slopes), list(tangent))
    second = back * stress
    # C_ABCD = F^-1_Ai F^-1_Ck (dP_iB/dF_kD - delta_ik S_BD).
    material = []
    for a, b in VOIGT:
        row = []
        for c_, d in VOIGT:
            terms = (back[a, i] * back[c_, k] * (tangent[3 * i + b, 3 * k + d] - (second[b, d] if i == k else 0))
                     for i in range(3) for k in range(3))
            row.append(sum(terms))
        material.append(row)
    cauchy = stress * f.T / j
    return {
        "W": number(law.energy(f)),
        "P": table(stress),
        "T": table(cauchy),
        "dP_dF": table(tangent),
        "dS_dE": [[number(x) for x in row] for row in material],
    }


def number(x):
    # What is zero up to the rounding of the differences is zero.
    return nstr(x if abs(x) > mpf(10) ** -45 else mpf(0), 30, strip_zeros=True)


def table(a):
    return [[number(a[i, j]) for j in range(a.cols)] for i in range(a.rows)]


DEFORMATIONS = {
    "general": [[1.25, 0.1875, -0.125], [-0.0625, 0.875, 0.25], [0.15625, -0.09375, 1.125]],
    "compressed": [[0.75, 0.125, 0.0], [-0.1875, 0.9375, 0.0625], [0.03125, 0.15625, 0.8125]],
    "sheared": [[1.0, 0.75, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    "small": [[1 + 2.0**-20, -(2.0**-21), 3 * 2.0**-22], [2.0**-22, 1 - 2.0**-20, 2.0**-21], [-(2.0**-23), 2.0**-20, 1 + 2.0**-22]],
}

ANISOTROPIC = [
    [2.0, 0.5, 0.25, 0.125, 0.0, -0.0625],
    [0.5, 1.5, 0.375, -0.25, 0.0625, 0.0],
    [0.25, 0.375, 1.25, 0.0, 0.1875, 0.125],
    [0.125, -0.25, 0.0, 0.75, 0.0625, 0.03125],
    [0.0, 0.0625, 0.1875, 0.0625, 0.625, -0.125],
    [-0.0625, 0.0, 0.125, 0.03125, -0.125, 0.875],
]

LAWS = [
    ("yeoh", Yeoh, {"c1": 0.5, "c2": -0.0625, "c3": 0.03125, "kappa": 5.0}),
    ("rivlin", Rivlin, {"terms": [[1, 0, 0.5], [0, 1, 0.125], [1, 1, 0.0625], [0, 2, 0.03125], [3, 0, 0.015625]], "kappa": 5.0}),
    ("mooney_rivlin", Rivlin, {"terms": [[1, 0, 0.5], [0, 1, 0.25]], "kappa": 5.0}),
    ("gent", Gent, {"mu": 0.75, "limit": 3.0, "kappa": 5.0}),
    ("arruda_boyce", ArrudaBoyce, {"modulus": 0.75, "links": 2.5, "kappa": 5.0}),
    ("blatz_ko", BlatzKo, {"mu": 0.75, "nu": 0.375, "f": 0.6875}),
    ("blatz_ko", BlatzKo, {"mu": 0.75, "nu": 0.25, "f": 0.0}),
    ("blatz_ko", BlatzKo, {"mu": 0.75, "nu": 0.25, "f": 1.0}),
    ("fung", Fung, {"c": 1.5, "exponents": ANISOTROPIC}),
    ("holzapfel_gasser_ogden", Holzapfel, {"mu": 0.5, "kappa": 4.0, "k1": 1.25, "k2": 2.5, "dispersion": 0.1875,
                                           "fibres": [[3.0, 4.0, 0.0], [1.0, -2.0, 2.0]]}),
    ("holzapfel_gasser_ogden", Holzapfel, {"mu": 0.5, "kappa": 4.0, "k1": 1.25, "k2": 2.5, "dispersion": 0.0,
                                           "fibres": [[3.0, 4.0, 0.0], [1.0, -2.0, 2.0]]}),
    ("reinforced_neo_hookean", Reinforced, {"mu": 0.5, "lame": 1.25, "k": 0.75, "fibre": [2.0, 1.0, -2.0]}),
    ("saint_venant_kirchhoff_orthotropic", SaintVenantKirchhoff,
     {"young": [12.0, 3.0, 1.5], "poisson": [0.25, 0.375, 0.125], "shear": [0.75, 0.5, 1.25],
      "axes": [[0.0, -0.6, 0.8], [1.0, 0.0, 0.0], [0.0, 0.8, 0.6]]}),
    ("saint_venant_kirchhoff_transverse", SaintVenantKirchhoff,
     {"along": 12.0, "across": 3.0, "poisson_along": 0.25, "poisson_across": 0.375, "shear": 0.75, "direction": [2.0, 1.0, -2.0]}),
]

VOLUMETRIC = {
    "quadratic": ("kappa/2 (J - 1)^2", lambda k, j: k / 2 * (j - 1) ** 2),
    "logarithmic": ("kappa/2 (ln J)^2", lambda k, j: k / 2 * ln(j) ** 2),
    "quadratic_logarithmic": ("kappa/4 ((J - 1)^2 + (ln J)^2)", lambda k, j: k / 4 * ((j - 1) ** 2 + ln(j) ** 2)),
    "simo_taylor": ("kappa/4 (J^2 - 1 - 2 ln J)", lambda k, j: k / 4 * (j**2 - 1 - 2 * ln(j))),
    "liu": ("kappa (J ln J - J + 1)", lambda k, j: k * (j * ln(j) - j + 1)),
    "miehe": ("kappa (J - ln J - 1)", lambda k, j: k * (j - ln(j) - 1)),
    "ogden": ("kappa/beta^2 (beta ln J + J^-beta - 1), beta = 9", lambda k, j: k / 81 * (9 * ln(j) + j**-9 - 1)),
    "hartmann_neff": ("kappa/50 (J^5 + J^-5 - 2)", lambda k, j: k / 50 * (j**5 + j**-5 - 2)),
}


def build(name, kind, params):
    if name == "saint_venant_kirchhoff_orthotropic":
        return kind(orthotropic(*params.values()))
    if name == "saint_venant_kirchhoff_transverse":
        return kind(transverse(*params.values()))
    return kind(**params)


def main():
    cases = []
    for number_of, (name, kind, params) in enumerate(LAWS):
        law = build(name, kind, params)
        for place, rows in DEFORMATIONS.items():
            identity = f"{name}_{number_of}/{place}"
            cases.append({"id": identity, "kind": "law", "law": name, "params": params, "input": {"F": rows},
                          "output": evaluate(identity, law, rows)})
    for name, (formula, energy) in VOLUMETRIC.items():
        for j in [0.375, 0.875, 1.5, 3.0]:
            kappa, volume = mpf(7), mpf(j)
            up, here, down = [energy(kappa, volume + s * STEP) for s in (1, 0, -1)]
            output = {"U": number(here), "J_dU": number(volume * (up - down) / (2 * STEP)), "d2U": number((up - 2 * here + down) / STEP**2)}
            cases.append({"id": f"{name}/{j}", "kind": "volumetric", "law": name, "formula": formula, "params": {"kappa": 7.0},
                          "input": {"J": j}, "output": output})
    meta = {
        "what": "energy, stresses and both tangents of laws of solids; energies of a change of volume with their derivatives",
        "source_equations": {
            "yeoh": "c1 x + c2 x^2 + c3 x^3 + kappa/2 (J - 1)^2, x = J^(-2/3) I1 - 3",
            "rivlin": Rivlin.__doc__,
            "mooney_rivlin": "the same",
            "gent": "-mu Jm/2 ln(1 - x/Jm) + kappa/2 (J - 1)^2",
            "arruda_boyce": "n N (b s + ln(b/sinh b)) less its value at rest + kappa/2 (J - 1)^2, coth b - 1/b = s = sqrt((x + 3)/(3 N))",
            "blatz_ko": "mu f/2 (I1 - 3 + (I3^-b - 1)/b) + mu (1 - f)/2 (I2/I3 - 3 + (I3^b - 1)/b), b = nu/(1 - 2 nu)",
            "fung": "c/2 (exp(E : A : E) - 1), A by its components over 11, 22, 33, 12, 23, 13",
            "holzapfel_gasser_ogden": " ".join(Holzapfel.__doc__.split()),
            "reinforced_neo_hookean": Reinforced.__doc__,
            "saint_venant_kirchhoff_orthotropic": "1/2 E : C : E, C the inverse of the compliance; axes are columns",
            "saint_venant_kirchhoff_transverse": "the same, isotropic across a direction",
            "P": "dW/dF",
            "T": "P F^T / J",
            "dS_dE": "6x6, over 11, 22, 33, 12, 23, 13; entry = C_ijkl",
            "dP_dF": "9x9, row (i,A) col (j,B) -> 3i+A, 3j+B",
        },
        "generator": "testdata/scripts/solid_laws.py (mpmath, 160 digits)",
        "digits": 30,
        "verified_by": "differences of the energy against hand-derived stresses and their differences, worst relative difference "
                       + nstr(WORST[0], 3),
    }
    lines = ",\n  ".join(json.dumps(case) for case in cases)
    print('{\n "meta": %s,\n "cases": [\n  %s\n ]\n}' % (json.dumps(meta, indent=1).replace("\n", "\n "), lines))


main()
