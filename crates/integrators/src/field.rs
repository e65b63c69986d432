//! What is integrated: a field ẏ = f(t, y), or a separable pair q̇ = u(t, p), ṗ = w(t, q).

use core::convert::Infallible;

use piola_numerics::Real;

use crate::IntegratorsError;

/// A first-order system ẏ = f(t, y) over any scalar.
///
/// Any `FnMut(f64, &[f64], &mut [f64])` with a dimension is one: see [`field`].
#[doc(alias("right-hand side", "ODE", "vector field"))]
pub trait Field<T: Real = f64> {
    /// Why an evaluation can fail; [`Infallible`] when it cannot.
    type Error;
    /// The number of components of y where it is the same for every value of this type. Methods then unroll their loops.
    ///
    /// A run refuses a value that differs from [`dimension`](Self::dimension).
    const DIMENSION: Option<usize> = None;
    /// The number of components of y.
    fn dimension(&self) -> usize;
    /// Writes f(t, y) to `rate`. Both slices have the length of [`dimension`](Self::dimension).
    ///
    /// # Errors
    /// Whatever makes the field undefined at (t, y).
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), Self::Error>;
    /// Whether y = (q, v) with q̇ = v, in two halves: methods may then save evaluations. The default is no.
    fn is_second_order(&self) -> bool {
        false
    }
    /// Brings the end of an accepted step back to where the field lives, as onto the constraints of a mechanism.
    ///
    /// [`DormandPrince853`](crate::DormandPrince853) calls it before it takes the rate at the end of the step, so
    /// that a projection costs no evaluation of the field; a step whose end cannot be projected is tried again
    /// shorter. The correction must be of the size of the error of the step. The default changes nothing, and so
    /// do the other methods.
    ///
    /// # Errors
    /// Whatever keeps the state from being projected.
    ///
    /// # Example
    /// ```
    /// use piola_integrators::{DormandPrince853, Field, State, Tolerance};
    /// struct Turning; // on the unit circle
    /// impl Field for Turning {
    ///     type Error = core::convert::Infallible;
    ///     fn dimension(&self) -> usize {
    ///         2
    ///     }
    ///     fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Self::Error> {
    ///         rate.copy_from_slice(&[-y[1], y[0]]);
    ///         Ok(())
    ///     }
    ///     fn project(&mut self, _t: f64, y: &mut [f64]) -> Result<(), Self::Error> {
    ///         let length = y[0].hypot(y[1]);
    ///         y.iter_mut().for_each(|y| *y /= length);
    ///         Ok(())
    ///     }
    /// }
    /// let mut state = State::new(0.0, vec![1.0, 0.0])?;
    /// DormandPrince853::new(Tolerance::relative(1e-3)?).integrate_to(&mut Turning, &mut state, 100.0)?;
    /// assert!((state.values[0].hypot(state.values[1]) - 1.0).abs() < 1e-15);
    /// # Ok::<(), piola_integrators::IntegratorsError>(())
    /// ```
    fn project(&mut self, _t: f64, _y: &mut [T]) -> Result<(), Self::Error> {
        Ok(())
    }
    /// Writes the magnitude against which the error of each component is relative.
    ///
    /// The default is each component's own block: y is a block of positions and a block of velocities of
    /// equal length if the dimension is even, and the magnitude is the largest |y| of the block. Fields
    /// whose components have natural groups (the three coordinates of one body) override it. Over lanes the
    /// magnitude is that of the largest lane.
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        magnitudes_of_blocks(y, magnitudes);
    }
}

/// Refuses a field whose dimension differs from the one its type states.
pub(crate) fn check_field<T: Real, F: Field<T>>(field: &F) -> Result<(), IntegratorsError<F::Error>> {
    let found = field.dimension();
    match F::DIMENSION {
        Some(expected) if expected != found => {
            Err(IntegratorsError::WrongLength { quantity: "field", expected, found })
        }
        _ => Ok(()),
    }
}

/// Directions in which a field is differentiated at once.
pub const DIRECTIONS: usize = 4;

/// The largest |y| of each block: positions and velocities where the dimension is even.
pub fn magnitudes_of_blocks<T: Real>(y: &[T], magnitudes: &mut [f64]) {
    let blocks = if y.len().is_multiple_of(2) { 2 } else { 1 };
    let length = (y.len() / blocks).max(1);
    for (block, magnitudes) in y.chunks(length).zip(magnitudes.chunks_mut(length)) {
        magnitudes.fill(block.iter().map(|&x| largest_lane(x)).fold(0.0, f64::max));
    }
}

/// The largest |value| among the lanes of one scalar; NaN when one of them is NaN, so that no lane hides it.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn largest_lane<T: Real>(x: T) -> f64 {
    let mut largest = x.primal(0).abs();
    for lane in 1..T::LANES {
        let value = x.primal(lane).abs();
        largest = if value <= largest || largest.is_nan() { largest } else { value };
    }
    largest
}

