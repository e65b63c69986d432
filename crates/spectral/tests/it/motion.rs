//! Modal motion against an adaptive integration and closed forms.

use piola_integrators::{DormandPrince853, State, Tolerance, field};
use piola_spectral::{BoxOperator, ModalMotion, ModalSeries, Walls};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::fixtures::{Wave, lame};

const SIDES: [f64; 2] = [1.0, 0.75];
const INDICES: [[usize; 2]; 4] = [[1, 0], [1, 1], [0, 2], [3, 2]];
const DENSITY: f64 = 1.3;

fn series(values: &[f64]) -> ModalSeries<2> {
    let mut series = ModalSeries::zeros(SIDES, Walls::Sliding, [3, 2]).expect("series");
    for (indices, pair) in INDICES.iter().zip(values.chunks_exact(2)) {
        series.set_amplitudes(*indices, [pair[0], pair[1]]).expect("set");
    }
    series
}

fn amplitudes(series: &ModalSeries<2>) -> Vec<f64> {
    INDICES.iter().flat_map(|indices| series.amplitudes(*indices)).collect()
}

/// Without the components that have no sine.
fn cleaned(values: &[f64]) -> Vec<f64> {
    amplitudes(&series(values))
}

/// (λ + 2μ)q², μq² of the first mode over ρ.
fn natural_frequency() -> f64 {
    (3.0 * std::f64::consts::PI.powi(2) / DENSITY).sqrt()
}

#[test]
fn modal_steps_equal_an_adaptive_integration() {
    let critical = 2.0 * DENSITY * natural_frequency();
    let u = cleaned(&[0.5, 0.0, -0.25, 0.75, 0.0, 1.0, 0.125, -0.5]);
    let v = cleaned(&[-1.0, 0.0, 2.0, 0.5, 0.0, -0.75, 1.5, 0.25]);
    let forces: Vec<Vec<f64>> = [3.0, -5.0, 4.0, 2.0]
        .iter()
        .map(|scale| cleaned(&[1.0, 0.0, 0.5, -2.0, 0.0, 1.5, -1.0, 0.25].map(|f: f64| f * scale)))
        .collect();
    let mut compared = 0;
    // Undamped, weak, critical to the last bit for the first mode, near it on both sides, strong, very strong.
    for drag in [0.0, 0.3, critical, critical * (1.0 - 1e-9), critical * (1.0 + 1e-9), 3.0 * critical, 12.0 * critical]
    {
        for (h, steps) in [(1.0, 1), (0.125, 8), (1.0 / 64.0, 64)] {
            let operator = BoxOperator::elastic(lame());
            let mut motion = ModalMotion::new(operator, DENSITY, drag, series(&u), series(&v)).expect("motion");
            let mut system = field(16, |t: f64, y: &[f64], rate: &mut [f64]| {
                for (mode, indices) in INDICES.iter().enumerate() {
                    let own = 2 * mode;
                    let wave = Wave { indices: *indices, amplitude: [y[own], y[own + 1]] };
                    let resisted = wave.elastic_force(lame(), SIDES).amplitude;
                    for c in 0..2 {
                        let f: f64 = forces.iter().rev().fold(0.0, |sum, f| sum * t + f[own + c]);
                        rate[own + c] = y[8 + own + c];
                        rate[8 + own + c] = (f - drag * y[8 + own + c] - resisted[c]) / DENSITY;
                    }
                }
            });
            let mut state = State::new(0.0, [u.clone(), v.clone()].concat()).expect("state");
            let tolerance = Tolerance::relative(1e-14).expect("tolerance");
            DormandPrince853::new(tolerance).integrate_to(&mut system, &mut state, 1.0).expect("integration");
            for step in 0..steps {
                // The same polynomial about the start of the step.
                let t = f64::from(step) * h;
                let about = [
                    [1.0, t, t * t, t * t * t],
                    [0.0, 1.0, 2.0 * t, 3.0 * t * t],
                    [0.0, 0.0, 1.0, 3.0 * t],
                    [0.0, 0.0, 0.0, 1.0],
                ];
                let shifted = about.map(|row| {
                    let sum = (0..8).map(|n| (0..4).map(|m| row[m] * forces[m][n]).sum()).collect::<Vec<f64>>();
                    series(&sum)
                });
                motion.step(h, &shifted).expect("step");
            }
            let tol = Tol::stated(1e-11, "the specification's tolerance of modal motion");
            let (displacement, velocity) = (amplitudes(motion.displacement()), amplitudes(motion.velocity()));
            assert_close_at_scale(&format!("u, c = {drag}, h = {h}"), &displacement, &state.values[..8], 1.0, tol);
            assert_close_at_scale(&format!("v, c = {drag}, h = {h}"), &velocity, &state.values[8..], 1.0, tol);
            compared += 1;
        }
    }
    assert_eq!(compared, 21);
}

#[test]
fn energy_without_drag_is_kept() {
    let (u, v) =
        (series(&[0.5, 0.0, -0.25, 0.75, 0.0, 1.0, 0.125, -0.5]), series(&[-1.0, 0.0, 2.0, 0.5, 0.0, 0.0, 1.5, 0.2]));
    let mut motion = ModalMotion::new(BoxOperator::elastic(lame()), DENSITY, 0.0, u, v).expect("motion");
    let energy = |motion: &ModalMotion<2>| motion.kinetic_energy() + motion.elastic_energy(lame());
    let start = energy(&motion);
    for step in 0..1000 {
        motion.step(0.37 + 0.001 * f64::from(step), &[]).expect("step");
    }
    // Each of a thousand rotations rounds by an ulp or two, at random.
    let tol = Tol::ulps_because(1000.0, "a thousand steps of one ulp");
    assert_close("energy", &[energy(&motion)], &[start], tol);
}

