//! Where the obvious way goes wrong, and what is refused by name.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::ContinuumError;
use piola_continuum::Symmetric;
use piola_continuum::{Deformation, DeformationGradient};
use piola_fields::FieldsError;
use piola_fields::compatibility::Curvature;
use piola_fields::{
    Affine, Cartesian, Coordinates, Cylindrical, Field, Inversion, Material, Motion, Spatial, Spherical, Uniform,
};
use piola_numerics::{Lanes, Real};
use piola_tensor::TensorError;
use piola_testkit::{Tol, assert_close};

use super::fixtures::{Tensor, Wave};

const TINY: Wave = Wave { amplitude: 1e-20, phase: [0.1, 0.2, 0.3], frequency: 1.0 };

#[test]
fn displacement_gradient_of_a_tiny_strain_equals_that_by_hand() {
    let x = Vector3::new(0.3, -0.2, 0.7);
    let gradient = TINY.displacement_gradient(&x, 0.5).expect("∇u");
    assert_close("∇u", gradient.matrix().as_slice(), TINY.by_hand(&x, 0.5, 0).1.as_slice(), Tol::ulps(8.0));
    // From F nothing of it is left.
    let rows = TINY.deformation_gradient(&x, 0.5).expect("F").displacement_rows();
    assert_close("F − 1", rows.as_flattened(), &[0.0; 9], Tol::ulps(1.0));
}

#[test]
fn divergence_contracts_the_last_index_and_not_the_first() {
    // T₁₂ = x₂, T₂₁ = 0: the last index gives (1, 0, 0), the first (0, 0, 0).
    struct Skewed;
    impl Field for Skewed {
        type Value = Matrix3<f64>;
        fn at<T: Real>(&self, place: &Vector3<T>, _time: T) -> Matrix3<T> {
            let o = T::zero();
            Matrix3::new(o, place.y, o, o, o, o, o, o, o)
        }
    }
    let divergence = Cartesian.divergence(&Skewed, &Vector3::zeros(), 0.0).expect("div T");
    assert_eq!(divergence, Vector3::new(1.0, 0.0, 0.0));
}

#[test]
fn axis_poles_and_centre_are_refused_by_name() {
    let field = Tensor { coefficients: [1.0; 9] };
    let vector = Uniform(Vector3::new(1.0, 2.0, 3.0));
    for (r, phi) in [(0.0, 1.0), (-1.0, 1.0), (1.0, 0.0), (1.0, -0.5), (1.0, 4.0), (0.0, 0.0)] {
        let q = Vector3::new(r, 0.3, phi);
        let spherical = Spherical.divergence(&field, &q, 0.0);
        assert!(matches!(spherical, Err(FieldsError::SingularCoordinates { .. })), "{spherical:?}");
        assert!(matches!(Spherical.local_basis(&q), Err(FieldsError::SingularCoordinates { .. })));
        assert!(matches!(Spherical.vector_gradient(&vector, &q, 0.0), Err(FieldsError::SingularCoordinates { .. })));
    }
    // Told is the distance from the axis, r sin φ.
    let beyond = Spherical.local_basis(&Vector3::new(2.0, 0.3, -0.5));
    let Err(FieldsError::SingularCoordinates { volume_element: radius, .. }) = beyond else { panic!("{beyond:?}") };
    assert_close("r sin φ", &[radius], &[2.0 * (-0.5_f64).sin()], Tol::ulps(2.0));
    let axis = Vector3::new(0.0, 0.3, 1.0);
    let Err(FieldsError::SingularCoordinates { coordinates, volume_element }) =
        Cylindrical.divergence(&field, &axis, 0.0)
    else {
        panic!("the axis was not refused");
    };
    assert_eq!((coordinates, volume_element.to_bits()), ([0.0, 0.3, 1.0], 0));
    assert!(matches!(Cylindrical.laplacian(&Uniform(1.0), &axis, 0.0), Err(FieldsError::SingularCoordinates { .. })));
}

#[test]
fn points_close_to_the_axis_keep_their_accuracy() {
    // T = 1: the divergence is zero however large 1/r.
    for r in [1e-3, 1e-100, 1e-300] {
        let q = Vector3::new(r, 0.3, 1.0);
        let identity = Uniform(Matrix3::<f64>::identity());
        assert_eq!(Cylindrical.divergence(&identity, &q, 0.0).expect("div 1"), Vector3::zeros());
    }
}

