//! Relative deformations, tensors of accelerations, exponentials, and tensors turned by a rotation of each point.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{determinant, from_rows, inverse_and_determinant};

use super::kinematic::flat;
use super::parts::part;
use super::point::Point;
use super::requests::{Quantity, Request};
use crate::rates::{
    AccelerationGradient, RelativeDeformation, RivlinEricksen, VelocityGradient, WhiteMetzner, exponential_rows,
};
use crate::tensor::rotation::{check_rotation, is_rotation};
use crate::tensor::rows::{Rows, difference, identity, product};
use crate::tensor::{MajorSymmetric, PairSymmetric};
use crate::{BatchError, Deformation, DeformationGradient, DisplacementGradient, Symmetric};

#[inline(always)]
fn rows<T: Copy>([a, b, c, d, e, f, g, h, i]: [T; 9]) -> Rows<T> {
    [[a, b, c], [d, e, f], [g, h, i]]
}

/// Fₜ(τ) of F(t), the deformation of the point, and F(τ), the input.
#[inline(always)]
fn relative<T: Real>(now: &impl Deformation<T>, then: [T; 9]) -> RelativeDeformation<T> {
    let change = difference(difference(rows(then), identity()), now.displacement_rows());
    let change = product(change, inverse_and_determinant(now.gradient_rows()).0);
    RelativeDeformation { displacement: DisplacementGradient::trusted(change) }
}

/// What follows from F now, at t, and from F then, at τ.
macro_rules! relatives {
    ($($(#[$documentation:meta])* $function:ident $name:ident [$k:literal] |$relative:ident| $value:expr, $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// The deformations of the batch are those at t, `then` is F(τ); det F(τ) ≤ 0 is a bad point.
        ///
        /// # Example
        /// ```
        /// use nalgebra::Matrix3;
        /// use piola_batch as batch;
        /// use piola_continuum::DeformationGradient;
        #[doc = concat!("let (then, mut out) = ([Matrix3::from_diagonal_element(6.0); 1000], [[0.0_f64; ", stringify!($k), "]; 1000]);")]
        #[doc = concat!("let request = batch::", stringify!($function), "(&then[..], &mut out[..]); // for `batch::evaluate`")]
        #[doc = concat!("assert_eq!(request.at(&DeformationGradient::dilatation(2.0)?, 7)[0], ", stringify!($expected), ");")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<S, V>(then: S, to: V) -> Request<$name, S, V, 9, $k> {
            Request { quantity: $name, source: then, to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<9, $k> for $name {
            type Input = Matrix3<f64>;
            type Output = Self;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = "deformation gradient then";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, input: [T; 9]) -> [T; $k] {
                let $relative = relative(point, input);
                $value
            }
            #[inline(always)]
            fn admits<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, input: &[T; 9]) -> T::Mask {
                T::zero().less_than(determinant(rows(*input)))
            }
            fn check_input<T: Real, D: Deformation<T>>(&self, _: &D, input: &[T; 9]) -> Result<(), BatchError> {
                DeformationGradient::from_rows(rows(*input)).map(|_| ())
            }
        }
    )* };
}

relatives! {
    /// Fₜ(τ) = F(τ) F(t)⁻¹ by rows: see [`RelativeDeformation`].
    relative_gradient RelativeGradient [9] |relative| flat(relative.gradient_rows()), 3.0;
    /// Cₜ(τ) = Fₜᵀ Fₜ: see [`RelativeDeformation::right_cauchy_green`].
    relative_right_cauchy_green RelativeRightCauchyGreen [6] |relative| relative.right_cauchy_green().components, 9.0;
    /// Cₜ(τ) − 1, without cancellation where F(τ) is near F(t): see [`RelativeDeformation::right_cauchy_green_change`].
    relative_right_cauchy_green_change RelativeRightCauchyGreenChange [6]
        |relative| relative.right_cauchy_green_change().components, 8.0;
}

