//! Homogeneous tests against closed forms.

use piola_continuum::{Deformation, DisplacementGradient};
use piola_numerics::{Dual, Gradient, Real};
use piola_solids::{Hyperelastic, MooneyRivlin};
use piola_specimens::SpecimensError;
use piola_specimens::homogeneous::{
    Control, Controls, Incompressible, IncompressibleState, Mode, equibiaxial, equilibrium, first_piola,
    first_piola_and_slope, planar, simple_shear, uniaxial, volumetric,
};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

const STRESS: Tol = Tol::stated(1e-13, "stresses of ordinary and of small strains");

fn rubber() -> MooneyRivlin {
    MooneyRivlin::stress_free(0.37, 0.11, 2.0).expect("parameters")
}

/// The same energy in stretches, its parameters over any scalar.
struct InStretches<T> {
    c10: T,
    c01: T,
}

impl<T: Real> Incompressible<T> for InStretches<T> {
    fn energy_of_stretches(&self, stretches: [Dual<T>; 3]) -> Dual<T> {
        let squares = stretches.map(|x| x * x);
        let first = squares[0] + squares[1] + squares[2];
        let second = squares[0].recip() + squares[1].recip() + squares[2].recip();
        Dual::constant(self.c10) * first + Dual::constant(self.c01) * second
    }
}

/// The closed forms of the textbooks, factored so that nothing cancels but λ − 1, which is exact.
fn closed(mode: Mode, x: f64) -> f64 {
    let (c10, c01) = (0.37, 0.11);
    let e = x - 1.0;
    match mode {
        Mode::Uniaxial => 2.0 * (e * (x * x + x + 1.0) / (x * x)) * (c10 + c01 / x),
        // λ − λ⁻⁵ = (λ⁶ − 1)/λ⁵
        Mode::Equibiaxial => {
            let sixth = e * (x + 1.0) * (x.powi(4) + x * x + 1.0) / x.powi(5);
            2.0 * sixth * (c10 + c01 * x * x)
        }
        Mode::Planar => 2.0 * (e * (x + 1.0) * (x * x + 1.0) / x.powi(3)) * (c10 + c01),
        Mode::SimpleShear => 2.0 * x * (c10 + c01),
    }
}

fn stretches(mode: Mode) -> impl Iterator<Item = f64> {
    let amounts = (1..=15).flat_map(|k| [10.0_f64.powi(-k), -(10.0_f64.powi(-k))]).chain([0.5, -0.5, 1.5, 4.0, 6.5]);
    amounts.map(move |amount| mode.rest() + amount).filter(move |&x| 0.0 < (x - mode.rest()).abs())
}

#[test]
fn mooney_rivlin_equals_the_closed_forms_at_small_and_large_strain() {
    for mode in Mode::ALL {
        for x in stretches(mode) {
            let stress = first_piola(mode, x, &rubber());
            assert_close(&format!("{} {x:e}", mode.name()), &[stress], &[closed(mode, x)], STRESS);
            let state = IncompressibleState::of(&rubber(), mode, x).expect("state");
            let place = if mode == Mode::SimpleShear { (1, 0) } else { (0, 0) };
            assert_close(&format!("{} {x:e}: state", mode.name()), &[state.first_piola.0[place]], &[stress], STRESS);
        }
    }
}

#[test]
fn energies_of_stretches_give_the_stress_and_its_derivatives_by_parameters() {
    for mode in Mode::ALL {
        for x in stretches(mode) {
            let law = InStretches { c10: Gradient::<f64, 2>::variable(0.37, 0), c01: Gradient::variable(0.11, 1) };
            let stress = first_piola(mode, Gradient::constant(x), &law);
            let rounding = Tol::ulps(64.0);
            // Only the sum is accurate to the moduli.
            assert_close_at_scale(mode.name(), &[stress.value], &[closed(mode, x)], 1.0 + x.abs().powi(3), rounding);
            // The stress is linear in the parameters: P = Σ c ∂P/∂c.
            let sum = 0.37 * stress.partials[0] + 0.11 * stress.partials[1];
            assert_close_at_scale(mode.name(), &[sum], &[stress.value], 1.0 + x.abs().powi(3), rounding);
        }
    }
}

#[test]
fn slope_equals_the_slope_of_the_closed_form() {
    for mode in Mode::ALL {
        for x in [mode.rest(), mode.rest() + 0.7] {
            let (stress, slope) = first_piola_and_slope(mode, x, &rubber());
            let along = |h: f64| closed(mode, x + h);
            // Richardson's differences of the closed form.
            let difference = |h: f64| (along(h) - along(-h)) / (2.0 * h);
            let expected = (4.0 * difference(5e-4) - difference(1e-3)) / 3.0;
            assert_close_at_scale("P", &[stress], &[closed(mode, x)], 1.0, STRESS);
            assert_close("dP/dλ", &[slope], &[expected], Tol::stated(1e-10, "differences of fourth order, h = 1e-3"));
        }
    }
}

#[test]
fn bad_stretches_are_refused() {
    for mode in [Mode::Uniaxial, Mode::Equibiaxial, Mode::Planar] {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(IncompressibleState::of(&rubber(), mode, bad).is_err(), "{} {bad}", mode.name());
        }
    }
}

/// The compressible solid's axial and lateral stress in stretches.
fn principal(law: &MooneyRivlin, [a, b, c]: [f64; 3]) -> f64 {
    // ∂W/∂λ₁ = 2 C₁₀ λ₁ + 2 C₀₁ λ₁ (λ₂² + λ₃²) + (2 c J² − d)/λ₁
    let jacobian = a * b * c;
    2.0 * law.c10() * a
        + 2.0 * law.c01() * a * (b * b + c * c)
        + (2.0 * law.square_coefficient() * jacobian * jacobian - law.logarithm_coefficient()) / a
}

