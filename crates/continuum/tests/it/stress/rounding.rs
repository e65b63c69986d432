//! Rounding of conversions under extreme deformations, beside doubled precision.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{CauchyStress, Deformation, DeformationGradient, SecondPiola, Symmetric};
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{DoubleDouble, Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{rotation, size, stress};

/// R diag(λ) Qᵀ with stretches from 10⁻⁴ to 10⁴.
fn extreme_deformation() -> impl Strategy<Value = DeformationGradient> {
    (rotation(), rotation(), proptest::collection::vec(-4.0..4.0_f64, 3)).prop_filter_map(
        "turned inside out by rounding",
        |(r, q, exponents)| {
            let stretches = Vector3::from_iterator(exponents.iter().map(|x| 10.0_f64.powf(*x)));
            DeformationGradient::new(r * Matrix3::from_diagonal(&stretches) * q.transpose()).ok()
        },
    )
}

fn doubled(tensor: &Symmetric) -> Symmetric<DoubleDouble> {
    Symmetric { components: tensor.components.map(DoubleDouble::lit) }
}

fn rounded(rows: [[DoubleDouble; 3]; 3]) -> Vec<f64> {
    rows.as_flattened().iter().map(|x| x.primal(0)).collect()
}

fn largest_of_inverse(f: &DeformationGradient) -> f64 {
    let lifted = DeformationGradient::new(f.matrix().map(DoubleDouble::lit)).expect("0 < det F");
    size(&rounded(lifted.inverse_rows()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn conversions_under_extreme_stretches_equal_those_in_doubled_precision(f in extreme_deformation(), t in stress()) {
        let exact = DeformationGradient::new(f.matrix().map(DoubleDouble::lit)).expect("0 < det F");
        let (large, inverse) = (size(f.matrix().as_slice()), largest_of_inverse(&f));
        let condition = large * inverse;
        let jacobian = f.jacobian();
        let tolerance = Tol::ulps(32.0);
        let entries = size(&t.0.components);
        // From S: products with F alone, of whose J the condition number is that of F.
        let (s, s_exact) = (SecondPiola(t.0), SecondPiola(doubled(&t.0)));
        let check = |what: &str, actual: &[[f64; 3]; 3], expected: [[DoubleDouble; 3]; 3], scale: f64, tolerance: Tol| {
            assert_close_at_scale(what, actual.as_flattened(), &rounded(expected), scale, tolerance);
        };
        check("P(S)", &s.first_piola(&f).rows(), s_exact.first_piola(&exact).rows(), entries * large, tolerance);
        check("τ(S)", &s.kirchhoff(&f).rows(), s_exact.kirchhoff(&exact).rows(), entries * large * large, tolerance);
        check("M(S)", &s.mandel(&f).rows(), s_exact.mandel(&exact).rows(), entries * large * large, tolerance);
        let scale = entries * large * large / jacobian;
        check("T(S)", &s.cauchy(&f).rows(), s_exact.cauchy(&exact).rows(), scale, tolerance.times(condition));
        // From T: cofactors, each within an ulp of its products.
        let (t_exact, cofactor) = (CauchyStress(doubled(&t.0)), inverse * jacobian);
        let rounding = (large * large / cofactor).max(1.0);
        let scale = entries * cofactor;
        check("P(T)", &t.first_piola(&f).rows(), t_exact.first_piola(&exact).rows(), scale, tolerance.times(rounding));
        let scale = entries * cofactor * inverse;
        let both = tolerance.times(condition.max(rounding));
        check("S(T)", &t.second_piola(&f).rows(), t_exact.second_piola(&exact).rows(), scale, both);
        // A general P, of no symmetry.
        let (p, p_exact) = (s.first_piola(&f), s_exact.first_piola(&exact));
        let scale = size(p.0.as_slice()) * large / jacobian;
        check("T(P)", &p.cauchy(&f).rows(), p_exact.cauchy(&exact).rows(), scale, tolerance.times(condition));
        let scale = size(p.0.as_slice()) * inverse;
        check("S(P)", &p.second_piola(&f).rows(), p_exact.second_piola(&exact).rows(), scale, both);
    }
}
