//! A motion seen from space.

use nalgebra::Vector3;
use piola_numerics::linear::matrix3::inverse_and_determinant;
use piola_numerics::{Dual, Real};

use super::{Inversion, Material, Preimage};
use crate::FieldsError;
use crate::field::{Field, ValueOf, finite, local_rate, value_and_partials};
use crate::motion::{Motion, kernels};
use crate::value::{FieldValue, map};

/// A motion evaluated at places x: each method inverts the motion first.
///
/// # Errors
/// Every method: as [`Inversion::preimage_near`], and [`FieldsError::NotFinite`] for a result.
///
/// # Example
/// The steady turn at the rate ω = 1: whatever particle is at x, its velocity is ω × x.
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::{Eulerian, Rigid, RigidHistory};
/// use piola_numerics::Real;
/// struct Spin;
/// impl RigidHistory for Spin {
///     fn attitude<T: Real>(&self, t: T) -> [T; 4] {
///         let (s, c) = (T::lit(0.5) * t).sin_cos();
///         [c, T::lit(0.0), T::lit(0.0), s]
///     }
/// }
/// let velocity = Eulerian::new(Rigid(Spin)).velocity(&Vector3::new(2.0, 0.0, 0.0), 7.0)?;
/// assert!((velocity - Vector3::new(0.0, 2.0, 0.0)).amax() < 1e-14);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Eulerian<M> {
    /// x(X, t).
    pub motion: M,
    /// How it is inverted.
    pub inversion: Inversion,
}

impl<M: Motion> Eulerian<M> {
    /// A motion seen from space, inverted as usual.
    #[must_use]
    pub fn new(motion: M) -> Self {
        Self { motion, inversion: Inversion::default() }
    }

    /// X(x, t) with its certificate.
    ///
    /// # Errors
    /// See [the type](Eulerian#errors).
    pub fn preimage<T: Real>(&self, place: &Vector3<T>, t: T) -> Result<Preimage<T>, FieldsError> {
        self.inversion.preimage(&self.motion, place, t)
    }

    /// u(x, t) = x − X(x, t), m, B(4.15): the displacement in the Eulerian frame, from the motion's own
    /// displacement, without cancellation where the motion states it.
    ///
    /// # Errors
    /// See [the type](Eulerian#errors).
    pub fn displacement<T: Real>(&self, place: &Vector3<T>, t: T) -> Result<Vector3<T>, FieldsError> {
        let reference = self.preimage(place, t)?.reference;
        finite::<Vector3<f64>, T>("displacement", self.motion.displacement(&reference, t))
    }

    /// v(x, t), m/s: the velocity of the particle at x.
    ///
    /// # Errors
    /// See [the type](Eulerian#errors).
    pub fn velocity<T: Real>(&self, place: &Vector3<T>, t: T) -> Result<Vector3<T>, FieldsError> {
        let reference = self.preimage(place, t)?.reference;
        finite::<Vector3<f64>, T>("velocity", kernels::velocity(&self.motion, &reference, t))
    }

    /// a(x, t), m/s²: the acceleration of the particle at x.
    ///
    /// # Errors
    /// See [the type](Eulerian#errors).
    pub fn acceleration<T: Real>(&self, place: &Vector3<T>, t: T) -> Result<Vector3<T>, FieldsError> {
        let reference = self.preimage(place, t)?.reference;
        finite::<Vector3<f64>, T>("acceleration", kernels::acceleration(&self.motion, &reference, t))
    }

    /// Ψ(x, t) = Ψ(X(x, t), t): a field of particles in the Eulerian frame, B(4.14).
    ///
    /// # Errors
    /// See [the type](Eulerian#errors).
    pub fn field<F: Field, T: Real>(
        &self,
        field: &Material<F>,
        place: &Vector3<T>,
        t: T,
    ) -> Result<ValueOf<F, T>, FieldsError> {
        let reference = self.preimage(place, t)?.reference;
        finite::<F::Value, T>("field", field.0.at(&reference, t))
    }

    /// ∂Ψ/∂xⱼ of a field of particles, (Grad Ψ) F⁻¹, per metre.
    ///
    /// # Errors
    /// See [the type](Eulerian#errors).
    pub fn gradient<F: Field, T: Real>(
        &self,
        field: &Material<F>,
        place: &Vector3<T>,
        t: T,
    ) -> Result<[ValueOf<F, T>; 3], FieldsError> {
        let reference = self.preimage(place, t)?.reference;
        let inverse = inverse_and_determinant(kernels::gradient(&self.motion, &reference, t)).0;
        let partials = value_and_partials(&field.0, &reference, t).1;
        let partial = |j: usize| {
            finite::<F::Value, T>(
                "grad",
                F::Value::from_components(|i| {
                    let along = |a: usize| F::Value::component(&partials[a], i) * inverse[a][j];
                    along(0) + along(1) + along(2)
                }),
            )
        };
        Ok([partial(0)?, partial(1)?, partial(2)?])
    }

    /// ∂Ψ/∂t at fixed x of a field of particles: Ψ̇ − (grad Ψ) v.
    ///
    /// Through the derivative of the inverse motion, and not as that difference.
    ///
    /// # Errors
    /// See [the type](Eulerian#errors).
    pub fn local_rate<F: Field, T: Real>(
        &self,
        field: &Material<F>,
        place: &Vector3<T>,
        t: T,
    ) -> Result<ValueOf<F, T>, FieldsError> {
        let value = self.field(field, &place.map(Dual::constant), Dual::variable(t))?;
        finite::<F::Value, T>("local rate", map::<F::Value, _, _>(&value, |x| x.tangent))
    }

    /// Ψ̇ of a field of particles at the place x: that of the particle found there, W(14.18).
    ///
    /// # Errors
    /// See [the type](Eulerian#errors).
    pub fn material_derivative<F: Field, T: Real>(
        &self,
        field: &Material<F>,
        place: &Vector3<T>,
        t: T,
    ) -> Result<ValueOf<F, T>, FieldsError> {
        let reference = self.preimage(place, t)?.reference;
        finite::<F::Value, T>("material rate", local_rate(&field.0, &reference, t))
    }
}
