//! Many points of one law in lanes, one implicit step an increment.
//!
//! The equations of a step, and what follows from their solution, are computed in lanes with three derivatives at a time. With all
//! derivatives at once, and both in one kernel, they would take many minutes to compile.

#![expect(
    clippy::needless_range_loop,
    reason = "indices of rows and columns of several arrays; iterators are not inlined into lanes"
)]

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Gradient, LaneKernel, Lanes, Real as _, dispatch_lanes};
use piola_tensor::FourthOrder;
use piola_tensor::internal::rows::Rows;

use crate::newton::{NEARLY, ROUNDING, size};
use crate::path::Effort;
use crate::points::{check_arrays, write_point};
use crate::{Advanced, Evolution, InelasticError, InelasticPoint, StepControl};

/// As [`advance_components`](crate::advance_components) of one law with [`StepControl::one_step`], in lanes.
///
/// Newton's method runs for several points at once, until all of them have converged. Points that do not flow, and those for which it does
/// not converge, are advanced alone. The numbers of a point do not depend on those beside it.
///
/// # Errors
/// Those of [`advance_components`](crate::advance_components).
///
/// # Accuracy
/// The numbers of [`advance_components`](crate::advance_components) to the condition of one step: both solve its equations to rounding.
///
/// # Example
/// A thousand points, held for a second after a fast shear.
/// ```
/// use piola_continuum::stress::tangents::FirstPiolaTangent;
/// use piola_continuum::{DeformationGradient, FirstPiola};
/// use piola_inelastic::{Evolution, ReeseGovindjee, advance_in_lanes};
/// use piola_solids::NeoHookeanCiarlet;
/// use piola_tensor::FourthOrder;
/// let spring = NeoHookeanCiarlet::with_constants(1.0, 2.0)?;
/// let law = ReeseGovindjee::new(spring, spring, 1e-3)?;
/// let mut arrays: Vec<Vec<f64>> = law.initial().iter().map(|value| vec![*value; 1000]).collect();
/// let mut states: Vec<&mut [f64]> = arrays.iter_mut().map(Vec::as_mut_slice).collect();
/// let states: &mut [&mut [f64]; 9] = states.as_mut_slice().try_into()?;
/// let sheared = vec![DeformationGradient::simple_shear(0.3)?; 1000];
/// let mut stresses = vec![FirstPiola::zero(); 1000];
/// let mut tangents = vec![FirstPiolaTangent(FourthOrder::zero()); 1000];
/// advance_in_lanes(&law, states, [&sheared, &sheared], 1.0, &mut stresses, &mut tangents)?;
/// assert!((stresses[999].0[(0, 1)] - 0.3_f64).abs() < 1e-3); // μ k: the second spring has flown
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn advance_in_lanes<L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    states: &mut [&mut [f64]; S],
    [from, to]: [&[DeformationGradient]; 2],
    dt: f64,
    stresses: &mut [FirstPiola],
    tangents: &mut [FirstPiolaTangent],
) -> Result<(), InelasticError> {
    check_arrays(states, [from, to], stresses.len(), tangents.len())?;
    crate::error::check_bound("increment", "dt", dt, "0 ≤ dt", 0.0 <= dt)?;
    let mut points = Points::<L, S, X> { law, states, from, to, dt, stresses, tangents, first: None };
    let count = from.len();
    for at in (0..count).step_by(BLOCK) {
        // The last block holds its last point several times.
        points.block(at, core::array::from_fn(|lane| (at + lane).min(count - 1)));
    }
    points.first.map_or(Ok(()), Err)
}

/// Points of a block, a multiple of the lanes of every processor that [`dispatch_lanes`] is asked for.
const BLOCK: usize = 4;

/// A number of each point of a block.
type Block = Lanes<f64, BLOCK>;

/// Derivatives that a kernel computes at a time.
const THREE: usize = 3;

/// Numbers of several points with three derivatives.
type Varied<const N: usize> = Gradient<Lanes<f64, N>, THREE>;

/// The points of a batch.
struct Points<'a, 'b, L, const S: usize, const X: usize> {
    law: &'a L,
    states: &'a mut [&'b mut [f64]; S],
    from: &'a [DeformationGradient],
    to: &'a [DeformationGradient],
    dt: f64,
    stresses: &'a mut [FirstPiola],
    tangents: &'a mut [FirstPiolaTangent],
    first: Option<InelasticError>,
}

