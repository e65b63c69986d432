"""Registers pictures with a known deformation by piola and by SimpleITK; prints one table.

    pip install SimpleITK numpy
    python3 benches/peers/registration.py

For each picture of data/images, and for two phantoms, a known smooth displacement makes the fixed image from the moving one
(cubic B-spline). The phantoms are sums of eight Gaussians, with 4 samples of largest displacement along each axis; B-splines
are left out in space, where they take too long.
Each program gets the same two files. Both write x + d(x) in LPS and mm, so the fields are compared as they are.
Error: mean |d - known| over all samples, in samples. Overlap: Dice's coefficient of the parts above the mean intensity.
Time: of the registration alone, without reading and writing; the least of three runs.
"""

import os
import pathlib
import subprocess
import tempfile
import time

import numpy as np
import SimpleITK as sitk

ROOT = pathlib.Path(__file__).resolve().parents[2]
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
PICTURES = [("retina, 102 x 102", "microaneurysms.png", 4.0), ("head, 33 x 41 x 25", "anatomical.nii.gz", 3.0)]
PHANTOMS = [("phantom, 256 x 256", (256, 256), 4.0), ("phantom, 128 x 128 x 128", (128, 128, 128), 4.0)]
RUNS = 3


def phantom(sizes):
    """Eight Gaussians at places of a fixed draw, between 0 and 200."""
    draw = np.random.default_rng(1788)
    grids = np.meshgrid(*[(np.arange(n) + 0.5) / n for n in sizes], indexing="ij")
    values = sum(np.exp(-sum((g - c) ** 2 for g, c in zip(grids, centre)) / (2 * width ** 2))
                 for centre, width in zip(draw.uniform(0.2, 0.8, (8, len(sizes))), draw.uniform(0.03, 0.1, 8)))
    return sitk.GetImageFromArray(200 * values / values.max())


def known(image, amplitude):
    """The displacement field, largest `amplitude` samples along each axis, zero at the walls; arrays are [z, y, x]."""
    sizes = np.array(image.GetSize())
    grids = np.meshgrid(*[(np.arange(n) + 0.5) / n for n in sizes[::-1]], indexing="ij")
    bump = np.prod([np.sin(np.pi * g) for g in grids], axis=0)
    dimensions = len(sizes)
    parts = [bump * np.cos(2 * np.pi * grids[(axis + 1) % dimensions] + axis) for axis in range(dimensions)]
    directions = np.array(image.GetDirection()).reshape(dimensions, dimensions)
    along = [amplitude * image.GetSpacing()[axis] * parts[dimensions - 1 - axis] for axis in range(dimensions)]
    field = np.tensordot(np.stack(along, axis=-1), directions.T, axes=1)
    field = sitk.GetImageFromArray(field, isVector=True)
    field.CopyInformation(image)
    return field


def warped(image, field, interpolator=sitk.sitkLinear):
    transform = sitk.DisplacementFieldTransform(sitk.Image(sitk.Cast(field, sitk.sitkVectorFloat64)))
    # Outside the moving image its nearest value, as piola takes it.
    resampler = sitk.ResampleImageFilter()
    resampler.SetReferenceImage(image)
    resampler.SetInterpolator(interpolator)
    resampler.SetTransform(transform)
    resampler.UseNearestNeighborExtrapolatorOn()
    return resampler.Execute(image)


