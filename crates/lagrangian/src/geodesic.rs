//! The geometry of the inertia metric: covariant acceleration, raised and lowered indices, geodesics.
//!
//! ```text
//! (Dq̇/Dt)^Γ = q̈^Γ + Γ^Γ_ΔΘ q̇^Δ q̇^Θ = Q^Γ        Q^Γ = g^ΓΔ Q_Δ                            W(6.8–6.10)
//! ```
//!
//! The motion without forces is a geodesic, run through with constant speed √(g_ΔΓ q̇^Δ q̇^Γ) = √(2E). Christoffel
//! symbols are not formed: what Γ q̇ q̇ does comes out of one pass of the placement.
//!
//! Where the placement depends on time, the metric is that of the constraint surface held still at the time t.

use nalgebra::DVector;
use piola_integrators::{DormandPrince853, Field, IntegratorsError, State, Tolerance};
use piola_kinematics::{Holonomic, Placement};
use piola_numerics::Real;

use super::workspace::Workspace;
use super::{Forces, Lagrangian, NoForces, NoPotential, Potential};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

/// A placement held still at the time it is given.
#[derive(Clone, Copy, Debug)]
struct Still<'a, S>(&'a S);

impl<S: Holonomic> Holonomic for Still<'_, S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        self.0.place(q, t, bodies);
    }
}

/// Geodesics as a field over arc length, y = (q, dq/ds): for any integrator.
///
/// # Example
/// See [`Lagrangian::geodesic`], which follows it.
#[derive(Clone, Debug)]
pub struct GeodesicMotion<'a, S, T = f64> {
    lagrangian: Lagrangian<Still<'a, S>, NoPotential, NoForces>,
    coordinates: usize,
    t: f64,
    work: Workspace<T>,
}

impl<S: Holonomic, T: Real> Field<T> for GeodesicMotion<'_, S, T> {
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        2 * self.coordinates
    }
    fn is_second_order(&self) -> bool {
        true
    }
    fn rate(&mut self, _arc: f64, y: &[T], rate: &mut [T]) -> Result<(), LagrangianError> {
        let (q, direction) = y.split_at(self.coordinates);
        let (velocity, bend) = rate.split_at_mut(self.coordinates);
        velocity.copy_from_slice(direction);
        self.lagrangian.acceleration_into(&mut self.work, q, direction, T::lit(self.t), bend)
    }
}

