//! An increment of the deformation: implicit steps, extrapolated; divided where the error or Newton's method asks for it.

use core::iter::successors;

use piola_tensor::internal::rows::Rows;

use crate::newton::{IncrementScalar, Iterations, along, between, implicit_step, values};
use crate::{Evolution, InelasticError};

/// The most widths of steps that are extrapolated: 1, ½, ⅓, … of the increment. Seven multiply rounding by a thousand, ten by fifty
/// thousand.
const MOST_WIDTHS: usize = 7;

/// How accurately an increment is integrated.
///
/// # Example
/// ```
/// use piola_inelastic::StepControl;
/// assert!(StepControl::new(1e-6).is_ok() && StepControl::new(-1.0).is_err());
/// assert_eq!(StepControl::one_step().tolerance(), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepControl {
    tolerance: Option<f64>,
}

impl StepControl {
    /// With an estimated error of the internal variables below `tolerance`, in each part of an increment.
    ///
    /// Parts begin where [`Evolution::evolves`] becomes true, as at a yield point. It is asked at eight places of a part: flow that begins
    /// and ends between two of them is not seen. A part that begins with flow is shortened until its own beginning flows at all of them,
    /// and at places ever closer to the beginning. A part at whose end the body no longer flows is halved, until the flow that is left changes
    /// the state by less than the tolerance.
    ///
    /// # Accuracy
    /// The errors of the parts add up, and the law may enlarge them. Where flow ends inside an increment, in 200 random unloadings of
    /// [`Kinematic`](crate::Kinematic) with viscosity and 200 random turns without, the state was off by less than a hundred times the
    /// tolerance, with 1e-6 and with 1e-10.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`] unless 1e-14 ≤ tolerance.
    pub fn new(tolerance: f64) -> Result<Self, InelasticError> {
        let holds = 1e-14 <= tolerance;
        crate::error::check_bound("control", "tolerance", tolerance, "1e-14 ≤ tolerance", holds)?;
        Ok(Self { tolerance: Some(tolerance) })
    }

    /// One implicit step an increment, of the first order in its width, without an estimate of the error: as finite elements use it.
    /// Where Newton's method fails the increment is divided all the same.
    #[must_use]
    pub const fn one_step() -> Self {
        Self { tolerance: None }
    }

    /// The tolerance; none for one step.
    #[must_use]
    pub const fn tolerance(&self) -> Option<f64> {
        self.tolerance
    }
}

impl Default for StepControl {
    /// A tolerance of 1e-10.
    fn default() -> Self {
        Self { tolerance: Some(1e-10) }
    }
}

/// What an increment took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Parts into which the increment was divided.
    pub parts: usize,
    /// Implicit steps.
    pub steps: usize,
    /// Iterations of Newton's method.
    pub iterations: usize,
    /// The largest estimated error of the internal variables in a part; zero for one step.
    pub error: f64,
}

/// Where an increment stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reached<T, const S: usize> {
    pub(crate) share: f64,
    pub(crate) state: [T; S],
}

/// A part of an increment.
struct Part<T, const S: usize> {
    /// The state at its end.
    state: [T; S],
    /// Widths of steps that were extrapolated.
    widths: usize,
    /// The largest change of a coordinate of the state.
    change: f64,
}

/// Why an increment ended early.
pub(crate) enum Failure {
    Newton(Iterations),
    Error { error: f64, tolerance: f64 },
}

impl Failure {
    pub(crate) fn at(self, share: f64, gradient: Rows<f64>) -> InelasticError {
        match self {
            Self::Newton(iterations) => InelasticError::NotConverged {
                share,
                gradient,
                residual: iterations.residual,
                iterations: iterations.count,
            },
            Self::Error { error, tolerance } => InelasticError::NotAccurate { share, gradient, error, tolerance },
        }
    }
}

/// An increment to be integrated.
pub(crate) struct Increment<'a, L, const S: usize> {
    pub(crate) law: &'a L,
    pub(crate) start: Rows<f64>,
    pub(crate) end: Rows<f64>,
    pub(crate) dt: f64,
    pub(crate) control: StepControl,
}

