//! The free rotation of a body over millions of steps, beside its closed form.

use std::error::Error;

use nalgebra::Vector3;
use piola_integrators::{GaussLegendre, Order, State};
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::rigid_motion::RigidRotation;
use piola_numerics::Real;
use piola_testkit::DoubleDouble;

use super::{Row, Table};

const MOMENTS: [f64; 3] = [1.0, 2.0, 2.5];
const STEPS_A_TURN: f64 = 100.0;

/// (sn, cn, dn)(u, m) by the arithmetic-geometric mean.
fn jacobi<T: Real>(u: T, parameter: T) -> [T; 3] {
    let half = T::lit(0.5);
    let (mut a, mut b) = (T::one(), (T::one() - parameter).sqrt());
    let mut ratios = Vec::new();
    let mut angle = u;
    for _ in 0..6 {
        let (mean, difference) = (half * (a + b), half * (a - b));
        b = (a * b).sqrt();
        a = mean;
        ratios.push(difference / a);
        angle = angle + angle;
    }
    angle *= a;
    for ratio in ratios.into_iter().rev() {
        angle = half * (angle + (ratio * angle.sin()).asin());
    }
    let (sn, cn) = angle.sin_cos();
    [sn, cn, (T::one() - parameter * sn * sn).sqrt()]
}

/// ω(t) of the body that starts with ω = (ω₁, 0, ω₃), where I₁ < I₂ < I₃ and the angular momentum circles the third
/// axis: (ω₁ cn, b sn, ω₃ dn).
fn closed_form(start: [f64; 2], time: DoubleDouble) -> [DoubleDouble; 3] {
    let lit = DoubleDouble::lit;
    let [i1, i2, i3] = MOMENTS.map(lit);
    let [w1, w3] = start.map(lit);
    // ω̇₂ I₂ = (I₃ − I₁) ω₃ ω₁ and cyclic, for ω₁ = a cn, ω₂ = b sn, ω₃ = c dn at the rate λ.
    let b = w1 * (i1 * (i3 - i1) / (i2 * (i3 - i2))).sqrt();
    let rate = w3 * ((i3 - i1) * (i3 - i2) / (i1 * i2)).sqrt();
    let parameter = i1 * (i2 - i1) * w1 * w1 / (i3 * (i3 - i2) * w3 * w3);
    let [sn, cn, dn] = jacobi(rate * time, parameter);
    [w1 * cn, b * sn, w3 * dn]
}

pub(super) fn free_top(steps: u32) -> Result<Table, Box<dyn Error>> {
    let body = RigidBody::new(1.0, Inertia::principal(MOMENTS)?)?;
    let start = [0.5, 1.0];
    let step = 2.0_f64.powi(-4); // about a hundredth of a turn, and a dyadic fraction
    let initial = vec![1.0, 0.0, 0.0, 0.0, start[0], 0.0, start[1]];
    let mut rows = Vec::new();
    let mut state = State::<f64>::new(0.0, initial)?;
    let mut method = GaussLegendre::new(Order::Eight, step)?;
    let mut field = RigidRotation::free(&body)?;
    let measure = |y: &[f64]| {
        let omega = Vector3::new(y[4], y[5], y[6]);
        let momentum = body.spin_in_body(&omega);
        let attitude = Attitude { w: y[0], x: y[1], y: y[2], z: y[3] };
        (body.kinetic_energy(&Vector3::zeros(), &omega), attitude.to_space(&momentum), attitude.squared_length())
    };
    let (energy, momentum, _) = measure(&state.values);
    let decades = (3..9).map(|k| 10_u32.pow(k)).filter(|&decade| decade < steps);
    for decade in decades.chain([steps]) {
        method.integrate_to(&mut field, &mut state, step * f64::from(decade))?;
        let exact = closed_form(start, DoubleDouble::lit(step) * DoubleDouble::lit(f64::from(decade)));
        let (energy_now, momentum_now, squared_length) = measure(&state.values);
        let turns = f64::from(decade) / STEPS_A_TURN;
        rows.push(Row {
            input: format!("{decade:.0e} steps"),
            errors: vec![
                super::rounding(&state.values[4..], &exact),
                (energy_now / energy - 1.0).abs(),
                (momentum_now - momentum).norm() / momentum.norm(),
                (squared_length - 1.0).abs(),
            ],
            // The phase: what the method leaves a step, and rounding that walks.
            allowed: vec![1e-13 + 1e-15 * turns, 1e-12, 1e-12, 1e-12],
        });
    }
    Ok(Table {
        title: "The free top",
        text: "A body with the moments 1, 2, 2.5, started with ω = (0.5, 0, 1) rad/s, by Gauss–Legendre of order 8 in steps of 1/16 s, \
               about a hundred a turn: ω beside the closed form in Jacobi's elliptic functions, and what should not change.",
        columns: vec!["run", "ω", "kinetic energy", "angular momentum in space", "attitude's squared length"],
        rows,
    })
}
