//! Prony series of finite-element programs.

use core::fmt::Write as _;

use piola_spectra::RelaxationSpectrum;

use crate::MeasuredError;
use crate::fitting::Program;

/// The most modes of `FEBio`.
const MOST_OF_FEBIO: usize = 6;

/// The card of a spectrum: each modulus over G₀ = Gₑ + Σ gᵢ, so that the elastic law of the program is that of fast loads.
///
/// ```text
/// Abaqus   *VISCOELASTIC, TIME=PRONY: gᵢ/G₀, 0, τᵢ       G(t)/G₀ = 1 − Σ (gᵢ/G₀)(1 − exp(−t/τᵢ))
/// Ansys    TB,PRONY,1,1,n,SHEAR: gᵢ/G₀, τᵢ               the same
/// FEBio    uncoupled viscoelastic: g0 = Gₑ/G₀, gᵢ/G₀, tᵢ   G(t)/G₀ = g0 + Σ gᵢ exp(−t/tᵢ)
/// ```
/// `FEBio`'s card takes an elastic law that is uncoupled too, as those of [`card`](crate::fitting::card) are.
/// Times are in s. The change of volume does not relax. LS-DYNA needs more: [`general_viscoelastic`].
///
/// # Errors
/// [`MeasuredError::Argument`] for other programs, and for more than six modes in `FEBio`. `CalculiX` reads no Prony series.
///
/// # Example
/// ```
/// use piola_measured::fitting::Program;
/// use piola_measured::spectra::{RelaxationMode, RelaxationSpectrum, prony};
/// let mode = RelaxationMode { modulus: 3.0, relaxation_time: 0.5 };
/// let gel = RelaxationSpectrum::new(vec![mode], 1.0)?;
/// assert!(prony(Program::Abaqus, &gel)?.contains("\n0.75, 0.0, 0.5\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn prony(program: Program, spectrum: &RelaxationSpectrum) -> Result<String, MeasuredError> {
    let glassy = spectrum.glassy_modulus();
    let terms: Vec<[f64; 2]> =
        spectrum.modes().iter().map(|mode| [mode.modulus / glassy, mode.relaxation_time]).collect();
    let mut text = String::new();
    match program {
        Program::Abaqus => {
            let _ = writeln!(
                text,
                "** instantaneous shear modulus {glassy:?} Pa; the elastic law beside it needs MODULI=INSTANTANEOUS\n\
                 *VISCOELASTIC, TIME=PRONY"
            );
            for [share, time] in terms {
                let _ = writeln!(text, "{share:?}, 0.0, {time:?}");
            }
        }
        Program::Ansys => {
            let _ = writeln!(text, "! instantaneous shear modulus {glassy:?} Pa\nTB,PRONY,1,1,{},SHEAR", terms.len());
            // Six constants a line, from the place that is named.
            for (k, chunk) in terms.chunks(3).enumerate() {
                let numbers: Vec<String> = chunk.iter().flatten().map(|x| format!("{x:?}")).collect();
                let _ = writeln!(text, "TBDATA,{},{}", 6 * k + 1, numbers.join(","));
            }
        }
        Program::FeBio if terms.len() <= MOST_OF_FEBIO => {
            let _ = writeln!(
                text,
                "<!-- instantaneous shear modulus {glassy:?} Pa; put the elastic law inside, as <elastic type=\"Ogden\"> -->"
            );
            text.push_str("<material id=\"1\" type=\"uncoupled viscoelastic\">\n");
            let rest = 1.0 - terms.iter().map(|[share, _]| share).sum::<f64>();
            let _ = writeln!(text, "  <g0>{:?}</g0>", rest.max(0.0));
            for (k, [share, time]) in (1..).zip(terms) {
                let _ = writeln!(text, "  <g{k}>{share:?}</g{k}>\n  <t{k}>{time:?}</t{k}>");
            }
            text.push_str("</material>\n");
        }
        Program::CalculiX => {
            return Err(MeasuredError::Argument {
                argument: "--card calculix".to_owned(),
                valid: "abaqus, ansys, febio or ls-dyna: CalculiX reads no Prony series",
            });
        }
        _ => {
            return Err(MeasuredError::Argument {
                argument: format!("--card of {program} with {} modes", terms.len()),
                valid: "abaqus, ansys, ls-dyna with --bulk-modulus and --density, or febio with at most six modes (--modes 6; --modes 5 for creep of a liquid)",
            });
        }
    }
    Ok(text)
}

/// The most terms of LS-DYNA.
const MOST_OF_LS_DYNA: usize = 18;

/// The card of a spectrum for LS-DYNA, material 76: a linear viscoelastic solid, with its moduli themselves.
///
/// ```text
/// *MAT_GENERAL_VISCOELASTIC: gᵢ, βᵢ = 1/τᵢ; Gₑ with β = 0      G(t) = Σ gᵢ exp(−βᵢ t)
/// ```
/// Units are SI: kg/m³, Pa, 1/s. The change of volume is elastic, with the bulk modulus.
///
/// # Errors
/// [`MeasuredError::Argument`] for a bulk modulus or a density that is not positive and finite, and for more than 18 terms.
///
/// # Example
/// ```
/// use piola_measured::spectra::{RelaxationMode, RelaxationSpectrum, general_viscoelastic};
/// let mode = RelaxationMode { modulus: 3.0, relaxation_time: 0.5 };
/// let gel = RelaxationSpectrum::new(vec![mode], 1.0)?;
/// let card = general_viscoelastic(&gel, 1e9, 1000.0)?;
/// assert!(card.contains("\n3.0,2.0\n1.0,0.0\n")); // β = 1/0.5
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn general_viscoelastic(
    spectrum: &RelaxationSpectrum,
    bulk_modulus: f64,
    density: f64,
) -> Result<String, MeasuredError> {
    for (name, value) in [("bulk modulus", bulk_modulus), ("density", density)] {
        if !(0.0 < value && value.is_finite()) {
            let argument = format!("{name} {value}");
            return Err(MeasuredError::Argument { argument, valid: "a finite number greater than zero" });
        }
    }
    let mut terms: Vec<[f64; 2]> =
        spectrum.modes().iter().map(|mode| [mode.modulus, mode.relaxation_time.recip()]).collect();
    if !spectrum.is_liquid() {
        terms.push([spectrum.equilibrium_modulus(), 0.0]);
    }
    if MOST_OF_LS_DYNA < terms.len() {
        let argument = format!("--card ls-dyna with {} terms", terms.len());
        return Err(MeasuredError::Argument { argument, valid: "at most 18 terms (--modes 17)" });
    }
    // Free format, comma separated. The second card stays blank: the constants are given, not fitted by LS-DYNA.
    let mut text = format!("$ SI: kg/m^3, Pa, 1/s\n*MAT_GENERAL_VISCOELASTIC\n1,{density:?},{bulk_modulus:?}\n\n");
    for [modulus, rate] in terms {
        let _ = writeln!(text, "{modulus:?},{rate:?}");
    }
    Ok(text)
}
