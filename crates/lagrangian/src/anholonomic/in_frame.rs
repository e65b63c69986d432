//! Equations of motion in quasi-velocities.

use nalgebra::{DMatrix, DVector};
use piola_integrators::Field;
use piola_kinematics::Holonomic;
use piola_numerics::Real;

use super::workspace::Workspace;
use super::{AnholonomicFrame, ByCoframe, ByFrame, Coframe, QuasiVelocities};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};
use crate::{Energies, Forces, Lagrangian, Potential};

/// A Lagrangian system whose velocities are told by quasi-velocities.
///
/// # Example
/// A particle of 2 kg in polar components, u = (ṙ, r φ̇): on a circle of 0.5 m at 3 m/s, without force,
/// r̈ = u₂²/r. The rate of the transverse component is −u₁u₂/r.
/// ```
/// use nalgebra::Vector3;
/// use piola_lagrangian::anholonomic::AnholonomicFrame;
/// use piola_lagrangian::{Holonomic, Lagrangian, Placement};
/// use piola_numerics::Real;
/// struct Polar; // q = [r, φ]
/// impl Holonomic for Polar {
///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
///         let (s, c) = q[1].sin_cos();
///         bodies.particle(2.0, Vector3::new(q[0] * c, q[0] * s, T::zero()));
///     }
/// }
/// impl AnholonomicFrame for Polar {
///     fn frame<T: Real>(&self, q: &[T], _t: T, rows: &mut [T]) {
///         let zero = T::zero();
///         rows.copy_from_slice(&[T::one(), zero, zero, q[0].recip()]);
///     }
/// }
/// let particle = Lagrangian::of(Polar).in_frame(Polar);
/// let (q, u) = ([0.5, 0.0], [1.0, 3.0]);
/// assert_eq!(particle.acceleration(&q, &u, 0.0)?.as_slice(), [18.0, -6.0]);
/// // φ̈ = −2 ṙφ̇/r
/// assert_eq!(particle.coordinate_acceleration(&q, &u, 0.0)?.as_slice(), [18.0, -24.0]);
///
/// assert_eq!(particle.velocities(&q, &u, 0.0)?.as_slice(), [1.0, 6.0]); // φ̇ = u₂/r
/// assert_eq!(particle.quasi_velocities(&q, &[1.0, 6.0], 0.0)?.as_slice(), u);
/// assert_eq!(particle.frame_matrix(&q, 0.0)?[(1, 1)], 2.0);
/// assert_eq!(particle.coframe_matrix(&q, 0.0)?[(1, 1)], 0.5);
/// assert_eq!(particle.inertia_metric(&q, 0.0)?[(1, 1)], 2.0); // ḡ = m δ
/// assert_eq!(particle.momenta(&q, &u, 0.0)?.as_slice(), [2.0, 6.0]);
/// assert_eq!(particle.generalised_forces(&q, &u, 0.0)?.as_slice(), [0.0, 0.0]);
/// assert_eq!(particle.energies(&q, &u, 0.0)?.kinetic, 10.0);
/// let terms = particle.boltzmann_hamel(&q, &u, &[18.0, -6.0], 0.0)?; // m (u̇₂ + u₁u₂/r) = 0
/// assert_eq!((terms.momentum_rate[1], terms.structure_term[1], terms.residual()[1]), (-12.0, 12.0, 0.0));
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
///
/// # Source
/// W(6.12–6.29).
#[derive(Clone, Debug)]
pub struct InFrame<S, P, F, W> {
    lagrangian: Lagrangian<S, P, F>,
    map: W,
}

impl<S, P, F> Lagrangian<S, P, F> {
    /// The system in the quasi-velocities of a frame.
    pub const fn in_frame<K: AnholonomicFrame>(self, frame: K) -> InFrame<S, P, F, ByFrame<K>> {
        InFrame { lagrangian: self, map: ByFrame(frame) }
    }

    /// The system in quasi-velocities that are given themselves.
    pub const fn in_coframe<C: Coframe>(self, coframe: C) -> InFrame<S, P, F, ByCoframe<C>> {
        InFrame { lagrangian: self, map: ByCoframe(coframe) }
    }
}

