//! The coefficients of the methods. Each field here shows one coefficient in its result; the tests compare these
//! coefficients with the conditions that define them.

use core::convert::Infallible;

use piola_integrators::{Composition, GaussLegendre, Order, Separable, State, field};
use piola_numerics::Real;
use piola_testkit::{DoubleDouble, Tol, assert_each_close, assert_each_close_at_scales};

use crate::problems::{kepler, kepler_at};

/// A force of one at one call and of nothing at all others.
struct OneKick {
    call: usize,
    calls: usize,
}

impl Separable for OneKick {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        1
    }
    fn force(&mut self, _t: f64, _q: &[f64], force: &mut [f64]) -> Result<(), Infallible> {
        force[0] = if self.calls == self.call { 1.0 } else { 0.0 };
        self.calls += 1;
        Ok(())
    }
}

/// The weights γ₁ … γₛ, exactly, and the time from the middle of each substep to the end of a step of length one.
fn stages(order: Order) -> (Vec<f64>, Vec<f64>) {
    let (mut kicks, mut left) = (Vec::new(), Vec::new());
    loop {
        let mut field = OneKick { call: kicks.len(), calls: 0 };
        let mut state = State::new(0.0, vec![0.0, 0.0]).unwrap();
        Composition::new(order, 1.0).unwrap().integrate_to(&mut field, &mut state, 1.0).unwrap();
        if field.calls == kicks.len() {
            return (kicks, left);
        }
        // p = γ, and q = γ times the drifts that follow.
        kicks.push(state.values[1]);
        left.push(state.values[0] / state.values[1]);
    }
}

/// ∫ γ(s)^{m−1} (s − ½)ʳ ds over the stages, s from 0 to Σγ.
fn moment(kicks: &[f64], m: u32, r: u32) -> DoubleDouble {
    let lit = DoubleDouble::lit;
    let power = |x: DoubleDouble, n: u32| (0..n).fold(lit(1.0), |product, _| product * x);
    let (mut from, mut sum) = (lit(-0.5), lit(0.0));
    for &gamma in kicks {
        let to = from + lit(gamma);
        let weight = power(lit(gamma), m - 1);
        sum += weight * (power(to, r + 1) - power(from, r + 1)) / lit(f64::from(r + 1));
        from = to;
    }
    sum
}

/// ∫∫ γ(s)² γ(s′)² (s − s′) ds′ ds over s′ < s.
fn pairs(kicks: &[f64]) -> DoubleDouble {
    let lit = DoubleDouble::lit;
    let (mut once, mut twice, mut sum) = (lit(0.0), lit(0.0), lit(0.0));
    for &gamma in kicks {
        let x = lit(gamma);
        let weight = x * x;
        sum += weight * (twice * x + once * x * x / lit(2.0) + weight * x * x * x / lit(6.0));
        twice += once * x + weight * x * x / lit(2.0);
        once += weight * x;
    }
    sum
}

/// A symmetric step of second order is exp(γh A₁ + γ³h³ A₃ + γ⁵h⁵ A₅ + …). Seen from the moment s of the whole step, Aₘ is
/// Aₘ − (s − ½) [A₁, Aₘ] + ½ (s − ½)² [A₁, [A₁, Aₘ]] − …, so that the composition is of order p when Σγ = 1 and
///
/// ```text
/// ∫ γ^{m−1} (s − ½)ʳ ds = 0            for m = 3, 5, …, r = 0, 2, … with m + r < p
/// ∫∫ γ² γ′² (s − s′) ds′ ds = 0        for p = 8, of [A₃, [A₁, A₃]]
/// ```
///
/// (odd r by symmetry): 1, 3 and 7 conditions beside Σγ = 1 for the orders 4, 6 and 8. Evaluated with 31 digits at the
/// stored doubles they leave what these were rounded by: the largest is 4.9e-16.
#[test]
fn compositions_obey_their_order_conditions() {
    for (order, conditions) in [(Order::Four, 1), (Order::Six, 3), (Order::Eight, 7)] {
        let (kicks, _) = stages(order);
        let mut compared = 0;
        let mut zero = |what: String, value: DoubleDouble| {
            let value = value.primal(0);
            assert!(value.abs() < 1e-15, "{order:?}, {what}: {value:e}");
            compared += 1;
        };
        let sum = kicks.iter().fold(DoubleDouble::lit(-1.0), |sum, &gamma| sum + DoubleDouble::lit(gamma));
        zero("Σγ − 1".into(), sum);
        for m in (3..order.value()).step_by(2) {
            for r in (0..order.value() - m).step_by(2) {
                zero(format!("m = {m}, r = {r}"), moment(&kicks, m, r));
            }
        }
        if order == Order::Eight {
            zero("pairs".into(), pairs(&kicks));
        }
        assert_eq!(compared, conditions + 1, "{order:?}");
        // The next condition fails: the order is no higher, and zero is not what these integrals are by themselves.
        let beyond = moment(&kicks, order.value() - 1, 2).primal(0);
        assert!(1e-5 < beyond.abs(), "{order:?}: {beyond:e}");
    }
}

