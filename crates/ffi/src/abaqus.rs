//! What the user subroutines UMAT and VUMAT of Abaqus need, on plain arrays in Abaqus' layouts.
//!
//! | | UMAT | VUMAT |
//! |---|---|---|
//! | deformation | F, by columns | U in the corotated frame |
//! | stress | T: 11, 22, 33, 12, 13, 23 | Rᵀ T R: 11, 22, 33, 12, 23, 13 |
//! | tangent | of Jaumann's rate of τ, over J: `DDSDDE` | – |
//! | points a call | 1 | a block, each component an array |

use piola::solids::AnySolid;

use crate::FfiError;
use crate::error::{check_finite, check_length};
use crate::points::{StressMeasure, TangentMeasure, VoigtNumbering, stress, stress_and_tangent};

/// Refuses components other than those of solid elements: 3 and 3, and 3 and 1 of plane strain and axial symmetry.
pub(crate) fn check_components(direct: usize, shear: usize) -> Result<(), FfiError> {
    if direct == 3 && matches!(shear, 1 | 3) { Ok(()) } else { Err(FfiError::Components { direct, shear }) }
}

/// T and `DDSDDE` of one point.
///
/// | argument | meaning | length |
/// |---|---|---|
/// | `components` | numbers of direct and of shear components | |
/// | `f` | F by columns, `DFGRD1` | 9 |
/// | `stress_out` | `STRESS` | `NTENS` |
/// | `tangent_out` | `DDSDDE`, symmetric | `NTENS²` |
///
/// # Errors
/// [`FfiError::Components`], [`FfiError::WrongLength`]; [`FfiError::BadPoints`] where the law has no answer: both outputs are
/// left as they are.
///
/// # Example
/// ```
/// use piola::solids::SaintVenantKirchhoff;
/// let law = SaintVenantKirchhoff::new(1.0, 2.0)?.into();
/// let (mut stress, mut tangent) = ([0.0; 6], [0.0; 36]);
/// let still = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
/// piola_ffi::abaqus::umat(&law, [3, 3], &still, &mut stress, &mut tangent)?;
/// assert_eq!((tangent[0], tangent[1], tangent[21]), (5.0, 1.0, 2.0)); // λ + 2 μ, λ, μ
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn umat(
    law: &AnySolid,
    components: [usize; 2],
    f: &[f64; 9],
    stress_out: &mut [f64],
    tangent_out: &mut [f64],
) -> Result<(), FfiError> {
    let [direct, shear] = components;
    check_components(direct, shear)?;
    let count = direct + shear;
    check_length("STRESS", count, stress_out.len())?;
    check_length("DDSDDE", count * count, tangent_out.len())?;
    let [a, b, c, d, e, g, h, i, j] = *f;
    let by_rows = [[a, d, h, b, e, i, c, g, j]];
    let (mut whole, mut tangent) = ([[0.0; 9]], [0.0; 36]);
    let measures = (StressMeasure::Cauchy, TangentMeasure::Jaumann);
    stress_and_tangent(law, measures, VoigtNumbering::Abaqus, &by_rows, (&mut whole, &mut tangent))?;
    let [[t11, t12, t13, _, t22, t23, _, _, t33]] = whole;
    for (out, component) in stress_out.iter_mut().zip([t11, t22, t33, t12, t13, t23]) {
        *out = component;
    }
    for (row, out) in tangent_out.chunks_mut(count).enumerate() {
        out.copy_from_slice(&tangent[6 * row..6 * row + count]);
    }
    Ok(())
}

/// Points of a block.
const BLOCK: usize = 128;

/// Rᵀ T R of many points from the stretches U.
///
/// ```text
/// component k of point i at k n + i      U: `stretchNew`      Rᵀ T(F) R = T(U)
/// ```
/// `added` is added to the diagonal: 1 makes U of small strains, as in the first call of a run, which asks for the stiffness of
/// the undeformed body by small strain increments.
///
/// # Errors
/// [`FfiError::Components`], [`FfiError::WrongLength`], [`FfiError::NotFinite`]; [`FfiError::BadPoints`] where the law has no answer: the stresses of
/// these points are NaN.
///
/// # Example
/// ```
/// use piola::solids::SaintVenantKirchhoff;
/// let law = SaintVenantKirchhoff::new(1.0, 2.0)?.into();
/// let mut stress = [0.0; 8]; // of two points in plane strain
/// piola_ffi::abaqus::vumat(&law, [3, 1], &[2.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0], 0.0, &mut stress)?;
/// assert_eq!(&stress[..2], [15.0, 0.0]); // F₁₁² (λ + 2 μ) E₁₁/J; at rest
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn vumat(
    law: &AnySolid,
    components: [usize; 2],
    stretches: &[f64],
    added: f64,
    stress_out: &mut [f64],
) -> Result<(), FfiError> {
    let [direct, shear] = components;
    check_components(direct, shear)?;
    let count = direct + shear;
    let points = stretches.len() / count;
    check_length("stretchNew", points * count, stretches.len())?;
    check_length("stressNew", stretches.len(), stress_out.len())?;
    check_finite("stretchNew", stretches)?;
    let (mut failed, mut first_error) = (0, None);
    let (mut f, mut whole) = ([[0.0; 9]; BLOCK], [[0.0; 9]; BLOCK]);
    for start in (0..points).step_by(BLOCK) {
        let here = BLOCK.min(points - start);
        for (index, f) in f[..here].iter_mut().enumerate() {
            let u = |k: usize| if k < count { stretches[k * points + start + index] } else { 0.0 };
            let (u11, u22, u33) = (u(0) + added, u(1) + added, u(2) + added);
            *f = [u11, u(3), u(5), u(3), u22, u(4), u(5), u(4), u33];
        }
        match stress(law, StressMeasure::Cauchy, &f[..here], &mut whole[..here]) {
            Err(FfiError::BadPoints { bad, index, error, .. }) => {
                failed += bad;
                first_error.get_or_insert((start + index, error));
            }
            result => result?,
        }
        for (index, [t11, t12, t13, _, t22, t23, _, _, t33]) in whole[..here].iter().enumerate() {
            for (k, component) in [t11, t22, t33, t12, t23, t13].into_iter().take(count).enumerate() {
                stress_out[k * points + start + index] = *component;
            }
        }
    }
    match first_error {
        None => Ok(()),
        Some((index, error)) => Err(FfiError::BadPoints { bad: failed, count: points, index, error }),
    }
}
