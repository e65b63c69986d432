//! Integration on Lie groups: rotations stay rotations, whatever the step and the number of steps.
//!
//! The state is an element g of a group. The field gives its velocity ξ in the algebra of the group, in the frame of the
//! body (trivialised from the left):
//!
//! ```text
//! ġ = g ξ(t, g)         rotations: q̇ = ½ q (0, ω_body)         rigid motions: ξ = (ω_body, v_body)
//! ```
//!
//! A step multiplies by exponentials, g ← g exp θ, and so never leaves the group. The displacement θ in the algebra obeys
//!
//! ```text
//! θ̇ = dexp⁻¹_{−θ} ξ = ξ + ½ [θ, ξ] + ¹⁄₁₂ [θ, [θ, ξ]] − …
//! ```
//!
//! | group | type | element | algebra |
//! |---|---|---|---|
//! | rotations SO(3) | [`Rotations`] | unit quaternion (w, x, y, z), Hamilton, body → space | ω in body components, rad/s |
//! | rigid motions SE(3) | [`RigidMotions`] | quaternion, then position in space, m | (ω, v) in body components |
//! | vectors ℝⁿ | [`Translations`] | n numbers | their rates |
//! | two groups | [`DirectProduct`] | one after the other | one after the other |
//! | many of one group | [`DirectPower`] | one after the other | one after the other |
//!
//! # Which method?
//! [`AdaptiveMuntheKaas`], order 8(5,3), for smooth fields; [`MuntheKaas`] of orders 2, 4, 6, 8 with a fixed step.
//! [`CommutatorFree`], order 4, for a group of your own of which only the exponential is known. [`GeneralisedAlpha`], implicit and of order 2, for stiff mechanical systems whose fast vibrations
//! should be damped.
//!
//! # References
//! A. Iserles, H. Munthe-Kaas, S. P. Nørsett & A. Zanna, *Lie-group methods*, Acta Numerica 9 (2000) 215; E. Hairer,
//! C. Lubich & G. Wanner, *Geometric Numerical Integration*, IV.8.

mod adaptive;
mod commutator_free;
mod generalised_alpha;
mod munthe_kaas;
mod products;
mod rigid_motions;
mod rotations;
mod run;
mod tableaux;

use core::convert::Infallible;

use piola_numerics::Real;

pub use self::adaptive::AdaptiveMuntheKaas;
pub use self::commutator_free::CommutatorFree;
pub use self::generalised_alpha::{GeneralisedAlpha, GroupMotion};
pub use self::munthe_kaas::MuntheKaas;
pub use self::products::{DirectPower, DirectProduct, Translations};
pub use self::rigid_motions::RigidMotions;
pub use self::rotations::Rotations;

/// A Lie group whose elements and whose algebra are numbers in slices.
///
/// An element is held with a carry: what rounding has cut off its numbers so far. With it, a million small steps have no more
/// rounding error than one. The slices have the lengths [`element_length`](Self::element_length) and [`dimension`](Self::dimension).
///
/// # Example
/// ```
/// use piola_geometric::{LieGroup, Rotations};
/// // A quarter turn about z, then one about the body's x.
/// let quarter = std::f64::consts::FRAC_PI_2;
/// let (mut q, mut carry) = ([1.0, 0.0, 0.0, 0.0], [0.0; 4]);
/// Rotations.advance(&mut q, &mut carry, &[0.0, 0.0, quarter]);
/// Rotations.advance(&mut q, &mut carry, &[quarter, 0.0, 0.0]);
/// assert!(q.iter().all(|x| (x - 0.5).abs() < 2.0 * f64::EPSILON));
/// ```
///
/// A group of your own: positive numbers with their product.
/// ```
/// use piola_geometric::{CommutatorFree, LieGroup, group_field};
/// use piola_integrators::State;
/// struct Positive;
/// impl LieGroup for Positive {
///     fn element_length(&self) -> usize {
///         1
///     }
///     fn dimension(&self) -> usize {
///         1
///     }
///     fn advance(&self, element: &mut [f64], _carry: &mut [f64], displacement: &[f64]) {
///         element[0] *= displacement[0].exp();
///     }
///     fn inverse_differential(&self, _displacement: &[f64], _velocity: &mut [f64]) {} // the product commutes
/// }
/// // ġ = g (1 − g): however long the step, g stays positive.
/// let mut logistic = group_field(Positive, |_t, g: &[f64], velocity: &mut [f64]| velocity[0] = 1.0 - g[0]);
/// let mut state = State::new(0.0, vec![0.5])?;
/// CommutatorFree::new(0.05)?.integrate_to(&mut logistic, &mut state, 1.0)?;
/// assert!((state.values[0] - 1.0 / (1.0 + (-1.0_f64).exp())).abs() < 1e-8);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("SO(3)", "SE(3)", "exponential map", "manifold"))]
pub trait LieGroup<T: Real = f64> {
    /// The number of numbers that hold an element.
    fn element_length(&self) -> usize;
    /// The dimension of the group and of its algebra.
    fn dimension(&self) -> usize;
    /// Moves the element by a displacement in its own frame: g ← g exp θ, summed with compensation into g + carry.
    fn advance(&self, element: &mut [T], carry: &mut [T], displacement: &[T]);
    /// Turns the velocity ξ into the rate of the displacement: ξ ← dexp⁻¹_{−θ} ξ.
    ///
    /// It inverts the derivative of the exponential, trivialised from the left: d/dt exp θ = (exp θ) dexp_{−θ} θ̇.
    /// [`MuntheKaas`] and [`AdaptiveMuntheKaas`] need it.
    #[doc(alias("dexpinv", "inverse right Jacobian"))]
    fn inverse_differential(&self, displacement: &[T], velocity: &mut [T]);
    /// Brings the element back to the group, from which rounding has moved it. The correction is as small as that rounding.
    ///
    /// Methods call it at the end of each step. The default, for groups whose elements are any numbers, does nothing.
    fn renormalise(&self, _element: &mut [T], _carry: &mut [T]) {}
    /// Writes the magnitude against which the error of each component of a displacement is relative. The default is one, as for
    /// angles. Only [`AdaptiveMuntheKaas`] needs it.
    fn magnitudes(&self, _element: &[T], magnitudes: &mut [f64]) {
        magnitudes.fill(1.0);
    }
    /// Tells whether these numbers are no element of the group, beyond what [`renormalise`](Self::renormalise) mends: the index of
    /// the first number of the part that is wrong, and its defect. A run refuses such a start. The default is `None`.
    fn defect(&self, _element: &[T]) -> Option<(usize, f64)> {
        None
    }
}