impl<L: Evolution<S, X>, const S: usize, const X: usize> Points<'_, '_, L, S, X> {
    fn block(&mut self, at: usize, places: [usize; BLOCK]) {
        let zero = Block::splat(0.0);
        let (mut start, mut f) = ([zero; S], [[zero; 3]; 3]);
        // The others are advanced alone.
        let mut flows = [false; BLOCK];
        for (lane, &place) in places.iter().enumerate() {
            let rows = rows_of(self.to[place].matrix());
            let mut state = [0.0; S];
            for (k, value) in state.iter_mut().enumerate() {
                *value = self.states[k][place];
                start[k].0[lane] = *value;
            }
            for i in 0..3 {
                for j in 0..3 {
                    f[i][j].0[lane] = rows[i][j];
                }
            }
            flows[lane] = X == 0 || self.law.evolves(&state, &rows, self.dt);
        }
        let increment = Increment { law: self.law, start, f, dt: self.dt };
        let found = if flows.contains(&true) { increment.step::<X>(flows) } else { None };
        for (lane, &place) in places.iter().enumerate().take(self.from.len() - at) {
            let advanced = match &found {
                Some(found) if found.good[lane] => self.of_lane(found, lane, place),
                _ => self.alone(place),
            };
            if let Some(after) = write_point(place, advanced, self.stresses, self.tangents, &mut self.first) {
                for (value, all) in after.iter().zip(&mut *self.states) {
                    all[place] = *value;
                }
            }
        }
    }

    /// What the step of a lane has found.
    fn of_lane(&self, found: &Found<S>, lane: usize, place: usize) -> Result<Advanced<S>, InelasticError> {
        let Found { end, iterations, .. } = found;
        let state = end.state.map(|x| x.0[lane]);
        self.law.check(&rows_of(self.to[place].matrix()), &state)?;
        let mut first_piola = FirstPiola::zero();
        let mut components = [[0.0; 9]; 9];
        for row in 0..9 {
            first_piola.0[(row / 3, row % 3)] = end.stress[row].0[lane];
            for k in 0..9 {
                components[row][k] = end.tangent[k][row].0[lane];
            }
        }
        crate::error::check_finite("P", first_piola.0.as_slice())?;
        let tangent = FirstPiolaTangent(FourthOrder { components });
        let effort = Effort { parts: 1, steps: 1, iterations: *iterations, error: 0.0 };
        Ok(Advanced { state, first_piola, tangent, effort })
    }

    /// A point by itself.
    #[inline(never)]
    fn alone(&self, place: usize) -> Result<Advanced<S>, InelasticError> {
        let mut state = [0.0; S];
        for (value, all) in state.iter_mut().zip(&*self.states) {
            *value = all[place];
        }
        let mut point = InelasticPoint::with_state(self.law, &state, &self.from[place])?;
        point.advance(&self.to[place], self.dt, &StepControl::one_step())
    }
}

/// An increment of a block.
struct Increment<'a, L, const S: usize> {
    law: &'a L,
    start: [Block; S],
    f: Rows<Block>,
    dt: f64,
}

/// What a step has found.
struct Found<const S: usize> {
    end: End<S>,
    iterations: usize,
    /// Where the equations are solved.
    good: [bool; BLOCK],
}

/// The largest modulus of the numbers of each point; NaN where one is.
fn sizes<const X: usize>(values: &[Block; X]) -> [f64; BLOCK] {
    core::array::from_fn(|lane| size(&values.map(|block| block.0[lane])))
}

