//! One stress in all forms of the response functions.

use piola_continuum::polar::StretchAnalysis;
use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::Real;
use piola_solids::{
    BlatzKo, Hyperelastic, IsotropicResponse, IsotropicSolid, MooneyRivlin, Polynomial, ResponseForm,
    SaintVenantKirchhoff,
};
use piola_tensor::spectral::{EigenvalueCase, representation};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

const FORMS: [ResponseForm; 4] =
    [ResponseForm::Stretch, ResponseForm::Square, ResponseForm::Inverse, ResponseForm::Mixed];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn stress_of_a_law_equals_that_of_every_form(entries in strategies::vector(9, -0.35..0.35)) {
        let row = |i: usize| core::array::from_fn(|j| entries[3 * i + j] + if i == j { 1.0 } else { 0.0 });
        let f = DeformationGradient::from_rows([row(0), row(1), row(2)]);
        prop_assume!(f.as_ref().is_ok_and(|f| 0.3 < f.jacobian()));
        let f = f.expect("0.3 < det F");
        let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.25).expect("bounds");
        let foam = BlatzKo::foam(0.8).expect("bounds");
        for (stress, response) in [
            (rubber.cauchy(&f), IsotropicResponse::of(&rubber, &f)),
            (foam.cauchy(&f), IsotropicResponse::of(&foam, &f)),
        ] {
            for form in FORMS {
                let converted = response.converted(form, &f);
                prop_assert_eq!(converted.form, form);
                for back in FORMS {
                    let again = converted.converted(back, &f);
                    let inverse = f.inverse_rows().as_flattened().iter().fold(1.0_f64, |largest, x| largest.max(x.abs()));
                    let largest = again.coefficients.iter().fold(1.0_f64, |largest, x| largest.max(x.abs()));
                    // The largest term: coefficients by B, or by B⁻².
                    let scale = largest * inverse.powi(4) * 8.0;
                    let actual = again.cauchy(&f).0.components;
                    assert_close_at_scale(&format!("{form:?} to {back:?}"), &actual, &stress.0.components, scale, Tol::stated(1e-13, "conversions, of the largest term"));
                }
            }
        }
    }
}

/// φ₀ = 0.3 ln I₃ − 0.2 I₁, φ₁ = 0.5 + 0.1 I₂, φ₂ = 0.4 I₁ − 0.6: elastic, without an energy.
struct Elastic;

impl Elastic {
    fn coefficients<T: Real>([first, second, third]: [T; 3]) -> [T; 3] {
        let c = T::lit;
        [c(0.3) * third.ln() - c(0.2) * first, c(0.5) + c(0.1) * second, c(0.4) * first - c(0.6)]
    }
}

impl IsotropicSolid for Elastic {
    fn response<T: Real>(&self, invariants: [T; 3]) -> IsotropicResponse<T> {
        IsotropicResponse { form: ResponseForm::Stretch, coefficients: Self::coefficients(invariants) }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(5_000)))]

    #[test]
    fn stress_of_an_isotropic_solid_is_that_of_its_principal_stretches_and_has_its_coefficients(
        entries in strategies::vector(9, -0.35..0.35),
    ) {
        let row = |i: usize| core::array::from_fn(|j| entries[3 * i + j] + if i == j { 1.0 } else { 0.0 });
        let f = DeformationGradient::from_rows([row(0), row(1), row(2)]);
        prop_assume!(f.as_ref().is_ok_and(|f| 0.3 < f.jacobian()));
        let f = f.expect("0 < det F");
        let stress = Elastic.cauchy(&f).0;
        // By another program's singular values: λ and the axes of V are those of F = W λ Zᵀ.
        let singular = f.matrix().svd(true, true);
        let (axes, stretches) = (singular.u.expect("asked for"), singular.singular_values);
        let [a, b, c] = [0, 1, 2].map(|k| stretches[k] * stretches[k]);
        let [zeroth, first, second] = Elastic::coefficients([a + b + c, a * b + b * c + c * a, a * b * c]);
        let principal = stretches.map(|stretch| zeroth + first * stretch + second * stretch * stretch);
        let expected = axes * nalgebra::Matrix3::from_diagonal(&principal) * axes.transpose();
        let tol = Tol::ulps_because(256.0, "two decompositions of condition 10");
        assert_close_at_scale("T", stress.matrix().as_slice(), expected.as_slice(), 8.0, tol);

        // The coefficients again, from V and T alone.
        let stretch = StretchAnalysis::of(&f).left_stretch();
        let found = representation(&stretch, &stress, 1e-3).expect("finite");
        prop_assume!(found.case == EigenvalueCase::Three);
        let gaps = (stretches[0] - stretches[1]) * (stretches[1] - stretches[2]);
        let tol = Tol::ulps_because(2048.0, "two decompositions of condition 10");
        assert_close_at_scale("φ", &found.coefficients, &[zeroth, first, second], 8.0 / gaps, tol);
        prop_assert!(found.residual * stress.norm() < 1e-12 / gaps);
    }
}

#[test]
fn polynomial_with_coefficients_of_the_text_equals_saint_venant_kirchhoff() {
    let closed = SaintVenantKirchhoff::new(1.5, 0.75).expect("bounds");
    let terms = Polynomial::saint_venant_kirchhoff(1.5, 0.75).expect("bounds");
    let f = DeformationGradient::from_rows([[1.1, 0.2, 0.0], [-0.1, 0.9, 0.3], [0.05, 0.1, 1.2]]).expect("0 < det F");
    let (actual, expected) = (terms.second_piola(&f), closed.second_piola(&f));
    assert_close_at_scale("S", &actual.0.components, &expected.0.components, 1.0, Tol::ulps(16.0));
    assert_close("W", &[terms.energy(&f)], &[closed.energy(&f)], Tol::ulps(32.0));
}
