"""The planar chain of pendulums by sympy.physics.mechanics: what the bench `lagrangian` is compared with.

    pip install sympy numpy
    python benches/peers/sympy_chain.py

For each number of links: seconds to form the equations by Lagrange's method, and the lowest time of one
acceleration (mass matrix and forcing by `lambdify` with common subexpressions removed, then numpy's solve), ns.
Angles from the downward vertical, masses 1 − 0.4 i/n kg, rods 1 − 0.3 i/n m, as in the bench.
"""

import platform
import timeit

import numpy
import sympy
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

GRAVITY = 9.80665


def chain(links):
    angles = dynamicsymbols(f"q:{links}")
    time = dynamicsymbols._t
    x = z = sympy.S.Zero
    lagrangian = sympy.S.Zero
    for i, angle in enumerate(angles):
        mass, length = 1 - 0.4 * i / links, 1 - 0.3 * i / links
        x += length * sympy.sin(angle)
        z -= length * sympy.cos(angle)
        lagrangian += mass * (x.diff(time) ** 2 + z.diff(time) ** 2) / 2 - mass * GRAVITY * z
    return LagrangesMethod(lagrangian, angles), angles


def measure(links):
    start = timeit.default_timer()
    method, angles = chain(links)
    method.form_lagranges_equations()
    mass_matrix, forcing = method.mass_matrix, method.forcing
    formed = timeit.default_timer() - start
    rates = [angle.diff() for angle in angles]
    function = sympy.lambdify([*angles, *rates], [mass_matrix, forcing], modules="numpy", cse=True)
    state = numpy.linspace(0.3, 1.1, 2 * links)

    def acceleration():
        mass, force = function(*state)
        return numpy.linalg.solve(mass, force)

    number = 1000
    lowest = min(timeit.repeat(acceleration, number=number, repeat=7)) / number
    return formed, lowest * 1e9


if __name__ == "__main__":
    print(f"Python {platform.python_version()}, sympy {sympy.__version__}, numpy {numpy.__version__}")
    for links in [1, 2, 3, 4, 6, 8]:
        formed, lowest = measure(links)
        print(f"{links:3d} links: formed in {formed:8.3f} s, {lowest:10.0f} ns an acceleration")
