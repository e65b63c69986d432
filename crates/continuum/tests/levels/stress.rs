//! The same formulas over single precision, lanes and exact derivatives.

#[expect(dead_code, reason = "the rest serves the tests of `it`")]
#[path = "../it/stress/cases.rs"]
mod cases;

use nalgebra::{Matrix3, Vector3};
use piola_continuum::stress::{gradients, invariants};
use piola_continuum::{
    CauchyStress, ContinuumError, Deformation, DeformationGradient, ReferenceNormal, Symmetric, UnitNormal,
};
use piola_numerics::{Dual, Kernel, Lanes, Level, Real, dispatch_at};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use cases::{deformation, direction, nine, size, stress};

/// Everything there is to compute from a stress, a deformation and a direction.
#[cfg_attr(not(debug_assertions), inline(always))]
fn everything<T: Real>(
    t: &CauchyStress<T>,
    f: &impl Deformation<T>,
    n: &UnitNormal<T>,
    reference: &ReferenceNormal<T>,
) -> [T; 44] {
    let p = t.first_piola(f).rows();
    let s = t.second_piola(f).0.components;
    let k = t.kirchhoff(f).0.components;
    let m = t.mandel(f).rows();
    let shear = t.shear_traction(n);
    let area = reference.deformed(f);
    [
        p[0][0],
        p[0][1],
        p[0][2],
        p[1][0],
        p[1][1],
        p[1][2],
        p[2][0],
        p[2][1],
        p[2][2],
        s[0],
        s[1],
        s[2],
        s[3],
        s[4],
        s[5],
        k[0],
        k[1],
        k[2],
        k[3],
        k[4],
        k[5],
        m[0][0],
        m[0][1],
        m[0][2],
        m[1][0],
        m[1][1],
        m[1][2],
        m[2][0],
        m[2][1],
        m[2][2],
        shear[0],
        shear[1],
        shear[2],
        t.normal_traction(n),
        area.ratio,
        area.vector[0],
        area.normal.components()[1],
        t.mean(),
        t.j2(),
        t.j3(),
        t.von_mises(),
        t.octahedral_shear(),
        t.tresca(),
        t.lode_angle(),
    ]
}

struct InLanes<'a, const N: usize> {
    stress: &'a CauchyStress<Lanes<f64, N>>,
    deformation: &'a DeformationGradient<Lanes<f64, N>>,
    normal: &'a UnitNormal<Lanes<f64, N>>,
    reference: &'a ReferenceNormal<Lanes<f64, N>>,
}

impl<const N: usize> Kernel for InLanes<'_, N> {
    type Output = [Lanes<f64, N>; 44];
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        everything(self.stress, self.deformation, self.normal, self.reference)
    }
}

