//! A splitting with a processor: the kernel is iterated, the processor enters and leaves its coordinates.
//!
//! ```text
//! y → π(y)  once,    y ← κₕ(y)  at each step,    y → π⁻¹(y)  where the state is shown
//! ```
//!
//! The map π⁻¹ κₕ π has order six, though the kernel κₕ alone has order two only: the errors that a change of coordinates
//! takes away need not be taken away by stages of the kernel. It has fewer conditions to obey, and so fewer forces and smaller errors.

use core::ops::ControlFlow;

use piola_numerics::Real;

use crate::composition::Splitter;
use crate::splitting::{SplittingStage, palindrome, processor};
use crate::state::{check_run, check_step};
use crate::{Checkpoint, Ending, IntegratorsError, Report, Separable, State, Step};

/// A processed Runge–Kutta–Nyström splitting of order six, with a fixed step: for q̇ = M⁻¹p with a constant M, ṗ = w(t, q).
///
/// ```text
/// kernel κ       b₁ a₁ b₂ a₂ … a₂ b₂ a₁ b₁    Σ a = Σ b = 1, symmetric: 7 forces a step
/// processor π    a₀ b₁ a₁ … b₁₁ a₁₁           Σ a = Σ b = 0: 11 forces at the start, and for each state that is shown
/// ```
///
/// Both are symplectic, and so is what is shown. On other separable systems the order is lower, and the method cannot detect it. Use
/// [`Composition`](crate::Composition) there.
///
/// # Accuracy
/// Global error O(h⁶). Evaluated with 31 digits at the stored doubles, the order conditions of π⁻¹ κₕ π are obeyed to
/// 2e-15 (test `the_processed_splitting_obeys_all_conditions`). States are summed with compensation.
///
/// # Example
/// ```
/// use core::ops::ControlFlow;
/// use piola_integrators::{ProcessedSplitting, State, separable};
/// let mut pendulum = separable(1, |_t, q: &[f64], force: &mut [f64]| force[0] = -q[0].sin());
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// // Four hundred steps, of which every hundredth is shown.
/// let mut method = ProcessedSplitting::new(0.25)?;
/// let mut shown = 0;
/// let report = method.integrate(&mut pendulum, &mut state, 100.0, 100, |_step| {
///     shown += 1;
///     ControlFlow::Continue(())
/// })?;
/// assert_eq!((report.steps, shown), (400, 4));
/// let energy = 0.5 * state.values[1].powi(2) - state.values[0].cos();
/// assert!((energy + 1.0_f64.cos()).abs() < 1e-9);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
///
/// # References
/// S. Blanes, F. Casas & J. Ros, *Symplectic integration with processing: a general study*, SIAM J. Sci. Comput. 21 (1999) 711. The
/// coefficients are our own: `testdata/scripts/processed_splitting.py`.
#[doc(alias("symplectic corrector", "effective order", "processing", "conjugate"))]
#[derive(Clone, Debug)]
pub struct ProcessedSplitting<T = f64> {
    step: f64,
    kernel: Splitter<T>,
    enter: Splitter<T>,
    leave: Splitter<T>,
    /// The state in the kernel's coordinates, which depend on the length of the step.
    inner: Option<Inner<T>>,
}

#[derive(Clone, Debug)]
struct Inner<T> {
    state: State<T>,
    step: f64,
}

/// The name in a checkpoint.
const NAME: &str = "ProcessedSplitting";

