//! Laws with history by the command `fit`.

use piola_measured::MeasuredError;
use piola_measured::history::{HistoryMeasurements, HistoryRequest, compare_histories_until};

use crate::Exit;
use crate::arguments::FitArguments;
use crate::commands::refused;
use crate::fit_options::refuse_all_but;
use crate::flows::{Results, finished, out, watched};
use crate::interrupt::Interrupt;

/// Fits laws with history to tests along time.
pub(crate) fn fit(arguments: &FitArguments) -> Exit {
    let interrupt = Interrupt::listen();
    let prepared = request(arguments).and_then(|request| {
        let measurements = HistoryMeasurements::load(&arguments.data)?;
        let found =
            watched(&measurements.name(), &interrupt, |watch| compare_histories_until(&measurements, &request, watch))?;
        Ok((measurements, found))
    });
    match prepared {
        Ok((measurements, found)) => {
            let results = Results {
                table: &|| found.table(&measurements),
                summary: &|| found.summary(&measurements),
                write: &|folder| found.write(folder, &measurements),
            };
            let out = out(arguments.out.as_deref(), "fit", &measurements.name());
            finished(&found, &results, &out, (arguments.json, true))
        }
        Err(error) => refused(&error, arguments.json),
    }
}

fn request(arguments: &FitArguments) -> Result<HistoryRequest, MeasuredError> {
    let valid = "for laws with history: --law, --bound, --intervals, --confidence, --out and --json";
    refuse_all_but(arguments, &["--bound"], valid)?;
    let laws = arguments.laws.iter().map(|name| Ok(name.parse()?)).collect::<Result<_, MeasuredError>>()?;
    let mut request = HistoryRequest::of(laws);
    request.confidence = arguments.confidence;
    request.intervals = arguments.intervals.kind()?;
    arguments.bounds.iter().try_fold(request, |request, text| request.with_bound(text))
}
