//! Parallel transport, development and Burgers vectors.

use nalgebra::{Matrix3, Vector3};
use piola_integrators::Tolerance;
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, assert_order};
use piola_uniformity::{
    BurgersVector, CharacteristicMetric, DislocationDensity, LeviCivita, MaterialConnection, PolygonalCurve,
    ReferenceCurve, RoundCircuit, Segment, TransportedFrame, UniformityError, UniformityMap,
};
use proptest::prelude::*;

use super::fixtures::{Golden, point, waves};

fn tight() -> Tolerance {
    Tolerance::relative(1e-13).expect("a tolerance")
}

/// The transports below take some hundred steps of 1e-13 each.
const TRANSPORT: Tol = Tol::stated(1e-11, "the integrator's tolerance of 1e-13 a step, over up to a hundred steps");

/// A space curve that bends and twists.
struct Wound {
    start: Vector3<f64>,
}

impl ReferenceCurve for Wound {
    fn place<T: Real>(&self, _piece: usize, s: T) -> Vector3<T> {
        let (sine, cosine) = (T::lit(2.0) * s).sin_cos();
        let offset = Vector3::new(cosine - T::one(), sine, s * s);
        Vector3::from_fn(|i, _| T::lit(self.start[i]) + T::lit(0.5) * offset[i])
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn transport_in_a_crystal_equals_the_map_at_the_end(map in waves(), x in point()) {
        let connection = MaterialConnection::of_crystal(map);
        let curve = Wound { start: x };
        let start = map.value(&x)?;
        let moved = TransportedFrame::along(&connection, &curve, &start, tight())?;
        let end = map.value(&curve.place(0, 1.0))?;
        assert_close("P = K", moved.end.as_slice(), end.as_slice(), TRANSPORT);
        let carried = moved.carried(&start.column(1).into_owned());
        assert_close("u", carried.as_slice(), end.column(1).as_slice(), TRANSPORT);
    }

    #[test]
    fn transport_by_a_metric_keeps_lengths(map in waves(), x in point()) {
        use piola_fields::Field as _;
        let metric = CharacteristicMetric(map);
        let curve = Wound { start: x };
        let moved = TransportedFrame::along(&LeviCivita(metric), &curve, &Matrix3::identity(), tight())?;
        let (before, after) = (metric.at(&x, 0.0).matrix(), metric.at(&curve.place(0, 1.0), 0.0).matrix());
        let carried = moved.end.transpose() * after * moved.end;
        assert_close("M", carried.as_slice(), before.as_slice(), TRANSPORT);
    }

    #[test]
    fn development_around_a_circuit_is_its_burgers_vector(map in waves(), x in point(), radius in 0.1..1.0_f64) {
        let circle = RoundCircuit::new(x, Vector3::new(1.0, 2.0, -1.0), radius)?;
        let burgers = BurgersVector::of(&map, &circle, 1e-13)?;
        let start = map.value(&circle.place(0, 0.0))?;
        let round = TransportedFrame::around(&MaterialConnection::of_crystal(map), &circle, &start, tight())?;
        assert_close_at_scale("b", round.development.as_slice(), burgers.value.as_slice(), burgers.scale.amax(), TRANSPORT);
        assert_close("holonomy", round.holonomy().as_slice(), Matrix3::<f64>::identity().as_slice(), TRANSPORT);
    }

    #[test]
    fn burgers_vector_of_a_small_triangle_is_the_density_times_its_area(map in waves(), x in point()) {
        let density = DislocationDensity::of(&map, &x)?;
        let normal = Vector3::new(2.0, -1.0, 2.0) / 3.0;
        let (first, second) = (Vector3::new(1.0, 2.0, 0.0).normalize(), normal.cross(&Vector3::new(1.0, 2.0, 0.0).normalize()));
        let mut errors = Vec::new();
        let sizes = [0.04, 0.02, 0.01];
        for size in sizes {
            // The centroid is x: the error is of the fourth order in the size, of the area of the second.
            let corner = |angle: f64| x + (first * angle.cos() + second * angle.sin()) * size;
            let third = core::f64::consts::TAU / 3.0;
            let triangle = PolygonalCurve::closed([0.0, third, 2.0 * third].map(corner).to_vec())?;
            let area = 0.75 * 3.0_f64.sqrt() * size * size;
            let burgers = BurgersVector::of(&map, &triangle, 1e-14)?.value / area;
            errors.push((burgers - density.through(&normal)).amax().max(1e-12));
        }
        // α varies over the triangle in the second order about the centroid.
        prop_assert!(errors[2] <= 0.3 * errors[1] || errors[2] <= 1e-9, "{errors:?}");
        prop_assert!(errors[1] <= 0.3 * errors[0] || errors[1] <= 1e-9, "{errors:?}");
    }
}

#[test]
fn holonomy_of_a_small_circuit_is_the_curvature_times_its_area() {
    use piola_uniformity::AffineConnection as _;
    let map = Golden::Smooth;
    let connection = LeviCivita(CharacteristicMetric(map));
    let x = Vector3::new(0.5, -0.25, 0.75);
    let curvature = connection.curvature(&x).expect("curvature").components;
    let sizes = [0.2, 0.1, 0.05];
    let errors = sizes.map(|size: f64| {
        // Counter-clockwise in the plane 1, 2, about x; u ↦ u + R^C_A12 u^A × area, in the sign convention of R.
        let corner = |a: f64, b: f64| x + Vector3::new(a, b, 0.0) * (0.5 * size);
        let square = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let square = PolygonalCurve::closed(square.to_vec()).expect("a square");
        let round = TransportedFrame::around(&connection, &square, &Matrix3::identity(), tight()).expect("transport");
        let change = (round.end - Matrix3::identity()) / (size * size);
        let expected = Matrix3::from_fn(|c, a| curvature[c][a][0][1]);
        (change - expected).amax() / expected.amax()
    });
    // The circuit starts at a corner: the frame there differs from that at the centre in the first order.
    assert_order("holonomy", &sizes, &errors, 1.0, 0.25);
}

/// Two pieces that do not meet.
struct Jump;
impl ReferenceCurve for Jump {
    fn place<T: Real>(&self, piece: usize, s: T) -> Vector3<T> {
        Vector3::new(s, T::lit(if piece == 0 { 0.0 } else { 0.5 }), T::zero())
    }
    fn pieces(&self) -> usize {
        2
    }
}

#[test]
fn open_broken_and_short_curves_are_refused_by_name() {
    let map = Golden::Smooth;
    let open = Segment { from: Vector3::zeros(), to: Vector3::x() };
    assert!(matches!(
        BurgersVector::of(&map, &open, 1e-9),
        Err(UniformityError::OpenCircuit { gap, .. }) if (gap - 1.0).abs() < 1e-15
    ));
    let frame = Matrix3::identity();
    let connection = MaterialConnection::of_crystal(map);
    assert!(matches!(
        TransportedFrame::around(&connection, &open, &frame, tight()),
        Err(UniformityError::OpenCircuit { .. })
    ));
    assert!(TransportedFrame::along(&connection, &open, &frame, tight()).is_ok());

    assert!(matches!(Jump.check(), Err(UniformityError::BrokenCurve { piece: 1, .. })));
    let short = PolygonalCurve::new(vec![Vector3::zeros()]);
    assert!(matches!(short, Err(UniformityError::WrongLength { found: 1, .. })));
    assert!(matches!(
        RoundCircuit::new(Vector3::zeros(), Vector3::z(), -1.0),
        Err(UniformityError::OutOfBounds { quantity: "radius", .. })
    ));
}

#[test]
fn a_density_has_parts_of_screws_and_edges() {
    let value = Matrix3::new(1.0, 2.0, 0.0, 0.0, 3.0, -1.0, 4.0, 0.0, 5.0);
    let map = Matrix3::new(2.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 3.0);
    let density = DislocationDensity { value, map, scale: 5.0 };
    let in_reference = Matrix3::new(2.0, 7.0, -1.0, 0.0, 3.0, -1.0, 13.0, 2.0, 15.0);
    assert_eq!(density.in_reference(), in_reference);
    // N = (3/5, 4/5, 0): α N = (11/5, 12/5, 12/5), K α N = (34/5, 12/5, 47/5), N · K α N = 6.
    let line = Vector3::new(0.6, 0.8, 0.0);
    assert_close("α N", density.through(&line).as_slice(), &[2.2, 2.4, 2.4], Tol::ulps(4.0));
    assert_close("screws", &[density.screw(&line)], &[6.0], Tol::ulps(4.0));
    assert_close("edges", density.edge(&line).as_slice(), &[3.2, -2.4, 9.4], Tol::ulps(16.0));
}

#[test]
fn a_circuit_through_the_dislocation_is_refused() {
    let through = RoundCircuit::new(Vector3::new(1.0, 0.0, 0.0), Vector3::z(), 1.0).expect("a circle");
    // The middle of the circle lies on the line, where K is not regular.
    let burgers = BurgersVector::of(&Golden::ScrewLine, &through, 1e-12);
    let is_named = matches!(burgers, Err(UniformityError::SingularMap { .. } | UniformityError::NotFinite { .. }));
    assert!(is_named, "{burgers:?}");
}
