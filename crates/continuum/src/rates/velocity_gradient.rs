//! The velocity gradient, the rate of deformation and the spin.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant, rows_of};
use piola_tensor::Skew;
use piola_tensor::internal::rows::{difference, product, product_transposed, sum, trace};

use crate::measures::{general_measure, skew_measure, symmetric_measure};
use crate::{Deformation, Symmetric};

general_measure! {
    /// The rate of the deformation gradient, Ḟ = Grad v, 1/s; also that of the displacement gradient.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, rates::{GradientRate, VelocityGradient}};
    /// let twice = DeformationGradient::new(Matrix3::from_diagonal_element(2.0))?;
    /// let rate = GradientRate::new(Matrix3::from_diagonal_element(6.0))?;
    /// assert_eq!(VelocityGradient::of(&twice, &rate).divergence(), 9.0); // 3 · 6/2
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    GradientRate, "rate of F"
}

general_measure! {
    /// The second rate of the deformation gradient, F̈ = Grad a, 1/s².
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::rates::GradientSecondRate;
    /// assert!(GradientSecondRate::new(Matrix3::from_element(f64::NAN)).is_err());
    /// ```
    GradientSecondRate, "second rate of F"
}

general_measure! {
    /// The velocity gradient L = grad v = Ḟ F⁻¹, Lᵢⱼ = ∂vᵢ/∂xⱼ, 1/s.
    ///
    /// ```text
    /// L = Ḟ F⁻¹ = D + W        D = ½ (L + Lᵀ),   W = ½ (L − Lᵀ)
    /// ```
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::rates::VelocityGradient;
    /// // Simple shear at the rate 2: half of it stretches, half of it turns.
    /// let shear = VelocityGradient::new(Matrix3::new(0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    /// assert_eq!(shear.rate_of_deformation().0.components, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    /// assert_eq!(shear.spin().axial.z, -1.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    /// # Source
    /// W(14.20–14.21), W(14.30), B(4.34–4.35).
    VelocityGradient, "velocity gradient"
}

general_measure! {
    /// The acceleration gradient grad a = F̈ F⁻¹ = L̇ + L², 1/s².
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::rates::{AccelerationGradient, VelocityGradient};
    /// // Steady rotation at 3 rad/s: L̇ = 0, so grad a = L² is the centripetal acceleration −9 r.
    /// let turn = VelocityGradient::new(Matrix3::new(0.0, -3.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    /// let acceleration = AccelerationGradient::of_rate(&turn, &Matrix3::zeros());
    /// assert_eq!(acceleration.0[(0, 0)], -9.0);
    /// assert_eq!(acceleration.velocity_gradient_rate(&turn), Matrix3::zeros());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    AccelerationGradient, "acceleration gradient"
}

symmetric_measure! {
    /// The rate of deformation D = ½ (L + Lᵀ), the rate of strain per present length, 1/s.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::rates::RateOfDeformation;
    /// let pull = RateOfDeformation::new(2.0, -1.0, -1.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(pull.0.trace(), 0.0); // no change of volume
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    /// # Source
    /// W(14.29), B(4.34).
    #[doc(alias = "stretching")]
    RateOfDeformation, "rate of deformation"
}

skew_measure! {
    /// The spin W = ½ (L − Lᵀ), by its axial vector ½ curl v, 1/s.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::rates::Spin;
    /// let spin = Spin::new(Vector3::new(0.0, 0.0, 3.0))?;
    /// assert_eq!(spin.vorticity().z, 6.0);
    /// assert_eq!(spin.matrix()[(1, 0)], 3.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    /// # Source
    /// W(14.28), B(4.35).
    Spin, "spin"
}

impl<T: Real> Spin<T> {
    /// The vorticity curl v, twice the axial vector, 1/s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn vorticity(&self) -> Vector3<T> {
        Vector3::new(self.axial[0] + self.axial[0], self.axial[1] + self.axial[1], self.axial[2] + self.axial[2])
    }
}

impl<T: Real> GradientRate<T> {
    /// Ḟ = L F, W(14.21).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>, velocity_gradient: &VelocityGradient<T>) -> Self {
        // L + L ∇u: what is stored of a small displacement gradient is not rounded away.
        let l = velocity_gradient.rows();
        Self::trusted(sum(l, product(l, deformation.displacement_rows())))
    }
}

impl<T: Real> VelocityGradient<T> {
    /// L = Ḟ F⁻¹, W(14.21).
    ///
    /// # Accuracy
    /// A few ulp × the condition number of F.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>, rate: &GradientRate<T>) -> Self {
        Self::trusted(product(rate.rows(), inverse_and_determinant(deformation.gradient_rows()).0))
    }

    /// L = D + W, W(14.30).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of_parts(stretching: &RateOfDeformation<T>, spin: &Spin<T>) -> Self {
        Self::trusted(sum(stretching.rows(), spin.rows()))
    }

    /// D = ½ (L + Lᵀ), W(14.29).
    #[doc(alias = "stretching")]
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rate_of_deformation(&self) -> RateOfDeformation<T> {
        RateOfDeformation(Symmetric::symmetric_part(self.rows()))
    }

    /// W = ½ (L − Lᵀ), W(14.28).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn spin(&self) -> Spin<T> {
        Spin::of_axial(Skew::skew_part(self.rows()).axial)
    }

    /// div v = tr L, the rate of volume per present volume, 1/s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn divergence(&self) -> T {
        trace(self.rows())
    }

    /// J̇ = J tr L, 1/s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn jacobian_rate(&self, deformation: &impl Deformation<T>) -> T {
        deformation.jacobian() * self.divergence()
    }

    /// L seen by an observer who turns: Q L Qᵀ + Ω, with Ω = Q̇ Qᵀ of axial vector `angular_velocity`.
    ///
    /// ```text
    /// x* = Q x + c:   L* = Q L Qᵀ + Q̇ Qᵀ,   D* = Q D Qᵀ,   W* = Q W Qᵀ + Q̇ Qᵀ
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn seen_from(&self, rotation: &Matrix3<T>, angular_velocity: &Vector3<T>) -> Self {
        let q = rows_of(rotation);
        let turned = product(q, product_transposed(self.rows(), q));
        Self::trusted(sum(turned, Skew::new(angular_velocity[0], angular_velocity[1], angular_velocity[2]).rows()))
    }
}

impl<T: Real> AccelerationGradient<T> {
    /// grad a = F̈ F⁻¹.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>, second_rate: &GradientSecondRate<T>) -> Self {
        Self::trusted(product(second_rate.rows(), inverse_and_determinant(deformation.gradient_rows()).0))
    }

    /// grad a = L̇ + L².
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of_rate(velocity_gradient: &VelocityGradient<T>, rate: &Matrix3<T>) -> Self {
        let l = velocity_gradient.rows();
        Self::trusted(sum(rows_of(rate), product(l, l)))
    }

    /// L̇ = grad a − L², the material derivative of the velocity gradient, 1/s².
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn velocity_gradient_rate(&self, velocity_gradient: &VelocityGradient<T>) -> Matrix3<T> {
        let l = velocity_gradient.rows();
        from_rows(difference(self.rows(), product(l, l)))
    }

    /// F̈ = (grad a) F.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn gradient_second_rate(&self, deformation: &impl Deformation<T>) -> GradientSecondRate<T> {
        GradientSecondRate::trusted(product(self.rows(), deformation.gradient_rows()))
    }
}