/// A separable system: q̇ depends on t and p alone, ṗ on t and q alone.
///
/// ```text
/// q̇ = ∂T/∂p (t, p)        ṗ = −∂V/∂q (t, q)
/// ```
///
/// These are the systems that explicit symplectic methods integrate. The state is y = (q, p).
pub trait Separable<T: Real = f64> {
    /// Why an evaluation can fail; [`Infallible`] when it cannot.
    type Error;
    /// The number of positions n; the state has 2n components.
    fn freedom(&self) -> usize;
    /// Writes q̇ = ∂T/∂p to `velocity`. The default is q̇ = p: momenta per unit mass.
    ///
    /// It is asked for at the ends of the substeps, forces in their middles, so that fields that depend on
    /// time keep the order of the method.
    ///
    /// # Errors
    /// Whatever makes the velocity undefined.
    fn velocity(&mut self, _t: f64, momentum: &[T], velocity: &mut [T]) -> Result<(), Self::Error> {
        velocity.copy_from_slice(momentum);
        Ok(())
    }
    /// Writes ṗ = −∂V/∂q to `force`.
    ///
    /// # Errors
    /// Whatever makes the force undefined.
    fn force(&mut self, t: f64, position: &[T], force: &mut [T]) -> Result<(), Self::Error>;
}

/// A function with a dimension: see [`field`].
#[derive(Clone, Copy, Debug)]
pub struct FunctionField<F> {
    dimension: usize,
    second_order: bool,
    componentwise: bool,
    function: F,
}

impl<F> FunctionField<F> {
    /// Declares that y = (q, v) and that the function writes q̇ = v: implicit methods then need about half as
    /// many evaluations.
    #[must_use]
    pub fn of_second_order(mut self) -> Self {
        self.second_order = true;
        self
    }

    /// Makes the error of each component relative to its own size, as reactions with concentrations of very different
    /// sizes need it. A component that passes through zero then needs an absolute tolerance.
    #[must_use]
    pub fn componentwise(mut self) -> Self {
        self.componentwise = true;
        self
    }
}

/// Makes a field of a function f(t, y, rate).
pub fn field<F: FnMut(f64, &[T], &mut [T]), T: Real>(dimension: usize, function: F) -> FunctionField<F> {
    FunctionField { dimension, second_order: false, componentwise: false, function }
}

impl<T: Real, F: FnMut(f64, &[T], &mut [T])> Field<T> for FunctionField<F> {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        self.dimension
    }
    fn is_second_order(&self) -> bool {
        self.second_order
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        (self.function)(t, y, rate);
        Ok(())
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        if self.componentwise {
            for (magnitude, &y) in magnitudes.iter_mut().zip(y) {
                *magnitude = largest_lane(y);
            }
        } else {
            magnitudes_of_blocks(y, magnitudes);
        }
    }
}

/// A function of arrays: see [`sized_field`].
#[derive(Clone, Copy, Debug)]
pub struct SizedField<F, const N: usize>(F);

/// Makes a field of a function f(t, y, rate) of arrays. The compiler then knows the size of the state, and a step of a small
/// system takes less time.
///
/// # Example
/// ```
/// use piola_integrators::{DormandPrince853, State, Tolerance, sized_field};
/// let mut oscillator = sized_field(|_t, y: &[f64; 2], rate: &mut [f64; 2]| *rate = [y[1], -y[0]]);
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// DormandPrince853::new(Tolerance::relative(1e-13)?).integrate_to(&mut oscillator, &mut state, 10.0)?;
/// assert!((state.values[0] - 10.0_f64.cos()).abs() < 1e-12);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
pub fn sized_field<F: FnMut(f64, &[T; N], &mut [T; N]), T: Real, const N: usize>(function: F) -> SizedField<F, N> {
    SizedField(function)
}

impl<T: Real, F: FnMut(f64, &[T; N], &mut [T; N]), const N: usize> Field<T> for SizedField<F, N> {
    type Error = Infallible;
    const DIMENSION: Option<usize> = Some(N);
    fn dimension(&self) -> usize {
        N
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        // Methods give slices of this length alone.
        if let (Some(y), Some(rate)) = (y.first_chunk(), rate.first_chunk_mut()) {
            (self.0)(t, y, rate);
        }
        Ok(())
    }
}

/// Makes a separable system of n degrees of freedom with q̇ = p and ṗ = f(t, q).
pub fn separable<F: FnMut(f64, &[T], &mut [T]), T: Real>(freedom: usize, force: F) -> FunctionField<F> {
    FunctionField { dimension: freedom, second_order: false, componentwise: false, function: force }
}

impl<T: Real, F: FnMut(f64, &[T], &mut [T])> Separable<T> for FunctionField<F> {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        self.dimension
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force(&mut self, t: f64, position: &[T], force: &mut [T]) -> Result<(), Infallible> {
        (self.function)(t, position, force);
        Ok(())
    }
}
