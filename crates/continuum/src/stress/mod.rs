//! Stress: measures, tractions, invariants, power. Each measure is its own type, and a conversion needs the deformation.
//!
//! | measure | type | refers to | unit of area | symmetric |
//! |---|---|---|---|---|
//! | Cauchy T | [`CauchyStress`] | space, space | deformed | yes |
//! | Kirchhoff τ = J T | [`KirchhoffStress`] | space, space | – | yes |
//! | first Piola–Kirchhoff P = J T F⁻ᵀ | [`FirstPiola`] | space, reference | reference | P Fᵀ is |
//! | second Piola–Kirchhoff S = F⁻¹ P | [`SecondPiola`] | reference, reference | reference | yes |
//! | Biot Rᵀ P | [`BiotStress`] | reference, reference | reference | no |
//! | Mandel M = C S = Fᵀ P | [`MandelStress`] | reference, reference | reference | C⁻¹ M is |
//!
//! # Conversions
//! Every measure has the methods `cauchy`, `kirchhoff`, `first_piola`, `second_piola`, `biot` and `mandel` of the other
//! five, which take the deformation:
//!
//! ```text
//! to ↓ from →   T               τ               P               S               M               Biot Q
//! T             ·               τ/J             sym(P Fᵀ)/J     F S Fᵀ/J        sym(F⁻ᵀM Fᵀ)/J  sym(R Q Fᵀ)/J
//! τ             J T             ·               sym(P Fᵀ)       F S Fᵀ          sym(F⁻ᵀM Fᵀ)    sym(R Q Fᵀ)
//! P             T Cof F         τ F⁻ᵀ           ·               F S             F⁻ᵀ M           R Q
//! S             J F⁻¹ T F⁻ᵀ     F⁻¹ τ F⁻ᵀ       sym(F⁻¹ P)      ·               sym(C⁻¹ M)      sym(U⁻¹ Q)
//! M             Fᵀ T Cof F      Fᵀ τ F⁻ᵀ        Fᵀ P            C S             ·               U Q
//! Biot          Rᵀ T Cof F      Rᵀ τ F⁻ᵀ        Rᵀ P            U S             U⁻¹ M           ·
//! ```
//! A general P, M or Q becomes a symmetric measure by its symmetric part. What is left out is zero for a stress that
//! obeys the balance of angular momentum W(17.34–17.35): [`FirstPiola::moment_residual`] tells how large it is, and
//! [`FirstPiola::check_moment`] refuses it. Biot's stress needs R, which is computed from F; with a
//! [`StretchAnalysis`](crate::polar::StretchAnalysis) or R at hand the methods `…_of_analysis` and
//! `…_of_rotation` do not compute it again.
//!
//! Results are within a few ulp × their condition number: |F| |F⁻¹| where F or F⁻¹ stands on one side of the stress, its
//! square where on both.
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use piola_continuum::rates::GradientRate;
//! use piola_continuum::{CauchyStress, DeformationGradient, ReferenceNormal, UnitNormal};
//! // A bar pulled to twice its length and half its width, 8 Pa in it.
//! let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 0.5, 0.5].into()))?;
//! let cauchy = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
//! assert_eq!(cauchy.kirchhoff(&stretch).0.components[0], 4.0); // J = 1/2
//! assert_eq!(cauchy.first_piola(&stretch).0[(0, 0)], 2.0); // a quarter of the area
//! assert_eq!(cauchy.second_piola(&stretch).0.components[0], 1.0);
//! assert_eq!(cauchy.biot(&stretch).0[(0, 0)], 2.0); // no rotation
//! assert_eq!(cauchy.mandel(&stretch).0[(0, 0)], 4.0); // C = 4
//! assert_eq!(cauchy.second_piola(&stretch).cauchy(&stretch), cauchy);
//!
//! // The force on the end of the bar, by its deformed and by its reference area.
//! let end = ReferenceNormal::new(Vector3::x())?;
//! let area = end.deformed(&stretch); // Nanson
//! assert_eq!(cauchy.traction(&area.normal) * area.ratio, cauchy.first_piola(&stretch).traction(&end));
//!
//! // Lengthening at 3/s works 6 W per reference m³.
//! let rate = GradientRate::new(Matrix3::from_diagonal(&[3.0, 0.0, 0.0].into()))?;
//! assert_eq!(cauchy.first_piola(&stretch).power_per_reference_volume(&rate), 6.0);
//! assert_eq!(cauchy.von_mises(), 8.0);
//! # Ok::<(), piola_continuum::ContinuumError>(())
//! ```
//!
//! # Tractions and areas
//! ```text
//! t = T n  W(16.4)     P N     n da = J F⁻ᵀ N dA     g = J |F⁻ᵀ N| g̃  B(4.39)     f = J f̃  B(4.38)
//! ```
//! Normals are [`UnitNormal`] in space and [`ReferenceNormal`] in the reference body, of length one by construction.
//! Methods: [`CauchyStress::traction`], [`CauchyStress::shear_traction`], [`FirstPiola::traction`],
//! [`ReferenceNormal::deformed`]; functions: [`reference_surface_force`], [`reference_force_per_volume`] and, for Cauchy's
//! tetrahedron, [`oblique_traction`].
//!
//! # Invariants, principal stresses, derivatives
//! [`CauchyStress`] and [`KirchhoffStress`] have them as methods; the formulas, and both conventions of the Lode
//! angle, are in [`invariants`], derivatives for flow rules in [`gradients`], directions and Mohr's circles in
//! [`PrincipalStresses`]. Tension is positive. Stresses from 10⁻³⁰⁰ to 10³⁰⁰ Pa are no special cases.
//!
//! # Stress power
//! ```text
//! T : D = tr(T L)   per deformed volume  W(20.8)
//! τ : D = P : Ḟ = S : Ė = sym(Rᵀ P) : U̇ = M : F⁻¹ Ḟ = J tr(T L)   per reference volume  W(20.15)
//! ```
//! `power_per_deformed_volume` and `power_per_reference_volume` of each measure; rates are those of
//! [`rates`](crate::rates).

mod area;
mod conversions;
mod deviator;
pub mod gradients;
pub mod invariants;
pub(crate) mod kernels;
mod measures;
mod methods;
mod normal;
mod power;
mod principal;
pub mod rates;
mod symmetry;
pub mod tangents;
mod traction;
mod transformation;

pub use area::{DeformedArea, reference_force_per_volume, reference_surface_force};
pub use invariants::HaighWestergaard;
pub use measures::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
pub use normal::{ReferenceNormal, UnitNormal};
pub use principal::{MohrCircle, PrincipalStresses};
pub use symmetry::moment_residual;
pub use traction::oblique_traction;
