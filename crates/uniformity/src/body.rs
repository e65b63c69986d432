//! Materially uniform bodies: one law everywhere, laid into the reference configuration by K(X).
//!
//! ```text
//! T = N(F K)        P = P_N(F K) Kᵀ/det K        W = W_N(F K)/det K        ρ_κ = ρ₀/det K
//! ```
//!
//! N, `P_N`, `W_N` and ρ₀ are those of the crystal.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{CauchyStress, DeformationGradient, FirstPiola};
use piola_fields::integral::StoredEnergy;
use piola_fields::{Field, Motion};
use piola_numerics::linear::matrix3::{determinant, inverse_and_determinant, rows_of};
use piola_numerics::{Gradient, Real};
use piola_solids::Hyperelastic;
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::{product, product_transposed, scaled};

use crate::UniformityError;
use crate::error::{check_finite, check_metric};
use crate::indices::variables;
use crate::map::UniformityMap;

/// A materially uniform body of a hyperelastic law, W(26.2).
///
/// The law is that of the crystal in its own reference. The stress does not depend on which of the maps K(X) H(X), H in the law's symmetry
/// group, is given.
///
/// | symbol | here | unit |
/// |---|---|---|
/// | N | `law` | Pa |
/// | K(X) | `map` | – |
///
/// # Errors
/// Methods that return a `Result` refuse what the map refuses, and deformations that the law refuses.
///
/// # Example
/// Half of a bar has grown by 10 %: held at its old length it is compressed.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_continuum::DeformationGradient;
/// use piola_numerics::Real;
/// use piola_solids::NeoHookeanLogarithmic;
/// use piola_uniformity::{MateriallyUniformBody, UniformityMap};
/// struct Grown;
/// impl UniformityMap for Grown {
///     fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
///         let growth = T::select(T::zero().less_than(reference.x), T::lit(1.1), T::one());
///         Matrix3::from_diagonal_element(growth.recip())
///     }
/// }
/// let body = MateriallyUniformBody { law: NeoHookeanLogarithmic::with_constants(1.0, 1.0)?, map: Grown };
/// let held = DeformationGradient::identity();
/// assert!(body.cauchy(&held, &Vector3::new(1.0, 0.0, 0.0))?.0.components[0] < -0.1);
/// assert_eq!(body.cauchy(&held, &Vector3::new(-1.0, 0.0, 0.0))?.0.components[0], 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(26.2); isotropic solids W(29.22).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MateriallyUniformBody<L, M> {
    /// The law of the crystal.
    pub law: L,
    /// K(X).
    pub map: M,
}

impl<L: Hyperelastic, M: UniformityMap> MateriallyUniformBody<L, M> {
    /// F K, the deformation of the crystal.
    ///
    /// # Errors
    /// See [the type](MateriallyUniformBody#errors).
    pub fn crystal_deformation<T: Real>(
        &self,
        deformation: &DeformationGradient<T>,
        reference: &Vector3<T>,
    ) -> Result<DeformationGradient<T>, UniformityError> {
        let k = rows_of(&self.map.value(reference)?);
        let crystal = DeformationGradient::from_rows(product(rows_of(deformation.matrix()), k))?;
        self.law.check(&crystal)?;
        Ok(crystal)
    }

    /// T = N(F K), Pa, W(26.2).
    ///
    /// # Errors
    /// See [the type](MateriallyUniformBody#errors).
    pub fn cauchy<T: Real>(
        &self,
        deformation: &DeformationGradient<T>,
        reference: &Vector3<T>,
    ) -> Result<CauchyStress<T>, UniformityError> {
        let stress = self.law.cauchy(&self.crystal_deformation(deformation, reference)?);
        check_finite("T", &stress.0.components)?;
        Ok(stress)
    }

    /// P = `P_N(F K)` Kᵀ/det K, Pa.
    ///
    /// # Errors
    /// See [the type](MateriallyUniformBody#errors).
    pub fn first_piola<T: Real>(
        &self,
        deformation: &DeformationGradient<T>,
        reference: &Vector3<T>,
    ) -> Result<FirstPiola<T>, UniformityError> {
        self.crystal_deformation(deformation, reference)?;
        let stress = first_piola(&self.law, &self.map, deformation.matrix(), reference);
        check_finite("P", stress.0.as_slice())?;
        Ok(stress)
    }

    /// W(F, X) = `W_N(F K)`/det K, J per m³ of the reference configuration.
    ///
    /// # Errors
    /// See [the type](MateriallyUniformBody#errors).
    pub fn energy<T: Real>(
        &self,
        deformation: &DeformationGradient<T>,
        reference: &Vector3<T>,
    ) -> Result<T, UniformityError> {
        let crystal = self.crystal_deformation(deformation, reference)?;
        let energy = self.law.energy(&crystal) / determinant(rows_of(&self.map.at(reference)));
        check_finite("W", &[energy])?;
        Ok(energy)
    }

