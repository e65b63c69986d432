//! The steps of methods whose stages are solved for as one system of equations.

use core::marker::PhantomData;
use core::ops::ControlFlow;

use piola_integrators::internal::{check_run, check_sums, compensated_add};
use piola_integrators::{Checkpoint, Field, IntegratorsError, Report, State, Step};
use piola_numerics::{Gradient, Real};

use super::equations::{Jacobians, PairStep, Workspace};
use super::tableau::PairTableau;
use crate::fixed_step::take_equal_steps;
use crate::kept::{Kept, Visitor};
use crate::newton::Newton;

/// A tableau, and the memory of its steps.
#[derive(Clone, Debug)]
pub(super) struct PairStepper<T> {
    tableau: PairTableau,
    newton: Newton<T>,
    increments: Vec<T>,
    work: Workspace<T>,
}

impl<T: Real> Kept<T> for PairStepper<T> {
    fn visit<V: Visitor<T>>(&mut self, visitor: &mut V) {
        visitor.values(&mut self.increments);
        self.newton.visit(visitor);
    }
}

impl<T: Real> PairStepper<T> {
    pub(super) const fn new(tableau: &PairTableau) -> Self {
        let work = Workspace {
            stage: Vec::new(),
            rate: Vec::new(),
            seeds: Vec::new(),
            rate_of_seeds: Vec::new(),
            jacobian: Vec::new(),
        };
        Self { tableau: *tableau, newton: Newton::new(), increments: Vec::new(), work }
    }

    /// Takes equal steps no longer than `step` to `end` for the `method`; a run that is resumed goes on from its checkpoint.
    pub(super) fn run<F: Field<T>, K: Jacobians<F, T>>(
        &mut self,
        (method, resumed, step): (&'static str, Option<&Checkpoint<T>>, f64),
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        let n = field.dimension();
        let size = n * self.tableau.stages;
        self.newton.begin(size, !K::NONE);
        self.increments.clear();
        self.increments.resize(size, T::zero());
        self.work.resize(n, !K::NONE);
        let before = self.start(method, resumed, state, |state| check_run(n, state, end))?;
        let Self { tableau, newton, increments, work } = self;
        take_equal_steps((before, step), state, end, observer, |state, h| {
            // The weights sum to the step exactly.
            let mut weights = tableau.weights.map(|b| h * b);
            let middle = tableau.stages / 2;
            let others: f64 = weights.iter().sum::<f64>() - weights[middle];
            weights[middle] = h - others;
            let (values, carry, t) = (&state.values, &state.carry, state.time);
            let (weights, kind) = (&weights, PhantomData::<K>);
            let mut step = PairStep { field, tableau, weights, work, values, carry, t, h, evaluations: 0, kind };
            newton.solve(&mut step, increments, (t, h))?;
            let evaluations = step.evaluations;
            let total = &mut work.rate;
            for (k, total) in total.iter_mut().enumerate() {
                *total = T::zero();
                for stage in increments.chunks(n.max(1)) {
                    *total += stage[k];
                }
            }
            check_sums(t, &state.values, total)?;
            for ((y, carry), &increment) in state.values.iter_mut().zip(&mut state.carry).zip(&*total) {
                compensated_add(y, carry, increment);
            }
            Ok(evaluations)
        })
    }
}

impl<T: Real> Workspace<T> {
    fn resize(&mut self, n: usize, with_jacobian: bool) {
        self.stage.resize(n, T::zero());
        self.rate.resize(n, T::zero());
        if with_jacobian {
            self.seeds.resize(n, Gradient::constant(T::zero()));
            self.rate_of_seeds.resize(n, Gradient::constant(T::zero()));
            self.jacobian.resize(n * n, T::zero());
        }
    }
}