def demons(fixed, moving):
    """Diffeomorphic demons on three levels; fields of coarse levels are resampled."""
    field = None
    for shrink in (4, 2, 1):
        sizes = [max(1, shrink) if n // shrink >= 8 else max(1, n // 8) for n in fixed.GetSize()]
        small = [sitk.Shrink(sitk.SmoothingRecursiveGaussian(i, [0.5 * s * h for s, h in zip(sizes, i.GetSpacing())])
                             if shrink > 1 else i, sizes) for i in (fixed, moving)]
        method = sitk.DiffeomorphicDemonsRegistrationFilter()
        method.SetNumberOfIterations(100)
        method.SetSmoothDisplacementField(True)
        method.SetStandardDeviations(1.5)
        if field is None:
            field = method.Execute(*small)
        else:
            field = method.Execute(*small, sitk.Resample(field, small[0], sitk.Transform(), sitk.sitkLinear))
    return field


def splines(fixed, moving):
    """Cubic B-splines with eight cells along each axis (five in space), squares, L-BFGS-B, three levels."""
    cells = 8 if fixed.GetDimension() == 2 else 5
    transform = sitk.BSplineTransformInitializer(fixed, [cells] * fixed.GetDimension())
    method = sitk.ImageRegistrationMethod()
    method.SetMetricAsMeanSquares()
    method.SetOptimizerAsLBFGSB(numberOfIterations=50)
    method.SetInterpolator(sitk.sitkLinear)
    method.SetShrinkFactorsPerLevel([4, 2, 1])
    method.SetSmoothingSigmasPerLevel([2, 1, 0])
    method.SetInitialTransform(transform, inPlace=True)
    method.Execute(fixed, moving)
    filter_ = sitk.TransformToDisplacementFieldFilter()
    filter_.SetReferenceImage(fixed)
    return filter_.Execute(transform)


def piola(model, *levels):
    def run(fixed, moving):
        with tempfile.TemporaryDirectory() as folder:
            names = [str(pathlib.Path(folder) / name) for name in ("fixed.nii.gz", "moving.nii.gz")]
            sitk.WriteImage(fixed, names[0])
            sitk.WriteImage(moving, names[1])
            program = TARGET / "release/examples/register_files"
            said = subprocess.run([program, *names, model, folder, *levels], check=True, capture_output=True, text=True).stdout
            return sitk.ReadImage(str(pathlib.Path(folder) / "displacement.nii.gz")), float(said.split()[0])
    return run


def timed(method):
    def run(fixed, moving):
        begun = time.perf_counter()
        field = method(fixed, moving)
        return field, time.perf_counter() - begun
    return run


def main():
    subprocess.run(["cargo", "build", "--release", "--quiet", "-p", "piola-images", "--features", "rayon", "--example",
                    "register_files", "--target-dir", str(TARGET)], cwd=ROOT, check=True)
    methods = [("piola, fluid", piola("fluid")), ("piola, elastic", piola("elastic")),
               ("piola, fluid, two levels", piola("fluid", "2")), ("piola, elastic, two levels", piola("elastic", "2")),
               ("SimpleITK, diffeomorphic demons", timed(demons)), ("SimpleITK, B-splines", timed(splines))]
    print("| picture | method | mean error, samples | overlap | time, s |\n|---|---|---|---|---|")
    pictures = [(title, sitk.Cast(sitk.ReadImage(str(ROOT / "data/images" / name)), sitk.sitkFloat64), amplitude)
                for title, name, amplitude in PICTURES]
    pictures += [(title, phantom(sizes), amplitude) for title, sizes, amplitude in PHANTOMS]
    for title, moving, amplitude in pictures:
        truth = known(moving, amplitude)
        fixed = warped(moving, truth, sitk.sitkBSpline)
        exact = sitk.GetArrayFromImage(truth) / np.array(moving.GetSpacing())
        values = sitk.GetArrayFromImage(fixed)
        threshold = values.mean()

        def row(method, found, seconds):
            field = sitk.GetArrayFromImage(found) / np.array(moving.GetSpacing())
            error = np.linalg.norm(field - exact, axis=-1).mean()
            one, two = values > threshold, sitk.GetArrayFromImage(warped(moving, found)) > threshold
            overlap = 2 * np.logical_and(one, two).sum() / (one.sum() + two.sum())
            print(f"| {title} | {method} | {error:.3f} | {overlap:.4f} | {seconds} |", flush=True)

        row("none", truth - truth, "–")
        is_large = moving.GetNumberOfPixels() > 1 << 20
        for method, run in methods:
            if is_large and "B-splines" in method or "phantom" in title and "two levels" in method:
                continue
            results = [run(fixed, moving) for _ in range(1 if is_large else RUNS)]
            row(method, results[0][0], f"{min(seconds for _, seconds in results):.2f}")


if __name__ == "__main__":
    main()