impl<T: Real> ProcessedSplitting<T> {
    /// The splitting with steps no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        Ok(Self {
            step,
            kernel: Splitter::new(palindrome(&KERNEL)),
            enter: Splitter::new(processor(&PROCESSOR, false)),
            leave: Splitter::new(processor(&PROCESSOR, true)),
            inner: None,
        })
    }

    crate::longest_step!();

    /// The drifts and kicks of the processor, of one step of the kernel, and of the inverse processor, in units of the step.
    #[doc(hidden)]
    #[must_use]
    pub fn stages() -> [Vec<SplittingStage>; 3] {
        [processor(&PROCESSOR, false), palindrome(&KERNEL), processor(&PROCESSOR, true)]
            .map(|(stages, count)| stages[..count].to_vec())
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step), unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F: Separable<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate(field, state, end, 0, crate::unobserved)
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is earlier than the state's time.
    ///
    /// The observer sees the last step and, if `shown` is not 0, every `shown`-th one, and may stop the run there. To show a state
    /// costs the forces of the processor; it does not change the run.
    ///
    /// # Errors
    /// The state does not fit or is not finite, the step is too small to advance the time, or the field fails or gives a rate that is
    /// not finite. The state then stands at the last complete step. If the processor itself fails, the state is the one shown last.
    pub fn integrate<F: Separable<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        check_run(2 * field.freedom(), state, end)?;
        self.inner = None;
        self.run(field, state, end, shown, Report::begin(), observer)
    }

    /// The run where it stands, to be continued by [`resume`](Self::resume): the state and the report of a run of this method that has
    /// ended or that the observer has stopped. Before the first run, and where the processor has failed, the checkpoint is empty, and
    /// [`resume`](Self::resume) refuses it.
    #[must_use]
    pub fn checkpoint(&self, state: &State<T>, report: Report) -> Checkpoint<T> {
        // Where the processor has failed, the kernel is ahead of the state.
        let inner = self.inner.as_ref().filter(|inner| inner.state.time.total_cmp(&state.time).is_eq());
        let (memory, numbers) = inner.map_or((Vec::new(), Vec::new()), |Inner { state, step }| {
            ([&state.values[..], &state.carry].concat(), vec![*step])
        });
        Checkpoint::of(NAME, state.clone(), report, memory, numbers)
    }

    /// Continues a run from a [`Checkpoint`] that this method made with the same settings: the state becomes that of the
    /// checkpoint. To the same end the run takes the same steps, to the last bit. To another end the length of the steps may differ;
    /// the run then begins anew from the state of the checkpoint, and its report goes on counting.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate); [`IntegratorsError::WrongMethod`] for a checkpoint of another method,
    /// [`IntegratorsError::WrongLength`] for one of another system or an empty one. The state is then left alone.
    pub fn resume<F: Separable<T>>(
        &mut self,
        field: &mut F,
        checkpoint: &Checkpoint<T>,
        state: &mut State<T>,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        let n = 2 * field.freedom();
        checkpoint.open(NAME, [2 * n, 1], &[], state, |state| check_run(n, state, end))?;
        let mut inner = state.clone();
        let (memory, numbers) = checkpoint.memory();
        let (values, carry) = memory.split_at(n);
        inner.values.copy_from_slice(values);
        inner.carry.copy_from_slice(carry);
        self.inner = Some(Inner { state: inner, step: numbers[0] });
        self.run(field, state, end, shown, checkpoint.report().continued(), observer)
    }

    fn run<F: Separable<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        shown: u64,
        before: Report,
        mut observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        let Self { step, kernel, enter, leave, inner } = self;
        for splitter in [&mut *kernel, enter, leave] {
            splitter.begin(field.freedom());
        }
        let (steps, taken) = state.begin_equal_steps(end, *step)?;
        let h = steps.length;
        let mut report = before;
        if steps.count == taken {
            return Ok(report);
        }
        let of_this_step = inner.take().filter(|inner| inner.step.total_cmp(&h).is_eq());
        let Inner { state: inner, .. } = if let Some(kept) = of_this_step {
            inner.insert(kept)
        } else {
            let mut entered = state.clone();
            report.evaluations += enter.advance(field, &mut entered, h, state.time)?;
            inner.insert(Inner { state: entered, step: h })
        };
        let mut spare = inner.clone();
        let mut show = |field: &mut F, inner: &State<T>, state: &mut State<T>| {
            spare.clone_from(inner);
            let evaluations = leave.advance(field, &mut spare, h, inner.time)?;
            state.values.copy_from_slice(&spare.values);
            state.carry.copy_from_slice(&spare.carry);
            state.set_time(inner.time);
            Ok(evaluations)
        };
        for number in taken + 1..=steps.count {
            let time = steps.time(number);
            match kernel.advance(field, inner, h, time) {
                Ok(evaluations) => report.evaluations += evaluations,
                Err(error) => {
                    if number > taken + 1 {
                        let _: Result<u64, IntegratorsError<F::Error>> = show(field, inner, state);
                    }
                    return Err(error);
                }
            }
            inner.set_time(time);
            report.steps += 1;
            let is_shown = number == steps.count || 0 < shown && report.steps.is_multiple_of(shown);
            if !is_shown {
                continue;
            }
            report.evaluations += show(field, inner, state)?;
            if observer(Step { number: report.steps, time, values: &state.values }).is_break() {
                report.ending = Ending::Stopped;
                break;
            }
        }
        Ok(report)
    }
}

/// Half of the palindrome of drifts and kicks in turn, its middle included; it begins with a kick.
const KERNEL: [f64; 9] = [
    0.0,
    0.277_541_589_141_102_1,
    -0.060_871_170_384_930_395,
    -0.145_537_376_712_813_4,
    0.326_652_364_723_273_75,
    0.260_722_349_791_710_2,
    0.310_760_009_360_904_1,
    0.107_273_437_780_001_04,
    -0.153_082_407_398_494_96,
];
/// Drifts and kicks in turn, whose sums vanish.
const PROCESSOR: [f64; 23] = [
    -0.046_340_073_573_558_01,
    0.136_123_924_201_075_33,
    -0.253_018_255_548_663_53,
    0.030_611_421_743_488_87,
    0.200_303_650_717_487_46,
    -0.136_895_499_999_401_26,
    -0.500_289_797_767_428_5,
    -0.002_266_089_781_788_570_7,
    0.662_783_433_180_958_8,
    -0.030_150_893_365_099_605,
    0.647_869_839_365_322_7,
    -0.266_695_625_828_194_34,
    -0.231_563_360_440_635_2,
    0.044_903_975_900_372_345,
    0.281_902_895_800_175_97,
    0.296_127_755_654_875_54,
    0.038_087_738_077_444_463,
    -0.518_805_824_634_815,
    -0.260_975_247_119_059_95,
    -0.015_137_497_707_134_623,
    0.250_993_465_475_074,
    0.462_184_353_816_621_3,
    -0.789_754_288_167_118_2,
];
