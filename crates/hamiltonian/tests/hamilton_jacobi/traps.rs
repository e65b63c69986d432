//! Bad input and singular cases, each with the numbers that its error must hold.

use piola_hamiltonian::PhaseFunction;
use piola_hamiltonian::hamilton_jacobi::{
    CompleteIntegral, Constants, Event, GeodeticDistance, InitialFront, SearchRegion, WaveFront,
};
use piola_hamiltonian::{HamiltonJacobiError, HamiltonianError};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};

use super::systems::Particle;

const PI: f64 = core::f64::consts::PI;

#[test]
fn foci_of_an_oscillator_are_conjugate_events() {
    let oscillator = Particle::oscillator(1.0, 1.0, 2);
    let distance = GeodeticDistance::new(&oscillator);
    let (from, focus) = (Event::new(&[1.0, 0.5], 0.0), Event::new(&[-1.0, -0.5], PI));
    match distance.between(&from, &focus, &[0.3, 0.0]) {
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::ConjugateEvents { ratio })) => {
            // sin π of a motion integrated to 1e-13.
            assert!(ratio < 1e-10, "{ratio}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn no_extremal_of_an_oscillator_reaches_another_place_after_half_a_period() {
    let oscillator = Particle::oscillator(1.0, 1.0, 1);
    let (from, to) = (Event::new(&[1.0], 0.0), Event::new(&[0.25], PI));
    let region = SearchRegion::new(&[-2.0], &[2.0], 5).unwrap();
    match GeodeticDistance::new(&oscillator).all_between(&from, &to, &region) {
        // All extremals are at −1 then.
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NoExtremal { miss, starts: 5 })) => {
            assert_close("miss", &[miss], &[1.25], Tol::stated(1e-11, "integration"));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn conjugate_points_of_an_isotropic_oscillator_count_twice() {
    // det ∂q/∂p₀ = sin²t does not change sign.
    let oscillator = Particle::oscillator(1.0, 1.0, 2);
    let (from, to) = (Event::new(&[1.0, 0.5], 0.0), Event::new(&[0.5, 0.0], 7.0));
    let found = GeodeticDistance::new(&oscillator).between(&from, &to, &[0.0, 0.0]).unwrap();
    assert_eq!(found.morse_index(), 4);
    let times: Vec<f64> = found.conjugate_points.iter().map(|point| point.time).collect();
    assert_close("times", &times, &[PI, 2.0 * PI], Tol::stated(1e-10, "dense output of order seven"));
    assert!(found.conjugate_points.iter().all(|point| point.multiplicity == 2));
    // Backwards in time too.
    let back = GeodeticDistance::new(&oscillator).between(&to, &from, &[0.0, 0.0]).unwrap();
    assert_eq!(back.morse_index(), 4);
    assert_close("G back", &[back.distance], &[-found.distance], Tol::stated(1e-10, "shooting"));
}

#[test]
fn events_and_regions_that_cannot_be_used() {
    let oscillator = Particle::oscillator(1.0, 1.0, 1);
    let distance = GeodeticDistance::new(&oscillator);
    let (a, b) = (Event::new(&[1.0], 2.0), Event::new(&[2.0], 2.0));
    assert_eq!(
        distance.between(&a, &b, &[0.0]),
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::EventsAtOneTime { time: 2.0 }))
    );
    let bad = distance.between(&Event::new(&[f64::NAN], 0.0), &b, &[0.0]);
    assert!(matches!(bad, Err(HamiltonianError::NotFinite { quantity: "q", index: 0, .. })), "{bad:?}");
    let short = distance.between(&Event::new(&[1.0, 2.0], 0.0), &b, &[0.0]);
    assert!(matches!(short, Err(HamiltonianError::WrongLength { expected: 2, found: 1, .. })), "{short:?}");
    let region = SearchRegion::new(&[1.0], &[-1.0], 4);
    assert_eq!(
        region,
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::InvalidRegion { index: 0, lower: 1.0, upper: -1.0 }))
    );
}

/// U = (q₁ + q₂)(Q₁ + Q₂) − (Q₁ + Q₂)² t: two constants that are one.
#[derive(Debug)]
struct OneConstant;

