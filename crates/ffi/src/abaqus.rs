//! What the user subroutines UMAT and VUMAT of Abaqus need, on plain arrays in Abaqus' layouts.
//!
//! | | UMAT | VUMAT |
//! |---|---|---|
//! | deformation | F before and after, by columns | U before and after, in the corotated frame |
//! | stress | T: 11, 22, 33, 12, 13, 23 | Rᵀ T R: 11, 22, 33, 12, 23, 13 |
//! | tangent | of Jaumann's rate of τ, over J: `DDSDDE` | none is computed |
//! | state | `STATEV` | `stateOld` to `stateNew`, each variable an array |
//! | points a call | 1 | a block, each component an array |
//!
//! A law with history takes one implicit step an increment; its tangent is consistent, and not symmetric in general. A state of zeros, with
//! which Abaqus begins, stands for the undeformed body. The state of `thermal` is the temperature at the end of the increment; Abaqus gives it,
//! and zero is a temperature like any other. An elastic law uses the deformation after alone, and leaves the state as it is.

use crate::FfiError;
use crate::blocks::BLOCK;
use crate::error::{Failures, check_finite, check_length};
use crate::materials::MaterialLaw;
use crate::points::{StressMeasure, TangentMeasure, VoigtNumbering, stress, stress_and_tangent};

/// Refuses components other than those of solid elements: 3 and 3, and 3 and 1 of plane strain and axial symmetry.
fn check_components(direct: usize, shear: usize) -> Result<(), FfiError> {
    if direct == 3 && matches!(shear, 1 | 3) { Ok(()) } else { Err(FfiError::Components { direct, shear }) }
}

/// An increment of one point for UMAT.
///
/// # Example
/// See [`umat`].
#[derive(Clone, Copy, Debug)]
pub struct PointIncrement<'a> {
    /// F by columns before and after: `DFGRD0` and `DFGRD1`.
    pub f: [&'a [f64; 9]; 2],
    /// The time that it takes, s: `DTIME`.
    pub dt: f64,
    /// The temperature after, in the unit of the law's reference temperature: `TEMP` + `DTEMP`. Only `thermal` uses it.
    pub temperature: f64,
}

