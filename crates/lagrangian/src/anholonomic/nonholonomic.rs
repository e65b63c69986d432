//! Constraints on velocities: some quasi-velocities are held.

use nalgebra::DVector;
use piola_integrators::Field;
use piola_kinematics::Holonomic;
use piola_numerics::Real;

use super::workspace::Workspace;
use super::{InFrame, QuasiVelocities};
use crate::check::{check_finite, check_length};
use crate::{AnholonomicError, LagrangianError};
use crate::{Energies, Forces, Potential, Reaction};

/// A system some of whose quasi-velocities are held at zero, or at other constant values.
///
/// ```text
/// u^h = const        ḡ_αβ u̇^β = k_α·(f − M c)        R_h = k_h·(M q̈ − f)                         W(6.29)
/// ```
///
/// The free quasi-velocities w = (u^α) follow the equations of motion along their own vectors; those along the
/// vectors that are held give the reactions, which do no work in any admissible motion. The state has 2n − m
/// components, (q, w), for m conditions: no multipliers, no drift off the constraint.
///
/// Only the vectors k_α span what moves: coordinates may be redundant (four of a quaternion) when the
/// superfluous directions are held. A surface that moves is a drift of the frame.
///
/// # Example
/// A skate of 2 kg on ice that falls off along y with a pull of 3 m/s²: at φ = 0 the blade holds all of it.
/// ```
/// use nalgebra::Vector3;
/// use piola_lagrangian::anholonomic::Coframe;
/// use piola_lagrangian::{Holonomic, Lagrangian, Placement};
/// use piola_numerics::Real;
/// struct Skate; // q = [x, y, φ]: particles 1 m ahead and behind
/// impl Holonomic for Skate {
///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
///         let (s, c) = q[2].sin_cos();
///         bodies.particle(1.0, Vector3::new(q[0] + c, q[1] + s, T::zero()));
///         bodies.particle(1.0, Vector3::new(q[0] - c, q[1] - s, T::zero()));
///     }
/// }
/// impl Coframe for Skate { // u = (along, across, φ̇)
///     fn coframe<T: Real>(&self, q: &[T], _t: T, rows: &mut [T]) {
///         let ((s, c), zero) = (q[2].sin_cos(), T::zero());
///         rows.copy_from_slice(&[c, s, zero, -s, c, zero, zero, zero, T::one()]);
///     }
/// }
/// let on_ice = Lagrangian::of(Skate).with_uniform_gravity([0.0, -3.0, 0.0]).in_coframe(Skate).holding(&[1])?;
/// let (q, w) = ([0.0; 3], [5.0, 2.0]);
/// assert_eq!(on_ice.acceleration(&q, &w, 0.0)?.as_slice(), [0.0, 0.0]);
/// assert_eq!(on_ice.held(), [1]);
/// // It holds the weight 6 N and turns the momentum 10 kg m/s at 2 rad/s.
/// assert_eq!(on_ice.reactions(&q, &w, 0.0)?[0], 26.0);
/// assert_eq!(on_ice.coordinate_reactions(&q, &w, 0.0)?.as_slice(), [0.0, 26.0, 0.0]);
///
/// assert_eq!(on_ice.quasi_velocities(&q, &w)?.as_slice(), [5.0, 0.0, 2.0]);
/// assert_eq!(on_ice.velocities(&q, &w, 0.0)?.as_slice(), [5.0, 0.0, 2.0]);
/// assert_eq!(on_ice.coordinate_acceleration(&q, &w, 0.0)?.as_slice(), [0.0, 10.0, 0.0]); // v φ̇ across
/// assert_eq!(on_ice.energies(&q, &w, 0.0)?.kinetic, 29.0); // ½ 2·25 + ½ 2·4
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
///
/// # Source
/// W(6.29).
#[derive(Clone, Debug)]
pub struct Nonholonomic<S, P, F, W> {
    system: InFrame<S, P, F, W>,
    held: Vec<usize>,
    values: Vec<f64>,
}

impl<S, P, F, W> InFrame<S, P, F, W> {
    /// Holds the quasi-velocities of the given indices at zero.
    ///
    /// # Errors
    /// [`AnholonomicError::HeldTwice`]. An index beyond the last quasi-velocity is refused at evaluation, when
    /// their number is known.
    pub fn holding(self, held: &[usize]) -> Result<Nonholonomic<S, P, F, W>, LagrangianError> {
        let held: Vec<(usize, f64)> = held.iter().map(|&index| (index, 0.0)).collect();
        self.holding_at(&held)
    }

    /// Holds quasi-velocities at constant values: a motor that keeps its speed.
    ///
    /// # Errors
    /// [`AnholonomicError::HeldTwice`], [`LagrangianError::NotFinite`].
    pub fn holding_at(self, held: &[(usize, f64)]) -> Result<Nonholonomic<S, P, F, W>, LagrangianError> {
        let mut sorted = held.to_vec();
        sorted.sort_by_key(|&(index, _)| index);
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(LagrangianError::Anholonomic(AnholonomicError::HeldTwice { index: pair[0].0 }));
        }
        let (held, values): (Vec<_>, Vec<_>) = sorted.into_iter().unzip();
        check_finite("held quasi-velocities", &values)?;
        Ok(Nonholonomic { system: self, held, values })
    }
}

