//! Many points of one law in lanes, one implicit step an increment.

#![expect(
    clippy::needless_range_loop,
    reason = "indices of rows and columns of several arrays; iterators are not inlined into lanes"
)]

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Gradient, LaneKernel, Lanes, Mask, Real, dispatch_lanes};
use piola_tensor::FourthOrder;
use piola_tensor::internal::rows::Rows;

use crate::newton::{NEARLY, ROUNDING};
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
    dispatch_lanes::<_, 2, 4, 4>(Points::<L, S, X> { law, states, from, to, dt, stresses, tangents, first: None })
}

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

impl<L: Evolution<S, X>, const S: usize, const X: usize> LaneKernel for Points<'_, '_, L, S, X> {
    type Output = Result<(), InelasticError>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(mut self) -> Self::Output {
        let count = self.from.len();
        let mut at = 0;
        while at < count {
            // The last block holds its last point several times.
            let places: [usize; N] = core::array::from_fn(|lane| (at + lane).min(count - 1));
            self.block(at, places);
            at += N;
        }
        self.first.map_or(Ok(()), Err)
    }
}

impl<L: Evolution<S, X>, const S: usize, const X: usize> Points<'_, '_, L, S, X> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn block<const N: usize>(&mut self, at: usize, places: [usize; N]) {
        let mut start = [Lanes::<f64, N>::splat(0.0); S];
        let mut f = [[Lanes::<f64, N>::splat(0.0); 3]; 3];
        // 1 where the point flows, 0 where it is advanced alone.
        let mut flows = Lanes::<f64, N>::splat(0.0);
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
            flows.0[lane] = f64::from(u8::from(X == 0 || self.law.evolves(&state, &rows, self.dt)));
        }
        let flows = Lanes::splat(0.0).less_than(flows);
        let found = if flows.any() { step::<L, N, S, X>(self.law, &start, &f, self.dt, flows) } else { None };
        for (lane, &place) in places.iter().enumerate().take(self.from.len() - at) {
            let advanced = match &found {
                Some(found) if found.good.lane(lane) => self.of_lane(found, lane, place),
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
    fn of_lane<const N: usize>(
        &self,
        found: &Step<N, S>,
        lane: usize,
        place: usize,
    ) -> Result<Advanced<S>, InelasticError> {
        let state = found.state.map(|x| x.value.0[lane]);
        self.law.check(&rows_of(self.to[place].matrix()), &state)?;
        let mut first_piola = FirstPiola::zero();
        let mut components = [[0.0; 9]; 9];
        for (row, entries) in components.iter_mut().enumerate() {
            let stress = &found.stress[row / 3][row % 3];
            first_piola.0[(row / 3, row % 3)] = stress.value.0[lane];
            for (entry, partial) in entries.iter_mut().zip(&stress.partials) {
                *entry = partial.0[lane];
            }
        }
        crate::error::check_finite("P", first_piola.0.as_slice())?;
        let tangent = FirstPiolaTangent(FourthOrder { components });
        let effort = Effort { parts: 1, steps: 1, iterations: found.iterations, error: 0.0 };
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

/// Numbers of several points with their derivatives by the nine entries of F.
type Varied<const N: usize> = Gradient<Lanes<f64, N>, 9>;

/// State and stress at the end of a step.
struct Step<const N: usize, const S: usize> {
    state: [Varied<N>; S],
    stress: Rows<Varied<N>>,
    iterations: usize,
    /// Where the equations are solved.
    good: <Lanes<f64, N> as Real>::Mask,
}

/// The largest modulus in each lane; NaN where one is.
#[cfg_attr(not(debug_assertions), inline(always))]
fn size<const N: usize, const X: usize>(values: &[Lanes<f64, N>; X]) -> Lanes<f64, N> {
    let mut size = Lanes::splat(0.0);
    let mut k = 0;
    while k < X {
        let modulus = values[k].abs();
        size = Lanes::select(modulus.at_most(size), size, modulus);
        k += 1;
    }
    size
}

/// The matrix of Newton's method, decomposed without pivots: what it cannot solve is solved alone.
struct Decomposed<const N: usize, const X: usize>([[Lanes<f64, N>; X]; X]);

impl<const N: usize, const X: usize> Decomposed<N, X> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(mut m: [[Lanes<f64, N>; X]; X]) -> Self {
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

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn solve(&self, mut right: [Lanes<f64, N>; X]) -> [Lanes<f64, N>; X] {
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

/// The residual and the decomposed matrix of its derivatives by the unknowns.
#[cfg_attr(not(debug_assertions), inline(always))]
fn linearised<L: Evolution<S, X>, const N: usize, const S: usize, const X: usize>(
    law: &L,
    start: &[Lanes<f64, N>; S],
    f: &Rows<Lanes<f64, N>>,
    unknowns: &[Lanes<f64, N>; X],
    dt: f64,
) -> ([Lanes<f64, N>; X], Decomposed<N, X>) {
    let mut from = [Gradient::<Lanes<f64, N>, X>::constant(Lanes::splat(0.0)); S];
    for k in 0..S {
        from[k] = Gradient::constant(start[k]);
    }
    let mut gradient = [[Gradient::<Lanes<f64, N>, X>::constant(Lanes::splat(0.0)); 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            gradient[i][j] = Gradient::constant(f[i][j]);
        }
    }
    let mut x = [Gradient::<Lanes<f64, N>, X>::constant(Lanes::splat(0.0)); X];
    for k in 0..X {
        x[k] = Gradient::variable(unknowns[k], k);
    }
    let residual = law.residual(&from, &gradient, &x, dt);
    let (mut values, mut matrix) = ([Lanes::splat(0.0); X], [[Lanes::splat(0.0); X]; X]);
    for k in 0..X {
        values[k] = residual[k].value;
        matrix[k] = residual[k].partials;
    }
    (values, Decomposed::of(matrix))
}

/// One implicit step of several points; none where an iteration leads nowhere.
#[cfg_attr(not(debug_assertions), inline(always))]
fn step<L: Evolution<S, X>, const N: usize, const S: usize, const X: usize>(
    law: &L,
    start: &[Lanes<f64, N>; S],
    f: &Rows<Lanes<f64, N>>,
    dt: f64,
    flows: <Lanes<f64, N> as Real>::Mask,
) -> Option<Step<N, S>> {
    /// Iterations after which the points are tried alone, with steps that are shortened where they must be.
    const MOST_ITERATIONS: usize = 12;
    let (rounding, nearly) = (Lanes::splat(ROUNDING), Lanes::splat(NEARLY));
    let mut unknowns = [Lanes::<f64, N>::splat(0.0); X];
    let (mut residual, mut matrix) = linearised(law, start, f, &unknowns, dt);
    let (mut iterations, mut moved) = (0, Lanes::splat(1.0));
    while X != 0 && iterations < MOST_ITERATIONS {
        // A point that has converged stays where it is, so that its numbers do not depend on those beside it.
        let rest = size(&residual);
        let done = !flows | rest.at_most(rounding) | (rest.at_most(nearly) & moved.at_most(nearly));
        if done.all() {
            break;
        }
        iterations += 1;
        let change = matrix.solve(residual);
        for k in 0..X {
            unknowns[k] = Lanes::select(done, unknowns[k], unknowns[k] - change[k]);
        }
        moved = Lanes::select(done, moved, size(&change));
        (residual, matrix) = linearised(law, start, f, &unknowns, dt);
    }
    let mut good = flows & size(&residual).at_most(nearly);
    if !good.any() {
        return None;
    }
    // x̂ = x − (∂r/∂x)⁻¹ r(z, F̂, x): derivatives of the unknowns, and in their value one more iteration.
    let mut from = [Varied::<N>::constant(Lanes::splat(0.0)); S];
    for k in 0..S {
        from[k] = Gradient::constant(start[k]);
    }
    let mut gradient = [[Varied::<N>::constant(Lanes::splat(0.0)); 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            gradient[i][j] = Gradient::variable(f[i][j], 3 * i + j);
        }
    }
    let mut exact = [Varied::<N>::constant(Lanes::splat(0.0)); X];
    for k in 0..X {
        exact[k] = Gradient::constant(unknowns[k]);
    }
    if X != 0 {
        let varied = law.residual(&from, &gradient, &exact, dt);
        let mut right = [Lanes::splat(0.0); X];
        for k in 0..X {
            right[k] = varied[k].value;
        }
        let correction = matrix.solve(right);
        for k in 0..X {
            exact[k].value -= correction[k];
        }
        for direction in 0..9 {
            for k in 0..X {
                right[k] = varied[k].partials[direction];
            }
            let rate = matrix.solve(right);
            for k in 0..X {
                exact[k].partials[direction] = -rate[k];
            }
        }
    }
    let state = law.updated(&from, &gradient, &exact, dt);
    for value in &state {
        good = good & value.value.is_finite();
    }
    let stress = law.first_piola(&gradient, &state);
    Some(Step { state, stress, iterations, good })
}