/// T, `DDSDDE` and the new state of one point.
///
/// | argument | meaning | length |
/// |---|---|---|
/// | `components` | numbers of direct and of shear components | |
/// | `increment` | F before and after, time, temperature | |
/// | `state` | `STATEV` | that of the law with history; any of an elastic law |
/// | `stress_out` | `STRESS` | `NTENS` |
/// | `tangent_out` | `DDSDDE` by columns | `NTENS²` |
///
/// # Errors
/// [`FfiError::Components`], [`FfiError::WrongLength`], [`FfiError::NotFinite`]; [`FfiError::BadPoints`] of an elastic law and
/// `BadIncrements` of a law with history where it has no answer: all is left as it is.
///
/// # Example
/// ```
/// use piola::solids::{AnySolid, SaintVenantKirchhoff};
/// use piola_ffi::abaqus::{PointIncrement, umat};
/// let material = AnySolid::from(SaintVenantKirchhoff::new(1.0, 2.0)?).into();
/// let (mut stress, mut tangent) = ([0.0; 6], [0.0; 36]);
/// let still = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
/// let increment = PointIncrement { f: [&still, &still], dt: 1.0, temperature: 0.0 };
/// umat(&material, [3, 3], increment, &mut [], &mut stress, &mut tangent)?;
/// assert_eq!((tangent[0], tangent[1], tangent[21]), (5.0, 1.0, 2.0)); // λ + 2 μ, λ, μ
/// # #[cfg(feature = "history")] {
/// let metal = piola_ffi::named::history("viscoplastic-hencky-lame", &[1.0, 1.0, 0.01, 0.0, 0.01, 0.0, 0.0])?.into();
/// let sheared = [1.0, 0.0, 0.0, 0.1, 1.0, 0.0, 0.0, 0.0, 1.0];
/// let (increment, mut state) = (PointIncrement { f: [&still, &sheared], ..increment }, [0.0; 10]);
/// umat(&metal, [3, 3], increment, &mut state, &mut stress, &mut tangent)?;
/// assert!((stress[3] - 0.01 / 3.0_f64.sqrt()).abs() < 1e-4 && 0.0 < state[9]); // σ₀/√3
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn umat(
    material: &MaterialLaw,
    components: [usize; 2],
    increment: PointIncrement<'_>,
    state: &mut [f64],
    stress_out: &mut [f64],
    tangent_out: &mut [f64],
) -> Result<(), FfiError> {
    let [direct, shear] = components;
    check_components(direct, shear)?;
    let count = direct + shear;
    if let Some(length) = material.state_length() {
        check_length("STATEV", length, state.len())?;
    }
    check_length("STRESS", count, stress_out.len())?;
    check_length("DDSDDE", count * count, tangent_out.len())?;
    if material.state_length().is_some() {
        check_finite("temperature", &[increment.temperature])?;
    }
    let by_rows = |[a, b, c, d, e, g, h, i, j]: [f64; 9]| [[a, d, h, b, e, i, c, g, j]];
    let [from, to] = increment.f.map(|f| by_rows(*f));
    let (mut whole, mut tangent) = ([[0.0; 9]], [0.0; 36]);
    match material {
        MaterialLaw::Elastic(law) => {
            let measures = (StressMeasure::Cauchy, TangentMeasure::Jaumann);
            stress_and_tangent(law, measures, VoigtNumbering::Abaqus, &to, (&mut whole, &mut tangent))?;
        }
        #[cfg(feature = "history")]
        MaterialLaw::History(law) => {
            let PointIncrement { dt, temperature, .. } = increment;
            crate::history::abaqus::point(law, [&from, &to], (dt, temperature), state, &mut whole, &mut tangent)?;
        }
    }
    #[cfg(not(feature = "history"))]
    let _ = (from, state);
    let [[t11, t12, t13, _, t22, t23, _, _, t33]] = whole;
    for (out, component) in stress_out.iter_mut().zip([t11, t22, t33, t12, t13, t23]) {
        *out = component;
    }
    for (place, out) in tangent_out.iter_mut().enumerate() {
        *out = tangent[6 * (place % count) + place / count];
    }
    Ok(())
}

/// An increment of many points for VUMAT.
///
/// # Example
/// See [`vumat`].
#[derive(Clone, Copy, Debug)]
pub struct Stretching<'a> {
    /// U before: `stretchOld`; 1 where it is empty.
    pub before: &'a [f64],
    /// U after: `stretchNew`.
    pub after: &'a [f64],
    /// This number is added to the diagonal of `after`: 0 where `after` holds stretches U, 1 where it holds strains U − 1, as in the first call
    /// of a run, which asks for the stiffness of the undeformed body.
    pub added: f64,
    /// The time that it takes, s.
    pub dt: f64,
    /// The temperatures after: `tempNew`; that of the state where it is empty, and where that is zero the reference temperature. Only `thermal`
    /// uses them.
    pub temperatures: &'a [f64],
}