/// A field on a Lie group: ġ = g ξ(t, g), over any scalar.
///
/// # Example
/// A rigid body: its attitude and its angular momentum are one element of SO(3) × ℝ³.
/// ```
/// use core::convert::Infallible;
/// use piola_geometric::{DirectProduct, GroupField, MuntheKaas, Rotations, Translations};
/// use piola_integrators::{Order, State};
/// struct FreeTop {
///     group: DirectProduct<Rotations, Translations>,
///     inertia: [f64; 3],
/// }
/// impl GroupField for FreeTop {
///     type Error = Infallible;
///     type Group = DirectProduct<Rotations, Translations>;
///     fn group(&self) -> &Self::Group {
///         &self.group
///     }
///     fn velocity(&mut self, _t: f64, g: &[f64], velocity: &mut [f64]) -> Result<(), Infallible> {
///         let l = [g[4], g[5], g[6]]; // angular momentum in body components, after the quaternion
///         let omega: [f64; 3] = std::array::from_fn(|i| l[i] / self.inertia[i]);
///         velocity[..3].copy_from_slice(&omega);
///         velocity[3] = l[1] * omega[2] - l[2] * omega[1]; // l̇ = l × ω
///         velocity[4] = l[2] * omega[0] - l[0] * omega[2];
///         velocity[5] = l[0] * omega[1] - l[1] * omega[0];
///         Ok(())
///     }
/// }
/// let mut top = FreeTop { group: DirectProduct(Rotations, Translations(3)), inertia: [1.0, 2.0, 3.0] };
/// // About the third axis at 3/3 rad/s, half a turn: q = (0, 0, 0, 1).
/// let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.0])?;
/// MuntheKaas::new(Order::Four, 0.25)?.integrate_to(&mut top, &mut state, std::f64::consts::PI)?;
/// assert!(state.values[0].abs() < 1e-15 && (state.values[3] - 1.0).abs() < 1e-15);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
pub trait GroupField<T: Real = f64> {
    /// Why an evaluation can fail; [`Infallible`] when it cannot.
    type Error;
    /// The group.
    type Group: LieGroup<T>;
    /// The group.
    fn group(&self) -> &Self::Group;
    /// Writes ξ(t, g) = g⁻¹ ġ to `velocity`: the velocity in the frame of the body.
    ///
    /// # Errors
    /// Whatever makes the field undefined at (t, g).
    fn velocity(&mut self, t: f64, element: &[T], velocity: &mut [T]) -> Result<(), Self::Error>;
}

/// A function on a group: see [`group_field`].
#[derive(Clone, Copy, Debug)]
pub struct FunctionGroupField<G, F> {
    group: G,
    function: F,
}

/// Makes a field on a group of a function ξ(t, g, velocity).
///
/// # Example
/// ```
/// use piola_geometric::{CommutatorFree, Rotations, group_field};
/// use piola_integrators::State;
/// // About z at 2t rad/s: the angle is t².
/// let mut turning = group_field(Rotations, |t, _q: &[f64], omega: &mut [f64]| omega.copy_from_slice(&[0.0, 0.0, 2.0 * t]));
/// let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0])?;
/// CommutatorFree::new(0.1)?.integrate_to(&mut turning, &mut state, 1.0)?;
/// assert!((state.values[3] - 0.5_f64.sin()).abs() < 1e-15); // sin of half the angle
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
pub fn group_field<G, F: FnMut(f64, &[T], &mut [T]), T: Real>(group: G, function: F) -> FunctionGroupField<G, F> {
    FunctionGroupField { group, function }
}

impl<T: Real, G: LieGroup<T>, F: FnMut(f64, &[T], &mut [T])> GroupField<T> for FunctionGroupField<G, F> {
    type Error = Infallible;
    type Group = G;
    fn group(&self) -> &G {
        &self.group
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity(&mut self, t: f64, element: &[T], velocity: &mut [T]) -> Result<(), Infallible> {
        (self.function)(t, element, velocity);
        Ok(())
    }
}