#[test]
fn free_faces_carry_no_traction_and_the_axial_stress_is_that_of_the_stretches() {
    let law = rubber();
    for stretch in [0.05, 0.3, 0.9, 1.0, 1.1, 2.0, 6.0, 30.0] {
        for state in [uniaxial(&law, stretch), equibiaxial(&law, stretch), planar(&law, stretch)] {
            let state = state.expect("state");
            let f = state.deformation.gradient_rows();
            let [a, b, c] = [f[0][0], f[1][1], f[2][2]];
            let scale = 1.0 + a * a * a;
            let rounding = Tol::ulps(64.0);
            assert_close_at_scale("P₃₃", &[principal(&law, [c, a, b])], &[0.0], scale, rounding);
            let axial = principal(&law, [a, b, c]);
            assert_close_at_scale("P₁₁", &[state.first_piola.0[(0, 0)]], &[axial], scale, rounding);
            let end = Tol::stated(1e-10, "a residual with which Newton's method may end");
            assert!(state.residual <= end.value() * scale && state.iterations < 40, "{stretch}: {state:?}");
        }
    }
}

#[test]
fn small_tests_equal_linear_elasticity() {
    let law = rubber();
    let (mu, lambda) = (law.shear_modulus(), 4.0 * law.c01() + 4.0 * law.square_coefficient());
    let ratio = lambda / (2.0 * (lambda + mu));
    for k in 6..=15 {
        let e = 10.0_f64.powi(-k);
        let controls = Controls::axial([Control::Displacement(e), Control::FREE, Control::FREE]).expect("controls");
        let bar = equilibrium(&law, &controls, &DisplacementGradient::zero()).expect("state");
        let linear = Tol::order(10.0 * e, 1).times(1.0 + 1e-12 / e);
        assert_close("ν", &[-bar.deformation.matrix()[(1, 1)] / e], &[ratio], linear);
        assert_close("E", &[bar.first_piola.0[(0, 0)] / e], &[2.0 * mu * (1.0 + ratio)], linear);
    }
}

#[test]
fn volumetric_stress_equals_the_derivative_of_the_energy_by_volume() {
    let law = rubber();
    for jacobian in [0.2_f64, 0.9, 1.0, 1.3, 4.0] {
        let state = volumetric(&law, jacobian).expect("state");
        // T = dW/dJ of W(J^(⅓) 1).
        let l = jacobian.cbrt();
        let expected = principal(&law, [l, l, l]) / (l * l);
        let cauchy = state.cauchy.0.components;
        assert_close_at_scale("T", &cauchy[..3], &[expected; 3], 5.0, Tol::ulps(32.0));
        assert_eq!(state.iterations, 0, "nothing is free");
    }
}

#[test]
fn mixed_controls_recover_the_deformation_that_made_the_stresses() {
    let law = rubber();
    let target = DisplacementGradient::from_rows([[0.4, 0.1, -0.2], [0.0, -0.2, 0.3], [0.0, 0.0, 0.25]]).expect("F");
    let first_piola = law.first_piola(&target);
    let cauchy = law.cauchy(&target).0.rows();
    // Stresses on and above the diagonal; below it F is that of the target, which fixes the rotation.
    for spatial in [false, true] {
        let components = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                if j < i {
                    Control::HELD
                } else if spatial {
                    Control::Cauchy(cauchy[i][j])
                } else {
                    Control::FirstPiola(first_piola.0[(i, j)])
                }
            })
        });
        let controls = Controls::new(components).expect("controls");
        let state = equilibrium(&law, &controls, &DisplacementGradient::zero()).expect("state");
        let found = state.deformation.displacement_rows();
        let expected = target.displacement_rows();
        assert_close("∇u", found.as_flattened(), expected.as_flattened(), Tol::stated(1e-12, "end of the iteration"));
    }
}

#[test]
fn sheared_block_with_free_faces_becomes_thinner_or_thicker_until_no_traction_is_left() {
    let law = rubber();
    let held = simple_shear(&law, 0.8, false).expect("state");
    assert_close("T₂₁", &[held.cauchy.0.components[3]], &[law.shear_modulus() * 0.8], Tol::ulps(16.0));
    let free = simple_shear(&law, 0.8, true).expect("state");
    assert_close_at_scale("P₃₃", &[free.first_piola.0[(2, 2)]], &[0.0], 4.0, Tol::ulps(64.0));
    assert!(free.deformation.matrix()[(2, 2)].abs() > 1e-3);
}

#[test]
fn impossible_loads_and_free_rotations_are_named() {
    let law = rubber();
    // All nine tractions given: the body may turn.
    let all_free = Controls::new([[Control::FREE; 3]; 3]).expect("controls");
    let error = equilibrium(&law, &all_free, &DisplacementGradient::zero()).expect_err("a rotation is free");
    assert!(matches!(error, SpecimensError::Indeterminate { .. }), "{error}");
    // T₁₁ falls without bound only towards det F = 0: a bar that is flattened.
    let inside_out = Controls::axial([Control::Displacement(-1.5), Control::FREE, Control::FREE]).expect("controls");
    let error = equilibrium(&law, &inside_out, &DisplacementGradient::zero()).expect_err("λ < 0");
    let SpecimensError::NotConverged { share, gradient, .. } = error else { panic!("{error}") };
    assert!(share < 1.0 / 1.5 && 0.0 < gradient[0][0], "{share}");
    assert!(Controls::uniaxial(f64::NAN).is_err());
}
