"""Points a second of a law over NumPy arrays, beside the same law in NumPy.

python crates/python/tests/throughput.py
"""

import time

import numpy as np

import piola

C10, C01, C = 0.5, 0.25, 1.0


def mooney_rivlin(f):
    """P of W = C10 (I1 - 3) + C01 (I2 - 3) + c J^2 - d ln J with a stress-free reference."""
    d = 2.0 * (C10 + 2.0 * C01 + C)
    c = np.einsum("nki,nkj->nij", f, f)
    first = np.trace(c, axis1=1, axis2=2)[:, None, None]
    j = np.linalg.det(f)[:, None, None]
    inverse = np.linalg.inv(f).swapaxes(1, 2)
    return 2.0 * C10 * f + 2.0 * C01 * (first * f - f @ c) + (2.0 * C * j * j - d) * inverse


def shortest(call, passes=20):
    """The shortest of some passes, s."""
    times = []
    for _ in range(passes):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return min(times)


def main():
    law = piola.Solid("mooney_rivlin", c10=C10, c01=C01, square_coefficient=C)
    print("| points | quantity | piola, ns a point | NumPy, ns a point | ratio |\n|---|---|---|---|---|")
    for count in (1, 1000, 100_000):
        f = np.eye(3) + 0.2 * np.random.default_rng(0).uniform(-1.0, 1.0, (count, 3, 3))
        stress, square, six = np.empty_like(f), np.empty((count, 3, 3, 3, 3)), np.empty((count, 6, 6))
        error = np.abs(law.stress(f, "first_piola") - mooney_rivlin(f)).max()
        assert error < 1e-13, error
        passes = 20 if count > 1 else 2000
        numpy = 1e9 * shortest(lambda: mooney_rivlin(f), passes) / count
        for name, call in [
            ("P", lambda: law.stress(f, "first_piola", out=stress)),
            ("T", lambda: law.stress(f, "cauchy", out=stress)),
            ("P and dP/dF", lambda: law.stress_and_tangent(f, out=(stress, square))),
            ("T and DDSDDE", lambda: law.stress_and_tangent(f, ("cauchy", "jaumann"), out=(stress, six))),
        ]:
            own = 1e9 * shortest(call, passes) / count
            beside = f"{numpy:.0f} | {numpy / own:.0f}" if name == "P" else " | "
            print(f"| {count} | {name} | {own:.1f} | {beside} |")


def histories():
    """An increment of two laws with history at a thousand points, beside the number of points alone."""
    spring = {"law": "neo_hookean", "shear_modulus": 1.0, "volumetric": {"law": "simo_taylor", "bulk_modulus": 5.0}}
    metal = {"law": "hencky", "shear_modulus": 2.0, "volumetric": {"law": "lame", "first_lame_parameter": 3.0}}
    hardening = {"yield_stress": 0.25, "linear": 0.125, "saturation": 0.5, "saturation_exponent": 4.0}
    laws = [
        piola.History("reese_govindjee", equilibrium=spring, overstress=spring, viscosity=0.75, bulk_fluidity=0.0),
        piola.History("viscoplastic", elastic=metal, hardening=hardening, viscosity=0.0),
    ]
    print("\n| law with history | points | T and the new state, ns a point | with DDSDDE |\n|---|---|---|---|")
    for law in laws:
        for count in (1, 1000):
            f = np.eye(3) + 0.2 * np.random.default_rng(0).uniform(-1.0, 1.0, (count, 3, 3))
            before, state = np.broadcast_to(np.eye(3), f.shape).copy(), law.initial_states(count)
            stress, six, new = np.empty_like(f), np.empty((count, 6, 6)), np.empty_like(state)
            ways = [
                lambda: law.advance(before, f, 0.1, state, out=(stress, new)),
                lambda: law.advance(before, f, 0.1, state, tangent="jaumann", voigt="abaqus", out=(stress, six, new)),
            ]
            times = [1e9 * shortest(way, 20 if count > 1 else 500) / count for way in ways]
            print(f"| {law.parameters['law']} | {count} | {times[0]:.0f} | {times[1]:.0f} |")


if __name__ == "__main__":
    main()
    histories()
