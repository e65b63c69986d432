//! What is refused, by name and number; what looks wrong and is not.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{ContinuumError, DisplacementGradient, FirstPiola};
use piola_fields::FieldsError;
use piola_fields::Motion;
use piola_fields::integral::{
    AdaptiveQuadrature, Ball, Cuboid, Cylinder, Ellipsoid, EstimatedQuadrature, ExplicitMotion, LinearTetrahedra,
    MovedRegion, QuadraticTetrahedra, Quadrature, SphericalShell, TetrahedralMesh,
};
use piola_numerics::Real;

fn corners() -> Vec<Vector3<f64>> {
    vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z(), Vector3::repeat(1.0)]
}

#[test]
fn inverted_element_is_named() {
    let error = TetrahedralMesh::new(corners(), vec![[1, 2, 3, 4], [1, 0, 2, 3]]).expect_err("inverted");
    assert!(matches!(error, FieldsError::InvertedElement { element: 1, volume } if volume < 0.0), "{error}");
}

#[test]
fn flat_element_is_named() {
    let mut vertices = corners();
    vertices[3] = Vector3::new(0.3, 0.3, 1e-17);
    let error = TetrahedralMesh::new(vertices, vec![[0, 1, 2, 3]]).expect_err("flat");
    assert!(matches!(error, FieldsError::FlatElement { element: 0, .. }), "{error}");
    // Thin is not flat, and small is not flat.
    let thin = |z: f64, size: f64| {
        let vertices = vec![Vector3::zeros(), Vector3::x() * size, Vector3::y() * size, Vector3::z() * z * size];
        TetrahedralMesh::new(vertices, vec![[0, 1, 2, 3]])
    };
    assert!(thin(1e-10, 1.0).is_ok());
    assert!(thin(1.0, 1e-90).is_ok());
    // Beyond the range of numbers nothing can be said.
    assert!(matches!(thin(1.0, 1e-110), Err(FieldsError::FlatElement { .. })));
    assert!(matches!(thin(1.0, 1e150), Err(FieldsError::FlatElement { .. })));
}

#[test]
fn vertices_that_do_not_fit_are_named() {
    let new = |tetrahedra: Vec<[usize; 4]>| TetrahedralMesh::new(corners(), tetrahedra).expect_err("refused");
    assert_eq!(new(vec![]), FieldsError::EmptyMesh);
    assert_eq!(new(vec![[0, 1, 2, 7]]), FieldsError::NoSuchVertex { element: 0, vertex: 7, count: 5 });
    assert_eq!(new(vec![[0, 1, 1, 3]]), FieldsError::RepeatedVertex { element: 0, vertex: 1 });
    assert_eq!(new(vec![[0, 1, 2, 3]]), FieldsError::UnusedVertex { vertex: 4 });
    let mut vertices = corners();
    vertices[2].y = f64::NAN;
    let error = TetrahedralMesh::new(vertices, vec![[0, 1, 2, 3]]).expect_err("not a number");
    assert!(matches!(error, FieldsError::NotFinite { quantity: "vertex", index: 7, .. }), "{error}");
}

#[test]
fn elements_on_one_side_of_a_face_are_named() {
    let mut vertices = corners();
    vertices.push(Vector3::new(0.1, 0.2, 2.0));
    // Both stand on the triangle 0 1 2.
    let error = TetrahedralMesh::new(vertices, vec![[0, 1, 2, 3], [1, 2, 3, 4], [0, 1, 2, 5]]).expect_err("overlap");
    assert_eq!(error, FieldsError::OverlappingElements { face: [0, 1, 2], elements: [0, 2] });
    // Given twice, the same element overlaps itself.
    let error = TetrahedralMesh::new(corners(), vec![[1, 2, 3, 4], [0, 1, 2, 3], [0, 1, 2, 3]]).expect_err("overlap");
    assert!(matches!(error, FieldsError::OverlappingElements { elements: [1, 2], .. }), "{error}");
}

#[test]
fn sizes_that_are_not_positive_are_named() {
    let zero = Vector3::zeros();
    let cuboid = Cuboid::new(zero, Vector3::new(1.0, 0.0, 1.0)).expect_err("flat");
    assert_eq!(cuboid, FieldsError::NotPositive { quantity: "edge", index: 1, value: 0.0 });
    assert!(matches!(Cuboid::new(Vector3::repeat(-1e308), Vector3::repeat(1e308)), Err(FieldsError::NotFinite { .. })));
    assert!(matches!(Ball::new(zero, -1.0), Err(FieldsError::NotPositive { quantity: "radius", .. })));
    assert!(matches!(Ball::new(zero, f64::NAN), Err(FieldsError::NotFinite { quantity: "radius", .. })));
    assert!(matches!(Ball::new(Vector3::repeat(f64::INFINITY), 1.0), Err(FieldsError::NotFinite { .. })));
    assert!(SphericalShell::new(zero, [0.0, 1.0]).is_err() && SphericalShell::new(zero, [1.0, 1.0]).is_err());
    assert!(Cylinder::new(zero, zero, [0.0, 1.0]).is_err() && Cylinder::new(zero, Vector3::x(), [-1.0, 1.0]).is_err());
    assert!(Cylinder::new(zero, Vector3::x(), [1.0, 0.5]).is_err());
    assert!(matches!(
        Ellipsoid::new(zero, -Matrix3::identity()),
        Err(FieldsError::Continuum(ContinuumError::NonPositiveJacobian { .. }))
    ));
}

