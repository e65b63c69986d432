//! Built-in laws by kind: all laws that share a formula as one type with one kernel.
//!
//! [`AnySolid::visit`] calls a visitor with the type of each law, so that the compiler makes a kernel for each law, request and
//! set of instructions: twenty-nine for each request. [`visit`] calls it with the kind of the law: the formula that makes stress and
//! tangent of what a law gives is compiled once for all laws of a kind, twelve for each request. Laws of straight code run
//! faster in lanes by themselves: `visit` passes them as they are. Some of them are laws of a kind as well: they
//! stand behind a semicolon in the table, and `LawOfInvariants::of` or `LawOfStrain::of` takes them.
//!
//! | kind | laws | what a law gives |
//! |---|---|---|
//! | [`LawOfInvariants`] | shape and volume, incompressible, polynomial; Mooney–Rivlin, neo-Hookean, Blatz–Ko | slopes and curvatures by I₁, I₂, J |
//! | [`LawOfStretches`] | Ogden, incompressible Ogden, Hencky | w′, w″ and divided differences of w′ |
//! | [`LawOfStrain`] | Holzapfel–Gasser–Ogden, reinforced neo-Hookean; St. Venant–Kirchhoff, that of any symmetry, Fung | S and ∂S/∂E |
//! | the law itself | all others | |
//!
//! The code of what a law of a kind gives is short. A program that offers all laws may run it in a first pass and put stress and tangent
//! together in a second one, which is compiled once for the kind. `piola-ffi` does so.

use piola_solids::{AnySolid, SolidVisitor};

pub(crate) mod composition;
mod invariants;
mod strain;
mod stretches;

pub use invariants::LawOfInvariants;
pub use strain::LawOfStrain;
pub use stretches::LawOfStretches;

/// Calls the visitor with the kind of the law; `None` for a law that has no kind yet.
///
/// # Example
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::kinds;
/// use piola_solids::{AnySolid, Hyperelastic, SaintVenantKirchhoff, SolidVisitor};
/// struct Energy(DeformationGradient);
/// impl SolidVisitor for Energy {
///     type Output = f64;
///     fn visit<L: Hyperelastic + Sync>(self, law: &L) -> f64 {
///         law.energy(&self.0)
///     }
/// }
/// let solid = AnySolid::from(SaintVenantKirchhoff::new(1.0, 2.0)?);
/// let bar = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
/// assert_eq!(kinds::visit(&solid, Energy(bar)), Some(5.625)); // ½ (λ + 2 μ) E₁₁²
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn visit<V: SolidVisitor>(solid: &AnySolid, visitor: V) -> Option<V::Output> {
    // Laws of straight code first: they have kinds, too, but are faster in lanes by themselves.
    match solid {
        AnySolid::MooneyRivlin(law) => return Some(visitor.visit(law)),
        AnySolid::NeoHookean(law) => return Some(visitor.visit(law)),
        AnySolid::BlatzKo(law) => return Some(visitor.visit(law)),
        AnySolid::SaintVenantKirchhoff(law) => return Some(visitor.visit(law)),
        AnySolid::AnisotropicSaintVenantKirchhoff(law) => return Some(visitor.visit(law)),
        AnySolid::Fung(law) => return Some(visitor.visit(law)),
        AnySolid::IsochoricOgden(law) => return Some(visitor.visit(law)),
        AnySolid::LinearElastic(law) => return Some(visitor.visit(law)),
        AnySolid::AnisotropicLinear(law) => return Some(visitor.visit(law)),
        _ => {}
    }
    if let Some(law) = LawOfInvariants::of(solid) {
        return Some(visitor.visit(&law));
    }
    if let Some(law) = LawOfStretches::of(solid) {
        return Some(visitor.visit(&law));
    }
    LawOfStrain::of(solid).map(|law| visitor.visit(&law))
}

/// Declares the enum of the laws of a kind and chooses among them.
macro_rules! kind {
    ($(#[$about:meta])* $kind:ident { $($name:ident($law:ty)),+ $(,)? }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum $kind<'a> {
            $(
                #[doc = concat!("[`AnySolid::", stringify!($name), "`](piola_solids::AnySolid::", stringify!($name), ").")]
                $name(&'a $law)
            ),+
        }

        impl<'a> $kind<'a> {
            /// The law, if it is of this kind.
            #[must_use]
            pub const fn of(solid: &'a piola_solids::AnySolid) -> Option<Self> {
                match solid {
                    $(piola_solids::AnySolid::$name(law) => Some(Self::$name(law)),)+
                    _ => None,
                }
            }
        }

        /// An answer of the law, its type known.
        macro_rules! chosen {
            ($self_:expr, $law_:ident => $answer_:expr) => {
                match $self_ { $($kind::$name($law_) => $answer_),+ }
            };
        }
    };
}
use kind;
