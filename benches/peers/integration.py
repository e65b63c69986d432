"""SciPy, heyoka and REBOUND on the problems of `work-precision`, in turn with our methods.

Writes work-precision-all.json; work-precision.json without its own peers; and the figures, which do not have them either.

    pip install numpy scipy==1.17.1 heyoka==7.13.2 rebound==4.4.3
    cargo build --release --manifest-path benches/peers/integration/Cargo.toml
    taskset -c 0 python3 benches/peers/integration.py \\
        --ours benches/peers/integration/target/release/piola-peer-integration --out docs/measurements/figures

Fields are those of work-precision.json: problem, method, peer, parameter, error, seconds, evaluations (none where the peer does not tell).
In every round our program runs once on a problem, then every peer at every tolerance; the least time of all rounds counts. SciPy's
equations are in NumPy or plain Python, which is most of its time. heyoka compiles each system and tolerance before its time is taken.
`--problem NAME` runs one problem only, `--table FILE` prints the comparison that a file holds.
"""

import argparse
import json
import math
import pathlib
import shutil
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
LONGEST, ROUNDS, SAMPLES = 0.6, 2, 5


def read(kind, name):
    return json.loads((ROOT / "testdata" / kind / f"{name}.json").read_text())


def number(value):
    over, _, under = str(value).partition("/")
    return float(over) / float(under or 1.0)


def flat(values):
    return [x for value in values for x in flat(value)] if isinstance(values, list) else [number(values)]


def by_components(triples):
    half = len(triples) // 2
    return [x for block in (triples[:half], triples[half:]) for k in range(3) for x in block[k::3]]


class Problem:
    """A start, an end and a right-hand side `rate(lib, y)` over the scalars of `lib`, a module with sqrt, sin and cos."""

    def __init__(self, name, rate, start, end, reference, positions=None, small=1.0, bodies=None, axes=3, stiff=False):
        self.name, self.rate, self.start, self.end, self.reference = name, rate, start, end, reference
        self.positions, self.small, self.bodies, self.axes, self.stiff = positions or len(start) // 2, small, bodies, axes, stiff

    def error(self, state):
        worst = 0.0
        for block in (slice(0, self.positions), slice(self.positions, None)):
            size = max(abs(x) for x in self.reference[block])
            worst = max([worst] + [abs(a - b) / size for a, b in zip(state[block], self.reference[block])])
        return worst


def attraction(parameters, axes, light=None):
    n = len(parameters)

    def rate(lib, y):
        x, v = [y[k * n : (k + 1) * n] for k in range(axes)], [y[(axes + k) * n : (axes + k + 1) * n] for k in range(axes)]
        force = [[[] for _ in range(n)] for _ in range(axes)]
        for i in range(n):
            for j in range(i + 1, n):
                d = [x[k][j] - x[k][i] for k in range(axes)]
                inverse = sum((a * a for a in d[1:]), d[0] * d[0]) ** -1.5
                for k in range(axes):
                    force[k][i].append(parameters[j] * (d[k] * inverse))
                    force[k][j].append(-parameters[i] * (d[k] * inverse))
        for i in range(1, n) if light else ():
            r, w = [x[k][i] - x[k][0] for k in range(3)], [v[k][i] - v[k][0] for k in range(3)]
            r2, w2, rw = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] for a, b in ((r, r), (w, w), (r, w)))
            distance = lib.sqrt(r2)
            factor = parameters[0] / light**2 / (r2 * distance)
            for k in range(3):
                change = factor * ((4.0 * parameters[0] / distance - w2) * r[k] + 4.0 * rw * w[k])
                force[k][i].append(change)
                force[k][0].append(-parameters[i] / parameters[0] * change)
        total = lib.total if hasattr(lib, "total") else sum
        return list(y[axes * n :]) + [total(f) for row in force for f in row]

    return rate


def top(inertia, weight):
    def rate(lib, y):
        q0, q1, q2, q3, a, b, c = y
        up = [2.0 * (q1 * q3 - q0 * q2), 2.0 * (q2 * q3 + q0 * q1), q0 * q0 - q1 * q1 - q2 * q2 + q3 * q3]
        j, w, omega = inertia, weight, [a, b, c]
        moment = [(j[(i + 1) % 3] - j[(i + 2) % 3]) * omega[(i + 1) % 3] * omega[(i + 2) % 3] for i in range(3)]
        if any(w):
            moment = [m + up[(i + 1) % 3] * w[(i + 2) % 3] - up[(i + 2) % 3] * w[(i + 1) % 3] for i, m in enumerate(moment)]
        return [
            -0.5 * (q1 * a + q2 * b + q3 * c), 0.5 * (q0 * a + q2 * c - q3 * b),
            0.5 * (q0 * b + q3 * a - q1 * c), 0.5 * (q0 * c + q1 * b - q2 * a),
        ] + [m / i for m, i in zip(moment, j)]

    return rate


