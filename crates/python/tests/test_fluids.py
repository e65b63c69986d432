"""Fluids, flows and fits against closed forms."""

import pickle

import numpy as np
import pytest

import piola


def test_viscometric_functions_are_those_of_the_fluid():
    melt = piola.Fluid("oldroyd_b", solvent_viscosity=1.0, polymer_viscosity=3.0, time=0.5)
    rates = np.array([[0.0, 2.0], [-2.0, 4.0]])
    np.testing.assert_array_equal(melt.shear_stress(rates), 4.0 * rates)
    np.testing.assert_array_equal(melt.viscosity(rates), np.full((2, 2), 4.0))
    np.testing.assert_array_equal(melt.first_normal_stress_difference(rates), 3.0 * rates**2)  # 2 eta_p lambda k^2
    np.testing.assert_array_equal(melt.second_normal_stress_difference(rates), np.zeros((2, 2)))
    np.testing.assert_array_equal(melt.shear_rate(4.0 * rates), rates)
    assert melt.shear_stress(2.0).shape == ()
    assert melt == pickle.loads(pickle.dumps(melt)) and melt.yield_stress == 0.0


def test_a_pipe_is_that_of_hagen_and_poiseuille():
    oil = piola.Fluid("newtonian", viscosity_coefficient=0.5)
    pipe = piola.Pipe(oil, 2.0, pressure_gradient=3.0)
    assert abs(pipe.discharge - 12.0 * np.pi) <= pipe.error  # pi c R^4/(8 mu)
    r = np.linspace(0.0, 2.0, 11)
    np.testing.assert_allclose(pipe.velocity(r), 3.0 * (4.0 - r**2) / 2.0, rtol=0.0, atol=1e-14)
    back = piola.Pipe(oil, 2.0, discharge=12.0 * np.pi)
    assert abs(back.pressure_gradient - 3.0) <= back.error


def test_coaxial_cylinders_are_those_of_couette():
    oil = piola.Fluid("newtonian", viscosity_coefficient=0.5)
    flow = piola.Couette(oil, 1.0, 2.0, moment=8.0 * np.pi)
    assert abs(flow.speed_difference - 3.0) <= flow.error
    r = np.linspace(1.0, 2.0, 5)
    np.testing.assert_allclose(flow.angular_velocity(r), 4.0 * (1.0 - r**-2), rtol=0.0, atol=1e-14)
    back = piola.Couette(oil, 1.0, 2.0, speed_difference=3.0)
    assert abs(back.moment - 8.0 * np.pi) <= back.error


def test_a_plug_moves_in_a_pipe_of_mud():
    mud = piola.Fluid("bingham", yield_stress=3.0, plastic_viscosity=0.5)
    velocities = piola.Pipe(mud, 2.0, pressure_gradient=6.0).velocity([0.0, 0.5, 1.0, 2.0])
    np.testing.assert_allclose(velocities, [3.0, 3.0, 3.0, 0.0], atol=1e-14)  # (tau_w - tau_y)^2/(c mu)
    assert mud.yield_stress == 3.0


def test_a_flow_curve_gives_its_fluid():
    rates = np.array([1.0, 4.0, 9.0, 100.0])
    fluid, fit = piola.fit_fluid("power_law", rates, 3.0 * np.sqrt(rates), start=[1.0, 1.0])
    values = [parameter["value"] for parameter in fit["parameters"]]
    np.testing.assert_allclose(values, [3.0, 0.5], rtol=1e-10)
    assert fit["converged"] and fluid.parameters["fluid"] == "power_law"
    np.testing.assert_allclose(fluid.shear_stress(4.0), 6.0, rtol=1e-10)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda oil: piola.Fluid("cheese"), "cheese"),
        (lambda oil: piola.Fluid("newtonian", viscosity_coefficient=-1.0), "violates 0 < μ"),
        (lambda oil: oil.shear_stress([1.0, np.inf]), "entry 1: inf is not finite"),
        (lambda oil: piola.Pipe(oil, -1.0, pressure_gradient=1.0), "0 < R"),
        (lambda oil: piola.Pipe(oil, 1.0), "give either"),
        (lambda oil: piola.Pipe(oil, 1.0, pressure_gradient=1.0).velocity(2.0), "r"),
        (lambda oil: piola.Couette(oil, 2.0, 1.0, moment=1.0), "R₁ < R₂"),
        (lambda oil: piola.fit_fluid("cheese", [1.0], [1.0], [1.0]), "no fluid that can be fitted"),
        (lambda oil: piola.fit_fluid("power_law", [1.0, 2.0], [1.0, 2.0], [1.0]), "must be 2"),
        (lambda oil: piola.fit_fluid("power_law", [1.0, 2.0], [1.0], [1.0, 1.0]), "shape"),
    ],
)
def test_what_is_wrong_is_a_value_error(call, says):
    with pytest.raises(ValueError, match=says):
        call(piola.Fluid("newtonian", viscosity_coefficient=0.5))
