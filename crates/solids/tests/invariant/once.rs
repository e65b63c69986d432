//! A law whose answers are each compiled once for a scalar, however many tests ask for them.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::Real;
use piola_solids::{Hyperelastic, SolidsError};

/// A law behind functions that are not inlined. Its answers are those of the law to the last bit.
pub(super) struct Once<'a, L>(pub(super) &'a L);

/// Forwards methods of a deformation to the law.
macro_rules! forward {
    ($($method:ident -> $result:ty),+ $(,)?) => { $(
        #[inline(never)]
        fn $method<T: Real>(&self, deformation: &impl Deformation<T>) -> $result {
            self.0.$method(deformation)
        }
    )+ };
}

impl<L: Hyperelastic> Hyperelastic for Once<'_, L> {
    const REFUSED_IS_NOT_FINITE: bool = L::REFUSED_IS_NOT_FINITE;
    const KNOWS_DEFORMATIONS: bool = L::KNOWS_DEFORMATIONS;

    forward! {
        energy -> T,
        check -> Result<(), SolidsError>,
        first_piola -> FirstPiola<T>,
        energy_and_first_piola -> (T, FirstPiola<T>),
        energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>),
        second_piola -> SecondPiola<T>,
        kirchhoff -> KirchhoffStress<T>,
        cauchy -> CauchyStress<T>,
        first_piola_tangent -> FirstPiolaTangent<T>,
        first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>),
        material_tangent -> MaterialTangent<T>,
        truesdell_tangent -> TruesdellTangent<T>,
        second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>),
        cauchy_and_tangent -> (CauchyStress<T>, TruesdellTangent<T>),
    }

    fn reference_energy(&self) -> f64 {
        self.0.reference_energy()
    }

    fn is_incompressible(&self) -> bool {
        self.0.is_incompressible()
    }

    #[inline(never)]
    fn first_piola_derivative<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
        direction: &Matrix3<T>,
    ) -> FirstPiola<T> {
        self.0.first_piola_derivative(deformation, direction)
    }
}