def double_pendulum(lib, y):
    q1, q2, v1, v2 = y
    sine, cosine = lib.sin(q1 - q2), lib.cos(q1 - q2)
    first = -sine * v2 * v2 - 2.0 * 9.81 * lib.sin(q1)
    second = sine * v1 * v1 - 9.81 * lib.sin(q2)
    inverse = 1.0 / (2.0 - cosine * cosine)
    return [v1, v2, (first - cosine * second) * inverse, (2.0 * second - cosine * first) * inverse]


def henon_heiles(lib, y):
    return [y[2], y[3], -y[0] - 2.0 * y[0] * y[1], y[1] * y[1] - y[1] - y[0] * y[0]]


def kepler(parameter):
    def rate(lib, y):
        factor = -parameter * (y[0] * y[0] + y[1] * y[1]) ** -1.5
        return [y[2], y[3], factor * y[0], factor * y[1]]

    return rate


def arenstorf(lib, y):
    moon = 0.012277471
    earth = 1.0 - moon
    a, b = y[0] + moon, y[0] - earth
    d1, d2 = earth * (a * a + y[1] * y[1]) ** -1.5, moon * (b * b + y[1] * y[1]) ** -1.5
    return [y[2], y[3], y[0] + 2.0 * y[3] - d1 * a - d2 * b, y[1] - 2.0 * y[2] - (d1 + d2) * y[1]]


def chain(lib, y):
    u, v, n = y[:20], y[20:], 20
    pull = [1e6 * (u[i + 1] - u[i]) + 1e3 * (v[i + 1] - v[i]) for i in range(n - 1)] + [0.0]
    above = [u[0] * u[0] * u[0] + u[0]] + pull[:-1]
    return list(v) + [pull[i] - above[i] + 1.0 for i in range(n)]


def problems():
    half = math.pi / 2
    yield Problem("double-pendulum", double_pendulum, [half, half, 0.0, 0.0], 10.0, flat(read("reference", "double_pendulum")["T10"]["state"]))
    yield Problem("henon-heiles", henon_heiles, [0.0, 0.1, 0.49057788916725, 0.0], 100.0, flat(read("reference", "henon_heiles")["own_reference_T100"]["state"]))
    for name, r, a, mu in (("kepler-03", 13.0, 10.0, 130.0 / 7.0), ("kepler", 19.0, 10.0, 190.0), ("kepler-099", 199.0, 100.0, 19900.0)):
        start = [r, 0.0, 0.0, 1.0]
        yield Problem(name, kepler(mu), start, 20.0 * math.pi * math.sqrt(a * a * a / mu), start)
    data = read("reference", "arenstorf_of_doubles")
    yield Problem("arenstorf", arenstorf, flat(data["initial_state"]), flat(data["period"])[0], flat(data["own_reference_after_one_period"]["state"]))
    data, masses = read("reference", "pleiades"), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
    yield Problem("pleiades", attraction(masses, 2), flat(data["initial_state"]), 3.0, flat(data["own_reference_t3"]["state"]), bodies=masses, axes=2)
    data = read("reference", "outer_solar_system")
    parameters = [number(data["G"]) * number(mass) for mass in data["masses"]]
    yield Problem(
        "outer-solar-system", attraction(parameters, 3), by_components(flat(data["positions"]) + flat(data["velocities"])), 200000.0,
        by_components(flat(data["own_reference_T200000days"]["state"])), small=1e-3, bodies=parameters,
    )
    for name, file, small in (
        ("outer-solar-system-long", "outer_solar_system_long", 1e-3), ("inner-solar-system", "inner_solar_system", 1e-2), ("cluster", "cluster", 1.0)
    ):
        data = read("reference", file)
        light = data["speed_of_light"]
        yield Problem(
            name, attraction(data["parameters"], 3, light), data["initial_state"], data["end"], flat(data["state"]), small=small,
            bodies=None if light else data["parameters"],
        )
    for name, case in (("free-top", "free asymmetric top"), ("heavy-top", "heavy top of the test set")):
        case = next(each for each in read("golden", "tops")["cases"] if each["name"] == case)
        state = lambda of: flat(of["attitude"]) + flat(of["angular_velocity"])
        yield Problem(name, top(case["inertia"], case["weight_times_arm"]), state(case), case["states"][-1]["t"], state(case["states"][-1]), positions=4)
    data = read("reference", "stiff_chain")
    yield Problem("spring-chain", chain, [0.0] * 40, 10.0, flat(data["values"]), stiff=True)


