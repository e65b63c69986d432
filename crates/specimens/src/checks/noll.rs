//! Noll's theorem: for a law with an energy, three claims stand or fall together.

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_solids::Hyperelastic;

use super::law::drawn;
use super::{Elastic, Observers, Report, Sampler, Search, Stored, frame_indifference};

/// The energy as seen by two observers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyOfObservers {
    /// F of the first.
    pub gradient: Matrix3<f64>,
    /// Q: the second sees Q F.
    pub rotation: Matrix3<f64>,
    /// W(F), J/m³.
    pub energy: f64,
    /// W(Q F), J/m³: should be the same.
    pub seen: f64,
}

/// A stress that is not symmetric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Skewness {
    /// F.
    pub gradient: Matrix3<f64>,
    /// T = P Fᵀ/J, Pa.
    pub stress: Matrix3<f64>,
}

/// The three claims of Noll's theorem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NollReport {
    /// W(Q F) = W(F).
    pub energy: Report<EnergyOfObservers>,
    /// G(Q F) = Q G(F) Qᵀ.
    pub response: Report<Observers>,
    /// T = Tᵀ.
    pub symmetry: Report<Skewness>,
}

impl NollReport {
    /// True if all three pass.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.energy.passes() && self.response.passes() && self.symmetry.passes()
    }

    /// True if the three stand or fall together, as the theorem says: otherwise the stress of the law is not the derivative of
    /// its energy. False where nothing was tested.
    #[must_use]
    pub fn agrees(&self) -> bool {
        let tested = [self.energy.samples, self.response.samples, self.symmetry.samples].iter().all(|&count| 0 < count);
        tested && self.energy.passes() == self.response.passes() && self.response.passes() == self.symmetry.passes()
    }
}

/// Tries to refute each of the three equivalent claims on a law with an energy, W(20.18).
///
/// # Example
/// ```
/// use piola_specimens::checks::{Search, noll};
/// use piola_solids::MooneyRivlin;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// let report = noll(&rubber, &Search::default());
/// assert!(report.agrees() && report.passes());
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
///
/// # Source
/// W p. 127.
#[must_use]
pub fn noll(law: &impl Hyperelastic, search: &Search) -> NollReport {
    let energy_of = |gradient: &Matrix3<f64>| DeformationGradient::new(*gradient).map_or(f64::NAN, |f| law.energy(&f));
    let mut sampler = Sampler::new(search.seed);
    let response = Stored(law);
    let energies = (0..search.samples).map(|_| {
        let (gradient, rotation) = (drawn(&response, &mut sampler, search.strain), sampler.rotation());
        if !response.answers(&gradient) {
            return None;
        }
        let (energy, seen) = (energy_of(&gradient), energy_of(&(rotation * gradient)));
        let scale = energy.abs().max(seen.abs());
        Some(((seen - energy).abs(), scale, EnergyOfObservers { gradient, rotation, energy, seen }))
    });
    let energy = Report::of(search, energies);
    let mut sampler = Sampler::new(search.seed);
    let stresses = (0..search.samples).map(|_| {
        let gradient = drawn(&response, &mut sampler, search.strain);
        if !response.answers(&gradient) {
            return None;
        }
        let stress = response.cauchy(&gradient);
        Some(((stress - stress.transpose()).norm(), stress.norm(), Skewness { gradient, stress }))
    });
    let symmetry = Report::of(search, stresses);
    NollReport { energy, response: frame_indifference(&response, search), symmetry }
}
