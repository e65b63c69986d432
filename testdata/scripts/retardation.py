"""Writes testdata/golden/retardation.json: relaxation spectra with their retardation spectra, and the reverse.

    Q(s) = Ge + sum g s t/(1 + s t),    s J(s) = 1/Q(s),    J(t) = Jg + t/eta + sum J (1 - exp(-t/l))

and the reverse from given retardation spectra. The zeros of the polynomial Q(s) prod (1 + s t) are the rates -1/l; the residues give J. Polynomial roots with 120 digits, which share
no step with a search between poles; written are 30. Each case is verified by s J(s) Q(s) = 1 at five s, to 60 digits. Inputs are exact
doubles. Nothing of Piola is used.

    python3 testdata/scripts/retardation.py > testdata/golden/retardation.json
"""

import json
import random
import sys

from mpmath import exp, mp, mpf, nstr, polyroots

mp.dps = 160


def product(roots):
    """Coefficients of prod (1 + s r), the highest first."""
    poly = [mpf(1)]
    for r in roots:
        poly = [a * r + b for a, b in zip(poly + [mpf(0)], [mpf(0)] + poly)]
    return poly


def add(a, b):
    n = max(len(a), len(b))
    return [x + y for x, y in zip([mpf(0)] * (n - len(a)) + a, [mpf(0)] * (n - len(b)) + b)]


def value(poly, s):
    total = mpf(0)
    for c in poly:
        total = total * s + c
    return total


def derivative(poly):
    n = len(poly) - 1
    return [c * (n - k) for k, c in enumerate(poly[:-1])]


def real_roots(poly):
    """Roots of a polynomial, all real and negative."""
    found = polyroots(poly, maxsteps=4000, extraprec=1600)
    assert all(abs(r.imag) <= abs(r) * mpf(10) ** -60 for r in found)
    return sorted((r.real for r in found), reverse=True)


def retardation(modes, equilibrium):
    modes = [(mpf(g), mpf(t)) for g, t in modes]
    equilibrium = mpf(equilibrium)
    below = product([t for _, t in modes])
    above = [equilibrium * c for c in below]
    for k, (g, t) in enumerate(modes):
        rest = product([other for j, (_, other) in enumerate(modes) if j != k])
        above = add(above, [g * t * c for c in rest] + [mpf(0)])
    # 1/Q = below/above; of a liquid above has the factor s.
    is_liquid = equilibrium == 0
    if is_liquid:
        above = above[:-1]
    found = []
    slope = derivative(above)
    for r in real_roots(above) if len(above) > 1 else []:
        # 1/Q has the residue c at r; of a creep mode it is J/(1 + s l) with l = -1/r: J = c l.
        c = value(below, r) / value(slope, r) / (r if is_liquid else 1)
        found.append((-c / r, -1 / r))
    glassy = 1 / (equilibrium + sum(g for g, _ in modes))
    fluidity = 1 / sum(g * t for g, t in modes) if is_liquid else mpf(0)
    for s in [mpf("0.37"), mpf(2), mpf("1e-3"), mpf(1000), mpf("17.5")]:
        q = equilibrium + sum(g * s * t / (1 + s * t) for g, t in modes)
        j = glassy + fluidity / s + sum(J / (1 + s * l) for J, l in found)
        assert abs(q * j - 1) < mpf(10) ** -60
    return sorted(found, key=lambda mode: mode[1]), glassy, fluidity


def case(name, modes, equilibrium):
    found, glassy, fluidity = retardation(modes, equilibrium)
    times = [0.0, 1e-3, 0.125, 1.0, 7.0, 300.0]
    creep = [glassy + fluidity * t + sum(J * (1 - exp(-mpf(t) / l)) for J, l in found) for t in times]
    digits = lambda x: nstr(x, 30)
    return {
        "name": name,
        "moduli": [g for g, _ in modes],
        "relaxation_times": [t for _, t in modes],
        "equilibrium_modulus": equilibrium,
        "compliances": [digits(J) for J, _ in found],
        "retardation_times": [digits(l) for _, l in found],
        "glassy_compliance": digits(glassy),
        "fluidity": digits(fluidity),
        "times": times,
        "creep": [digits(x) for x in creep],
    }