def timed(run):
    began = time.perf_counter()
    state, evaluations = run()
    return time.perf_counter() - began, state, evaluations


def scipy_methods(problem):
    import numpy as np
    from scipy.integrate import solve_ivp

    if problem.bodies and problem.axes == 3:
        n, mu = len(problem.bodies), np.array(problem.bodies)

        def rate(_t, y):
            x = y[: 3 * n].reshape(3, n)
            d = x[:, None, :] - x[:, :, None]
            square = (d * d).sum(axis=0)
            np.fill_diagonal(square, 1.0)
            return np.concatenate([y[3 * n :], ((mu * square**-1.5) * d).sum(axis=2).ravel()])
    else:
        rate = lambda _t, y: problem.rate(math, y.tolist())
    names = ("Radau", "LSODA", "BDF") if problem.stiff else ("DOP853", "LSODA")
    for name in names:

        def run(tolerance, name=name):
            found = solve_ivp(
                rate, (0.0, problem.end), problem.start, name, t_eval=[problem.end], rtol=tolerance, atol=tolerance * problem.small
            )
            return found.y[:, -1].tolist(), int(found.nfev)

        yield f"SciPy 1.17, {name}", [10.0**-k for k in range(4, 14 if name == "DOP853" else 12, 2)], run


def heyoka_methods(problem):
    import heyoka as hy

    names = [f"y{i}" for i in range(len(problem.start))]
    hy.total = hy.sum
    y = [hy.expression(name) for name in names]
    rates = problem.rate(hy, y)
    system = [(a, b if isinstance(b, hy.expression) else hy.expression(b)) for a, b in zip(y, rates)]
    compact, made = len(names) > 60, {}

    def prepared(tolerance):
        if tolerance not in made:
            made[tolerance] = hy.taylor_adaptive(system, problem.start, tol=tolerance, compact_mode=compact)
        return made[tolerance]

    def run(tolerance):
        method = prepared(tolerance)
        method.time = 0.0
        method.state[:] = problem.start
        method.propagate_until(problem.end)
        return method.state.tolist(), None

    run.prepare = prepared
    yield "heyoka 7.13, Taylor", [1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15, 1e-17], run


def rebound_methods(problem):
    import ctypes

    import rebound

    if not problem.bodies:
        return
    n, axes = len(problem.bodies), problem.axes

    def bodies():
        simulation = rebound.Simulation()
        for i, mass in enumerate(problem.bodies):
            part = lambda block: [problem.start[(block * axes + k) * n + i] for k in range(axes)] + [0.0] * (3 - axes)
            (x, y, z), (u, v, w) = part(0), part(1)
            simulation.add(m=mass, x=x, y=y, z=z, vx=u, vy=v, vz=w)
        return simulation

    def end(simulation):
        particles = simulation.particles
        rows = [[p.x, p.y, p.z][:axes] + [p.vx, p.vy, p.vz][:axes] for p in particles]
        return [row[k] for k in range(2 * axes) for row in rows], None

    def ias15(tolerance):
        simulation = bodies()
        simulation.integrator = "ias15"
        simulation.ri_ias15.epsilon = tolerance
        simulation.integrate(problem.end)
        return end(simulation)

    yield "REBOUND 4.4, IAS15", [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9], ias15
    if problem.name.startswith("outer"):

        def whfast(step):
            simulation = bodies()
            simulation.integrator = "whfast"
            simulation.dt = problem.end / math.ceil(problem.end / step)
            simulation.ri_whfast.corrector, simulation.ri_whfast.safe_mode = 17, 0
            simulation.integrate(problem.end)
            rebound.clibrebound.reb_simulation_synchronize(ctypes.byref(simulation))
            return end(simulation)

        yield "REBOUND 4.4, WHFast, corrector 17", [400.0, 200.0, 100.0, 50.0, 25.0, 12.5], whfast


