"""Laws of solids against closed forms and NumPy."""

import copy
import json
import pickle
import threading

import numpy as np
import pytest

import piola

LAME, MU = 1.0, 2.0


def deformations(count, seed=0):
    """Deformation gradients with 0 < det F, near the identity."""
    generator = np.random.default_rng(seed)
    return np.eye(3) + 0.2 * generator.uniform(-1.0, 1.0, (count, 3, 3))


def saint_venant_kirchhoff(f):
    """P = F (lambda tr E 1 + 2 mu E)."""
    e = 0.5 * (np.swapaxes(f, -1, -2) @ f - np.eye(3))
    s = LAME * np.trace(e, axis1=-2, axis2=-1)[..., None, None] * np.eye(3) + 2.0 * MU * e
    return f @ s


@pytest.fixture
def law():
    return piola.Solid("saint_venant_kirchhoff", first_lame_parameter=LAME, shear_modulus=MU)


def test_stresses_are_those_of_numpy(law):
    f = deformations(1000)
    p = saint_venant_kirchhoff(f)
    j = np.linalg.det(f)[:, None, None]
    tolerance = dict(rtol=0.0, atol=1e-14 * np.abs(p).max())
    np.testing.assert_allclose(law.stress(f, "first_piola"), p, **tolerance)
    np.testing.assert_allclose(law.stress(f), p @ np.swapaxes(f, 1, 2) / j, **tolerance)
    np.testing.assert_allclose(law.stress(f, "second_piola"), np.linalg.solve(f, p), **tolerance)


def test_a_stretched_bar_is_that_of_the_book(law):
    f = np.diag([2.0, 1.0, 1.0])
    assert law.stress(f)[0, 0] == 15.0  # F11^2 (lambda + 2 mu) E11/J
    assert law.tangent(f)[0, 0, 0, 0] == 27.5  # S11 + F11^2 (lambda + 2 mu)
    assert law.tangent(f, "material")[0, 0] == 5.0
    assert law.tangent(f, "truesdell")[0, 0] == 40.0
    assert law.tangent(f, "jaumann")[0, 0] == 70.0  # 40 + 2 T11
    assert law.tangent(np.eye(3), "jaumann", voigt="abaqus")[4, 4] == MU


def test_the_tangent_is_the_derivative_of_the_stress(law):
    f = deformations(5)
    tangent = law.tangent(f)
    step = 1e-6
    for j in range(3):
        for b in range(3):
            shifted = np.zeros((3, 3))
            shifted[j, b] = step
            difference = law.stress(f + shifted, "first_piola") - law.stress(f - shifted, "first_piola")
            # Central differences of a cubic: the step squared, and rounding over the step.
            np.testing.assert_allclose(tangent[..., j, b], difference / (2.0 * step), rtol=0.0, atol=1e-8)
    np.testing.assert_array_equal(tangent, np.transpose(tangent, (0, 3, 4, 1, 2)))


def test_the_stress_is_the_derivative_of_the_energy(law):
    f = deformations(6).reshape(2, 3, 3, 3)
    assert law.energy(np.diag([2.0, 1.0, 1.0])) == 5.625  # (lambda/2 + mu) E11^2
    assert law.energy(f).shape == (2, 3)
    stress, step = law.stress(f, "first_piola"), 1e-5
    for j in range(3):
        for b in range(3):
            shifted = np.zeros((3, 3))
            shifted[j, b] = step
            difference = law.energy(f + shifted) - law.energy(f - shifted)
            # Central differences of a quartic: the step squared, and rounding over the step.
            np.testing.assert_allclose(stress[..., j, b], difference / (2.0 * step), rtol=0.0, atol=1e-8)
    out = np.empty((2, 3))
    assert law.energy(f, out=out) is out
    f[1, 2] = 0.0
    with pytest.raises(ValueError, match="1 of 6 points failed: at point 5"):
        law.energy(f)
    assert np.isnan(law.energy(f, bad_points="nan")[1, 2])
    with pytest.raises(ValueError, match="is needed"):
        law.energy(f, out=np.empty(6))


def test_stress_and_tangent_together_are_those_alone(law):
    f = deformations(300)
    stress, tangent = law.stress_and_tangent(f, ("cauchy", "jaumann"), voigt="abaqus")
    np.testing.assert_array_equal(tangent, law.tangent(f, "jaumann", voigt="abaqus"))
    np.testing.assert_allclose(stress, law.stress(f), rtol=0.0, atol=1e-14)
    outputs = np.empty((300, 3, 3)), np.empty((300, 6, 6))
    again = law.stress_and_tangent(f, ("cauchy", "jaumann"), voigt="abaqus", out=outputs)
    assert again[0] is outputs[0] and again[1] is outputs[1]
    np.testing.assert_array_equal(again[1], tangent)


def test_any_shape_and_layout_will_do(law):
    f = deformations(24).reshape(2, 3, 4, 3, 3)
    whole = law.stress(f)
    assert whole.shape == f.shape
    np.testing.assert_array_equal(law.stress(f[1, ::2]), whole[1, ::2])
    np.testing.assert_array_equal(law.stress(np.asfortranarray(f)), whole)
    np.testing.assert_array_equal(law.stress(f.tolist()), whole)
    assert law.stress(np.empty((0, 3, 3))).shape == (0, 3, 3)
    assert law.tangent(f).shape == (2, 3, 4, 3, 3, 3, 3)


def test_contiguous_arrays_are_not_copied(law):
    f, out = deformations(10), np.empty((10, 3, 3))
    f.setflags(write=False)
    assert law.stress(f, out=out) is out
    np.testing.assert_array_equal(out, law.stress(f))


