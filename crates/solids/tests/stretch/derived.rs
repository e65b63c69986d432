//! Closed forms against exact derivatives of the energy, and lanes against floats.

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_numerics::{Lanes, Real};
use piola_solids::{Hyperelastic, derived};
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{Group, Visitor, all, gradient};

const DERIVED: Tol = Tol::stated(1e-13, "closed forms against exact derivatives, relative to the moduli");

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, x| largest.max(x.abs()))
}

struct ClosedFormsEqualDerived(DeformationGradient);

impl Visitor for ClosedFormsEqualDerived {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, _: Group) {
        let f = &self.0;
        let (stress, tangent) = law.first_piola_and_tangent(f);
        let entries = tangent.0.components;
        let moduli = largest(entries.as_flattened());
        let close = |what: &str, actual: &[f64], expected: &[f64], scale: f64| {
            assert_close_at_scale(&format!("{name}: {what} at {f:?}"), actual, expected, scale, DERIVED);
        };
        // Together they share what apart each rounds for itself.
        close("P apart", law.first_piola(f).0.as_slice(), stress.0.as_slice(), moduli);
        let apart = law.first_piola_tangent(f).0.components;
        close("∂P/∂F apart", apart.as_flattened(), entries.as_flattened(), moduli);
        close("P", stress.0.as_slice(), derived::first_piola(law, f).0.as_slice(), moduli);
        let expected = derived::first_piola_tangent(law, f);
        close("∂P/∂F", entries.as_flattened(), expected.0.components.as_flattened(), moduli);
        for (row, of_row) in entries.iter().enumerate() {
            for (column, entry) in of_row.iter().enumerate() {
                assert_eq!(entry.to_bits(), entries[column][row].to_bits(), "{name}: major symmetry");
            }
        }
        let direction = Matrix3::new(0.3, -0.2, 0.5, 0.1, 0.4, -0.6, 0.7, 0.2, -0.1);
        let along = law.first_piola_derivative(f, &direction).0;
        let expected = Matrix3::from_fn(|i, a| {
            (0..9).map(|k| tangent.entry(i, a, k / 3, k % 3) * direction[(k / 3, k % 3)]).sum::<f64>()
        });
        close("∂P/∂F : δF", along.as_slice(), expected.as_slice(), moduli);
    }
}

struct LanesEqualFloats([[[f64; 3]; 3]; 4]);

impl Visitor for LanesEqualFloats {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, _: Group) {
        let entry = |i: usize, j: usize| Lanes(core::array::from_fn::<f64, 4, _>(|lane| self.0[lane][i][j]));
        let rows = core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j)));
        let lanes = DeformationGradient::from_rows(rows).expect("0 < det F");
        let (stress, tangent) = law.first_piola_and_tangent(&lanes);
        let energy = law.energy(&lanes);
        for (lane, gradient) in self.0.iter().enumerate() {
            let f = DeformationGradient::from_rows(*gradient).expect("0 < det F");
            let (expected, expected_tangent) = law.first_piola_and_tangent(&f);
            let moduli = largest(expected_tangent.0.components.as_flattened());
            let actual: Vec<f64> = stress.0.iter().map(|x| x.primal(lane)).collect();
            assert_close_at_scale(&format!("{name}: P"), &actual, expected.0.as_slice(), moduli, DERIVED);
            let actual: Vec<f64> = tangent.0.components.as_flattened().iter().map(|x| x.primal(lane)).collect();
            let expected_tangent = expected_tangent.0.components;
            assert_close_at_scale(&format!("{name}: ∂P/∂F"), &actual, expected_tangent.as_flattened(), moduli, DERIVED);
            assert_close_at_scale(&format!("{name}: W"), &[energy.primal(lane)], &[law.energy(&f)], moduli, DERIVED);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn closed_forms_equal_exact_derivatives_of_the_energy(rows in gradient()) {
        all(&mut ClosedFormsEqualDerived(DeformationGradient::from_rows(rows).expect("0 < det F")));
    }

    #[test]
    fn lanes_equal_floats(rows in [gradient(), gradient(), gradient(), gradient()]) {
        all(&mut LanesEqualFloats(rows));
    }
}
