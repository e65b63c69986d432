//! The command `nonlinear`.

use std::path::PathBuf;

use clap::Args;
use piola_measured::MeasuredError;
use piola_measured::nonlinear::{
    NonlinearRequest, NonlinearTable, RelaxationModes, compare_nonlinear_until, modes_of_spectrum,
};

use crate::Exit;
use crate::commands::refused;
use crate::flows::{Results, finished, out, watched};
use crate::interrupt::Interrupt;
use crate::intervals::IntervalArguments;

#[derive(Debug, Args)]
pub(crate) struct NonlinearArguments {
    /// The measurements: CSV with a shear rate or an extension rate, stresses or viscosities, N1, N2, and of start-up the time, with
    /// units in the header; several files for several flows.
    #[arg(required = true)]
    pub(crate) data: Vec<PathBuf>,
    /// A fluid: oldroyd-b, giesekus, linear-ptt, exponential-ptt, kbkz-rational or kbkz-exponential; several times for several. Without
    /// any, all that have the measured responses.
    #[arg(long = "fluid", value_name = "FLUID")]
    pub(crate) fluids: Vec<String>,
    /// The number of relaxation modes that are fitted, 1 to 6.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) modes: usize,
    /// Hold the relaxation modes of this spectrum, the summary.json of `piola spectrum`.
    #[arg(long, value_name = "FILE", conflicts_with = "modes")]
    pub(crate) spectrum: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) intervals: IntervalArguments,
    /// The probability of the intervals.
    #[arg(long, value_name = "PROBABILITY", default_value_t = 0.95)]
    pub(crate) confidence: f64,
    /// Folder of the results instead of out/nonlinear-DATA.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON to standard output.
    #[arg(long)]
    pub(crate) json: bool,
}

pub(crate) fn fit(arguments: &NonlinearArguments) -> Exit {
    let interrupt = Interrupt::listen();
    let prepared = NonlinearTable::load(&arguments.data).and_then(|table| {
        let mut request = NonlinearRequest::default();
        request.fluids = arguments.fluids.iter().map(|name| Ok(name.parse()?)).collect::<Result<_, MeasuredError>>()?;
        request.modes = match &arguments.spectrum {
            Some(path) => modes_of_spectrum(path)?,
            None => RelaxationModes::Fitted(arguments.modes),
        };
        request.confidence = arguments.confidence;
        request.intervals = arguments.intervals.kind()?;
        let found = watched(&table.name(), &interrupt, |watch| compare_nonlinear_until(&table, &request, watch))?;
        Ok((table, found))
    });
    match prepared {
        Ok((table, found)) => {
            let results = Results {
                table: &|| found.table(&table),
                summary: &|| found.summary(&table),
                write: &|folder| found.write(folder, &table),
            };
            let out = out(arguments.out.as_deref(), "nonlinear", &table.name());
            finished(&found, &results, &out, (arguments.json, !arguments.fluids.is_empty()))
        }
        Err(error) => refused(&error, arguments.json),
    }
}
