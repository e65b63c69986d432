//! Wave fronts: Huygens' principle, caustics, swallow-tails, refinement.

use std::collections::BTreeMap;

use piola_hamiltonian::PhaseFunction;
use piola_hamiltonian::hamilton_jacobi::{InitialFront, Mesh, WaveFront};
use piola_hamiltonian::{HamiltonJacobiError, HamiltonianError};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::systems::{Bowl, Magnetic};

const TURN: f64 = core::f64::consts::TAU;

/// Waves of the speed v = 1 + 0.3 x + 0.2 y², or of the speed 1: H = v |p|.
#[derive(Debug)]
struct Graded(bool);

impl PhaseFunction for Graded {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let mut square = T::zero();
        for &p in p {
            square += p * p;
        }
        let speed = if self.0 { T::one() + T::lit(0.3) * q[0] + T::lit(0.2) * q[1] * q[1] } else { T::one() };
        square.sqrt() * speed
    }
}

/// (a, a²/2 · b).
#[derive(Debug)]
struct Parabola(f64);

impl InitialFront<2, 1> for Parabola {
    fn at<T: Real>(&self, [a]: [T; 1]) -> [T; 2] {
        [a, T::lit(0.5 * self.0) * a * a]
    }
}

#[derive(Debug)]
struct Ellipse(f64, f64);

impl InitialFront<2, 1> for Ellipse {
    fn at<T: Real>(&self, [a]: [T; 1]) -> [T; 2] {
        [T::lit(self.0) * a.cos(), T::lit(self.1) * a.sin()]
    }
}

/// A patch of the unit sphere by polar angle and azimuth; the normal points outwards.
#[derive(Debug)]
struct Sphere;

impl InitialFront<3, 2> for Sphere {
    fn at<T: Real>(&self, [a, b]: [T; 2]) -> [T; 3] {
        [a.sin() * b.cos(), a.sin() * b.sin(), a.cos()]
    }
}

fn huygens<H: PhaseFunction + Sync>(system: &H, energy: f64, reach: f64, side: f64) {
    let curve = Parabola(0.4);
    let mut front = WaveFront::open(system, &curve, side, energy, (-0.5, 0.5), 5).unwrap();
    front.advance(reach, 8).unwrap();
    let envelope: Vec<[f64; 2]> = (0..5).map(|ray| front.envelope_point(ray, reach, 8).unwrap()).collect();
    let report = front.advance(reach, 8).unwrap();
    // The estimate of a step of order six, beside the bar of 1e-9 for what it estimates.
    assert!(report.error < 1e-8, "{report:?}");
    for (ray, place) in front.rays().iter().zip(envelope) {
        let tolerance = Tol::stated(1e-9, "the bar of Huygens' principle");
        assert_close_at_scale("envelope and front", &place, &ray.coordinates(), 1.0, tolerance);
        // The energy stays, and rays of a level of S leave it across: p·∂q/∂σ = 0.
        let (p, [tangent]) = (ray.momenta(), ray.tangents());
        let kept = system.value(&ray.coordinates(), &p, 0.0);
        assert_close("H", &[kept], &[energy], Tol::stated(1e-9, "order six with sixteen steps"));
        assert_close_at_scale("p·∂q/∂σ", &[p[0] * tangent[0] + p[1] * tangent[1]], &[0.0], 1.0, tolerance);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20))]

    #[test]
    fn fronts_are_envelopes_of_the_fronts_that_they_emit(reach in 0.05..0.4_f64, side in prop::bool::ANY) {
        let side = if side { 1.0 } else { -1.0 };
        huygens(&Graded(true), 1.0, reach, side);
        huygens(&Bowl, 2.0, reach, side);
        huygens(&Magnetic { mass: 1.0, charge: 1.0, field: 0.5 }, 2.0, 0.5 * reach, side);
    }
}

