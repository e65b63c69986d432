//! Laws of solids: made from a text, a fit or numbers, evaluated at many points.

use std::ffi::c_char;

use piola::solids::AnySolid;

use super::PiolaStatus;
use super::memory::{
    check_apart, choice, hand_over, handle, optional_text, points, points_mut, slice, slice_mut, text, texts,
};
use super::status::answer;
use crate::points::{StressMeasure, TangentMeasure, VoigtNumbering};
use crate::{FfiError, named, points, text};

/// A law of a solid. Made by `piola_solid_from_*`, freed by `piola_solid_free`.
#[derive(Debug)]
pub struct PiolaSolid(AnySolid);

/// A measure of stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum PiolaStress {
    /// Cauchy stress T, Pa.
    Cauchy = 0,
    /// First Piola-Kirchhoff stress P, Pa.
    FirstPiola = 1,
    /// Second Piola-Kirchhoff stress S, Pa.
    SecondPiola = 2,
}

/// A tangent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum PiolaTangent {
    /// dP/dF, Pa: 81 numbers a point, row 3 i + A, column 3 j + B.
    FirstPiola = 0,
    /// dS/dE, Pa: 36 numbers a point.
    Material = 1,
    /// Tangent of Truesdell's rate of T, Pa: 36 numbers a point.
    Truesdell = 2,
    /// Tangent of Jaumann's rate of the Kirchhoff stress, over J, Pa (DDSDDE of Abaqus): 36 numbers a point.
    Jaumann = 3,
}

/// The order of the six pairs of indices in tangents of 36 numbers, which multiply engineering shears.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum PiolaVoigt {
    /// 11, 22, 33, 12, 23, 13.
    Piola = 0,
    /// 11, 22, 33, 12, 13, 23.
    Abaqus = 1,
    /// 11, 22, 33, 23, 13, 12.
    Classical = 2,
}

/// Makes a law from JSON, such as `{"law": "saint_venant_kirchhoff", "first_lame_parameter": 1e6, "shear_modulus": 2e6}`.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_solid_from_json(json: *const c_char, made: *mut *mut PiolaSolid) -> PiolaStatus {
    // SAFETY: as the caller promises.
    answer(|| unsafe { hand_over(made, || Ok(PiolaSolid(text::solid_from_json(text("json", json)?)?))) })
}

/// Makes the law of a fit from the text of its `summary.json`.
///
/// `model` chooses one of its laws, such as `yeoh`; a null pointer chooses the best by `aicc`. `volumetric` is the energy of the
/// change of volume in JSON, such as `{"law": "quadratic", "bulk_modulus": 2e9}`; with a null pointer the law is incompressible. Parameters
/// are converted from the `stress_unit` of the summary to Pa.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_solid_from_fit(
    summary: *const c_char,
    model: *const c_char,
    volumetric: *const c_char,
    made: *mut *mut PiolaSolid,
) -> PiolaStatus {
    let make = || {
        // SAFETY: as the caller promises.
        let (summary, model, volumetric) = unsafe {
            (text("summary", summary)?, optional_text("model", model)?, optional_text("volumetric", volumetric)?)
        };
        let volumetric = volumetric.map(text::volumetric_from_json).transpose()?;
        Ok(PiolaSolid(text::solid_from_fit(summary, model, volumetric)?))
    };
    // SAFETY: as the caller promises.
    answer(|| unsafe { hand_over(made, make) })
}

/// Makes a law from its name, such as `compressible-gent-simo_taylor`, and its parameters in the order of the reference.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_solid_from_values(
    name: *const c_char,
    values: *const f64,
    count: usize,
    made: *mut *mut PiolaSolid,
) -> PiolaStatus {
    // SAFETY: as the caller promises.
    let make = || unsafe { Ok(PiolaSolid(named::solid(text("name", name)?, slice("values", values, count)?)?)) };
    // SAFETY: as the caller promises.
    answer(|| unsafe { hand_over(made, make) })
}

/// Makes a law from its name and `count` parameters by name, in any order.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_solid_from_names(
    name: *const c_char,
    names: *const *const c_char,
    values: *const f64,
    count: usize,
    made: *mut *mut PiolaSolid,
) -> PiolaStatus {
    let make = || {
        // SAFETY: as the caller promises.
        let (name, names, values) =
            unsafe { (text("name", name)?, texts("names", names, count)?, slice("values", values, count)?) };
        Ok(PiolaSolid(named::solid_with_names(name, &names, values)?))
    };
    // SAFETY: as the caller promises.
    answer(|| unsafe { hand_over(made, make) })
}

