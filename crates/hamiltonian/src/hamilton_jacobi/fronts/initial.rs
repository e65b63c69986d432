//! The curve or surface from which a front starts.

use core::array::from_fn;

use piola_numerics::{Gradient, Real};

/// A curve in the plane (N = 2, M = 1) or a surface in space (N = 3, M = 2), by parameters, written once for any
/// scalar.
///
/// # Example
/// A circle, and a point from which a front spreads in all directions:
/// ```
/// use piola_hamiltonian::hamilton_jacobi::InitialFront;
/// use piola_numerics::Real;
/// struct Circle(f64);
/// impl InitialFront<2, 1> for Circle {
///     fn at<T: Real>(&self, [a]: [T; 1]) -> [T; 2] {
///         [T::lit(self.0) * a.cos(), T::lit(self.0) * a.sin()]
///     }
/// }
/// assert_eq!(Circle(2.0).normal([0.0]), [1.0, 0.0]); // to the right of the way round: outwards
/// struct Source;
/// impl InitialFront<2, 1> for Source {
///     fn at<T: Real>(&self, _: [T; 1]) -> [T; 2] {
///         [T::zero(); 2]
///     }
///     fn normal<T: Real>(&self, [a]: [T; 1]) -> [T; 2] {
///         [a.cos(), a.sin()]
///     }
/// }
/// assert_eq!(Source.normal([0.0]), [1.0, 0.0]);
/// ```
///
/// # Source
/// W(13.10), W(13.26).
pub trait InitialFront<const N: usize, const M: usize> {
    /// The place q at the parameters.
    fn at<T: Real>(&self, parameters: [T; M]) -> [T; N];
    /// The unit covector in whose direction the momenta point: by default the normal, to the right of a curve, and
    /// ∂q/∂σ₁ × ∂q/∂σ₂ of a surface. To be given where the front starts in a point or a line.
    fn normal<T: Real>(&self, parameters: [T; M]) -> [T; N] {
        let varied: [Gradient<T, M>; M] = from_fn(|i| Gradient::variable(parameters[i], i));
        let place = self.at(varied);
        let tangent = |axis: usize, k: usize| place[axis % N].partials[k % M];
        let normal: [T; N] = from_fn(|i| {
            if N == 2 {
                // (y′, −x′)
                let other = tangent(1 - i.min(1), 0);
                if i == 0 { other } else { -other }
            } else {
                tangent(i + 1, 0) * tangent(i + 2, 1) - tangent(i + 2, 0) * tangent(i + 1, 1)
            }
        });
        let mut square = T::zero();
        for x in normal {
            square += x * x;
        }
        let inverse = square.sqrt().recip();
        normal.map(|x| x * inverse)
    }
}
