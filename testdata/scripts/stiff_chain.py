"""Writes testdata/reference/stiff_chain.json: a chain of twenty masses with stiff springs, hung on a soft one.

    pip install mpmath gmpy2 numpy scipy
    python3 testdata/scripts/stiff_chain.py > testdata/reference/stiff_chain.json

Collocation of order 21 with 140 bits, as in stiff.py; the digits written are those in which a run with every step halved agrees.
Inputs are exact doubles; nothing of Piola is used.
"""

import json
import sys

from stiff import BITS, STAGES, collocation

MASSES = 20
STIFFNESS, DAMPING, GRAVITY = 1e6, 1e3, 1.0
END = 10.0


def chain(y):
    u, v = y[:MASSES], y[MASSES:]
    pull = [u[0] * u[0] * u[0] + u[0]]
    pull += [(u[i + 1] - u[i]) * STIFFNESS + (v[i + 1] - v[i]) * DAMPING for i in range(MASSES - 1)]
    pull.append(0)
    # The soft spring pulls the first mass back; each other link pulls its upper mass down and its lower mass up.
    up, down = pull[:-1], pull[1:]
    return list(v) + [down[i] - up[i] + GRAVITY for i in range(MASSES)]


if __name__ == "__main__":
    values, distance = collocation("stiff chain", chain, [0.0] * (2 * MASSES), END)
    json.dump({
        "problem": "Twenty masses of 1 hang one below the other: u1'' = -u1 - u1^3 + N1 + 1, ui'' = Ni - N(i-1) + 1, "
                   "Ni = 1e6 (u(i+1) - ui) + 1e3 (v(i+1) - vi), N20 = 0; from rest at u = 0; state (u1 ... u20, v1 ... v20)",
        "masses": MASSES, "stiffness": STIFFNESS, "damping": DAMPING, "gravity": GRAVITY, "end": END,
        "values": ["{0:.30g}".format(x) for x in values],
        "provenance": f"collocation on {STAGES} nodes of Radau (order {2 * STAGES - 1}) with {BITS} bits, by testdata/scripts/stiff_chain.py",
        "largest_relative_distance_from_coarser_mesh": f"{distance:.1e}",
    }, sys.stdout, indent=1)
    print()
