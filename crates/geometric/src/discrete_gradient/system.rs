//! Systems with an energy: ẏ = (S − R) ∇H.

use piola_numerics::Real;

/// A system ẏ = (S(y) − R(y)) ∇H(y) with S skew and R ≥ 0, written once for any scalar.
///
/// | method | formula | default |
/// |---|---|---|
/// | [`energy`](Self::energy) | H(y) | |
/// | [`structure`](Self::structure) | S(y) g | canonical: y = (q, p), S g = (∂g/∂p part, −∂g/∂q part) |
/// | [`damping`](Self::damping) | R(y) g | 0 |
///
/// Without damping Ḣ = ∇H·S∇H = 0; with damping Ḣ = −∇H·R∇H ≤ 0. A function C with S∇C = 0 is a Casimir function, which
/// the motion keeps for every H.
///
/// # Example
/// A rigid body: y is the angular momentum in the body, S g = y × g (which is −g × y), and |y|² is a Casimir function.
/// ```
/// use piola_geometric::EnergySystem;
/// use piola_numerics::Real;
/// struct FreeBody;
/// impl EnergySystem for FreeBody {
///     fn dimension(&self) -> usize {
///         3
///     }
///     fn energy<T: Real>(&self, y: &[T]) -> T {
///         T::lit(0.5) * (y[0] * y[0] + y[1] * y[1] / T::lit(2.0) + y[2] * y[2] / T::lit(3.0))
///     }
///     fn structure<T: Real>(&self, y: &[T], g: &[T], out: &mut [T]) {
///         out[0] = y[1] * g[2] - y[2] * g[1];
///         out[1] = y[2] * g[0] - y[0] * g[2];
///         out[2] = y[0] * g[1] - y[1] * g[0];
///     }
/// }
/// let mut rate = [0.0; 3];
/// FreeBody.structure(&[2.0, 2.0, 3.0], &[2.0, 1.0, 1.0], &mut rate); // ∇H = (2, 1, 1)
/// assert_eq!(rate, [-1.0, 4.0, -2.0]);
/// ```
#[doc(alias("Poisson system", "port-Hamiltonian", "GENERIC", "Casimir"))]
pub trait EnergySystem {
    /// Whether there is damping. Without it the method corrects in each step what rounding did to the energy.
    const DAMPED: bool = false;
    /// The number of components of y.
    fn dimension(&self) -> usize;
    /// H(y), J.
    fn energy<T: Real>(&self, y: &[T]) -> T;
    /// Writes S(y) g. S must be skew: g·S g = 0 for every g.
    ///
    /// The default is canonical: y = (q, p), two halves. If the dimension is odd, the last component stays constant.
    fn structure<T: Real>(&self, y: &[T], g: &[T], out: &mut [T]) {
        let n = y.len() / 2;
        for i in 0..n {
            out[i] = g[n + i];
            out[n + i] = -g[i];
        }
        if let Some(last) = out.get_mut(2 * n) {
            *last = T::zero();
        }
    }
    /// Writes R(y) g, with 0 ≤ g·R g for every g. It is called only if [`DAMPED`](Self::DAMPED).
    fn damping<T: Real>(&self, _y: &[T], _g: &[T], out: &mut [T]) {
        out.fill(T::zero());
    }
}