/// Rᵀ T R and the new states of many points from their stretches.
///
/// ```text
/// component k of point i at k n + i      U: `stretchOld`, `stretchNew`      Rᵀ T(F) R = T(U)      states: `stateOld`, `stateNew`
/// ```
/// States of an elastic law are copied.
///
/// # Errors
/// [`FfiError::Components`], [`FfiError::WrongLength`], [`FfiError::NotFinite`]; [`FfiError::BadPoints`] of an elastic law and
/// `BadIncrements` of a law with history where it has no answer: the stresses of these points are NaN.
///
/// # Example
/// ```
/// use piola::solids::{AnySolid, SaintVenantKirchhoff};
/// use piola_ffi::abaqus::{Stretching, vumat};
/// let material = AnySolid::from(SaintVenantKirchhoff::new(1.0, 2.0)?).into();
/// let stretches = [2.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0]; // of two points in plane strain
/// let stretching = Stretching { before: &[], after: &stretches, added: 0.0, dt: 1.0, temperatures: &[] };
/// let mut stress = [0.0; 8];
/// vumat(&material, [3, 1], stretching, (&[], &mut []), &mut stress)?;
/// assert_eq!(&stress[..2], [15.0, 0.0]); // F₁₁² (λ + 2 μ) E₁₁/J; at rest
/// # #[cfg(feature = "history")] {
/// let metal = piola_ffi::named::history("viscoplastic-hencky-lame", &[1.0, 1.0, 0.01, 0.0, 0.01, 0.0, 0.0])?.into();
/// let (old, mut new, mut stress) = ([0.0; 10], [0.0; 10], [0.0; 4]); // one point in plane strain
/// let stretching = Stretching { after: &[1.1, 0.9, 1.0, 0.0], ..stretching };
/// vumat(&metal, [3, 1], stretching, (&old, &mut new), &mut stress)?;
/// assert!((stress[0] - stress[1] - 2.0 * 0.01 / 3.0_f64.sqrt()).abs() < 1e-3); // T₁₁ − T₂₂ = 2 σ₀/√3
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn vumat(
    material: &MaterialLaw,
    components: [usize; 2],
    stretching: Stretching<'_>,
    (old, new): (&[f64], &mut [f64]),
    stress_out: &mut [f64],
) -> Result<(), FfiError> {
    let [direct, shear] = components;
    check_components(direct, shear)?;
    let Stretching { before, after, added, temperatures, .. } = stretching;
    let count = direct + shear;
    let points = after.len() / count;
    check_length("stretchNew", points * count, after.len())?;
    if !before.is_empty() {
        check_length("stretchOld", after.len(), before.len())?;
    }
    if !temperatures.is_empty() {
        check_length("tempNew", points, temperatures.len())?;
    }
    check_length("stressNew", after.len(), stress_out.len())?;
    if let Some(length) = material.state_length() {
        check_length("stateOld", points * length, old.len())?;
    }
    check_length("stateNew", old.len(), new.len())?;
    check_finite("stretchNew", after)?;
    let has_history = material.state_length().is_some();
    if has_history {
        check_finite("stretchOld", before)?;
        check_finite("tempNew", temperatures)?;
        check_finite("stateOld", old)?;
    }
    let mut failures = Failures::default();
    let still = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let (mut from, mut to, mut whole) = ([still; BLOCK], [still; BLOCK], [[0.0; 9]; BLOCK]);
    for start in (0..points).step_by(BLOCK) {
        let here = BLOCK.min(points - start);
        let stretches = |all: &[f64], added: f64, f: &mut [[f64; 9]]| {
            for (index, f) in f.iter_mut().enumerate() {
                let u = |k: usize| if k < count { all[k * points + start + index] } else { 0.0 };
                let (u11, u22, u33) = (u(0) + added, u(1) + added, u(2) + added);
                *f = [u11, u(3), u(5), u(3), u22, u(4), u(5), u(4), u33];
            }
        };
        stretches(after, added, &mut to[..here]);
        if has_history && !before.is_empty() {
            stretches(before, 0.0, &mut from[..here]);
        }
        let (from, to, whole) = (&from[..here], &to[..here], &mut whole[..here]);
        failures.note(
            start,
            match material {
                MaterialLaw::Elastic(law) => stress(law, StressMeasure::Cauchy, to, whole),
                #[cfg(feature = "history")]
                MaterialLaw::History(law) => {
                    let increment =
                        crate::history::DeformationIncrement { from, to, dt: stretching.dt, tolerance: None };
                    crate::history::abaqus::block(law, increment, (start, points), temperatures, (old, new), whole)
                }
            },
        )?;
        #[cfg(not(feature = "history"))]
        let _ = from;
        for (index, [t11, t12, t13, _, t22, t23, _, _, t33]) in whole.iter().enumerate() {
            for (k, component) in [t11, t22, t33, t12, t23, t13].into_iter().take(count).enumerate() {
                stress_out[k * points + start + index] = *component;
            }
        }
    }
    if matches!(material, MaterialLaw::Elastic(_)) {
        new.copy_from_slice(old);
    }
    failures.finish(points)
}
