//! Universal deformations pass the search for a law that refutes them, others fail, and the law found does refute.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::FirstPiola;
use piola_fields::{Affine, Body, Field, Material, Motion, Uniform};
use piola_numerics::{Gradient, Real};
use piola_solutions::SolutionsError;
use piola_solutions::families::{
    AsMotion, AzimuthalShearing, BlockBending, Family, Orientation, SectorStraightening, SphereDeformation,
    TubeDeformation,
};
use piola_solutions::universality::{CompressibleEnergy, compressible, elastic_fluid, incompressible};
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

/// Residuals of exact derivatives of third order.
const ROUNDING: f64 = 1e-9;

fn particles() -> Vec<Vector3<f64>> {
    vec![Vector3::new(1.0, 0.3, 0.2), Vector3::new(0.8, -0.4, 0.5), Vector3::new(1.3, 0.1, -0.6)]
}

#[test]
fn the_families_are_universal_for_incompressible_solids_and_not_for_compressible_ones() {
    fn check(family: impl Family) {
        let motion = AsMotion(family);
        let found = incompressible(&motion, &particles(), 0.0, 1.0).expect("search");
        assert!(!found.refutes(ROUNDING), "{found:?}");
        let found = compressible(&motion, &particles(), 0.0, 1.0).expect("search");
        assert!(found.refutes(1e-3), "{found:?}");
        // They keep volumes: for elastic fluids all are universal.
        assert!(elastic_fluid(&motion, &particles(), 0.0, 1.0).expect("residual") < 1e-12);
    }
    check(BlockBending::isochoric([0.9, 0.2, -0.1, 1.2]).expect("constants"));
    check(SectorStraightening::isochoric([1.1, 0.2, -0.1, 1.2]).expect("constants"));
    check(TubeDeformation::isochoric([0.4, 1.1, 0.3, 0.1, 0.9]).expect("constants"));
    check(SphereDeformation::new(Orientation::Kept, 0.7).expect("A"));
    check(SphereDeformation::new(Orientation::Everted, 7.0).expect("A"));
    check(AzimuthalShearing::isochoric([1.1, 0.4, 0.9]).expect("constants"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn homogeneous_deformations_are_universal_for_all(entries in prop::array::uniform9(-0.4..0.4_f64)) {
        use piola_continuum::DeformationGradient;
        let f = Matrix3::identity() + Matrix3::from_row_slice(&entries);
        prop_assume!(0.2 < f.determinant());
        let affine = Affine::new(DeformationGradient::new(f).expect("F"), Vector3::zeros()).expect("affine");
        prop_assert!(!compressible(&affine, &particles(), 0.0, 1.0).expect("search").refutes(1e-13));
        prop_assert!(elastic_fluid(&affine, &particles(), 0.0, 1.0).expect("residual") < 1e-13);
        let isochoric = DeformationGradient::new(f / f.determinant().cbrt()).expect("F");
        let isochoric = Affine::new(isochoric, Vector3::zeros()).expect("affine");
        prop_assert!(!incompressible(&isochoric, &particles(), 0.0, 1.0).expect("search").refutes(1e-12));
    }

    #[test]
    fn curved_deformations_are_refuted_and_the_law_that_refutes_is_out_of_equilibrium(
        c in prop::array::uniform3(0.05..0.2_f64), x in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        let bow = Bow(c);
        let particle = Vector3::from(x);
        let found = compressible(&bow, &[particle], 0.0, 1.0).expect("search");
        prop_assert!(found.refutes(1e-4), "{found:?}");
        // Independently: Div P of that law by the balances of fields.
        let body = Body { motion: &bow, reference_density: Uniform(1.0) };
        let stress = Material(Stress { law: found.law, motion: &bow });
        let none = Material(Uniform(Vector3::zeros()));
        let left = body.equilibrium_residual(&stress, &none, &particle, 0.0).expect("residual");
        let scale = Vector3::from(found.residual).norm();
        assert_close_at_scale("Div P", left.value.as_slice(), &found.residual, scale, Tol::ulps_because(1e3, "products of F up to degree six"));
        // P of the law is the derivative of its energy.
        let f: [[Gradient<f64, 9>; 3]; 3] = [0, 1, 2].map(|i: usize| [0, 1, 2].map(|j: usize| {
            Gradient::variable(f64::from(u8::from(i == j)) + 0.1 * x[i] * x[j] + 0.05 * i as f64, 3 * i + j)
        }));
        let energy = found.law.energy(f).partials;
        let piola = found.law.first_piola(f.map(|row| row.map(|entry| entry.value))).0;
        let piola: Vec<f64> = (0..9).map(|k| piola[(k / 3, k % 3)]).collect();
        assert_close_at_scale("P", &piola, &energy, 1.0, Tol::ulps_because(1e3, "products of F up to degree six"));
    }
}

/// Shears with amounts that vary: det F = 1.
struct Bow([f64; 3]);

impl Motion for Bow {
    fn place<T: Real>(&self, x: &Vector3<T>, _t: T) -> Vector3<T> {
        let [a, b, c] = self.0.map(T::lit);
        let y = x[1] + a * x[0] * x[0] * x[0] + b * x[0] * x[0];
        Vector3::new(x[0], y, x[2] + c * y * y)
    }
}

struct Stress<'a> {
    law: CompressibleEnergy,
    motion: &'a Bow,
}

impl Field for Stress<'_> {
    type Value = FirstPiola;
    fn at<T: Real>(&self, reference: &Vector3<T>, t: T) -> FirstPiola<T> {
        let at: Vector3<Gradient<T, 3>> = Vector3::from_fn(|i, _| Gradient::variable(reference[i], i));
        let place = self.motion.place(&at, Gradient::constant(t));
        self.law.first_piola([0, 1, 2].map(|i: usize| place[i].partials))
    }
}

