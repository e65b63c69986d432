//! Plane strain and plane stress of any law: stress and tangent of the plane.

use nalgebra::Matrix3;
use piola_continuum::DisplacementGradient;
use piola_solids::Response;

use crate::LawsError;

/// Stress and tangent of a sheet in the plane 1, 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneState {
    /// P₁₁, P₁₂, P₂₁, P₂₂, Pa.
    pub first_piola: [f64; 4],
    /// Their derivatives by F₁₁, F₁₂, F₂₁, F₂₂, Pa; in plane stress those at P₃₃ = 0.
    pub tangent: [[f64; 4]; 4],
    /// F₃₃.
    pub thickness_stretch: f64,
    /// P₃₃, Pa.
    pub normal_stress: f64,
}

/// The places of 11, 12, 21 and 22 among nine.
const PLACES: [usize; 4] = [0, 1, 3, 4];
/// The place of 33.
const NORMAL: usize = 8;
/// Iterations for F₃₃.
const MOST_ITERATIONS: usize = 50;

fn at(gradient: &[[f64; 2]; 2], thickness_stretch: f64) -> Result<DisplacementGradient, LawsError> {
    let [[a, b], [c, d]] = *gradient;
    let h = Matrix3::new(a - 1.0, b, 0.0, c, d - 1.0, 0.0, 0.0, 0.0, thickness_stretch - 1.0);
    Ok(DisplacementGradient::new(h)?)
}

/// Stress and tangent in plane strain, F₃₃ = 1.
///
/// # Errors
/// [`LawsError::Continuum`], [`LawsError::Solids`] where the law refuses.
///
/// # Example
/// ```
/// use piola_laws::plane::plane_strain;
/// use piola_solids::SaintVenantKirchhoff;
/// let state = plane_strain(&SaintVenantKirchhoff::new(1.0, 2.0)?, &[[2.0, 0.0], [0.0, 1.0]])?;
/// assert_eq!((state.first_piola[0], state.normal_stress), (15.0, 1.5)); // F₁₁ (λ + 2 μ) E₁₁, λ E₁₁
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn plane_strain(law: &impl Response, gradient: &[[f64; 2]; 2]) -> Result<PlaneState, LawsError> {
    let deformation = at(gradient, 1.0)?;
    law.admits(&deformation)?;
    let (stress, tangent) = law.stress_and_tangent(&deformation);
    let entries = tangent.0.components;
    Ok(PlaneState {
        first_piola: PLACES.map(|place| stress.0[(place / 3, place % 3)]),
        tangent: PLACES.map(|row| PLACES.map(|column| entries[row][column])),
        thickness_stretch: 1.0,
        normal_stress: stress.0[(2, 2)],
    })
}

/// Stress and tangent in plane stress: F₃₃ is such that P₃₃ = 0.
///
/// ```text
/// Ā = A − A₍₎₃₃ ⊗ A₃₃₍₎/A₃₃₃₃
/// ```
/// The plane must be one of the law's planes of symmetry, so that P₁₃ = P₂₃ = 0. The law may be a step of a solid with internal variables.
///
/// # Errors
/// [`LawsError::Continuum`], [`LawsError::Solids`] where the law refuses; [`LawsError::NoPlaneStress`] where no F₃₃ is found, with the best one.
///
/// # Accuracy
/// P₃₃ is rounding of the stresses; Newton's method in ln F₃₃.
///
/// # Example
/// ```
/// use piola_laws::plane::plane_stress;
/// use piola_solids::Hencky;
/// let state = plane_stress(&Hencky::new(2.0, 1.0)?, &[[1.5, 0.0], [0.0, 1.0]])?;
/// assert!((state.thickness_stretch - 1.5_f64.powf(-0.5)).abs() < 1e-14); // ln F₃₃ = −λ/(λ + 2 μ) (ln F₁₁ + ln F₂₂)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn plane_stress(law: &impl Response, gradient: &[[f64; 2]; 2]) -> Result<PlaneState, LawsError> {
    let mut logarithm = 0.0_f64;
    let mut best = (f64::INFINITY, 1.0);
    for _ in 0..MOST_ITERATIONS {
        let stretch = logarithm.exp();
        let deformation = at(gradient, stretch)?;
        law.admits(&deformation)?;
        let (stress, tangent) = law.stress_and_tangent(&deformation);
        let entries = tangent.0.components;
        let (normal, stiffness) = (stress.0[(2, 2)], entries[NORMAL][NORMAL]);
        if normal.abs() < best.0 {
            best = (normal.abs(), stretch);
        }
        let step = -normal / (stiffness * stretch);
        if !(step.is_finite() && 0.0 < stiffness) {
            break;
        }
        if step.abs() <= 16.0 * f64::EPSILON {
            let condensed = |row: usize, column: usize| {
                entries[row][column] - entries[row][NORMAL] * entries[NORMAL][column] / stiffness
            };
            return Ok(PlaneState {
                first_piola: PLACES.map(|place| stress.0[(place / 3, place % 3)]),
                tangent: PLACES.map(|row| PLACES.map(|column| condensed(row, column))),
                thickness_stretch: stretch,
                normal_stress: normal,
            });
        }
        // No step changes the thickness by more than a factor of two.
        logarithm += step.clamp(-0.7, 0.7);
    }
    Err(LawsError::NoPlaneStress { normal_stress: best.0, thickness_stretch: best.1 })
}