    /// `ρ_κ = ρ₀`/det K, kg/m³ of the reference configuration, of the crystal's density `ρ₀`.
    ///
    /// # Errors
    /// What the map refuses; [`UniformityError::NotFinite`].
    pub fn reference_density<T: Real>(&self, crystal_density: T, reference: &Vector3<T>) -> Result<T, UniformityError> {
        let density = crystal_density / determinant(rows_of(&self.map.value(reference)?));
        check_finite("density", &[density])?;
        Ok(density)
    }
}

/// P, unchecked.
#[inline]
fn first_piola<T: Real>(
    law: &impl Hyperelastic,
    map: &impl UniformityMap,
    gradient: &Matrix3<T>,
    reference: &Vector3<T>,
) -> FirstPiola<T> {
    let k = rows_of(&map.at(reference));
    let crystal = DeformationGradient::trusted(product(rows_of(gradient), k));
    let of_crystal = law.first_piola(&crystal).rows();
    FirstPiola::trusted(scaled(product_transposed(of_crystal, k), determinant(k).recip()))
}

/// For integrals over the body and forces on the nodes of a mesh; a place that the map refuses gives NaN.
impl<L: Hyperelastic, M: UniformityMap> StoredEnergy for MateriallyUniformBody<L, M> {
    fn density<T: Real>(&self, reference: &Vector3<f64>, gradient: &Matrix3<T>) -> T {
        let k = rows_of(&self.map.at(&reference.map(T::lit)));
        self.law.energy(&DeformationGradient::trusted(product(rows_of(gradient), k))) / determinant(k)
    }

    fn stress<T: Real>(&self, reference: &Vector3<f64>, gradient: &Matrix3<T>) -> FirstPiola<T> {
        first_piola(&self.law, &self.map, gradient, &reference.map(T::lit))
    }
}

/// P(X, t) of a uniform body in a motion, as a field: what the balances of `piola_fields` take.
///
/// # Example
/// A homogeneous body at rest is free of stress.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::{Affine, Field, Motion};
/// use piola_numerics::Real;
/// use piola_solids::NeoHookeanLogarithmic;
/// use piola_uniformity::{ConstantMap, MateriallyUniformBody, StressInMotion};
/// struct Rest;
/// impl Motion for Rest {
///     fn place<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Vector3<T> {
///         *reference
///     }
/// }
/// let body = MateriallyUniformBody { law: NeoHookeanLogarithmic::with_constants(1.0, 1.0)?, map: ConstantMap(Matrix3::identity()) };
/// let stress = StressInMotion { body: &body, motion: &Rest }.at(&Vector3::new(1.0, 2.0, 3.0), 0.0);
/// assert_eq!(stress.0, Matrix3::zeros());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressInMotion<'a, L, M, X> {
    /// The body.
    pub body: &'a MateriallyUniformBody<L, M>,
    /// x(X, t).
    pub motion: &'a X,
}

impl<L: Hyperelastic, M: UniformityMap, X: Motion> Field for StressInMotion<'_, L, M, X> {
    type Value = FirstPiola;
    fn at<T: Real>(&self, place: &Vector3<T>, t: T) -> FirstPiola<T> {
        let x = self.motion.place(&variables(place), Gradient::constant(t));
        let gradient = Matrix3::from_fn(|i, j| x[i].partials[j]);
        first_piola(&self.body.law, &self.body.map, &gradient, place)
    }
}

/// A uniformity map of a given metric: the K with K Kᵀ = M⁻¹ that is upper triangular.
///
/// For an isotropic solid any such K gives the same body: `T = N(F K KᵀFᵀ)`, W(29.22).
///
/// # Errors
/// [`TensorError::NotPositiveDefinite`](piola_tensor::TensorError::NotPositiveDefinite).
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::Symmetric;
/// use piola_fields::Uniform;
/// use piola_uniformity::{MapOfMetric, UniformityMap};
/// let map = MapOfMetric(Uniform(Symmetric::diagonal([4.0, 1.0, 0.25])));
/// assert_eq!(map.value(&Vector3::<f64>::zeros())?.diagonal(), Vector3::new(0.5, 1.0, 2.0));
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MapOfMetric<G>(
    /// M(X).
    pub G,
);

impl<G: Field<Value = Symmetric>> UniformityMap for MapOfMetric<G> {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        let m = self.0.at(reference, T::zero()).rows();
        // M = L Lᵀ, K = L⁻ᵀ.
        let zero = T::zero();
        let a = m[0][0].sqrt();
        let (b, c) = (m[1][0] / a, m[2][0] / a);
        let d = (m[1][1] - b * b).sqrt();
        let e = (m[2][1] - b * c) / d;
        let f = (m[2][2] - c * c - e * e).sqrt();
        let lower = [[a, zero, zero], [b, d, zero], [c, e, f]];
        let inverse = inverse_and_determinant(lower).0;
        Matrix3::from_fn(|i, j| inverse[j][i])
    }

    fn check_domain<T: Real>(&self, reference: &Vector3<T>) -> Result<(), UniformityError> {
        check_metric(&self.0.at(reference, T::zero()))
    }
}
