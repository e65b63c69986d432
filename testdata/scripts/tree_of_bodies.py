"""Accelerations of a chain of three bodies, and their derivatives, to 30 digits.

Hinge about an oblique axis, slide along one, hinge about y at a turned place. Everything follows from the placement alone, by
differences in 160 digits: M from the derivatives of the centres of mass and of the attitudes, the bias forces from the
derivatives of M, the derivatives of the accelerations from differences of the accelerations.

    python3 testdata/scripts/tree_of_bodies.py > testdata/reference/tree_of_bodies.json
"""

import json

from mpmath import mp, mpf, matrix, cos, sin, lu_solve, eye, zeros

mp.dps = 160
F = mpf

AXES = [(F(3) / 5, F(0), F(4) / 5), (F(0), F(-4) / 5, F(3) / 5), (F(0), F(1), F(0))]
KINDS = ["revolute", "prismatic", "revolute"]
ORIGINS = [(F(0), F(1) / 8, F(1) / 4), (F(1) / 2, F(0), F(-1) / 4), (F(-1) / 4, F(3) / 8, F(1) / 2)]
MASSES = [F(3) / 2, F(3) / 4, F(2)]
CENTRES = [(F(1) / 8, F(0), F(-1) / 2), (F(0), F(1) / 4, F(1) / 8), (F(-3) / 8, F(1) / 8, F(1) / 4)]
MOMENTS = [(F(1) / 4, F(3) / 8, F(1) / 2), (F(1) / 8, F(1) / 8, F(3) / 16), (F(1) / 2, F(3) / 8, F(1) / 4)]
GRAVITY = matrix([0, 0, -F(981) / 100])
Q = [F(5) / 8, F(-3) / 16, F(11) / 8]
V = [F(-3) / 4, F(1) / 2, F(9) / 8]
TAU = [F(1) / 2, F(-2), F(3) / 4]


def rotation(axis, angle):
    x, y, z = axis
    k = matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return eye(3) + sin(angle) * k + (1 - cos(angle)) * (k * k)


def place(q):
    """Attitude and centre of mass of each body."""
    attitude, origin, out = eye(3), matrix([0, 0, 0]), []
    for i in range(3):
        origin = origin + attitude * matrix(ORIGINS[i])
        if KINDS[i] == "revolute":
            attitude = attitude * rotation(AXES[i], q[i])
        else:
            origin = origin + attitude * matrix(AXES[i]) * q[i]
        out.append((attitude, origin + attitude * matrix(CENTRES[i])))
    return out


def differences(function, x, j, h):
    up, down = list(x), list(x)
    up[j] += h
    down[j] -= h
    return function(up), function(down), 2 * h


def mass_matrix(q):
    here = place(q)
    columns = []
    for j in range(3):
        up, down, width = differences(place, q, j, mpf(10) ** -50)
        column = []
        for i in range(3):
            centre = (up[i][1] - down[i][1]) / width
            spin = here[i][0].T * ((up[i][0] - down[i][0]) / width)
            column.append((centre, matrix([spin[2, 1], spin[0, 2], spin[1, 0]])))
        columns.append(column)
    m = zeros(3)
    for a in range(3):
        for b in range(3):
            for i in range(3):
                (c, w), (d, u) = columns[a][i], columns[b][i]
                m[a, b] += MASSES[i] * (c.T * d)[0] + sum(MOMENTS[i][k] * w[k] * u[k] for k in range(3))
    return m


def potential(q):
    return -sum(MASSES[i] * (GRAVITY.T * place(q)[i][1])[0] for i in range(3))


def acceleration(x):
    q, v, tau = x[:3], x[3:6], x[6:]
    m = mass_matrix(q)
    slopes, forces = [], []
    for j in range(3):
        up, down, width = differences(mass_matrix, q, j, mpf(10) ** -25)
        slopes.append((up - down) / width)
        up, down, width = differences(potential, q, j, mpf(10) ** -50)
        forces.append((up - down) / width)
    velocity = matrix(v)
    right = matrix(3, 1)
    for i in range(3):
        carried = sum(slopes[k][i, j] * v[j] * v[k] for j in range(3) for k in range(3))
        right[i] = tau[i] - carried + (velocity.T * slopes[i] * velocity)[0] / 2 - forces[i]
    return lu_solve(m, right), m


def text(x):
    return mp.nstr(x, 30, strip_zeros=False)


state = Q + V + TAU
solution, m = acceleration(state)
by = []
for j in range(9):
    up, down, width = differences(lambda x: acceleration(x)[0], state, j, mpf(10) ** -12)
    wide_up, wide_down, wide = differences(lambda x: acceleration(x)[0], state, j, 2 * mpf(10) ** -12)
    # One step of Richardson's extrapolation leaves 10⁻⁴⁸.
    by.append([text((4 * (up[i] - down[i]) / width - (wide_up[i] - wide_down[i]) / wide) / 3) for i in range(3)])
print(
    json.dumps(
        {
            "provenance": "testdata/scripts/tree_of_bodies.py, mpmath, differences of the placement in 160 digits; rounded to 30",
            "q": [float(x) for x in Q],
            "v": [float(x) for x in V],
            "tau": [float(x) for x in TAU],
            "mass_matrix": [[text(m[i, j]) for j in range(3)] for i in range(3)],
            "acceleration": [text(solution[i]) for i in range(3)],
            "by_q": by[:3],
            "by_v": by[3:6],
            "by_tau": by[6:],
        },
        indent=1,
    )
)