impl<L, const S: usize> Increment<'_, L, S> {
    /// One implicit step of several points; none where an iteration leads nowhere.
    fn step<const X: usize>(&self, flows: [bool; BLOCK]) -> Option<Found<S>>
    where
        L: Evolution<S, X>,
    {
        /// Iterations after which the points are tried alone, with steps that are shortened where they must be.
        const MOST_ITERATIONS: usize = 12;
        let zero = [Block::splat(0.0); X];
        let (mut unknowns, mut residual) = (zero, zero);
        let (mut iterations, mut moved) = (0, [1.0; BLOCK]);
        let (rest, matrix) = loop {
            let mut columns = [zero; X];
            self.differentiate(By::Unknowns, &unknowns, &mut residual, &mut columns);
            let matrix = Decomposed::of(&columns);
            // A point that has converged stays where it is, so that its numbers do not depend on those beside it.
            let rest = sizes(&residual);
            let is_done =
                |lane: usize| !flows[lane] || rest[lane] <= ROUNDING || (rest[lane] <= NEARLY && moved[lane] <= NEARLY);
            let done: [bool; BLOCK] = core::array::from_fn(is_done);
            if X == 0 || iterations == MOST_ITERATIONS || !done.contains(&false) {
                break (rest, matrix);
            }
            iterations += 1;
            let change = matrix.solve(residual);
            let changes = sizes(&change);
            for lane in (0..BLOCK).filter(|lane| !done[*lane]) {
                for (unknown, change) in unknowns.iter_mut().zip(&change) {
                    unknown.0[lane] -= change.0[lane];
                }
                moved[lane] = changes[lane];
            }
        };
        let mut good: [bool; BLOCK] = core::array::from_fn(|lane| flows[lane] && rest[lane] <= NEARLY);
        if !good.contains(&true) {
            return None;
        }
        // x̂ = x − (∂r/∂x)⁻¹ r(z, F̂, x): derivatives of the unknowns by F, and in their value one more iteration.
        let mut columns = [zero; 9];
        if X != 0 {
            self.differentiate(By::Gradient, &unknowns, &mut residual, &mut columns);
            let correction = matrix.solve(residual);
            for k in 0..X {
                unknowns[k] -= correction[k];
            }
            for column in &mut columns {
                *column = matrix.solve(*column).map(|rate| -rate);
            }
        }
        let zero = Block::splat(0.0);
        let mut end = End { state: [zero; S], stress: [zero; 9], tangent: [[zero; 9]; 9] };
        dispatch_lanes::<_, 2, 4, 4>(Finish { increment: self, unknowns: &unknowns, columns: &columns, end: &mut end });
        for (lane, good) in good.iter_mut().enumerate() {
            *good &= end.state.iter().all(|value| value.0[lane].is_finite());
        }
        Some(Found { end, iterations, good })
    }

    /// The residual at the unknowns and its derivatives, a column for each direction.
    fn differentiate<const X: usize>(
        &self,
        by: By,
        unknowns: &[Block; X],
        residual: &mut [Block; X],
        columns: &mut [[Block; X]],
    ) where
        L: Evolution<S, X>,
    {
        dispatch_lanes::<_, 2, 4, 4>(Equations { increment: self, by, unknowns, residual, columns });
    }

    /// State at the start and F as constants.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn constants<const N: usize>(&self, first: usize) -> ([Varied<N>; S], Rows<Varied<N>>) {
        let zero = Gradient::constant(Lanes::splat(0.0));
        let (mut from, mut gradient) = ([zero; S], [[zero; 3]; 3]);
        for k in 0..S {
            from[k] = Gradient::constant(load(&self.start[k], first));
        }
        for i in 0..3 {
            for j in 0..3 {
                gradient[i][j] = Gradient::constant(load(&self.f[i][j], first));
            }
        }
        (from, gradient)
    }
}