#[test]
fn isochoric_deformations_that_are_no_family_are_refuted() {
    let bow = Bow([0.1, 0.2, 0.3]);
    let found = incompressible(&bow, &particles(), 0.0, 1.0).expect("search");
    assert!(found.refutes(1e-3), "{found:?}");
    let found = incompressible(&Swirl, &particles(), 0.0, 1.0).expect("search");
    assert!(found.refutes(1e-3), "{found:?}");
    assert!(elastic_fluid(&Swirl, &particles(), 0.0, 1.0).expect("residual") < 1e-13);
}

#[test]
fn bodies_without_particles_or_size_and_changes_of_volume_are_refused() {
    let bow = Bow([0.1; 3]);
    assert!(matches!(compressible(&bow, &[], 0.0, 1.0), Err(SolutionsError::OutOfBounds { .. })));
    assert!(matches!(elastic_fluid(&bow, &particles(), 0.0, 0.0), Err(SolutionsError::OutOfBounds { .. })));
    let nowhere = [Vector3::new(f64::NAN, 0.0, 0.0)];
    assert!(matches!(incompressible(&bow, &nowhere, 0.0, 1.0), Err(SolutionsError::NotFinite { .. })));
    assert!(matches!(incompressible(&Swell, &particles(), 0.0, 1.0), Err(SolutionsError::OutOfBounds { .. })));
}

#[test]
fn volumes_that_differ_between_places_refute_elastic_fluids() {
    // det F = (1 + 2 a X) (1 + 2 b Y): |Grad det F|/det F by hand.
    let (a, b) = (0.1, 0.05);
    let found = |places: &[Vector3<f64>]| elastic_fluid(&Uneven([a, b]), places, 0.0, 3.0).expect("residual");
    let by_hand = |x: &Vector3<f64>| 3.0 * (2.0 * a / (1.0 + 2.0 * a * x[0])).hypot(2.0 * b / (1.0 + 2.0 * b * x[1]));
    for place in particles() {
        assert_close_at_scale("Grad det F", &[found(&[place])], &[by_hand(&place)], 1.0, Tol::ulps(32.0));
    }
    let largest = particles().iter().map(by_hand).fold(0.0, f64::max);
    assert_close_at_scale("the largest", &[found(&particles())], &[largest], 1.0, Tol::ulps(32.0));
}

/// X + a X², Y + b Y².
struct Uneven([f64; 2]);

impl Motion for Uneven {
    fn place<T: Real>(&self, x: &Vector3<T>, _t: T) -> Vector3<T> {
        let [a, b] = self.0.map(T::lit);
        Vector3::new(x[0] + a * x[0] * x[0], x[1] + b * x[1] * x[1], x[2] + x[0] * x[1])
    }
}

/// Angles θ = Θ + 0.3 R²: no logarithm.
struct Swirl;

impl Motion for Swirl {
    fn place<T: Real>(&self, x: &Vector3<T>, _t: T) -> Vector3<T> {
        let (sin, cos) = (T::lit(0.3) * (x[0] * x[0] + x[1] * x[1])).sin_cos();
        Vector3::new(x[0] * cos - x[1] * sin, x[0] * sin + x[1] * cos, x[2])
    }
}

/// The volume changes.
struct Swell;

impl Motion for Swell {
    fn place<T: Real>(&self, x: &Vector3<T>, _t: T) -> Vector3<T> {
        x * T::lit(1.5)
    }
}
