"""Runs the outer Solar System for ten thousand years by REBOUND; prints one table.

    pip install rebound==4.4.3
    taskset -c 1 python3 benches/peers/planets.py

Bodies, steps and columns are those of `cargo run --release -p piola-gravitation --example planets`. The error is the largest of
1000 times, relative to the energy at the start. The time is that of the fastest of 200 runs of 1000 steps, with one corrector at
either end. IAS15 has the last row: its step is the mean, its time that of the fastest of 20 runs of 100,000 days.
"""

import ctypes
import json
import pathlib
import time

import rebound

ROOT = pathlib.Path(__file__).resolve().parents[2]
END = 3652500.0
RUNS, STEPS = 200, 1000


def bodies():
    data = json.loads((ROOT / "testdata/reference/outer_solar_system.json").read_text())
    simulation = rebound.Simulation()
    simulation.G = float(data["G"])
    for mass, (x, y, z), (u, v, w) in zip(data["masses"], data["positions"], data["velocities"]):
        top, _, bottom = mass.partition("/")
        simulation.add(m=float(top) / float(bottom or 1.0), x=x, y=y, z=z, vx=u, vy=v, vz=w)
    simulation.move_to_com()
    return simulation


def whfast(corrector, step):
    simulation = bodies()
    simulation.integrator, simulation.dt = "whfast", step
    simulation.ri_whfast.corrector, simulation.ri_whfast.safe_mode = corrector, 0
    return simulation


def saba(step):
    simulation = bodies()
    simulation.integrator, simulation.dt = "saba", step
    simulation.ri_saba.type, simulation.ri_saba.safe_mode = "(10,6,4)", 0
    return simulation


def row(name, step, begin):
    seconds = float("inf")
    for _ in range(RUNS):
        simulation = begin()
        began = time.perf_counter()
        simulation.steps(STEPS)
        rebound.clibrebound.reb_simulation_synchronize(ctypes.byref(simulation))
        seconds = min(seconds, time.perf_counter() - began)
    simulation = begin()
    before, largest = simulation.energy(), 0.0
    for part in range(1, 1001):
        simulation.integrate(part * END / 1000, exact_finish_time=0)
        rebound.clibrebound.reb_simulation_synchronize(ctypes.byref(simulation))
        largest = max(largest, abs(simulation.energy() / before - 1.0))
    print(f"| {name} | {step:g} | {1e9 * seconds / STEPS:.0f} | {1e9 * seconds / STEPS / step:.2f} | {largest:.1e} |", flush=True)


def ias15():
    span, seconds = 100000.0, float("inf")
    for _ in range(20):
        simulation = bodies()
        simulation.integrator = "ias15"
        began = time.perf_counter()
        simulation.integrate(span, exact_finish_time=0)
        seconds = min(seconds, time.perf_counter() - began)
    steps, reached = simulation.steps_done, simulation.t
    simulation = bodies()
    simulation.integrator = "ias15"
    before, largest = simulation.energy(), 0.0
    for part in range(1, 1001):
        simulation.integrate(part * END / 1000)
        largest = max(largest, abs(simulation.energy() / before - 1.0))
    print(f"| IAS15 | {reached / steps:.0f} | {1e9 * seconds / steps:.0f} | {1e9 * seconds / reached:.2f} | {largest:.1e} |", flush=True)


def main():
    print(f"REBOUND {rebound.__version__}\n\n| method | step, d | ns a step | ns a day | error of the energy |\n|---|---|---|---|---|")
    for corrector in (0, 3, 17):
        for step in (200.0, 100.0, 50.0, 25.0):
            row(f"WHFast, corrector {corrector}", step, lambda: whfast(corrector, step))
    for step in (1600.0, 800.0, 400.0, 200.0):
        row("SABA(10,6,4)", step, lambda: saba(step))
    ias15()


main()