/// Four values in the lanes of one.
fn together<const N: usize>(value: impl Fn(usize) -> f64) -> Lanes<f64, N> {
    Lanes(core::array::from_fn(value))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    #[test]
    fn lanes_equal_single_points(
        t in proptest::collection::vec(stress(), 4),
        f in proptest::collection::vec(deformation(), 4),
        n in proptest::collection::vec(direction(), 4),
    ) {
        let single: Vec<[f64; 44]> = (0..4)
            .map(|lane| {
                let normal = UnitNormal::new(n[lane]).expect("a direction");
                let reference = ReferenceNormal::new(n[lane]).expect("a direction");
                everything(&t[lane], &f[lane], &normal, &reference)
            })
            .collect();
        let stress = CauchyStress(Symmetric {
            components: core::array::from_fn(|i| together(|lane| t[lane].0.components[i])),
        });
        let gradient = Matrix3::from_fn(|i, j| together(|lane| f[lane].matrix()[(i, j)]));
        let deformation = DeformationGradient::new(gradient).expect("0 < det F");
        let vector = Vector3::from(core::array::from_fn::<_, 3, _>(|i| together(|lane| n[lane][i])));
        let normal = UnitNormal::new(vector).expect("directions");
        let reference = ReferenceNormal::new(vector).expect("directions");
        for level in Level::available() {
            let kernel =
                InLanes::<4> { stress: &stress, deformation: &deformation, normal: &normal, reference: &reference };
            let lanes = dispatch_at(level, kernel);
            for (lane, single) in single.iter().enumerate() {
                for (index, (lanes, single)) in lanes.iter().zip(single).enumerate() {
                    // Only Tresca's stress and the angle call elementary functions, which lanes have of their own.
                    let ulps = if index < 42 { 0.0 } else { 4.0 };
                    assert_close(&format!("{index}"), &[lanes.0[lane]], &[*single], Tol::ulps(ulps));
                }
            }
        }
    }

    #[test]
    fn single_precision_equals_double_to_its_own_rounding(t in stress(), f in deformation(), n in direction()) {
        let narrow = f32::lit;
        let components = t.0.components.map(narrow);
        let t32 = CauchyStress(Symmetric { components });
        let t = CauchyStress(Symmetric { components: components.map(f64::from) });
        let gradient = f.matrix().map(narrow);
        let f32 = DeformationGradient::new(gradient).expect("0 < det F");
        let f = DeformationGradient::new(gradient.map(f64::from)).expect("0 < det F");
        let n32 = n.map(narrow);
        let n = n32.map(f64::from);
        let single = everything(
            &t32,
            &f32,
            &UnitNormal::new(n32).expect("a direction"),
            &ReferenceNormal::new(n32).expect("a direction"),
        );
        let double = everything(
            &t,
            &f,
            &UnitNormal::new(n).expect("a direction"),
            &ReferenceNormal::new(n).expect("a direction"),
        );
        let size = size(&nine(&t.0));
        // Stretches between ½ and 2 magnify a stress at most 16 times in any measure.
        for (index, (single, double)) in single.iter().zip(&double).enumerate().take(43) {
            let scale = match index {
                38 => size * size,
                39 => size * size * size,
                34..=36 => 4.0,
                _ => 16.0 * size,
            };
            assert_close_at_scale(&format!("{index}"), &[f64::from(*single)], &[*double], scale, Tol::ulps32(16.0));
        }
        let magnified = Tol::ulps32(32.0).times(size / t.von_mises());
        assert_close_at_scale("θ", &[f64::from(single[43])], &[double[43]], 1.0, magnified);
    }

    #[test]
    fn derivatives_of_functions_equal_gradients(t in stress(), other in stress()) {
        let size = size(&nine(&t.0));
        let direction = other * (1.0 / 100.0);
        let dual = Symmetric {
            components: core::array::from_fn(|i| Dual::new(t.0.components[i], direction.0.components[i])),
        };
        let along = |gradient: Symmetric| gradient.double_contraction(&direction.0);
        let check = |what: &str, dual: Dual<f64>, gradient: Symmetric, scale: f64, tolerance: Tol| {
            assert_close_at_scale(what, &[dual.tangent], &[along(gradient)], scale, tolerance);
        };
        let tolerance = Tol::ulps(64.0);
        check("J₂", invariants::j2(&dual), gradients::j2(&t.0), size, tolerance);
        check("J₃", invariants::j3(&dual), gradients::j3(&t.0), size * size, tolerance);
        check("von Mises", invariants::von_mises(&dual), gradients::von_mises(&t.0), 1.0, tolerance.times(size / t.von_mises()));
        // The corners of the angle magnify rounding by the inverse of their distance.
        let distance = (3.0 * t.lode_angle()).sin();
        prop_assume!(1e-3 < distance);
        let radius = t.haigh_westergaard().deviatoric;
        let tolerance = Tol::ulps_because(256.0, "an arc cosine of a quotient of invariants").times(1.0 / distance).times(size / radius);
        check("θ", invariants::lode_angle(&dual), gradients::lode_angle(&t.0), 1.0 / radius, tolerance);
        check("θₛ", invariants::lode_angle_from_shear(&dual), -gradients::lode_angle(&t.0), 1.0 / radius, tolerance);
        check("Tresca", invariants::tresca(&dual), gradients::tresca(&t.0), 1.0, tolerance);
        // Known sizes, and no trace: a pressure changes none of them.
        let norm = |g: Symmetric| g.double_contraction(&g).sqrt();
        assert_close("|∂σᵥ|", &[norm(gradients::von_mises(&t.0))], &[1.5_f64.sqrt()], Tol::ulps(8.0));
        assert_close("|∂θ|", &[norm(gradients::lode_angle(&t.0)) * radius], &[1.0], Tol::ulps(16.0));
        assert_close("|∂Tresca|", &[norm(gradients::tresca(&t.0))], &[2.0_f64.sqrt()], Tol::ulps(32.0));
        let product = gradients::lode_angle(&t.0).double_contraction(&t.deviator().0) ;
        assert_close_at_scale("∂θ : D", &[product], &[0.0], 1.0, tolerance);
    }

    #[test]
    fn derivative_of_first_piola_equals_its_product_rule(t in stress(), f in deformation(), n in direction()) {
        // P = T Cof F along Ḟ = n⊗e₁, by numbers that carry the derivative.
        let lift = |x: f64| Dual::constant(x);
        let gradient = Matrix3::from_fn(|i, j| Dual::new(f.matrix()[(i, j)], if j == 0 { n[i] } else { 0.0 }));
        let dual_f = DeformationGradient::new(gradient).expect("0 < det F");
        let dual_t = CauchyStress(Symmetric { components: t.0.components.map(lift) });
        let p = dual_t.first_piola(&dual_f).0;
        // Cof F is linear in each column: only columns 2 and 3 of it change.
        let f = f.matrix();
        let (b, c) = (f.column(1).into_owned(), f.column(2).into_owned());
        let rate = Matrix3::from_columns(&[Vector3::zeros(), c.cross(&n), n.cross(&b)]);
        let expected = t.0.matrix() * rate;
        let actual = p.map(|x| x.tangent);
        assert_close_at_scale("Ṗ", actual.as_slice(), expected.as_slice(), size(&nine(&t.0)), Tol::ulps(16.0));
    }
}

#[test]
fn bad_lanes_are_refused() {
    let good = Lanes([1.0, 2.0]);
    let bad = Lanes([1.0, f64::NAN]);
    let zero = Lanes([0.0, 0.0]);
    let stress = CauchyStress::new(good, good, good, zero, bad, zero);
    assert!(matches!(stress, Err(ContinuumError::NotFinite { index: 4, value, .. }) if value.is_nan()));
    let normal = UnitNormal::new(Vector3::new(zero, Lanes([1.0, 0.0]), zero));
    assert_eq!(normal, Err(ContinuumError::ZeroNormal));
    let spherical = Symmetric::diagonal([Lanes([1.0, 7.0]), Lanes([2.0, 7.0]), Lanes([3.0, 7.0])]);
    assert_eq!(invariants::triaxiality(&spherical), Err(ContinuumError::ZeroDeviator { mean: 7.0 }));
}
