//! Eigenvalues, eigenvectors and functions of symmetric tensors.

use piola_numerics::{Lanes, Real};

use super::kinematic::flat;
use super::parts::part;
use super::point::Point;
use super::requests::{Quantity, Request};
use super::tangents::slots;
use super::{BatchScalar, Destination};
use crate::spectral::{IsotropicFunction, decompose, derivative, derivative_array, second_derivative};
use crate::tensor::MinorSymmetric;
use crate::{Deformation, Symmetric};

/// Eigenvalues and eigenvectors of a symmetric tensor: see [`decompose`].
///
/// The vectors go out as nine components, one vector a row.
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_continuum::Symmetric;
/// let (mut values, mut vectors) = ([[0.0_f64; 3]], [[[0.0_f64; 3]; 3]]);
/// let tensors = [Symmetric::diagonal([1.0, 3.0, 2.0])];
/// batch::evaluate(batch::Undeformed(1), batch::eigenpairs(&tensors[..], &mut values[..], &mut vectors[..]))?;
/// assert!((values[0][0] - 3.0).abs() < 2e-15 && (vectors[0][0][1].abs() - 1.0).abs() < 1e-15);
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[must_use]
pub fn eigenpairs<S, V, W>(tensor: S, values: V, vectors: W) -> Request<Eigenpairs, S, (V, W), 6, 12> {
    Request { quantity: Eigenpairs, source: tensor, to: (values, vectors) }
}

/// The output of [`eigenpairs`].
#[derive(Clone, Copy, Debug)]
pub struct Eigenpairs;

impl Quantity<6, 12> for Eigenpairs {
    type Input = Symmetric;
    type Output = Self;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "tensor";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, components: [T; 6]) -> [T; 12] {
        let decomposition = decompose(&Symmetric { components });
        let ([x, y, z], [a, b, c, d, e, f, g, h, i]) = (decomposition.values, flat(decomposition.vectors));
        [x, y, z, a, b, c, d, e, f, g, h, i]
    }
}

/// Values and vectors apart.
impl<T, V, W> Destination<Eigenpairs, T, 12> for (V, W)
where
    T: BatchScalar,
    V: Destination<Eigenpairs, T, 3>,
    W: Destination<Eigenpairs, T, 9>,
{
    fn count(&self) -> usize {
        // Both are checked: a pair is as long as both parts, and no batch as long as neither.
        let (values, vectors) = (self.0.count(), self.1.count());
        if values == vectors { values } else { usize::MAX }
    }
    #[inline(always)]
    fn split(self, middle: usize) -> (Self, Self) {
        let ((a, b), (c, d)) = (self.0.split(middle), self.1.split(middle));
        ((a, c), (b, d))
    }
    #[inline(always)]
    fn put(&mut self, index: usize, [x, y, z, a, b, c, d, e, f, g, h, i]: [T; 12]) {
        self.0.put(index, [x, y, z]);
        self.1.put(index, [a, b, c, d, e, f, g, h, i]);
    }
    #[inline(always)]
    fn store<const N: usize>(&mut self, first: usize, count: usize, values: &[Lanes<T, N>; 12]) {
        let [x, y, z, a, b, c, d, e, f, g, h, i] = *values;
        self.0.store(first, count, &[x, y, z]);
        self.1.store(first, count, &[a, b, c, d, e, f, g, h, i]);
    }
}

/// f(A) of symmetric tensors A: see [`tensor_function`](crate::spectral::tensor_function()).
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_continuum::{DeformationGradient, Symmetric};
/// use piola_tensor::spectral::SquareRoot;
/// let squares = [Symmetric::diagonal([9.0, 4.0, 1.0]); 3];
/// let mut roots = [Symmetric::zero(); 3];
/// let any = DeformationGradient::identity();
/// let request = batch::tensor_function(SquareRoot, &squares[..], &mut roots[..]);
/// assert!((request.at(&any, 2)[0] - 3.0_f64).abs() < 2e-15);
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[must_use]
pub fn tensor_function<F, S, V>(f: F, tensor: S, to: V) -> Request<TensorFunction<F>, S, V, 6, 6> {
    Request { quantity: TensorFunction(f), source: tensor, to }
}

/// The output of [`tensor_function`].
#[derive(Clone, Copy, Debug)]
pub struct TensorFunction<F>(F);

impl<F: IsotropicFunction + Copy + Send + Sync> Quantity<6, 6> for TensorFunction<F> {
    type Input = Symmetric;
    type Output = Self;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "tensor";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, components: [T; 6]) -> [T; 6] {
        crate::spectral::tensor_function(&self.0, &Symmetric { components }).components
    }
}