impl CompleteIntegral for OneConstant {
    fn value<T: Real>(&self, q: &[T], c: &[T], t: T) -> T {
        let sum = c[0] + c[1];
        (q[0] + q[1]) * sum - sum * sum * t
    }
}

#[test]
fn constants_that_depend_on_each_other_make_no_complete_integral() {
    let free = Particle::oscillator(1.0, 0.0, 2);
    let motion = Constants::through(&free, &OneConstant, (&[0.0, 0.0], &[2.0, 2.0], 0.0), &[1.0, 1.0]);
    match motion {
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::IncompleteIntegral { ratio })) => {
            // A determinant of equal rows, beside its terms.
            assert!(ratio < 1e-15);
        }
        other => panic!("{other:?}"),
    }
}

/// U = q Q − Q² t instead of q Q − Q² t/2.
#[derive(Debug)]
struct NotASolution;

impl CompleteIntegral for NotASolution {
    fn value<T: Real>(&self, q: &[T], c: &[T], t: T) -> T {
        q[0] * c[0] - c[0] * c[0] * t
    }
}

#[test]
fn a_function_that_does_not_solve_gives_no_motion() {
    let free = Particle::oscillator(1.0, 0.0, 1);
    match Constants::through(&free, &NotASolution, (&[0.0], &[2.0], 0.0), &[1.0]) {
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NoSolution { residual, scale })) => {
            assert_close("residual and scale", &[residual, scale], &[-2.0, 6.0], Tol::ulps(8.0));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_search_among_arcs_of_kepler_gives_up_what_heads_for_the_centre() {
    struct Kepler; // m = k = 1, in the plane
    impl PhaseFunction for Kepler {
        fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
            T::lit(0.5) * (p[0] * p[0] + p[1] * p[1]) - (q[0] * q[0] + q[1] * q[1]).sqrt().recip()
        }
    }
    let (from, to) = (Event::new(&[1.0, 0.0], 0.0), Event::new(&[-0.6, 1.1], 5.0));
    let region = SearchRegion::new(&[-1.4, -1.4], &[1.4, 1.4], 12).unwrap();
    let sheets = GeodeticDistance::new(&Kepler).all_between(&from, &to, &region).unwrap();
    // Lambert: one arc either way round, and no time for a whole turn more.
    let turning: Vec<f64> = sheets.iter().map(|sheet| sheet.initial_momenta[1]).collect();
    // Newton's iteration ends at what the integration, to 1e-13, leaves.
    assert!(sheets.iter().all(|sheet| sheet.miss < 1e-10), "{turning:?}");
    assert!(turning.iter().any(|p| 0.0 < *p) && turning.iter().any(|p| *p < 0.0), "{turning:?}");
}

#[test]
fn fronts_of_any_unit_start_and_fronts_in_a_changing_medium_are_refused() {
    /// A free particle of an electron's mass, in SI units; with a wobble its mass changes.
    #[derive(Debug)]
    struct Electron {
        wobble: f64,
    }
    impl PhaseFunction for Electron {
        fn value<T: Real>(&self, _q: &[T], p: &[T], t: T) -> T {
            (p[0] * p[0] + p[1] * p[1]) / T::lit(2.0 * 9.109e-31) * (T::one() + T::lit(self.wobble) * t)
        }
    }
    #[derive(Debug)]
    struct Line;
    impl InitialFront<2, 1> for Line {
        fn at<T: Real>(&self, [a]: [T; 1]) -> [T; 2] {
            [a, T::zero()]
        }
    }
    let energy = 1.602e-19; // one electronvolt
    let front = WaveFront::open(&Electron { wobble: 0.0 }, &Line, 1.0, energy, (0.0, 1.0), 3).unwrap();
    let [across, along] = front.rays()[1].momenta();
    let expected = (2.0 * 9.109e-31 * energy).sqrt();
    assert_close("|p|", &[across.hypot(along)], &[expected], Tol::ulps(8.0));
    match WaveFront::open(&Electron { wobble: 0.5 }, &Line, 1.0, energy, (0.0, 1.0), 3) {
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::TimeDependentHamiltonian { rate })) => {
            assert_close("∂H/∂t", &[rate], &[0.5 * energy], Tol::ulps(16.0));
        }
        other => panic!("{other:?}"),
    }
}