/// The numbers of so many points from one on.
#[cfg_attr(not(debug_assertions), inline(always))]
fn load<const N: usize>(block: &Block, first: usize) -> Lanes<f64, N> {
    let mut lanes = Lanes::splat(0.0);
    for lane in 0..N {
        lanes.0[lane] = block.0[first + lane];
    }
    lanes
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn store<const N: usize>(lanes: Lanes<f64, N>, block: &mut Block, first: usize) {
    for lane in 0..N {
        block.0[first + lane] = lanes.0[lane];
    }
}

/// The matrix of Newton's method, decomposed without pivots: what it cannot solve is solved alone.
struct Decomposed<const X: usize>([[Block; X]; X]);

impl<const X: usize> Decomposed<X> {
    fn of(columns: &[[Block; X]; X]) -> Self {
        let mut m: [[Block; X]; X] = core::array::from_fn(|i| columns.map(|column| column[i]));
        for k in 0..X {
            m[k][k] = m[k][k].recip();
            for i in k + 1..X {
                let factor = m[i][k] * m[k][k];
                m[i][k] = factor;
                for j in k + 1..X {
                    let change = factor * m[k][j];
                    m[i][j] -= change;
                }
            }
        }
        Self(m)
    }

    fn solve(&self, mut right: [Block; X]) -> [Block; X] {
        for i in 1..X {
            for k in 0..i {
                let change = self.0[i][k] * right[k];
                right[i] -= change;
            }
        }
        for i in (0..X).rev() {
            for k in i + 1..X {
                let change = self.0[i][k] * right[k];
                right[i] -= change;
            }
            right[i] *= self.0[i][i];
        }
        right
    }
}

/// What the derivatives of the equations are by.
#[derive(Clone, Copy)]
enum By {
    Unknowns,
    Gradient,
}

/// The residual at the unknowns with its derivatives.
struct Equations<'a, L, const S: usize, const X: usize> {
    increment: &'a Increment<'a, L, S>,
    by: By,
    unknowns: &'a [Block; X],
    residual: &'a mut [Block; X],
    columns: &'a mut [[Block; X]],
}

impl<L: Evolution<S, X>, const S: usize, const X: usize> LaneKernel for Equations<'_, L, S, X> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) {
        let Self { increment, by, unknowns, residual, columns } = self;
        let mut first = 0;
        while first < BLOCK {
            let mut done = 0;
            while done < columns.len() || done == 0 {
                let (from, mut gradient) = increment.constants::<N>(first);
                let mut x = [Varied::<N>::constant(Lanes::splat(0.0)); X];
                for k in 0..X {
                    x[k] = Gradient::constant(load(&unknowns[k], first));
                }
                for (direction, k) in (done..columns.len().min(done + THREE)).enumerate() {
                    let varied = match by {
                        By::Unknowns => &mut x[k],
                        By::Gradient => &mut gradient[k / 3][k % 3],
                    };
                    varied.partials[direction] = Lanes::splat(1.0);
                }
                let found = increment.law.residual(&from, &gradient, &x, increment.dt);
                for i in 0..X {
                    store(found[i].value, &mut residual[i], first);
                }
                for (direction, k) in (done..columns.len().min(done + THREE)).enumerate() {
                    for i in 0..X {
                        store(found[i].partials[direction], &mut columns[k][i], first);
                    }
                }
                done += THREE;
            }
            first += N;
        }
    }
}

/// State, stress and ∂P/∂F at the end of a step; of the last a column for each entry of F.
struct End<const S: usize> {
    state: [Block; S],
    stress: [Block; 9],
    tangent: [[Block; 9]; 9],
}

/// State and stress at the unknowns, whose derivatives by F are the columns.
struct Finish<'a, L, const S: usize, const X: usize> {
    increment: &'a Increment<'a, L, S>,
    unknowns: &'a [Block; X],
    columns: &'a [[Block; X]; 9],
    end: &'a mut End<S>,
}

impl<L: Evolution<S, X>, const S: usize, const X: usize> LaneKernel for Finish<'_, L, S, X> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) {
        let Self { increment, unknowns, columns, end } = self;
        let mut first = 0;
        while first < BLOCK {
            let mut done = 0;
            while done < 9 {
                let (from, mut gradient) = increment.constants::<N>(first);
                let mut x = [Varied::<N>::constant(Lanes::splat(0.0)); X];
                for k in 0..X {
                    x[k] = Gradient::constant(load(&unknowns[k], first));
                    for direction in 0..THREE {
                        x[k].partials[direction] = load(&columns[done + direction][k], first);
                    }
                }
                for direction in 0..THREE {
                    gradient[done / 3][direction].partials[direction] = Lanes::splat(1.0);
                }
                let state = increment.law.updated(&from, &gradient, &x, increment.dt);
                let stress = increment.law.first_piola(&gradient, &state);
                for k in 0..S {
                    store(state[k].value, &mut end.state[k], first);
                }
                for row in 0..9 {
                    let stress = &stress[row / 3][row % 3];
                    store(stress.value, &mut end.stress[row], first);
                    for direction in 0..THREE {
                        store(stress.partials[direction], &mut end.tangent[done + direction][row], first);
                    }
                }
                done += THREE;
            }
            first += N;
        }
    }
}
