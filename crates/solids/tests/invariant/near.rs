//! Relative accuracy of stress and energy near the reference, against the same formulas in twice the precision.

use piola_continuum::{Deformation, DisplacementGradient};
use piola_numerics::Real;
use piola_solids::Hyperelastic;
use piola_testkit::strategies::random_cases;
use piola_testkit::{DoubleDouble, strategies};
use proptest::prelude::*;

use super::zoo::{self, Visitor};

const BOUND: f64 = 1e-13;

/// The largest relative errors of P, S, τ and W, with the law of each.
struct Errors {
    gradient: DisplacementGradient,
    largest: [(f64, String); 4],
}

fn relative(exact: &[DoubleDouble], rounded: &[f64]) -> f64 {
    let size = exact.iter().fold(0.0_f64, |size, x| size.max(x.primal(0).abs()));
    let error = exact.iter().zip(rounded).fold(0.0_f64, |error, (x, &y)| error.max(x.rounding_of(y).abs()));
    error / size
}

impl Visitor for Errors {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L) {
        let h = &self.gradient;
        let exact = h.lifted(|_, _, x| DoubleDouble::lit(x));
        let errors = [
            relative(law.first_piola(&exact).0.as_slice(), law.first_piola(h).0.as_slice()),
            relative(&law.second_piola(&exact).0.components, &law.second_piola(h).0.components),
            relative(&law.kirchhoff(&exact).0.components, &law.kirchhoff(h).0.components),
            relative(&[law.energy(&exact)], &[law.energy(h)]),
        ];
        for (largest, error) in self.largest.iter_mut().zip(errors) {
            if largest.0 < error || error.is_nan() {
                *largest = (error, name.to_owned());
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    #[test]
    fn stress_near_the_reference_equals_that_in_twice_the_precision(
        entries in strategies::vector(9, -1.0..1.0),
        exponent in -16.0..-3.0,
    ) {
        let scale = 10.0_f64.powf(exponent);
        let row = |i: usize| core::array::from_fn(|j| scale * entries[3 * i + j]);
        let gradient = DisplacementGradient::from_rows([row(0), row(1), row(2)]).expect("0 < det F");
        let mut errors = Errors { gradient, largest: Default::default() };
        prop_assert_eq!(zoo::stress_free(&mut errors), Ok(()));
        for (quantity, (error, law)) in ["P", "S", "τ", "W"].into_iter().zip(errors.largest) {
            prop_assert!(error <= BOUND, "{quantity} of {law}: {error:e}");
        }
    }
}