impl<S, P, F, W> Nonholonomic<S, P, F, W> {
    /// Indices known to increase, held at zero.
    pub(super) fn at_rest(system: InFrame<S, P, F, W>, held: &[usize]) -> Self {
        Self { system, held: held.to_vec(), values: vec![0.0; held.len()] }
    }
    /// The system with all its quasi-velocities.
    pub const fn unconstrained(&self) -> &InFrame<S, P, F, W> {
        &self.system
    }
    /// The indices held, increasing: the order of [`reactions`](Self::reactions).
    #[must_use]
    pub fn held(&self) -> &[usize] {
        &self.held
    }
}

impl<S: Holonomic, P: Potential, F: Forces, W: QuasiVelocities> Nonholonomic<S, P, F, W> {
    /// Forms u in `work` and solves.
    fn solve<T: Real>(&self, work: &mut Workspace<T>, q: &[T], w: &[T], t: T) -> Result<(), LagrangianError> {
        self.spread(work, q, w)?;
        self.system.solve(work, q, t)
    }

    /// All quasi-velocities from the free ones.
    pub(super) fn spread<T: Real>(&self, work: &mut Workspace<T>, q: &[T], w: &[T]) -> Result<(), LagrangianError> {
        let n = q.len();
        work.hold(n, &self.held)?;
        check_length("free quasi-velocities", n - self.held.len(), w.len())?;
        work.quasi.clear();
        let mut held = self.held.iter().zip(&self.values).peekable();
        let mut free = w.iter();
        for a in 0..n {
            let value = match held.next_if(|&(&index, _)| index == a) {
                Some((_, &value)) => T::lit(value),
                None => free.next().copied().unwrap_or_else(T::zero),
            };
            work.quasi.push(value);
        }
        Ok(())
    }

    /// All quasi-velocities u: the free ones and those held, each in its place.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`AnholonomicError::NoSuchQuasiVelocity`].
    pub fn quasi_velocities<T: Real>(&self, q: &[T], w: &[T]) -> Result<DVector<T>, LagrangianError> {
        let mut work = Workspace::default();
        self.spread(&mut work, q, w)?;
        Ok(DVector::from_column_slice(&work.quasi))
    }

    /// The velocities q̇ of free quasi-velocities w.
    ///
    /// # Errors
    /// As [`quasi_velocities`](Self::quasi_velocities) and [`InFrame::velocities`].
    pub fn velocities<T: Real>(&self, q: &[T], w: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        self.system.velocities(q, self.quasi_velocities(q, w)?.as_slice(), t)
    }

    /// Kinetic and potential energy.
    ///
    /// # Errors
    /// As [`velocities`](Self::velocities).
    pub fn energies<T: Real>(&self, q: &[T], w: &[T], t: T) -> Result<Energies<T>, LagrangianError> {
        self.system.energies(q, self.quasi_velocities(q, w)?.as_slice(), t)
    }

    /// The rates ẇ of the free quasi-velocities.
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | q | `q` | n | the coordinates' own |
    /// | w | `w` | n − m, in the order of the frame | the frame's own |
    /// | t | `t` | scalar | s |
    /// | ẇ | returned | n − m | those of w / s |
    ///
    /// # Errors
    /// As [`InFrame::acceleration`]; [`AnholonomicError::NoSuchQuasiVelocity`].
    pub fn acceleration<T: Real>(&self, q: &[T], w: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut work = Workspace::default();
        self.solve(&mut work, q, w, t)?;
        Ok(DVector::from_column_slice(&work.rates))
    }

