//! A law's answers, each compiled once for a scalar.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::Real;
use piola_solids::Hyperelastic;

macro_rules! answers {
    ($($name:ident -> $answer:ty),+) => { $(
        #[inline(never)]
        pub(super) fn $name<T: Real, L: Hyperelastic>(law: &L, deformation: &impl Deformation<T>) -> $answer {
            law.$name(deformation)
        }
    )+ };
}
answers!(
    energy -> T,
    first_piola -> FirstPiola<T>,
    second_piola -> SecondPiola<T>,
    kirchhoff -> KirchhoffStress<T>,
    first_piola_tangent -> FirstPiolaTangent<T>,
    first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>)
);
