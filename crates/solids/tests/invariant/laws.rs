//! Closed forms against the exact derivatives of the energy, over random deformations.

use nalgebra::Matrix3;
use piola_continuum::{Deformation, DisplacementGradient, Symmetric};
use piola_numerics::Dual;
use piola_solids::Hyperelastic;
use piola_solids::SolidsError;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale, strategies};
use proptest::prelude::*;

use super::zoo::{self, Visitor};

const MODULI: Tol = Tol::stated(1e-13, "closed forms and exact derivatives, of the moduli");

struct ClosedEqualsDerived(DisplacementGradient);

impl Visitor for ClosedEqualsDerived {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L) {
        let f = &self.0;
        let tangent = law.first_piola_tangent(f);
        let entries = tangent.0.components.as_flattened();
        let moduli = entries.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let close = |what: &str, scale: f64, a: &[f64], b: &[f64]| {
            assert_close_at_scale(&format!("{name}: {what}"), a, b, scale, MODULI);
        };
        let stress = law.first_piola(f);
        // ∂W/∂F of the energy and ∂P/∂F of P, a column at a time, by dual numbers.
        let mut slopes = Matrix3::zeros();
        for column in 0..9 {
            let varied = f.lifted(|i, j, x| Dual::new(x, if 3 * i + j == column { 1.0 } else { 0.0 }));
            slopes[(column / 3, column % 3)] = law.energy(&varied).tangent;
            let derivative = law.first_piola(&varied).0.map(|x| x.tangent);
            let closed: [f64; 9] = core::array::from_fn(|row| tangent.0.components[row][column]);
            close("∂P/∂F", moduli, &closed, derivative.transpose().as_slice());
        }
        close("P", moduli, stress.0.as_slice(), slopes.as_slice());
        let inverse = f.inverse_rows().as_flattened().iter().fold(1.0_f64, |largest, x| largest.max(x.abs()));
        let (second, kirchhoff) = (law.second_piola(f).0, law.kirchhoff(f).0);
        // To the linear law all measures are one.
        let linear = Symmetric::symmetric_part(stress.0.into());
        let (pulled, pushed) =
            if name == "linear elastic" { (linear, linear) } else { (stress.second_piola(f).0, stress.kirchhoff(f).0) };
        close("S", moduli * inverse, &second.components, &pulled.components);
        close("τ", moduli, &kirchhoff.components, &pushed.components);
        assert_eq!(law.first_piola_and_tangent(f), (stress, tangent), "{name}: together and apart");
    }
}

struct ReferenceIsFree;

impl Visitor for ReferenceIsFree {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L) {
        for component in law.reference_stress().components {
            assert_eq!(component.abs().to_bits(), 0, "{name}");
        }
        let energy: f64 = law.energy(&DisplacementGradient::zero());
        assert_eq!(energy.abs().to_bits(), 0, "{name}");
    }
}

struct EnergyIsNotNegative(DisplacementGradient);

impl Visitor for EnergyIsNotNegative {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L) {
        // Continued off J = 1 an incompressible law need not be positive.
        if !name.starts_with("incompressible") && name != "polynomial" {
            let energy = law.energy(&self.0);
            assert!(0.0 <= energy, "{name}: {energy:e}");
        }
    }
}

fn deformation(entries: &[f64]) -> Option<DisplacementGradient> {
    let row = |i: usize| core::array::from_fn(|j| entries[3 * i + j]);
    let h = DisplacementGradient::from_rows([row(0), row(1), row(2)]).ok()?;
    (0.2 < h.jacobian()).then_some(h)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(2_000)))]

    #[test]
    fn closed_forms_equal_exact_derivatives(entries in strategies::vector(9, -0.35..0.35)) {
        let f = deformation(&entries);
        prop_assume!(f.is_some());
        let mut visitor = ClosedEqualsDerived(f.expect("0.2 < det F"));
        let visited = zoo::stress_free(&mut visitor).and_then(|()| zoo::stressed(&mut visitor));
        prop_assert_eq!(visited, Ok(()));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn energy_is_not_negative(entries in strategies::vector(9, -0.35..0.35), scale in -16.0..0.0) {
        let entries: Vec<f64> = entries.iter().map(|x| x * 10.0_f64.powf(scale)).collect();
        let f = deformation(&entries);
        prop_assume!(f.is_some());
        prop_assert_eq!(zoo::stress_free(&mut EnergyIsNotNegative(f.expect("0.2 < det F"))), Ok(()));
    }
}

#[test]
fn reference_stress_and_energy_equal_zero() -> Result<(), SolidsError> {
    zoo::stress_free(&mut ReferenceIsFree)
}

#[test]
fn reference_stress_equals_what_the_parameters_say() -> Result<(), SolidsError> {
    struct Residual(Vec<f64>);
    impl Visitor for Residual {
        fn visit<L: Hyperelastic>(&mut self, _: &str, law: &L) {
            self.0.push(law.reference_stress().components[0]);
        }
    }
    let mut residual = Residual(Vec::new());
    zoo::stressed(&mut residual)?;
    // −p + 2 C₁₀ − 2 C₀₁, −q, 2 C₁₀ + 4 C₀₁ + 2 c − d.
    assert_eq!(residual.0, [-1.25, -0.5, 1.5]);
    Ok(())
}
