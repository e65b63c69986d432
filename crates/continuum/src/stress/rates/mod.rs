//! Objective rates of stress: rates that are those of the stress alone, whoever turns.
//!
//! ```text
//! x* = Q(t) x + c(t):  T* = Q T Qᵀ, but (T*)˙ ≠ Q Ṫ Qᵀ;   every rate T° here has (T*)° = Q T° Qᵀ
//! ```
//!
//! | rate | T° of the material rate Ṫ | needs | is the rate of |
//! |---|---|---|---|
//! | [`JaumannRate`] (Zaremba) | Ṫ − W T + T W | the [`Spin`](crate::rates::Spin) W | T in axes that turn with W |
//! | [`GreenNaghdiRate`] | Ṫ − Ω T + T Ω, Ω = Ṙ Rᵀ | the [`PolarSpin`](crate::rates::PolarSpin) | R (Rᵀ T R)˙ Rᵀ |
//! | [`LogarithmicRate`] | Ṫ − Ω T + T Ω, Ω = Ω^log | the [`LogarithmicSpin`](crate::rates::LogarithmicSpin) | T in axes where (ln V)° = D |
//! | [`UpperConvectedRate`] (Oldroyd) | Ṫ − L T − T Lᵀ | the [`VelocityGradient`](crate::rates::VelocityGradient) | F (F⁻¹ T F⁻ᵀ)˙ Fᵀ, the Lie derivative |
//! | [`LowerConvectedRate`] (Cotter–Rivlin) | Ṫ + Lᵀ T + T L | the [`VelocityGradient`](crate::rates::VelocityGradient) | F⁻ᵀ (Fᵀ T F)˙ F⁻¹ |
//! | [`TruesdellRate`], of Cauchy's stress alone | Ṫ − L T − T Lᵀ + T tr L | the [`VelocityGradient`](crate::rates::VelocityGradient) | J⁻¹ F (J F⁻¹ T F⁻ᵀ)˙ Fᵀ = J⁻¹ F Ṡ Fᵀ |
//!
//! Each is a type over the stress that it is a rate of, [`CauchyStress`](crate::CauchyStress) or [`KirchhoffStress`](crate::KirchhoffStress), so that the rate of
//! one is never taken for that of the other, nor one rate for another; [`material`](JaumannRate::material) gives Ṫ
//! back, as a rate law needs it. With τ = J T the two are connected by
//!
//! ```text
//! τ° = J (T° + T tr D)   for every rate,        (upper-convected rate of τ) = J (Truesdell rate of T) = F Ṡ Fᵀ
//! ```
//!
//! # Accuracy
//! Within 4 ulp of |Ṫ| + 2 |L| |T|; no formula divides.

mod material_rate;
mod objective;

pub use material_rate::MaterialRate;
pub use objective::{
    Carrier, GreenNaghdiRate, JaumannRate, LogarithmicRate, LowerConvectedRate, SpatialStress, TruesdellRate,
    UpperConvectedRate,
};
