//! Stresses and tangents of other measures from P and a tangent ∂P/∂F that may lack the major symmetry.

use piola::continuum::DeformationGradient;
use piola::continuum::FirstPiola;
use piola::inelastic::AnyAdvanced;
use piola::tensor::voigt::{Abaqus, Classical, Piola, StiffnessMatrix};
use piola::tensor::{MinorSymmetric, Symmetric};

use crate::points::{StressMeasure, TangentMeasure, VoigtNumbering};

/// The stress by rows.
pub(super) fn stress(
    first_piola: &FirstPiola,
    measure: StressMeasure,
    deformation: &DeformationGradient,
    out: &mut [f64; 9],
) {
    let symmetric: Symmetric = match measure {
        StressMeasure::FirstPiola => {
            for (place, entry) in out.iter_mut().enumerate() {
                *entry = first_piola.0[(place / 3, place % 3)];
            }
            return;
        }
        StressMeasure::Cauchy => first_piola.kirchhoff(deformation).cauchy(deformation).0,
        StressMeasure::SecondPiola => first_piola.second_piola(deformation).0,
    };
    out.copy_from_slice(symmetric.rows().as_flattened());
}

/// The tangent: 81 or 36 numbers by rows.
pub(super) fn tangent(
    advanced: &AnyAdvanced,
    measure: TangentMeasure,
    numbering: VoigtNumbering,
    deformation: &DeformationGradient,
    out: &mut [f64],
) {
    let AnyAdvanced { first_piola, tangent, .. } = advanced;
    let cauchy = || first_piola.kirchhoff(deformation).cauchy(deformation);
    let six: MinorSymmetric = match measure {
        TangentMeasure::FirstPiola => {
            out.copy_from_slice(tangent.0.components.as_flattened());
            return;
        }
        TangentMeasure::Material => tangent.material(&first_piola.second_piola(deformation), deformation).0,
        TangentMeasure::Truesdell => tangent.spatial(&cauchy(), deformation).0,
        TangentMeasure::Jaumann => {
            let stress = cauchy();
            tangent.spatial(&stress, deformation).jaumann(&stress).0
        }
    };
    let entries = match numbering {
        VoigtNumbering::Piola => StiffnessMatrix::<f64, Piola>::of(&six).entries,
        VoigtNumbering::Abaqus => StiffnessMatrix::<f64, Abaqus>::of(&six).entries,
        VoigtNumbering::Classical => StiffnessMatrix::<f64, Classical>::of(&six).entries,
    };
    out.copy_from_slice(entries.as_flattened());
}