/// The derivatives of f at symmetric tensors A along symmetric H: see [`derivative`].
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_continuum::{DeformationGradient, Symmetric};
/// use piola_tensor::spectral::SquareRoot;
/// let (a, h) = ([Symmetric::diagonal([9.0, 4.0, 1.0]); 3], [Symmetric::diagonal([3.0, 0.0, 0.0]); 3]);
/// let mut along = [Symmetric::zero(); 3];
/// let any = DeformationGradient::identity();
/// let request = batch::tensor_function_derivative(SquareRoot, &a[..], &h[..], &mut along[..]);
/// assert!((request.at(&any, 2)[0] - 0.5_f64).abs() < 1e-15); // 3/(2 √9)
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[must_use]
pub fn tensor_function_derivative<F, S, H, V>(
    f: F,
    tensor: S,
    along: H,
    to: V,
) -> Request<TensorFunctionDerivative<F>, (S, H), V, 12, 6> {
    Request { quantity: TensorFunctionDerivative(f), source: (tensor, along), to }
}

/// The output of [`tensor_function_derivative`].
#[derive(Clone, Copy, Debug)]
pub struct TensorFunctionDerivative<F>(F);

impl<F: IsotropicFunction + Copy + Send + Sync> Quantity<12, 6> for TensorFunctionDerivative<F> {
    type Input = (Symmetric, Symmetric);
    type Output = Self;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "tensor and direction";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, input: [T; 12]) -> [T; 6] {
        let (a, h) = (Symmetric { components: part(&input, 0) }, Symmetric { components: part(&input, 6) });
        derivative(&self.0, &a, &h).components
    }
}

/// The second derivatives of f at symmetric tensors A along symmetric H and K: see
/// [`second_derivative`](crate::spectral::second_derivative).
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_continuum::{DeformationGradient, Symmetric};
/// use piola_tensor::spectral::SquareRoot;
/// let (a, h) = ([Symmetric::<f64>::identity(); 3], [Symmetric::diagonal([1.0, 2.0, 0.0]); 3]);
/// let mut along = [Symmetric::zero(); 3];
/// let any = DeformationGradient::identity();
/// let request = batch::tensor_function_second_derivative(SquareRoot, &a[..], &h[..], &h[..], &mut along[..]);
/// assert!((request.at(&any, 2)[1] + 1.0).abs() < 1e-15); // √(1 + h) = 1 + h/2 − h²/8
/// ```
#[must_use]
pub fn tensor_function_second_derivative<F, S, H, K, V>(
    f: F,
    tensor: S,
    first: H,
    second: K,
    to: V,
) -> Request<TensorFunctionSecondDerivative<F>, (S, H, K), V, 18, 6> {
    Request { quantity: TensorFunctionSecondDerivative(f), source: (tensor, first, second), to }
}

/// The output of [`tensor_function_second_derivative`].
#[derive(Clone, Copy, Debug)]
pub struct TensorFunctionSecondDerivative<F>(F);

impl<F: IsotropicFunction + Copy + Send + Sync> Quantity<18, 6> for TensorFunctionSecondDerivative<F> {
    type Input = (Symmetric, Symmetric, Symmetric);
    type Output = Self;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "tensor and directions";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, input: [T; 18]) -> [T; 6] {
        let (a, h) = (Symmetric { components: part(&input, 0) }, Symmetric { components: part(&input, 6) });
        second_derivative(&self.0, &a, &h, &Symmetric { components: part(&input, 12) }).components
    }
}

/// The whole derivatives ∂f(A)/∂A of symmetric tensors A, six rows of six: see [`derivative_array`].
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_continuum::{DeformationGradient, Symmetric};
/// use piola_tensor::spectral::SquareRoot;
/// let (a, mut out) = ([Symmetric::<f64>::identity(); 3], [[0.0; 36]; 3]);
/// let request = batch::tensor_function_derivative_array(SquareRoot, &a[..], &mut out[..]);
/// assert!((request.at(&DeformationGradient::identity(), 2)[0] - 0.5).abs() < 1e-15);
/// ```
#[must_use]
pub fn tensor_function_derivative_array<F, S, V>(
    f: F,
    tensor: S,
    to: V,
) -> Request<TensorFunctionDerivativeArray<F>, S, V, 6, 36> {
    Request { quantity: TensorFunctionDerivativeArray(f), source: tensor, to }
}

/// The output of [`tensor_function_derivative_array`].
#[derive(Clone, Copy, Debug)]
pub struct TensorFunctionDerivativeArray<F>(F);

impl<F: IsotropicFunction + Copy + Send + Sync> Quantity<6, 36> for TensorFunctionDerivativeArray<F> {
    type Input = Symmetric;
    type Output = Self;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "tensor";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, components: [T; 6]) -> [T; 36] {
        slots(&MinorSymmetric { components: derivative_array(&self.0, &Symmetric { components }) })
    }
}
