"""Writes testdata/golden/equations.json: both sides of equations that other files do not reach, at one point each.

Everything is evaluated by mpmath at 40 digits from the definitions; nothing of Piola is used. Each case is computed in two
ways, and the script stops where they differ by more than 1e-20. Inputs are exact doubles.

    python3 testdata/scripts/equations.py > testdata/golden/equations.json
"""

import json

from mpmath import cos, diff, exp, legendre, matrix, mp, mpf, polyroots, sin, taylor

mp.dps = 40


def same(what, a, b):
    """Both ways of computing a list of numbers must agree."""
    worst = max(abs(x - y) for x, y in zip(a, b, strict=True))
    assert worst < mpf(10) ** -20, (what, worst)


def numbers(x):
    """Nested lists of doubles."""
    if isinstance(x, dict):
        return {key: numbers(value) for key, value in x.items()}
    if isinstance(x, (list, tuple)):
        return [numbers(y) for y in x]
    if isinstance(x, (str, int)):
        return x
    return float(x) if mpf(10) ** -30 < abs(x) else 0.0  # what 40 digits leave of zero


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def plus(*vectors):
    return [sum(x) for x in zip(*vectors, strict=True)]


def times(c, a):
    return [c * x for x in a]


# --- Motion in a moving frame, W(1.9) ---------------------------------------------------------------------------------


def moving_frame():
    """A frame that precesses, nods and spins, on an accelerated origin: no axis of the rotation is fixed."""
    t0 = mpf("0.75")

    def basis(t):
        psi, theta, phi = mpf("0.5") + t / 4 + t * t, 1 - t * t / 2, 2 * t - t**3 / 4
        about_z = lambda a: matrix([[cos(a), -sin(a), 0], [sin(a), cos(a), 0], [0, 0, 1]])
        about_y = matrix([[cos(theta), 0, sin(theta)], [0, 1, 0], [-sin(theta), 0, cos(theta)]])
        r = about_z(psi) * about_y * about_z(phi)
        return [[r[i, j] for i in range(3)] for j in range(3)]

    def origin(t):
        return [t * t, sin(t), exp(t / 2)]

    def within(t):
        return [cos(2 * t), t**3 - 1, 1 + t * t / 2]

    def path(t):
        e, x = basis(t), within(t)
        return plus(origin(t), *[times(x[i], e[i]) for i in range(3)])

    def derivatives(f, n):
        return [diff(lambda t: f(t)[i], t0, n) for i in range(3)]

    basis_n = [[[diff(lambda t: basis(t)[j][i], t0, n) for i in range(3)] for j in range(3)] for n in range(3)]
    of = {n: (derivatives(origin, n), derivatives(within, n), derivatives(path, n)) for n in range(3)}
    x, rate, second = (of[n][1] for n in range(3))
    relative = plus(*[times(second[i], basis_n[0][i]) for i in range(3)])
    # ė_i = ω×e_i: ω = ½ Σ e_i × ė_i, and ω̇ = ½ Σ e_i × ë_i.
    omega = times(mpf(1) / 2, plus(*[cross(basis_n[0][i], basis_n[1][i]) for i in range(3)]))
    omega_rate = times(mpf(1) / 2, plus(*[cross(basis_n[0][i], basis_n[2][i]) for i in range(3)]))
    # The second way: by ω, as in the textbooks.
    r = plus(*[times(x[i], basis_n[0][i]) for i in range(3)])
    v = plus(*[times(rate[i], basis_n[0][i]) for i in range(3)])
    coriolis = times(2, cross(omega, v))
    transport = plus(cross(omega_rate, r), cross(omega, cross(omega, r)))
    same("v", of[1][2], plus(of[1][0], v, cross(omega, r)))
    same("a", of[2][2], plus(of[2][0], relative, coriolis, transport))
    return {
        "equation": "W(1.9)",
        "frame": "psi = 1/2 + t/4 + t^2, theta = 1 - t^2/2, phi = 2t - t^3/4; R = R_z(psi) R_y(theta) R_z(phi), columns e_i",
        "origin": [of[n][0] for n in range(3)],
        "basis": basis_n,
        "angular_velocity": omega,
        "angular_acceleration": omega_rate,
        "within": [of[n][1] for n in range(3)],
        "motion": [of[n][2] for n in range(3)],
        "relative": relative,
        "coriolis": coriolis,
        "transport": transport,
    }


