//! Closed forms of every law against exact derivatives of its energy.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::Gradient;
use piola_solids::{Hyperelastic, derived};
use piola_tensor::{FourthOrder, PairSymmetric};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::laws::{all, gradient, largest};

const DERIVED: Tol = Tol::stated(1e-13, "closed forms against exact derivatives, relative to the moduli");

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn stresses_of_every_law_equal_derivatives_of_its_energy(rows in gradient()) {
        let f = DeformationGradient::from_rows(rows).expect("0 < det F");
        let inverse = largest(f.inverse_rows().as_flattened());
        for (law, _) in all() {
            let (stress, tangent) = law.first_piola_and_tangent(&f);
            let moduli = largest(tangent.0.components.as_flattened());
            let close = |what: &str, actual: &[f64], expected: &[f64], scale: f64| {
                assert_close_at_scale(&format!("{law:?}: {what} at {f:?}"), actual, expected, scale, DERIVED);
            };
            let derived = derived::first_piola(&law, &f);
            close("P", stress.0.as_slice(), derived.0.as_slice(), moduli);
            // An energy of small strain speaks of one stress, whatever its measure.
            if !format!("{law:?}").contains("Linear") {
                close("S", &law.second_piola(&f).0.components, &derived.second_piola(&f).0.components, moduli * inverse);
                close("τ", &law.kirchhoff(&f).0.components, &derived.kirchhoff(&f).0.components, moduli * 2.0);
                close("T", &law.cauchy(&f).0.components, &derived.cauchy(&f).0.components, moduli * 4.0);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(2_000)))]

    /// Of a stress that is the exact derivative of the energy, as the other test shows.
    #[test]
    fn tangents_of_every_law_equal_derivatives_of_its_stress(rows in gradient()) {
        let f = DeformationGradient::from_rows(rows).expect("0 < det F");
        let inverse = largest(f.inverse_rows().as_flattened());
        for (law, _) in all() {
            let tangent = law.first_piola_tangent(&f);
            let moduli = largest(tangent.0.components.as_flattened());
            let close = |what: &str, actual: &[f64], expected: &[f64], scale: f64| {
                assert_close_at_scale(&format!("{law:?}: {what} at {f:?}"), actual, expected, scale, DERIVED);
            };
            let varied = law.first_piola(&f.lifted(|i, j, x| Gradient::<f64, 9>::variable(x, 3 * i + j))).0;
            let components = core::array::from_fn(|row| varied[(row / 3, row % 3)].partials);
            let derived = FirstPiolaTangent(FourthOrder { components });
            let entries = tangent.0.components;
            close("∂P/∂F", entries.as_flattened(), derived.0.components.as_flattened(), moduli);
            for (row, of_row) in entries.iter().enumerate() {
                for (column, entry) in of_row.iter().enumerate() {
                    prop_assert_eq!(entry.to_bits(), entries[column][row].to_bits(), "{:?}: major symmetry", law);
                }
            }
            if !format!("{law:?}").contains("Linear") {
                let stress = law.second_piola(&f);
                let material = derived.material(&stress, &f).0.major_part().slots();
                let by_strain = law.material_tangent(&f);
                close("∂S/∂E", by_strain.0.slots().as_flattened(), material.as_flattened(), moduli * inverse * inverse);
                let spatial = law.truesdell_tangent(&f).0.slots();
                let expected = by_strain.truesdell(&f).0.slots();
                close("c/J", spatial.as_flattened(), expected.as_flattened(), moduli * 4.0);
            }
        }
    }
}
