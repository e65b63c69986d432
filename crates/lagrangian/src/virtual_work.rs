//! Virtual work: what given forces do in the displacements that a constraint admits, and the test of an ideal
//! constraint.
//!
//! ```text
//! Q_Δ = Σ f·∂x/∂q^Δ + Σ F·∂ξ/∂q^Δ + Σ G·ω_Δ                                                  W(5.9)
//! ideal:  Σ f_c·∂x/∂q^Δ + Σ F_c·∂ξ/∂q^Δ + Σ G_c·ω_Δ = 0   for every Δ                        W(5.5–5.8)
//! ```
//!
//! A virtual displacement is taken at a fixed time: a moving constraint may be ideal and yet have power.

use nalgebra::{DVector, Vector3};
use piola_kinematics::{Attitude, Holonomic, Placement, RigidBody};
use piola_numerics::{Gradient, Real};

use super::collect::turning;
use super::directions::CHUNK;
use super::workspace::Workspace;
use super::{Forces, Lagrangian, PartForce, Potential};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

/// The power of constraint forces in the unit virtual displacement along each coordinate.
///
/// # Example
/// See [`Lagrangian::ideal_constraint_test`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct IdealConstraintTest {
    powers: Vec<f64>,
    scales: Vec<f64>,
}

/// Whether a constraint is ideal.
///
/// # Example
/// See [`Lagrangian::ideal_constraint_test`].
///
/// # Source
/// W(5.5).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum ConstraintVerdict {
    /// The forces have no power in any virtual displacement, to the tolerance asked for.
    Ideal,
    /// The forces have power: the constraint resists, as by friction, or drives.
    Working {
        /// The coordinate along which the power is largest against the terms it is summed of.
        coordinate: usize,
        /// W per unit of q̇.
        power: f64,
        /// The sum of the magnitudes of the terms, in the same unit.
        scale: f64,
    },
}

impl IdealConstraintTest {
    /// Σ f_c·h_Δ for each coordinate: N where the coordinate is a length, N m where it is an angle.
    ///
    /// # Source
    /// W(5.8).
    #[must_use]
    pub fn powers(&self) -> &[f64] {
        &self.powers
    }

    /// The sums of the magnitudes of the terms, against which the powers are small when the constraint is ideal.
    #[must_use]
    pub fn scales(&self) -> &[f64] {
        &self.scales
    }

    /// The coordinate along which the power is largest against its scale, and that ratio, which lies in [0, 1].
    /// `None` for a system without coordinates.
    #[must_use]
    pub fn worst(&self) -> Option<(usize, f64)> {
        let ratio = |(power, scale): (&f64, &f64)| if 0.0 < *scale { power.abs() / scale } else { 0.0 };
        let ratios = self.powers.iter().zip(&self.scales).map(ratio).enumerate();
        ratios.fold(None, |worst, next| match worst {
            Some((_, largest)) if next.1 <= largest => worst,
            _ => Some(next),
        })
    }

    /// The verdict: ideal when no power exceeds `tolerance` times its scale. A few dozen ulp times the condition
    /// number of the metric, scaled to unit diagonal, are what the reactions of an ideal constraint need.
    ///
    /// # Source
    /// W(5.5).
    #[must_use]
    pub fn verdict(&self, tolerance: f64) -> ConstraintVerdict {
        match self.worst() {
            // A tolerance that is no number tolerates nothing.
            Some((coordinate, ratio)) if tolerance < ratio || tolerance.is_nan() => {
                let (power, scale) = (self.powers[coordinate], self.scales[coordinate]);
                ConstraintVerdict::Working { coordinate, power, scale }
            }
            _ => ConstraintVerdict::Ideal,
        }
    }
}

/// Sums of terms, and of their magnitudes.
struct Sums<'a, T: Real> {
    given: core::slice::Iter<'a, PartForce<T>>,
    work: [T; CHUNK],
    scale: [T; CHUNK],
    parts: usize,
}

impl<T: Real> Sums<'_, T> {
    fn add(&mut self, component: T, partials: impl Fn(usize) -> T) {
        for i in 0..CHUNK {
            let term = component * partials(i);
            self.work[i] += term;
            self.scale[i] += term.abs();
        }
    }
    fn add_force(&mut self, force: &Vector3<T>, x: &Vector3<Gradient<T, CHUNK>>) {
        for k in 0..3 {
            self.add(force[k], |i| x[k].partials[i]);
        }
    }
}

