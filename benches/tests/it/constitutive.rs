//! What the bench of laws states as their error is the error of the law with those parameters, and their formulas from
//! textbooks are the same laws.

use std::error::Error;

use nalgebra::{Matrix3, Rotation3, Vector3};
use piola_benches::constitutive::Printed;
use piola_benches::constitutive::laws::{self, Visit};
use piola_benches::constitutive::naive::{self, Naive, Textbook};
use piola_benches::continuum::ordinary_deformations;
use piola_continuum::DeformationGradient;
use piola_solids::Hyperelastic;

struct Accurate(usize);

impl Visit for Accurate {
    fn law<L: Hyperelastic + Textbook + Sync>(
        &mut self,
        name: &'static str,
        model: Option<&'static str>,
        law: &L,
    ) -> Result<(), Box<dyn Error>> {
        let [stress, tangent] = laws::errors_near_identity(model, law)?;
        assert!(stress <= 1e-13, "{name}: P within {stress:e} near the identity");
        assert!(tangent <= 1e-12, "{name}: ∂P/∂F within {tangent:e} near the identity");
        self.0 += 1;
        Ok(())
    }
}

#[test]
fn laws_that_are_measured_are_accurate_near_the_identity() -> Result<(), Box<dyn Error>> {
    let mut visited = Accurate(0);
    laws::each(&mut visited)?;
    laws::each_incompressible(&mut visited)?;
    assert_eq!(visited.0, 25);
    Ok(())
}

#[test]
fn batches_of_a_formula_that_cancels_are_not() -> Result<(), Box<dyn Error>> {
    let rubber = laws::mooney_rivlin()?;
    let printed = Printed {
        c10: rubber.c10(),
        c01: rubber.c01(),
        c: rubber.square_coefficient(),
        d: rubber.logarithm_coefficient(),
    };
    let error = laws::batch_stress_error_near_identity(Some("mooney_rivlin_compressible"), &printed)?;
    assert!(1e-12 < error, "{error:e}");
    Ok(())
}

#[test]
fn batches_keep_their_digits_near_the_identity_whatever_the_layout() -> Result<(), Box<dyn Error>> {
    let (model, rubber) = (Some("mooney_rivlin_compressible"), laws::mooney_rivlin()?);
    let stress = laws::batch_stress_error_near_identity(model, &rubber)?;
    let tangent = laws::batch_tangent_error_near_identity(model, &rubber)?;
    assert!(stress <= 1e-13 && tangent <= 1e-12, "P within {stress:e}, ∂P/∂F within {tangent:e}");
    let expected = [stress, tangent].map(f64::to_bits);
    assert_eq!(laws::array_errors_near_identity(model, &rubber)?.map(f64::to_bits), expected);
    assert_eq!(laws::matrix_errors_near_identity(model, &rubber)?.map(f64::to_bits), expected);
    Ok(())
}

/// The textbook's formula beside ours.
struct Same<'a> {
    deformations: &'a [DeformationGradient],
    /// A law that is left out.
    except: Option<&'static str>,
}

impl Same<'_> {
    /// All laws at all deformations; of incompressible laws at what is left of these without their change of volume.
    fn everywhere(deformations: &[DeformationGradient], except: Option<&'static str>) -> Result<(), Box<dyn Error>> {
        laws::each(&mut Same { deformations, except })?;
        let isochoric: Vec<_> = deformations.iter().map(laws::unimodular).collect::<Result<_, _>>()?;
        laws::each_incompressible(&mut Same { deformations: &isochoric, except })
    }
}

impl Visit for Same<'_> {
    fn law<L: Hyperelastic + Textbook + Sync>(
        &mut self,
        name: &'static str,
        _model: Option<&'static str>,
        law: &L,
    ) -> Result<(), Box<dyn Error>> {
        if self.except == Some(name) {
            return Ok(());
        }
        let theirs = law.textbook();
        for deformation in self.deformations {
            let f = deformation.matrix();
            let [stress, tangent] = naive::differences(law, &theirs, deformation);
            assert!(stress <= naive::AGREEMENT, "{name}: P differs by {stress:e} at {f}");
            assert!(tangent <= naive::AGREEMENT, "{name}: ∂P/∂F differs by {tangent:e} at {f}");
            assert_eq!(theirs.first_piola_and_tangent(f), (theirs.first_piola(f), theirs.first_piola_tangent(f)));
        }
        Ok(())
    }
}

#[test]
fn formulas_from_textbooks_are_the_same_laws() -> Result<(), Box<dyn Error>> {
    Same::everywhere(&ordinary_deformations(64), None)
}

/// The deformation of these principal stretches, turned, and turned before.
fn turned(stretches: [f64; 3]) -> Result<[DeformationGradient; 3], Box<dyn Error>> {
    let (turn, stretch) =
        (Rotation3::new(Vector3::new(0.3, -0.8, 0.5)).into_inner(), Matrix3::from_diagonal(&stretches.into()));
    let of = DeformationGradient::new;
    Ok([of(stretch)?, of(turn * stretch)?, of(turn * stretch * turn.transpose())?])
}

#[test]
fn formulas_from_textbooks_hold_where_stretches_are_equal() -> Result<(), Box<dyn Error>> {
    let two = [turned([1.25, 1.25, 0.75])?, turned([1.0, 1.5, 1.5])?].concat();
    Same::everywhere(&two, None)?;
    // A mere change of volume is where the tangent of fibres that bear tension only jumps.
    Same::everywhere(&turned([1.25; 3])?, Some("holzapfel_gasser_ogden"))
}