# --- Lie derivatives, W(9.15-9.18) ------------------------------------------------------------------------------------

POINT = [mpf("0.75"), mpf("-0.5"), mpf("1.25"), mpf("0.375")]


def lie_field(x):
    q1, q2, p1, p2 = x
    return [q1 * p2**2 - q2, sin(q1) + p1 * q2, q1**2 * p1 - exp(p2 / 2), q2 * p1 * p2 + q1]


def partial(f, x, i):
    return diff(lambda s: f(x[:i] + [s] + x[i + 1 :]), x[i])


def lie_derivatives():
    """d/ds at s = 0 of the forms pulled back by x + s k(x), which is the flow of k to first order: the definition."""
    theta = lambda x: [x[2], x[3], mpf(0), mpf(0)]
    omega = matrix(4, 4)
    omega[0, 2] = omega[1, 3] = -1  # ω = dp ∧ dq: ω(∂_q, ∂_p) = −1
    omega[2, 0] = omega[3, 1] = 1
    other = lambda x: [x[1] * x[2], x[0] ** 2, sin(x[3]), x[0] * x[1]]

    def area(x):
        b = matrix(4, 4)
        for i, j, entry in [(0, 1, x[2]), (0, 2, x[0] * x[3]), (0, 3, sin(x[1])), (1, 2, x[3]), (1, 3, x[0] ** 2), (2, 3, x[1] * x[2])]:
            b[i, j], b[j, i] = entry, -entry
        return b

    def moved(s):
        image = lambda x: plus(x, times(s, lie_field(x)))
        jacobian = matrix(4, 4)
        for i in range(4):
            for j in range(4):
                jacobian[i, j] = partial(lambda x: image(x)[i], POINT, j)
        return image(POINT), jacobian

    def pulled_one(form, s):
        y, j = moved(s)
        alpha = form(y)
        return [sum(alpha[m] * j[m, i] for m in range(4)) for i in range(4)]

    def pulled_two(form, s):
        y, j = moved(s)
        return list(j.T * form(y) * j)

    def rate(f, length):
        # Central differences of order eight in 40 digits with s = 1e-4: the error is of the order of 1e-32.
        h, weights = mpf(10) ** -4, [(1, mpf(4) / 5), (2, -mpf(1) / 5), (3, mpf(4) / 105), (4, -mpf(1) / 280)]
        total = [mpf(0)] * length
        for n, w in weights:
            total = plus(total, times(w / h, plus(f(n * h), times(-1, f(-n * h)))))
        return total

    lie_theta, lie_omega = rate(lambda s: pulled_one(theta, s), 4), rate(lambda s: pulled_two(lambda x: omega, s), 16)
    lie_other, lie_area = rate(lambda s: pulled_one(other, s), 4), rate(lambda s: pulled_two(area, s), 16)
    # The second way: L_k θ = k^p·dq + p·dk^q and L_k ω = Σ dk^p ∧ dq + dp ∧ dk^q, component by component.
    k = lie_field(POINT)
    slope = lambda i, j: partial(lambda x: lie_field(x)[i], POINT, j)
    by_parts = [(k[2 + i] if i < 2 else 0) + sum(POINT[2 + m] * slope(m, i) for m in range(2)) for i in range(4)]
    same("L_k theta", lie_theta, by_parts)
    wedge = []
    unit = lambda i, j: mpf(1) if i == j else mpf(0)
    for i in range(4):
        for j in range(4):
            entry = mpf(0)
            for m in range(2):
                entry += slope(2 + m, i) * unit(j, m) - slope(2 + m, j) * unit(i, m)
                entry += unit(i, 2 + m) * slope(m, j) - unit(j, 2 + m) * slope(m, i)
            wedge.append(entry)
    same("L_k omega", lie_omega, wedge)
    return {
        "equation": "W(9.15-9.18)",
        "field": "k = (q1 p2^2 - q2, sin q1 + p1 q2, q1^2 p1 - exp(p2/2), q2 p1 p2 + q1)",
        "one_form": "(q2 p1, q1^2, sin p2, q1 q2)",
        "two_form": "entries 12: p1, 13: q1 p2, 14: sin q2, 23: p2, 24: q1^2, 34: q2 p1",
        "x": POINT,
        "lie_theta": lie_theta,
        "lie_omega": lie_omega,
        "lie_one_form": lie_other,
        "lie_two_form": lie_area,
    }