#[test]
fn steps_of_a_front_are_of_order_six() {
    let (graded, curve) = (Graded(true), Parabola(0.4));
    let end = |steps: usize| {
        let mut front = WaveFront::open(&graded, &curve, 1.0, 1.0, (-0.5, 0.5), 3).unwrap();
        front.advance(1.5, steps).unwrap();
        let ([x, y], [[u, v]]) = (front.rays()[0].coordinates(), front.rays()[0].tangents());
        [x, y, u, v]
    };
    let exact = end(256);
    let steps = [2_u8, 4, 8];
    let error = |steps: &u8| {
        let pairs = end(usize::from(*steps)).into_iter().zip(exact);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let lengths: Vec<f64> = steps.iter().map(|&steps| 1.5 / f64::from(steps)).collect();
    let errors: Vec<f64> = steps.iter().map(error).collect();
    piola_testkit::assert_order("front", &lengths, &errors, 6.0, 0.8);
}

#[test]
fn swallow_tails_are_kept_and_what_comes_first_is_least() {
    // Waves from a hollow mirror y = x²: its caustic is the evolute, with a cusp at the radius of curvature 1/2.
    let (even, curve) = (Graded(false), Parabola(2.0));
    let mut front = WaveFront::open(&even, &curve, -1.0, 1.0, (-1.5, 1.5), 601).unwrap();
    let before = front.advance(0.49, 4).unwrap();
    assert_eq!((before.caustics, front.first_arrival().len()), (0, 1));
    assert_eq!(front.first_arrival()[0].points.len(), 601);
    // A ray from (a, a²) touches it after the radius of curvature there, (1 + 4a²)^(3/2)/2.
    front.advance(0.51, 51).unwrap();
    let touched = |a: f64| (1.0 + 4.0 * a * a).powf(1.5) / 2.0 < 1.0;
    for ray in front.rays() {
        let [a] = ray.parameters();
        let radius = (1.0 + 4.0 * a * a).powf(1.5) / 2.0;
        // At the caustic itself rounding decides.
        assert!((radius - 1.0).abs() < 1e-9 || (0 < ray.caustics()) == touched(a), "{a}");
        // det(∂q/∂σ, dq/dS) shrinks linearly along straight rays.
        let expected = (1.0 + 4.0 * a * a).sqrt() * (1.0 - 1.0 / radius);
        assert_close_at_scale("Jacobian", &[ray.jacobian().abs()], &[expected.abs()], 1.0, Tol::ulps(256.0));
    }
    // It touches the caustic with the rays of the radius of curvature 1, a = ±√(4^(1/3) − 1)/2 = ±0.3832, on either side.
    let marks: Vec<f64> = front.caustic_edges().iter().map(|&(i, _)| front.rays()[i].parameters()[0]).collect();
    assert_close("cusps", &marks, &[-0.385, 0.38], Tol::stated(1e-12, "starts of the rays before the cusps"));
    // The front passes through itself on the axis; what came first is one piece with a corner there.
    let pieces = front.first_arrival();
    assert_eq!(pieces.len(), 1, "{pieces:?}");
    let corner = pieces[0].rays.iter().position(Option::is_none).unwrap();
    assert_close_at_scale("corner", &pieces[0].points[corner][..1], &[0.0], 1.0, Tol::ulps(64.0));
    // By looking at all of the mirror: the least distance from it is the action, for these points and no others.
    let least = |q: [f64; 2]| {
        let distances = (-4000..=4000).map(|i| f64::from(i) / 2000.0).map(|a| (q[0] - a).hypot(q[1] - a * a));
        distances.fold(f64::INFINITY, f64::min)
    };
    let kept: Vec<usize> = pieces[0].rays.iter().flatten().copied().collect();
    for (index, ray) in front.rays().iter().enumerate() {
        let first = least(ray.coordinates());
        assert!(first < 1.0 + 1e-6);
        // Near the corner both come at once.
        if 1e-3 < ray.coordinates()[0].abs() {
            assert_eq!(kept.contains(&index), 1.0 - 1e-5 < first, "ray {index}, {ray:?}");
        }
    }
}

#[test]
fn a_closed_front_that_has_passed_its_foci_keeps_only_its_outer_parts() {
    let (even, curve) = (Graded(false), Ellipse(2.0, 1.0));
    let mut front = WaveFront::closed(&even, &curve, -1.0, 1.0, (0.0, TURN), 400).unwrap();
    // The least radius of curvature is b²/a = 1/2, the greatest 4.
    front.advance(0.75, 30).unwrap();
    assert!(front.refine(0.005).unwrap() < 2000);
    let pieces = front.first_arrival();
    let least = |q: [f64; 2]| {
        let distances =
            (0..8000).map(|i| TURN * f64::from(i) / 8000.0).map(|a| (q[0] - 2.0 * a.cos()).hypot(q[1] - a.sin()));
        distances.fold(f64::INFINITY, f64::min)
    };
    assert_eq!(pieces.len(), 1);
    assert!(100 < pieces[0].points.len());
    for place in &pieces[0].points {
        let stated = Tol::stated(1e-5, "spacing of the points looked at");
        assert_close("least distance from the ellipse", &[least(*place)], &[0.75], stated);
    }
    // The inner parallel curve has two corners, on the long axis.
    assert_eq!(pieces[0].rays.iter().filter(|ray| ray.is_none()).count(), 2);
}

#[test]
fn refined_fronts_are_fronts_that_had_more_rays_from_the_start() {
    let (graded, curve) = (Graded(true), Parabola(0.5));
    let mut front = WaveFront::open(&graded, &curve, 1.0, 1.0, (-1.0, 1.0), 5).unwrap();
    front.advance(0.3, 3).unwrap();
    front.advance(0.2, 1).unwrap();
    let inserted = front.refine(0.3).unwrap();
    assert_eq!(front.rays().len(), 5 + inserted);
    assert!(front.rays().windows(2).all(|pair| pair[0].parameters()[0] < pair[1].parameters()[0]));
    let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    assert!(front.rays().windows(2).all(|pair| apart(pair[0].coordinates(), pair[1].coordinates()) <= 0.3));
    let mut other = WaveFront::open(&graded, &curve, 1.0, 1.0, (-1.0, 1.0), 9).unwrap();
    other.advance(0.3, 3).unwrap();
    other.advance(0.2, 1).unwrap();
    let mut compared = 0;
    for ray in other.rays() {
        if let Some(same) = front.rays().iter().find(|r| r.parameters()[0].to_bits() == ray.parameters()[0].to_bits()) {
            assert_eq!(same, ray);
            compared += 1;
        }
    }
    // The five of the start, and those of the other front that refinement has met.
    assert!((5..=9).contains(&compared), "{compared} rays");
}

#[test]
fn surfaces_spread_as_spheres_and_their_meshes_have_no_gaps() {
    let even = Graded(false);
    let mut front = WaveFront::surface(&even, &Sphere, (1.0, 1.0), [(0.4, 1.2), (0.0, 1.0)], [5, 5]).unwrap();
    front.advance(1.0, 2).unwrap();
    let inserted = front.refine(0.25).unwrap();
    assert!(0 < inserted);
    for ray in front.rays() {
        let [x, y, z] = ray.coordinates();
        assert_close("r", &[(x * x + y * y + z * z).sqrt()], &[2.0], Tol::ulps(16.0));
        // |∂q/∂a × ∂q/∂b| = r² sin a.
        assert_close("Jacobian", &[ray.jacobian()], &[4.0 * ray.parameters()[0].sin()], Tol::ulps(64.0));
        assert_eq!(ray.caustics(), 0);
    }
    let Mesh::Triangles(triangles) = front.mesh() else { panic!("a surface is a mesh") };
    let mut edges = BTreeMap::<(usize, usize), usize>::new();
    let mut area = 0.0;
    for &[a, b, c] in triangles {
        for (i, j) in [(a, b), (b, c), (c, a)] {
            *edges.entry((i.min(j), i.max(j))).or_default() += 1;
        }
        let place = |i: usize| front.rays()[i].parameters();
        let ([ax, ay], [bx, by], [cx, cy]) = (place(a), place(b), place(c));
        area += 0.5 * ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax));
    }
    // The triangles cover the rectangle of parameters once, and only its border has edges of one triangle.
    assert_close("area", &[area], &[0.8], Tol::ulps(64.0));
    let border = |i: usize| {
        let [a, b] = front.rays()[i].parameters();
        [(a - 0.4).abs() < 1e-12, (a - 1.2).abs() < 1e-12, b.abs() < 1e-12, (b - 1.0).abs() < 1e-12]
    };
    for (&(i, j), &count) in &edges {
        let common = border(i).into_iter().zip(border(j)).any(|(i, j)| i && j);
        assert_eq!(count, if common { 1 } else { 2 }, "edge {i}–{j}");
    }
    // Inwards, all of it passes the focus: a double one, which leaves the sign of the Jacobian as it was.
    let mut inwards = WaveFront::surface(&even, &Sphere, (-1.0, 1.0), [(0.4, 1.2), (0.0, 1.0)], [3, 3]).unwrap();
    inwards.advance(1.5, 3).unwrap(); // exactly on the focus after the second step
    assert!(inwards.rays().iter().all(|ray| ray.caustics() == 2), "{:?}", inwards.rays()[4]);
    assert_close_at_scale(
        "through the focus",
        &[inwards.rays()[4].coordinates()[2]],
        &[-0.5 * 0.8_f64.cos()],
        1.0,
        Tol::ulps(16.0),
    );
}

