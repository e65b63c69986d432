//! Bending of a block by couples, its curved faces free.

use piola_numerics::{Dual, Real};

use super::resultants::of_profile;
use super::{Block, SectorLoads};
use crate::error::check_bound;
use crate::families::BlockBending;
use crate::families::profile::Cylindrical;
use crate::{LoadCurve, ResponseFunctions, SolutionsError};

/// The moment on a bent block over the angle it is bent by, its curved faces free.
///
/// ```text
/// r = √(2 A X)      θ = α Y/length      z = λ Z      A = length/(α λ)
/// r₁ r₂ = A/B,  r₂² − r₁² = 2 A · thickness      (the stretches of the two faces are exchanged, so T_rr is zero at both)
/// M = height · ∫ r P_θY dX      no resultant force on the ends
/// ```
///
/// # Accuracy
/// The moment is one about the axis r = 0 of forces without resultant: it loses (length/(α · thickness))² ulp for small angles.
///
/// # Example
/// Neo-Hookean, α = 1 and all extents 1: r₁ r₂ = 1 and r₂² − r₁² = 2, so that r² = √2 ± 1.
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::loads::{Bending, Block};
/// let law = NeoHookean::new(1.0)?;
/// let bending = Bending { block: Block::new(1.0, 1.0, 1.0)?, law: &law, axial_stretch: 1.0 };
/// let bent = bending.state(1.0)?;
/// assert!((bent.radii[1].powi(2) - (2.0_f64.sqrt() + 1.0)).abs() < 1e-15);
/// assert!(bent.loads.normal_stresses[0].abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. S. Rivlin, Proc. R. Soc. A 195 (1949) 463; family 1.
#[derive(Clone, Copy, Debug)]
pub struct Bending<'a, L> {
    /// The block.
    pub block: Block,
    /// The law.
    pub law: &'a L,
    /// λ along the axis of bending.
    pub axial_stretch: f64,
}

/// A bent block.
///
/// # Example
/// See [`Bending`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BentBlock {
    /// The deformation; the block lies between [`faces`](Self::faces).
    pub deformation: BlockBending,
    /// X of the inner and of the outer face, m.
    pub faces: [f64; 2],
    /// r of the inner and of the outer face, m.
    pub radii: [f64; 2],
    /// The loads per unit of the reference.
    pub loads: SectorLoads,
    /// The moment on each end, N m.
    pub moment: f64,
    /// The axial force that keeps λ, N.
    pub axial_force: f64,
}

impl<L: ResponseFunctions> Bending<'_, L> {
    /// (profile, X of the faces).
    fn profile<T: Real>(&self, angle: T) -> Result<(Cylindrical<T>, [T; 2]), SolutionsError> {
        check_bound("axial stretch", self.axial_stretch, "0 < λ", 0.0 < self.axial_stretch)?;
        check_bound("angle", angle.primal(0), "0 < α", 0.0 < angle.primal(0))?;
        let axial = T::lit(self.axial_stretch);
        let b = angle / T::lit(self.block.length());
        let a = (b * axial).recip();
        let half = a * T::lit(self.block.thickness());
        let product = a / b;
        let outer = half + (half * half + product * product).sqrt();
        let inner = product * product / outer;
        let profile = Cylindrical { a, offset: T::zero(), block: [b, T::zero(), T::zero(), axial], is_sector: false };
        let over = (a + a).recip();
        Ok((profile, [inner * over, outer * over]))
    }

    /// The state at an angle, rad.
    ///
    /// # Errors
    /// [`SolutionsError::OutOfBounds`] unless 0 < α and 0 < λ; what the law refuses.
    pub fn state(&self, angle: f64) -> Result<BentBlock, SolutionsError> {
        let (profile, faces) = self.profile(angle)?;
        let loads = of_profile::<_, 6>(&profile, self.law, (faces[0], faces[1]), 0.0)?;
        let [b, c, d, e] = profile.block;
        Ok(BentBlock {
            deformation: BlockBending::isochoric([b, c, d, e])?,
            faces,
            radii: faces.map(|x| profile.radius(x)),
            loads,
            moment: loads.bending_moment * self.block.height(),
            axial_force: loads.axial_force * self.block.length(),
        })
    }
}

impl<L: ResponseFunctions> LoadCurve for Bending<'_, L> {
    const LOAD: &'static str = "moment";
    const PARAMETER: &'static str = "angle";

    fn load_and_slope(&self, angle: f64) -> Result<[f64; 2], SolutionsError> {
        let (profile, [first, second]) = self.profile(Dual::variable(angle))?;
        let loads = of_profile::<_, 11>(&profile, self.law, (first, second), Dual::constant(0.0))?;
        let moment = loads.bending_moment * Dual::constant(self.block.height());
        Ok([moment.value, moment.tangent])
    }
}
