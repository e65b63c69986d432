//! Integrals with an estimate of their error: two rules of different degree.

use nalgebra::Vector3;
use piola_numerics::Real;

use super::{Quadrature, Region, SurfacePoint};
use crate::FieldsError;
use crate::integrand::{Integrand, largest_component, largest_difference};

/// An integral with an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimate<V> {
    /// The integral by the better rule.
    pub value: V,
    /// The largest component of the difference of the two rules: where they converge, more than the error of the
    /// better one. Of differentiable numbers the values count, not the derivatives.
    pub error: f64,
    /// The degree of the better rule.
    pub degree: usize,
}

/// Two rules of quadrature, the difference of whose results estimates the error.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Cuboid, EstimatedQuadrature};
/// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let rules = EstimatedQuadrature::of_degree(6)?;
/// let integral = rules.volume_integral(&unit, |x: &Vector3<f64>| x.x.exp())?;
/// let error = (integral.value - (core::f64::consts::E - 1.0)).abs();
/// assert!(error < integral.error && integral.error < 1e-5);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EstimatedQuadrature {
    coarse: Quadrature,
    fine: Quadrature,
}

impl EstimatedQuadrature {
    /// The rules of `degree` and of `degree` + 2.
    ///
    /// # Errors
    /// [`FieldsError::DegreeTooHigh`].
    pub fn of_degree(degree: usize) -> Result<Self, FieldsError> {
        Self::of_degrees(degree, degree.saturating_add(2))
    }

    /// The rules of two degrees, the better one last.
    ///
    /// # Errors
    /// [`FieldsError::DegreeTooHigh`].
    pub fn of_degrees(coarse: usize, fine: usize) -> Result<Self, FieldsError> {
        Ok(Self { coarse: Quadrature::of_degree(coarse)?, fine: Quadrature::of_degree(fine)? })
    }

    /// The rule of lower degree.
    #[must_use]
    pub fn coarse(&self) -> &Quadrature {
        &self.coarse
    }

    /// The rule of higher degree.
    #[must_use]
    pub fn fine(&self) -> &Quadrature {
        &self.fine
    }

    /// Whatever is made by integration, by both rules.
    ///
    /// # Errors
    /// Those of the integration.
    pub fn estimate<V: Integrand>(
        &self,
        mut integral: impl FnMut(&Quadrature) -> Result<V, FieldsError>,
    ) -> Result<Estimate<V>, FieldsError> {
        let coarse = integral(&self.coarse)?;
        let value = integral(&self.fine)?;
        Ok(Estimate { value, error: largest_difference(&value, &coarse), degree: self.fine.degree() })
    }

    /// ∫ f dV over a region.
    ///
    /// # Errors
    /// As [`Quadrature::volume_integral`].
    pub fn volume_integral<T: Real, V: Integrand<Scalar = T>, R: Region<T>>(
        &self,
        region: &R,
        mut integrand: impl FnMut(&Vector3<T>) -> V,
    ) -> Result<Estimate<V>, FieldsError> {
        self.estimate(|rule| rule.volume_integral(region, &mut integrand))
    }

    /// ∫ f dA over the boundary of a region.
    ///
    /// # Errors
    /// As [`Quadrature::surface_integral`].
    pub fn surface_integral<T: Real, V: Integrand<Scalar = T>, R: Region<T>>(
        &self,
        region: &R,
        mut integrand: impl FnMut(&SurfacePoint<T>) -> V,
    ) -> Result<Estimate<V>, FieldsError> {
        self.estimate(|rule| rule.surface_integral(region, &mut integrand))
    }
}

