//! Rates of motion and of strain.

use piola_continuum::rates::{GradientRate, StretchRates, VelocityGradient};
use piola_numerics::linear::matrix3::from_rows;

use super::quantity;
use crate::engine::parts::{flat, rows};

quantity! {
    /// (ln U)˙ for Ḟ, 1/s: see [`StretchRates::hencky_material`].
    ///
    /// # Example
    /// Every request of this family is made and evaluated in the same way.
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_batch as batch;
    /// use piola_continuum::{DeformationGradient, rates::GradientRate};
    /// let f = [DeformationGradient::diagonal([2.0, 0.5, 0.5])?; 1000];
    /// let rate = [GradientRate::new(Matrix3::from_diagonal(&[4.0, 0.0, 0.0].into()))?; 1000];
    /// let mut out = vec![[0.0_f64; 6]; 1000];
    /// batch::evaluate(&f[..], batch::hencky_rate(&rate[..], &mut out[..]))?;
    /// assert!((out[7][0] - 2.0).abs() < 1e-14); // λ̇₁/λ₁
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    hencky_rate(rate: S) HenckyRate: GradientRate [9] => Self [6], "GradientRate", stretches |point, rate| {
        let rate = GradientRate(from_rows(rows(rate)));
        StretchRates::of_analysis(point.stretch(), &rate).hencky_material().components
    };
    /// L = Ḟ F⁻¹ by rows, 1/s.
    velocity_gradient(rate: S) VelocityGradientOutput: GradientRate [9] => Self [9], "GradientRate",
        |point, rate| flat(VelocityGradient::of(point, &GradientRate(from_rows(rows(rate)))).rows());
    /// D = sym L, 1/s.
    rate_of_deformation(velocity_gradient: S)
        RateOfDeformationOutput: VelocityGradient [9] => Self [6], "VelocityGradient",
        |_, gradient| VelocityGradient(from_rows(rows(gradient))).rate_of_deformation().0.components;
}
