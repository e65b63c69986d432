//! One stress in all forms of the response functions.

use piola_continuum::{Deformation, DeformationGradient};
use piola_solids::{
    BlatzKo, Hyperelastic, IsotropicResponse, MooneyRivlin, Polynomial, ResponseForm, SaintVenantKirchhoff,
};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

const FORMS: [ResponseForm; 4] =
    [ResponseForm::Stretch, ResponseForm::Square, ResponseForm::Inverse, ResponseForm::Mixed];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

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

#[test]
fn polynomial_with_coefficients_of_the_text_equals_saint_venant_kirchhoff() {
    let closed = SaintVenantKirchhoff::new(1.5, 0.75).expect("bounds");
    let terms = Polynomial::saint_venant_kirchhoff(1.5, 0.75).expect("bounds");
    let f = DeformationGradient::from_rows([[1.1, 0.2, 0.0], [-0.1, 0.9, 0.3], [0.05, 0.1, 1.2]]).expect("0 < det F");
    let (actual, expected) = (terms.second_piola(&f), closed.second_piola(&f));
    assert_close_at_scale("S", &actual.0.components, &expected.0.components, 1.0, Tol::ulps(16.0));
    assert_close("W", &[terms.energy(&f)], &[closed.energy(&f)], Tol::ulps(32.0));
}
