"""Laws with history against closed forms, NumPy and difference quotients."""

import json
import pickle

import numpy as np
import pytest

import piola

history = getattr(piola._native, "History", None)
pytestmark = pytest.mark.skipif(history is None, reason="built without the feature `history`")

SPRING = {"law": "neo_hookean", "shear_modulus": 1.0, "volumetric": {"law": "simo_taylor", "bulk_modulus": 2.0}}
METAL = {"law": "hencky", "shear_modulus": 2.0, "volumetric": {"law": "lame", "first_lame_parameter": 3.0}}
HARDENING = {"yield_stress": 0.25, "linear": 0.125, "saturation": 0.5, "saturation_exponent": 4.0}


def shear(k):
    return np.array([[1.0, k, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])


def deformations(count, seed=0):
    return np.eye(3) + 0.2 * np.random.default_rng(seed).uniform(-1.0, 1.0, (count, 3, 3))


@pytest.fixture
def law():
    return piola.History("reese_govindjee", equilibrium=SPRING, overstress=SPRING, viscosity=0.5, bulk_fluidity=0.0)


def test_a_sheared_block_relaxes_to_the_law_at_rest(law):
    stress, state = law.advance(np.eye(3), shear(0.3), 1e-9)
    assert abs(stress[0, 1] - 0.6) < 1e-8  # 2 mu k
    before = stress[0, 1]
    for _ in range(5):
        stress, state = law.advance(shear(0.3), shear(0.3), 0.5, state)
        assert stress[0, 1] < before
        before = stress[0, 1]
    stress, state = law.advance(shear(0.3), shear(0.3), 1e6, state)
    assert abs(stress[0, 1] - 0.3) < 1e-6  # mu k


def test_a_plastic_block_bears_its_yield_stress():
    perfect = {"yield_stress": 0.01, "linear": 0.0, "saturation": 0.01, "saturation_exponent": 0.0}
    law = piola.History("viscoplastic", elastic=METAL, hardening=perfect, viscosity=0.0)
    stress, state = law.advance(np.eye(3), shear(0.1), 1.0)
    assert abs(stress[0, 1] - 0.01 / np.sqrt(3.0)) < 1e-4
    assert law.state_length == 10 and state[9] > 0.0


def test_the_consistent_tangent_is_the_derivative_of_the_stress():
    law = piola.History("kinematic", elastic=METAL, back=SPRING, hardening=HARDENING, recovery=1.5, viscosity=0.0)
    f = deformations(4) + shear(0.5) - np.eye(3)
    stress, tangent, _ = law.advance(np.eye(3), f, 0.5, None, "first_piola", tangent="first_piola")
    step = 1e-5
    for j in range(3):
        for b in range(3):
            moved = np.zeros((3, 3))
            moved[j, b] = step
            up, _ = law.advance(np.eye(3), f + moved, 0.5, None, "first_piola")
            down, _ = law.advance(np.eye(3), f - moved, 0.5, None, "first_piola")
            # Central differences: the step squared times the third derivative, and rounding over the step.
            np.testing.assert_allclose(tangent[..., j, b], (up - down) / (2.0 * step), rtol=0.0, atol=1e-7)


def test_layouts_shapes_and_outputs_agree(law):
    f = deformations(24).reshape(4, 6, 3, 3)
    with_tangent, tangent, after = law.advance(np.eye(3), f, 0.25, tangent="jaumann", voigt="abaqus")
    stress, state = law.advance(np.eye(3), f, 0.25)
    # Without a tangent other operations are done: the last bits differ.
    np.testing.assert_allclose(with_tangent, stress, rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(after, state, rtol=0.0, atol=1e-13)
    assert stress.shape == f.shape and tangent.shape == (4, 6, 6, 6) and state.shape == (4, 6, 9)
    other, columns = law.advance(np.eye(3), f, 0.25, layout="components")
    np.testing.assert_array_equal(other, stress)
    np.testing.assert_array_equal(np.moveaxis(columns, 0, -1), state)
    out = np.empty_like(stress), np.empty_like(state)
    again = law.advance(np.broadcast_to(np.eye(3), f.shape), f, 0.25, law.initial_states((4, 6)), out=out)
    assert again[0] is out[0] and again[1] is out[1]
    np.testing.assert_array_equal(out[1], state)
    alone, _ = law.advance(np.eye(3), f[2, 3], 0.25)
    np.testing.assert_array_equal(alone, stress[2, 3])


def test_laws_are_written_and_made_by_number_and_from_a_fit(law):
    assert law == pickle.loads(pickle.dumps(law)) == piola.History.from_json(law.to_json())
    name = "reese_govindjee-neo_hookean-simo_taylor-neo_hookean-simo_taylor"
    assert piola.History.from_values(name, [1.0, 2.0, 1.0, 2.0, 0.5, 0.0]) == law
    values = {"shear_modulus": 1.0, "first_lame_parameter": 2.0, "overstress_shear_modulus": 1.0}
    values |= {"overstress_first_lame_parameter": 2.0, "viscosity": 0.5}
    parameters = [{"name": name, "value": value} for name, value in values.items()]
    assert piola.History.from_fit(json.dumps({"model": "reese-govindjee", "parameters": parameters})) == law


def test_the_temperature_is_a_state_of_yours():
    expansion = {"coefficient": 1e-5, "reference_temperature": 300.0}
    law = piola.History("thermal", elastic=SPRING, expansion=expansion)
    state = law.initial_states(3)
    np.testing.assert_array_equal(state, np.full((3, 1), 300.0))
    state[:, 0] = [300.0, 400.0, 200.0]
    stress, after = law.advance(np.eye(3), np.broadcast_to(np.eye(3), (3, 3, 3)), 1.0, state)
    # -(3 lambda + 2 mu) alpha dT, to terms of the order of the strain.
    np.testing.assert_allclose(stress[:, 0, 0], [0.0, -8e-3, 8e-3], rtol=1e-2, atol=1e-14)
    np.testing.assert_array_equal(after, state)


def test_bad_points_are_named_and_the_others_advanced(law):
    f = deformations(20)
    f[7] = 0.0
    with pytest.raises(ValueError, match="1 of 20 points failed: at point 7"):
        law.advance(np.eye(3), f, 0.5)
    stress, tangent, state = law.advance(np.eye(3), f, 0.5, tangent="material", bad_points="nan")
    assert list(np.flatnonzero(np.isnan(stress).any(axis=(1, 2)))) == [7]
    assert list(np.flatnonzero(np.isnan(tangent).any(axis=(1, 2)))) == [7]
    np.testing.assert_array_equal(state[7], law.initial_states())


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda law: law.advance(np.eye(3), np.eye(3), -1.0), "0 ≤ dt"),
        (lambda law: law.advance(np.eye(3), np.eye(3), np.nan), "not finite"),
        (lambda law: law.advance(np.eye(3), np.eye(3), 1.0, np.zeros(8)), r"`state` has shape \(8,\)"),
        (lambda law: law.advance(np.eye(3), np.eye(3), 1.0, np.full(9, np.inf)), "`states before`, entry 0"),
        (lambda law: law.advance(np.eye(3), np.eye(3), 1.0, "pressure"), "could not convert"),
        (lambda law: law.advance(np.eye(3), np.eye(3), 1.0, None, "pressure"), "no stress"),
        (lambda law: law.advance(np.eye(3), np.eye(3), 1.0, tangent="spatial"), "first_piola, material"),
        (lambda law: law.advance(np.eye(3), np.eye(3), 1.0, layout="tree"), "rows, components"),
        (lambda law: law.advance(np.eye(3), np.eye(3), 1.0, tolerance=-1.0), "1e-14 ≤ tolerance"),
        (lambda law: law.advance(np.eye(3), np.eye(3), 1.0, out=(None,)), "2 are returned"),
        (lambda law: (lambda s: law.advance(np.eye(3), np.eye(3), 1.0, s, out=(None, s)))(law.initial_states()), "memory"),
        (lambda law: piola.History("cheese"), "cheese"),
        (lambda law: piola.History("in_series", first=SPRING, second=SPRING, viscosity=-1.0), "0 ≤ η"),
        (lambda law: piola.History.from_values("mullins-hencky-lame", [1.0]), "takes elastic.shear_modulus"),
    ],
)
def test_what_is_wrong_is_a_value_error(law, call, says):
    with pytest.raises(ValueError, match=says):
        call(law)
