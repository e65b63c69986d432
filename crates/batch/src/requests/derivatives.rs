//! Derivatives of Hencky's strain by F.

use nalgebra::Matrix3;
use piola_continuum::rates::{GradientRate, StretchRates};
use piola_continuum::strain::HenckyStrain;
use piola_numerics::linear::matrix3::from_rows;

use super::quantity;
use crate::engine::parts::{part, rows};

quantity! {
    /// ∂ ln U/∂F: six components 11, 22, 33, 12, 23, 13, each with the nine derivatives by the entries of F by rows.
    ///
    /// # Accuracy
    /// That of [`StretchRates`] along each entry, relative to the largest derivative: nothing is divided by a gap of the
    /// stretches.
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::DeformationGradient;
    /// let f = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
    /// let request = batch::hencky_derivative(&mut [[0.0; 54]; 0][..]);
    /// assert!((request.at(&f, 0)[0] - 0.5_f64).abs() < 1e-15); // ∂ ln U₁₁/∂F₁₁ = 1/λ₁
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    hencky_derivative() HenckyDerivative: () [0] => Self [54], "", stretches |point, _| {
        let mut all = [T::zero(); 54];
        let mut place = 0;
        while place < 9 {
            let mut direction = [[T::zero(); 3]; 3];
            direction[place / 3][place % 3] = T::one();
            let rates = StretchRates::of_analysis(point.stretch(), &GradientRate(from_rows(direction)));
            for (row, component) in rates.hencky_material().components.into_iter().enumerate() {
                all[9 * row + place] = component;
            }
            place += 1;
        }
        all
    };
    /// The second derivative of ln U along two directions of F: see [`HenckyStrain::second_derivative`].
    hencky_second_derivative(first: A, second: B)
        HenckySecondDerivative: (Matrix3<f64>, Matrix3<f64>) [18] => Self [6], "directions",
        |point, input| {
            let (a, b) = (from_rows(rows(part(&input, 0))), from_rows(rows(part(&input, 9))));
            HenckyStrain::second_derivative(point, &a, &b).components
        };
}
