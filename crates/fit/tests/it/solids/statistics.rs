//! Covariance, intervals and criteria against the normal equations of two parameters, solved by hand.

use piola_fit::solids::{
    AnyModel, Covariance, Criteria, Data, Measure, Options, Stability, Table, Test, Weighting, fit,
};
use piola_testkit::{Tol, assert_close};

/// Of three degrees of freedom at 95 %.
const STUDENT: f64 = 3.182_446_305_284_263;

#[test]
fn statistics_of_mooney_and_rivlin_equal_the_normal_equations() {
    let points = [[1.25, 0.4642], [1.5, 0.7758], [2.0, 1.2247], [3.0, 1.9260], [4.0, 2.5594]];
    let bar = Test::new("bar", Table::Uniaxial(points.to_vec()), Measure::FirstPiola).expect("a test");
    let data = Data::new(vec![bar]).expect("data");
    for weighting in [Weighting::LargestStress, Weighting::Equal] {
        let options = Options { stability: Stability::Free, weighting, ..Options::default() };
        let found = fit(&AnyModel::MooneyRivlin, &data, &options).expect("a fit");
        // P = C₁₀ a + C₀₁ b, a = 2 (λ − λ⁻²), b = a/λ, all over the largest stress.
        let rows = points.map(|[x, p]| {
            let a = 2.0 * (x - 1.0 / (x * x));
            [a / 2.5594, a / x / 2.5594, p / 2.5594]
        });
        let sum = |f: fn(&[f64; 3]) -> f64| rows.iter().map(f).sum::<f64>();
        let (aa, ab, bb) = (sum(|r| r[0] * r[0]), sum(|r| r[0] * r[1]), sum(|r| r[1] * r[1]));
        let (ap, bp) = (sum(|r| r[0] * r[2]), sum(|r| r[1] * r[2]));
        let determinant = aa * bb - ab * ab;
        let values = [(bb * ap - ab * bp) / determinant, (aa * bp - ab * ap) / determinant];
        let squares = rows.iter().map(|r| (values[0] * r[0] + values[1] * r[1] - r[2]).powi(2)).sum::<f64>();
        let variance = squares / 3.0;
        let covariance = [bb, -ab, -ab, aa].map(|x| x * variance / determinant);
        // S is a sum of squares of differences of five digits.
        let tolerance = Tol::stated(1e-9, "residuals of 1e-5, through the condition of the normal equations");
        assert_close("parameters", &found.values(), &values, tolerance);
        assert_close("S", &[found.weighted_squares], &[squares], tolerance);
        let Covariance { matrix, .. } = found.covariance.as_ref().expect("degrees of freedom");
        assert_close("covariance", &matrix.concat(), &covariance, tolerance);
        for (k, estimate) in found.parameters.iter().enumerate() {
            let error = covariance[3 * k].sqrt();
            assert_close("standard error", &[estimate.standard_error.expect("determined")], &[error], tolerance);
            let interval = estimate.interval.expect("determined");
            let expected = [values[k] - STUDENT * error, values[k] + STUDENT * error];
            assert_close("interval", &interval, &expected, tolerance);
        }
        // Five numbers; two parameters and the variance are estimated.
        let misfit = 5.0 * (squares / 5.0).ln();
        let criteria: &Criteria = &found.criteria;
        assert_close("AIC", &[criteria.aic.expect("2 < 5")], &[misfit + 6.0], tolerance);
        assert_close("AICc", &[criteria.aicc.expect("5 − 3 − 1 = 1")], &[misfit + 6.0 + 24.0], tolerance);
        assert_close("BIC", &[criteria.bic.expect("2 < 5")], &[misfit + 3.0 * 5.0_f64.ln()], tolerance);
        assert_eq!(found.degrees_of_freedom, 3);
    }
}
