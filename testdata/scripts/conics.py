"""Writes testdata/golden/conics.json: motion about a fixed centre on every conic, by the classical anomalies.

Ellipses by Kepler's equation in the eccentric anomaly, hyperbolas in the hyperbolic one, parabolas by Barker's cubic, straight
lines by the same equations at eccentricity one; mpmath at 60 digits, nothing of Piola is used. Each end is checked: the
energy, the angular momentum and Laplace's vector are those of the start. Inputs are exact doubles.

    python3 testdata/scripts/conics.py > testdata/golden/conics.json
"""

import json

from mpmath import cos, cosh, mp, mpf, sin, sinh, sqrt

mp.dps = 60

# Name, mu, position, velocity, times.
CASES = [
    ("circle", 1.0, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.125, 1.0, -3.0, 20.0]),
    ("ellipse e = 0.75", 2.0, [0.5, 0.0, 0.25], [0.25, 2.25, 0.5], [0.03125, 0.5, -0.5, 5.0]),
    ("from the apocentre, e = 0.96", 1.0, [0.0, 2.0, 0.0], [-0.125, 0.0, 0.0625], [1.0, 3.0, 4.0, -7.0]),
    ("long ellipse, e = 0.9999", 1.0, [1.0, 0.0, 0.0], [0.0, 0.0078125, 0.0], [0.5, 1.0, 1.1107, 2.0]),
    ("almost a parabola, bound", 1.0, [0.5, 0.0, 0.0], [0.0, 1.9999999999, 0.0], [0.25, 10.0, -1000.0]),
    ("almost a parabola, free", 1.0, [0.5, 0.0, 0.0], [0.0, 2.0000000001, 0.0], [0.25, 10.0, -1000.0]),
    ("parabola", 1.0, [0.5, 0.0, 0.0], [0.0, 2.0, 0.0], [0.25, 10.0, -1000.0]),
    ("parabola, coming in", 2.0, [0.0, 0.0, 4.0], [0.5, 0.5, -0.7071067811865475], [1.0, 8.0, -100.0]),
    ("hyperbola e = 1.5", 1.0, [1.0, 0.0, 0.0], [0.5, 1.5, 0.25], [0.125, 2.0, -30.0]),
    ("hyperbola, coming in", 1.0, [100.0, 3.0, 0.0], [-2.0, 0.0, 0.0], [10.0, 49.0, 120.0]),
    ("fast fly-by", 1.0, [1.0, 0.0, 0.0], [0.0, 16.0, 0.0], [0.0625, 1.0, -100.0]),
    ("straight fall", 1.0, [1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.25, 1.0, 1.125]),
    ("straight up, free", 1.0, [0.0, 0.5, 0.0], [0.0, 3.0, 0.0], [0.125, 4.0, 100.0]),
    ("no centre", 0.0, [1.0, 2.0, 3.0], [0.5, -0.25, 1.0], [1.0, -8.0]),
]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def monotone_root(f, slope, low, high):
    """Newton between bounds."""
    x = (low + high) / 2
    for _ in range(2000):
        value = f(x)
        low, high = (x, high) if value < 0 else (low, x)
        trial = x - value / slope(x) if slope(x) != 0 else low - 1
        trial = trial if low < trial < high else (low + high) / 2
        if abs(trial - x) <= mpf(10) ** (-mp.dps + 8) * max(abs(x), mpf(10) ** -20):
            return trial
        x = trial
    raise ValueError("no root")


def advance(mu, x, v, t):
    if mu == 0:
        return [a + t * b for a, b in zip(x, v)], list(v)
    r, rv, speed = sqrt(dot(x, x)), dot(x, v), dot(v, v)
    alpha = 2 / r - speed / mu  # 1/a
    if abs(alpha) < mpf(10) ** -40:
        # Barker's cubic from any place: sqrt(mu) t = r s + sigma s^2/2 + s^3/6.
        sigma = rv / sqrt(mu)
        s = monotone_root(lambda s: r * s + sigma * s * s / 2 + s**3 / 6 - sqrt(mu) * t, lambda s: r + sigma * s + s * s / 2,
                          -mpf(10) ** 6, mpf(10) ** 6)
        g1, g2, g3 = s / sqrt(mu), s * s / (2 * mu), s**3 / (6 * mu * sqrt(mu))
    elif 0 < alpha:
        a = 1 / alpha
        n = sqrt(mu / a**3)
        ec, es = 1 - r / a, rv / sqrt(mu * a)
        # Change of the eccentric anomaly: n t = y - ec sin y + es (1 - cos y).
        y = monotone_root(lambda y: y - ec * sin(y) + es * (1 - cos(y)) - n * t, lambda y: 1 - ec * cos(y) + es * sin(y),
                          n * t - 3, n * t + 3)
        g1, g2, g3 = sin(y) * sqrt(a / mu), (1 - cos(y)) * a / mu, (y - sin(y)) / n / mu
    else:
        a = -1 / alpha
        n = sqrt(mu / a**3)
        ec, es = 1 + r / a, rv / sqrt(mu * a)
        y = monotone_root(lambda y: ec * sinh(y) + es * (cosh(y) - 1) - y - n * t,
                          lambda y: ec * cosh(y) + es * sinh(y) - 1, mpf(-60), mpf(60))
        g1, g2, g3 = sinh(y) * sqrt(a / mu), (cosh(y) - 1) * a / mu, (sinh(y) - y) / n / mu
    now = r * (1 - mu * alpha * g2) + rv * g1 + mu * g2
    f, g = 1 - mu * g2 / r, t - mu * g3
    df, dg = -mu * g1 / (r * now), 1 - mu * g2 / now
    end = [f * a + g * b for a, b in zip(x, v)], [df * a + dg * b for a, b in zip(x, v)]
    check(mu, (x, v), end)
    return end


def invariants(mu, x, v):
    h = cross(x, v)
    r = sqrt(dot(x, x))
    laplace = [a - mu * b / r for a, b in zip(cross(v, h), x)]
    return [dot(v, v) / 2 - mu / r, *h, *laplace]


def check(mu, start, end):
    before, after = invariants(mu, *start), invariants(mu, *end)
    size = mu / sqrt(dot(end[0], end[0])) + mu / sqrt(dot(start[0], start[0])) + 1
    assert all(abs(a - b) < mpf(10) ** -40 * size for a, b in zip(before, after)), (before, after)


def main():
    cases = []
    for name, mu, x, v, times in CASES:
        states = []
        for t in times:
            state = advance(mpf(mu), [mpf(c) for c in x], [mpf(c) for c in v], mpf(t))
            states.append({"t": t, "state": [mp.nstr(c, 34) for part in state for c in part]})
        cases.append({"name": name, "mu": mu, "position": x, "velocity": v, "states": states})
    meta = {
        "what": "position and velocity of a body about a fixed centre after a time",
        "source_equations": "Kepler's equation in the eccentric and the hyperbolic anomaly, Barker's cubic",
        "generator": "testdata/scripts/conics.py, mpmath",
        "digits": 34,
        "verified_by": "energy, angular momentum and Laplace's vector of start and end agree to 40 digits",
    }
    print(json.dumps({"meta": meta, "cases": cases}, indent=1))


main()
