//! Tangents of one measure from those of another.

use piola_continuum::stress::tangents::{
    FirstPiolaTangent, JaumannTangent, LieTangent, MaterialTangent, TruesdellTangent,
};
use piola_continuum::{CauchyStress, SecondPiola};
use piola_tensor::{MajorSymmetric, Symmetric};

use super::quantity;
use crate::engine::parts::part;
use crate::engine::tangents::entries;

quantity! {
    /// c = `F_iA F_jB F_kC F_lD C_ABCD`, the push-forward of ∂S/∂E: see [`MaterialTangent::lie`].
    ///
    /// # Example
    /// Every request of this family is made and evaluated in the same way.
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::DeformationGradient;
    /// use piola_tensor::MajorSymmetric;
    /// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?];
    /// let (material, mut spatial) = ([MajorSymmetric::isotropic(1.0, 1.0)], [MajorSymmetric::zero()]);
    /// batch::evaluate(&f[..], batch::push_forward_tangent(&material[..], &mut spatial[..]))?;
    /// assert_eq!(spatial[0].components[0], 48.0); // 2⁴ × 3
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    push_forward_tangent(tangent: S) PushForwardTangent: MaterialTangent [21] => LieTangent [21], "MaterialTangent",
        |point, components| MaterialTangent::<T>(MajorSymmetric { components }).lie(point).0.components;
    /// c/J: see [`MaterialTangent::truesdell`].
    truesdell_tangent(tangent: S)
        TruesdellTangentOutput: MaterialTangent [21] => TruesdellTangent [21], "MaterialTangent",
        |point, components| MaterialTangent::<T>(MajorSymmetric { components }).truesdell(point).0.components;
    /// ∂P/∂F of S and ∂S/∂E: see [`MaterialTangent::first_piola`].
    first_piola_tangent(stress: S, tangent: C)
        FirstPiolaTangentOutput: (SecondPiola, MaterialTangent) [27] => FirstPiolaTangent [81],
        "SecondPiola and MaterialTangent", |point, input| {
            let stress = SecondPiola(Symmetric { components: part(&input, 0) });
            let tangent = MaterialTangent::<T>(MajorSymmetric { components: part(&input, 6) });
            entries(&tangent.first_piola(&stress, point).0)
        };
    /// Jaumann's tangent (`DDSDDE` of Abaqus) of T and c/J: see [`TruesdellTangent::jaumann`].
    jaumann_tangent(stress: S, tangent: C)
        JaumannTangentOutput: (CauchyStress, TruesdellTangent) [27] => JaumannTangent [21],
        "CauchyStress and TruesdellTangent", |_, input| {
            let stress = CauchyStress(Symmetric { components: part(&input, 0) });
            let tangent = TruesdellTangent::<T>(MajorSymmetric { components: part(&input, 6) });
            tangent.jaumann(&stress).0.components
        };
}
