//! The spins that come with the polar decomposition, each a type of its own; what they are is said by [`StretchRates`].

#[cfg(doc)]
use super::StretchRates;
use crate::measures::skew_measure;

skew_measure! {
    /// The polar spin Ω = Ṙ Rᵀ, by its axial vector, 1/s: how fast the rotation R of F = R U turns, seen in space.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::rates::PolarSpin;
    /// assert_eq!(PolarSpin::new(Vector3::new(0.0, 0.0, 2.0))?.matrix()[(1, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    PolarSpin, "polar spin"
}

skew_measure! {
    /// The material spin Rᵀ Ṙ, by its axial vector, 1/s: the polar spin seen in the reference configuration.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::rates::MaterialSpin;
    /// assert_eq!(MaterialSpin::new(Vector3::new(0.0, 0.0, 2.0))?.matrix()[(1, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    MaterialSpin, "material spin"
}

skew_measure! {
    /// The logarithmic spin Ω^log, by its axial vector, 1/s: (ln V)˙ − Ω ln V + ln V Ω = D.
    ///
    /// ```text
    /// Ω^log = W + Σ ((1 + r)/(1 − r) + 2/ln r) PₖDPₗ = ṘRᵀ + Σ (1/x − 1/sinh x) PₖDPₗ,   r = λₖ²/λₗ², x = ½ ln r
    /// ```
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::rates::LogarithmicSpin;
    /// assert_eq!(LogarithmicSpin::new(Vector3::new(0.0, 0.0, 2.0))?.matrix()[(1, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    /// # Source
    /// H. Xiao, O. T. Bruhns & A. Meyers, *Acta Mech.* 124 (1997).
    LogarithmicSpin, "logarithmic spin"
}

skew_measure! {
    /// The twirl of the material triad, by its axial vector, 1/s: N̂̇ₖ = ω × N̂ₖ for the principal axes N̂ₖ of U.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::rates::MaterialTwirl;
    /// assert_eq!(MaterialTwirl::new(Vector3::new(0.0, 0.0, 2.0))?.matrix()[(1, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    MaterialTwirl, "twirl"
}

skew_measure! {
    /// The twirl of the spatial triad, by its axial vector, 1/s: n̂̇ₖ = ω × n̂ₖ for the principal axes n̂ₖ of V.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::rates::SpatialTwirl;
    /// assert_eq!(SpatialTwirl::new(Vector3::new(0.0, 0.0, 2.0))?.matrix()[(1, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    SpatialTwirl, "twirl"
}
