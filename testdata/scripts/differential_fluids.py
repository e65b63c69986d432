"""Writes testdata/golden/differential_fluids.json: Giesekus' fluid and the networks of Phan-Thien and Tanner in shear.

The steady states solve the equations of the fluid, not a closed form of them. The start of a flow is integrated by Taylor series.
Nothing of Piola is used. Inputs are exact doubles.

    python3 testdata/scripts/differential_fluids.py > testdata/golden/differential_fluids.json

Direction 1 = gradient, 2 = flow, L21 = k. In units of eta_p/lambda and lambda the polymer's stress s obeys, with x = lambda k,

    s11' = -y11          s22' = 2 x s12 - y22          s12' = x (1 + s11) - y12          s33 = 0
    Giesekus  y = s + alpha s^2          linear  y = (1 + epsilon tr s) s          exponential  y = exp(epsilon tr s) s
"""

import json
import sys

from mpmath import exp, ln, mp, mpf, nstr, sqrt

mp.dps = 60
SOLVENT, POLYMER, TIME = mpf(0.125), mpf(2), mpf(0.5)
RATES = [1e-6, 1e-3, 0.7, 40.0, 1e4, 1e8]
FLUIDS = [("giesekus", 0.1), ("giesekus", 0.3), ("giesekus", 0.5), ("linear", 0.25), ("exponential", 0.25)]
STARTED = [("giesekus", 0.3), ("giesekus", 0.5), ("linear", 0.25), ("exponential", 0.25)]


def relaxing(name, parameter, s):
    """y11, y22, y12 of s11, s22, s12."""
    s11, s22, s12 = s
    if name == "giesekus":
        return [s11 + parameter * (s11**2 + s12**2), s22 + parameter * (s22**2 + s12**2), s12 + parameter * s12 * (s11 + s22)]
    trace = parameter * (s11 + s22)
    factor = 1 + trace if name == "linear" else exp(trace)
    return [factor * x for x in s]


def rates(name, parameter, x, s):
    y = relaxing(name, parameter, s)
    return [-y[0], 2 * x * s[2] - y[1], x * (1 + s[0]) - y[2]]


def bisect(f, low, high):
    """The root of an increasing function."""
    for _ in range(int(mp.dps * 4)):
        middle = (low + high) / 2
        low, high = (middle, high) if f(middle) < 0 else (low, middle)
    return (low + high) / 2


def steady(name, parameter, x):
    """s11, s22, s12 at rest of the equations above."""
    if name == "giesekus":
        # m = -s11 in (0, 1): s12 from the first equation, s22 from the last, and the second is the equation of ln m.
        def state(m):
            s12 = sqrt(m * (1 - parameter * m) / parameter)
            return [-m, (x * (1 - m) / s12 - 1) / parameter + m, s12]
        def residual(u):
            s = state(exp(u))
            # A flow stretches the polymer along itself: 0 < s22.
            return 1 if s[1] < 0 else rates(name, parameter, x, s)[1]
        root = bisect(residual, ln(mpf(10) ** -40), mpf(0))
        return state(exp(root))
    # s11 = 0: f s12 = x, f s22 = 2 x s12, and f is 1 + epsilon s22 or exp(epsilon s22).
    def state(f):
        return [mpf(0), 2 * x**2 / f**2, x / f]
    factor = (lambda t: 1 + t) if name == "linear" else exp
    root = bisect(lambda u: exp(u) - factor(parameter * state(exp(u))[1]), mpf(0), ln(1 + 2 * parameter * x**2) + 1)
    return state(exp(root))


def product(a, b, n):
    return sum(a[k] * b[n - k] for k in range(n + 1))


def taylor(name, parameter, x, start, order):
    """Coefficients of s11, s22, s12 about `start`, and of the factor of an exponential network."""
    s = [[value] for value in start]
    factor = [exp(parameter * (start[0] + start[1]))]
    for n in range(order):
        a, b, c = s
        if name == "giesekus":
            y = [a[n] + parameter * (product(a, a, n) + product(c, c, n)), b[n] + parameter * (product(b, b, n) + product(c, c, n)),
                 c[n] + parameter * (product(c, a, n) + product(c, b, n))]
        elif name == "linear":
            trace = [1 * (k == 0) + parameter * (p + q) for k, (p, q) in enumerate(zip(a, b))]
            y = [product(trace, part, n) for part in s]
        else:
            y = [product(factor, part, n) for part in s]
        slopes = [-y[0], 2 * x * c[n] - y[1], x * (a[n] + (1 if n == 0 else 0)) - y[2]]
        for part, slope in zip(s, slopes):
            part.append(slope / (n + 1))
        # (n + 1) f_(n+1) = sum (k + 1) g_(k+1) f_(n-k) of f = exp g, g = epsilon (s11 + s22).
        power = sum((k + 1) * parameter * (s[0][k + 1] + s[1][k + 1]) * factor[n - k] for k in range(n + 1))
        factor.append(power / (n + 1))
    return s