/// Rules of rising degree, taken one after another until two agree; written as the highest degree.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{AdaptiveQuadrature, Ball};
/// let ball = Ball::new(Vector3::zeros(), 1.0)?;
/// let rules = AdaptiveQuadrature::up_to_degree(64)?;
/// let integral = rules.volume_integral(&ball, 1e-12, |x: &Vector3<f64>| (3.0 * x.z).exp())?;
/// // 4π ∫ r² sinh(3r)/(3r) dr = 4π (cosh 3/9 − sinh 3/27)
/// let exact = 4.0 * core::f64::consts::PI * (3.0_f64.cosh() / 9.0 - 3.0_f64.sinh() / 27.0);
/// assert!((integral.value - exact).abs() < 1e-12 * exact && integral.degree < 40);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "usize", into = "usize"))]
pub struct AdaptiveQuadrature {
    rules: Box<[Quadrature]>,
}

impl AdaptiveQuadrature {
    /// Rules of the degrees 1, 3, 5, 8, 12, 18, 27, … up to the given one, which is at least 3.
    ///
    /// # Errors
    /// [`FieldsError::DegreeTooHigh`].
    pub fn up_to_degree(degree: usize) -> Result<Self, FieldsError> {
        let mut degrees = vec![1, 3];
        while let Some(&last) = degrees.last()
            && last < degree
        {
            degrees.push((last + last.div_ceil(2)).min(degree));
        }
        let rules: Result<Vec<_>, _> = degrees.into_iter().map(Quadrature::of_degree).collect();
        Ok(Self { rules: rules?.into_boxed_slice() })
    }

    /// Whatever is made by integration, until two rules agree to `tolerance` times the largest component.
    ///
    /// An integral that is zero by cancellation has no relative accuracy: add to it a component that is not. Rules of
    /// low degree may agree by chance, where an integrand varies only between their points: cut the region then.
    ///
    /// # Errors
    /// Those of the integration; [`FieldsError::IntegralNotConverged`].
    pub fn estimate<V: Integrand>(
        &self,
        tolerance: f64,
        mut integral: impl FnMut(&Quadrature) -> Result<V, FieldsError>,
    ) -> Result<Estimate<V>, FieldsError> {
        let (mut last, mut error, mut degree) = (None, f64::INFINITY, 0);
        for rule in &self.rules {
            let value = integral(rule)?;
            degree = rule.degree();
            if let Some(last) = last.replace(value) {
                error = largest_difference(&value, &last);
                if error <= tolerance * largest_component(&value) {
                    return Ok(Estimate { value, error, degree });
                }
            }
        }
        Err(FieldsError::IntegralNotConverged { error, tolerance, degree })
    }

    /// ∫ f dV over a region to a relative tolerance.
    ///
    /// # Errors
    /// As [`estimate`](Self::estimate) and [`Quadrature::volume_integral`].
    pub fn volume_integral<T: Real, V: Integrand<Scalar = T>, R: Region<T>>(
        &self,
        region: &R,
        tolerance: f64,
        mut integrand: impl FnMut(&Vector3<T>) -> V,
    ) -> Result<Estimate<V>, FieldsError> {
        self.estimate(tolerance, |rule| rule.volume_integral(region, &mut integrand))
    }

    /// ∫ f dA over the boundary of a region to a relative tolerance.
    ///
    /// # Errors
    /// As [`estimate`](Self::estimate) and [`Quadrature::surface_integral`].
    pub fn surface_integral<T: Real, V: Integrand<Scalar = T>, R: Region<T>>(
        &self,
        region: &R,
        tolerance: f64,
        mut integrand: impl FnMut(&SurfacePoint<T>) -> V,
    ) -> Result<Estimate<V>, FieldsError> {
        self.estimate(tolerance, |rule| rule.surface_integral(region, &mut integrand))
    }
}

/// As [`AdaptiveQuadrature::up_to_degree`].
impl TryFrom<usize> for AdaptiveQuadrature {
    type Error = FieldsError;
    fn try_from(degree: usize) -> Result<Self, FieldsError> {
        Self::up_to_degree(degree)
    }
}

/// The highest degree.
impl From<AdaptiveQuadrature> for usize {
    fn from(quadrature: AdaptiveQuadrature) -> Self {
        quadrature.rules.last().map_or(0, Quadrature::degree)
    }
}
