//! The membrane and the thin plate as models of a displacement field: energies of its first and of its second gradient.
//!
//! # Derivation
//! Let u vanish to sufficient order on the boundary and let f be the force per volume, N/m³. Stationary is, for every
//! variation δu,
//!
//! ```text
//! membrane   Π = ∫ (½ τ |∇u|² − f · u) dV
//!            δΠ = ∫ (τ ∇u : ∇δu − f · δu) dV = −∫ (τ Δu + f) · δu dV                 ⇒  f + τ Δu = 0
//!
//! plate      Π = ∫ (½ D |∇∇u|² − f · u) dV
//!            δΠ = ∫ (D u_i,jk δu_i,jk − f · δu) dV
//!               = −∫ (D u_i,jkk δu_i,j + f · δu) dV        one integration by parts: one change of sign
//!               = +∫ (D u_i,jjkk − f_i) δu_i dV            two: none                     ⇒  f − D Δ²u = 0
//! ```
//! The text prints f + Δ²u = 0 in B(4.81) beside the energy |∇∇u|². That sign contradicts the energy: with it a force would
//! push the plate against itself, and no load would be in equilibrium with a wave u = a sin(k · X), whose energy grows with
//! |a|. The sign here is that of the energy. The factors ½ are ours: without them τ and D are doubled.
//!
//! Both are energies of a displacement and linear: τ ∇u is not symmetric and changes with a rotation of the body, so that
//! neither S = F⁻¹ P nor T = P Fᵀ/J of it means the stress of a solid.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_numerics::Real;
use piola_tensor::FourthOrder;

use piola_numerics::parameters;

parameters! {
    SolidsError;
    /// A membrane: energy ½ τ |∇u|², equilibrium f + τ Δu = 0.
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | τ | `tension` | Pa | 0 < τ |
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_solids::Membrane;
    /// let membrane = Membrane::new(2.0)?;
    /// assert_eq!(membrane.energy_density(&Matrix3::<f64>::identity()), 3.0);
    /// // u = ½ |X|² e₁ has Δu = 3 e₁.
    /// let residual = membrane.residual(&Vector3::new(-6.0, 0.0, 0.0), &Vector3::new(3.0, 0.0, 0.0));
    /// assert_eq!(residual, Vector3::zeros());
    /// # Ok::<(), piola_solids::SolidsError>(())
    /// ```
    ///
    /// # Source
    /// B(4.80).
    pub struct Membrane("membrane") {
        /// τ, Pa.
        tension: "0 < τ" => 0.0 < tension,
    }
}

impl Membrane {
    /// ½ τ |∇u|², J/m³.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn energy_density<T: Real>(&self, gradient: &Matrix3<T>) -> T {
        T::lit(0.5 * self.tension) * gradient.iter().fold(T::zero(), |sum, &g| sum + g * g)
    }

    /// τ ∇u, what is conjugate to ∇u, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn stress<T: Real>(&self, gradient: &Matrix3<T>) -> Matrix3<T> {
        gradient * T::lit(self.tension)
    }

    /// ∂(τ ∇u)/∂∇u = τ δᵢₖ δⱼₗ, Pa, the same everywhere.
    #[must_use]
    pub fn tangent<T: Real>(&self) -> FirstPiolaTangent<T> {
        let mut components = [[T::zero(); 9]; 9];
        for (k, row) in components.iter_mut().enumerate() {
            row[k] = T::lit(self.tension);
        }
        FirstPiolaTangent(FourthOrder { components })
    }

    /// f + τ Δu, N/m³, of the force per volume f, N/m³, and Δu, 1/m: zero in equilibrium.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn residual<T: Real>(&self, force_per_volume: &Vector3<T>, laplacian: &Vector3<T>) -> Vector3<T> {
        force_per_volume + laplacian * T::lit(self.tension)
    }

    /// −τ |k|², by which the operator multiplies a wave exp(i k · X), N/m⁴; k in rad/m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn symbol<T: Real>(&self, wave: &Vector3<T>) -> T {
        T::lit(-self.tension) * wave.iter().fold(T::zero(), |sum, &k| sum + k * k)
    }
}

parameters! {
    SolidsError;
    /// A thin plate: energy ½ D |∇∇u|², equilibrium f − D Δ²u = 0; see the [module's](self) derivation for the sign.
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | D | `stiffness` | N | 0 < D |
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_solids::ThinPlate;
    /// let plate = ThinPlate::new(2.0)?;
    /// // u = X₁⁴ e₁/24 has Δ²u = e₁: the force that holds it points along u.
    /// let residual = plate.residual(&Vector3::new(2.0, 0.0, 0.0), &Vector3::x());
    /// assert_eq!(residual, Vector3::zeros());
    /// assert_eq!(plate.symbol(&Vector3::new(1.0, 1.0, 0.0)), -8.0); // −D |k|⁴
    /// # Ok::<(), piola_solids::SolidsError>(())
    /// ```
    ///
    /// # Source
    /// B(4.81), its sign corrected.
    pub struct ThinPlate("thin plate") {
        /// D, N.
        stiffness: "0 < D" => 0.0 < stiffness,
    }
}

impl ThinPlate {
    /// ½ D |∇∇u|², J/m³, of `second[i][j][k]` = `∂²u_i/∂X_j∂X_k`, 1/m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn energy_density<T: Real>(&self, second: &[[[T; 3]; 3]; 3]) -> T {
        let entries = second.as_flattened().as_flattened();
        T::lit(0.5 * self.stiffness) * entries.iter().fold(T::zero(), |sum, &g| sum + g * g)
    }

    /// D ∇∇u, what is conjugate to ∇∇u, N/m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn moment<T: Real>(&self, second: &[[[T; 3]; 3]; 3]) -> [[[T; 3]; 3]; 3] {
        second.map(|rows| rows.map(|row| row.map(|g| g * T::lit(self.stiffness))))
    }

    /// D of ∂(D ∇∇u)/∂∇∇u = D δᵢₗ δⱼₘ δₖₙ, N, the same everywhere.
    #[must_use]
    pub fn tangent<T: Real>(&self) -> T {
        T::lit(self.stiffness)
    }

    /// f − D Δ²u, N/m³, of the force per volume f, N/m³, and Δ²u, 1/m³: zero in equilibrium.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn residual<T: Real>(&self, force_per_volume: &Vector3<T>, bilaplacian: &Vector3<T>) -> Vector3<T> {
        force_per_volume - bilaplacian * T::lit(self.stiffness)
    }

    /// −D |k|⁴, by which the operator multiplies a wave exp(i k · X), N/m⁴; k in rad/m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn symbol<T: Real>(&self, wave: &Vector3<T>) -> T {
        let square = wave.iter().fold(T::zero(), |sum, &k| sum + k * k);
        T::lit(-self.stiffness) * (square * square)
    }
}