/// Tensors of the gradients of velocity and acceleration.
macro_rules! accelerations {
    ($($(#[$documentation:meta])* $function:ident $name:ident $tensor:ident [$place:literal] = $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use nalgebra::Matrix3;
        /// use piola_batch as batch;
        /// use piola_continuum::{DeformationGradient, rates::{AccelerationGradient, VelocityGradient}};
        /// // Simple shear v₂ = k x₁ with k = 3, without acceleration.
        /// let shear = VelocityGradient::new(Matrix3::new(0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
        /// let (l, a) = ([shear; 1000], [AccelerationGradient::new(Matrix3::zeros())?; 1000]);
        /// let mut out = [[0.0_f64; 6]; 1000];
        #[doc = concat!("let request = batch::", stringify!($function), "(&a[..], &l[..], &mut out[..]); // for `batch::evaluate`")]
        #[doc = concat!("assert_eq!(request.at(&DeformationGradient::identity(), 7)[", stringify!($place), "], ", stringify!($expected), ");")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<A, L, V>(
            acceleration_gradient: A,
            velocity_gradient: L,
            to: V,
        ) -> Request<$name, (A, L), V, 18, 6> {
            Request { quantity: $name, source: (acceleration_gradient, velocity_gradient), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<18, 6> for $name {
            type Input = (AccelerationGradient, VelocityGradient);
            type Output = Self;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = "gradients of acceleration and velocity";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, input: [T; 18]) -> [T; 6] {
                let gradients = [from_rows(rows(part(&input, 9))), from_rows(rows(part(&input, 0)))];
                $tensor::of_gradients(&gradients)[1].0.components
            }
        }
    )* };
}

accelerations! {
    /// The second tensor of Rivlin and Ericksen, A₂, 1/s², of grad a and L: see [`RivlinEricksen`]. A₁ is twice
    /// [`stretching`](super::stretching).
    second_rivlin_ericksen SecondRivlinEricksen RivlinEricksen [0] = 18.0;
    /// The second tensor of White and Metzner, B₂, 1/s², of grad a and L: see [`WhiteMetzner`].
    second_white_metzner SecondWhiteMetzner WhiteMetzner [1] = -18.0;
}

/// exp A of a tensor by rows, such as L t of a steady motion: see [`exponential_rows`].
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_batch as batch;
/// use piola_continuum::DeformationGradient;
/// let (a, mut out) = ([Matrix3::from_diagonal_element(1.0); 1000], [[0.0_f64; 9]; 1000]);
/// let request = batch::exponential(&a[..], &mut out[..]); // for `batch::evaluate`
/// assert_eq!(request.at(&DeformationGradient::identity(), 7)[0], core::f64::consts::E);
/// ```
#[must_use]
pub fn exponential<S, V>(of: S, to: V) -> Request<Exponential, S, V, 9, 9> {
    Request { quantity: Exponential, source: of, to }
}

/// The output of [`exponential`].
#[derive(Clone, Copy, Debug)]
pub struct Exponential;

impl Quantity<9, 9> for Exponential {
    type Input = Matrix3<f64>;
    type Output = Self;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "exponent";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, input: [T; 9]) -> [T; 9] {
        flat(exponential_rows(rows(input)))
    }
}

/// What is turned by a rotation Q of each point.
macro_rules! turned {
    ($($(#[$documentation:meta])* $function:ident $name:ident $of:ident [$i:literal + 9 = $total:literal] $example:literal, $place:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// Q that is no rotation to 64 ulp is a bad point.
        ///
        /// # Example
        /// ```
        /// use nalgebra::Matrix3;
        /// use piola_batch as batch;
        /// use piola_continuum::{DeformationGradient, Symmetric};
        /// use piola_tensor::MajorSymmetric;
        #[doc = concat!("let tensor = [", $example, "; 1000];")]
        /// let quarter_turn = [Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0); 1000];
        #[doc = concat!("let mut out = [[0.0_f64; ", stringify!($i), "]; 1000];")]
        #[doc = concat!("let request = batch::", stringify!($function), "(&tensor[..], &quarter_turn[..], &mut out[..]);")]
        /// let turned = request.at(&DeformationGradient::identity(), 7);
        #[doc = concat!("assert_eq!((turned[0], turned[", stringify!($place), "]), (0.0, 4.0)); // the axis 1 is 2 now")]
        /// ```
        #[must_use]
        pub fn $function<S, R, V>(tensor: S, rotation: R, to: V) -> Request<$name, (S, R), V, $total, $i> {
            Request { quantity: $name, source: (tensor, rotation), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<$total, $i> for $name {
            type Input = ($of, Matrix3<f64>);
            type Output = $of;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = "tensor and rotation";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, input: [T; $total]) -> [T; $i] {
                $of { components: part(&input, 0) }.congruence(rows(part(&input, $i))).components
            }
            #[inline(always)]
            fn admits<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, input: &[T; $total]) -> T::Mask {
                is_rotation(rows(part(input, $i)))
            }
            fn check_input<T: Real, D: Deformation<T>>(
                &self,
                _: &D,
                input: &[T; $total],
            ) -> Result<(), BatchError> {
                check_rotation(&from_rows(rows(part(input, $i))))
            }
        }
    )* };
}

turned! {
    /// Q A Qᵀ of a symmetric tensor: see [`Symmetric::rotated`].
    rotated RotatedSymmetric Symmetric [6 + 9 = 15] "Symmetric::diagonal([4.0, 0.0, 0.0])", 1;
    /// A tangent turned by Q, `QᵢₐQⱼᵦQₖᵧQₗᵟ Cₐᵦᵧᵟ`: see [`PairSymmetric::rotated`].
    rotated_tangent RotatedTangent MajorSymmetric [21 + 9 = 30] "MajorSymmetric::dyad(&Symmetric::diagonal([2.0, 0.0, 0.0]))", 6;
}