#[test]
fn integrand_that_is_no_number_is_located() {
    let unit = Cuboid::new(Vector3::repeat(-1.0), Vector3::repeat(1.0)).expect("a box");
    let rules = Quadrature::of_degree(4).expect("rules");
    let error = rules.volume_integral(&unit, |x: &Vector3<f64>| [1.0, 1.0 / x.y]).expect_err("a pole at zero");
    let expected = [-(0.6_f64.sqrt()), 0.0, -(0.6_f64.sqrt())];
    match error {
        FieldsError::IntegrandNotFinite { position, component: 1, value } if value.is_infinite() => {
            piola_testkit::assert_close("place", &position, &expected, piola_testkit::Tol::ulps(4.0));
        }
        other => panic!("{other}"),
    }
}

#[test]
fn integral_beyond_the_range_of_numbers_is_refused() {
    let rules = Quadrature::of_degree(1).expect("rules");
    let vast = Cuboid::new(Vector3::zeros(), Vector3::repeat(1e120)).expect("a box");
    let error = rules.volume_integral(&vast, |_: &Vector3<f64>| 1.0).expect_err("1e360");
    assert!(matches!(error, FieldsError::NotFinite { quantity: "integral", index: 0, .. }), "{error}");
}

#[test]
fn motion_that_turns_a_region_inside_out_is_refused() {
    struct Fold;
    impl Motion for Fold {
        fn place<T: Real>(&self, x: &Vector3<T>, time: T) -> Vector3<T> {
            Vector3::new(x.x * x.x * time, x.y, x.z)
        }
    }
    let unit = Cuboid::new(Vector3::repeat(-1.0), Vector3::repeat(1.0)).expect("a box");
    let moved = MovedRegion { region: &unit, motion: &Fold, time: 1.0 };
    let error = Quadrature::of_degree(3).expect("rules").volume_integral(&moved, |_| 1.0).expect_err("folded");
    assert!(
        matches!(error, FieldsError::Continuum(ContinuumError::NonPositiveJacobian { determinant }) if determinant < 0.0),
        "{error}"
    );
}

#[test]
fn degrees_above_the_limit_are_refused() {
    let error = Quadrature::of_degree(Quadrature::LIMIT + 1).expect_err("too high");
    assert_eq!(error, FieldsError::DegreeTooHigh { degree: 257, limit: 256 });
    assert!(EstimatedQuadrature::of_degree(255).is_err() && EstimatedQuadrature::of_degree(usize::MAX).is_err());
    assert!(AdaptiveQuadrature::up_to_degree(1000).is_err());
}

#[test]
fn adaptive_integral_of_a_jump_reports_what_it_reached() {
    let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0)).expect("a box");
    let rules = AdaptiveQuadrature::up_to_degree(20).expect("rules");
    let jump = |x: &Vector3<f64>| if x.x < 0.3 { 1.0 } else { 0.0 };
    let error = rules.volume_integral(&unit, 1e-10, jump).expect_err("not smooth");
    assert!(matches!(error, FieldsError::IntegralNotConverged { degree: 20, error, .. } if 1e-10 < error), "{error}");
    let nothing = rules.volume_integral(&unit, 1e-10, |_: &Vector3<f64>| 0.0_f64).expect("zero");
    assert_eq!(nothing.value.to_bits(), 0.0_f64.to_bits());
}

#[test]
fn displacement_that_turns_an_element_inside_out_is_named() {
    let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0)).expect("a box");
    let body = LinearTetrahedra::new(TetrahedralMesh::of_cuboid(&unit, [1, 1, 1]).expect("a mesh"), 0).expect("a body");
    let mut displacement = vec![0.0; body.components()];
    displacement[0] = 2.0; // the corner at the origin, through the opposite faces
    let mut forces = vec![0.0; body.components()];
    let law = |_: &_, _: &DisplacementGradient| Ok(FirstPiola::zero());
    let error = body.add_stress_forces(&displacement, law, &mut forces).expect_err("inside out");
    assert!(matches!(error, FieldsError::InvertedElement { element: 0, volume } if volume <= 0.0), "{error}");
    displacement[0] = f64::NAN;
    let error = body.add_stress_forces(&displacement, law, &mut forces).expect_err("not a number");
    assert!(matches!(error, FieldsError::NotFinite { .. }), "{error}");
    let error = body.add_stress_forces(&[0.0], law, &mut forces).expect_err("too short");
    assert_eq!(error, FieldsError::WrongLength { quantity: "displacement", found: 1, expected: 24 });
}

