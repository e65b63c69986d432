//! Material symmetry.

use nalgebra::Matrix3;

use super::law::drawn;
use super::{Elastic, Report, Sampler, Search, SymmetryGroup};

/// A deformation, and the same after a change of the reference that should not be felt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Images {
    /// F.
    pub gradient: Matrix3<f64>,
    /// H of the group.
    pub element: Matrix3<f64>,
    /// G(F), Pa.
    pub stress: Matrix3<f64>,
    /// G(F H), Pa: should be the same.
    pub image: Matrix3<f64>,
}

/// Tries to refute G(F H) = G(F) for H of the group, W(18.27).
///
/// Finite groups are gone through element by element, with as many deformations each as samples allow, at least one.
///
/// # Example
/// A law with a preferred direction is not isotropic, but symmetric about that direction.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_specimens::checks::{Search, SymmetryGroup, material_symmetry};
/// let law = |f: &Matrix3<f64>| { let a = f * Vector3::z(); f * f.transpose() + a * a.transpose() };
/// let search = Search::default();
/// assert!(!material_symmetry(&law, &SymmetryGroup::isotropic(), &search).passes());
/// let about = SymmetryGroup::transversely_isotropic([0.0, 0.0, 1.0])?;
/// assert!(material_symmetry(&law, &about, &search).passes());
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
#[must_use]
pub fn material_symmetry(law: &impl Elastic, group: &SymmetryGroup, search: &Search) -> Report<Images> {
    let mut sampler = Sampler::new(search.seed);
    let count = search.samples.max(group.order().unwrap_or(0));
    let samples = (0..count).map(|k| {
        let (gradient, element) = (drawn(law, &mut sampler, search.strain), group.element(k, &mut sampler));
        let changed = gradient * element;
        // Where but one of the two is refused the limit of the law has less symmetry, which its stress need not show.
        if !law.answers(&gradient) || !law.answers(&changed) {
            return None;
        }
        let (stress, image) = (law.cauchy(&gradient), law.cauchy(&changed));
        let scale = stress.norm().max(image.norm());
        Some(((image - stress).norm(), scale, Images { gradient, element, stress, image }))
    });
    Report::of(search, samples)
}
