//! The types of the measures of stress.

use crate::measures::{general_measure, linear_measure, symmetric_measure};

symmetric_measure! {
    /// Cauchy's stress T, Pa: force per area of the deformed body.
    ///
    /// ```text
    /// t = T n,   T = Tᵀ
    /// ```
    /// Components refer to space on both sides.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// let bar = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 0.5, 0.5].into()))?;
    /// // 8 Pa on a quarter of the area are 2 Pa on the area before the deformation.
    /// assert_eq!(bar.first_piola(&stretch).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// W(16.4), W(17.34).
    CauchyStress, "Cauchy stress"
}
symmetric_measure! {
    /// Kirchhoff's stress τ = J T, Pa: Cauchy's stress weighed with the change of volume.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{CauchyStress, DeformationGradient, KirchhoffStress};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 0.5, 0.5].into()))?;
    /// let kirchhoff = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?.kirchhoff(&stretch);
    /// assert_eq!(kirchhoff, KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?); // J = 1/2
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    KirchhoffStress, "Kirchhoff stress"
}
symmetric_measure! {
    /// The second Piola–Kirchhoff stress S = F⁻¹ P, Pa: components in the reference configuration on both
    /// sides.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, SecondPiola};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 0.5, 0.5].into()))?;
    /// let stress = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.cauchy(&stretch).0.components[0], 8.0); // 2 · 1 · 2 / J
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// B(4.57).
    SecondPiola, "second Piola-Kirchhoff stress"
}
linear_measure!(CauchyStress KirchhoffStress SecondPiola);

general_measure! {
    /// The first Piola–Kirchhoff stress P = J T F⁻ᵀ = T Cof F, Pa: force per area of the reference body.
    ///
    /// Rows refer to space, columns to the reference configuration; in general P is not symmetric, but
    /// P Fᵀ is, W(17.35): see [`moment_residual`](FirstPiola::moment_residual).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, FirstPiola};
    /// let shear = DeformationGradient::new(Matrix3::new(1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0))?;
    /// let pull = FirstPiola::new(Matrix3::new(0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0))?;
    /// assert_eq!(pull.moment_residual(&shear).z, 1.0); // this P turns the sheared body: it is no stress
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// W(17.21), B(4.52).
    FirstPiola, "first Piola-Kirchhoff stress"
}
general_measure! {
    /// Biot's stress Rᵀ P, Pa: force per area of the reference body, turned back by the rotation R.
    ///
    /// Both sides refer to the reference configuration. It need not be symmetric; its
    /// [symmetric part](BiotStress::symmetric_part) is conjugate to U.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{BiotStress, FirstPiola};
    /// let turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    /// // The traction (0, 3, 0) on the first face is (3, 0, 0) before the quarter turn.
    /// let first_piola = FirstPiola::new(Matrix3::new(0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    /// let biot: BiotStress = first_piola.biot_of_rotation(&turn)?;
    /// assert_eq!(biot.0[(0, 0)], 3.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    BiotStress, "Biot stress"
}
general_measure! {
    /// Mandel's stress C S = Fᵀ P, Pa: conjugate to F⁻¹ Ḟ.
    ///
    /// Both sides refer to the reference configuration. It is symmetric only where C and S commute, as they
    /// do in an isotropic body.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, SecondPiola};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 0.5, 0.5].into()))?;
    /// let mandel = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?.mandel(&stretch);
    /// assert_eq!(mandel.0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    MandelStress, "Mandel stress"
}
