//! Incompressible laws in mixed control: the pressure as an unknown, against closed forms and against pressures eliminated.

use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_solids::isochoric::{Gent, MooneyRivlin};
use piola_solids::{
    Fibre, Hencky, HolzapfelGasserOgden, Hyperelastic, IncompressibleOgden, IncompressibleSolid, Ogden, OgdenTerm,
    Pressurised, ReinforcedNeoHookean, derived,
};
use piola_specimens::homogeneous::{
    Control, Controls, IncompressibleState, Mode, equibiaxial, equilibrium, first_piola, first_piola_and_slope, planar,
    simple_shear, uniaxial,
};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

const NEWTON: Tol = Tol::stated(1e-13, "corrections below 1e-11 of ∇u, with convergence of second order");

fn rubber() -> IncompressibleSolid<MooneyRivlin> {
    IncompressibleSolid::new(MooneyRivlin::new(0.37, 0.11).expect("parameters"))
}

/// Two families of fibres about axis 1.
fn wall() -> HolzapfelGasserOgden {
    let fibres = [Fibre::in_plane(0.6).expect("fibre"), Fibre::in_plane(-0.6).expect("fibre")];
    HolzapfelGasserOgden::new(1.0, 50.0, 2.0, 1.0, 0.0, fibres).expect("parameters")
}

/// P₁₁ of the textbooks.
fn closed(mode: Mode, x: f64) -> f64 {
    let (c10, c01) = (0.37, 0.11);
    match mode {
        Mode::Uniaxial => 2.0 * (x - x.powi(-2)) * (c10 + c01 / x),
        Mode::Equibiaxial => 2.0 * (x - x.powi(-5)) * (c10 + c01 * x * x),
        Mode::Planar => 2.0 * (x - x.powi(-3)) * (c10 + c01),
        Mode::SimpleShear => 2.0 * x * (c10 + c01),
    }
}

#[test]
fn stretched_bodies_carry_the_stress_of_the_closed_forms() {
    // The pressure that the law has already makes no difference.
    for law in [rubber(), rubber().at_pressure(0.3).expect("p"), rubber().at_excess_pressure(-0.2).expect("q")] {
        for x in [0.3, 0.9, 1.0 + 1e-9, 1.5, 2.0, 6.5] {
            let states = [uniaxial(&law, x), equibiaxial(&law, x), planar(&law, x), simple_shear(&law, x, true)];
            for (mode, state) in Mode::ALL.into_iter().zip(states) {
                let state = state.unwrap_or_else(|error| panic!("{mode:?} {x}: {error}"));
                let place = if mode == Mode::SimpleShear { (1, 0) } else { (0, 0) };
                let scale = 1.0 + x.powi(3) + x.powi(-6);
                assert_close_at_scale("P", &[state.first_piola.0[place]], &[closed(mode, x)], scale, NEWTON);
                assert_close_at_scale("P₃₃", &[state.first_piola.0[(2, 2)]], &[0.0], scale, NEWTON);
                assert_close_at_scale("J − 1", &[state.deformation.volume_change()], &[0.0], 1.0, Tol::ulps(64.0));
            }
        }
    }
}

