"""Optima of fluids on measured flow curves by SciPy and RheoJAX, beside `piola fit-flow`.

The sum of squares is that of `piola fit-flow`: ln(model/measured) of the stress in each row. SciPy's search by Levenberg and Marquardt over
the logarithms of the parameters starts from random points; the least sum of all is printed with the time of all starts. RheoJAX fits its
own models of the same fluids with residuals of logarithms, from its own starts; its parameters are judged by the same sum of squares, once
as they are and once after SciPy has gone downhill from there. RheoJAX is left out where it is not installed.

    pip install scipy rheojax
    taskset -c 0 python3 benches/peers/flow_fits.py data/rheology/emulsion-0.70.csv data/rheology/ethylcellulose-8.csv
"""

import csv
import sys
import time

import numpy as np
from scipy.optimize import least_squares

STARTS = 40


def read(path):
    with open(path) as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return np.array([[float(x) for x in row[:2]] for row in rows[1:]]).T


# Stress of positive parameters and the rate.
FLUIDS = {
    "power-law": (2, lambda p, k: p[0] * k ** p[1]),
    "bingham": (2, lambda p, k: p[0] + p[1] * k),
    "casson": (2, lambda p, k: (np.sqrt(p[0]) + np.sqrt(p[1] * k)) ** 2),
    "herschel-bulkley": (3, lambda p, k: p[0] + p[1] * k ** p[2]),
    "sisko": (3, lambda p, k: p[0] * k + p[1] * k ** p[2]),
    "cross": (4, lambda p, k: (p[1] + (p[0] - p[1]) / (1 + (p[2] * k) ** p[3])) * k),
    # Over logarithms: (λ k)^a overflows at a sharp transition, and a false optimum lies there.
    "carreau-yasuda": (
        5,
        lambda p, k: (p[1] + (p[0] - p[1]) * np.exp((p[3] - 1) / p[4] * np.logaddexp(0, p[4] * np.log(p[2] * k)))) * k,
    ),
}
# RheoJAX's model and the order of its parameters.
PEERS = {
    "power-law": ("PowerLaw", ["K", "n"]),
    "bingham": ("Bingham", ["sigma_y", "eta_p"]),
    "herschel-bulkley": ("HerschelBulkley", ["sigma_y", "K", "n"]),
    "cross": ("Cross", ["eta0", "eta_inf", "lambda_", "m"]),
    "carreau-yasuda": ("CarreauYasuda", ["eta0", "eta_inf", "lambda_", "n", "a"]),
}


def search(start, stress, k, tau):
    def residuals(x):
        with np.errstate(all="ignore"):
            r = np.log(stress(np.exp(x), k) / tau)
        return np.where(np.isfinite(r), r, 1e6)

    return least_squares(residuals, start, method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=20000)


def scipy_best(name, k, tau):
    count, stress = FLUIDS[name]
    rng = np.random.default_rng(1)
    eta = tau / k
    boxes = {
        2: [(tau.min(), tau.max()), (eta.min(), eta.max())],
        3: [(eta.min() if name == "sisko" else tau.min(), tau.max()), (eta.min(), eta.max()), (0.2, 1)],
        4: [(eta.min(), 2 * eta.max()), (0.01 * eta.min(), eta.min()), (1 / k.max(), 1 / k.min()), (0.3, 1.5)],
        5: [(eta.min(), 2 * eta.max()), (0.01 * eta.min(), eta.min()), (1 / k.max(), 1 / k.min()), (0.2, 0.9), (0.4, 3)],
    }
    box = [(tau.min(), tau.max()), (0.05, 1)] if name == "power-law" else boxes[count]
    found, begun = [], time.process_time()
    for _ in range(STARTS):
        start = np.array([rng.uniform(np.log(a), np.log(b)) for a, b in box])
        found.append(search(start, stress, k, tau))
    spent = time.process_time() - begun
    best = min(found, key=lambda end: end.cost)
    agree = sum(end.cost < best.cost * (1 + 1e-6) for end in found)
    return 2 * best.cost, agree, spent, np.exp(best.x)


def rheojax_best(name, k, tau):
    import rheojax.models as models

    kind, order = PEERS[name]
    times = []
    for _ in range(2):
        fit = getattr(models, kind)()
        begun = time.process_time()
        fit.fit(k, tau, test_mode="flow_curve", use_log_residuals=True)
        times.append(time.process_time() - begun)
    theta = np.array([float(fit.parameters.get_value(key)) for key in order])
    stress = FLUIDS[name][1]
    own = float(np.sum(np.log(stress(theta, k) / tau) ** 2))
    return own, 2 * search(np.log(np.maximum(theta, 1e-12)), stress, k, tau).cost, times


def main():
    for path in sys.argv[1:]:
        k, tau = read(path)
        print(f"{path}: {len(k)} rows")
        for name in FLUIDS:
            squares, agree, spent, theta = scipy_best(name, k, tau)
            print(f"  {name:17} S = {squares:.12e}  {agree}/{STARTS}  {spent:.2f} s  {[float(f'{x:.6g}') for x in theta]}")
            if name not in PEERS:
                continue
            try:
                own, after, times = rheojax_best(name, k, tau)
                print(f"  {'RheoJAX':17} S = {own:.6e}  downhill {after:.12e}  {times[0]:.1f} s, {times[1]:.2f} s")
            except Exception as why:  # noqa: BLE001 - what is not installed, or refuses, is told
                print(f"  RheoJAX: {type(why).__name__}: {why}")


main()
