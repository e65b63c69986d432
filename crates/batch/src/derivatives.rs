//! Derivatives of strains and invariants with respect to F and C.
//!
//! Along one direction dF the derivative of a strain is its rate for Ḟ = dF: [`green_rate`](super::green_rate),
//! [`right_stretch_rate`](super::right_stretch_rate), [`hencky_rate`](super::hencky_rate),
//! [`seth_hill_rate`](super::seth_hill_rate) and the others. Here are all nine at once, and second ones.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, rows_of};

use super::kinematic::flat;
use super::parts::part;
use super::point::Point;
use super::requests::{Quantity, Request};
use crate::rates::{GradientRate, StretchRates};
use crate::strain::{
    AlmansiStrain, GreenStrain, HenckyStrain, LeftCauchyGreen, LeftStretch, RightCauchyGreen, RightStretch, SethHill,
    SethHillStrain, SpatialHenckyStrain, SpatialSethHillStrain, invariants,
};
use crate::tensor::rows::Rows;
use crate::{Deformation, Symmetric};

/// Rows of nine derivatives, one for each component.
#[inline(always)]
fn joined<T: Real, const K: usize, const TOTAL: usize>(rows: [[T; 9]; K]) -> [T; TOTAL] {
    let mut all = [T::zero(); TOTAL];
    let mut at = 0;
    while at < TOTAL {
        all[at] = rows[at / 9][at % 9];
        at += 1;
    }
    all
}

/// The rates for Ḟ with a one in one place.
#[inline(always)]
fn along_entry<T: Real, D: Deformation<T>>(point: &Point<T, D>, place: usize) -> StretchRates<T> {
    let mut direction = [[T::zero(); 3]; 3];
    direction[place / 3][place % 3] = T::one();
    StretchRates::of_analysis(point.stretch(), &GradientRate(from_rows(direction)))
}

#[inline(always)]
fn matrix<T: Real, const TOTAL: usize>(input: &[T; TOTAL], at: usize) -> Matrix3<T> {
    let [a, b, c, d, e, f, g, h, i] = part(input, at);
    from_rows([[a, b, c], [d, e, f], [g, h, i]])
}

