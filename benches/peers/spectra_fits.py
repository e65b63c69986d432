"""Optima of discrete relaxation spectra by SciPy and RheoJAX, beside `piola spectrum`.

The sum of squares is that of `piola spectrum --equilibrium`: model/measured - 1 of G' and G'', with an equilibrium modulus, which RheoJAX
always fits. SciPy's search by Levenberg and Marquardt starts from random times; the
least sum of all is printed with the time of all starts. RheoJAX fits its `GeneralizedMaxwell` by log residuals, its choice for data of many
decades, from its own starts; its modes are then judged by the same sum of squares, once as they are and once after SciPy has gone downhill
from there. RheoJAX is left out where it is not installed.

    pip install scipy rheojax
    taskset -c 0 python3 benches/peers/spectra_fits.py data/rheology/polystyrene-175.csv 4 6 8
"""

import csv
import sys
import time

import numpy as np
from scipy.optimize import least_squares

STARTS = 40


def read(path):
    with open(path) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return np.array([[float(x) for x in row.values()] for row in rows]).T


def model(theta, omega):
    g, t = np.exp(theta[:-1:2]), np.exp(theta[1::2])
    x = omega[:, None] * t
    d = 1 + x * x
    return np.exp(theta[-1]) + (g * (1 - 1 / d)).sum(1), (g * x / d).sum(1)


def residuals(theta, omega, storage, loss):
    a, b = model(theta, omega)
    return np.concatenate([a / storage - 1, b / loss - 1])


def jacobian(theta, omega, storage, loss):
    g, t = np.exp(theta[:-1:2]), np.exp(theta[1::2])
    x = omega[:, None] * t
    d = 1 + x * x
    slopes = np.empty((2 * len(omega), len(theta)))
    n = len(omega)
    slopes[:n, :-1:2], slopes[n:, :-1:2] = g * (1 - 1 / d) / storage[:, None], g * x / d / loss[:, None]
    slopes[:n, 1::2] = 2 * g * (1 - 1 / d) / d / storage[:, None]
    slopes[n:, 1::2] = g * x / d * (2 / d - 1) / loss[:, None]
    slopes[:n, -1], slopes[n:, -1] = np.exp(theta[-1]) / storage, 0
    return slopes


def search(start, data):
    return least_squares(residuals, start, jacobian, args=data, method="lm", xtol=1e-14, ftol=1e-14, gtol=1e-14, max_nfev=5000)


def scipy_best(modes, data):
    omega, storage, _ = data
    rng = np.random.default_rng(1)
    low, high = -np.log(omega.max()), -np.log(omega.min())
    found, begun = [], time.process_time()
    for _ in range(STARTS):
        times = np.sort(rng.uniform(low, high, modes))
        heights = np.log(storage.max() / modes) - 0.5 * (times - low)
        found.append(search(np.append(np.column_stack([heights, times]).ravel(), np.log(storage.min()) - 1), data))
    spent = time.process_time() - begun
    least = min(f.cost for f in found)
    agree = sum(f.cost < least * (1 + 1e-9) for f in found)
    return 2 * least, agree, spent


def rheojax_best(modes, data):
    from rheojax.models import GeneralizedMaxwell

    omega, storage, loss = data
    complex_modulus = storage + 1j * loss
    times = []
    for _ in range(2):
        fit = GeneralizedMaxwell(n_modes=modes)
        begun = time.process_time()
        fit.fit(omega, complex_modulus, test_mode="oscillation", use_log_residuals=True, optimization_factor=None)
        times.append(time.process_time() - begun)
    spectrum = fit.get_relaxation_spectrum()
    theta = np.append(np.column_stack([spectrum["G_i"], spectrum["tau_i"]]).ravel(), spectrum["G_inf"])
    theta = np.log(np.maximum(theta, 1e-30))
    r = residuals(theta, *data)
    return (r * r).sum(), 2 * search(theta, data).cost, times


def main():
    data = read(sys.argv[1])
    order = np.argsort(data[0])
    data = tuple(column[order] for column in data)
    print(f"{len(data[0])} rows of {sys.argv[1]}")
    for modes in map(int, sys.argv[2:]):
        least, agree, spent = scipy_best(modes, data)
        print(f"{modes} modes: SciPy S = {least:.12g}, {agree} of {STARTS} starts agree, {spent:.2f} s")
        try:
            as_it_is, downhill, times = rheojax_best(modes, data)
        except ImportError as error:
            print(f"  RheoJAX is left out: {error}")
            continue
        print(f"  RheoJAX S = {as_it_is:.6g}, downhill from there {downhill:.12g}; {times[0]:.2f} s, again {times[1]:.2f} s")


main()