def follow(name, parameter, x, start, span, step, order):
    """s at the end of a span, in steps of `step` or less."""
    count = int(span / step) + 1
    h = span / count
    state = start
    for _ in range(count):
        series = taylor(name, parameter, x, state, order)
        state = [sum(c * h**n for n, c in enumerate(part)) for part in series]
    return state


def stresses(s, rate):
    """T12, N1 = T22 - T11, N2 = T11 - T33 with the solvent."""
    s11, s22, s12 = [POLYMER / TIME * value for value in s]
    return {"T12": number(s12 + SOLVENT * rate), "N1": number(s22 - s11), "N2": number(s11)}


def number(x):
    return nstr(x, 30, strip_zeros=True)


def agree(what, a, b, bound):
    worst = max(abs(p - q) / (abs(q) if q else 1) for p, q in zip(a, b))
    if worst > bound:
        sys.exit(f"{what}: {nstr(worst, 5)}")
    return worst


def main():
    cases, worst = [], mpf(0)
    for name, parameter in FLUIDS:
        for k in RATES:
            x = TIME * mpf(k)
            s = steady(name, mpf(parameter), x)
            scale = [abs(2 * x * s[2]) + abs(s[1]), x, x]
            left = [abs(r) / q for r, q in zip(rates(name, mpf(parameter), x, s), scale)]
            if max(left) > mpf(10) ** -35:
                sys.exit(f"{name} at {k}: {left}")
            cases.append({"id": f"{name}_{parameter}/steady_{k:g}", "kind": "steady", "fluid": name, "parameter": parameter,
                          "input": {"k": k}, "output": stresses(s, mpf(k))})
    for name, parameter in STARTED:
        # A weak and a strong flow; the strong one overshoots.
        for k in [0.75, 12.0]:
            x, rest = TIME * mpf(k), [mpf(0)] * 3
            for t in [0.0625, 0.25, 0.75, 3.0]:
                span = mpf(t) / TIME
                s = follow(name, mpf(parameter), x, rest, span, mpf(1) / 32, 40)
                again = follow(name, mpf(parameter), x, rest, span, mpf(1) / 50, 36)
                worst = max(worst, agree(f"{name} after {t}", again, s, mpf(10) ** -32))
                cases.append({"id": f"{name}_{parameter}/start_{k:g}_{t:g}", "kind": "start", "fluid": name, "parameter": parameter,
                              "input": {"k": k, "t": t}, "output": stresses(s, mpf(k))})
            for t in [0.0625, 0.75]:
                # After the flow stops nothing of the solvent is left.
                s = follow(name, mpf(parameter), mpf(0), steady(name, mpf(parameter), x), mpf(t) / TIME, mpf(1) / 32, 40)
                cases.append({"id": f"{name}_{parameter}/stop_{k:g}_{t:g}", "kind": "stop", "fluid": name, "parameter": parameter,
                              "input": {"k": k, "t": t}, "output": stresses(s, mpf(0))})
    meta = {
        "what": "Giesekus' fluid and the networks of Phan-Thien and Tanner in steady shear, after its start and after its stop",
        "source_equations": {
            "all": "tau + lambda (tau' - L tau - tau L^T) + y = 2 eta_p D with y below in place of tau, T = tau + 2 eta_s D; L21 = k",
            "giesekus": "y = tau + alpha lambda/eta_p tau^2",
            "linear": "y = (1 + epsilon lambda/eta_p tr tau) tau",
            "exponential": "y = exp(epsilon lambda/eta_p tr tau) tau",
            "T12, N1, N2": "N1 = T22 - T11, N2 = T11 - T33; 1 = gradient, 2 = flow",
        },
        "parameters": {"eta_s": 0.125, "eta_p": 2.0, "lambda": 0.5},
        "generator": "testdata/scripts/differential_fluids.py (mpmath, 60 digits)",
        "digits": 30,
        "verified_by": "steady states by their equation's residual; starts by Taylor series of another order and step, worst relative "
                       "difference " + nstr(worst, 3),
    }
    lines = ",\n  ".join(json.dumps(case) for case in cases)
    print('{\n "meta": %s,\n "cases": [\n  %s\n ]\n}' % (json.dumps(meta, indent=1).replace("\n", "\n "), lines))


main()
