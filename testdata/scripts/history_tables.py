"""Writes testdata/golden/history_tables.json: stresses of laws with history in simple shear, as tables of time, shear and stress.

The differential equations and their integration are those of inelastic_paths.py: nothing of Piola is used. The body is as made at time zero;
a first row of time zero is a jump.

    python3 testdata/scripts/history_tables.py > testdata/golden/history_tables.json
"""

import json
import sys

import inelastic_paths as paths
from mpmath import erf, eye, matrix, mp, mpf, nstr

mp.dps = 30


def shear(k):
    return matrix([[1, mpf(k), 0], [0, 1, 0], [0, 0, 1]])


def table(build, rows, parts):
    """P_12 at rows of (t, k)."""
    _, parameters, rest, spring, flow, _, extra = build()
    y = paths.flat(eye(3)) + list(extra)
    found, before = [], (0.0, 0.0)
    for t, k in rows:
        start, end, duration = shear(before[1]), shear(k), mpf(t) - mpf(before[0])
        if duration > 0:
            def rate(s, y):
                f_i = paths.of(y)
                d, more = flow(spring.mandel(paths.path(start, end, s, duration) * paths.inv(f_i)), f_i, y[9:])
                return paths.flat(d * f_i) + list(more)
            y = paths.integrate(rate, y, duration, parts, columns=8)
        found.append(paths.stress(rest, spring, end, y)[0, 1])
        before = (t, k)
    return parameters, found


def isochoric(build):
    """The law without flow of volumes."""
    def built():
        name, parameters, rest, spring, flow, legs, extra = build()
        parameters.pop("bulk_viscosity", None)
        return name, parameters, rest, spring, lambda m, f, more: flow(paths.dev(m), f, more), legs, extra
    return built


def mullins(rows):
    """W = mu k^2/2 and P_12 = mu k of a neo-Hookean law."""
    mu, r, m, beta, worst, found = mpf(1), mpf(2), mpf("0.25"), mpf("0.125"), mpf(0), []
    for _, k in rows:
        energy = mu * mpf(k) ** 2 / 2
        worst = max(worst, energy)
        found.append(mu * mpf(k) * (1 - erf((worst - energy) / (m + beta * worst)) / r))
    return {"mu": 1.0, "lambda": 5.0, "softening": 2.0, "energy": 0.25, "share": 0.125}, found


def cycle(width, turns, steps=4):
    """Up and down between shears, `steps` rows a leg of `width` seconds a row."""
    rows, t, k = [], 0.0, 0.0
    for turn in turns:
        for step in range(1, steps + 1):
            t += width
            rows.append((t, k + (turn - k) * step / steps))
        k = turn
    return rows


def main():
    load_hold = [(0.0, 0.5)] + [(0.125 * n, 0.5 + 0.125 * n) for n in range(1, 6)] + [(0.625 + 0.25 * n, 1.125) for n in range(1, 6)]
    fast = [(0.5 * t, k) for t, k in load_hold]
    flowing = [cycle(0.125, [0.75, 0.75, 0.125]), cycle(1.0, [1.0, 0.25])]
    laws = [("bergstrom-boyce", paths.bergstrom_boyce, flowing), ("reese-govindjee", isochoric(paths.reese_govindjee), flowing),
            ("viscoplastic", paths.viscoplastic, [load_hold, fast])]
    cases, worst = [], mpf(0)
    for name, build, tables in laws:
        for number, rows in enumerate(tables):
            parameters, found = table(build, rows, 6)
            _, again = table(build, rows, 8)
            difference = max(abs(a - b) for a, b in zip(found, again))
            print(name, number, nstr(difference, 3), file=sys.stderr)
            worst = max(worst, difference)
            cases.append((f"{name}/{number}", name, parameters, rows, found))
    rows = cycle(1.0, [0.5, 0.0, 1.0, 0.0, 1.25], 8)
    parameters, found = mullins(rows)
    cases.append(("ogden-roxburgh/0", "ogden-roxburgh", parameters, rows, found))
    meta = {
        "what": "P_12 of laws with history in simple shear: rows of time and amount of shear, and the stresses",
        "source_equations": "those of inelastic_paths.json; reese-govindjee without flow of volumes",
        "generator": "testdata/scripts/history_tables.py (mpmath, 30 digits)",
        "digits": 20,
        "verified_by": "integration in a third more parts, largest difference " + nstr(worst, 3),
    }
    lines = ",\n  ".join(json.dumps({"id": id, "law": law, "params": parameters, "input": {"rows": rows},
                                     "output": {"P12": [nstr(x, 20) for x in found]}})
                         for id, law, parameters, rows, found in cases)
    print('{\n "meta": %s,\n "cases": [\n  %s\n ]\n}' % (json.dumps(meta, indent=1).replace("\n", "\n "), lines))


if __name__ == "__main__":
    main()
