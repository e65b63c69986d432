//! Bad input is refused by name.

use nalgebra::{Matrix3, Vector3};
use piola_fields::{FieldsError, Interpolation, Uniform};
use piola_numerics::{Lanes, Real};
use piola_tensor::{Symmetric, TensorError};
use piola_uniformity::laminated::{HomogeneousPlate, HomogeneousTube, LaminatedPlate, LaminatedSphere, LaminatedTube};
use piola_uniformity::{
    AffineConnection, ConstantMap, DislocationDensity, Flatness, InverseMap, LieAlgebra, MaterialConnection,
    MetricGeometry, MoebiusCrystal, NominalGroup, SampledUniformityMap, UniformityError, UniformityMap,
    UniformityMapSamples,
};

fn origin() -> Vector3<f64> {
    Vector3::zeros()
}

/// diag(1, 1, X₁).
#[derive(Clone, Copy, Debug)]
struct Flattening;

impl UniformityMap for Flattening {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        Matrix3::from_diagonal(&Vector3::new(T::one(), T::one(), reference.x))
    }
}

#[test]
fn singular_and_reversing_maps_are_refused_by_name() {
    let place = |x: f64| Vector3::new(x, 2.0, 3.0);
    let singular = Flattening.value(&place(0.0));
    assert!(matches!(singular, Err(UniformityError::SingularMap { place: [_, 2.0, 3.0], .. })), "{singular:?}");
    let reversing = Flattening.value(&place(-0.5));
    assert!(matches!(reversing, Err(UniformityError::OrientationReversing { determinant, .. }) if determinant < -0.4));
    // Of everything that follows from the map, too, and of a map by its inverse.
    let connection = MaterialConnection::of_crystal(Flattening);
    for refused in [
        connection.torsion(&place(-0.5)).map(|_| ()),
        connection.curvature(&place(-0.5)).map(|_| ()),
        DislocationDensity::of(&Flattening, &place(-0.5)).map(|_| ()),
        InverseMap(Flattening).value(&place(-0.5)).map(|_| ()),
        Flatness::of_body(&Flattening, LieAlgebra::trivial(), &[place(1.0), place(-0.5)], 1.0, 1e-9).map(|_| ()),
    ] {
        assert!(matches!(refused, Err(UniformityError::OrientationReversing { .. })), "{refused:?}");
    }
    // A rank of two, to rounding.
    let flat = ConstantMap(Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0));
    assert!(matches!(flat.value(&origin()), Err(UniformityError::SingularMap { .. })));
    // In one of several lanes.
    let lanes = Vector3::new(Lanes([1.0, -0.5, 2.0, 3.0]), Lanes([0.0; 4]), Lanes([0.0; 4]));
    let refused = Flattening.value(&lanes);
    assert!(matches!(refused, Err(UniformityError::OrientationReversing { place: [x, ..], .. }) if x < 0.0));
    assert!(matches!(
        Flattening.value(&place(f64::NAN)),
        Err(UniformityError::NotFinite { quantity: "X", index: 0, .. })
    ));
}

#[test]
fn a_singular_sample_is_refused_with_its_node() {
    let nodes = [2, 3, 4].map(|count: u32| (0..count).map(f64::from).collect::<Vec<_>>());
    let mut values = vec![Matrix3::identity(); 24];
    // The node (1, 2, 1), the last axis first.
    values[12 + 2 * 4 + 1] = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0));
    let samples = UniformityMapSamples { nodes, values, interpolation: Interpolation::Linear };
    let refused = SampledUniformityMap::new(samples);
    assert!(matches!(refused, Err(UniformityError::SingularMap { place: [1.0, 2.0, 1.0], .. })), "{refused:?}");
}

#[test]
fn metrics_that_are_not_positive_definite_are_refused_by_name() {
    let metric = Uniform(Symmetric::diagonal([1.0, -1.0, 1.0]));
    assert!(matches!(
        MetricGeometry::of(&metric, &origin()),
        Err(UniformityError::Continuum(piola_continuum::ContinuumError::Tensor(TensorError::NotPositiveDefinite {
            order: 2,
            ..
        })))
    ));
}