/// Frees a law; a null pointer is no fault.
///
/// # Safety
/// The law comes from this library and was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_solid_free(solid: *mut PiolaSolid) {
    if !solid.is_null() {
        // SAFETY: made by `hand_over`, as the caller promises.
        drop(unsafe { Box::from_raw(solid) });
    }
}

/// A law, deformations and memory for one kind of numbers.
type Evaluation<'a> = (&'a AnySolid, &'a [[f64; 9]], &'a mut [f64]);

/// What an evaluation of one kind of numbers is given.
///
/// # Safety
/// See the [module](super).
unsafe fn evaluation<'a>(
    solid: *const PiolaSolid,
    f: *const f64,
    f_length: usize,
    out: *mut f64,
    out_length: usize,
) -> Result<Evaluation<'a>, FfiError> {
    check_apart(&[("out", out, out_length)], &[("f", f, f_length)])?;
    // SAFETY: as the caller promises.
    let (solid, f, out) =
        unsafe { (handle("solid", solid)?, slice("f", f, f_length)?, slice_mut("out", out, out_length)?) };
    Ok((&solid.0, points("f", f)?, out))
}

/// Stress at n points.
///
/// `stress` is a `PiolaStress`. `f` has the deformation gradients, nine numbers a point by rows; `out` gets the stresses, Pa, nine
/// numbers a point by rows. Both lengths are 9 n numbers. After `PIOLA_STATUS_BAD_POINTS` the stresses of bad points are NaN, and all
/// others are written.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_stress(
    solid: *const PiolaSolid,
    stress: i32,
    f: *const f64,
    f_length: usize,
    out: *mut f64,
    out_length: usize,
) -> PiolaStatus {
    answer(|| {
        // SAFETY: as the caller promises.
        let (law, f, out) = unsafe { evaluation(solid, f, f_length, out, out_length)? };
        let measure = choice("stress", &StressMeasure::ALL, stress)?;
        points::stress(law, measure, f, points_mut("out", out)?)
    })
}

/// Strain energy at n points, J/m^3 of the reference, less that of the undeformed body.
///
/// `f` has the deformation gradients, 9 n numbers by rows; `out` gets n numbers. After `PIOLA_STATUS_BAD_POINTS` the energies of bad
/// points are NaN, and all others are written.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_energy(
    solid: *const PiolaSolid,
    f: *const f64,
    f_length: usize,
    out: *mut f64,
    out_length: usize,
) -> PiolaStatus {
    answer(|| {
        // SAFETY: as the caller promises.
        let (law, f, out) = unsafe { evaluation(solid, f, f_length, out, out_length)? };
        points::energy(law, f, out)
    })
}

/// Tangent at n points.
///
/// `tangent` is a `PiolaTangent`, `voigt` a `PiolaVoigt`. `out` gets 81 or 36 numbers a point, Pa, by rows.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_tangent(
    solid: *const PiolaSolid,
    tangent: i32,
    voigt: i32,
    f: *const f64,
    f_length: usize,
    out: *mut f64,
    out_length: usize,
) -> PiolaStatus {
    answer(|| {
        // SAFETY: as the caller promises.
        let (law, f, out) = unsafe { evaluation(solid, f, f_length, out, out_length)? };
        let measure = choice("tangent", &TangentMeasure::ALL, tangent)?;
        let numbering = choice("Voigt order", &VoigtNumbering::ALL, voigt)?;
        points::tangent(law, measure, numbering, f, out)
    })
}

/// Stress and tangent at n points, the law evaluated once for both.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_stress_and_tangent(
    solid: *const PiolaSolid,
    stress: i32,
    tangent: i32,
    voigt: i32,
    f: *const f64,
    f_length: usize,
    stresses: *mut f64,
    stresses_length: usize,
    tangents: *mut f64,
    tangents_length: usize,
) -> PiolaStatus {
    answer(|| {
        let outputs = [
            ("stresses", stresses.cast_const(), stresses_length),
            ("tangents", tangents.cast_const(), tangents_length),
        ];
        check_apart(&outputs, &[("f", f, f_length)])?;
        // SAFETY: as the caller promises.
        let (solid, f) = unsafe { (handle("solid", solid)?, slice("f", f, f_length)?) };
        // SAFETY: as the caller promises.
        let (stresses, tangents) = unsafe {
            (slice_mut("stresses", stresses, stresses_length)?, slice_mut("tangents", tangents, tangents_length)?)
        };
        let measures =
            (choice("stress", &StressMeasure::ALL, stress)?, choice("tangent", &TangentMeasure::ALL, tangent)?);
        let numbering = choice("Voigt order", &VoigtNumbering::ALL, voigt)?;
        let outputs = (points_mut("stresses", stresses)?, tangents);
        points::stress_and_tangent(&solid.0, measures, numbering, points("f", f)?, outputs)
    })
}
