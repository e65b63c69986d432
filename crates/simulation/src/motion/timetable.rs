//! The span of time and the instants that are recorded.

use core::cmp::Ordering;

/// A span of time, s. The run goes backwards in time if `end < start`.
///
/// # Example
/// ```
/// use piola_simulation::motion::TimeSpan;
/// let back = TimeSpan { start: 2.0, end: -1.0 };
/// assert_eq!((back.length(), back.direction()), (3.0, -1.0));
/// assert!(back.holds(0.5) && back.order(1.0, 0.0).is_lt());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeSpan {
    /// Start, s.
    pub start: f64,
    /// End, s; not the start.
    pub end: f64,
}

impl TimeSpan {
    /// |end − start|, s.
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.end - self.start).abs()
    }

    /// 1 for a run forward in time, −1 for one backwards.
    #[must_use]
    pub fn direction(&self) -> f64 {
        (self.end - self.start).signum()
    }

    /// Sorts instants, s, in the order of the run.
    pub fn sort(&self, instants: &mut [f64]) {
        instants.sort_by(|a, b| self.order(*a, *b));
    }

    /// The order of two instants, s, in the run.
    #[must_use]
    pub fn order(&self, a: f64, b: f64) -> Ordering {
        // Adding zero makes −0 equal to 0.
        let along = |t: f64| self.direction() * t + 0.0;
        along(a).total_cmp(&along(b))
    }

    /// Whether an instant, s, lies in the span, or outside it by rounding alone: by at most [`slack`](Self::slack).
    #[must_use]
    pub fn holds(&self, t: f64) -> bool {
        let slack = self.slack();
        self.start.min(self.end) - slack <= t && t <= self.start.max(self.end) + slack
    }

    /// 10⁻¹² of the length, s: instants nearer to each other than this differ by rounding alone.
    #[must_use]
    pub fn slack(&self) -> f64 {
        1e-12 * self.length()
    }
}

/// The instants at which a run is recorded.
///
/// # Example
/// ```
/// use piola_simulation::motion::{TimeSpan, Timetable};
/// let timetable = Timetable::new(TimeSpan { start: 0.0, end: 1.0 }, 3, &[0.2, 0.5, 7.0]);
/// assert_eq!(timetable.instants(), [0.0, 0.2, 0.5, 1.0]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Timetable {
    span: TimeSpan,
    instants: Vec<f64>,
    pub(super) landings: Vec<f64>,
}

impl Timetable {
    /// `samples` instants at equal distances, the ends of the span among them, and the `landings`, s.
    ///
    /// An adaptive method ends a step at each landing; it records the other instants by dense output. Landings outside of the
    /// span are left out.
    #[must_use]
    pub fn new(span: TimeSpan, samples: u32, landings: &[f64]) -> Self {
        let (first, last) = (span.start.min(span.end), span.start.max(span.end));
        let mut landings: Vec<f64> = landings.iter().copied().filter(|t| first <= *t && *t <= last).collect();
        span.sort(&mut landings);
        Self { span, instants: instants(span, samples, &landings), landings }
    }

    /// The span of time.
    #[must_use]
    pub fn span(&self) -> TimeSpan {
        self.span
    }

    /// The instants, s, in the order of the run, each once.
    #[must_use]
    pub fn instants(&self) -> &[f64] {
        &self.instants
    }
}

/// Samples and landings in the order of the run, each once.
fn instants(time: TimeSpan, samples: u32, landings: &[f64]) -> Vec<f64> {
    let (start, end) = (time.start, time.end);
    let last = f64::from(samples.saturating_sub(1));
    let mut instants: Vec<f64> = (0..samples)
        .map(|i| if i + 1 == samples { end } else { start + (end - start) * (f64::from(i) / last) })
        .collect();
    instants.extend(landings);
    time.sort(&mut instants);
    // Two instants that differ by rounding alone are one; a landing is the one that stays.
    let mut merged: Vec<f64> = Vec::with_capacity(instants.len());
    for t in instants {
        match merged.last_mut() {
            Some(last) if (t - *last).abs() <= time.slack() => {
                if landings.binary_search_by(|probe| time.order(*probe, t)).is_ok() {
                    *last = t;
                }
            }
            _ => merged.push(t),
        }
    }
    merged
}