#[test]
fn strongly_damped_mode_creeps_with_all_digits() {
    // r₁ = k/c (1 + ρk/c² + …): with ρk/c² = 1e-16 the textbook's difference γ − σ has no digit left.
    let stiffness = 3.0 * std::f64::consts::PI.powi(2);
    let drag = 1e8 * (DENSITY * stiffness).sqrt();
    let (u, v) = (series(&[1.0]), series(&[0.0]));
    let mut u = u;
    u.set_amplitudes([1, 0], [1.0, 0.0]).expect("set");
    let mut motion = ModalMotion::new(BoxOperator::elastic(lame()), DENSITY, drag, u, v).expect("motion");
    let h = drag / stiffness;
    motion.step(h, &[]).expect("step");
    // The exact rate differs from k/c by 1e-16 of itself.
    assert_close("u", &[motion.displacement().amplitudes([1, 0])[0]], &[(-1.0_f64).exp()], Tol::ulps(16.0));
    let expected = -(-1.0_f64).exp() / h;
    assert_close("v", &[motion.velocity().amplitudes([1, 0])[0]], &[expected], Tol::ulps(16.0));
}

#[test]
fn motion_under_a_steady_force_ends_at_the_static_solution() {
    let force = series(&[0.5, 0.0, -0.25, 0.75, 0.0, 1.0, 0.125, -0.5]);
    let operator = BoxOperator::elastic(lame());
    let expected = force.solved(&operator);
    let rest = series(&[]);
    let mut motion = ModalMotion::new(operator, DENSITY, 4.0, rest.clone(), rest).expect("motion");
    for _ in 0..100 {
        motion.step(1.0, std::slice::from_ref(&force)).expect("step");
    }
    assert_close("u", &amplitudes(motion.displacement()), &amplitudes(&expected), Tol::ulps(64.0));
}

/// u = t³ solves ρü + cu̇ + ku = 6ρt + 3ct² + kt³ from rest, whatever the damping: also where the slow rate k/c is so small that what the
/// force has done during a step is k/c of the force times the step.
#[test]
fn strongly_damped_mode_follows_a_cubic_with_all_digits() {
    let stiffness = 3.0 * std::f64::consts::PI.powi(2);
    let mut compared = 0;
    for factor in [4.0, 1e2, 1e4, 1e6] {
        let drag = factor * (DENSITY * stiffness).sqrt();
        // One mode, along its wave vector.
        let longitudinal = |amplitude: f64| series(&[amplitude, 0.0]);
        let force = [0.0, 6.0 * DENSITY, 3.0 * drag, stiffness].map(longitudinal);
        let rest = longitudinal(0.0);
        let mut motion =
            ModalMotion::new(BoxOperator::elastic(lame()), DENSITY, drag, rest.clone(), rest).expect("motion");
        // ω₀h = 5 or so: neither the force nor the mode is slow.
        motion.step(1.0, &force).expect("step");
        let (u, v) = (motion.displacement().amplitudes([1, 0])[0], motion.velocity().amplitudes([1, 0])[0]);
        assert_close(&format!("u, v of c = {drag}"), &[u, v], &[1.0, 3.0], Tol::ulps(32.0));
        compared += 1;
    }
    assert_eq!(compared, 4);
}

/// Momentum: ρv + cu + k∫u = ∫f. Where the drag is strong, u ≈ ∫f/c, so that k∫u is small and known: also for a single power of time, whose
/// share of the motion comes from no other.
#[test]
fn strongly_damped_mode_keeps_its_momentum_under_each_power_of_time() {
    let stiffness = 3.0 * std::f64::consts::PI.powi(2);
    let drag = 1e7 * (DENSITY * stiffness).sqrt();
    let h: f64 = 1.25;
    let longitudinal = |amplitude: f64| series(&[amplitude, 0.0]);
    for power in 0..4_i32 {
        let force: Vec<_> = (0..4).map(|m| longitudinal(if m == power { 2.0 } else { 0.0 })).collect();
        let rest = longitudinal(0.0);
        let mut motion =
            ModalMotion::new(BoxOperator::elastic(lame()), DENSITY, drag, rest.clone(), rest).expect("motion");
        motion.step(h, &force).expect("step");
        let (u, v) = (motion.displacement().amplitudes([1, 0])[0], motion.velocity().amplitudes([1, 0])[0]);
        let m = f64::from(power);
        let impulse = 2.0 * h.powi(power + 1) / (m + 1.0);
        let elastic = stiffness / drag * 2.0 * h.powi(power + 2) / ((m + 1.0) * (m + 2.0));
        let left = Tol::stated(1e-13, "kh/c is 6e-7: its square over six or more, and ρ/ch of it");
        assert_close(&format!("momentum, t^{power}"), &[DENSITY * v + drag * u + elastic], &[impulse], left);
        // c v = f − k u − ρ f′/c.
        let driven = 2.0 * h.powi(power) - stiffness * u - DENSITY * 2.0 * m * h.powi(power - 1) / drag;
        assert_close(&format!("velocity, t^{power}"), &[drag * v], &[driven], left);
    }
}