def test_bad_points_are_named_and_the_others_computed(law):
    f = deformations(200)
    f[7] = 0.0
    f[130, 1, 1] = np.nan
    out = np.empty_like(f)
    with pytest.raises(ValueError, match="2 of 200 points failed: at point 7"):
        law.stress(f, out=out)
    bad = np.isnan(out).any(axis=(1, 2))
    assert list(np.flatnonzero(bad)) == [7, 130]
    again = law.stress(f, bad_points="nan")
    np.testing.assert_array_equal(again, out)
    assert list(np.flatnonzero(np.isnan(law.tangent(f, bad_points="nan")).any(axis=(1, 2, 3, 4)))) == [7, 130]


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda law: law.stress(np.eye(2)), "shape"),
        (lambda law: law.stress(np.eye(3), "pressure"), "`pressure` is no stress; there are cauchy"),
        (lambda law: law.stress(np.eye(3), out=np.empty((2, 2))), "is needed"),
        (lambda law: law.stress(np.eye(3), out=np.empty((3, 3), np.float32)), "float32"),
        (lambda law: law.stress(np.eye(3), out=np.empty((3, 6))[:, ::2]), "C order"),
        (lambda law: law.stress(np.eye(3), bad_points="ignore"), "bad_points"),
        (lambda law: law.tangent(np.eye(3), "spatial"), "first_piola, material"),
        (lambda law: law.tangent(np.eye(3), "material", voigt="ansys"), "Voigt order"),
        (lambda law: piola.Solid("cheese"), "cheese"),
        (lambda law: piola.Solid("blatz_ko", shear_modulus=1.0), "poisson_ratio"),
        (lambda law: piola.Solid("blatz_ko", shear_modulus=float("nan")), "JSON"),
        (lambda law: piola.Solid("blatz_ko", shear_modulus=1.0, poisson_ratio=0.75, solid_fraction=0.0), "ν < ½"),
        (lambda law: piola.Solid.from_values("blatz_ko", [1.0]), "takes shear_modulus, poisson_ratio"),
    ],
)
def test_what_is_wrong_is_a_value_error(law, call, says):
    with pytest.raises(ValueError, match=says):
        call(law)


def test_the_input_cannot_be_the_output(law):
    f = deformations(4)
    before = f.copy()
    with pytest.raises((ValueError, TypeError, RuntimeError)):
        law.stress(f, out=f)
    np.testing.assert_array_equal(f, before)


def test_laws_with_parts_are_written_and_read():
    gent = piola.Solid(
        "compressible",
        isochoric={"law": "gent", "shear_modulus": np.float64(1.0), "limit": 50.0},
        volumetric={"law": "simo_taylor", "bulk_modulus": 100.0},
    )
    assert gent == piola.Solid.from_values("compressible-gent-simo_taylor", [1.0, 50.0, 100.0])
    assert gent == pickle.loads(pickle.dumps(gent)) == copy.deepcopy(gent) == piola.Solid.from_json(gent.to_json())
    assert gent.parameters["isochoric"]["limit"] == 50.0 and "gent" in repr(gent)
    shear = np.eye(3)
    shear[0, 1] = 0.5
    # mu k/(1 - k^2/Jm): the pressure of volume has no share in T12.
    assert abs(gent.stress(shear)[0, 1] - 0.5 / (1.0 - 0.25 / 50.0)) < 1e-15


def test_a_law_is_shared_by_threads(law):
    f = deformations(20000)
    expected, found = law.stress(f), [None] * 4

    def run(index):
        found[index] = law.stress(f)

    threads = [threading.Thread(target=run, args=(index,)) for index in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for result in found:
        np.testing.assert_array_equal(result, expected)


def test_the_law_of_a_fit():
    stretch = np.array([1.25, 1.5, 2.0, 3.0, 4.0])
    stress = 2.0 * (stretch - stretch**-2) * (0.3 + 0.1 / stretch)
    fit = piola.fit_solid("mooney-rivlin", [{"mode": "uniaxial", "stretch": stretch, "stress": stress}])
    values = [parameter["value"] for parameter in fit["parameters"]]
    np.testing.assert_allclose(values, [0.3, 0.1], rtol=1e-12)
    assert fit["converged"] and fit["stable"]
    rubber = piola.Solid.from_fit(json.dumps(fit), volumetric={"law": "quadratic", "bulk_modulus": 1000.0})
    shear = np.eye(3)
    shear[0, 1] = 0.5
    assert abs(rubber.stress(shear)[0, 1] - 2.0 * sum(values) * 0.5) < 1e-14  # 2 (C10 + C01) k
    bounded = piola.fit_solid(
        "mooney-rivlin",
        [{"mode": "uniaxial", "stretch": stretch, "stress": stress}],
        bounds={fit["parameters"][1]["name"]: (0.0, 0.05)},
    )
    assert bounded["parameters"][1]["value"] <= 0.05
    with pytest.raises(ValueError, match="a test has no colour"):
        piola.fit_solid("yeoh", [{"mode": "uniaxial", "stretch": stretch, "stress": stress, "colour": "red"}])
    with pytest.raises(ValueError, match="not finite"):
        piola.fit_solid("yeoh", [{"mode": "uniaxial", "stretch": stretch, "stress": stress * np.nan}])
    with pytest.raises(ValueError, match="the stretch -1.5 is not positive"):
        piola.fit_solid("yeoh", [{"mode": "uniaxial", "stretch": [-1.5], "stress": [1.0]}])
    with pytest.raises(ValueError, match="cheese"):
        piola.fit_solid("cheese", [{"mode": "uniaxial", "stretch": stretch, "stress": stress}])