    /// [`acceleration`](Self::acceleration) to the caller's memory, without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    ///
    /// # Example
    /// ```
    /// use piola_lagrangian::anholonomic::{Workspace, rolling::KnifeEdge};
    /// let blade = KnifeEdge::new(1.0, 0.1, 0.0)?.on_plane([8.0, 0.0, -6.0]);
    /// let (mut work, mut rates) = (Workspace::default(), [0.0; 2]);
    /// blade.acceleration_into(&mut work, &[0.0; 3], &[1.0, 2.0], 0.0, &mut rates)?;
    /// assert_eq!(rates, [8.0, 0.0]);
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    pub fn acceleration_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        w: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        self.solve(work, q, w, t)?;
        check_length("ẇ", work.rates.len(), out.len())?;
        out.copy_from_slice(&work.rates);
        Ok(())
    }

    /// The accelerations q̈ of the coordinates.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn coordinate_acceleration<T: Real>(&self, q: &[T], w: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut work = Workspace::default();
        self.solve(&mut work, q, w, t)?;
        work.form_coordinate_acceleration();
        Ok(DVector::from_column_slice(&work.acceleration))
    }

    /// The generalised reactions R_h along the vectors that are held: what the unused equations leave over.
    ///
    /// R_h u^h is the power at which the constraint would work if it gave way.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    ///
    /// # Source
    /// W(6.29).
    pub fn reactions<T: Real>(&self, q: &[T], w: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(self.held.len(), T::zero());
        self.reactions_into(&mut Workspace::default(), q, w, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`reactions`](Self::reactions) to the caller's memory, without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn reactions_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        w: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("reactions", self.held.len(), out.len())?;
        self.solve(work, q, w, t)?;
        work.form_coordinate_acceleration();
        work.form_reaction();
        work.reactions_into(out);
        Ok(())
    }

    /// The reactions in the coordinates, R_C = M_CD q̈^D − f_C: no work in any admissible motion, k_α·R = 0.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn coordinate_reactions<T: Real>(&self, q: &[T], w: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut work = Workspace::default();
        self.solve(&mut work, q, w, t)?;
        work.form_coordinate_acceleration();
        work.form_reaction();
        Ok(DVector::from_column_slice(work.reaction()))
    }

    /// The forces that hold each particle and body, in the order of placement: those of the placement and of the
    /// velocity constraint together, W(5.1–5.3).
    ///
    /// Of a single body that rolls, the force is that of the contact.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    ///
    /// # Source
    /// W(5.1–5.3).
    pub fn part_reactions<T: Real>(&self, q: &[T], w: &[T], t: T) -> Result<Vec<Reaction<T>>, LagrangianError> {
        let mut out = vec![Reaction::none(); self.system.lagrangian().parts(q, t)];
        self.part_reactions_into(&mut Workspace::default(), q, w, t, &mut out)?;
        Ok(out)
    }

    /// [`part_reactions`](Self::part_reactions) to the caller's memory, without allocation once `work` has been
    /// used.
    ///
    /// # Errors
    /// As [`part_reactions`](Self::part_reactions); [`LagrangianError::WrongLength`] when `out` does not have
    /// one place for each part.
    pub fn part_reactions_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        w: &[T],
        t: T,
        out: &mut [Reaction<T>],
    ) -> Result<(), LagrangianError> {
        self.solve(work, q, w, t)?;
        work.form_coordinate_acceleration();
        let Workspace { lagrangian, velocity, acceleration, .. } = work;
        self.system.lagrangian().reactions_at_acceleration_into(lagrangian, q, velocity, acceleration, t, out)
    }

    /// The motion of n coordinates as a field in y = (q, w).
    ///
    /// # Example
    /// A blade on an incline, started at rest and turning with 2 rad/s, draws cycloids: it does not run away down the
    /// incline, but sideways.
    /// ```
    /// use piola_lagrangian::anholonomic::rolling::KnifeEdge;
    /// use piola_integrators::{DormandPrince853, State, Tolerance};
    /// let blade = KnifeEdge::new(1.0, 0.1, 0.0)?.on_plane([8.0, 0.0, -6.0]); // 8 m/s² down along x
    /// let mut state = State::new(0.0, vec![0.0_f64, 0.0, 0.0, 0.0, 2.0])?; // x, y, φ, speed, φ̇
    /// let mut method = DormandPrince853::new(Tolerance::relative(1e-12)?);
    /// method.integrate_to(&mut blade.motion(3), &mut state, std::f64::consts::PI)?;
    /// // After a full turn: x = 0, y = 8/(2·2²) · 2π
    /// assert!(state.values[0].abs() < 1e-10 && (state.values[1] - 2.0 * std::f64::consts::PI).abs() < 1e-10);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn motion<T: Real>(&self, coordinates: usize) -> ConstrainedMotion<'_, S, P, F, W, T> {
        ConstrainedMotion { system: self, coordinates, work: Workspace::default() }
    }
}

/// The motion in coordinates and free quasi-velocities, y = (q, w).
///
/// # Example
/// See [`Nonholonomic::motion`].
#[derive(Clone, Debug)]
pub struct ConstrainedMotion<'a, S, P, F, W, T = f64> {
    system: &'a Nonholonomic<S, P, F, W>,
    coordinates: usize,
    work: Workspace<T>,
}

impl<S, P, F, W, T> Field<T> for ConstrainedMotion<'_, S, P, F, W, T>
where
    S: Holonomic,
    P: Potential,
    F: Forces,
    W: QuasiVelocities,
    T: Real,
{
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        (2 * self.coordinates).saturating_sub(self.system.held.len())
    }
    #[inline]
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), LagrangianError> {
        let (q, w) = y.split_at(self.coordinates);
        let (velocity, rates) = rate.split_at_mut(self.coordinates);
        self.system.acceleration_into(&mut self.work, q, w, T::lit(t), rates)?;
        velocity.copy_from_slice(&self.work.velocity);
        Ok(())
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        let (q, w) = y.split_at(self.coordinates);
        let (of_q, of_w) = magnitudes.split_at_mut(self.coordinates);
        for (values, magnitudes) in [(q, of_q), (w, of_w)] {
            let lanes = values.iter().flat_map(|x| (0..T::LANES).map(|lane| x.primal(lane).abs()));
            magnitudes.fill(lanes.fold(0.0, |largest, x| if x <= largest || largest.is_nan() { largest } else { x }));
        }
    }
}