def reverse(name, modes, glassy, fluidity):
    """From a retardation spectrum: 1/Q = Jg + f/s + sum J/(1 + s l); Q = Ge + sum g - sum g/(1 + s t)."""
    exact = [(mpf(J), mpf(l)) for J, l in modes]
    below = product([l for _, l in exact])
    above = [mpf(glassy) * c for c in below]
    for k, (J, _) in enumerate(exact):
        above = add(above, [J * c for c in product([other for j, (_, other) in enumerate(exact) if j != k])])
    if 0 < fluidity:
        above = add([c for c in above] + [mpf(0)], [mpf(fluidity) * c for c in below])
    slope = derivative(above)
    found = []
    for r in real_roots(above):
        c = value(below, r) * (r if 0 < fluidity else 1) / value(slope, r)
        found.append((c / r, -1 / r))
    found.sort(key=lambda mode: mode[1])
    resting = 0 if 0 < fluidity else 1 / (mpf(glassy) + sum(J for J, _ in exact))
    for s in [mpf("0.37"), mpf(2), mpf("1e-3"), mpf(1000), mpf("17.5")]:
        q = resting + sum(g * s * t / (1 + s * t) for g, t in found)
        j = mpf(glassy) + mpf(fluidity) / s + sum(J / (1 + s * l) for J, l in exact)
        assert abs(q * j - 1) < mpf(10) ** -60
    return {
        "name": name,
        "compliances": [J for J, _ in modes],
        "retardation_times": [l for _, l in modes],
        "glassy_compliance": glassy,
        "fluidity": fluidity,
        "moduli": [nstr(g, 30) for g, _ in found],
        "relaxation_times": [nstr(t, 30) for _, t in found],
        "equilibrium_modulus": nstr(mpf(resting), 30),
        "reverse": True,
    }


random.seed(20)
cases = [
    case("three decades", [(1e5, 0.01), (3e4, 0.3), (1e3, 20.0)], 0.0),
    case("a solid", [(1.0, 1.0), (0.5, 4.0)], 0.25),
    case("stiff rest", [(1e-6, 1.0), (1e-3, 4.0)], 1.0),
    case("soft rest", [(1.0, 1.0), (3.0, 2.0)], 1e-9),
    case("near times", [(1.0, 1.0), (1.0, 1.0 + 2.0**-20), (2.0, 3.0)], 0.0),
    case("nearer times", [(1.0, 1.0), (1.0, 1.0 + 2.0**-40), (2.0, 3.0)], 0.5),
    case("a weak mode", [(1.0, 0.5), (1e-10, 1.0), (1.0, 2.0)], 0.0),
    case("eighteen decades", [(1e9, 1e-9), (1e6, 1e-3), (10.0, 1e4), (0.1, 1e9)], 0.0),
    case("even moduli", [(1.0, 10.0 ** (0.5 * k - 3)) for k in range(12)], 0.0),
]
for k in range(16):
    count = random.randint(2, 10)
    modes, log_time = [], -3.0
    for _ in range(count):
        log_time += random.uniform(0.05, 1.0)
        modes.append((10.0 ** random.uniform(-3, 3), 10.0**log_time))
    cases.append(case(f"random {k}", modes, 0.0 if k % 2 else 10.0 ** random.uniform(-3, 2)))

cases += [
    reverse("creep of a liquid", [(1e-5, 0.1), (3e-5, 4.0)], 1e-6, 1e-6),
    reverse("creep of a solid", [(1.0, 1.0), (0.5, 4.0)], 0.25, 0.0),
    reverse("hardly glassy", [(1.0, 1.0), (0.5, 4.0)], 1e-9, 0.5),
    reverse("hardly flowing", [(1.0, 1.0), (0.5, 4.0)], 0.5, 1e-12),
    reverse("near retardation times", [(1.0, 1.0), (1.0, 1.0 + 2.0**-30), (2.0, 3.0)], 0.5, 0.25),
    reverse("a weak retardation mode", [(1.0, 0.5), (1e-10, 1.0), (1.0, 2.0)], 0.5, 0.25),
]
for k in range(10):
    modes, log_time = [], -3.0
    for _ in range(random.randint(1, 9)):
        log_time += random.uniform(0.05, 1.0)
        modes.append((10.0 ** random.uniform(-3, 3), 10.0**log_time))
    cases.append(reverse(f"random creep {k}", modes, 10.0 ** random.uniform(-4, 1), 10.0 ** random.uniform(-4, 1) if k % 2 else 0.0))

json.dump(
    {
        "meta": {
            "what": "discrete relaxation spectra with their retardation spectra and creep",
            "source_equations": {"creep": "s J(s) = 1/(s G(s)): B. Gross, Mathematical Structure of the Theories of Viscoelasticity, 1953"},
            "generator": "testdata/scripts/retardation.py (mpmath, polynomial roots with 160 digits)",
            "digits": 30,
            "verified_by": "s J(s) s G(s) = 1 at five s to 60 digits",
        },
        "cases": cases,
    },
    sys.stdout,
    indent=1,
)
print()
