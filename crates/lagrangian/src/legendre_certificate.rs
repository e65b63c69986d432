//! What vouches for velocities that were found from momenta.

use piola_kinematics::Holonomic;

use super::energy::With;
use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

/// How well velocities belong to momenta, and whether others could.
///
/// It is made by [`Lagrangian::legendre_certificate`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LegendreCertificate {
    /// max|∂L/∂q̇ − p| over max|p|.
    pub residual: f64,
    /// max|H⁻¹(p − ∂L/∂q̇)| over max|q̇| with H = ∂²L/∂q̇∂q̇: the relative change that one more Newton step would make,
    /// an estimate of the error of q̇.
    pub correction: f64,
    /// The smallest pivot of H over the diagonal entry it came from, in (0, 1]. That there is one proves H positive
    /// definite at q̇: near these velocities no others have the same momenta, and where L is convex in q̇ none at all.
    pub smallest_pivot: f64,
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// Tests velocities against momenta, however they were found.
    ///
    /// ```text
    /// r = p − ∂L/∂q̇ (q, q̇, t),    H = ∂²L/∂q̇∂q̇,    δq̇ = H⁻¹ r
    /// ```
    ///
    /// Shapes: q, q̇ and p have n entries; the units are those of the coordinates, t in s.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`] also where L is not defined;
    /// [`LagrangianError::SingularMetric`] with the direction in which H is not positive.
    ///
    /// # Accuracy
    /// The residual is itself rounded: a few ulp times the largest term of ∂L/∂q̇ over max|p|.
    ///
    /// # Example
    /// ```
    /// use piola_lagrangian::{Lagrangian, LagrangianFunction, Workspace};
    /// use piola_numerics::Real;
    /// struct Relativistic; // unit mass, unit speed of light
    /// impl LagrangianFunction for Relativistic {
    ///     fn lagrangian<T: Real>(&self, _q: &[T], v: &[T], _t: T) -> T {
    ///         -(T::one() - v[0] * v[0]).sqrt()
    ///     }
    /// }
    /// let particle = Lagrangian::from_function(Relativistic);
    /// let mut velocity = [0.0_f64];
    /// particle.velocities_into(&mut Workspace::default(), &[0.0], &[0.75], 0.0, &mut velocity)?;
    /// let certificate = particle.legendre_certificate(&[0.0], &velocity, &[0.75], 0.0)?;
    /// assert!(certificate.residual < 1e-15 && certificate.correction < 1e-15);
    /// assert_eq!(certificate.smallest_pivot, 1.0); // one coordinate: its diagonal entry is its pivot
    ///
    /// let guessed = particle.legendre_certificate(&[0.0], &[0.5], &[0.75], 0.0)?;
    /// assert!((guessed.correction - 0.2).abs() < 0.06); // 0.6 is a fifth more
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(9.4).
    pub fn legendre_certificate(
        &self,
        q: &[f64],
        v: &[f64],
        p: &[f64],
        t: f64,
    ) -> Result<LegendreCertificate, LagrangianError> {
        let n = q.len();
        check_length("q̇", n, v.len())?;
        check_length("p", n, p.len())?;
        self.check_given([("q", q), ("q̇", v)], t)?;
        check_finite("p", p)?;
        let mut work = Workspace::default();
        let mut remainder = vec![0.0; n];
        self.differentiate(&mut work, q, v, t, With::Velocities, &mut remainder);
        check_finite("∂L/∂q̇", &remainder)?;
        for (remainder, &p) in remainder.iter_mut().zip(p) {
            *remainder = p - *remainder;
        }
        let residual = share(&remainder, p);
        self.form_inertia_metric(&mut work, q, t);
        if P::VELOCITY_DEPENDENT {
            let Workspace { nested, metric, .. } = &mut work;
            self.subtract_velocity_hessian(nested, q, v, t, metric, n);
        }
        check_finite("∂²L/∂q̇∂q̇", &work.metric)?;
        let diagonal: Vec<f64> = (0..n).map(|i| work.metric[i * (n + 1)]).collect();
        self.solve_with_hessian(&mut work, (q, p, t), &mut remainder)?;
        let pivots = diagonal.iter().enumerate().map(|(i, diagonal)| work.metric[i * (n + 1)] / diagonal);
        let smallest_pivot = pivots.fold(1.0, f64::min);
        Ok(LegendreCertificate { residual, correction: share(&remainder, v), smallest_pivot })
    }
}

/// max|a| over max|b|; zero where a vanishes.
fn share(a: &[f64], b: &[f64]) -> f64 {
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let (a, b) = (largest(a), largest(b));
    if a <= 0.0 { 0.0 } else { a / b }
}