impl<S, P, F, W> InFrame<S, P, F, W> {
    /// The Lagrangian.
    pub const fn lagrangian(&self) -> &Lagrangian<S, P, F> {
        &self.lagrangian
    }
    /// The quasi-velocities.
    pub const fn map(&self) -> &W {
        &self.map
    }
}

/// K^C_AB as n matrices, `[C][(A, B)]`: the structure coefficients of a frame.
///
/// ```text
/// [k_A, k_B] = K^C_AB k_C,        [k_A, k_B]^D = k_A^E ∂k_B^D/∂q^E − k_B^E ∂k_A^D/∂q^E            W(6.13)
/// ```
///
/// By exact derivatives along the vectors of the frame; antisymmetric in A and B to the last bit. They vanish
/// where, and only where, the quasi-velocities are rates of coordinates.
///
/// # Errors
/// [`AnholonomicError::SingularFrame`](crate::AnholonomicError::SingularFrame), [`LagrangianError::NotFinite`].
///
/// # Accuracy
/// A few ulp of the terms of the bracket times the condition number of the frame.
///
/// # Example
/// ```
/// use piola_lagrangian::anholonomic::{AnholonomicFrame, ByFrame, structure_coefficients};
/// use piola_numerics::Real;
/// struct Polar; // ∂_r and ∂_φ/r
/// impl AnholonomicFrame for Polar {
///     fn frame<T: Real>(&self, q: &[T], _t: T, rows: &mut [T]) {
///         rows.copy_from_slice(&[T::one(), T::zero(), T::zero(), q[0].recip()]);
///     }
/// }
/// // [k₁, k₂] = −∂_φ/r² = −k₂/r
/// let k = structure_coefficients(&ByFrame(Polar), &[0.5, 0.0], 0.0)?;
/// assert_eq!((k[1][(0, 1)], k[1][(1, 0)], k[0][(0, 1)]), (-2.0, 2.0, 0.0));
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
///
/// # Source
/// W(6.13).
pub fn structure_coefficients<W: QuasiVelocities, T: Real>(
    map: &W,
    q: &[T],
    t: T,
) -> Result<Vec<DMatrix<T>>, LagrangianError> {
    let n = q.len();
    let all = structure(map, q, t)?;
    Ok((0..n).map(|c| DMatrix::from_fn(n, n, |a, b| all[c + n * (b + (n + 1) * a)])).collect())
}

/// K^C_A0, `[(C, A)]`: how drift and time spoil the frame.
///
/// ```text
/// [k_A, ∂_t + d] = K^C_A0 k_C
/// ```
///
/// # Errors
/// As [`structure_coefficients`].
pub fn drift_coefficients<W: QuasiVelocities, T: Real>(map: &W, q: &[T], t: T) -> Result<DMatrix<T>, LagrangianError> {
    let n = q.len();
    let all = structure(map, q, t)?;
    Ok(DMatrix::from_fn(n, n, |c, a| all[c + n * (n + (n + 1) * a)]))
}

fn structure<W: QuasiVelocities, T: Real>(map: &W, q: &[T], t: T) -> Result<Vec<T>, LagrangianError> {
    let mut work = super::map::Map::default();
    let mut all = Vec::new();
    check_finite("q", q)?;
    check_finite("t", &[t])?;
    work.evaluate(map, q, t)?;
    work.structure_into(map, q, t, &mut all)?;
    check_finite("structure coefficients", &all)?;
    Ok(all)
}