#[test]
fn skew_coordinates_have_no_physical_components() {
    struct Slanted;
    impl Coordinates for Slanted {
        fn place<T: Real>(&self, q: &Vector3<T>) -> Vector3<T> {
            Vector3::new(q[0] + q[1], q[1], q[2])
        }
    }
    let Err(FieldsError::NotOrthogonal { row, column, cosine }) = Slanted.physical_frame(&Vector3::<f64>::zeros())
    else {
        panic!("a slanted basis was taken for orthogonal");
    };
    assert_eq!((row, column), (0, 1));
    assert_close("cosine", &[cosine], &[core::f64::consts::FRAC_1_SQRT_2], Tol::ulps(2.0));
    let field = Tensor { coefficients: [1.0; 9] };
    assert!(Slanted.divergence(&field, &Vector3::<f64>::zeros(), 0.0).is_err());
    assert!(Slanted.local_basis(&Vector3::<f64>::zeros()).is_ok());
}

#[test]
fn coordinates_are_regular_in_any_unit_and_singular_where_two_lines_run_together() {
    /// The third line is inclined to the first by `angle`, and measured in a unit of its own.
    struct Inclined {
        angle: f64,
        unit: f64,
    }
    impl Coordinates for Inclined {
        fn place<T: Real>(&self, q: &Vector3<T>) -> Vector3<T> {
            let along = q[2] * T::lit(self.unit);
            Vector3::new(q[0] + along * T::lit(self.angle.cos()), q[1], along * T::lit(self.angle.sin()))
        }
    }
    for unit in [1e-12, 1.0, 1e12] {
        let basis = |angle: f64| Inclined { angle, unit }.local_basis(&Vector3::new(0.3, 0.2, 0.1));
        let regular = basis(0.5).expect("half a radian apart");
        // g³ is across the first two lines: (0, 0, 1/(unit sin)).
        assert_close("g³", &regular.dual[2], &[0.0, 0.0, 1.0 / (unit * 0.5_f64.sin())], Tol::ulps(4.0));
        assert!(matches!(basis(1e-15), Err(FieldsError::SingularCoordinates { .. })), "{unit:e}");
    }
}

/// x₁ = X₁²: folded along X₁ = 0, and nothing lies at x₁ < 0.
struct Fold;
impl Motion for Fold {
    fn place<T: Real>(&self, reference: &Vector3<T>, _time: T) -> Vector3<T> {
        Vector3::new(reference.x * reference.x, reference.y, reference.z)
    }
}

#[test]
fn folded_motion_is_refused_where_the_gradient_is_asked_for() {
    let folded = Vector3::new(-1.0, 0.0, 0.0);
    assert_eq!(
        Fold.deformation_gradient(&folded, 0.0).map(|_| ()),
        Err(FieldsError::Continuum(ContinuumError::NonPositiveJacobian { determinant: -2.0 }))
    );
    assert!(matches!(
        Fold.velocity_gradient(&Vector3::zeros(), 0.0),
        Err(FieldsError::Continuum(ContinuumError::NonPositiveJacobian { .. }))
    ));
    assert!(Fold.velocity(&folded, 0.0).is_ok());
}

#[test]
fn place_without_a_particle_is_refused_with_the_best_one() {
    let place = Vector3::new(-1.0, 2.0, 3.0);
    let guess = Vector3::new(1.0, 2.0, 3.0);
    let found = Inversion::default().preimage_near(&Fold, &place, 0.0, &guess);
    let Err(FieldsError::InversionFailed { best, residual, determinant, iterations, .. }) = found else {
        panic!("a particle was found where there is none: {found:?}");
    };
    // The residual 1 + X² is least at the fold.
    assert!(0.0 < determinant && best[0].abs() < 0.1 && 1.0 <= residual && residual < 1.1 && 0 < iterations);
    // From behind the fold nothing is tried.
    assert!(matches!(
        Inversion::default().preimage_near(&Fold, &Vector3::new(1.0, 0.0, 0.0), 0.0, &Vector3::new(-1.0, 0.0, 0.0)),
        Err(FieldsError::Continuum(ContinuumError::NonPositiveJacobian { .. }))
    ));
}