/// z = b (x² + y²)/2 + a x²/2 over a square.
#[derive(Debug)]
struct Bowl3(f64, f64);

impl InitialFront<3, 2> for Bowl3 {
    fn at<T: Real>(&self, [x, y]: [T; 2]) -> [T; 3] {
        [x, y, T::lit(0.5 * self.0) * (x * x + y * y) + T::lit(0.5 * self.1) * x * x]
    }
}

#[test]
fn swallow_tails_of_surfaces_are_cut_off_where_they_come_late() {
    let (even, surface) = (Graded(false), Bowl3(0.5, 1.5));
    let mut front = WaveFront::surface(&even, &surface, (1.0, 1.0), [(-0.7, 0.7), (-0.5, 0.5)], [57, 41]).unwrap();
    let whole = front.first_arrival().len();
    assert_eq!(whole, 2 * 56 * 40);
    front.advance(0.6, 30).unwrap();
    // The radius of curvature is 1/2 across the valley and 2 along it.
    assert!(front.rays().iter().any(|ray| ray.caustics() == 1));
    let kept = front.first_arrival();
    assert!(whole / 4 < kept.len() && kept.len() < whole, "{} of {whole}", kept.len());
    let least = |q: [f64; 3]| {
        let places = (-140..=140).flat_map(|i| (-100..=100).map(move |j| (f64::from(i) / 200.0, f64::from(j) / 200.0)));
        places.fold(f64::INFINITY, |m, (x, y)| {
            let z = 0.25 * (x * x + y * y) + 0.75 * x * x;
            m.min((q[0] - x).powi(2) + (q[1] - y).powi(2) + (q[2] - z).powi(2))
        })
    };
    for triangle in kept.iter().step_by(17) {
        for &corner in triangle {
            // Triangles that the other sheet cuts are kept whole: their corners may be late by an edge.
            assert!(0.6 - 0.04 < least(front.rays()[corner].coordinates()).sqrt(), "{corner}");
        }
    }
    // What has been cut off is late.
    let late = |corner: usize| least(front.rays()[corner].coordinates()).sqrt() < 0.6 - 1e-6;
    let gone = (0..front.rays().len()).filter(|corner| !kept.iter().flatten().any(|kept| kept == corner));
    assert!(gone.step_by(13).all(late));
}

