//! Does an energy state an elastic solid? What the compiler cannot find out.

use nalgebra::{Matrix3, Rotation3, Vector3};
use piola_continuum::{DeformationGradient, DisplacementGradient};
use piola_solids::Hyperelastic;

use crate::LawsError;

/// Looks for what an energy must not do: answers that are not finite, an energy or a stress of the undeformed body, another energy for
/// another observer. Finding nothing proves nothing.
///
/// The energy and its derivatives are asked at some thirty deformations with strains up to `strain`, the same in every run. A body that is
/// meant to have a stress in its reference configuration, such as a grown one, is reported as well.
///
/// # Errors
/// [`LawsError`]: the first violated condition; [`LawsError::OutOfBounds`] unless `strain` is finite and positive.
///
/// # Example
/// ```
/// use piola_continuum::Deformation;
/// use piola_laws::{LawsError, examine};
/// use piola_numerics::Real;
/// use piola_solids::{Hyperelastic, SaintVenantKirchhoff};
///
/// struct Wrong; // (F₁₁ − 1)²: not the same for all observers
/// impl Hyperelastic for Wrong {
///     fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
///         let stretch = deformation.displacement_rows()[0][0];
///         stretch * stretch
///     }
/// }
/// assert!(matches!(examine(&Wrong, 0.2), Err(LawsError::DependsOnObserver { .. })));
/// assert_eq!(examine(&SaintVenantKirchhoff::new(1.0, 2.0)?, 0.2), Ok(()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn examine(law: &impl Hyperelastic, strain: f64) -> Result<(), LawsError> {
    if !(strain.is_finite() && 0.0 < strain) {
        return Err(LawsError::OutOfBounds { quantity: "strain", value: strain, bound: "0 < strain" });
    }
    let rest = DisplacementGradient::<f64>::new(Matrix3::zeros()).unwrap_or_default();
    finite(law, &rest)?;
    let (stress, tangent) = law.second_piola_and_tangent(&rest);
    let modulus = largest(&tangent.0.components);
    let energy = law.energy(&rest);
    if ROUNDING * modulus < energy.abs() {
        return Err(LawsError::ReferenceEnergy { energy });
    }
    let stress = largest(&stress.0.components);
    if ROUNDING * modulus < stress {
        return Err(LawsError::ReferenceStress { stress, modulus });
    }
    for number in 0..DEFORMATIONS {
        let share = f64::from(number + 1) / f64::from(DEFORMATIONS);
        let entry = |k: i32| strain * share * (f64::from(9 * number + k) * 2.399_963).sin();
        let h = Matrix3::from_fn(|i, j| entry([0, 3, 6][i] + [0, 1, 2][j]));
        // Strains for which there is no such deformation, or that the law refuses, are left out.
        let Ok(deformation) = DisplacementGradient::new(h) else { continue };
        if law.check(&deformation).is_err() {
            continue;
        }
        finite(law, &deformation)?;
        let gradient = Matrix3::identity() + h;
        let axis = Vector3::new(entry(9), entry(10), entry(11)).normalize();
        let turned = Rotation3::new(axis * (0.3 + 2.5 * share)).into_inner() * gradient;
        let Ok(seen) = DeformationGradient::new(turned) else { continue };
        let (energy, turned): (f64, f64) = (law.energy(&deformation), law.energy(&seen));
        // F keeps fewer digits than ∇u does.
        if 1e3 * ROUNDING * (energy.abs() + modulus) < (energy - turned).abs() {
            return Err(LawsError::DependsOnObserver { energy, turned, gradient: rows(&gradient) });
        }
    }
    Ok(())
}

/// Rounding of terms of the size of the moduli.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
const DEFORMATIONS: i32 = 30;

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, x| size.max(x.abs()))
}

fn rows(matrix: &Matrix3<f64>) -> [[f64; 3]; 3] {
    piola_numerics::linear::matrix3::rows_of(matrix)
}

/// Refuses answers that are not finite.
fn finite(law: &impl Hyperelastic, deformation: &DisplacementGradient) -> Result<(), LawsError> {
    let (energy, stress, tangent) = law.energy_first_piola_and_tangent(deformation);
    let stress = rows(&stress.0);
    let answers: [(&'static str, &[f64]); 3] =
        [("W", &[energy]), ("P", stress.as_flattened()), ("∂P/∂F", tangent.0.components.as_flattened())];
    for (quantity, values) in answers {
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            let gradient = rows(&(Matrix3::identity() + deformation.matrix()));
            return Err(LawsError::NotFinite { quantity, index, value: values[index], gradient });
        }
    }
    Ok(())
}