#[test]
fn place_on_the_fold_has_no_certificate() {
    // X = 0 solves x = 0 but F is singular there: no ball of uniqueness.
    let found = Inversion::default().preimage_near(&Fold, &Vector3::zeros(), 0.0, &Vector3::new(1.0, 0.0, 0.0));
    let Err(FieldsError::InversionFailed { change, .. }) = found else {
        panic!("the fold was certified: {found:?}");
    };
    assert!(0.5 < change);
}

/// x₁ = X₁ − X₁ⁿ: the second gradient, for n = 5 the third and fourth too, vanishes at 0, which shares its place with ±1.
struct OddPower(i32);
impl Motion for OddPower {
    fn place<T: Real>(&self, reference: &Vector3<T>, _time: T) -> Vector3<T> {
        let power = (0..self.0).fold(T::one(), |power, _| power * reference.x);
        Vector3::new(reference.x - power, reference.y, reference.z)
    }
}

#[test]
fn uniqueness_where_higher_gradients_vanish_ends_before_the_next_particle() {
    for power in [3, 5, 7] {
        let motion = OddPower(power);
        let found = Inversion::default().preimage(&motion, &Vector3::zeros(), 0.0).expect("X");
        assert!(found.error_bound <= 1e-14, "{found:?}");
        for reach in [0.9, 1.0, 8.0, 1e3, 1e9, 1e15] {
            let radius = found.uniqueness_radius(&motion, 0.0, reach).expect("radius");
            // |n ρⁿ⁻¹| ≤ 1 is where the fold begins; ½ of it is asked for, and ρ halves.
            let fold = f64::from(power).recip().powf(f64::from(power - 1).recip());
            assert!(radius < fold && fold / 4.0 < radius, "n = {power}, reach {reach}: {radius}, fold {fold}");
        }
    }
}

#[test]
fn uniqueness_in_a_wave_ends_before_the_next_crest() {
    // sin X has its crest at π/2, beyond which places come again; the second gradient at 10⁻⁹ is 10⁻⁹.
    struct Sine;
    impl Motion for Sine {
        fn place<T: Real>(&self, reference: &Vector3<T>, _time: T) -> Vector3<T> {
            Vector3::new(reference.x.sin(), reference.y, reference.z)
        }
    }
    let place = Vector3::new(1e-9_f64.sin(), 0.0, 0.0);
    let found = Inversion::default().preimage(&Sine, &place, 0.0).expect("X");
    for reach in [1.0, 3.0, 10.0, 1e3, 1e9, 1e12] {
        let radius = found.uniqueness_radius(&Sine, 0.0, reach).expect("radius");
        assert!(0.5 <= radius && radius <= core::f64::consts::FRAC_PI_3, "reach {reach}: {radius}");
    }
    let lanes = Lanes::<f64, 2>::from([1e-9, 1.0]);
    let place = Vector3::new(lanes.sin(), Lanes::lit(0.0), Lanes::lit(0.0));
    let found = Inversion::default().preimage(&Sine, &place, Lanes::lit(0.0)).expect("X");
    let radius = found.uniqueness_radius(&Sine, Lanes::lit(0.0), Lanes::lit(8.0)).expect("radius");
    assert!(radius.primal(0) <= core::f64::consts::FRAC_PI_3 && radius.primal(1) < 0.5, "{radius:?}");
}

#[test]
fn uniqueness_of_an_affine_motion_reaches_as_far_as_asked() {
    let stretch = DeformationGradient::new(Matrix3::new(2.0, 1.0, 0.0, 0.0, 1.0, 0.5, 0.0, 0.0, 3.0)).expect("F");
    let motion = Affine::new(stretch, Vector3::new(1.0, 2.0, 3.0)).expect("motion");
    let found = Inversion::default().preimage(&motion, &Vector3::new(0.3, 0.2, 0.1), 0.0).expect("X");
    assert_eq!(found.uniqueness_radius(&motion, 0.0, 1e6), Ok(1e6));
    assert!(matches!(
        found.uniqueness_radius(&motion, 0.0, f64::INFINITY),
        Err(FieldsError::NotFinite { quantity: "reach", .. })
    ));
}

#[test]
fn far_guess_is_damped_and_not_lost() {
    // Newton's full step from the flat part of the arctangent overshoots without end.
    struct Flattening;
    impl Motion for Flattening {
        fn place<T: Real>(&self, reference: &Vector3<T>, _time: T) -> Vector3<T> {
            Vector3::new(reference.x.atan(), reference.y, reference.z)
        }
    }
    let guess = Vector3::new(20.0, 0.0, 0.0);
    let found = Inversion::default().preimage_near(&Flattening, &Vector3::zeros(), 0.0, &guess).expect("X");
    assert!(found.reference.amax() <= found.error_bound && found.error_bound < 1e-14, "{found:?}");
}

