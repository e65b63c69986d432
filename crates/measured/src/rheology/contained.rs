//! Fluids that contain other fluids, so that the larger one never fits worse.

use piola_fit::fluids::FluidModel;

/// A fluid, one that it contains, and the parameters with which the first is the second. Terms that the second lacks are so small that they do
/// nothing.
pub(super) type Embedding = (FluidModel, FluidModel, fn(&[f64]) -> Vec<f64>);

/// Of no effect beside a number of its size.
const NOTHING: f64 = 1e-12;

/// Every fluid with those that it contains, the smallest first.
pub(super) const CONTAINED: [Embedding; 10] = [
    (FluidModel::PowerLaw, FluidModel::Newtonian, |p| vec![p[0], 1.0]),
    (FluidModel::Bingham, FluidModel::Newtonian, |p| vec![NOTHING * p[0], p[0]]),
    (FluidModel::Casson, FluidModel::Newtonian, |p| vec![NOTHING * p[0], p[0]]),
    (FluidModel::HerschelBulkley, FluidModel::PowerLaw, |p| vec![NOTHING * p[0], p[0], p[1]]),
    (FluidModel::HerschelBulkley, FluidModel::Bingham, |p| vec![p[0], p[1], 1.0]),
    (FluidModel::Sisko, FluidModel::PowerLaw, |p| vec![NOTHING * p[0], p[0], p[1]]),
    (FluidModel::Sisko, FluidModel::Newtonian, |p| vec![p[0], NOTHING * p[0], 0.5]),
    // η₀ beyond all rows: η₀/(λ k)^(1 − n) = K k^(n − 1).
    (FluidModel::Cross, FluidModel::Sisko, |p| {
        let [zero, time] = beyond(p);
        vec![zero, p[0], time, 1.0 - p[2]]
    }),
    (FluidModel::CarreauYasuda, FluidModel::Sisko, |p| {
        let [zero, time] = beyond(p);
        vec![zero, p[0], time, p[2], 1.0]
    }),
    // (1 + (λ k)^m)⁻¹, as far as m < 1.
    (FluidModel::CarreauYasuda, FluidModel::Cross, |p| vec![p[0], p[1], p[2], (1.0 - p[3]).max(1e-3), p[3]]),
];

/// The fluids that are asked for, then those that they contain.
pub(super) fn with_contained(fluids: &[FluidModel]) -> Vec<FluidModel> {
    let mut all = fluids.to_vec();
    // From the largest fluids to the smallest.
    for (larger, smaller, _) in CONTAINED.iter().rev() {
        if all.contains(larger) && !all.contains(smaller) {
            all.push(*smaller);
        }
    }
    all
}

/// A viscosity at rest, and a time, of a fluid that thins as Sisko's over all rows.
fn beyond(sisko: &[f64]) -> [f64; 2] {
    const FAR: f64 = 1e6;
    [FAR * sisko[1], FAR.powf((1.0 - sisko[2]).recip())]
}