/// Lists of stages are symmetric, and those that have a closed form or are in print have these values.
#[test]
fn stages_of_compositions_equal_those_in_print() {
    let (kicks, _) = stages(Order::Two);
    assert_each_close("2", &kicks, &[1.0], Tol::ulps(0.0));
    // Suzuki: γ = 1/(4 − ∛4) four times.
    let (kicks, _) = stages(Order::Four);
    let gamma = 1.0 / (4.0 - 4.0_f64.cbrt());
    assert_each_close("4", &kicks, &[gamma, gamma, 1.0 - 4.0 * gamma, gamma, gamma], Tol::ulps(2.0));
    // Hairer, Lubich, Wanner, V(3.11): nine stages of order 6, rounded from twenty digits.
    let (kicks, _) = stages(Order::Six);
    let [a, b, c, d, middle] = [
        0.392_161_444_007_314_1,
        0.332_599_136_789_359_44,
        -0.706_246_172_557_639_4,
        0.082_213_596_293_550_8,
        0.798_543_990_934_83,
    ];
    assert_each_close("6", &kicks, &[a, b, c, d, middle, d, c, b, a], Tol::ulps(2.0));
    for order in Order::ALL {
        let (kicks, left) = stages(order);
        let reversed: Vec<f64> = kicks.iter().rev().copied().collect();
        assert_eq!(kicks, reversed, "{order:?}");
        // Each kick stands in the middle of its stage.
        let mut reached = 0.0;
        let expected: Vec<f64> = kicks
            .iter()
            .map(|gamma| {
                reached += gamma;
                1.0 - (reached - 0.5 * gamma)
            })
            .collect();
        assert_each_close_at_scales("left", &left, &expected, &vec![1.0; left.len()], Tol::ulps(16.0));
    }
}

/// y′ = (k + 1) tᵏ for k < S is continued exactly: the first stages of the second step are those of y = tᵏ⁺¹, before any
/// sweep has corrected them.
#[test]
fn starting_guess_of_collocation_continues_polynomials() {
    let mut compared = 0;
    for (stages, order) in (1_usize..).zip(Order::ALL) {
        for (k, degree) in (0_i32..).zip(1..=stages) {
            let mut seen = Vec::new();
            let mut power = field(1, |t: f64, y: &[f64], rate: &mut [f64]| {
                if 1.0 < t && seen.len() < stages {
                    seen.push((t, y[0]));
                }
                rate[0] = f64::from(k + 1) * t.powi(k);
            });
            let mut state = State::new(0.0, vec![0.0]).unwrap();
            GaussLegendre::new(order, 1.0).unwrap().integrate_to(&mut power, &mut state, 2.0).unwrap();
            let expected: Vec<f64> = seen.iter().map(|(t, _)| t.powi(k + 1)).collect();
            let found: Vec<f64> = seen.iter().map(|(_, y)| *y).collect();
            // The coefficients are up to thirty, of alternating sign.
            assert_each_close(&format!("{order:?}, t^{degree}"), &found, &expected, Tol::ulps(64.0));
            compared += found.len();
        }
    }
    // Σ S² for one to four stages.
    assert_eq!(compared, 1 + 4 + 9 + 16);
}

/// The starting guess saves sweeps: a run is cheaper than its steps by themselves, which start from a constant rate. That
/// of one stage, the increment before, is as good as a constant rate. Measured: 444 evaluations in sweeps against 470,
/// 684 against 747, 796 against 932.
#[test]
fn a_run_of_collocation_takes_fewer_sweeps_than_its_steps_apart() {
    for (order, h, most) in [(Order::Four, 0.05, 0.97), (Order::Six, 0.1, 0.94), (Order::Eight, 0.1, 0.88)] {
        let steps = 40;
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let mut method = GaussLegendre::new(order, h).unwrap();
        let run = method.integrate_to(&mut kepler(), &mut state, h * f64::from(steps)).unwrap().evaluations - 1;
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        // Each step begins with one evaluation beside its sweeps.
        let apart: u64 = (1..=steps)
            .map(|step| method.integrate_to(&mut kepler(), &mut state, h * f64::from(step)).unwrap().evaluations - 1)
            .sum();
        assert!((run as f64) < most * apart as f64, "{order:?}: {run} evaluations against {apart}");
    }
}