/// H = √(p·A p) with A = diag(4, 1, 9): rays are not along their momenta.
#[derive(Debug)]
struct Crystal;

const SPEEDS: [f64; 3] = [4.0, 1.0, 9.0];

impl PhaseFunction for Crystal {
    fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
        let mut sum = T::zero();
        for (&p, speed) in p.iter().zip(SPEEDS) {
            sum += T::lit(speed) * p * p;
        }
        sum.sqrt()
    }
}

#[test]
fn envelopes_of_curves_and_surfaces_are_their_parallels_also_past_caustics_and_in_crystals() {
    let tight = Tol::ulps_because(64.0, "a few steps of straight rays");
    let mut compared = 0;
    let (even, hollow) = (Graded(false), Parabola(2.0));
    for (reach, side) in [(0.3, -1.0), (1.5, -1.0), (0.8, 1.0)] {
        let front = WaveFront::open(&even, &hollow, side, 1.0, (-1.0, 1.0), 9).unwrap();
        for (index, ray) in front.rays().iter().enumerate() {
            // The normal (2 a, −1)/√(1 + 4 a²) to the right of the way along the mirror.
            let [a] = ray.parameters();
            let length = side * reach / (1.0 + 4.0 * a * a).sqrt();
            let expected = [a + 2.0 * a * length, a * a - length];
            let found = front.envelope_point(index, reach, 3).unwrap();
            assert_close_at_scale("parallel curve", &found, &expected, 1.0, tight);
            compared += 1;
        }
    }
    // q + ΔS A n/√(n·A n).
    let crystal = Crystal;
    let surface = Bowl3(0.5, 1.5);
    for (reach, side) in [(0.5, 1.0), (2.0, 1.0), (0.5, -1.0)] {
        let front = WaveFront::surface(&crystal, &surface, (side, 1.0), [(-0.7, 0.7), (-0.5, 0.5)], [4, 4]).unwrap();
        for (index, ray) in front.rays().iter().enumerate() {
            let [x, y] = ray.parameters();
            let normal = [-2.0 * x, -0.5 * y, 1.0];
            let energy = (0..3).map(|i| SPEEDS[i] * normal[i] * normal[i]).sum::<f64>().sqrt();
            let place = [x, y, 0.25 * (x * x + y * y) + 0.75 * x * x];
            let expected: [f64; 3] = core::array::from_fn(|i| place[i] + side * reach * SPEEDS[i] * normal[i] / energy);
            let found = front.envelope_point(index, reach, 2).unwrap();
            assert_close_at_scale("surface in a crystal", &found, &expected, 4.0, tight);
            compared += 1;
        }
    }
    assert_eq!(compared, 75);
}

