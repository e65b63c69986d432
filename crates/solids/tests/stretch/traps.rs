//! Where such laws go wrong: coalescent stretches, slack fibres, impossible parameters.

use nalgebra::Matrix3;
use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::Real;
use piola_solids::SolidsError;
use piola_solids::{
    EngineeringConstants, Fibre, Fung, Hencky, HolzapfelGasserOgden, Hyperelastic, IsochoricOgden, Ogden, OgdenTerm,
    ReinforcedNeoHookean, Stiffness,
};
use piola_testkit::{DoubleDouble, Tol, assert_close_at_scale};

use super::cases::{artery, hencky, isochoric_ogden, ogden, wood};
use super::once::Once;

const STRESS: Tol = Tol::stated(1e-13, "stresses at coalescence, relative to the moduli");
const TANGENT: Tol = Tol::stated(1e-12, "tangents at coalescence");

/// Numbers between −1 and 1 without a generator's library: Weyl's sequence.
struct Weyl(f64);

impl Weyl {
    fn next(&mut self) -> f64 {
        self.0 = (self.0 + 0.754_877_666_246_693).fract();
        2.0 * self.0 - 1.0
    }
    fn matrix(&mut self) -> Matrix3<f64> {
        let mut matrix = Matrix3::zeros();
        for entry in matrix.iter_mut() {
            *entry = self.next();
        }
        matrix
    }
}

fn deformation<T: Real>(matrix: &Matrix3<f64>) -> DeformationGradient<T> {
    DeformationGradient::new(matrix.map(T::lit)).expect("0 < det F")
}

fn check<L: Hyperelastic>(name: &str, law: &L, matrix: &Matrix3<f64>) {
    let (stress, tangent) = law.first_piola_and_tangent(&deformation::<f64>(matrix));
    let (exact, exact_tangent) = law.first_piola_and_tangent(&deformation::<DoubleDouble>(matrix));
    let entries = tangent.0.components.as_flattened();
    let moduli = entries.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    assert!(moduli.is_finite(), "{name}: {matrix}");
    let exact = exact.0.map(|x| x.primal(0));
    assert_close_at_scale(&format!("{name}: P at {matrix}"), stress.0.as_slice(), exact.as_slice(), moduli, STRESS);
    let exact: Vec<f64> = exact_tangent.0.components.as_flattened().iter().map(|x| x.primal(0)).collect();
    assert_close_at_scale(&format!("{name}: ∂P/∂F at {matrix}"), entries, &exact, 0.0, TANGENT);
}

fn check_all(matrix: &Matrix3<f64>) {
    check("Hencky", &Once(&hencky()), matrix);
    check("Ogden", &Once(&ogden()), matrix);
    check("isochoric Ogden", &Once(&isochoric_ogden()), matrix);
}

/// A library that this was compared with refuses 4819 of 20 000 such stretches.
#[test]
fn answers_at_near_isotropic_stretches_equal_20_000_of_20_000() {
    let mut weyl = Weyl(0.1);
    for k in 0..20_000 {
        let size = 10.0_f64.powf(-16.0 * f64::from(k) / 20_000.0);
        let noise = weyl.matrix() * (0.1 * size);
        check_all(&(Matrix3::identity() * (1.0 + 0.5 * weyl.next()) + noise));
    }
}

/// The same library refuses 651 of 20 000 of these.
#[test]
fn answers_at_near_uniaxial_stretches_equal_20_000_of_20_000() {
    let mut weyl = Weyl(0.3);
    for k in 0..20_000 {
        let size = 10.0_f64.powf(-16.0 * f64::from(k) / 20_000.0);
        let noise = weyl.matrix() * (0.1 * size);
        let stretch = 1.5 + 0.9 * weyl.next();
        let side = stretch.powf(-0.5);
        check_all(&(Matrix3::from_diagonal(&[stretch, side, side].into()) + noise));
    }
}

#[test]
fn tangent_of_a_fibre_jumps_where_its_stress_is_continuous() {
    let law = artery(0.0);
    let [x, y, _] = law.fibres()[0].direction();
    let along = Matrix3::new(x * x, x * y, 0.0, x * y, y * y, 0.0, 0.0, 0.0, 0.0);
    let at = |elongation: f64| DeformationGradient::new(Matrix3::identity() + along * elongation).expect("0 < det F");
    let (taut, slack) = (at(1e-9), at(-1e-9));
    let jump = law.first_piola(&taut).0 - law.first_piola(&slack).0;
    // ΔP = ∂P/∂F : ΔF: the stress is continuous.
    let stiffness = law.first_piola_tangent(&taut).0.components;
    let largest = stiffness.as_flattened().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let close = Tol::stated(2e-9, "elongations of ±1e-9, of the moduli").times(3.0);
    assert_close_at_scale("P across the kink", jump.as_slice(), &[0.0; 9], largest, close);
    let stiff = |f: &DeformationGradient| law.first_piola_derivative(f, &along).0.dot(&along);
    // k₁ (∂Eₐ)² of each family, ∂Eₐ = 2 (aₐ · a₁)² − ⅔: the first becomes taut and the second slack.
    let across = (law.fibres()[1].direction()[0] * x + law.fibres()[1].direction()[1] * y).powi(2);
    let expected = law.fibre_modulus() * ((4.0_f64 / 3.0).powi(2) - (2.0 * across - 2.0 / 3.0).powi(2));
    let tolerance = Tol::stated(1e-6, "the jump between elongations of ±1e-9");
    assert_close_at_scale("jump", &[stiff(&taut) - stiff(&slack)], &[expected], 0.0, tolerance);
}

fn bound_of<T>(result: Result<T, SolidsError>) -> (&'static str, &'static str) {
    match result {
        Err(SolidsError::OutOfBounds { parameter, bound, .. }) => (parameter, bound),
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("accepted"),
    }
}