/// The end of a piece of a geodesic.
///
/// # Example
/// See [`Lagrangian::geodesic`].
///
/// # Source
/// W(6.10).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GeodesicEnd {
    /// q.
    pub coordinates: Vec<f64>,
    /// dq/ds, of length one in the metric.
    pub direction: Vec<f64>,
    /// g_ΔΓ q′^Δ q′^Γ − 1 at the end: what the integration did to a quantity that a geodesic keeps.
    pub length_error: f64,
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The system with nothing acting on it and its constraint held still.
    fn held_still(&self) -> Lagrangian<Still<'_, S>, NoPotential, NoForces> {
        Lagrangian { system: Still(&self.system), gravity: [0.0; 3], potential: NoPotential, forces: NoForces }
    }

    /// The covariant acceleration of a motion.
    ///
    /// ```text
    /// (Dq̇/Dt)^Γ = q̈^Γ + Γ^Γ_ΔΘ q̇^Δ q̇^Θ
    /// ```
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | q, q̇, q̈ | `q`, `v`, `a` | n | the coordinates' own |
    /// | Dq̇/Dt | returned | n | the coordinates' own / s² |
    ///
    /// Along a motion of a system whose placement does not depend on time it is the generalised force with its
    /// index [raised](Self::raise). It is a vector: in other coordinates it transforms with ∂q̄/∂q alone.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`], [`LagrangianError::SingularMetric`].
    ///
    /// # Accuracy
    /// A few ulp of the larger of q̈ and Γ q̇ q̇, times the condition number of the metric scaled to unit diagonal.
    ///
    /// # Source
    /// W(6.8–6.10).
    pub fn covariant_acceleration<T: Real>(
        &self,
        q: &[T],
        v: &[T],
        a: &[T],
        t: T,
    ) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(q.len(), T::zero());
        self.covariant_acceleration_into(&mut Workspace::default(), q, v, a, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`covariant_acceleration`](Self::covariant_acceleration) to the caller's memory, without allocation once
    /// `work` has been used.
    ///
    /// # Errors
    /// As [`covariant_acceleration`](Self::covariant_acceleration).
    pub fn covariant_acceleration_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("q̈", q.len(), a.len())?;
        check_finite("q̈", a)?;
        // q̈ is what geodesics have; the rest is what bends the motion away from them.
        self.held_still().acceleration_into(work, q, v, t, out)?;
        for (out, &a) in out.iter_mut().zip(a) {
            *out = a - *out;
        }
        Ok(())
    }

    /// Raises the index of a covector: the vector with g_ΔΓ x^Γ = x_Δ. With the generalised force it gives the
    /// covariant acceleration.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`], [`LagrangianError::SingularMetric`].
    ///
    /// # Accuracy
    /// A few ulp times the condition number of the metric scaled to unit diagonal.
    ///
    /// # Source
    /// W(6.8).
    pub fn raise<T: Real>(&self, q: &[T], covector: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_column_slice(covector);
        self.raise_in_place(&mut Workspace::default(), q, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`raise`](Self::raise) in place, without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`raise`](Self::raise).
    pub fn raise_in_place<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        t: T,
        covector: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("covector", q.len(), covector.len())?;
        check_finite("covector", covector)?;
        self.form_inertia_metric(work, q, t);
        self.solve_with_metric(work, (q, q, t), covector)
    }

    /// Lowers the index of a vector: x_Δ = g_ΔΓ x^Γ.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`]; those of
    /// [`inertia_metric`](Self::inertia_metric).
    ///
    /// # Source
    /// W(6.8).
    pub fn lower<T: Real>(&self, q: &[T], vector: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let n = q.len();
        check_length("vector", n, vector.len())?;
        let mut work = Workspace::default();
        self.form_inertia_metric(&mut work, q, t);
        self.refuse_without_parts(q, t, &work.metric)?;
        let row = |i: usize| (0..n).fold(T::zero(), |sum, j| sum + work.metric[i + j * n] * vector[j]);
        let lowered = DVector::from_fn(n, |i, _| row(i));
        self.finite([("q", q), ("vector", vector)], t, ("covector", lowered.as_slice()))?;
        Ok(lowered)
    }

    /// Geodesics of the inertia metric as a field in (q, dq/ds), over the arc length or, what is the same, the
    /// motion without forces over time, on the constraint surface held still at `t`.
    ///
    /// # Source
    /// W(6.10) with Q = 0.
    pub fn geodesic_motion<T: Real>(&self, coordinates: usize, t: f64) -> GeodesicMotion<'_, S, T> {
        GeodesicMotion { lagrangian: self.held_still(), coordinates, t, work: Workspace::default() }
    }

    /// Follows a geodesic from q in a direction for a given arc length, √kg m.
    ///
    /// ```text
    /// ds² = g_ΔΓ dq^Δ dq^Γ        d²q^Γ/ds² + Γ^Γ_ΔΘ dq^Δ/ds dq^Θ/ds = 0
    /// ```
    ///
    /// The direction need not have length one. For a single particle of 1 kg the arc length is that of its path, m.
    /// The method is the adaptive one of order eight.
    ///
    /// # Errors
    /// [`LagrangianError::NoDirection`] unless 0 < g_ΔΓ v^Δ v^Γ; [`LagrangianError::Run`].
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// use piola_integrators::Tolerance;
    /// struct Sphere; // q = [polar angle, azimuth], radius 1 m, 1 kg
    /// impl Holonomic for Sphere {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         let ((s, c), (sp, cp)) = (q[0].sin_cos(), q[1].sin_cos());
    ///         bodies.particle(1.0, Vector3::new(s * cp, s * sp, c));
    ///     }
    /// }
    /// // From the equator to the north-east: a quarter of a great circle leads to its highest point, at 45°.
    /// let quarter = std::f64::consts::FRAC_PI_2;
    /// let tolerance = Tolerance::relative(1e-13)?;
    /// let end = Lagrangian::of(Sphere).geodesic(&[quarter, 0.0], &[-1.0, 1.0], quarter, 0.0, tolerance)?;
    /// assert!((end.coordinates[0] - 0.5 * quarter).abs() < 1e-12 && (end.coordinates[1] - quarter).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// W(6.10) with Q = 0.
    pub fn geodesic(
        &self,
        q: &[f64],
        direction: &[f64],
        length: f64,
        t: f64,
        tolerance: Tolerance,
    ) -> Result<GeodesicEnd, LagrangianError> {
        let n = q.len();
        check_length("direction", n, direction.len())?;
        self.check_given([("q", q), ("direction", direction)], t)?;
        let squared = |q: &[f64], v: &[f64]| -> Result<f64, LagrangianError> {
            Ok(self.lower(q, v, t)?.iter().zip(v).map(|(p, v)| p * v).sum())
        };
        let squared_length = squared(q, direction)?;
        if !(0.0 < squared_length && squared_length < f64::INFINITY) {
            return Err(LagrangianError::NoDirection { squared_length });
        }
        let unit = direction.iter().map(|v| v / squared_length.sqrt());
        let stopped = |arc: f64, error: IntegratorsError| LagrangianError::Run {
            time: arc,
            source: Box::new(error.with_field_error()),
        };
        let mut state =
            State::new(0.0, q.iter().copied().chain(unit).collect()).map_err(|error| stopped(0.0, error))?;
        DormandPrince853::new(tolerance)
            .integrate_to(&mut self.geodesic_motion(n, t), &mut state, length)
            .map_err(|error| LagrangianError::Run { time: state.time, source: Box::new(error) })?;
        let (q, v) = state.values.split_at(n);
        let length_error = squared(q, v)? - 1.0;
        Ok(GeodesicEnd { coordinates: q.to_vec(), direction: v.to_vec(), length_error })
    }
}