impl<S: Holonomic, P: Potential, F: Forces, W: QuasiVelocities> InFrame<S, P, F, W> {
    /// The velocities q̇ = k_A u^A + d.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`]; [`AnholonomicError::SingularFrame`](crate::AnholonomicError::SingularFrame) where
    /// a coframe has no inverse.
    pub fn velocities<T: Real>(&self, q: &[T], u: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(q.len(), T::zero());
        self.velocities_into(&mut Workspace::default(), q, u, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`velocities`](Self::velocities) to the caller's memory.
    ///
    /// # Errors
    /// As [`velocities`](Self::velocities).
    pub fn velocities_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        u: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("u", q.len(), u.len())?;
        check_length("q̇", q.len(), out.len())?;
        for (quantity, values) in [("q", q), ("u", u), ("t", &[t])] {
            check_finite(quantity, values)?;
        }
        work.map.evaluate(&self.map, q, t)?;
        work.map.velocities_into(u, out);
        check_finite("q̇", out)
    }

    /// The quasi-velocities u of the velocities q̇.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`]; [`AnholonomicError::SingularFrame`](crate::AnholonomicError::SingularFrame) where
    /// the frame does not span the velocities.
    pub fn quasi_velocities<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        check_length("q̇", q.len(), v.len())?;
        for (quantity, values) in [("q", q), ("q̇", v), ("t", &[t])] {
            check_finite(quantity, values)?;
        }
        let mut work = Workspace::default();
        let mut out = DVector::from_element(q.len(), T::zero());
        work.map.evaluate(&self.map, q, t)?;
        work.map.quasi_velocities_into::<W>(v, out.as_mut_slice())?;
        check_finite("u", out.as_slice())?;
        Ok(out)
    }

    /// k_A^C, entry `(A, C)`.
    ///
    /// # Errors
    /// [`LagrangianError::NotFinite`]; [`AnholonomicError::SingularFrame`](crate::AnholonomicError::SingularFrame) where a coframe has no inverse.
    pub fn frame_matrix<T: Real>(&self, q: &[T], t: T) -> Result<DMatrix<T>, LagrangianError> {
        let n = q.len();
        check_finite("q", q)?;
        let mut work = Workspace::default();
        work.map.evaluate(&self.map, q, t)?;
        check_finite("frame", &work.map.frame)?;
        Ok(DMatrix::from_row_slice(n, n, &work.map.frame))
    }

    /// A^A_C of u^A = A^A_C q̇^C, entry `(A, C)`: the inverse of the transposed [`frame_matrix`](Self::frame_matrix).
    ///
    /// # Errors
    /// [`LagrangianError::NotFinite`], [`AnholonomicError::SingularFrame`](crate::AnholonomicError::SingularFrame).
    pub fn coframe_matrix<T: Real>(&self, q: &[T], t: T) -> Result<DMatrix<T>, LagrangianError> {
        let n = q.len();
        check_finite("q", q)?;
        let mut work = Workspace::default();
        let mut rows = vec![T::zero(); n * n];
        work.map.evaluate(&self.map, q, t)?;
        work.map.coframe_into::<W>(n, &mut rows)?;
        check_finite("coframe", &rows)?;
        Ok(DMatrix::from_row_slice(n, n, &rows))
    }

    /// The inertia metric of the quasi-velocities, ḡ_AB = k_A^C k_B^D g_CD.
    ///
    /// # Errors
    /// As [`frame_matrix`](Self::frame_matrix); [`LagrangianError::NoParts`] for a system given by its Lagrangian
    /// function.
    ///
    /// # Source
    /// W(6.15).
    pub fn inertia_metric<T: Real>(&self, q: &[T], t: T) -> Result<DMatrix<T>, LagrangianError> {
        let frame = self.frame_matrix(q, t)?;
        Ok(&frame * self.lagrangian.inertia_metric(q, t)? * frame.transpose())
    }

    /// The momenta p̄_A = ∂L̄/∂u^A = k_A^C ∂L/∂q̇^C.
    ///
    /// # Errors
    /// As [`velocities`](Self::velocities).
    ///
    /// # Source
    /// W(6.29).
    pub fn momenta<T: Real>(&self, q: &[T], u: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let v = self.velocities(q, u, t)?;
        let momenta = self.lagrangian.momenta(q, v.as_slice(), t)?;
        Ok(self.frame_matrix(q, t)? * momenta)
    }

    /// The applied forces along the frame, Ω_A = k_A^C Q_C; gravity and the potential are not among them.
    ///
    /// # Errors
    /// As [`velocities`](Self::velocities).
    ///
    /// # Source
    /// W(6.21).
    pub fn generalised_forces<T: Real>(&self, q: &[T], u: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let v = self.velocities(q, u, t)?;
        let forces = self.lagrangian.generalised_forces(q, v.as_slice(), t)?;
        Ok(self.frame_matrix(q, t)? * forces)
    }

    /// Kinetic and potential energy.
    ///
    /// # Errors
    /// As [`velocities`](Self::velocities).
    pub fn energies<T: Real>(&self, q: &[T], u: &[T], t: T) -> Result<Energies<T>, LagrangianError> {
        let v = self.velocities(q, u, t)?;
        self.lagrangian.energies(q, v.as_slice(), t)
    }

    /// The rates u̇ that the equations of motion give.
    ///
    /// ```text
    /// ḡ_AB u̇^B = k_A^C (f_C − M_CD (u^B k̇_B + ḋ)^D)
    /// ```
    ///
    /// with the mass matrix M and the forcing f of Lagrange's equations. No structure coefficients are formed:
    /// the derivative of the frame along the motion is enough. The result is that of the Boltzmann–Hamel
    /// equations, [`boltzmann_hamel`](Self::boltzmann_hamel).
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | q, u | `q`, `u` | n | the coordinates' and the frame's own |
    /// | t | `t` | scalar | s |
    /// | u̇ | returned | n | those of u / s |
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`], [`LagrangianError::SingularMetric`],
    /// [`AnholonomicError::SingularFrame`](crate::AnholonomicError::SingularFrame).
    ///
    /// # Accuracy
    /// A few ulp times the condition number of ḡ, scaled to unit diagonal, times that of the frame.
    ///
    /// # Source
    /// W(6.29).
    pub fn acceleration<T: Real>(&self, q: &[T], u: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(q.len(), T::zero());
        self.acceleration_into(&mut Workspace::default(), q, u, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`acceleration`](Self::acceleration) to the caller's memory, without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn acceleration_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        u: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("u", q.len(), u.len())?;
        check_length("u̇", q.len(), out.len())?;
        work.hold(q.len(), &[])?;
        work.quasi.clear();
        work.quasi.extend_from_slice(u);
        self.solve(work, q, t)?;
        out.copy_from_slice(&work.rates);
        Ok(())
    }

    /// The accelerations q̈ of the coordinates along the same motion.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn coordinate_acceleration<T: Real>(&self, q: &[T], u: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut work = Workspace::default();
        let mut rates = vec![T::zero(); q.len()];
        self.acceleration_into(&mut work, q, u, t, &mut rates)?;
        work.form_coordinate_acceleration();
        Ok(DVector::from_column_slice(&work.acceleration))
    }

    /// The motion of n coordinates as a field in y = (q, u).
    pub fn motion<T: Real>(&self, coordinates: usize) -> QuasiMotion<'_, S, P, F, W, T> {
        QuasiMotion { system: self, coordinates, work: Workspace::default() }
    }
}

/// The motion in coordinates and quasi-velocities, y = (q, u).
///
/// # Example
/// See [`Nonholonomic::motion`](super::Nonholonomic::motion).
#[derive(Clone, Debug)]
pub struct QuasiMotion<'a, S, P, F, W, T = f64> {
    system: &'a InFrame<S, P, F, W>,
    coordinates: usize,
    work: Workspace<T>,
}

impl<S: Holonomic, P: Potential, F: Forces, W: QuasiVelocities, T: Real> Field<T> for QuasiMotion<'_, S, P, F, W, T> {
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        2 * self.coordinates
    }
    #[inline]
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), LagrangianError> {
        let (q, u) = y.split_at(self.coordinates);
        let (velocity, rates) = rate.split_at_mut(self.coordinates);
        self.system.acceleration_into(&mut self.work, q, u, T::lit(t), rates)?;
        velocity.copy_from_slice(&self.work.velocity);
        Ok(())
    }
}
