//! Frame-indifference.

use nalgebra::Matrix3;

use super::law::drawn;
use super::{Elastic, Report, Sampler, Search};

/// Two observers of the same deformation, turned against one another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observers {
    /// F of the first.
    pub gradient: Matrix3<f64>,
    /// Q: the second sees Q F.
    pub rotation: Matrix3<f64>,
    /// G(F), Pa.
    pub stress: Matrix3<f64>,
    /// G(Q F), Pa: should be Q G(F) Qᵀ.
    pub seen: Matrix3<f64>,
}

/// Tries to refute G(Q F) = Q G(F) Qᵀ, W(18.3).
///
/// The size is ‖G(QF) − Q G(F) Qᵀ‖ relative to ‖G(F)‖.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_specimens::checks::{Search, frame_indifference};
/// let good = |f: &Matrix3<f64>| f * f.transpose() - Matrix3::identity();
/// let bad = |f: &Matrix3<f64>| f + f.transpose();
/// assert!(frame_indifference(&good, &Search::default()).passes());
/// let report = frame_indifference(&bad, &Search::default());
/// assert!(0.5 < report.size);
/// ```
#[must_use]
pub fn frame_indifference(law: &impl Elastic, search: &Search) -> Report<Observers> {
    let mut sampler = Sampler::new(search.seed);
    let samples = (0..search.samples).map(|_| {
        let (gradient, rotation) = (drawn(law, &mut sampler, search.strain), sampler.rotation());
        if !law.answers(&gradient) {
            return None;
        }
        let (stress, seen) = (law.cauchy(&gradient), law.cauchy(&(rotation * gradient)));
        let violation = (seen - rotation * stress * rotation.transpose()).norm();
        Some((violation, stress.norm().max(seen.norm()), Observers { gradient, rotation, stress, seen }))
    });
    Report::of(search, samples)
}