#[test]
fn bodies_under_forces_find_the_stretch_that_carries_them() {
    let (free, start) = (Control::FREE, DisplacementGradient::zero());
    for x in [0.4, 0.8, 1.0 + 1e-10, 1.2, 2.0, 5.0] {
        let pulled = Control::FirstPiola(closed(Mode::Uniaxial, x));
        let bar = equilibrium(&rubber(), &Controls::axial([pulled, free, free]).expect("controls"), &start);
        let bar = bar.unwrap_or_else(|error| panic!("{x}: {error}"));
        let tolerance = NEWTON.times(8.0);
        assert_close("λ", &[bar.deformation.gradient_rows()[0][0]], &[x], tolerance);
        let stress = Control::Cauchy(closed(Mode::Uniaxial, x) * x);
        let bar = equilibrium(&rubber(), &Controls::axial([stress, free, free]).expect("controls"), &start);
        let bar = bar.unwrap_or_else(|error| panic!("{x}: {error}"));
        assert_close("λ by T", &[bar.deformation.gradient_rows()[0][0]], &[x], tolerance);
        let pulled = Control::FirstPiola(closed(Mode::Equibiaxial, x));
        let sheet = equilibrium(&rubber(), &Controls::axial([pulled, pulled, free]).expect("controls"), &start);
        let sheet = sheet.unwrap_or_else(|error| panic!("{x}: {error}"));
        let f = sheet.deformation.gradient_rows();
        assert_close("λ of a sheet", &[f[0][0], f[1][1]], &[x, x], tolerance);
    }
    // A fluid pressure on all faces moves nothing and is the pressure.
    let pressed = Controls::axial([Control::FirstPiola(-3.0); 3]).expect("controls");
    let state = equilibrium(&rubber(), &pressed, &start).expect("state");
    assert_close_at_scale("∇u", state.deformation.matrix().as_slice(), &[0.0; 9], 1.0, Tol::ulps(64.0));
    assert_close("p", &[state.pressure], &[3.0], Tol::ulps(64.0));
}

#[test]
fn limits_of_the_chains_are_kept_on_the_way() {
    let law = IncompressibleSolid::new(Gent::new(0.8, 3.0).expect("parameters"));
    let pulled = Controls::axial([Control::FirstPiola(40.0), Control::FREE, Control::FREE]).expect("controls");
    let bar = equilibrium(&law, &pulled, &DisplacementGradient::zero()).expect("state");
    let x = bar.deformation.gradient_rows()[0][0];
    let first = x * x + 2.0 / x - 3.0;
    assert!(0.9 * 3.0 < first && first < 3.0, "{first}");
    assert_close("P", &[0.8 * (x - x.powi(-2)) / (1.0 - first / 3.0)], &[40.0], Tol::stated(1e-10, "near the limit"));
}

#[test]
fn bulk_modulus_of_a_pressurised_law_says_nothing() {
    let terms = [OgdenTerm { modulus: 0.63, exponent: 1.3 }, OgdenTerm { modulus: -0.01, exponent: -2.0 }];
    let expected = IncompressibleOgden::new(&terms).expect("terms");
    for kappa in [0.1, 2.0, 1e4] {
        let law = Pressurised::new(Ogden::new(&terms, kappa).expect("terms"));
        for (mode, x) in [(Mode::Uniaxial, 2.0), (Mode::Equibiaxial, 0.7), (Mode::Planar, 1.4)] {
            let state = match mode {
                Mode::Uniaxial => uniaxial(&law, x),
                Mode::Equibiaxial => equibiaxial(&law, x),
                _ => planar(&law, x),
            };
            let stress: f64 = first_piola(mode, x, &expected);
            let state = state.expect("state");
            let tolerance = Tol::stated(1e-12, "J − 1 to rounding").times(1.0 + kappa);
            assert_close(mode.name(), &[state.first_piola.0[(0, 0)]], &[stress], tolerance);
            assert_close(mode.name(), &[first_piola(mode, x, &law)], &[stress], tolerance);
        }
    }
    // Hencky's bar: T = 3 μ ln λ.
    let bar = uniaxial(&Pressurised::new(Hencky::new(7.0, 0.5).expect("parameters")), 1.7).expect("state");
    assert_close("T", &[bar.cauchy.0.components[0]], &[1.5 * 1.7_f64.ln()], NEWTON);
}

