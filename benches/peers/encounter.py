"""Runs two planets that meet by REBOUND's hybrid integrators; prints one table.

    pip install rebound==4.4.3
    taskset -c 1 python3 benches/peers/encounter.py

Bodies, steps and columns are those of `cargo run --release -p piola-gravitation --example encounter`: a star with three planets for
twenty units of time. Errors are those at the end, the places against 30 digits. The time is that of the fastest of 20 runs.
"""

import json
import pathlib
import time

import rebound

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = json.loads((ROOT / "testdata/reference/planet_encounter.json").read_text())
END = DATA["states"][-1]
RUNS = 20
STEPS = (0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625)


def bodies():
    simulation = rebound.Simulation()
    for mass, (x, y, z), (u, v, w) in zip(DATA["masses"], DATA["positions"], DATA["velocities"]):
        simulation.add(m=mass, x=x, y=y, z=z, vx=u, vy=v, vz=w)
    return simulation


def row(name, step, integrator):
    seconds = float("inf")
    for _ in range(RUNS):
        simulation = bodies()
        simulation.integrator = integrator
        if step:
            simulation.dt = step
        if integrator == "mercurius":
            simulation.ri_mercurius.r_crit_hill = 3.0
            simulation.ri_mercurius.safe_mode = 0
        before = simulation.energy()
        began = time.perf_counter()
        simulation.integrate(float(END["t"]))
        seconds = min(seconds, time.perf_counter() - began)
    energy = abs(simulation.energy() / before - 1.0)
    found = [x for particle in simulation.particles for x in particle.xyz]
    place = max(abs(a - float(b)) for a, b in zip(found, END["state"]))
    print(f"| {name} | {step:g} | {1e3 * seconds:.2f} | {energy:.1e} | {place:.1e} |", flush=True)


def main():
    print(f"REBOUND {rebound.__version__}\n\n| method | step | ms | error of the energy | error of a place |\n|---|---|---|---|---|")
    row("IAS15", 0.0, "ias15")
    for step in STEPS:
        row("MERCURIUS", step, "mercurius")
    for step in STEPS:
        row("TRACE", step, "trace")


main()