#[test]
fn one_lane_without_a_particle_is_named() {
    type Pair = Lanes<f64, 4>;
    let place = Vector3::new(Pair::from([4.0, -1.0, 1.0, 1.0]), Pair::lit(0.0), Pair::lit(0.0));
    let guess = Vector3::new(Pair::lit(1.0), Pair::lit(0.0), Pair::lit(0.0));
    let found = Inversion::default().preimage_near(&Fold, &place, Pair::lit(0.0), &guess);
    let Err(FieldsError::InversionFailed { place, .. }) = found else { panic!("{found:?}") };
    assert_close("x", &place, &[-1.0, 0.0, 0.0], Tol::ulps(0.5));
}

/// Everything is everywhere at the time zero.
struct Explosion;
impl Motion for Explosion {
    fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
        reference / time
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused_by_name() {
    let (nan, x) = (Vector3::new(0.0, f64::NAN, 0.0), Vector3::zeros());
    let is = |error: Option<FieldsError>, name: &str| {
        assert!(
            matches!(error, Some(FieldsError::NotFinite { quantity, .. }) if quantity == name),
            "{name}: {error:?}"
        );
    };
    is(TINY.velocity(&nan, 0.0).err(), "X");
    is(TINY.velocity(&x, f64::INFINITY).err(), "t");
    is(Inversion::default().preimage(&TINY, &nan, 0.0).err(), "place");
    is(Spatial(Uniform(1.0)).material_derivative(&Uniform(nan), &x, 0.0).err(), "velocity");
    is(Spatial(Uniform(f64::NAN)).value(&x, 0.0).err(), "field");
    is(Cylindrical.divergence(&Uniform(Matrix3::repeat(f64::NAN)), &Vector3::repeat(1.0), 0.0).err(), "divergence");
    is(Cylindrical.local_basis(&nan).err(), "coordinates");
    is(Explosion.position(&Vector3::repeat(1.0), 0.0).err(), "place");
    let affine = Affine::new(DeformationGradient::new(Matrix3::identity()).expect("F"), nan);
    is(affine.err(), "translation");
}

#[test]
fn metric_that_is_not_positive_definite_is_refused() {
    let indefinite = Material(Uniform(Symmetric::new(1.0, 1.0, 1.0, 2.0, 0.0, 0.0)));
    assert!(matches!(
        Curvature::of_metric(&indefinite, &Vector3::zeros(), 0.0),
        Err(FieldsError::Continuum(ContinuumError::Tensor(TensorError::NotPositiveDefinite { order: 2, .. })))
    ));
}

#[test]
fn velocity_does_not_ask_for_the_deformation_gradient() {
    // A motion that counts what it is asked over: three orders of derivative scalars.
    use core::sync::atomic::{AtomicUsize, Ordering};
    #[derive(Default)]
    struct Counting {
        orders: [AtomicUsize; 3],
        bytes: AtomicUsize,
    }
    impl Motion for Counting {
        fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
            self.orders[T::ORDER].fetch_add(1, Ordering::Relaxed);
            self.bytes.fetch_max(size_of::<T>(), Ordering::Relaxed);
            reference * time
        }
    }
    let count = |ask: &dyn Fn(&Counting)| {
        let motion = Counting::default();
        ask(&motion);
        let orders = motion.orders.each_ref().map(|n| n.load(Ordering::Relaxed));
        (orders, motion.bytes.load(Ordering::Relaxed) / 8)
    };
    let x = Vector3::repeat(1.0);
    assert_eq!(count(&|m| drop(m.position(&x, 1.0))), ([1, 0, 0], 1));
    assert_eq!(count(&|m| drop(m.velocity(&x, 1.0))), ([0, 1, 0], 2)); // a value and one rate
    assert_eq!(count(&|m| drop(m.acceleration(&x, 1.0))), ([0, 0, 1], 3)); // value, rate, second rate
    assert_eq!(count(&|m| drop(m.deformation_gradient(&x, 1.0))), ([0, 1, 0], 4)); // three directions
    assert_eq!(count(&|m| drop(m.velocity_gradient(&x, 1.0))), ([0, 0, 1], 8));
}
