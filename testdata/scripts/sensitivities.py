"""Writes testdata/golden/sensitivities.json: derivatives of the end of a motion by its start and by parameters.

Two problems, with starts, parameters and times that are exact in double precision:

    Kepler           q'' = -mu q/|q|^3 in the plane, p = (mu)
    Lotka-Volterra   x' = a x - b x y, y' = d x y - c y, p = (a, b, c, d)

The motion of Kepler is a closed form, differentiated by central differences in 90 digits with increments of 1e-28: an error below
1e-50. The variational equations of Lotka and Volterra are integrated by mpmath's Taylor series in 45 digits. Each is checked to 18
digits by the other way: Kepler by its variational equations, Lotka-Volterra by central differences of motions.
Nothing of Piola is used.

    pip install mpmath
    python3 testdata/scripts/sensitivities.py > testdata/golden/sensitivities.json
"""

import json

from mpmath import cos, findroot, mp, mpf, nstr, odefun, sin, sqrt

KEPLER_START = ["0.75", "0.25", "-0.5", "1.125"]
KEPLER_PARAMETERS = ["1.0625"]
KEPLER_TIME = 12
LOTKA_START = ["1", "0.5"]
LOTKA_PARAMETERS = ["1.5", "1", "3", "1.25"]
LOTKA_TIME = 5


def kepler_end(start, parameters):
    """The closed form, by the difference of the eccentric anomalies."""
    (q1, q2, v1, v2), (mu,), t = start, parameters, mpf(KEPLER_TIME)
    r = sqrt(q1 * q1 + q2 * q2)
    a = 1 / (2 / r - (v1 * v1 + v2 * v2) / mu)
    n = sqrt(mu / a**3)
    sigma = (q1 * v1 + q2 * v2) / sqrt(mu * a)
    c = 1 - r / a
    x = findroot(lambda x: x - c * sin(x) + sigma * (1 - cos(x)) - n * t, n * t, tol=mpf(10) ** (-2 * mp.dps + 20))
    end_r = a * (1 - c * cos(x) + sigma * sin(x))
    f, g = 1 - a / r * (1 - cos(x)), t + (sin(x) - x) / n
    fd, gd = -sqrt(mu * a) / (r * end_r) * sin(x), 1 - a / end_r * (1 - cos(x))
    return [f * q1 + g * v1, f * q2 + g * v2, fd * q1 + gd * v1, fd * q2 + gd * v2]


def kepler_rate(y, p):
    """The rate with its derivatives by y and p."""
    q1, q2, v1, v2 = y
    r2 = q1 * q1 + q2 * q2
    i3 = r2 ** (-mpf(3) / 2)
    i5 = i3 / r2
    mu = p[0]
    rate = [v1, v2, -mu * q1 * i3, -mu * q2 * i3]
    by_y = [
        [0, 0, 1, 0],
        [0, 0, 0, 1],
        [mu * (3 * q1 * q1 * i5 - i3), 3 * mu * q1 * q2 * i5, 0, 0],
        [3 * mu * q1 * q2 * i5, mu * (3 * q2 * q2 * i5 - i3), 0, 0],
    ]
    return rate, by_y, [[0], [0], [-q1 * i3], [-q2 * i3]]


def lotka_rate(y, parameters):
    (u, w), (a, b, c, d) = y, parameters
    rate = [a * u - b * u * w, d * u * w - c * w]
    by_y = [[a - b * w, -b * u], [d * w, d * u - c]]
    return rate, by_y, [[u, -u * w, 0, 0], [0, 0, -w, u * w]]


def variational(rate, start, parameters, t):
    """End, derivatives by the start, derivatives by the parameters."""
    n, m = len(start), len(parameters)
    columns = n + m

    def equations(_t, z):
        f, by_y, by_p = rate(z[:n], parameters)
        out = list(f)
        for i in range(n):
            for j in range(columns):
                total = sum(by_y[i][k] * z[n + k * columns + j] for k in range(n))
                out.append(total + (by_p[i][j - n] if n <= j else 0))
        return out

    seeds = [mpf(1 if i == j else 0) for i in range(n) for j in range(columns)]
    z = odefun(equations, mpf(0), list(start) + seeds)(mpf(t))
    rows = [[z[n + i * columns + j] for j in range(columns)] for i in range(n)]
    return list(z[:n]), [row[:n] for row in rows], [row[n:] for row in rows]


def differences(end, start, parameters, increment):
    inputs, n = list(start) + list(parameters), len(start)
    columns = []
    for j in range(len(inputs)):
        up, down = list(inputs), list(inputs)
        up[j] += increment
        down[j] -= increment
        high, low = end(up[:n], up[n:]), end(down[:n], down[n:])
        columns.append([(a - b) / (2 * increment) for a, b in zip(high, low)])
    rows = [[column[i] for column in columns] for i in range(n)]
    return [row[:n] for row in rows], [row[n:] for row in rows]


def agree(one, other, tolerance):
    for a, b in zip(one, other):
        for x, y in zip(a, b):
            assert abs(x - y) <= tolerance * (1 + abs(x)), (x, y)


def case(name, start, parameters, t, result):
    write = lambda rows: [[nstr(x, 34) for x in row] for row in rows]
    end, by_start, by_parameters = result
    return {
        "name": name,
        "start": [float(x) for x in start],
        "parameters": [float(x) for x in parameters],
        "t": t,
        "end": write([end])[0],
        "by_start": write(by_start),
        "by_parameters": write(by_parameters),
    }


def main():
    numbers = lambda texts: [mpf(x) for x in texts]
    start, parameters = numbers(KEPLER_START), numbers(KEPLER_PARAMETERS)
    mp.dps = 90
    by_start, by_parameters = differences(kepler_end, start, parameters, mpf(10) ** -28)
    kepler = kepler_end(start, parameters), by_start, by_parameters
    mp.dps = 22
    check = variational(kepler_rate, start, parameters, KEPLER_TIME)
    agree([kepler[0]], [check[0]], mpf(10) ** -18)
    agree(kepler[1], check[1], mpf(10) ** -18)
    agree(kepler[2], check[2], mpf(10) ** -18)

    start, parameters_l = numbers(LOTKA_START), numbers(LOTKA_PARAMETERS)
    mp.dps = 45
    lotka = variational(lotka_rate, start, parameters_l, LOTKA_TIME)
    mp.dps = 32
    end = lambda y, p: odefun(lambda _t, y: lotka_rate(y, p)[0], mpf(0), list(y))(mpf(LOTKA_TIME))
    check = differences(end, start, parameters_l, mpf(10) ** -10)
    agree(lotka[1], check[0], mpf(10) ** -17)
    agree(lotka[2], check[1], mpf(10) ** -17)

    mp.dps = 45
    meta = {
        "what": "ends of motions with their derivatives by the start (row i: component i) and by parameters",
        "source": "testdata/scripts/sensitivities.py",
        "generator": "mpmath: closed form of Kepler's motion; Taylor series of the variational equations",
        "digits": 34,
        "verified_by": "the other way of the two: variational equations, central differences of motions",
    }
    cases = [
        case("kepler", KEPLER_START, KEPLER_PARAMETERS, KEPLER_TIME, kepler),
        case("lotka_volterra", LOTKA_START, LOTKA_PARAMETERS, LOTKA_TIME, lotka),
    ]
    print(json.dumps({"meta": meta, "cases": cases}, indent=1))


main()