/// What is derived, as the rows of its components; for the example one entry at F = diag(2, ½, ½).
macro_rules! of_gradient {
    ($($(#[$documentation:meta])* $function:ident $name:ident [$k:literal] $stretch:literal |$point:ident| $value:expr,
        $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use piola_batch as batch;
        /// use piola_continuum::DeformationGradient;
        #[doc = concat!("let mut out = [[0.0_f64; ", stringify!($k), "]; 1000];")]
        #[doc = concat!("let request = batch::", stringify!($function), "(&mut out[..]); // for `batch::evaluate`")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
        #[doc = concat!("assert!((request.at(&f, 7)[0] - (", stringify!($expected), ")).abs() < 1e-14);")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<V>(to: V) -> Request<$name, (), V, 0, $k> {
            Request { quantity: $name, source: (), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<0, $k> for $name {
            type Input = ();
            type Output = Self;
            const NEEDS_STRETCH: bool = $stretch;
            const INPUT: &'static str = "";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, _input: [T; 0]) -> [T; $k] {
                $value
            }
        }
    )* };
}

/// The components of a symmetric rate of the stretches for each of the nine entries of Ḟ.
macro_rules! by_entries {
    ($point:ident, |$rates:ident| $rate:expr) => {{
        let mut rows = [[T::zero(); 9]; 6];
        for place in 0..9 {
            let $rates = along_entry($point, place);
            let components = $rate.components;
            for (row, component) in rows.iter_mut().zip(components) {
                row[place] = component;
            }
        }
        joined(rows)
    }};
}

of_gradient! {
    /// ∂C/∂F: a row of nine, 11, 12, 13, 21, …, for each of the six components of C.
    right_cauchy_green_derivative RightCauchyGreenDerivative [54] false
        |point| joined(RightCauchyGreen::derivative_matrix(point)), 4.0;
    /// ∂B/∂F, six rows of nine.
    left_cauchy_green_derivative LeftCauchyGreenDerivative [54] false
        |point| joined(LeftCauchyGreen::derivative_matrix(point)), 4.0;
    /// ∂E/∂F, six rows of nine.
    green_strain_derivative GreenStrainDerivative [54] false |point| joined(GreenStrain::derivative_matrix(point)), 2.0;
    /// ∂e/∂F of Almansi's strain, six rows of nine.
    almansi_strain_derivative AlmansiStrainDerivative [54] false
        |point| joined(AlmansiStrain::derivative_matrix(point)), 0.125;
    /// ∂U/∂F, six rows of nine, which is that of Biot's strain too: of [`StretchRates`] for the nine entries.
    right_stretch_derivative RightStretchDerivative [54] true
        |point| by_entries!(point, |rates| rates.right_stretch()), 1.0;
    /// ∂V/∂F, six rows of nine.
    left_stretch_derivative LeftStretchDerivative [54] true
        |point| by_entries!(point, |rates| rates.left_stretch()), 1.0;
    /// ∂ ln U/∂F, six rows of nine.
    hencky_derivative HenckyDerivative [54] true |point| by_entries!(point, |rates| rates.hencky_material()), 0.5;
    /// ∂ ln V/∂F, six rows of nine.
    hencky_spatial_derivative HenckySpatialDerivative [54] true
        |point| by_entries!(point, |rates| rates.hencky_spatial()), 0.5;
    /// ∂R/∂F, nine rows of nine.
    rotation_derivative RotationDerivative [81] true |point| {
        let mut rows = [[T::zero(); 9]; 9];
        for place in 0..9 {
            let components = flat(rows_of(&along_entry(point, place).rotation()));
            for (row, component) in rows.iter_mut().zip(components) {
                row[place] = component;
            }
        }
        joined(rows)
    }, 0.0;
    /// ∂I₁/∂F, ∂I₂/∂F and ∂I₃/∂F of the invariants of C, by rows: see [`invariants::first_gradient`].
    strain_invariant_gradients StrainInvariantGradients [27] false |point| {
        let gradients: [Rows<T>; 3] =
            [invariants::first_gradient(point), invariants::second_gradient(point), invariants::third_gradient(point)];
        joined([flat(gradients[0]), flat(gradients[1]), flat(gradients[2])])
    }, 4.0;
    /// Ī₁ = J^(−2/3) I₁ and Ī₂ = J^(−4/3) I₂; in the example 4.5 ∛4.
    isochoric_invariants IsochoricInvariants [2] false
        |point| [invariants::isochoric_first(point), invariants::isochoric_second(point)], 7.143_304_733_856_898;
    /// ∂Ī₁/∂C: see [`invariants::isochoric_first_derivative`].
    isochoric_first_derivative IsochoricFirstDerivative [6] false
        |point| invariants::isochoric_first_derivative(point).components, 0.992_125_657_480_124_7;
    /// ∂Ī₂/∂C: see [`invariants::isochoric_second_derivative`].
    isochoric_second_derivative IsochoricSecondDerivative [6] false
        |point| invariants::isochoric_second_derivative(point).components, 0.393_725_328_092_147_84;
}

/// Derivatives of the whole family of Seth and Hill.
macro_rules! seth_hill {
    ($($(#[$documentation:meta])* $function:ident $name:ident $rate:ident; $second:ident $second_name:ident $strain:ident;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use piola_continuum::strain::SethHill;
        /// use piola_batch as batch;
        /// use piola_continuum::DeformationGradient;
        /// let mut out = [[0.0_f64; 54]; 1000];
        #[doc = concat!("let request = batch::", stringify!($function), "(SethHill::GREEN, &mut out[..]); // for `batch::evaluate`")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
        /// assert!((request.at(&f, 7)[0] - 2.0).abs() < 1e-14); // of ½ (λ² − 1)
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<V>(scale: SethHill, to: V) -> Request<$name, (), V, 0, 54> {
            Request { quantity: $name(scale), source: (), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name(SethHill);

        impl Quantity<0, 54> for $name {
            type Input = ();
            type Output = Self;
            const NEEDS_STRETCH: bool = true;
            const INPUT: &'static str = "";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, _input: [T; 0]) -> [T; 54] {
                by_entries!(point, |rates| rates.$rate(&self.0))
            }
        }

        #[doc = concat!("The second derivative of the same along two directions: see [`", stringify!($strain), "::second_derivative`].")]
        ///
        /// # Example
        /// ```
        /// use nalgebra::Matrix3;
        /// use piola_continuum::strain::SethHill;
        /// use piola_batch as batch;
        /// use piola_continuum::DeformationGradient;
        /// let (along, mut out) = ([Matrix3::from_diagonal(&[1.0, 0.0, 0.0].into()); 3], [[0.0_f64; 6]; 3]);
        #[doc = concat!("let request = batch::", stringify!($second), "(SethHill::GREEN, &along[..], &along[..], &mut out[..]);")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
        /// assert!((request.at(&f, 2)[0] - 1.0).abs() < 1e-14); // of ½ (λ² − 1)
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $second<A, B, V>(scale: SethHill, first: A, second: B, to: V) -> Request<$second_name, (A, B), V, 18, 6> {
            Request { quantity: $second_name(scale), source: (first, second), to }
        }

        #[doc = concat!("The output of [`", stringify!($second), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $second_name(SethHill);

        impl Quantity<18, 6> for $second_name {
            type Input = (Matrix3<f64>, Matrix3<f64>);
            type Output = Self;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = "directions";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, input: [T; 18]) -> [T; 6] {
                $strain::second_derivative(point, self.0, &matrix(&input, 0), &matrix(&input, 9)).components
            }
        }
    )* };
}

seth_hill! {
    /// ∂/∂F of (Uᵐ − 1)/m, six rows of nine: of [`StretchRates::material_function`].
    seth_hill_derivative SethHillDerivative material_function;
    seth_hill_second_derivative SethHillSecondDerivative SethHillStrain;
    /// ∂/∂F of (Vᵐ − 1)/m, six rows of nine: of [`StretchRates::spatial_function`].
    seth_hill_spatial_derivative SethHillSpatialDerivative spatial_function;
    seth_hill_spatial_second_derivative SethHillSpatialSecondDerivative SpatialSethHillStrain;
}

/// Second derivatives along two directions; for the example the first component at F = diag(2, ½, ½), both e₁ ⊗ e₁.
macro_rules! second {
    ($($(#[$documentation:meta])* $function:ident $name:ident |$point:ident, $first:ident, $second:ident| $value:expr,
        $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use nalgebra::Matrix3;
        /// use piola_batch as batch;
        /// use piola_continuum::DeformationGradient;
        /// let (along, mut out) = ([Matrix3::from_diagonal(&[1.0, 0.0, 0.0].into()); 3], [[0.0_f64; 6]; 3]);
        #[doc = concat!("let request = batch::", stringify!($function), "(&along[..], &along[..], &mut out[..]);")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
        #[doc = concat!("assert!((request.at(&f, 2)[0] - (", stringify!($expected), ")).abs() < 1e-14);")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<A, B, V>(first: A, second: B, to: V) -> Request<$name, (A, B), V, 18, 6> {
            Request { quantity: $name, source: (first, second), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<18, 6> for $name {
            type Input = (Matrix3<f64>, Matrix3<f64>);
            type Output = Self;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = "directions";

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, input: [T; 18]) -> [T; 6] {
                let ($first, $second) = (&matrix(&input, 0), &matrix(&input, 9));
                $value.components
            }
        }
    )* };
}

second! {
    /// ∂²C/∂F² along two directions: Aᵀ B + Bᵀ A.
    right_cauchy_green_second_derivative RightCauchyGreenSecondDerivative
        |_point, a, b| RightCauchyGreen::second_derivative(a, b), 2.0;
    /// ∂²B/∂F² along two directions: A Bᵀ + B Aᵀ.
    left_cauchy_green_second_derivative LeftCauchyGreenSecondDerivative
        |_point, a, b| LeftCauchyGreen::second_derivative(a, b), 2.0;
    /// ∂²E/∂F² along two directions.
    green_strain_second_derivative GreenStrainSecondDerivative |_point, a, b| GreenStrain::second_derivative(a, b), 1.0;
    /// ∂²e/∂F² of Almansi's strain along two directions.
    almansi_strain_second_derivative AlmansiStrainSecondDerivative
        |point, a, b| AlmansiStrain::second_derivative(point, a, b), -0.1875;
    /// ∂²U/∂F² along two directions, which is that of Biot's strain too.
    right_stretch_second_derivative RightStretchSecondDerivative
        |point, a, b| RightStretch::second_derivative(point, a, b), 0.0;
    /// ∂²V/∂F² along two directions.
    left_stretch_second_derivative LeftStretchSecondDerivative
        |point, a, b| LeftStretch::second_derivative(point, a, b), 0.0;
    /// ∂² ln U/∂F² along two directions.
    hencky_second_derivative HenckySecondDerivative |point, a, b| HenckyStrain::second_derivative(point, a, b), -0.25;
    /// ∂² ln V/∂F² along two directions.
    hencky_spatial_second_derivative HenckySpatialSecondDerivative
        |point, a, b| SpatialHenckyStrain::second_derivative(point, a, b), -0.25;
}

/// Of symmetric tensors; for the example one component at F = diag(2, ½, ½), all inputs e₁ ⊗ e₁.
macro_rules! of_tensors {
    ($($(#[$documentation:meta])* $function:ident $name:ident ($($argument:ident $generic:ident),*) $input:ty,
        [$i:literal => $k:literal] $what:literal |$point:ident, $given:ident| $value:expr, $expected:literal;)*) => { $(
        $(#[$documentation])*
        ///
        /// # Example
        /// ```
        /// use piola_batch as batch;
        /// use piola_continuum::{DeformationGradient, Symmetric};
        #[doc = concat!("let (a, mut out) = ([Symmetric::diagonal([1.0, 0.0, 0.0]); 3], [[0.0_f64; ", stringify!($k), "]; 3]);")]
        #[doc = concat!("let request = batch::", stringify!($function), "(", $(of_tensors!($argument),)* "&mut out[..]);")]
        /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
        #[doc = concat!("assert!((request.at(&f, 2)[0] - (", stringify!($expected), ")).abs() < 1e-14);")]
        /// # Ok::<(), piola_batch::BatchError>(())
        /// ```
        #[must_use]
        pub fn $function<$($generic,)* V>($($argument: $generic,)* to: V) -> Request<$name, of_tensors!(source $($generic)*), V, $i, $k> {
            Request { quantity: $name, source: of_tensors!(value $($argument)*), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<$i, $k> for $name {
            type Input = $input;
            type Output = Self;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = $what;

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, input: [T; $i]) -> [T; $k] {
                let $given = &input;
                $value
            }
        }
    )* };
    (source $one:ident) => { $one };
    (source $($more:ident)+) => { ($($more),+) };
    (value $one:ident) => { $one };
    (value $($more:ident)+) => { ($($more),+) };
    ($argument:ident) => { "&a[..], " };
}

#[inline(always)]
fn symmetric<T: Real, const TOTAL: usize>(input: &[T; TOTAL], at: usize) -> Symmetric<T> {
    Symmetric { components: part(input, at) }
}

of_tensors! {
    /// ∂²Ī₁/∂C² applied to X: see [`invariants::isochoric_first_second_derivative`].
    isochoric_first_second_derivative IsochoricFirstSecondDerivative (along S) Symmetric, [6 => 6] "direction"
        |point, x| invariants::isochoric_first_second_derivative(point, &symmetric(x, 0)).components,
        -0.066_141_710_498_674_98;
    /// ∂²Ī₂/∂C² applied to X: see [`invariants::isochoric_second_second_derivative`].
    isochoric_second_second_derivative IsochoricSecondSecondDerivative (along S) Symmetric, [6 => 6] "direction"
        |point, x| invariants::isochoric_second_second_derivative(point, &symmetric(x, 0)).components,
        -0.059_058_799_213_822_18;
    /// ∂I₁/∂A, ∂I₂/∂A and ∂I₃/∂A of symmetric tensors A, six components each: see [`invariants::derivatives`].
    invariant_derivatives InvariantDerivatives (tensor S) Symmetric, [6 => 18] "tensor" |_point, a| {
        let [first, second, third] = invariants::derivatives(&symmetric(a, 0));
        let ([a, b, c, d, e, f], [g, h, i, j, k, l]) = (first.components, second.components);
        let [m, n, o, p, q, r] = third.components;
        [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r]
    }, 1.0;
    /// The second derivatives of I₁, I₂ and I₃ of symmetric tensors A along X and Y: see
    /// [`invariants::second_derivatives`].
    invariant_second_derivatives InvariantSecondDerivatives (tensor S, first X, second Y)
        (Symmetric, Symmetric, Symmetric), [18 => 3] "tensor and directions"
        |_point, a| invariants::second_derivatives(&symmetric(a, 0), &symmetric(a, 6), &symmetric(a, 12)), 0.0;
}