# --- Integral balances, W(15.16), W(15.18), W(21.4) -------------------------------------------------------------------


def balances():
    """A box with polynomial motion, density, stress and body force that are in no balance: every term by itself."""
    low, high = [mpf("0.5"), mpf("-0.75"), mpf(0)], [mpf(2), mpf(1), mpf("1.5")]
    time, pole = mpf("0.75"), [mpf("0.25"), mpf("-0.5"), mpf(1)]
    # Eight Gauss points in each direction: exact to degree fifteen.
    nodes = polyroots(list(reversed(taylor(lambda x: legendre(8, x), 0, 8))), maxsteps=500, extraprec=400)
    weights = [2 / ((1 - x * x) * diff(lambda y: legendre(8, y), x) ** 2) for x in nodes]

    def place(x, t):
        return [x[0] + t * x[1] ** 2 / 4 + t * t, x[1] - t * t * x[0] * x[2] / 2, x[2] + t * t * x[0] / 2]

    def velocity(x, t):
        return [x[1] ** 2 / 4 + 2 * t, -t * x[0] * x[2], t * x[0]]

    acceleration = lambda x: [mpf(2), -x[0] * x[2], x[0]]
    density = lambda x: 2 + x[0] / 2 - x[1] / 4
    force = lambda x: [x[1] * x[2], 1 - time * x[0], -mpf("9.75") + x[0] * x[1]]

    def stress(x):
        a, b, c = x
        return [[a * b, time + c * c, -b], [2 * c, a * a - b, time * a * c], [b * b, 3 - c, a + b * c]]

    # F-dot of the velocity and Div P, by hand.
    def gradient_rate(x):
        return [[mpf(0), x[1] / 2, mpf(0)], [-time * x[2], mpf(0), -time * x[0]], [time, mpf(0), mpf(0)]]

    def divergence(x):
        a, b, c = x
        return [b + 0 + 0, 0 - 1 + time * a, 0 + 0 + b]

    def points(axis):
        half, middle = (high[axis] - low[axis]) / 2, (high[axis] + low[axis]) / 2
        return [(middle + half * x, half * w) for x, w in zip(nodes, weights, strict=True)]

    axes = [points(i) for i in range(3)]

    def volume(f):
        total = None
        for x, wx in axes[0]:
            for y, wy in axes[1]:
                for z, wz in axes[2]:
                    term = times(wx * wy * wz, f([x, y, z]))
                    total = term if total is None else plus(total, term)
        return total

    def surface(f):
        total = None
        for axis in range(3):
            j, k = (axis + 1) % 3, (axis + 2) % 3
            for side, sign in [(low[axis], -1), (high[axis], 1)]:
                for u, wu in axes[j]:
                    for v, wv in axes[k]:
                        x = [mpf(0)] * 3
                        x[axis], x[j], x[k] = side, u, v
                        normal = [mpf(0)] * 3
                        normal[axis] = mpf(sign)
                        term = times(wu * wv, f(x, normal))
                        total = term if total is None else plus(total, term)
        return total

    def about_pole(x, t, vector):
        return cross(plus(place(x, t), times(-1, pole)), vector)

    def state(t):
        momentum = volume(lambda x: times(density(x), velocity(x, t)))
        moment = volume(lambda x: times(density(x), about_pole(x, t, velocity(x, t))))
        energy = volume(lambda x: [density(x) * dot(velocity(x, t), velocity(x, t)) / 2])
        return momentum + moment + energy

    def resultants(vector, x):
        return vector + about_pole(x, time, vector) + [dot(vector, velocity(x, time))]

    now = state(time)
    # Rates: densities of the acceleration, and central differences of the integrals, polynomials in t of degree below five.
    rates = volume(lambda x: times(density(x), acceleration(x)))
    rates += volume(lambda x: times(density(x), about_pole(x, time, acceleration(x))))
    rates += volume(lambda x: [density(x) * dot(velocity(x, time), acceleration(x))])
    h = mpf(1) / 8
    near, far = plus(state(time + h), times(-1, state(time - h))), plus(state(time + 2 * h), times(-1, state(time - 2 * h)))
    same("rates", rates, times(1 / (12 * h), plus(times(8, near), times(-1, far))))
    body = volume(lambda x: resultants(times(density(x), force(x)), x))
    tractions = surface(lambda x, n: resultants([dot(row, n) for row in stress(x)], x))
    # The second way: the divergence theorem, with ∂x/∂X by hand.
    def inside(x):
        p, div, v = stress(x), divergence(x), velocity(x, time)
        f = [[1, time * x[1] / 2, 0], [-time * time * x[2] / 2, 1, -time * time * x[0] / 2], [time * time / 2, 0, 1]]
        turn = [mpf(0)] * 3
        for a in range(3):
            turn = plus(turn, cross([f[i][a] for i in range(3)], [p[i][a] for i in range(3)]))
        rate = gradient_rate(x)
        contraction = sum(dot(p[i], rate[i]) for i in range(3))
        return div + plus(about_pole(x, time, div), turn) + [dot(div, v) + contraction]

    same("tractions", tractions, volume(inside))
    power = volume(lambda x: [sum(dot(p, d) for p, d in zip(stress(x), gradient_rate(x), strict=True))])
    return {
        "equation": "W(15.16), W(15.18), W(21.4)",
        "motion": "x = (X1 + t X2^2/4 + t^2, X2 - t^2 X1 X3/2, X3 + t^2 X1/2)",
        "density": "2 + X1/2 - X2/4",
        "stress": "P = [[X1 X2, t + X3^2, -X2], [2 X3, X1^2 - X2, t X1 X3], [X2^2, 3 - X3, X1 + X2 X3]]",
        "body_force": "b = (X2 X3, 1 - t X1, -9.75 + X1 X2)",
        "low": low,
        "high": high,
        "t": time,
        "pole": pole,
        "momentum": now[:3],
        "angular_momentum": now[3:6],
        "kinetic_energy": now[6],
        "momentum_rate": rates[:3],
        "angular_momentum_rate": rates[3:6],
        "kinetic_energy_rate": rates[6],
        "body": {"force": body[:3], "moment": body[3:6], "power": body[6]},
        "surface": {"force": tractions[:3], "moment": tractions[3:6], "power": tractions[6]},
        "stress_power": power[0],
        "mass": volume(lambda x: [density(x)])[0],
    }


print(
    json.dumps(
        {
            "meta": {
                "what": "terms of the motion in a moving frame, of Lie derivatives and of integral balances, each at one point",
                "source_equations": "W(1.9); W(9.15-9.18); W(15.16), W(15.18), W(21.4)",
                "generator": "testdata/scripts/equations.py, mpmath",
                "digits": "40, rounded to doubles",
                "verified_by": "each case in two ways to 1e-20: by omega and by derivatives of the path; by pulling back and by "
                "parts; by surface integrals and by the divergence theorem",
            },
            "cases": numbers([moving_frame(), lie_derivatives(), balances()]),
        },
        indent=1,
    )
)
