//! Outputs that need the deformation alone.

use piola_continuum::Deformation;
use piola_continuum::strain::{GreenStrain, LeftCauchyGreen, RightCauchyGreen};

use super::quantity;
use crate::engine::parts::flat;

quantity! {
    /// J = det F.
    ///
    /// # Example
    /// Every request of this family is made and evaluated in the same way.
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{DeformationGradient, Symmetric};
    /// let f = [DeformationGradient::diagonal([2.0, 0.5, 0.5])?; 1000];
    /// let (mut j, mut u) = (vec![0.0; 1000], vec![Symmetric::zero(); 1000]);
    /// batch::evaluate(&f[..], (batch::jacobian(&mut j[..]), batch::right_stretch(&mut u[..])))?;
    /// assert_eq!((j[7], u[7].components[0]), (0.5, 2.0));
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    jacobian() Jacobian: () [0] => Self [1], "", |point, _| [point.jacobian()];
    /// C = Fᵀ F: see [`RightCauchyGreen`].
    right_cauchy_green() RightCauchyGreenOutput: () [0] => Self [6], "",
        |point, _| RightCauchyGreen::of(point).0.components;
    /// B = F Fᵀ: see [`LeftCauchyGreen`].
    left_cauchy_green() LeftCauchyGreenOutput: () [0] => Self [6], "",
        |point, _| LeftCauchyGreen::of(point).0.components;
    /// E = ½ (C − 1): see [`GreenStrain`].
    green_strain() GreenStrainOutput: () [0] => Self [6], "", |point, _| GreenStrain::of(point).0.components;
    /// R of F = R U, by rows.
    rotation() Rotation: () [0] => Self [9], "", stretches |point, _| flat(point.stretch().rotation());
    /// U = √C.
    right_stretch() RightStretch: () [0] => Self [6], "",
        stretches |point, _| point.stretch().right_stretch().components;
    /// V = √B.
    left_stretch() LeftStretch: () [0] => Self [6], "", stretches |point, _| point.stretch().left_stretch().components;
    /// ln U, Hencky's strain in the reference configuration.
    hencky() Hencky: () [0] => Self [6], "", stretches |point, _| point.stretch().hencky_material().components;
    /// ln V, Hencky's strain in the deformed configuration.
    spatial_hencky() SpatialHencky: () [0] => Self [6], "",
        stretches |point, _| point.stretch().hencky_spatial().components;
    /// The principal stretches λ₁ ≥ λ₂ ≥ λ₃.
    principal_stretches() PrincipalStretches: () [0] => Self [3], "",
        stretches |point, _| point.stretch().principal_stretches();
}