impl<L, const S: usize> Increment<'_, L, S> {
    /// `count` equal implicit steps over a part of the increment.
    fn steps<T: IncrementScalar, const X: usize>(
        &self,
        from: &Reached<T, S>,
        width: f64,
        count: usize,
        effort: &mut Effort,
    ) -> Result<[T; S], Failure>
    where
        L: Evolution<S, X>,
    {
        let mut state = from.state;
        for k in 1..=count {
            let share = from.share + width * (k as f64 / count as f64);
            let gradient = between(&self.start, &self.end, share);
            let dt = self.dt * (width / count as f64);
            let (next, iterations) =
                implicit_step::<T, L, S, X>(self.law, &state, &gradient, dt).map_err(Failure::Newton)?;
            state = next;
            effort.steps += 1;
            effort.iterations += iterations.count;
        }
        Ok(state)
    }

    /// A part of the increment by steps of several widths, extrapolated to width zero (Neville's scheme).
    ///
    /// ```text
    /// Tⱼₖ = Tⱼ,ₖ₋₁ + (Tⱼ,ₖ₋₁ − Tⱼ₋₁,ₖ₋₁)/(nⱼ/nⱼ₋ₖ₊₁ − 1)
    /// ```
    fn part<T: IncrementScalar, const X: usize>(
        &self,
        from: &Reached<T, S>,
        width: f64,
        effort: &mut Effort,
    ) -> Result<Part<T, S>, Failure>
    where
        L: Evolution<S, X>,
    {
        let Some(tolerance) = self.control.tolerance else {
            return Ok(Part { state: self.steps::<T, X>(from, width, 1, effort)?, widths: 1, change: 0.0 });
        };
        let mut row = [[T::zero(); S]; MOST_WIDTHS];
        let mut error = f64::INFINITY;
        for j in 0..MOST_WIDTHS {
            let state = self.steps::<T, X>(from, width, j + 1, effort)?;
            let mut entry = self.law.coordinates(&from.state, &state);
            let mut last = entry;
            for (k, place) in row.iter_mut().take(j).enumerate() {
                // The row holds T of the last width at k; it makes way for T of this one.
                let above = core::mem::replace(place, entry);
                let ratio = (j + 1) as f64 / (j - k) as f64 - 1.0;
                last = entry;
                for (entry, above) in entry.iter_mut().zip(above) {
                    let change = (*entry - above) * T::lit(1.0 / ratio);
                    *entry += change;
                }
            }
            row[j] = entry;
            if 0 < j {
                error =
                    entry.iter().zip(last).fold(0.0, |size: f64, (x, y)| size.max((x.primal(0) - y.primal(0)).abs()));
                if error <= tolerance {
                    effort.error = effort.error.max(error);
                    let change = entry.iter().fold(0.0, |size: f64, x| size.max(x.primal(0).abs()));
                    return Ok(Part { state: self.law.at_coordinates(&from.state, &entry), widths: j + 1, change });
                }
            }
        }
        Err(Failure::Error { error, tolerance })
    }

    /// Makes a part begin where the body begins to flow, and flow all the way: the share at which it begins, perhaps with a smaller width.
    ///
    /// Steps in which nothing flows leave the state alone, so an implicit step from before the yield point has the same result as one from the
    /// yield point. Steps of several widths would agree on it, and their difference would tell nothing of its error.
    fn aligned<const X: usize>(&self, state: &[f64; S], start: f64, width: &mut f64) -> f64
    where
        L: Evolution<S, X>,
    {
        let flows = |share: f64| self.law.evolves(state, &self.gradient(share), self.dt * (share - start));
        if flows(start + *width * BESIDE) {
            // A state of an extrapolated part may lie outside the yield surface by the tolerance: ask inside the part, too, and ever
            // closer to its beginning, from where a body unloads.
            let flows_through = |width: f64| {
                let near = successors(Some(0.5 * width / SAMPLES as f64), |share| Some(0.5 * share));
                let even = (1..=SAMPLES).map(|k| width * (k as f64 / SAMPLES as f64));
                even.chain(near.take_while(|share| SHORTEST_FLOW < *share)).all(|share| flows(start + share))
            };
            while SHORTEST_FLOW < *width && !flows_through(*width) {
                *width *= 0.5;
            }
            return start;
        }
        let mut samples = (1..=SAMPLES).map(|k| start + *width * (k as f64 / SAMPLES as f64));
        let Some(mut high) = samples.find(|share| flows(*share)) else { return start };
        let mut low = high - *width / SAMPLES as f64;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if flows(middle) { high = middle } else { low = middle }
        }
        if start + *width * BESIDE < low { low } else { start }
    }

    /// Whether a body of this state no longer flows a little beyond the end of a part. At the end itself rounding decides of a body without
    /// viscosity, which stands at its yield stress.
    fn has_ended<const X: usize>(&self, state: &[f64; S], share: f64, width: f64) -> bool
    where
        L: Evolution<S, X>,
    {
        let beyond = share + width / (8 * SAMPLES) as f64;
        let gradient = [0, 1, 2].map(|i| [0, 1, 2].map(|j| along(self.start[i][j], self.end[i][j], beyond)));
        !self.law.evolves(state, &gradient, self.dt * (beyond - share))
    }

    /// The state at the end; where that is not reached, the last admissible state and why it is the last.
    pub(crate) fn run<T: IncrementScalar, const X: usize>(
        &self,
        state: &[f64; S],
    ) -> (Reached<T, S>, Effort, Option<Failure>)
    where
        L: Evolution<S, X>,
    {
        let mut effort = Effort { parts: 0, steps: 0, iterations: 0, error: 0.0 };
        let mut reached = Reached { share: 0.0, state: state.map(T::lit) };
        let (mut width, mut alignments) = (1.0, 0);
        // Change of the state over the share of the increment in the part before, as long as the body flows.
        let (mut rate, mut is_ending) = (f64::INFINITY, false);
        while reached.share < 1.0 {
            width = f64::min(width, 1.0 - reached.share);
            let mut flows = false;
            if X != 0 && self.control.tolerance.is_some() && alignments < MOST_ALIGNMENTS {
                let before = width;
                let share = self.aligned::<X>(&values(&reached.state), reached.share, &mut width);
                // A shortening that does not reach the shortest width ends by itself.
                alignments += usize::from(reached.share < share || (width < before && width <= SHORTEST_FLOW));
                if reached.share < share {
                    reached.share = share;
                    continue;
                }
                let beside = self.gradient(reached.share + width * BESIDE);
                flows = self.law.evolves(&values(&reached.state), &beside, self.dt * (width * BESIDE));
            }
            match self.part::<T, X>(&reached, width, &mut effort) {
                Ok(Part { state, widths, change }) => {
                    let share = if width < 1.0 - reached.share { reached.share + width } else { 1.0 };
                    let has_ended = flows && self.has_ended::<X>(&values(&state), share, width);
                    // Flow fades before it ends: what is left of it is at most as fast as it was.
                    let is_left = self.control.tolerance.is_some_and(|tolerance| tolerance < rate * width);
                    if has_ended && is_left && SHORTEST_FLOW < width {
                        (width, is_ending) = (0.5 * width, true);
                        continue;
                    }
                    reached = Reached { share, state };
                    effort.parts += 1;
                    alignments += usize::from(has_ended);
                    is_ending = is_ending && flows && !has_ended;
                    rate = if flows && !has_ended { change / width } else { f64::INFINITY };
                    if widths < 5 && !is_ending {
                        width *= 2.0;
                    }
                }
                Err(failure) => {
                    width *= 0.5;
                    if width < SMALLEST_WIDTH {
                        return (reached, effort, Some(failure));
                    }
                }
            }
        }
        (reached, effort, None)
    }

    /// F of a share of the increment.
    pub(crate) fn gradient(&self, share: f64) -> Rows<f64> {
        between(&self.start, &self.end, share)
    }
}

/// Parts of an increment are not divided further.
const SMALLEST_WIDTH: f64 = 1e-5;
/// The share of a part that is taken as its beginning, above the rounding of a yield stress.
const BESIDE: f64 = 1e-12;
/// A part at whose end the body no longer flows is shortened to this: flow fades before it ends, so that less than the square is missed.
const SHORTEST_FLOW: f64 = 1e-7;
/// Shares of a part at which the body is asked whether it flows.
const SAMPLES: usize = 8;
/// How often flow may begin, or end within the shortest part, in an increment. A load that neither loads nor unloads a flowing body begins
/// and ends it by rounding.
const MOST_ALIGNMENTS: usize = 8;
/// Halvings that find the beginning of flow to rounding.
const HALVINGS: usize = 50;
