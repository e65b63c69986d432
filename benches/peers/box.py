"""Static solutions on a cube of cells: piola beside SciPy, and beside other ways in Rust; prints tables.

    pip install scipy numpy
    python3 benches/peers/box.py [--out FOLDER]

The displacement is smooth and obeys the sliding walls; its force is known in closed form, so every error is a true one.
SciPy: `scipy.fft.dct` and `dst` of type II along each axis, one 3 x 3 solution for each wave vector in numpy, and back.
The least time of several runs: first all sizes by the Rust program, then all by SciPy, in one call of this script.
"""

import json
import os
import pathlib
import subprocess
import sys
import time

import numpy as np
from scipy import fft

ROOT = pathlib.Path(__file__).resolve().parents[2]
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
FIRST, SHEAR = 1.5, 0.75
SIZES = [32, 64, 128, 256]


def factors(x):
    s, c = np.sin(np.pi * x), np.cos(np.pi * x)
    e, b = np.exp(c), np.exp(0.5 * c)
    p = np.pi
    return [[s * e, p * (c - s * s) * e, p * p * e * s * (s * s - 1 - 3 * c)],
            [b, -0.5 * p * s * b, p * p * b * (0.25 * s * s - 0.5 * c)]]


def derivative(table, component, orders):
    parts = [table[axis != component][orders[axis]] for axis in range(3)]
    return parts[0][:, None, None] * parts[1][None, :, None] * parts[2][None, None, :]


def force(n):
    table = factors((np.arange(n) + 0.5) / n)
    unit = np.eye(3, dtype=int)
    fields = []
    for c in range(3):
        laplacian = sum(derivative(table, c, 2 * unit[axis]) for axis in range(3))
        dilatation = sum(derivative(table, other, unit[other] + unit[c]) for other in range(3))
        fields.append(-SHEAR * laplacian - (FIRST + SHEAR) * dilatation)
    return fields


def displacement(n):
    table = factors((np.arange(n) + 0.5) / n)
    return [derivative(table, c, [0, 0, 0]) for c in range(3)]


def solve(fields, waves, workers):
    """Sines of a component stand one place lower than their wave number: all are set into arrays of n + 1 wave numbers."""
    n = fields[0].shape[0]
    modes = []
    for c, field in enumerate(fields):
        for axis in range(3):
            transform = fft.dst if axis == c else fft.dct
            field = transform(field, type=2, axis=axis, overwrite_x=axis > 0, workers=workers)
        padded = np.zeros((n + 1,) * 3)
        padded[tuple(slice(1, None) if axis == c else slice(0, n) for axis in range(3))] = field
        modes.append(padded)
    squared, q = waves
    along = (FIRST + SHEAR) / (FIRST + 2 * SHEAR) * sum(q[c] * modes[c] for c in range(3)) / squared
    for c in range(3):
        mode = ((modes[c] - q[c] * along) / (SHEAR * squared))[
            tuple(slice(1, None) if axis == c else slice(0, n) for axis in range(3))]
        for axis in range(3):
            transform = fft.idst if axis == c else fft.idct
            mode = transform(mode, type=2, axis=axis, overwrite_x=True, workers=workers)
        modes[c] = mode
    return modes


def scipy_rows(n):
    q = [np.pi * np.arange(n + 1).reshape([-1 if axis == c else 1 for axis in range(3)]) for c in range(3)]
    squared = q[0] ** 2 + q[1] ** 2 + q[2] ** 2
    squared[0, 0, 0] = 1.0
    exact = displacement(n)
    size = np.sqrt(sum((field ** 2).sum() for field in exact))
    for workers in (1, 2):
        best, spent, rounds = np.inf, 0.0, 0
        while rounds < 3 or spent < 0.5:
            fields = force(n) if rounds == 0 else [field.copy() for field in start]
            start = fields if rounds else [field.copy() for field in fields]
            begun = time.perf_counter()
            solution = solve(fields, (squared, q), workers)
            took = time.perf_counter() - begun
            best, spent, rounds = min(best, took), spent + took, rounds + 1
        error = np.sqrt(sum(((a - b) ** 2).sum() for a, b in zip(solution, exact))) / size
        yield {"way": "scipy", "points": n, "threads": workers, "seconds": best, "error": error,
               "gigabytes_per_second": 48.0 * n ** 3 / best / 1e9}


def time_text(seconds):
    return f"{seconds:.3f} s" if seconds >= 0.1 else f"{1e3 * seconds:.2f} ms" if seconds >= 1e-3 else f"{1e6 * seconds:.1f} µs"


def main():
    out = sys.argv[2] if sys.argv[1:2] == ["--out"] else None
    subprocess.run(["cargo", "build", "--quiet", "--release", "--package", "piola-benches", "--bin", "box-accuracy"],
                   cwd=ROOT, check=True)
    command = [TARGET / "release" / "box-accuracy"] + (["--out", out] if out else [])
    lines = subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE).stdout.splitlines()
    rows = [json.loads(line) for line in lines]
    for n in SIZES:
        rows.extend(scipy_rows(n))
    print("| cells | way | threads | time | GB/s | relative error |\n|---|---|---|---|---|---|")
    for n in SIZES:
        for way in ("piola f64", "piola f32", "rustdct", "realfft", "scipy"):
            for row in (row for row in rows if row["points"] == n and row["way"] == way):
                print(f"| {n}³ | {way} | {row['threads']} | {time_text(row['seconds'])} "
                      f"| {row['gigabytes_per_second']:.2f} | {row['error']:.1e} |")
    print("\n| differences: cells | error | time | piola: cells | error | time | ratio of times |\n|---|---|---|---|---|---|---|")
    ours = [row for row in rows if row["way"] == "piola f64" and row["threads"] == 1]
    for row in (row for row in rows if row["way"] == "differences"):
        equal = next(our for our in ours if our["error"] <= row["error"])
        print(f"| {row['points']}³ | {row['error']:.1e} | {time_text(row['seconds'])} | {equal['points']}³ "
              f"| {equal['error']:.1e} | {time_text(equal['seconds'])} | {row['seconds'] / equal['seconds']:.0f} |")
    print("\n| cells | relative error |\n|---|---|")
    for row in ours:
        print(f"| {row['points']}³ | {row['error']:.1e} |")


main()