#[test]
fn impossible_parameters_are_refused_by_name_and_bound() {
    let term = |mu: f64, alpha: f64| OgdenTerm { modulus: mu, exponent: alpha };
    assert_eq!(bound_of(Ogden::new(&[], 1.0)), ("terms", "1 ≤ number of terms ≤ 8"));
    assert_eq!(bound_of(Ogden::new(&[term(1.0, 2.0); 9], 1.0)).0, "terms");
    assert_eq!(bound_of(Ogden::new(&[term(1.0, 0.0)], 1.0)), ("exponent", "α ≠ 0"));
    assert_eq!(bound_of(Ogden::new(&[term(1.0, -2.0)], 1.0)).1, "0 < ½ Σ μ α");
    assert_eq!(bound_of(Ogden::new(&[term(1.0, 2.0)], -1.0)).0, "first_lame_parameter");
    assert_eq!(bound_of(IsochoricOgden::new(&[term(1.0, 2.0)], -1.0)), ("bulk_modulus", "0 ≤ κ"));
    assert_eq!(bound_of(Hencky::new(-1.0, 1.0)), ("first_lame_parameter", "0 < λ + ⅔ μ"));
    assert_eq!(bound_of(Hencky::new(1.0, 0.0)), ("shear_modulus", "0 < μ"));
    assert_eq!(bound_of(Fibre::new([0.0; 3])), ("direction", "0 < |direction|"));
    let fibre = Fibre::new([1.0, 0.0, 0.0]).expect("direction");
    assert_eq!(bound_of(ReinforcedNeoHookean::new(1.0, 1.0, -1.0, fibre)), ("fibre_modulus", "0 ≤ k"));
    let dispersed = HolzapfelGasserOgden::new(1.0, 1.0, 1.0, 1.0, 0.4, [fibre; 2]);
    assert_eq!(bound_of(dispersed), ("dispersion", "0 ≤ dispersion ≤ 1/3"));
    let axes = Matrix3::identity();
    let poisson = EngineeringConstants { poisson: [0.38, 0.45, 4.0], ..wood() };
    assert_eq!(bound_of(Stiffness::orthotropic(&poisson, &axes)), ("nu13", "nu13² < E1/E3"));
    let all = EngineeringConstants { young: [1.0; 3], poisson: [0.6; 3], shear: [1.0; 3] };
    assert_eq!(bound_of(Stiffness::orthotropic(&all, &axes)).0, "determinant of the compliance");
    let soft = nalgebra::Matrix6::from_diagonal(&[1.0, 1.0, 1.0, 1.0, -1.0, 1.0].into());
    assert_eq!(bound_of(Stiffness::from_matrix(&soft)), ("pivot of C", "0 < A : C : A"));
    assert!(matches!(
        Hencky::new(f64::NAN, 1.0),
        Err(SolidsError::NotFinite { parameter: "first_lame_parameter", .. })
    ));
}

#[test]
fn exponents_beyond_the_range_of_numbers_are_refused() {
    let law = Fung::new(1.0, Stiffness::isotropic(1.0, 10.0).expect("parameters")).expect("parameters");
    let large = DeformationGradient::diagonal([5.0, 1.0, 1.0]).expect("0 < det F");
    let refused = law.check(&large);
    assert!(matches!(refused, Err(SolidsError::BeyondLimit { quantity: "Q", .. })), "{refused:?}");
    let bar = DeformationGradient::diagonal([20.0, 0.25, 0.25]).expect("0 < det F");
    assert!(matches!(artery(0.0).check(&bar), Err(SolidsError::BeyondLimit { quantity: "k2 E²", .. })));
    assert_eq!(artery(0.0).check(&DeformationGradient::<f64>::identity()), Ok(()));
}

#[test]
fn engineering_constants_equal_those_of_the_simple_tests() {
    use piola_tensor::PairSymmetric;
    let compliance = super::cases::orthotropic().tensor().inverse().expect("positive definite");
    let EngineeringConstants { young, poisson, shear } = wood();
    let strain = |i: usize| compliance.entry(i, i, 0, 0);
    let actual = [1.0 / strain(0), -strain(1) / strain(0), -strain(2) / strain(0), 0.25 / compliance.entry(0, 1, 0, 1)];
    assert_close_at_scale(
        "E₁, ν₁₂, ν₁₃, G₁₂",
        &actual,
        &[young[0], poisson[0], poisson[2], shear[0]],
        1.0,
        Tol::ulps(64.0),
    );
}

#[cfg(feature = "serde")]
#[test]
fn laws_written_and_read_equal_themselves() {
    fn round<L: serde::Serialize + serde::de::DeserializeOwned + PartialEq + core::fmt::Debug>(law: &L) {
        let text = serde_json::to_string(law).expect("written");
        assert_eq!(law, &serde_json::from_str::<L>(&text).expect("read"), "{text}");
    }
    round(&ogden());
    round(&isochoric_ogden());
    round(&hencky());
    let refused = serde_json::from_str::<Hencky>(r#"{"mu": -1.0, "volumetric": {"lambda": 1.0}}"#).expect_err("mu < 0");
    assert!(refused.to_string().contains("0 < μ"), "{refused}");
    assert!(serde_json::from_str::<Ogden>(r#"{"terms": [], "volumetric": {"lambda": 1.0}}"#).is_err());
}

#[test]
fn stretch_ratio_of_10_000_equals_the_stress_of_twice_the_precision() {
    let f = Matrix3::new(100.0, 3.0, 0.0, 0.0, 1.0, 0.5, 0.0, 0.0, 0.01);
    assert!(0.0 < deformation::<f64>(&f).jacobian());
    check_all(&f);
}
