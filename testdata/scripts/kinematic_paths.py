"""Writes testdata/golden/kinematic_paths.json: J2 plasticity with kinematic hardening of Armstrong and Frederick at finite strain.

The differential equations of F_i, F_k and the accumulated strain are integrated at 50 digits, as inelastic_paths.py does, in two numbers of
parts that must agree. Without viscosity the speed of the flow is that which keeps the stress on the yield surface; its derivatives are
central differences over 1e-17, exact to some 33 digits. Legs end where the body begins to yield, so that each is elastic or flows all the
way; those of `kinematic_crossing` do not end there, so that each is elastic first and then flows. Nothing of Piola is used. Inputs are exact doubles.

    python3 testdata/scripts/kinematic_paths.py > testdata/golden/kinematic_paths.json
"""

import json
import sys

from inelastic_paths import (F0, Hencky, NeoHookean, dev, flat, floats, integrate, inv, norm, numbers, of, path, rows, sqrt)
from mpmath import exp, mp, mpf, nstr

mp.dps = 50

ELASTIC, BACK = Hencky(3.0, 2.0), NeoHookean(0.25, 0.5)
SIGMA0, LINEAR, SATURATION, DELTA, BETA = mpf("0.25"), mpf("0.125"), mpf("0.5"), mpf(4), mpf("1.5")
PARTS = 24
STEP = mpf(10) ** -17

LOADED = rows([[1.5, 0.75, 0.0], [0.0, 0.75, 0.25], [0.125, 0.0, 1.0]])
BACKWARD = rows([[0.9375, -0.5, 0.0625], [0.125, 1.125, 0.0], [0.0, 0.1875, 0.9375]])


def hardened(strain):
    return SIGMA0 + LINEAR * strain + (SATURATION - SIGMA0) * (1 - exp(-DELTA * strain))


def drive(f, f_i, f_k):
    """dev(M - chi) and dev M of the spring of the back stress."""
    hat = f_i * inv(f_k)
    chi = BACK.first_piola(hat) * hat.T
    return dev(ELASTIC.mandel(f * inv(f_i)) - chi), dev(BACK.mandel(hat))


def excess(f, y):
    """The stress beyond the yield stress."""
    s, _ = drive(f, of(y), of(y[10:]))
    return sqrt(mpf(3) / 2) * norm(s) - hardened(y[9])


def direction(f, y):
    """Rates of the state for a unit rate of the accumulated strain."""
    f_i, f_k = of(y), of(y[10:])
    s, back = drive(f, f_i, f_k)
    sigma = sqrt(mpf(3) / 2) * norm(s)
    return flat(s * (mpf(3) / 2 / sigma) * f_i) + [mpf(1)] + flat(back * BETA * f_k)


def moved(y, rates, h):
    return [a + h * b for a, b in zip(y, rates)]


def flowing(y, start, end, duration, viscosity, parts):
    """The state after a leg that flows all the way."""
    f_rate = (end - start) / mpf(duration)

    def rate(t, y):
        f = path(start, end, t, mpf(duration))
        rates = direction(f, y)
        if viscosity > 0:
            speed = excess(f, y) / viscosity
        else:
            loading = (excess(f + f_rate * STEP, y) - excess(f - f_rate * STEP, y)) / (2 * STEP)
            softening = (excess(f, moved(y, rates, STEP)) - excess(f, moved(y, rates, -STEP))) / (2 * STEP)
            speed = -loading / softening
        assert speed > 0, "a leg that flows must flow all the way"
        return [speed * x for x in rates]

    return integrate(rate, y, duration, parts, 12)


def to_yield(y, start, end):
    """The last share of a leg from which on the body flows; none where it flows from the start."""
    share = lambda s: excess(path(start, end, mpf(s), mpf(1)), y)
    below = [s for s in (mpf(k) / 64 for k in range(65)) if share(s) < 0]
    if not below:
        return None
    low, high = below[-1], below[-1] + mpf(1) / 64
    for _ in range(150):
        middle = (low + high) / 2
        low, high = (middle, high) if share(middle) < 0 else (low, middle)
    return high


def legs(name, start, turns, viscosity, parts):
    """Legs of a law through the turns, from the body as it was made."""
    y, cases = flat(rows(F0.tolist())) + [mpf(0)] + flat(rows(F0.tolist())), []
    for end in turns:
        before = start
        yields, begin = to_yield(y, start, end), start
        if yields is not None:
            begin = path(start, end, yields, mpf(1))
        if yields is not None and not name.endswith("crossing"):
            # In doubles, as the inputs are.
            start = begin = rows(floats(begin))
            cases.append((name, before, start, mpf("0.5"), list(y)))
        y = flowing(y, begin, end, mpf("0.5"), viscosity, parts)
        cases.append((name, start, end, mpf("0.5"), list(y)))
        start = end
    return cases


def main():
    cases, worst = [], mpf(0)
    beyond = rows([[1.25, 0.25, 0.0], [0.0, 0.875, 0.125], [0.0625, 0.0, 1.0]])
    for name, start, turns, viscosity in [
        ("kinematic", rows(F0.tolist()), [LOADED, BACKWARD], mpf(0)),
        ("kinematic_viscous", beyond, [LOADED], mpf("0.5")),
        ("kinematic_crossing", rows(F0.tolist()), [LOADED, BACKWARD], mpf(0)),
    ]:
        found, again = (legs(name, start, turns, viscosity, parts) for parts in (PARTS, 4 * PARTS // 3))
        for number, ((_, begin, end, duration, y), (*_, z)) in enumerate(zip(found, again)):
            difference = max(abs(a - b) for a, b in zip(y, z))
            print(name, number, nstr(difference, 3), file=sys.stderr)
            worst = max(worst, difference)
            f_i = inv(of(y))
            p = ELASTIC.first_piola(end * f_i) * f_i.T
            cases.append({"id": f"{name}/{number}", "law": name, "params": {"viscosity": float(viscosity)},
                          "input": {"from": floats(begin), "to": floats(end), "duration": float(duration)},
                          "output": {"state": numbers(y), "P": numbers(flat(p))}})
    meta = {
        "what": "first Piola stresses and internal variables (F_i, a, F_k) of J2 plasticity with kinematic hardening, F changing in proportion to time",
        "source_equations": {
            "flow": "D_i = da 3/2 dev(M - chi)/sigma, sigma = sqrt(3/2) |dev(M - chi)|, chi = tau of the spring at F_i F_k^-1",
            "recovery": "D_k = da recovery dev of Mandel's stress of the spring at F_i F_k^-1",
            "speed": "da = (sigma - sigma(a))/viscosity; without viscosity that which keeps sigma = sigma(a)",
            "hardening": "sigma(a) = yield_stress + linear a + (saturation - yield_stress) (1 - exp(-saturation_exponent a))",
            "elastic": Hencky.__doc__,
            "spring": NeoHookean.__doc__,
        },
        "params": {"elastic": {"lambda": 3.0, "mu": 2.0}, "spring": {"mu": 0.25, "lambda": 0.5}, "yield_stress": 0.25, "linear": 0.125,
                   "saturation": 0.5, "saturation_exponent": 4.0, "recovery": 1.5},
        "generator": "testdata/scripts/kinematic_paths.py (mpmath, 50 digits)",
        "digits": 30,
        "verified_by": "integration in a third more parts, largest difference " + nstr(worst, 3),
    }
    lines = ",\n  ".join(json.dumps(case) for case in cases)
    print('{\n "meta": %s,\n "cases": [\n  %s\n ]\n}' % (json.dumps(meta, indent=1).replace("\n", "\n "), lines))


if __name__ == "__main__":
    main()
