//! The first step that a run chooses: where it looks, and its length by the formula.

use piola_integrators::{DormandPrince853, State, Tolerance, field};
use piola_testkit::{Tol, assert_close};

/// Places (t, y₀) of all evaluations of ẏ = λ y from y(t₀) = start in every component, and the end of the first step.
fn looked_at(rate_of_motion: f64, from: f64, start: &[f64], tolerance: Tolerance) -> (Vec<(f64, f64)>, f64) {
    let mut places = Vec::new();
    let mut growth = field(start.len(), |t, y: &[f64], rate: &mut [f64]| {
        places.push((t, y[0]));
        rate.iter_mut().zip(y).for_each(|(rate, y)| *rate = rate_of_motion * y);
    });
    let mut state = State::new(from, start.to_vec()).unwrap();
    let mut end = None;
    DormandPrince853::new(tolerance)
        .integrate(&mut growth, &mut state, from + 10.0, |step| {
            end.get_or_insert(step.time());
            core::ops::ControlFlow::Continue(())
        })
        .unwrap();
    (places, end.unwrap())
}

/// The Euler step's quotient of differences (y + λ h y − y)/h keeps eleven digits at λ h = 0.01; the eighth root does the rest.
const QUOTIENT: Tol = Tol::stated(1e-13, "rounding of a quotient of differences at a hundredth of a time constant");

#[test]
fn euler_step_is_a_hundredth_of_the_time_constant() {
    for (lambda, from, start) in [(0.7, 0.0, 3.0), (-2.0, 5.0, 1e-6), (31.0, -4.0, -2e8)] {
        let (places, _) = looked_at(lambda, from, &[start], Tolerance::relative(1e-9).unwrap());
        let [first, second, ..] = places[..] else { panic!("no two evaluations") };
        assert_eq!((first.0.to_bits(), first.1.to_bits()), (f64::to_bits(from), f64::to_bits(start)));
        let euler = 0.01 / f64::abs(lambda);
        assert_close("time", &[second.0], &[from + euler], Tol::ulps(4.0));
        assert_close("place", &[second.1], &[start + euler * lambda * start], Tol::ulps(4.0));
    }
}

#[test]
fn first_step_has_the_stated_length() {
    // h = (0.01/‖y‖)^(1/8)/λ with ‖y‖ = |y|/(absolute + relative |y|) in each of equal components.
    let cases =
        [(0.7, 3.0, 1, 0.0, 1e-9), (0.7, 3.0, 4, 0.0, 1e-9), (-2.0, 0.5, 3, 1e-7, 1e-5), (31.0, -2e4, 2, 1e-3, 1e-12)];
    for (lambda, start, n, absolute, relative) in cases {
        let (_, end) = looked_at(lambda, 0.0, &vec![start; n], Tolerance::new(relative, absolute).unwrap());
        // Where the motion grows, its norm is the one at the end of the Euler step.
        let grown = f64::abs(start) * if lambda > 0.0 { 1.01 } else { 1.0 };
        let size = grown / (absolute + relative * grown);
        let lambda = lambda.abs() * f64::sqrt(f64::abs(start) / grown);
        assert_close("end", &[end], &[(0.01 / size).powf(0.125) / lambda], QUOTIENT);
    }
}
