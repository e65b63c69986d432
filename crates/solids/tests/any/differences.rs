//! Tangents of every law against differences of its stress in twice the precision.

use nalgebra::Matrix3;
use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::Real;
use piola_solids::{AnySolid, Hyperelastic};
use piola_testkit::strategies::{random_cases, vector};
use piola_testkit::{DoubleDouble, Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::laws::{all, gradient, largest};

const DIFFERENCES: Tol = Tol::stated(1e-13, "differences of sixth order, h = 1e-4, of 31 digits");

/// (45 δ₁ − 9 δ₂ + δ₃)/60h with δₖ = f(k h) − f(−k h).
fn difference(f: impl Fn(DoubleDouble) -> [DoubleDouble; 9]) -> [f64; 9] {
    let step = 1e-4;
    let weights = [45.0, -9.0, 1.0].map(DoubleDouble::lit);
    let mut sum = [DoubleDouble::lit(0.0); 9];
    for (k, weight) in [1.0, 2.0, 3.0].into_iter().zip(weights) {
        let away = DoubleDouble::lit(k) * DoubleDouble::lit(step);
        for ((sum, ahead), behind) in sum.iter_mut().zip(f(away)).zip(f(-away)) {
            *sum += weight * (ahead - behind);
        }
    }
    sum.map(|x| (x / (DoubleDouble::lit(60.0) * DoubleDouble::lit(step))).primal(0))
}

fn along(law: &AnySolid, f: &DeformationGradient, direction: &Matrix3<f64>) -> [f64; 9] {
    difference(|away| {
        let moved = f.lifted(|i, j, x| DoubleDouble::lit(x) + away * DoubleDouble::lit(direction[(i, j)]));
        let stress = law.first_piola(&moved).0;
        core::array::from_fn(|k| stress[(k / 3, k % 3)])
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    #[test]
    fn tangents_of_every_law_equal_differences_of_the_stress(rows in gradient(), entries in vector(9, -1.0..1.0)) {
        let f = DeformationGradient::from_rows(rows).expect("0 < det F");
        let direction = Matrix3::from_iterator(entries);
        for (law, _) in all() {
            // A kink within the reach of the differences has no derivative: fibres that are about to slacken. Two forms of
            // a formula, for volumes near that of the reference and far from it, agree to double precision only.
            if let AnySolid::HolzapfelGasserOgden(wall) = &law
                && (wall.fibres().iter().any(|fibre| near_slack(wall.dispersion(), fibre.direction(), &f))
                    || ((f.jacobian() - 1.0).abs() - 0.5).abs() < 1e-2)
            {
                continue;
            }
            let tangent = law.first_piola_tangent(&f);
            let moduli = largest(tangent.0.components.as_flattened());
            let expected = along(&law, &f, &direction);
            let product: Vec<f64> = (0..9)
                .map(|r| (0..9).map(|s| tangent.0.components[r][s] * direction[(s / 3, s % 3)]).sum())
                .collect();
            assert_close_at_scale(&format!("{law:?}: ∂P/∂F : δF"), &product, &expected, moduli, DIFFERENCES);
            let derivative = law.first_piola_derivative(&f, &direction).0.transpose();
            assert_close_at_scale(&format!("{law:?}: derivative"), derivative.as_slice(), &expected, moduli, DIFFERENCES);
        }
    }
}

/// Whether Eₐ may change its sign within 3 h of F.
fn near_slack(dispersion: f64, fibre: [f64; 3], f: &DeformationGradient) -> bool {
    let c = f.matrix().transpose() * f.matrix();
    let scale = f.jacobian().powf(-2.0 / 3.0);
    let a = nalgebra::Vector3::from(fibre);
    let strain = dispersion * scale * c.trace() + (1.0 - 3.0 * dispersion) * scale * (c * a).dot(&a) - 1.0;
    strain.abs() < 1e-2
}
