//! Radau IIA: coefficients, stability, orders, stiff problems, constraints, failures.

mod checkpoints;
mod constraints;
mod failures;
mod golden;
mod runs;
#[cfg(feature = "sparse")]
mod sparse;
mod stability;
mod steps;
mod tables;
mod test_set;

#[path = "../../../examples/stiff/heavy_top.rs"]
mod heavy_top;
#[path = "../../../examples/stiff/large.rs"]
#[cfg_attr(not(feature = "sparse"), expect(dead_code, reason = "diffusion is solved by sparse matrices"))]
mod large;
#[path = "../../../examples/stiff/mechanisms.rs"]
mod mechanisms;
#[path = "../../../examples/stiff/problems.rs"]
mod problems;

use core::convert::Infallible;

use piola_integrators::field;
use piola_stiff::{GivenJacobian, StiffField};

/// ẏ = λ y for a complex λ, as two real equations.
fn oscillation(re: f64, im: f64) -> impl StiffField<Error = Infallible> {
    let rate = move |_t: f64, y: &[f64], rate: &mut [f64]| {
        rate[0] = re * y[0] - im * y[1];
        rate[1] = im * y[0] + re * y[1];
    };
    GivenJacobian::new(field(2, rate), move |_t, _y: &[f64], jacobian: &mut [f64]| {
        jacobian.copy_from_slice(&[re, im, -im, re]);
    })
}
