//! The command `spectrum`.

use std::path::{Path, PathBuf};

use clap::Args;
use piola_charts::Folder;
use piola_measured::MeasuredError;
use piola_measured::fitting::{Intervals, Program};
use piola_measured::spectra::{
    RelaxationMode, RelaxationSpectrum, SpectrumRequest, SpectrumTable, general_viscoelastic, prony, spectrum_until,
};

use crate::Exit;
use crate::commands::{note, refused};
use crate::flows::{show, watched};
use crate::interrupt::Interrupt;

#[derive(Debug, Args)]
pub(crate) struct SpectrumArguments {
    /// The measurements: CSV of G′ and G″ over the frequency, or of G or of J over the time, with units in the header; several files
    /// for several temperatures.
    #[arg(required = true)]
    pub(crate) data: Vec<PathBuf>,
    /// The number of modes, of creep that of retardation modes; chosen from the data when absent.
    #[arg(long, value_name = "N")]
    pub(crate) modes: Option<usize>,
    /// Fit an equilibrium modulus, as of a solid; without it creep flows in the end.
    #[arg(long)]
    pub(crate) equilibrium: bool,
    /// The temperature of the spectrum, as `150 °C`; without it, the middle one.
    #[arg(long, value_name = "TEMPERATURE", allow_hyphen_values = true)]
    pub(crate) reference_temperature: Option<String>,
    /// Shift temperatures vertically, too.
    #[arg(long)]
    pub(crate) vertical: bool,
    /// How intervals are found: linear. A profile and a bootstrap are refused, because modes that are fitted anew exchange their places.
    #[arg(long, value_name = "KIND", default_value = "linear")]
    pub(crate) intervals: String,
    /// Write the Prony series for abaqus, ansys, febio or ls-dyna; several times for several.
    #[arg(long = "card", value_name = "PROGRAM")]
    pub(crate) cards: Vec<String>,
    /// The bulk modulus, Pa, for the card of LS-DYNA.
    #[arg(long, value_name = "K")]
    pub(crate) bulk_modulus: Option<f64>,
    /// The density, kg/m³, for the card of LS-DYNA.
    #[arg(long, value_name = "RHO")]
    pub(crate) density: Option<f64>,
    /// Folder of the results instead of out/spectrum-DATA.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON to standard output.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Refuses intervals that spectra do not have.
fn linear_alone(intervals: &str) -> Result<(), MeasuredError> {
    match intervals.parse()? {
        Intervals::Linear => Ok(()),
        _ => Err(MeasuredError::Argument {
            argument: format!("--intervals {intervals}"),
            valid: "linear for a spectrum: modes that are fitted anew exchange their places, so that samples of one mode mix",
        }),
    }
}

/// The name of the file of a card, and the card.
fn card(
    text: &str,
    arguments: &SpectrumArguments,
    spectrum: &RelaxationSpectrum,
) -> Result<(String, String), MeasuredError> {
    let program: Program = text.parse()?;
    let card = match (program, arguments.bulk_modulus, arguments.density) {
        (Program::LsDyna, Some(bulk), Some(density)) => general_viscoelastic(spectrum, bulk, density)?,
        _ => prony(program, spectrum)?,
    };
    Ok((format!("{text}-prony.{}", program.ending()), card))
}

pub(crate) fn find(arguments: &SpectrumArguments) -> Exit {
    let interrupt = Interrupt::listen();
    let prepared = linear_alone(&arguments.intervals).and_then(|()| {
        let table = SpectrumTable::load(&arguments.data)?;
        // What a card refuses for one mode it refuses for all: before the search.
        let mode = RelaxationMode { modulus: 1.0, relaxation_time: 1.0 };
        let one = RelaxationSpectrum::new(vec![mode], 0.0)?;
        for program in &arguments.cards {
            card(program, arguments, &one)?;
        }
        let mut request = SpectrumRequest::default();
        if let Some(text) = &arguments.reference_temperature {
            request = request.at_temperature(text)?;
        }
        request.modes = arguments.modes;
        request.equilibrium = arguments.equilibrium;
        request.vertical = arguments.vertical;
        let found = watched(&table.name(), &interrupt, |watch| spectrum_until(&table, &request, watch))?;
        let beside = || Path::new("out").join(format!("spectrum-{}", table.name()));
        let folder = Folder::prepare(&arguments.out.clone().unwrap_or_else(beside))?;
        Ok((table, found, folder))
    });
    match prepared {
        Ok((table, found, folder)) => {
            let (mut cards, mut refusals) = (Vec::new(), Vec::new());
            for program in &arguments.cards {
                match card(program, arguments, &found.fit.spectrum) {
                    Ok(card) => cards.push(card),
                    Err(error) => refusals.push(error),
                }
            }
            let written = found.write(&folder, &table, &cards);
            let text = if arguments.json { found.summary(&table) } else { found.table(&table) };
            show(&text, arguments.json, &folder, &written);
            if found.interrupted {
                note("interrupted: what was fitted until then is written");
            } else if !found.is_settled() {
                note("error: the search of the modes did not converge");
            }
            for error in &refusals {
                note(&format!("error: {error}"));
            }
            let is_done = found.is_settled() && written.failures.is_empty() && refusals.is_empty();
            if is_done { Exit::Done } else { Exit::Failed }
        }
        Err(error) => refused(&error, arguments.json),
    }
}
