//! Stresses of the smallest strains.

use piola_continuum::DisplacementGradient;
use piola_numerics::Real;
use piola_solids::{Hyperelastic, IncompressibleOgden, OgdenTerm, Pressurised};
use piola_testkit::strategies::{random_cases, vector};
use piola_testkit::{DoubleDouble, Tol, assert_close};
use proptest::prelude::*;

use super::cases::{Group, Visitor, all, hencky};
use super::once::Once;

const RELATIVE: Tol = Tol::stated(1e-13, "stresses of small strain, relative to themselves");

struct RoundingIsSmall([[f64; 3]; 3]);

fn values<T: Real, L: Hyperelastic>(law: &L, rows: [[f64; 3]; 3]) -> [Vec<T>; 5] {
    let u = DisplacementGradient::from_rows(rows.map(|row| row.map(T::lit))).expect("small");
    [
        law.first_piola(&u).0.as_slice().to_vec(),
        law.second_piola(&u).0.components.to_vec(),
        law.kirchhoff(&u).0.components.to_vec(),
        law.cauchy(&u).0.components.to_vec(),
        vec![law.energy(&u)],
    ]
}

impl Visitor for RoundingIsSmall {
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L, _: Group) {
        let rounded = values::<f64, L>(law, self.0);
        let exact = values::<DoubleDouble, L>(law, self.0);
        for (what, (actual, expected)) in ["P", "S", "τ", "T", "W"].into_iter().zip(rounded.into_iter().zip(exact)) {
            let expected: Vec<f64> = expected.into_iter().map(|x| x.primal(0)).collect();
            assert_close(&format!("{name}: {what}"), &actual, &expected, RELATIVE);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(2_000)))]

    #[test]
    fn stresses_near_the_reference_equal_those_of_twice_the_precision(
        entries in vector(9, -1.0..1.0),
        exponent in -16.0..-3.0_f64,
    ) {
        let size = 10.0_f64.powf(exponent);
        let rows = core::array::from_fn(|i| core::array::from_fn(|j| size * entries[3 * i + j]));
        let mut visitor = RoundingIsSmall(rows);
        all(&mut visitor);
        let terms = [(0.63, 1.3), (0.0012, 5.0), (-0.01, -2.0)].map(|(mu, alpha)| OgdenTerm { modulus: mu, exponent: alpha });
        visitor.visit("incompressible Ogden", &Once(&IncompressibleOgden::new(&terms).expect("parameters")), Group::All);
        visitor.visit("incompressible Hencky", &Once(&Pressurised::new(hencky())), Group::All);
    }
}
