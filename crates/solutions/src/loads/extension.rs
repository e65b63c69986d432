//! Homogeneous deformation of a block.

use piola_numerics::{Dual, Real};
use piola_tensor::internal::rows::{cofactor, product};

use super::Block;
use crate::error::{check_bound, check_finite};
use crate::families::{Datum, Family, IsochoricDeformation};
use crate::{LoadCurve, LocalDeformation, ResponseFunctions, SolutionsError};

/// Forces on the faces of a block in a homogeneous deformation, family 0.
///
/// ```text
/// forces[a] = P e_a · (area of the face X_a = constant)        P = T Cof F
/// dE = Σ forces[a] · (extent along X_a) dF e_a        with the stored energy E of the block, det F = 1
/// ```
/// # Example
/// A cube of 1 m is sheared, x = X + ½ Y: the face above is pulled along x by μ k.
/// ```
/// use nalgebra::Matrix3;
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::families::IsochoricDeformation;
/// use piola_solutions::loads::{Block, FaceForces};
/// let shear = Matrix3::new(1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
/// let shear = IsochoricDeformation::new(shear, [0.0; 3])?;
/// let loads = FaceForces::of_block(&shear, &NeoHookean::new(2.0)?, &Block::new(1.0, 1.0, 1.0)?, 0.0)?;
/// assert_eq!(loads.forces[1][0], 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceForces {
    /// On the faces of constant X, Y, Z on the side of larger coordinates: their components x, y, z, N.
    pub forces: [[f64; 3]; 3],
}

impl FaceForces {
    /// Of a block with `T_xx` given, Pa.
    ///
    /// # Errors
    /// What the law refuses; [`SolutionsError::NotFinite`].
    ///
    /// # Accuracy
    /// A few ulp of the largest term of T times the cofactor of F.
    pub fn of_block(
        deformation: &IsochoricDeformation,
        law: &impl ResponseFunctions,
        block: &Block,
        stress: f64,
    ) -> Result<Self, SolutionsError> {
        let datum = Datum { reference: [0.0; 3], stress };
        let cauchy = deformation.stress(law, &datum, [0.0; 3])?.cauchy.0.rows();
        let first_piola = product(cauchy, cofactor(deformation.gradient::<f64>([0.0; 3])));
        let extents = [block.thickness(), block.length(), block.height()];
        let area = |a: usize| extents[(a + 1) % 3] * extents[(a + 2) % 3];
        Ok(Self { forces: [0, 1, 2].map(|a| [0, 1, 2].map(|i: usize| first_piola[i][a] * area(a))) })
    }
}

/// What the faces Z = constant of a block do while it is pulled along Y.
///
/// # Example
/// See [`BlockExtension`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlockSides {
    /// They are free: `λ_z` = λ^(−½), simple extension.
    Free,
    /// They are held at their distance: `λ_z` = 1, planar extension.
    Held,
    /// They are pulled as far: `λ_z` = λ, equibiaxial extension.
    Pulled,
}

/// The force along Y on a block over its stretch, its faces X = constant free.
///
/// ```text
/// F = diag(1/(λ λ_z), λ, λ_z)        T_xx = 0        N = (N_yy − N_xx)/λ · thickness · height
/// ```
/// Its states are those of family 0. Where the curve has limit points a force has several of them.
///
/// # Example
/// A neo-Hookean block, N = μ A (λ − λ⁻²).
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::LoadCurve;
/// use piola_solutions::loads::{Block, BlockExtension, BlockSides};
/// let law = NeoHookean::new(4.0)?;
/// let pulled = BlockExtension { block: Block::new(0.5, 2.0, 1.0)?, law: &law, sides: BlockSides::Free };
/// assert_eq!(pulled.point(2.0)?.load, 3.5); // 2 (2 − ¼)
/// let states = pulled.states_at(3.5, (0.5, 4.0))?;
/// assert!(states.len() == 1 && (states[0].parameter - 2.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W §25, family 0; R. S. Rivlin, Phil. Trans. R. Soc. A 240 (1948) 459.
#[doc(alias("uniaxial", "biaxial", "pure shear", "dead load"))]
#[derive(Clone, Copy, Debug)]
pub struct BlockExtension<'a, L> {
    /// The block, pulled along its length.
    pub block: Block,
    /// The law.
    pub law: &'a L,
    /// What the faces Z = constant do.
    pub sides: BlockSides,
}

/// A block that is pulled.
///
/// # Example
/// See [`BlockExtension`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtendedBlock {
    /// The deformation.
    pub deformation: IsochoricDeformation,
    /// The stretches along X, Y, Z.
    pub stretches: [f64; 3],
    /// The force on the faces of constant Y, N.
    pub force: f64,
    /// The force on the faces of constant Z, N: zero where they are free.
    pub side_force: f64,
}

impl<L: ResponseFunctions> BlockExtension<'_, L> {
    fn stretches<T: Real>(&self, stretch: T) -> [T; 3] {
        let across = match self.sides {
            BlockSides::Free => stretch.sqrt().recip(),
            BlockSides::Held => T::one(),
            BlockSides::Pulled => stretch,
        };
        [(stretch * across).recip(), stretch, across]
    }

    /// The forces on the faces of constant Y and Z.
    fn forces<T: Real>(&self, [x, y, z]: [T; 3]) -> Result<[T; 2], SolutionsError> {
        let zero = T::zero();
        let local = LocalDeformation::of([[x, zero, zero], [zero, y, zero], [zero, zero, z]]);
        let [xx, yy, zz, ..] = local.checked_stress(self.law)?.components;
        let area = |extent: f64| T::lit(self.block.thickness() * extent);
        let side = match self.sides {
            BlockSides::Free => zero,
            BlockSides::Held | BlockSides::Pulled => (zz - xx) / z * area(self.block.length()),
        };
        Ok([(yy - xx) / y * area(self.block.height()), side])
    }

    /// The state at a stretch.
    ///
    /// # Errors
    /// [`SolutionsError::OutOfBounds`] unless 0 < λ; what the law refuses.
    pub fn state(&self, stretch: f64) -> Result<ExtendedBlock, SolutionsError> {
        check_bound("stretch", stretch, "0 < λ", 0.0 < stretch)?;
        let stretches = self.stretches(stretch);
        let [force, side_force] = self.forces(stretches)?;
        check_finite("force", &[force, side_force])?;
        let gradient = nalgebra::Matrix3::from_diagonal(&stretches.into());
        Ok(ExtendedBlock { deformation: IsochoricDeformation::new(gradient, [0.0; 3])?, stretches, force, side_force })
    }
}

impl<L: ResponseFunctions> LoadCurve for BlockExtension<'_, L> {
    const LOAD: &'static str = "force";
    const PARAMETER: &'static str = "stretch";

    fn load_and_slope(&self, stretch: f64) -> Result<[f64; 2], SolutionsError> {
        check_bound("stretch", stretch, "0 < λ", 0.0 < stretch)?;
        let [force, _] = self.forces(self.stretches(Dual::variable(stretch)))?;
        Ok([force.value, force.tangent])
    }
}
