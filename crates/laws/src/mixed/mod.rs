//! Mixed forms for nearly incompressible and incompressible bodies: deformation, volume and pressure as separate unknowns.
//!
//! ```text
//! Π(F, θ, p) = W(F̃) + p (J − θ)        F̃ = (θ/J)^(1/3) F,   J = det F
//! ```
//! | form | unknowns | use | for |
//! |---|---|---|---|
//! | three-field | F, θ, p | [`ThreeField::of`], [`ThreeField::checked`] | any law |
//! | u–p | F, p | [`two_field`]; [`ThreeField::condensed`] within an iteration on θ | any law; θ = 1 where the law is incompressible |
//!
//! p is the mean Cauchy stress, Pa, positive in tension: minus the pressure. θ is the volume of the material in the law, relative to
//! the reference. In equilibrium θ = J and p = ⅓ tr T, and the stress is that of the law itself.
//!
//! # References
//! J. C. Simo, R. L. Taylor, K. S. Pister, Comput. Methods Appl. Mech. Eng. 51 (1985) 177–208. T. Sussman, K. J. Bathe, Comput.
//! Struct. 26 (1987) 357–409.

mod resized;
mod three_field;
mod two_field;

pub use three_field::ThreeField;
pub use two_field::{TwoField, two_field};
