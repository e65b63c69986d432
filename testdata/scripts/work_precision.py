"""Writes references of four problems of attracting bodies: the ends of the runs, in testdata/reference.

    inner_solar_system.json          the Sun and the inner planets for ten years, with the post-Newtonian term of the Sun
    outer_solar_system_long.json     the Sun and the outer planets for ten thousand years
    arenstorf_of_doubles.json        Arenstorf's orbit from the start, period and masses of arenstorf.json, rounded to doubles
    cluster.json                     a hundred bodies of one mass, drawn at random from Plummer's model, to t = 1/2

Starts and masses are exact doubles; a state lists all x, all y, all z, then the velocities. Taylor series in binary128 by heyoka, with
steps of its own choice for a tolerance. Every run is made twice, with another tolerance, hence another order and other steps: `agreement`
is the largest difference of a component, relative to the largest of its block. Nothing of Piola is used.

    pip install heyoka==7.13.2
    python3 testdata/scripts/work_precision.py inner outer arenstorf cluster
"""

import json
import math
import pathlib
import random
import sys

import heyoka as hy
import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parents[1]
LIGHT = 299792458.0
AU = 149597870700.0
DAY = 86400.0
real = hy.real128


def name(kind, body, axis):
    return f"{kind}{axis}_{body}"


def equations(parameters, centre_light=None):
    """The right-hand sides, in the order of a state; with the speed of light the term of body 0 is added."""
    n = len(parameters)
    mu = [hy.expression(real(p)) for p in parameters]
    x = [[hy.expression(name("x", i, k)) for i in range(n)] for k in range(3)]
    v = [[hy.expression(name("v", i, k)) for i in range(n)] for k in range(3)]
    force = [[[] for _ in range(n)] for _ in range(3)]
    for i in range(n):
        for j in range(i + 1, n):
            d = [x[k][j] - x[k][i] for k in range(3)]
            inverse_cube = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) ** hy.expression(real("-1.5"))
            for k in range(3):
                pull = d[k] * inverse_cube
                force[k][i].append(mu[j] * pull)
                force[k][j].append(-mu[i] * pull)
    if centre_light is not None:
        c2 = hy.expression(real(centre_light) * real(centre_light))
        for i in range(1, n):
            r, u = [x[k][i] - x[k][0] for k in range(3)], [v[k][i] - v[k][0] for k in range(3)]
            dot = lambda a, b: a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
            r2 = dot(r, r)
            four = hy.expression(real(4))
            factor = mu[0] / (c2 * r2 * hy.sqrt(r2))
            along_r, along_v = four * mu[0] / hy.sqrt(r2) - dot(u, u), four * dot(r, u)
            for k in range(3):
                change = factor * (along_r * r[k] + along_v * u[k])
                force[k][i].append(change)
                force[k][0].append(-mu[i] / mu[0] * change)
    flat = lambda table: [entry for row in table for entry in row]
    return list(zip(flat(x), flat(v))) + [(a, hy.sum(f)) for a, f in zip(flat(v), flat(force))]


def end_of(parameters, start, end, tolerance, light=None):
    system = equations(parameters, light)
    run = hy.taylor_adaptive(
        system, [real(s) for s in start], fp_type=real, tol=real(tolerance), compact_mode=True
    )
    outcome = run.propagate_until(real(end))
    print(f"  order {run.order}, {outcome[3]} steps, {outcome[0]}", file=sys.stderr, flush=True)
    return [real(s) for s in run.state]


def agreement(first, second):
    half, largest = len(first) // 2, 0.0
    for block in (slice(0, half), slice(half, None)):
        size = max(abs(float(s)) for s in first[block])
        largest = max(largest, max(abs(float(a - b)) for a, b in zip(first[block], second[block])) / size)
    return largest


def write(file, problem, parameters, start, end, tolerances, light=None, note=""):
    print(file, file=sys.stderr, flush=True)
    first, second = (end_of(parameters, start, end, tolerance, light) for tolerance in tolerances)
    data = {
        "problem": problem,
        "provenance": "testdata/scripts/work_precision.py: Taylor series in binary128 by heyoka 7.13.2, tolerances "
        + " and ".join(tolerances) + note,
        "agreement": f"{agreement(first, second):.1e}",
        "parameters": parameters,
        "speed_of_light": light,
        "initial_state": start,
        "end": end,
        "state": [str(s) for s in first],
    }
    (FOLDER / "reference" / file).write_text(json.dumps(data, indent=1) + "\n")


def by_components(places, velocities):
    return [row[k] for rows in (places, velocities) for k in range(3) for row in rows]