#[test]
fn algebras_and_groups_are_checked() {
    let (x, y) = (Vector3::x().cross_matrix(), Vector3::y().cross_matrix());
    assert!(matches!(LieAlgebra::spanned_by(&[x, y, x + y]), Err(UniformityError::DependentBasis { index: 2, .. })));
    assert!(matches!(LieAlgebra::spanned_by(&[x, y]), Err(UniformityError::NotAnAlgebra { first: 0, second: 1, .. })));
    assert_eq!(LieAlgebra::spanned_by(&[x, y, Vector3::z().cross_matrix()]).expect("so(3)").dimension(), 3);
    assert!(matches!(
        LieAlgebra::rotations_about(Vector3::zeros()),
        Err(UniformityError::OutOfBounds { quantity: "axis", .. })
    ));
    let stretch = Matrix3::identity() * 2.0;
    assert!(matches!(NominalGroup::generated(&[stretch], 8), Err(UniformityError::OutOfBounds { .. })));
    // An irrational turn generates no finite group.
    let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), 1.0).into_inner();
    assert!(matches!(
        NominalGroup::generated(&[turn], 100),
        Err(UniformityError::OutOfBounds { quantity: "number of elements", .. })
    ));
}

#[test]
fn samples_are_checked() {
    let samples = |values| UniformityMapSamples {
        nodes: [vec![0.0, 1.0], vec![0.0], vec![0.0]],
        values,
        interpolation: Interpolation::Cubic,
    };
    let one = Matrix3::identity();
    assert!(matches!(
        SampledUniformityMap::new(samples(vec![one])),
        Err(UniformityError::WrongLength { found: 1, expected: 2, .. })
    ));
    assert!(matches!(
        SampledUniformityMap::new(samples(vec![one, -one])),
        Err(UniformityError::OrientationReversing { place: [x, ..], .. }) if x > 0.5
    ));
    let map = SampledUniformityMap::new(samples(vec![one, one * 2.0])).expect("samples");
    assert!(matches!(
        map.value(&Vector3::new(1.5, 0.0, 0.0)),
        Err(UniformityError::Fields(FieldsError::OutsideSamples { .. }))
    ));
    // Lanes in different cells take their own values.
    let wide = UniformityMapSamples {
        nodes: [(0..9).map(f64::from).collect(), vec![0.0], vec![0.0]],
        values: (0..9).map(|i| one * (1.0 + f64::from(i * i))).collect(),
        interpolation: Interpolation::Cubic,
    };
    let map = SampledUniformityMap::new(wide).expect("samples");
    let lanes = map.at(&Vector3::new(Lanes([0.25, 3.5, 7.75, 4.0]), Lanes([0.0; 4]), Lanes([0.0; 4])));
    for (lane, x) in [0.25, 3.5, 7.75, 4.0_f64].into_iter().enumerate() {
        let single = map.at(&Vector3::new(x, 0.0, 0.0))[(1, 1)];
        assert!((lanes[(1, 1)].0[lane] - single).abs() <= 4.0 * f64::EPSILON * single);
        assert!((single - (1.0 + x * x)).abs() <= 32.0 * f64::EPSILON * single, "a parabola is given back");
    }
}

#[test]
fn laminates_are_checked() {
    let out = |result: Result<(), UniformityError>, name: &str| {
        let is_it = matches!(&result, Err(UniformityError::OutOfBounds { quantity, .. }) if *quantity == name);
        assert!(is_it, "{name}: {result:?}");
    };
    out(LaminatedPlate::new(HomogeneousPlate, [1.0, 0.0]).map(|_| ()), "outer depth");
    out(LaminatedTube::new(HomogeneousTube, [-1.0, 1.0]).map(|_| ()), "inner radius");
    let tube = LaminatedTube::new(HomogeneousTube, [1.0, 2.0]).expect("a tube");
    out(tube.inflated(1.0, [[1.0, 1.0], [1.0, 1.0]]).map(|_| ()), "Δ");
    // Everted about a radius that is too small: r² would be negative.
    out(tube.inflated(1.0, [[1.0, 0.0], [0.0, -1.0]]).map(|_| ()), "square of the radius");
    let sphere = LaminatedSphere::new(HomogeneousTube, [1.0, 2.0]).expect("a shell");
    out(sphere.everted(1.0).map(|_| ()), "cube of the radius");
    out(sphere.inflated(1.0).expect("a state").radius(2.5).map(|_| ()), "depth");
    out(MoebiusCrystal::new(0.0).map(|_| ()), "radius");
    let on_the_axis = MoebiusCrystal::new(1.0).expect("a ring").value(&Vector3::new(0.0, 0.0, 1.0));
    assert!(matches!(on_the_axis, Err(UniformityError::Fields(FieldsError::SingularCoordinates { .. }))));
}
