//! Laws with history by the command `fit`.

use std::path::Path;

use piola_charts::Folder;
use piola_measured::MeasuredError;
use piola_measured::history::{HistoryMeasurements, HistoryRequest, compare_histories_until};

use crate::Exit;
use crate::arguments::FitArguments;
use crate::commands::refused;
use crate::fit_options::refuse_all_but;
use crate::flows::{settled, show, watched};
use crate::interrupt::Interrupt;

/// Fits laws with history to tests along time.
pub(crate) fn fit(arguments: &FitArguments) -> Exit {
    let interrupt = Interrupt::listen();
    let prepared = request(arguments).and_then(|request| {
        let measurements = HistoryMeasurements::load(&arguments.data)?;
        let found =
            watched(&measurements.name(), &interrupt, |watch| compare_histories_until(&measurements, &request, watch))?;
        if let (None, Some((_, refused))) = (found.fits().next(), found.refusals().next()) {
            return Err(refused.clone().into());
        }
        let beside = || Path::new("out").join(format!("fit-{}", measurements.name()));
        let folder = Folder::prepare(&arguments.out.clone().unwrap_or_else(beside))?;
        Ok((measurements, found, folder))
    });
    match prepared {
        Ok((measurements, found, folder)) => {
            let written = found.write(&folder, &measurements);
            let text = if arguments.json { found.summary(&measurements) } else { found.table(&measurements) };
            show(&text, arguments.json, &folder, &written);
            let refusals: Vec<String> = found.refusals().map(|(law, refusal)| format!("{law}: {refusal}")).collect();
            settled(&found, found.is_complete(), &refusals, true, &written)
        }
        Err(error) => refused(&error, arguments.json),
    }
}

fn request(arguments: &FitArguments) -> Result<HistoryRequest, MeasuredError> {
    let valid = "for laws with history: --law, --bound, --confidence, --out and --json";
    refuse_all_but(arguments, &["--bound"], valid)?;
    let laws = arguments.laws.iter().map(|name| Ok(name.parse()?)).collect::<Result<_, MeasuredError>>()?;
    let mut request = HistoryRequest::of(laws);
    request.confidence = arguments.confidence;
    arguments.bounds.iter().try_fold(request, |request, text| request.with_bound(text))
}