def inner():
    golden = json.loads((FOLDER / "golden" / "solar_system.json").read_text())["cases"][0]["bodies"]
    names = ["sun", "mercury", "venus", "earth", "mars"]
    bodies = [next(body for body in golden if body["body"] == each) for each in names]
    parameters = [body["GM"] * DAY * DAY / AU**3 for body in bodies]
    start = by_components(
        [[x / AU for x in body["position"]] for body in bodies], [[v * DAY / AU for v in body["velocity"]] for body in bodies]
    )
    write(
        "inner_solar_system.json",
        "the Sun, Mercury, Venus, Earth and Mars, with the first post-Newtonian term of the Sun and its reaction; AU and days",
        parameters, start, 3652.5, ("1e-32", "1e-28"), LIGHT * DAY / AU,
        ". The start is that of testdata/golden/solar_system.json at J2000",
    )


def outer():
    data = json.loads((FOLDER / "reference" / "outer_solar_system.json").read_text())
    constant = float(data["G"])
    masses = []
    for mass in data["masses"]:
        over, _, under = mass.partition("/")
        masses.append(float(over) / float(under or 1.0))
    total = sum(masses)

    def centred(rows):
        mean = [sum(m * row[k] for m, row in zip(masses, rows)) / total for k in range(3)]
        return [[x - y for x, y in zip(row, mean)] for row in rows]

    write(
        "outer_solar_system_long.json",
        "the Sun and the outer planets about their centre of mass for ten thousand years; AU and days",
        [constant * mass for mass in masses], by_components(centred(data["positions"]), centred(data["velocities"])),
        3652500.0, ("1e-32", "1e-28"), None, ". The start is that of outer_solar_system.json, moved to the centre of mass",
    )


def arenstorf():
    """The motion magnifies the rounding of the start some 10^5 times: the reference of the unrounded start is 1e-11 away."""
    file = "arenstorf_of_doubles.json"
    print(file, file=sys.stderr, flush=True)
    data = json.loads((FOLDER / "reference" / "arenstorf.json").read_text())
    start, end, mass = [float(s) for s in data["initial_state"]], float(data["period"]), 0.012277471
    moon, earth = hy.expression(real(mass)), hy.expression(real(1.0 - mass))
    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    a, b, power, two = x + moon, x - earth, hy.expression(real("-1.5")), hy.expression(real(2))
    d1, d2 = earth * (a * a + y * y) ** power, moon * (b * b + y * y) ** power
    system = [(x, u), (y, v), (u, x + two * v - d1 * a - d2 * b), (v, y - two * u - (d1 + d2) * y)]

    def run(tolerance):
        method = hy.taylor_adaptive(system, [real(s) for s in start], fp_type=real, tol=real(tolerance), compact_mode=True)
        method.propagate_until(real(end))
        return [real(s) for s in method.state]

    tolerances = ("1e-32", "1e-28")
    first, second = map(run, tolerances)
    result = {
        "problem": "Arenstorf's orbit after one period, all inputs rounded to doubles, also the masses of the Moon and of the Earth",
        "provenance": "testdata/scripts/work_precision.py: Taylor series in binary128 by heyoka 7.13.2, tolerances " + " and ".join(tolerances),
        "agreement": f"{agreement(first, second):.1e}",
        "moon": mass,
        "initial_state": start,
        "period": end,
        "own_reference_after_one_period": {"state": [str(s) for s in first]},
    }
    (FOLDER / "reference" / file).write_text(json.dumps(result, indent=1) + "\n")


def cluster():
    """Aarseth, Henon & Wielen, Astron. Astrophys. 37 (1974) 183: G = M = 1, E = -1/4 on the average."""
    draw, places, velocities = random.Random(1788), [], []
    scale = 3.0 * math.pi / 16.0

    def direction(length):
        z, turn = 2.0 * draw.random() - 1.0, 2.0 * math.pi * draw.random()
        across = math.sqrt(1.0 - z * z)
        return [length * across * math.cos(turn), length * across * math.sin(turn), length * z]

    while len(places) < 100:
        radius = 1.0 / math.sqrt(draw.random() ** (-2.0 / 3.0) - 1.0)
        if radius > 10.0:
            continue
        while True:
            part, height = draw.random(), 0.1 * draw.random()
            if height < part * part * (1.0 - part * part) ** 3.5:
                break
        speed = part * math.sqrt(2.0) * (1.0 + radius * radius) ** -0.25
        rounded = lambda v: [round(x * 2**20) / 2**20 for x in v]
        places.append(rounded(direction(scale * radius)))
        velocities.append(rounded(direction(speed / math.sqrt(scale))))
    write(
        "cluster.json", "a hundred bodies of mass 1/128 from Plummer's model, G = 1", [1.0 / 128.0] * 100,
        by_components(places, velocities), 0.5, ("1e-24", "1e-20"),
    )


if __name__ == "__main__":
    for each in sys.argv[1:]:
        {"inner": inner, "outer": outer, "arenstorf": arenstorf, "cluster": cluster}[each]()
