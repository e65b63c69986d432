//! Ready-made transformations: there and back, canonical, and what becomes of the Hamiltonian.

use piola_hamiltonian::{
    Delaunay, Inverse, OscillatorActionAngle, PhaseFunction, PhaseMap, PolarCoordinates, SphericalCoordinates,
    TransformedHamiltonian, canonical_test,
};
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::systems::Kepler;

fn away() -> impl Strategy<Value = f64> {
    prop_oneof![-3.0..-0.3_f64, 0.3..3.0_f64]
}

/// There and back again, and canonical at the point.
fn check(map: &(impl piola_hamiltonian::InvertiblePhaseMap + Copy), q: &[f64], p: &[f64], condition: f64) {
    let d = 2 * q.len();
    let (mut new, mut back) = (vec![0.0; d], vec![0.0; d]);
    map.map(q, p, 0.0, &mut new).expect("a regular point");
    Inverse(*map).map(&new[..q.len()], &new[q.len()..], 0.0, &mut back).expect("a regular point");
    assert_close("φ⁻¹∘φ", &back, &[q, p].concat(), Tol::ulps(20.0).times(condition));
    let test = canonical_test(map, q, p, 0.0).expect("a regular point");
    // Some fifty ulp of the entries of J, times the condition of the map.
    assert!(test.relative < 1e-14 * condition, "{test:?}");
}

/// Oscillators of one mass and angular frequency.
struct Oscillators(f64, f64);
impl PhaseFunction for Oscillators {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let (m, stiffness) = (T::lit(self.0), T::lit(self.0 * self.1 * self.1));
        q.iter().zip(p).fold(T::zero(), |sum, (&q, &p)| sum + T::lit(0.5) * (p * p / m + stiffness * q * q))
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    #[test]
    fn polar_and_spherical_coordinates_lead_back_and_are_canonical(
        q in prop::array::uniform3(away()), p in prop::array::uniform3(-2.0..2.0_f64),
    ) {
        check(&PolarCoordinates, &q[..2], &p[..2], 10.0);
        check(&SphericalCoordinates, &q, &p, 30.0);
    }

    #[test]
    fn angle_and_action_lead_back_and_make_the_oscillators_hamiltonian_linear(
        q in prop::array::uniform2(away()), p in prop::array::uniform2(away()), mass in 0.5..3.0_f64, rate in 0.5..3.0_f64,
    ) {
        let map = OscillatorActionAngle::new(mass, rate).unwrap();
        check(&map, &q, &p, 10.0);
        let mut new = [0.0; 4];
        map.map(&q, &p, 0.0, &mut new).unwrap();
        let seen = TransformedHamiltonian { hamiltonian: Oscillators(mass, rate), map };
        assert_close("ω P", &[seen.value(&new[..2], &new[2..], 0.0)], &[rate * (new[2] + new[3])], Tol::ulps(10.0));
    }

    #[test]
    fn delaunays_elements_lead_back_and_are_canonical(
        axis in 0.5..3.0_f64,
        eccentricity in 0.02..0.97_f64,
        inclination in 0.05..3.0_f64,
        angles in prop::array::uniform3(-3.1..3.1_f64),
        mass in 0.5..2.0_f64,
        mu in 0.5..2.0_f64,
    ) {
        let map = Delaunay::new(mass, mu).unwrap();
        let first = mass * (mu * axis).sqrt();
        let second = first * ((1.0 - eccentricity) * (1.0 + eccentricity)).sqrt();
        let actions = [first, second, second * inclination.cos()];
        let mut point = [0.0; 6];
        Inverse(map).map(&angles, &actions, 0.0, &mut point).unwrap();
        // Small e and sin i divide the rounding of the angles; near e = 1 so does 1 − e.
        let condition = 4.0 / (eccentricity * inclination.sin() * (1.0 - eccentricity).powf(1.5));
        check(&map, &point[..3], &point[3..], condition);
        let mut back = [0.0; 6];
        map.map(&point[..3], &point[3..], 0.0, &mut back).unwrap();
        assert_close_at_scale("angles", &back[..3], &angles, 1.0, Tol::ulps(20.0).times(condition));
        assert_close("actions", &back[3..], &actions, Tol::ulps(40.0).times(1.0 / (1.0 - eccentricity)));
        let energy = Kepler { mass, strength: mass * mu }.value(&point[..3], &point[3..], 0.0);
        let kinetic = energy.abs() * 2.0 / (1.0 - eccentricity);
        assert_close_at_scale("H", &[map.hamiltonian().value(&angles, &actions, 0.0)], &[energy], kinetic, Tol::ulps(20.0));
    }
}

#[test]
fn keplers_motion_moves_the_mean_anomaly_alone_and_evenly() {
    use piola_hamiltonian::HamiltonianField;
    use piola_integrators::{DormandPrince853, State, Tolerance};
    let map = Delaunay::new(1.5, 2.0).unwrap();
    let kepler = Kepler { mass: 1.5, strength: 3.0 };
    let start = vec![1.0, 0.2, 0.3, -0.4, 1.9, 0.5];
    let (mut first, mut last) = ([0.0; 6], [0.0; 6]);
    map.map(&start[..3], &start[3..], 0.0, &mut first).unwrap();
    let mut state = State::new(0.0, start).unwrap();
    let mut field = HamiltonianField::new(&kepler, 3);
    let tolerance = Tolerance::relative(1e-13).unwrap();
    DormandPrince853::new(tolerance).integrate_to(&mut field, &mut state, 1.25).unwrap();
    map.map(&state.values[..3], &state.values[3..], 0.0, &mut last).unwrap();
    // dl/dt = ∂H/∂L = m³ μ²/L³.
    let rate = 1.5_f64.powi(3) * 4.0 / first[3].powi(3);
    let turns = (last[0] - first[0] - 1.25 * rate) / core::f64::consts::TAU;
    assert!((turns - turns.round()).abs() < 1e-11, "{turns}");
    assert_close("the rest", &last[1..], &first[1..], Tol::stated(1e-11, "an integration at 1e-13"));
}
