//! Identities of rates, for random motions.

mod exponentials;
mod histories;
mod objectivity;
mod polar;

use piola_numerics::Dual;

/// The derivative of a differentiable matrix with respect to time.
fn tangent(a: &nalgebra::Matrix3<Dual<f64>>) -> nalgebra::Matrix3<f64> {
    a.map(|x| x.tangent)
}

/// The value of a differentiable matrix.
fn value(a: &nalgebra::Matrix3<Dual<f64>>) -> nalgebra::Matrix3<f64> {
    a.map(|x| x.value)
}
