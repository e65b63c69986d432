//! The inequalities of Baker and Ericksen.

use piola_continuum::DeformationGradient;
use piola_solids::Hyperelastic;

use super::{Sampler, Search};

/// The least of Baker and Ericksen's quotients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BakerEricksen {
    /// Number of stretches compared.
    pub samples: usize,
    /// Number of further samples that the law refused.
    pub refused: usize,
    /// The least (Tᵢ − Tⱼ)/(λᵢ − λⱼ), Pa.
    pub least: f64,
    /// The principal stretches there.
    pub stretches: [f64; 3],
    /// i and j.
    pub pair: [usize; 2],
}

impl BakerEricksen {
    /// True if something was compared, and the greater stress was always along the greater stretch.
    #[must_use]
    pub fn passes(&self) -> bool {
        0 < self.samples && 0.0 < self.least
    }
}

/// Tries to refute Baker and Ericksen's inequalities of an isotropic law: (Tᵢ − Tⱼ)(λᵢ − λⱼ) > 0 where λᵢ ≠ λⱼ.
///
/// The pressure of an incompressible law drops out of the differences; its stretches are isochoric.
///
/// # Example
/// ```
/// use piola_specimens::checks::{Search, baker_ericksen};
/// use piola_solids::MooneyRivlin;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// assert!(baker_ericksen(&rubber, &Search { strain: 2.0, ..Search::default() }).passes());
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
///
/// # Source
/// M. Baker, J. L. Ericksen, *Inequalities restricting the form of the stress-deformation relations for isotropic elastic
/// solids*, J. Wash. Acad. Sci. 44 (1954).
#[must_use]
pub fn baker_ericksen(law: &impl Hyperelastic, search: &Search) -> BakerEricksen {
    let mut sampler = Sampler::new(search.seed);
    let mut report = BakerEricksen { samples: 0, refused: 0, least: f64::INFINITY, stretches: [1.0; 3], pair: [0, 1] };
    for _ in 0..search.samples {
        let mut stretches = sampler.stretches(search.strain);
        if law.is_incompressible() {
            let mean = (stretches[0] * stretches[1] * stretches[2]).cbrt();
            stretches = stretches.map(|stretch| stretch / mean);
        }
        let answered = DeformationGradient::diagonal(stretches).ok().filter(|f| law.check(f).is_ok());
        let Some(deformation) = answered else {
            report.refused += 1;
            continue;
        };
        let stress = law.cauchy(&deformation).0.components;
        let mut compared = false;
        for pair in [[0, 1], [1, 2], [0, 2]] {
            let apart = stretches[pair[0]] - stretches[pair[1]];
            // Closer together the difference of the stresses is rounding.
            if apart.abs() < 1e-6 * stretches[pair[0]] {
                continue;
            }
            compared = true;
            let quotient = (stress[pair[0]] - stress[pair[1]]) / apart;
            if quotient < report.least || quotient.is_nan() {
                (report.least, report.stretches, report.pair) = (quotient, stretches, pair);
            }
        }
        report.samples += usize::from(compared);
    }
    report
}