#[test]
fn fronts_that_cannot_start_or_go_on_say_so() {
    let curve = Parabola(2.0);
    let too_little = WaveFront::open(&Bowl, &curve, 1.0, 0.1, (-1.5, 1.5), 5);
    assert!(matches!(too_little, Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound { .. }))));
    let even = Graded(false);
    let mut front = WaveFront::open(&even, &curve, 1.0, 1.0, (-1.0, 1.0), 5).unwrap();
    assert!(matches!(front.advance(f64::NAN, 1), Err(HamiltonianError::NotFinite { quantity: "ΔS", .. })));
    assert!(matches!(
        front.refine(0.0),
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::InvalidLength { .. }))
    ));
    assert!(matches!(front.envelope_point(9, 0.1, 1), Err(HamiltonianError::WrongLength { .. })));
}

#[test]
#[cfg(not(feature = "rayon"))]
fn steps_of_a_front_do_not_allocate() {
    let (graded, curve) = (Graded(true), Parabola(0.5));
    let mut front = WaveFront::open(&graded, &curve, 1.0, 1.0, (-1.0, 1.0), 500).unwrap();
    let (allocations, report) = piola_testkit::allocations_in(|| front.advance(0.1, 2));
    assert_eq!((allocations, report.is_ok()), (0, true));
}

#[test]
#[cfg(feature = "rayon")]
fn fronts_do_not_depend_on_the_number_of_threads() {
    let (graded, curve) = (Graded(true), Parabola(0.5));
    let advanced = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut front = WaveFront::open(&graded, &curve, 1.0, 1.0, (-1.0, 1.0), 1000).unwrap();
        pool.install(|| front.advance(0.5, 3).and_then(|_| front.refine(0.0012))).unwrap();
        front.rays().to_vec()
    };
    let one = advanced(1);
    assert_eq!(one, advanced(2));
    assert_eq!(one, advanced(3));
}
