"""Writes testdata/golden/shear_functions.json: shear stresses of nine fluids and moments of their shear rate.

Formulas are those of the literature, evaluated by mpmath at 50 digits; nothing of Piola is used. Inputs are exact doubles.

    python3 testdata/scripts/shear_functions.py > testdata/golden/shear_functions.json
"""

import json

from mpmath import asinh, exp, expm1, findroot, ln, mp, mpf, quad, sinh, sqrt

mp.dps = 50

# Parameters, in the order of the constructors.
FLUIDS = {
    "bingham": [0.5, 0.75],
    "herschel": [0.5, 0.75, 0.4],
    "casson": [0.5, 0.75],
    "carreau": [2.0, 0.0625, 1.5, 0.25, 0.75],
    "cross": [2.0, 0.125, 1.5, 0.75],
    "ellis": [2.0, 1.5, 2.5],
    "eyring": [0.75, 1.5],
    "sisko": [0.5, 3.0, 0.375],
    "papanastasiou": [0.5, 0.75, 0.5, 4.0],
}
RATES = [1e-8, 0.001, 0.5, 30.0, 1e8]
NARROW = 2.0**-20


def rate(name, s):
    """The shear rate at the stress s, where it is explicit."""
    p = [mpf(x) for x in FLUIDS[name]]
    if name == "bingham":
        return max(s - p[0], mpf(0)) / p[1]
    if name == "herschel":
        return (max(s - p[0], mpf(0)) / p[1]) ** (1 / p[2])
    if name == "casson":
        return max(sqrt(s) - sqrt(p[0]), mpf(0)) ** 2 / p[1]
    if name == "ellis":
        return s / p[0] * (1 + (s / p[1]) ** (p[2] - 1))
    if name == "eyring":
        return sinh(s / p[0]) / p[1]
    raise KeyError(name)


def stress(name, k):
    """The shear stress at the rate k."""
    p, k = [mpf(x) for x in FLUIDS[name]], mpf(k)
    if name == "bingham":
        return p[0] + p[1] * k
    if name == "herschel":
        return p[0] + p[1] * k ** p[2]
    if name == "casson":
        return (sqrt(p[0]) + sqrt(p[1] * k)) ** 2
    if name == "carreau":
        return (p[1] + (p[0] - p[1]) * (1 + (p[2] * k) ** p[4]) ** ((p[3] - 1) / p[4])) * k
    if name == "cross":
        return (p[1] + (p[0] - p[1]) / (1 + (p[2] * k) ** p[3])) * k
    if name == "eyring":
        return p[0] * asinh(p[1] * k)
    if name == "sisko":
        return p[0] * k + p[1] * k ** p[2]
    if name == "papanastasiou":
        return p[1] * k ** p[2] - p[0] * expm1(-p[3] * k)
    # Ellis: ln k is a function of ln tau of a slope between 1 and alpha.
    slow, fast = p[0] * k, p[1] * (p[0] * k / p[1]) ** (1 / p[2])
    below = ln(min(slow, fast))
    return exp(findroot(lambda x: ln(rate(name, exp(x)) / k), [below - 1, below], solver="anderson"))


def moment(name, power, low, high):
    """The integral of s^power times the shear rate over stresses from low to high, by tanh-sinh quadrature."""
    low, high = mpf(low), mpf(high)
    if name == "sisko":
        # In the rate: s = tau(k), ds = tau'(k) dk.
        p = [mpf(x) for x in FLUIDS[name]]
        bracket = [ln(mpf(1e-6)), ln(mpf(1e3))]
        ends = [exp(findroot(lambda x: ln(stress(name, exp(x)) / s), bracket, solver="anderson")) for s in (low, high)]
        slope = lambda k: p[0] + p[1] * p[2] * k ** (p[2] - 1)
        return quad(lambda k: stress(name, k) ** power * k * slope(k), ends)
    breaks = [low]
    while breaks[-1] * 8 < high and 0 < breaks[-1]:
        breaks.append(breaks[-1] * 8)
    return quad(lambda s: s**power * rate(name, s), breaks + [high])


def number(x):
    return float(x)


def main():
    cases = []
    for name in ["carreau", "cross", "sisko", "eyring", "papanastasiou", "casson", "herschel", "bingham", "ellis"]:
        for k in RATES:
            cases.append({"kind": "shear_stress", "fluid": name, "k": k, "tau": number(stress(name, k))})
    plastic = [(0.5, 0.5 + NARROW / 2), (0.5, 4.0), (1.0, 1.0 + NARROW), (0.75, 1e4)]
    liquid = [(0.0, 4.0), (1.0, 1.0 + NARROW), (NARROW, 2.0**-10), (1.0, 6.0)]
    intervals = {name: plastic for name in ["casson", "herschel", "bingham"]} | {name: liquid for name in ["ellis", "eyring"]}
    for name, pairs in (intervals | {"sisko": [(1.0, 20.0)]}).items():
        for power in (range(-1, 3) if name != "sisko" else range(3)):
            for low, high in pairs:
                # The reciprocal moment from rest is not the one that flows ask for.
                low = NARROW if power < 0 and low == 0.0 else low
                value = number(moment(name, power, low, high))
                cases.append({"kind": "moment", "fluid": name, "power": power, "from": low, "to": high, "integral": value})
    meta = {
        "what": "shear stresses of fluids and moments of their shear rate, integrals of s^p zeta(s) ds over shear stresses",
        "source_equations": {
            "bingham": "tau = tau_y + mu k; parameters tau_y, mu",
            "herschel": "tau = tau_y + K k^n; parameters tau_y, K, n",
            "casson": "sqrt tau = sqrt tau_y + sqrt(mu k); parameters tau_y, mu",
            "carreau": "tau/k = eta_inf + (eta_0 - eta_inf)(1 + (lambda k)^a)^((n-1)/a); parameters eta_0, eta_inf, lambda, n, a",
            "cross": "tau/k = eta_inf + (eta_0 - eta_inf)/(1 + (lambda k)^m); parameters eta_0, eta_inf, lambda, m",
            "ellis": "k = (tau/eta_0)(1 + (tau/tau_half)^(alpha-1)); parameters eta_0, tau_half, alpha",
            "eyring": "tau = tau_0 arsinh(lambda k); parameters tau_0, lambda",
            "sisko": "tau = eta_inf k + K k^n; parameters eta_inf, K, n",
            "papanastasiou": "tau = K k^n + tau_y (1 - exp(-m k)); parameters tau_y, K, n, m",
        },
        "parameters": FLUIDS,
        "generator": "testdata/scripts/shear_functions.py (mpmath, 50 digits)",
        "digits": 17,
        "verified_by": "moments by tanh-sinh quadrature of the explicit rate, Sisko's in the rate; Ellis' stress by a root of the explicit rate",
    }
    lines = ",\n  ".join(json.dumps(case) for case in cases)
    print('{\n "meta": %s,\n "cases": [\n  %s\n ]\n}' % (json.dumps(meta, indent=1).replace("\n", "\n "), lines))


main()
