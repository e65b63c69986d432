//! Stresses and tangents of a law at many points, from and to the caller's memory.
//!
//! Points pass through the stages of a computation in lanes, block by block: the law, P and the upper triangle of ∂P/∂F,
//! other measures. An evaluation allocates nothing; with feature `rayon`, the first large batch starts the threads.
//!
//! ```
//! use piola::solids::SaintVenantKirchhoff;
//! use piola_ffi::points::{StressMeasure, TangentMeasure, stress, tangent};
//! let law = SaintVenantKirchhoff::new(1.0, 2.0)?.into();
//! let f = [[2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]; 100]; // E₁₁ = 3/2
//! let mut t = [[0.0; 9]; 100];
//! stress(&law, StressMeasure::Cauchy, &f, &mut t)?;
//! assert_eq!(t[7][0], 15.0); // F₁₁² (λ + 2 μ) E₁₁/J
//! let mut c = vec![0.0; 3600];
//! tangent(&law, TangentMeasure::Material, VoigtNumbering::Piola, &f, &mut c)?;
//! assert_eq!(c[0], 5.0); // λ + 2 μ
//! # use piola_ffi::points::VoigtNumbering;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use piola::solids::{AnySolid, Hyperelastic, SolidsError};

use crate::FfiError;
use crate::error::check_length;
use crate::evaluation::{Bad, Evaluation, Part, Wanted, deformation, finished};
pub use crate::measures::{StressMeasure, TangentMeasure, VoigtNumbering};

/// The stress at each point, nine components by rows. Of a law of linear elasticity it is σ in every measure.
///
/// | argument | meaning | shape | unit |
/// |---|---|---|---|
/// | `f` | F by rows | n × 9 | – |
/// | `out` | the stress by rows | n × 9 | Pa |
///
/// # Errors
/// [`FfiError::WrongLength`] unless `out` has as many points as `f`, before anything is computed;
/// [`FfiError::BadPoints`] where F is not finite, 0 < det F fails, the law has no answer or a number of the result overflows: the
/// numbers of these points are NaN, those of all others are written.
///
/// # Accuracy
/// That of the law's P; T and S add 8 ulp of |P| |F|/J and of |F⁻¹| |P|.
///
/// # Example
/// See the [module](self).
pub fn stress(law: &AnySolid, measure: StressMeasure, f: &[[f64; 9]], out: &mut [[f64; 9]]) -> Result<(), FfiError> {
    check_length("stresses", f.len(), out.len())?;
    let wanted = Wanted { stress: Some(measure), tangent: None };
    Evaluation::new(law, wanted)?.run(Part { first: 0, f, stresses: out, tangents: &mut [] })
}

/// W(F) − W(1) at each point, J/m³.
///
/// Points are computed one after the other, not in lanes: a sum of energies is wanted once where stresses are wanted often, and
/// energies in lanes would lengthen the build of this library.
///
/// # Errors
/// As [`stress`].
///
/// # Accuracy
/// That of the law's energy.
///
/// # Example
/// ```
/// use piola::solids::SaintVenantKirchhoff;
/// let law = SaintVenantKirchhoff::new(1.0, 2.0)?.into();
/// let mut w = [0.0];
/// piola_ffi::points::energy(&law, &[[2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]], &mut w)?;
/// assert_eq!(w[0], 5.625); // ½ (λ + 2 μ) E₁₁², E₁₁ = 3/2
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn energy(law: &AnySolid, f: &[[f64; 9]], out: &mut [f64]) -> Result<(), FfiError> {
    check_length("energies", f.len(), out.len())?;
    let mut bad = Bad::default();
    for (index, (f, out)) in f.iter().zip(out).enumerate() {
        *out = energy_at(law, f).unwrap_or_else(|error| {
            bad.note(index, error);
            f64::NAN
        });
    }
    finished(bad, f.len())
}

fn energy_at(law: &AnySolid, f: &[f64; 9]) -> Result<f64, SolidsError> {
    let energy = law.energy(&deformation(law, f)?);
    if energy.is_finite() { Ok(energy) } else { Err(SolidsError::Overflow { answer: "energy" }) }
}

/// The tangent at each point, by rows: 81 numbers for ∂P/∂F, 36 in the order of `numbering` for the others. Of a law of linear
/// elasticity it is ∂σ/∂ε in every measure.
///
/// # Errors
/// As [`stress`]; `out` must hold [`TangentMeasure::numbers`] for each point.
///
/// # Accuracy
/// That of the law's ∂P/∂F, and the roundings of the conversions, 24 ulp of |F|⁴ |F⁻¹|² (|∂P/∂F| + |S|)/J.
///
/// # Example
/// See the [module](self).
pub fn tangent(
    law: &AnySolid,
    measure: TangentMeasure,
    numbering: VoigtNumbering,
    f: &[[f64; 9]],
    out: &mut [f64],
) -> Result<(), FfiError> {
    check_length("tangents", f.len().saturating_mul(measure.numbers()), out.len())?;
    let wanted = Wanted { stress: None, tangent: Some((measure, numbering)) };
    Evaluation::new(law, wanted)?.run(Part { first: 0, f, stresses: &mut [], tangents: out })
}

/// Stress and tangent at each point, the law evaluated once for both: see [`stress`] and [`tangent`].
///
/// # Errors
/// As theirs.
///
/// # Example
/// See the [module](self).
pub fn stress_and_tangent(
    law: &AnySolid,
    (stress, tangent): (StressMeasure, TangentMeasure),
    numbering: VoigtNumbering,
    f: &[[f64; 9]],
    (stresses, tangents): (&mut [[f64; 9]], &mut [f64]),
) -> Result<(), FfiError> {
    check_length("stresses", f.len(), stresses.len())?;
    check_length("tangents", f.len().saturating_mul(tangent.numbers()), tangents.len())?;
    let wanted = Wanted { stress: Some(stress), tangent: Some((tangent, numbering)) };
    Evaluation::new(law, wanted)?.run(Part { first: 0, f, stresses, tangents })
}
