//! Poincaré sections and Lyapunov exponents of an integrable and of a chaotic system.

use piola_hamiltonian::HamiltonianError;
use piola_hamiltonian::{PhaseFunction, PhasePoint, PoincareSection, lyapunov_exponents};
use piola_integrators::Tolerance;
use piola_numerics::Real;

/// H = ½(p² + q²) + c (x² y − y³/3); with the other sign of the cubic term's share it separates.
struct HenonHeiles {
    share: f64,
}

impl PhaseFunction for HenonHeiles {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let [x, y] = [q[0], q[1]];
        let square = p[0] * p[0] + p[1] * p[1] + x * x + y * y;
        T::lit(0.5) * square + x * x * y + T::lit(self.share) * y * y * y
    }
}

/// The coordinate x.
struct First;

impl PhaseFunction for First {
    fn value<T: Real>(&self, q: &[T], _p: &[T], _t: T) -> T {
        q[0]
    }
}

fn start(energy: f64, y: f64, share: f64) -> PhasePoint {
    let rest = 2.0 * energy - y * y - 2.0 * share * y * y * y;
    PhasePoint::new(&[0.0, y], &[rest.sqrt(), 0.0], 0.0).expect("a point inside the energy surface")
}

#[test]
fn crossings_lie_on_the_surface_and_keep_the_energy() {
    let system = HenonHeiles { share: -1.0 / 3.0 };
    let section = PoincareSection::new(&system, &First, Tolerance::relative(1e-12).unwrap());
    let point = start(1.0 / 12.0, 0.1, system.share);
    let mut crossings = Vec::new();
    section.follow_into(&point, 1e4, 200, &mut crossings).unwrap();
    assert_eq!(crossings.len(), 200);
    for crossing in &crossings {
        // The time of a crossing is found to some ulp of itself.
        let resolution = 4.0 * f64::EPSILON * crossing.time();
        assert!(crossing.q()[0].abs() < resolution && 0.0 < crossing.p()[0]);
        let energy = system.value(crossing.q(), crossing.p(), 0.0);
        // Ten times the tolerance of the steps, whose errors hardly add up.
        assert!((energy - 1.0 / 12.0).abs() < 1e-11, "{energy}");
    }
}

#[test]
fn a_system_that_separates_crosses_along_a_curve() {
    // V = ½(x² + y²) + x² y + y³/3 is f(x + y) + f(x − y), f(u) = u²/4 + u³/6: along each the energy is kept.
    let system = HenonHeiles { share: 1.0 / 3.0 };
    let section = PoincareSection::new(&system, &First, Tolerance::relative(1e-12).unwrap());
    let mut crossings = Vec::new();
    section.follow_into(&start(0.05, 0.1, system.share), 1e4, 100, &mut crossings).unwrap();
    let part = |point: &PhasePoint| {
        let (u, v) = (point.q()[0] + point.q()[1], point.p()[0] + point.p()[1]);
        0.25 * v * v + 0.25 * u * u + u * u * u / 6.0
    };
    assert_eq!(crossings.len(), 100);
    // As above.
    assert!(crossings.iter().all(|point| (part(point) - part(&crossings[0])).abs() < 1e-11));
}

#[test]
fn exponents_come_in_pairs_and_tell_chaos_from_order() {
    let tolerance = Tolerance::relative(1e-10).unwrap();
    let chaotic = HenonHeiles { share: -1.0 / 3.0 };
    let found = lyapunov_exponents(&chaotic, &start(1.0 / 6.0, -0.2, chaotic.share), 4, 2.0, 1000, tolerance).unwrap();
    let [first, second, third, fourth] = found.exponents[..] else { panic!("four exponents") };
    // M. Hénon and C. Heiles's system at E = 1/6 parts by about 0.12 to 0.14 per unit of time.
    assert!(0.08 < first && first < 0.18, "{first}");
    // Volumes of phase space are kept at every time, but for a hundred times the tolerance; pairs ±λ and the two zeros come out in the limit.
    assert!((first + second + third + fourth).abs() < 1e-8, "{:?}", found.exponents);
    assert!((first + fourth).abs() < 0.01 && (second + third).abs() < 0.01, "{:?}", found.exponents);
    assert!(second.abs() < 0.02);
    let ordered = HenonHeiles { share: 1.0 / 3.0 };
    let found = lyapunov_exponents(&ordered, &start(0.05, 0.1, ordered.share), 1, 2.0, 1000, tolerance).unwrap();
    // Variations of an ordered motion grow evenly: the estimate falls as ln t/t.
    assert!(found.exponents[0] < 0.006, "{:?}", found.exponents);
    assert!(found.history[999] < 0.3 * found.history[49]);
}

#[test]
fn more_exponents_than_dimensions_and_intervals_of_no_length_are_refused() {
    let system = HenonHeiles { share: 0.0 };
    let point = start(0.05, 0.1, 0.0);
    let tolerance = Tolerance::relative(1e-8).unwrap();
    assert_eq!(
        lyapunov_exponents(&system, &point, 5, 1.0, 1, tolerance).unwrap_err(),
        HamiltonianError::WrongLength { quantity: "exponents", expected: 4, found: 5 }
    );
    assert_eq!(
        lyapunov_exponents(&system, &point, 1, 0.0, 1, tolerance).unwrap_err(),
        HamiltonianError::NotPositive { quantity: "interval", value: 0.0 }
    );
}