impl<T: Real> Placement<Gradient<T, CHUNK>> for Sums<'_, T> {
    fn particle(&mut self, _mass: f64, position: Vector3<Gradient<T, CHUNK>>) {
        self.parts += 1;
        if let Some(given) = self.given.next() {
            self.add_force(&given.force, &position);
        }
    }
    fn body(&mut self, _body: &RigidBody, centre: Vector3<Gradient<T, CHUNK>>, attitude: Attitude<Gradient<T, CHUNK>>) {
        self.parts += 1;
        if let Some(given) = self.given.next() {
            self.add_force(&given.force, &centre);
            let quaternion = [attitude.w, attitude.x, attitude.y, attitude.z];
            let q = quaternion.map(|q| q.value);
            for i in 0..CHUNK {
                let turn = turning(q, quaternion.map(|q| q.partials[i]));
                for k in 0..3 {
                    let term = given.moment[k] * turn[k];
                    self.work[i] += term;
                    self.scale[i] += term.abs();
                }
            }
        }
    }
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The generalised forces of given forces and moments on the parts, in the order of placement.
    ///
    /// ```text
    /// Q_Δ = Σ f·∂x/∂q^Δ + Σ F·∂ξ/∂q^Δ + Σ G·ω_Δ
    /// ```
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | f, F; G | `forces` | one for each part | N; N m |
    /// | q, t | `q`, `t` | n, scalar | the coordinates' own, s |
    /// | Q_Δ | returned | n | J over the coordinate's unit |
    ///
    /// They are the components of a covector: in other coordinates Q̄_Δ = Q_Γ ∂q^Γ/∂q̄^Δ.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`] unless there is one force for each [part](Self::parts);
    /// [`LagrangianError::NotFinite`].
    ///
    /// # Accuracy
    /// A few ulp of the sum of the terms' magnitudes.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, PartForce, Placement};
    /// # use piola_numerics::Real;
    /// struct Polar; // q = [r, φ]
    /// impl Holonomic for Polar {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         let (s, c) = q[1].sin_cos();
    ///         bodies.particle(1.0, Vector3::new(q[0] * c, q[0] * s, T::zero()));
    ///     }
    /// }
    /// // 5 N across the ray at r = 2: no radial force, a moment of 10 N m.
    /// let work = Lagrangian::of(Polar).virtual_work(&[PartForce::force([0.0, 5.0, 0.0])], &[2.0, 0.0], 0.0)?;
    /// assert_eq!(work.as_slice(), [0.0, 10.0]);
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(5.9–5.12).
    pub fn virtual_work<T: Real>(&self, forces: &[PartForce<T>], q: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(q.len(), T::zero());
        self.virtual_work_into(&mut Workspace::default(), forces, q, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`virtual_work`](Self::virtual_work) to the caller's memory, without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`virtual_work`](Self::virtual_work).
    pub fn virtual_work_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        forces: &[PartForce<T>],
        q: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("Q", q.len(), out.len())?;
        self.one_force_each_part(forces, q, t)?;
        for (first, out) in (0..q.len()).step_by(CHUNK).zip(out.chunks_mut(CHUNK)) {
            let sums = self.virtual_work_along(work, forces, (q, t), first)?;
            out.copy_from_slice(&sums.work[..out.len()]);
        }
        for force in forces {
            check_finite("force", force.force.as_slice())?;
            check_finite("moment", force.moment.as_slice())?;
        }
        self.finite([("q", q), ("q", q)], t, ("Q", out))
    }

    /// Tests whether given constraint forces are those of an ideal constraint: whether they have no power in any
    /// virtual displacement.
    ///
    /// The [reactions](Self::reactions) of a system without potential and generalised forces pass to rounding;
    /// friction does not. Forces that are nothing but rounding have no meaningful scale: the reactions on a particle
    /// that is free, say. [`reaction_test`](Self::reaction_test) compares with what they are the difference of.
    ///
    /// # Errors
    /// As [`virtual_work`](Self::virtual_work).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{ConstraintVerdict, Holonomic, Lagrangian, PartForce, Placement};
    /// # use piola_numerics::Real;
    /// struct Slide; // a block on the axis x
    /// impl Holonomic for Slide {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         bodies.particle(1.0, Vector3::new(q[0], T::zero(), T::zero()));
    ///     }
    /// }
    /// let slide = Lagrangian::of(Slide);
    /// let smooth = slide.ideal_constraint_test(&[PartForce::force([0.0, 0.0, 8.0])], &[0.0], 0.0)?;
    /// assert_eq!(smooth.verdict(1e-12), ConstraintVerdict::Ideal);
    /// // A quarter of the normal force rubs.
    /// let rough = slide.ideal_constraint_test(&[PartForce::force([-2.0, 0.0, 8.0])], &[0.0], 0.0)?;
    /// assert_eq!(rough.verdict(1e-12), ConstraintVerdict::Working { coordinate: 0, power: -2.0, scale: 2.0 });
    /// assert_eq!((rough.powers(), rough.scales(), rough.worst()), (&[-2.0][..], &[2.0][..], Some((0, 1.0))));
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(5.5–5.8).
    pub fn ideal_constraint_test(
        &self,
        forces: &[PartForce],
        q: &[f64],
        t: f64,
    ) -> Result<IdealConstraintTest, LagrangianError> {
        self.check_given([("q", q), ("q", q)], t)?;
        self.one_force_each_part(forces, q, t)?;
        let mut work = Workspace::default();
        let (mut powers, mut scales) = (Vec::with_capacity(q.len()), Vec::with_capacity(q.len()));
        for first in (0..q.len()).step_by(CHUNK) {
            let sums = self.virtual_work_along(&mut work, forces, (q, t), first)?;
            let directions = CHUNK.min(q.len() - first);
            powers.extend_from_slice(&sums.work[..directions]);
            scales.extend_from_slice(&sums.scale[..directions]);
        }
        check_finite("power of the constraint forces", &powers)?;
        check_finite("power of the constraint forces", &scales)?;
        Ok(IdealConstraintTest { powers, scales })
    }

    /// Tests whether the reactions along the motion are those of an ideal constraint, against the inertia and the
    /// external forces that they are the difference of.
    ///
    /// What a potential and generalised forces do is in the reactions: the powers are then theirs. In a system
    /// without them the powers show how well Lagrange's equations have been solved.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    ///
    /// # Source
    /// W(5.5–5.8).
    pub fn reaction_test(&self, q: &[f64], v: &[f64], t: f64) -> Result<IdealConstraintTest, LagrangianError> {
        let mut work = Workspace::default();
        let (mut reactions, mut magnitudes) = (Vec::new(), Vec::new());
        self.with_acceleration(&mut work, q, v, t, |work, a| {
            self.tour(work, (q, v, a), t, |_part, part| {
                let mut reaction = PartForce::force(part.reaction());
                let size = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| -> [f64; 3] {
                    core::array::from_fn(|k| a[k].abs() + b[k].abs() + c[k].abs())
                };
                let mut magnitude = PartForce::force(size(part.inertia_force, part.weight, part.force));
                if let Some(turning) = part.turning {
                    reaction.moment = turning.reaction().into();
                    magnitude.moment = size(turning.inertia_moment, turning.moment, [0.0; 3]).into();
                }
                reactions.push(reaction);
                magnitudes.push(magnitude);
            })
        })?;
        let IdealConstraintTest { powers, .. } = self.ideal_constraint_test(&reactions, q, t)?;
        let IdealConstraintTest { scales, .. } = self.ideal_constraint_test(&magnitudes, q, t)?;
        Ok(IdealConstraintTest { powers, scales })
    }

    /// Without coordinates no pass would count the parts.
    fn one_force_each_part<T: Real>(&self, forces: &[PartForce<T>], q: &[T], t: T) -> Result<(), LagrangianError> {
        if q.is_empty() { check_length("forces", self.parts(q, t), forces.len()) } else { Ok(()) }
    }

    /// The virtual work along the coordinates from `first` on.
    fn virtual_work_along<'a, T: Real>(
        &self,
        work: &mut Workspace<T>,
        forces: &'a [PartForce<T>],
        (q, t): (&[T], T),
        first: usize,
    ) -> Result<Sums<'a, T>, LagrangianError> {
        work.coordinates.clear();
        work.coordinates.extend(q.iter().enumerate().map(|(i, &q)| Gradient::variable(q, i.wrapping_sub(first))));
        let zero = [T::zero(); CHUNK];
        let mut sums = Sums { given: forces.iter(), work: zero, scale: zero, parts: 0 };
        self.system.place(&work.coordinates, Gradient::constant(t), &mut sums);
        check_length("forces", sums.parts, forces.len())?;
        Ok(sums)
    }
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    powers: Vec<f64>,
    scales: Vec<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for IdealConstraintTest {
    type Error = LagrangianError;

    fn try_from(Unchecked { powers, scales }: Unchecked) -> Result<Self, LagrangianError> {
        check_length("scales", powers.len(), scales.len())?;
        check_finite("powers", &powers)?;
        check_finite("scales", &scales)?;
        Ok(Self { powers, scales })
    }
}
