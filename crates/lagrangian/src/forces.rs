//! Applied forces: generalised ones, and forces and moments on the particles and bodies themselves.

use piola_kinematics::Attitude;
use piola_numerics::Real;

/// Forces that do not come from a potential.
///
/// ```text
/// Q_Δ = Σ f·∂x/∂q^Δ + Σ F·∂ξ/∂q^Δ + Σ G·ω_Δ                                              W(5.9)
/// ```
///
/// A system of forces overrides what it has and declares it by the constants; the rest is compiled away.
///
/// # Example
/// ```
/// use piola_lagrangian::Forces;
/// use piola_numerics::Real;
/// /// Air drag −c v on every particle.
/// struct Drag { coefficient: f64 }
/// impl Forces for Drag {
///     const ON_PARTS: bool = true;
///     fn on_part<T: Real>(&self, _part: usize, _x: [T; 3], velocity: [T; 3], _t: T) -> [T; 3] {
///         velocity.map(|v| T::lit(-self.coefficient) * v)
///     }
/// }
/// assert_eq!(Drag { coefficient: 2.0 }.on_part(0, [0.0; 3], [1.0, 0.0, 0.0], 0.0), [-2.0, 0.0, 0.0]);
/// ```
pub trait Forces {
    /// Whether [`generalised`](Self::generalised) is to be called.
    const GENERALISED: bool = false;
    /// Whether [`on_part`](Self::on_part) is to be called.
    const ON_PARTS: bool = false;
    /// Whether [`moment_on_body`](Self::moment_on_body) is to be called.
    const MOMENTS: bool = false;

    /// Adds the generalised forces Q_Δ (N, N m, … conjugate to q) to `q_out`.
    fn generalised<T: Real>(&self, _q: &[T], _v: &[T], _t: T, _q_out: &mut [T]) {}
    /// The force (N, space components) on the part number `part`, counted over particles and bodies in the
    /// order of placement, at its position and velocity; on a body it acts at the centre of mass.
    fn on_part<T: Real>(&self, _part: usize, _position: [T; 3], _velocity: [T; 3], _t: T) -> [T; 3] {
        [T::zero(); 3]
    }
    /// The moment (N m, body components, about the centre of mass) on the body with the part number `part`,
    /// in its attitude, turning with the given angular velocity (rad/s, body components).
    /// [`Attitude::to_body`] brings a moment that is known in space components.
    fn moment_on_body<T: Real>(
        &self,
        _part: usize,
        _attitude: Attitude<T>,
        _angular_velocity: [T; 3],
        _t: T,
    ) -> [T; 3] {
        [T::zero(); 3]
    }
}

/// No applied forces: costs nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoForces;

impl Forces for NoForces {}