def measure(problem, ours, out):
    best = {}

    def record(method, parameter, error, seconds, evaluations, peer):
        key = (method, parameter)
        if key not in best or seconds < best[key]["seconds"]:
            best[key] = {
                "problem": problem.name, "method": method, "peer": peer, "parameter": parameter, "error": error, "seconds": seconds,
                "evaluations": evaluations,
            }

    peers = [entry for kind in (scipy_methods, heyoka_methods, rebound_methods) for entry in kind(problem)]
    for _ in range(ROUNDS):
        if ours:
            with tempfile.TemporaryDirectory() as folder:
                subprocess.run([ours, "--out", folder, "--filter", problem.name], check=True, capture_output=True)
                for figure in pathlib.Path(folder).glob(f"work-precision-{problem.name}.svg"):
                    shutil.copy(figure, out)
                for each in json.loads((pathlib.Path(folder) / "work-precision.json").read_text()):
                    if each["problem"] == problem.name:
                        record(each["method"], each["parameter"], each["error"], each["seconds"], each["evaluations"], each["peer"])
        for name, parameters, run in peers:
            for parameter in parameters:
                try:
                    if hasattr(run, "prepare"):
                        run.prepare(parameter)
                    seconds, state, evaluations = timed(lambda: run(parameter))
                except Exception as problem_of_peer:
                    print(f"  left out: {name} with {parameter:g}: {problem_of_peer}", flush=True)
                    continue
                if not problem.error(state) < 0.1:
                    print(f"  {name} with {parameter:g} ends elsewhere", flush=True)
                    continue
                if seconds > LONGEST:
                    break
                for _ in range(SAMPLES - 1 if seconds < 0.1 else 1):
                    seconds = min(seconds, timed(lambda: run(parameter))[0])
                record(name, parameter, problem.error(state), seconds, evaluations, True)
    return list(best.values())


def time_at(points, error):
    """The least time of a curve for an error, interpolated in logarithms between points of falling error."""
    points = sorted(points, key=lambda point: -point["error"])
    found = []
    for a, b in zip(points, points[1:]):
        if b["error"] <= error < a["error"]:
            part = math.log(a["error"] / error) / math.log(a["error"] / max(b["error"], 1e-17))
            found.append(math.exp((1.0 - part) * math.log(a["seconds"]) + part * math.log(b["seconds"])))
    if points and points[0]["error"] <= error:
        found.append(points[0]["seconds"])
    return min(found, default=None)


def table(records):
    names = list(dict.fromkeys(record["problem"] for record in records))
    print("| problem | error | the fastest of ours | time | the fastest peer | time | peer/ours |\n|---|---|---|---|---|---|---|")
    for name in names:
        curves = {}
        for each in records:
            if each["problem"] == name:
                curves.setdefault((each["peer"], each["method"]), []).append(each)
        for error in (1e-6, 1e-8, 1e-10, 1e-12):
            best = {}
            for (peer, method), points in curves.items():
                seconds = time_at(points, error)
                if seconds is not None and (peer not in best or seconds < best[peer][0]):
                    best[peer] = (seconds, method)
            show = lambda entry: f"{entry[1]} | {entry[0] * 1e6:.3g} µs" if entry else "none reaches it | –"
            ratio = f"{best[True][0] / best[False][0]:.1f}" if len(best) == 2 else "–"
            print(f"| {name} | {error:.0e} | {show(best.get(False))} | {show(best.get(True))} | {ratio} |")


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--ours")
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    options.add_argument("--problem", default="")
    options.add_argument("--table", type=pathlib.Path)
    chosen = options.parse_args()
    if chosen.table:
        table(json.loads(chosen.table.read_text()))
        return
    records = []
    for problem in problems():
        if chosen.problem in ("", problem.name):
            print(problem.name, flush=True)
            records += measure(problem, chosen.ours, chosen.out)
            by_script = ("SciPy", "heyoka", "REBOUND")
            for name, chosen_records in (
                ("work-precision.json", [record for record in records if not record["method"].startswith(by_script)]),
                ("work-precision-all.json", records),
            ):
                lines = ",\n".join(json.dumps(record, ensure_ascii=False) for record in chosen_records)
                (chosen.out / name).write_text(f"[\n{lines}\n]\n")
    table(records)


main()
