//! Settings of a search and its report.

/// Settings of a search.
///
/// # Example
/// ```
/// use piola_specimens::checks::Search;
/// let search = Search { samples: 1000, strain: 1.0, ..Search::default() };
/// assert_eq!(search.seed, Search::default().seed);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Search {
    /// Number of samples: 400.
    pub samples: usize,
    /// Seed of the sequence: the same seed draws the same samples.
    pub seed: u64,
    /// The largest |ln λ| of the principal stretches λ: ½, stretches between 0.61 and 1.65.
    pub strain: f64,
    /// The largest size, relative to the stress or work, that counts as rounding: 1e-10.
    pub tolerance: f64,
}

impl Default for Search {
    fn default() -> Self {
        Self { samples: 400, seed: 1, strain: 0.5, tolerance: 1e-10 }
    }
}

/// Result of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// No counterexample was found among the samples.
    Passed,
    /// A counterexample was found.
    Refuted,
    /// No counterexample was found, but there were samples whose own numerical error is above the tolerance: see
    /// [`Report::unresolved`].
    Unresolved,
    /// There were no samples, or the law refused them all.
    NothingTested,
}

/// The worst counterexample of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report<C> {
    /// Number of samples compared.
    pub samples: usize,
    /// Number of further samples that the law refused, such as those beyond a limiting stretch.
    pub refused: usize,
    /// Number of compared samples that decide nothing: their numerical error is above the tolerance, and their violation is
    /// not above it by more than that error. None but where a check integrates, see [`hyperelasticity`](super::hyperelasticity).
    pub unresolved: usize,
    /// The size up to which the claim passes.
    pub tolerance: f64,
    /// The largest violation, less its numerical error, relative to the stress or work there (but at least to a thousandth of
    /// the largest of all samples); infinite where the law answers with NaN without refusing.
    pub size: f64,
    /// The sample with that violation, or if nothing is refuted the one that is unresolved by most; none only if nothing was
    /// sampled.
    pub worst: Option<C>,
}

impl<C> Report<C> {
    /// True if something was compared, all of it resolved, and no violation above the tolerance was found.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.verdict() == Verdict::Passed
    }

    /// The claim passed, was refuted, remained open for numerical errors, or was not tested at all.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        if self.samples == 0 {
            Verdict::NothingTested
        } else if self.size <= self.tolerance {
            if 0 < self.unresolved { Verdict::Unresolved } else { Verdict::Passed }
        } else {
            Verdict::Refuted
        }
    }

    /// The worst of samples, each with its violation and its scale; none where the law has no answer.
    pub(crate) fn of(search: &Search, drawn: impl Iterator<Item = Option<(f64, f64, C)>>) -> Self {
        let exact = drawn.map(|sample| sample.map(|(violation, scale, sample)| ([violation, 0.0], scale, sample)));
        Self::with_errors(search, exact)
    }

    /// The worst of samples, each with its violation and the error of that, and its scale; none where the law has no answer.
    pub(crate) fn with_errors(search: &Search, drawn: impl Iterator<Item = Option<([f64; 2], f64, C)>>) -> Self {
        let tolerance = search.tolerance;
        let mut refused = 0;
        let samples: Vec<_> = drawn
            .filter_map(|sample| {
                refused += usize::from(sample.is_none());
                sample
            })
            .collect();
        let largest = samples.iter().fold(0.0_f64, |largest, sample| largest.max(sample.1));
        let mut report = Self { samples: samples.len(), refused, unresolved: 0, tolerance, size: 0.0, worst: None };
        let mut open: Option<(f64, C)> = None;
        for ([violation, error], scale, sample) in samples {
            let scale = scale.max(1e-3 * largest);
            let error = if error.is_nan() { f64::INFINITY } else { error };
            let certain = violation - error;
            let size = if certain <= 0.0 {
                0.0
            } else if (certain / scale).is_finite() {
                certain / scale
            } else {
                f64::INFINITY
            };
            if size <= tolerance && tolerance * scale < error {
                report.unresolved += 1;
                if open.as_ref().is_none_or(|(most, _)| *most < error / scale) {
                    open = Some((error / scale, sample));
                }
            } else if report.worst.is_none() || report.size < size {
                report.worst = Some(sample);
            }
            report.size = report.size.max(size);
        }
        if report.verdict() == Verdict::Unresolved {
            report.worst = open.map(|(_, sample)| sample);
        }
        report
    }
}
