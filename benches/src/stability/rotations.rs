//! Eulerian angles near their singular attitudes.

use std::error::Error;

use nalgebra::Vector3;
use piola_kinematics::{Attitude, EulerAngles, EulerSequence};
use piola_numerics::Real;
use piola_numerics::linear::matrix3;
use piola_testkit::DoubleDouble;

use super::{Numbers, Row, Table, rounding, worse};

fn components<T: Real>(attitude: Attitude<T>) -> [T; 4] {
    [attitude.w, attitude.x, attitude.y, attitude.z]
}

/// The angle, nearly, between an attitude and the one that its angles give back, in doubled precision.
fn distance(attitude: Attitude<f64>, again: Attitude<DoubleDouble>) -> f64 {
    let exact = components(attitude).map(DoubleDouble::lit);
    let again = components(again);
    let zero = DoubleDouble::lit(0.0);
    let dot = exact.iter().zip(&again).fold(zero, |sum, (&a, &b)| sum + a * b);
    let length = exact.iter().fold(zero, |sum, &a| sum + a * a).sqrt();
    // q and −q are one attitude; the given one has length one to rounding only.
    let sign = DoubleDouble::lit(1.0).copysign(dot);
    let square = exact.iter().zip(&again).fold(zero, |sum, (&a, &b)| {
        let difference = a / length - sign * b;
        sum + difference * difference
    });
    2.0 * square.sqrt().primal(0)
}

/// Errors at one state: attitude from angles, W, angles from the attitude, rates from ω, the same in the best sequence.
fn errors(sequence: EulerSequence, theta: [f64; 3], omega: [f64; 3]) -> Result<[f64; 5], Box<dyn Error>> {
    let angles = EulerAngles::new(sequence, theta);
    let exact = EulerAngles::new(sequence, theta.map(DoubleDouble::lit));
    let attitude = angles.attitude();
    let of_rates = |angles: EulerAngles<f64>| -> Result<f64, Box<dyn Error>> {
        let exact = EulerAngles::new(angles.sequence, angles.theta.map(DoubleDouble::lit));
        let omega = Vector3::from(omega.map(DoubleDouble::lit));
        let rates = matrix3::solve(&exact.rate_matrix(), &omega)?;
        Ok(rounding(&angles.rates(&Vector3::from(omega.map(|x| x.primal(0))))?.rates, rates.as_slice()))
    };
    let found = EulerAngles::of_attitude(sequence, attitude).angles();
    let rebuilt = EulerAngles::new(sequence, found.theta.map(DoubleDouble::lit)).attitude();
    let best = EulerAngles::of_attitude(EulerSequence::best(attitude), attitude).angles();
    Ok([
        rounding(&components(attitude), &components(exact.attitude())),
        rounding(angles.rate_matrix().as_slice(), exact.rate_matrix().as_slice()),
        distance(attitude, rebuilt),
        of_rates(angles)?,
        of_rates(best)?,
    ])
}

pub(super) fn near_singular_angles() -> Result<Table, Box<dyn Error>> {
    let places = [
        ("z–y–z, θ² =", EulerSequence::Zyz, 0.0),
        ("z–y–z, θ² = π −", EulerSequence::Zyz, core::f64::consts::PI),
        ("x–y–z, θ² = π/2 −", EulerSequence::Xyz, core::f64::consts::FRAC_PI_2),
    ];
    let mut rows = Vec::new();
    for (input, sequence, singular) in places {
        for exponent in [0, 3, 6, 9, 12] {
            let distance = 10_f64.powi(-exponent);
            let mut numbers = Numbers(11);
            let mut worst = vec![0.0; 5];
            for _ in 0..64 {
                let [first, third] = [(); 2].map(|()| 3.0 * numbers.next());
                let omega = [(); 3].map(|()| numbers.next());
                for (worst, error) in
                    worst.iter_mut().zip(errors(sequence, [first, (singular - distance).abs(), third], omega)?)
                {
                    *worst = worse(*worst, error);
                }
            }
            rows.push(Row { input: format!("{input} 1e-{exponent}"), errors: worst, allowed: vec![4e-15; 5] });
        }
    }
    Ok(Table {
        title: "Eulerian angles near their singular attitudes",
        text: "At 64 states each: the attitude and the matrix W from angles; the attitude that the angles found for an attitude give \
               back, as a rotation, rad; the rates θ̇ from ω, relative to themselves, which grow as 1/distance; and the rates in the \
               sequence that is then the best conditioned, to which a chart changes.",
        columns: vec!["angles", "attitude", "W", "angles of attitude", "θ̇", "θ̇, best sequence"],
        rows,
    })
}
