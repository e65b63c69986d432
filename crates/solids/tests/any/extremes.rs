//! Volumes from a millionth to a million times that of the reference, against the same formulas in twice the precision.

use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::Real;
use piola_solids::SolidsError;
use piola_solids::volumetric::{
    HartmannNeff, Lame, Liu, Logarithmic, Miehe, OgdenVolumetric, Quadratic, QuadraticLogarithmic, SimoTaylor,
};
use piola_solids::{AnySolid, AnyVolumetric, Hyperelastic, Polynomial, volumetric::Volumetric};
use piola_testkit::strategies::{rotation, rotation_matrix, vector};
use piola_testkit::{DoubleDouble, Tol, assert_close, condition_number};
use proptest::prelude::*;

use super::laws::all;

const BOUND: f64 = 1e-13;

/// W, P, S, τ and ∂P/∂F.
fn answers<T: Real>(law: &AnySolid, f: &impl Deformation<T>) -> [Vec<T>; 5] {
    let (stress, tangent) = law.first_piola_and_tangent(f);
    let (material, spatial) = (law.second_piola(f).0.components, law.kirchhoff(f).0.components);
    let tangent = tangent.0.components.as_flattened().to_vec();
    [vec![law.energy(f)], stress.0.as_slice().to_vec(), material.to_vec(), spatial.to_vec(), tangent]
}

fn deformation(entries: &[f64]) -> DeformationGradient {
    DeformationGradient::from_rows(core::array::from_fn(|i| core::array::from_fn(|j| entries[3 * i + j])))
        .expect("0 < det F")
}

fn largest(entries: &[f64]) -> f64 {
    entries.iter().fold(0.0, |size, x| size.max(x.abs()))
}

/// 1e-13, or sixteen units in the last place as the data magnify them: eight for those as given, as many for the products
/// and sums of which the measures of strain are made. The data are the entries of F and, where a law is a sum whose terms
/// may cancel, its coefficients. W, which is of second order in the strain where the invariants it is made of are of first
/// order, and are rounded apart from each other, is held to two units in the last place of the moduli if that is more.
fn tolerance(law: &AnySolid, which: usize, f: &DeformationGradient) -> Result<Tol, SolidsError> {
    let entries = f.gradient_rows();
    let answer = |law: &AnySolid, f: &DeformationGradient| answers(law, f)[which].clone();
    let mut condition = condition_number(|x| answer(law, &deformation(x)), entries.as_flattened());
    if let AnySolid::Polynomial(sum) = law {
        for term in sum.terms() {
            condition += largest(&answer(&Polynomial::new(vec![term])?.into(), f)) / largest(&answer(law, f));
        }
    }
    let mut bound = (16.0 * f64::EPSILON * condition).max(BOUND);
    if which == 0 {
        let moduli = largest(&answers(law, f)[4]) * largest(entries.as_flattened()).powi(2);
        bound = bound.max(2.0 * f64::EPSILON * moduli / largest(&answer(law, f)));
    }
    Ok(Tol::stated(bound, "1e-13, or 16 ulp × the condition number, or W to 2 ulp of the moduli"))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn answers_at_extreme_volumes_equal_those_of_twice_the_precision(
        r in rotation(),
        q in rotation(),
        stretches in vector(3, -0.35..0.35),
        exponent in -6.0..6.0_f64,
    ) {
        let (r, q) = (rotation_matrix(r), rotation_matrix(q));
        let mean = stretches.iter().sum::<f64>() / 3.0;
        let size = 10.0_f64.powf(exponent / 3.0);
        let along: Vec<f64> = stretches.iter().map(|x| size * (x - mean).exp()).collect();
        let entry = |i: usize, j: usize| (0..3).map(|k| r[i][k] * along[k] * q[k][j]).sum::<f64>();
        let f = deformation(&(0..9).map(|k| entry(k / 3, k % 3)).collect::<Vec<_>>());
        let wide = f.lifted(|_, _, x| DoubleDouble::lit(x));
        for (law, any_volume) in all() {
            if !any_volume || law.check(&f).is_err() {
                continue;
            }
            let (rounded, exact) = (answers(&law, &f), answers(&law, &wide));
            for (which, (actual, expected)) in rounded.into_iter().zip(exact).enumerate() {
                let size = largest(&expected.iter().map(|x| x.primal(0)).collect::<Vec<_>>());
                let error = actual.iter().zip(&expected).fold(0.0_f64, |e, (y, x)| e.max(x.rounding_of(*y).abs()));
                if error <= BOUND * size {
                    continue;
                }
                let expected: Vec<f64> = expected.iter().map(|x| x.primal(0)).collect();
                let what = format!("{law:?}: {} at J = 10^{exponent}, {f:?}", ["W", "P", "S", "τ", "∂P/∂F"][which]);
                let tolerance = tolerance(&law, which, &f).expect("each term is a law");
                assert_close(&what, &actual, &expected, tolerance);
            }
        }
    }
}

/// U, J U′, U″ and J (J U′)′.
fn parts<T: Real>(law: &AnyVolumetric, jacobian: T) -> [T; 4] {
    let change = jacobian - T::one();
    [
        law.energy(change, jacobian),
        law.mean_kirchhoff(change, jacobian),
        law.curvature(change, jacobian),
        law.stiffness(change, jacobian),
    ]
}

#[test]
fn energies_of_volume_from_a_millionth_to_a_million_equal_those_of_twice_the_precision() -> Result<(), SolidsError> {
    let laws: [AnyVolumetric; 10] = [
        Quadratic::new(7.0)?.into(),
        Logarithmic::new(7.0)?.into(),
        Lame::new(7.0)?.into(),
        QuadraticLogarithmic::new(7.0)?.into(),
        SimoTaylor::new(7.0)?.into(),
        Liu::new(7.0)?.into(),
        Miehe::new(7.0)?.into(),
        OgdenVolumetric::new(7.0, 9.0)?.into(),
        OgdenVolumetric::new(7.0, -2.0)?.into(),
        HartmannNeff::new(7.0)?.into(),
    ];
    for law in laws {
        for k in -600..=600 {
            let jacobian = 10.0_f64.powf(0.01 * f64::from(k));
            let (rounded, exact) = (parts(&law, jacobian), parts(&law, DoubleDouble::lit(jacobian)));
            for (which, (actual, expected)) in rounded.into_iter().zip(exact).enumerate() {
                if expected.rounding_of(actual).abs() <= BOUND * actual.abs() {
                    continue;
                }
                // Where U″ passes through zero no digit is left of it.
                let condition = condition_number(|x| vec![parts(&law, x[0])[which]], &[jacobian]);
                let tolerance = Tol::ulps(8.0).times(condition);
                assert_close(&format!("{law:?}, {which}, J = {jacobian}"), &[actual], &[expected.primal(0)], tolerance);
            }
        }
    }
    Ok(())
}