#[test]
fn stress_and_tangent_at_a_pressure_equal_derivatives_of_the_energy() {
    let laws =
        [Pressurised::new(wall()).at_pressure(0.7).expect("p"), Pressurised::new(wall()).at_pressure(-3.0).expect("p")];
    let f = DeformationGradient::from_rows([[1.3, 0.2, 0.1], [-0.1, 0.9, 0.3], [0.0, 0.2, 1.0]]).expect("F");
    for law in &laws {
        let tolerance = Tol::stated(1e-13, "closed forms against exact derivatives");
        let (stress, tangent) = law.first_piola_and_tangent(&f);
        assert_close("P", stress.0.as_slice(), derived::first_piola(law, &f).0.as_slice(), tolerance);
        let expected = derived::first_piola_tangent(law, &f).0.components;
        assert_close("∂P/∂F", tangent.0.components.as_flattened(), expected.as_flattened(), tolerance);
        let alone = law.first_piola_tangent(&f).0.components;
        assert_close("∂P/∂F alone", alone.as_flattened(), expected.as_flattened(), tolerance);
        let cauchy = stress.cauchy(&f).0.components;
        assert_close("T", &law.cauchy(&f).0.components, &cauchy, tolerance);
        assert_close("τ", &law.kirchhoff(&f).0.components, &cauchy.map(|x| x * f.jacobian()), tolerance);
    }
}

#[test]
fn sides_of_an_anisotropic_bar_are_free() {
    // The last corrections are below 1e-11 of ∇u: what convergence of second order leaves is rounding.
    const ROUNDING: Tol = Tol::ulps(32.0);
    let law = wall();
    for x in [0.8, 1.0 + 1e-8, 1.1, 1.3, 1.6] {
        let state = IncompressibleState::of(&law, Mode::Uniaxial, x).unwrap_or_else(|error| panic!("{x}: {error}"));
        let stress = state.cauchy.0.components;
        assert_close_at_scale("T₂₂, T₃₃", &stress[1..3], &[0.0; 2], stress[0].abs(), ROUNDING);
        // The same by Newton's method for all of F and the pressure.
        let bar = uniaxial(&Pressurised::new(law), x).unwrap_or_else(|error| panic!("{x}: {error}"));
        let (found, expected) = (bar.deformation.matrix(), state.deformation.matrix());
        assert_close("∇u", found.as_slice(), expected.as_slice(), ROUNDING);
        let cauchy = bar.cauchy.0.components;
        assert_close("T₁₁", &cauchy[..1], &stress[..1], ROUNDING);
        assert_close_at_scale("T₂₂, T₃₃ of the bar", &cauchy[1..3], &[0.0; 2], stress[0].abs(), ROUNDING);
        assert_close("P", &[first_piola(Mode::Uniaxial, x, &law)], &[state.first_piola.0[(0, 0)]], ROUNDING);
        if 1.0 + 1e-3 < x {
            let f = state.deformation.gradient_rows();
            assert!(1e-3 < (f[1][1] - f[2][2]).abs(), "fibres hold one side: {f:?}");
        }
    }
}

#[test]
fn slope_of_an_anisotropic_bar_equals_differences_of_its_stress() {
    let law = ReinforcedNeoHookean::new(1.0, 2.0, 3.0, Fibre::new([0.0, 1.0, 0.0]).expect("axis")).expect("parameters");
    for x in [0.8, 1.0, 1.3] {
        let (stress, slope) = first_piola_and_slope(Mode::Uniaxial, x, &law);
        let at = |h: f64| first_piola(Mode::Uniaxial, x + h, &law);
        let difference = |h: f64| (at(h) - at(-h)) / (2.0 * h);
        let expected = (4.0 * difference(1e-3) - difference(2e-3)) / 3.0;
        assert_close_at_scale("P", &[stress], &[at(0.0)], 1.0, NEWTON);
        // Across a bar that is pressed fibres are stretched: the curvature of their energy does not jump here.
        assert_close("dP/dλ", &[slope], &[expected], Tol::stated(1e-8, "differences of fourth order, h = 1e-3"));
    }
}

#[test]
fn a_sheet_held_along_one_axis_equals_planar_tension() {
    let rubber = piola_solids::MooneyRivlin::stress_free(0.5, 0.25, 1.0).expect("parameters");
    let sheet = IncompressibleState::biaxial(&rubber, [2.0, 1.0]).expect("stretches");
    assert_eq!(sheet, IncompressibleState::of(&rubber, Mode::Planar, 2.0).expect("a stretch"));
}