#[test]
fn masses_and_damping_that_cannot_be_are_named() {
    let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0)).expect("a box");
    let mesh = TetrahedralMesh::of_cuboid(&unit, [1, 1, 1]).expect("a mesh");
    let body = QuadraticTetrahedra::new(mesh, 4).expect("a body");
    let mut masses = vec![0.0; body.nodes().len()];
    let error = body.lumped_mass_into(|_| -1.0, &mut masses).expect_err("negative");
    assert!(matches!(error, FieldsError::NonPositiveMass { index: 0, .. }), "{error}");
    assert!(body.lumped_mass_into(|_| f64::NAN, &mut masses).is_err());
    // More mass than none, but not everywhere.
    assert!(body.lumped_mass_into(|x| if x.x < 0.2 { -1e3 } else { 1e3 }, &mut masses).is_err());
    assert!(body.stable_step(0.0).is_err() && body.stable_step(f64::NAN).is_err());
    let error = ExplicitMotion::new(&[1.0, 0.0], &[0.0; 2]).expect_err("no mass");
    assert_eq!(error, FieldsError::NonPositiveMass { index: 1, mass: 0.0 });
    let error = ExplicitMotion::new(&[1.0], &[-1.0]).expect_err("negative");
    assert_eq!(error, FieldsError::NegativeDamping { node: 0, damping: -1.0 });
    let mut motion = ExplicitMotion::new(&[1.0], &[0.0]).expect("a node");
    assert!(motion.set_state(0.0, &[f64::NAN, 0.0, 0.0], &[0.0; 3]).is_err());
    assert!(motion.hold(3).is_err());
    let wild = |_: f64, _: &[f64], forces: &mut [f64]| {
        forces[0] = f64::NAN;
        Ok(())
    };
    assert!(matches!(motion.step(0.1, wild), Err(FieldsError::NotFinite { quantity: "force", index: 0, .. })));
    assert!(motion.step(f64::NAN, |_, _, _| Ok(())).is_err());
}

#[test]
fn held_components_stay() {
    let mut motion = ExplicitMotion::new(&[1.0], &[0.0]).expect("a node");
    motion.set_state(0.0, &[1.0, 2.0, 3.0], &[1.0; 3]).expect("finite");
    motion.hold(1).expect("a component");
    motion
        .step(0.5, |_, _, forces| {
            forces.fill(1.0);
            Ok(())
        })
        .expect("finite");
    assert_eq!(motion.displacement()[1].to_bits(), 2.0_f64.to_bits());
    assert_eq!(motion.displacement()[0].to_bits(), 1.625_f64.to_bits());
}

#[cfg(feature = "serde")]
#[test]
fn written_regions_and_meshes_are_read_with_their_checks() {
    fn round_trip<V: serde::Serialize + serde::de::DeserializeOwned + PartialEq + core::fmt::Debug>(value: &V) {
        let text = serde_json::to_string(value).expect("written");
        assert_eq!(&serde_json::from_str::<V>(&text).expect("read"), value, "{text}");
    }
    let centre = Vector3::new(0.1, 0.2, 0.3);
    round_trip(&Cuboid::new(Vector3::zeros(), centre).expect("a box"));
    round_trip(&Ball::new(centre, 2.0).expect("a ball"));
    round_trip(&SphericalShell::new(centre, [1.0, 2.0]).expect("a shell"));
    round_trip(&Ellipsoid::new(centre, Matrix3::new(1.0, 2.0, 0.0, 0.0, 3.0, 4.0, 0.5, 0.0, 6.0)).expect("a body"));
    round_trip(&Cylinder::new(centre, Vector3::z(), [0.0, 2.0]).expect("a cylinder"));
    let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0)).expect("a box");
    round_trip(&TetrahedralMesh::of_cuboid(&unit, [2, 1, 1]).expect("a mesh"));
    round_trip(&Quadrature::of_degree(7).expect("rules"));
    round_trip(&EstimatedQuadrature::of_degrees(2, 5).expect("rules"));
    round_trip(&AdaptiveQuadrature::up_to_degree(20).expect("rules"));
    assert!(serde_json::from_str::<Quadrature>("1000").is_err());
    assert!(serde_json::from_str::<AdaptiveQuadrature>("1000").is_err());
    assert!(serde_json::from_str::<Ball>("[[0,0,0],-1]").is_err());
    let inverted = r#"{"vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"tetrahedra":[[1,0,2,3]]}"#;
    assert!(serde_json::from_str::<TetrahedralMesh>(inverted).is_err());
}
