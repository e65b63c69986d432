//! Retardation spectra: creep in closed form from a relaxation spectrum.

use piola_numerics::Real;

use crate::{RelaxationMode, RelaxationSpectrum, kernel};

/// One mode of a retardation spectrum: J (1 − e^(−t/λ)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RetardationMode {
    /// J, 1/Pa.
    pub compliance: f64,
    /// λ, s.
    pub retardation_time: f64,
}

/// A discrete retardation spectrum: the generalised Kelvin–Voigt model, converted from a relaxation spectrum.
///
/// ```text
/// J(t) = J_g + t/η₀ + Σ Jₖ (1 − e^(−t/λₖ))      J_g = 1/G(0);  t/η₀ only of a liquid
/// Q(λ) = Gₑ + Σ gᵢ τᵢ/(τᵢ − λ) = 0 at each λₖ    Jₖ = λₖ/Σ gᵢ τᵢ λₖ²/(λₖ − τᵢ)²
/// ```
/// The retardation times lie between the relaxation times, one in each gap. A solid has one more, beyond the longest.
///
/// # Accuracy
/// λₖ is found by bisection to the last place that Q resolves. The error of Jₖ grows where λₖ is close to a relaxation time:
/// about 4 ulp · λₖ/|λₖ − τᵢ|. Equal relaxation times are joined.
///
/// # Example
/// ```
/// use piola_spectra::{RelaxationMode, RelaxationSpectrum, RetardationSpectrum};
/// // A standard linear solid with Gₑ = g = 1 Pa, τ = 1 s: J(0) = 1/2, J(∞) = 1, λ = τ (Gₑ + g)/Gₑ = 2 s.
/// let solid = RelaxationSpectrum::new(vec![RelaxationMode { modulus: 1.0, relaxation_time: 1.0 }], 1.0)?;
/// let creep = RetardationSpectrum::of(&solid);
/// assert!((creep.modes()[0].retardation_time - 2.0).abs() < 1e-14);
/// assert!((creep.compliance(2.0) - (1.0 - 0.5 * (-1.0_f64).exp())).abs() < 1e-14);
/// # Ok::<(), piola_spectra::SpectraError>(())
/// ```
///
/// # Source
/// B. Gross, Mathematical Structure of the Theories of Viscoelasticity, Hermann, Paris, 1953.
#[derive(Clone, Debug, PartialEq)]
pub struct RetardationSpectrum {
    modes: Vec<RetardationMode>,
    glassy_compliance: f64,
    fluidity: f64,
}

impl RetardationSpectrum {
    /// Of a relaxation spectrum.
    #[must_use]
    pub fn of(spectrum: &RelaxationSpectrum) -> Self {
        let joined = joined(spectrum.modes());
        let equilibrium = spectrum.equilibrium_modulus();
        // Below a root Q < 0: just above τᵢ its own term is −∞.
        let is_below = |lambda: f64| {
            let terms = joined.iter().map(|mode| mode.modulus / (1.0 - lambda / mode.relaxation_time));
            terms.fold(equilibrium, |sum, term| sum + term) < 0.0
        };
        let mut modes = Vec::with_capacity(joined.len());
        let mut add = |low: f64, high: f64| {
            let retardation_time = root(low, high, &is_below);
            let slope = |mode: &RelaxationMode| {
                let distance = 1.0 - mode.relaxation_time / retardation_time;
                mode.modulus * (mode.relaxation_time / retardation_time) / (distance * distance)
            };
            modes.push(RetardationMode { compliance: joined.iter().map(slope).sum::<f64>().recip(), retardation_time });
        };
        for pair in joined.windows(2) {
            add(pair[0].relaxation_time, pair[1].relaxation_time);
        }
        if let Some(last) = joined.last().filter(|_| !spectrum.is_liquid()) {
            // Q > 0 from here on: each gᵢ τᵢ/(λ − τᵢ) is at most gᵢ τₙ/(λ − τₙ).
            let ratio = spectrum.glassy_modulus() / equilibrium;
            add(last.relaxation_time, last.relaxation_time * (1.0 + ratio));
        }
        Self {
            modes,
            glassy_compliance: spectrum.glassy_modulus().recip(),
            fluidity: spectrum.zero_shear_viscosity().map_or(0.0, f64::recip),
        }
    }

    /// The modes, from the shortest retardation time to the longest.
    #[must_use]
    pub fn modes(&self) -> &[RetardationMode] {
        &self.modes
    }

    /// Creep compliance J(t), 1/Pa, at the time `t`, s, after a step of stress.
    pub fn compliance<T: Real>(&self, t: T) -> T {
        let first = T::lit(self.glassy_compliance) + T::lit(self.fluidity) * t;
        self.modes
            .iter()
            .fold(first, |sum, mode| sum + T::lit(mode.compliance) * kernel::growth(t / T::lit(mode.retardation_time)))
    }
}

/// The modes with equal relaxation times joined.
fn joined(modes: &[RelaxationMode]) -> Vec<RelaxationMode> {
    let mut joined: Vec<RelaxationMode> = Vec::with_capacity(modes.len());
    for mode in modes {
        match joined.last_mut() {
            Some(last) if mode.relaxation_time <= last.relaxation_time => last.modulus += mode.modulus,
            _ => joined.push(*mode),
        }
    }
    joined
}

/// The root between two numbers, by bisection until no number is left between them.
fn root(mut low: f64, mut high: f64, is_below: &dyn Fn(f64) -> bool) -> f64 {
    loop {
        // The geometric mean first: the gap may span decades.
        let mean = if 4.0 * low < high { low.sqrt() * high.sqrt() } else { low + 0.5 * (high - low) };
        if mean <= low || high <= mean {
            return high;
        }
        if is_below(mean) { low = mean } else { high = mean }
    }
}
