//! Families whose constants depend on time.

use nalgebra::Vector3;
use piola_fields::{Coordinates, FieldsError, Motion, Residual, VectorResidual};
use piola_numerics::{Gradient, Jet, Real};

use crate::error::{check_bound, check_finite};
use crate::families::{Datum, Family, FromCartesian, LocalStress, at_normal_stress};
use crate::{ResponseFunctions, SolutionsError};

/// A condition on the constants, such as `B Ċ = C Ḃ`, with its left side less its right.
pub type NamedCondition = (&'static str, Residual);

/// Share of the terms of a condition that may be left by rounding.
const ROUNDING: f64 = 1e-12;

/// A sum with the moduli of its terms.
pub(super) fn sum(terms: &[f64]) -> Residual {
    terms.iter().copied().fold(Residual::zero(), Residual::plus)
}

/// Refuses constants whose values or rates are not finite.
pub(super) fn check_jets(constants: &[Jet<f64, 0>]) -> Result<(), SolutionsError> {
    constants.iter().try_for_each(|jet| check_finite("constants", &[jet.value, jet.rate, jet.second_rate]))
}

fn holds((_, residual): &NamedCondition) -> bool {
    residual.relative() <= ROUNDING
}

/// Whether all conditions hold to the rounding of their terms.
pub(super) fn all_hold(conditions: &[NamedCondition]) -> bool {
    conditions.iter().all(holds)
}

/// Refuses a motion at a time by the first condition that it violates.
pub(super) fn check_conditions(conditions: &[NamedCondition], t: f64) -> Result<(), SolutionsError> {
    match conditions.iter().find(|condition| !holds(condition)) {
        None => Ok(()),
        Some(&(condition, Residual { value: residual, scale })) => {
            Err(SolutionsError::NoPotential { condition, residual, scale, t })
        }
    }
}

/// A family of universal deformations whose constants depend on time.
///
/// # Errors
/// All methods that return a `Result`: those of [`Family`] at each time; [`SolutionsError::NoPotential`] where the
/// acceleration has no potential.
///
/// # Accuracy
/// Rates are exact derivatives: a few ulp of the largest term.
///
/// # Example
/// See [`MovingSector`](super::MovingSector).
pub trait MovingFamily {
    /// The family at one time.
    type Family: Family;

    /// The coordinates of the place of a particle, m or rad.
    #[must_use]
    fn place<T: Real>(&self, reference: [T; 3], t: T) -> [T; 3];

    /// The deformation at a time.
    ///
    /// # Errors
    /// See [the trait](MovingFamily#errors).
    fn at(&self, t: f64) -> Result<Self::Family, SolutionsError>;

    /// ζ, m²/s², of a = −grad ζ, at coordinates of a place.
    ///
    /// # Errors
    /// See [the trait](MovingFamily#errors).
    fn potential<T: Real>(&self, place: [T; 3], t: f64) -> Result<T, SolutionsError>;

    /// The acceleration of a particle in physical components, m/s²: the second derivative of its place in time.
    ///
    /// # Errors
    /// See [the trait](MovingFamily#errors).
    fn acceleration(&self, reference: [f64; 3], t: f64) -> Result<[f64; 3], SolutionsError> {
        self.at(t)?.check_domain(reference)?;
        let time = Jet::<f64, 0>::time(t);
        let coordinates = Vector3::from(self.place(reference.map(Real::lit), time));
        let system = <Self::Family as Family>::Current::default();
        let acceleration = system.place(&coordinates).map(|x| x.second_rate);
        let frame = system.physical_frame(&coordinates.map(|q| q.value))?;
        let acceleration: [f64; 3] = frame.vector_from_cartesian(&acceleration).into();
        check_finite("acceleration", &acceleration)?;
        Ok(acceleration)
    }

    /// p and T at a particle: those of the deformation at rest, with p greater by ρ (ζ − ζ₀), ζ₀ at the datum.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | ρ | `density` | kg/m³ |
    /// | T₁₁ at one particle | `datum` | Pa |
    ///
    /// # Errors
    /// See [the trait](MovingFamily#errors).
    fn stress(
        &self,
        law: &impl ResponseFunctions,
        density: f64,
        datum: &Datum,
        reference: [f64; 3],
        t: f64,
    ) -> Result<LocalStress, SolutionsError> {
        check_bound("density", density, "0 ≤ ρ", 0.0 <= density)?;
        let family = self.at(t)?;
        let at_rest = family.stress(law, datum, reference)?;
        let zeta = |particle| self.potential(family.place(particle), t);
        let inertia = density * (zeta(reference)? - zeta(datum.reference)?);
        let normal = at_rest.cauchy.0.components[0] - inertia;
        Ok(at_normal_stress(&family.deformation(reference)?.extra_stress(law), normal))
    }

    /// div T − ρ a, N/m³, in physical components, with the sum of the moduli of its terms.
    ///
    /// # Errors
    /// See [the trait](MovingFamily#errors).
    fn momentum_residual(
        &self,
        law: &impl ResponseFunctions,
        density: f64,
        datum: &Datum,
        reference: [f64; 3],
        t: f64,
    ) -> Result<VectorResidual, SolutionsError> {
        check_bound("density", density, "0 ≤ ρ", 0.0 <= density)?;
        let family = self.at(t)?;
        let VectorResidual { mut value, mut scale } = family.equilibrium_residual(law, datum, reference)?;
        let place = family.place(reference);
        let slopes = self.potential(core::array::from_fn(|i| Gradient::<f64, 3>::variable(place[i], i)), t)?.partials;
        let lengths = <Self::Family as Family>::Current::default().scale_factors(&Vector3::from(place))?;
        let acceleration = self.acceleration(reference, t)?;
        for i in 0..3 {
            let terms = [density * slopes[i] / lengths[i], density * acceleration[i]];
            value[i] -= terms[0] + terms[1];
            scale[i] += terms[0].abs() + terms[1].abs();
        }
        Ok(VectorResidual { value, scale })
    }
}

/// A [`MovingFamily`] as a motion x(X, t) in Cartesian coordinates.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::Motion;
/// use piola_numerics::Real;
/// use piola_solutions::dynamics::{AsMovingMotion, MovingSphere, SphereHistory};
/// use piola_solutions::families::Orientation;
/// struct Growth;
/// impl SphereHistory for Growth {
///     fn constant<T: Real>(&self, t: T) -> T {
///         T::lit(7.0) * t
///     }
/// }
/// let growth = AsMovingMotion(MovingSphere { orientation: Orientation::Kept, history: Growth });
/// // r³ = 1 + 7 t: at t = 1, r = 2 and ṙ = 7/(3 r²).
/// let v = growth.velocity(&Vector3::new(1.0, 0.0, 0.0), 1.0)?;
/// assert!((v.x - 7.0 / 12.0).abs() < 1e-15);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AsMovingMotion<M>(pub M);

impl<M: MovingFamily> Motion for AsMovingMotion<M> {
    fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        let particle = <M::Family as Family>::Reference::of_place((*reference).into());
        <M::Family as Family>::Current::default().place(&Vector3::from(self.0.place(particle, t)))
    }

    fn check_domain<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<(), FieldsError> {
        for lane in 0..T::LANES {
            let at: [f64; 3] = <M::Family as Family>::Reference::of_place(reference.map(|x| x.primal(lane)).into());
            let found = self.0.at(t.primal(lane)).and_then(|family| family.check_domain(at));
            found.map_err(|_| FieldsError::SingularCoordinates { coordinates: at, volume_element: 0.0 })?;
        }
        Ok(())
    }
}
