//! The command `fit`.

use std::path::Path;

use piola_charts::Folder;
use piola_measured::MeasuredError;
use piola_measured::fitting::{self, Measurements, Request};
use piola_measured::sides::{SidesMeasurements, SidesModel, SidesOptions, card_of_foam, compare_sides_until};

use crate::arguments::FitArguments;
use crate::commands::{listing, note, print, refused};
use crate::fit_options::refuse_all_but;
use crate::interrupt::Interrupt;
use crate::{Exit, comparison, flows, histories};

/// The names of laws with history, also of a program that is built without them.
const WITH_HISTORY: [&str; 4] = ["bergstrom-boyce", "reese-govindjee", "ogden-roxburgh", "viscoplastic"];

/// A kind of laws that are fitted to the same kind of tables.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Rubber,
    Sides,
    History,
}

/// The kind of a law by its name; none of an unknown one.
fn kind(name: &str) -> Option<Kind> {
    if WITH_HISTORY.contains(&name) {
        Some(Kind::History)
    } else if name.parse::<SidesModel>().is_ok() {
        Some(Kind::Sides)
    } else {
        name.parse::<fitting::AnyModel>().ok().map(|_| Kind::Rubber)
    }
}

pub(crate) fn fit(arguments: &FitArguments) -> Exit {
    let mut kinds = arguments.laws.iter().filter_map(|name| kind(name));
    let first = kinds.next();
    if kinds.any(|other| Some(other) != first) {
        let error = MeasuredError::Argument {
            argument: format!("--law {}", arguments.laws.join(" --law ")),
            valid: "laws of one kind, because each kind has tables of its own: of rubber, of foam and fibres, or with history",
        };
        return refused(&error, arguments.json);
    }
    match first {
        Some(Kind::Sides) => return with_sides(arguments),
        Some(Kind::History) => return histories::fit(arguments),
        _ => {}
    }
    let interrupt = Interrupt::listen();
    let prepared = flows::only(&arguments.only).and_then(|only| {
        let measurements = Measurements::load_only(&arguments.data, &only)?;
        let request = request(arguments)?;
        let bulk = bulk(arguments)?;
        let fitted = flows::watched(&measurements.name(), &interrupt, |watch| {
            fitting::compare_until(&measurements, &request, watch)
        })?;
        if let (None, Some((_, refused))) = (fitted.fits().next(), fitted.refusals().next()) {
            return Err(refused.clone().into());
        }
        let predictions = arguments.to.map(|stretch| fitted.predictions(&measurements, stretch)).transpose()?;
        let cards = bulk.map_or_else(|| Ok(Vec::new()), |bulk| cards(&arguments.cards, &fitted, bulk))?;
        let beside = || Path::new("out").join(format!("fit-{}", measurements.name()));
        let folder = Folder::prepare(&arguments.out.clone().unwrap_or_else(beside))?;
        Ok((measurements, fitted, predictions, cards, folder))
    });
    let (measurements, fitted, predictions, cards, folder) = match prepared {
        Ok(prepared) => prepared,
        Err(error) => return refused(&error, arguments.json),
    };
    let mut written = fitted.write(&folder, &measurements);
    if let Some(predictions) = predictions {
        written.add(&folder, [("predictions.csv", predictions)]);
    }
    written.add(&folder, cards.iter().map(|(name, text)| (name.as_str(), text.clone())));
    if arguments.json {
        print(&fitted.summary(&measurements));
    } else {
        print(&comparison::table(&measurements, &fitted));
        if let Some(stretch) = arguments.to {
            print(&comparison::warning(&measurements, stretch));
        }
        print(&listing(&folder, &written));
    }
    for failure in &written.failures {
        note(&format!("error: {failure}"));
    }
    let refusals: Vec<String> = fitted.refusals().map(|(_, refusal)| refusal.to_string()).collect();
    flows::settled(&fitted, fitted.is_complete(), &refusals, !arguments.laws.is_empty(), &written)
}

/// Laws of foam or of fibres, to tests whose sides are free, measured or held.
fn with_sides(arguments: &FitArguments) -> Exit {
    let interrupt = Interrupt::listen();
    let prepared = sides_options(arguments).and_then(|options| {
        let laws: Vec<SidesModel> =
            arguments.laws.iter().map(|name| Ok(name.parse()?)).collect::<Result<_, MeasuredError>>()?;
        let measurements = SidesMeasurements::load(&arguments.data)?;
        let intervals = arguments.intervals.kind()?;
        let found = flows::watched(&measurements.name(), &interrupt, |watch| {
            compare_sides_until(&measurements, &laws, &options, intervals, watch)
        });
        let mut cards = Vec::new();
        for text in &arguments.cards {
            let program: fitting::Program = text.parse()?;
            for (law, fit) in found.fits() {
                let name = law.to_string().replace(':', "-");
                let card = card_of_foam(program, law, fit)?;
                cards.push((format!("{text}-{name}.{}", program.ending()), card));
            }
        }
        let beside = || Path::new("out").join(format!("fit-{}", measurements.name()));
        let folder = Folder::prepare(&arguments.out.clone().unwrap_or_else(beside))?;
        Ok((measurements, found, cards, folder))
    });
    let (measurements, found, cards, folder) = match prepared {
        Ok(prepared) => prepared,
        Err(error) => return refused(&error, arguments.json),
    };
    let written = found.write(&folder, &measurements, &cards);
    if arguments.json {
        print(&found.summary(&measurements));
    } else {
        print(&found.table(&measurements));
        print(&listing(&folder, &written));
    }
    for failure in &written.failures {
        note(&format!("error: {failure}"));
    }
    if found.interrupted {
        note("interrupted: what was fitted until then is written");
    }
    if found.is_complete() && written.failures.is_empty() { Exit::Done } else { Exit::Failed }
}

/// The options of a fit of foam or fibres.
fn sides_options(arguments: &FitArguments) -> Result<SidesOptions, MeasuredError> {
    let valid = "for laws of foam and of fibres: --law, --intervals, --confidence, --card, --out and --json";
    refuse_all_but(arguments, &["--card"], valid)?;
    let mut options = SidesOptions::default();
    options.confidence = arguments.confidence;
    Ok(options)
}

/// The bulk modulus and the density of the material cards; none when no bulk modulus is given.
fn bulk(arguments: &FitArguments) -> Result<Option<fitting::Bulk>, MeasuredError> {
    let Some(modulus) = arguments.bulk_modulus else {
        return match arguments.cards.first() {
            Some(card) => Err(MeasuredError::Argument {
                argument: format!("--card {card} without --bulk-modulus"),
                valid: "a bulk modulus in the unit of the stresses; only a foam has its own",
            }),
            None => Ok(None),
        };
    };
    let mut bulk = fitting::Bulk::new(modulus)?;
    if let Some(density) = arguments.density {
        bulk = bulk.with_density(density)?;
    }
    for text in &arguments.cards {
        bulk.check(text.parse()?)?;
    }
    Ok(Some(bulk))
}

/// The material cards that are asked for, with the names of their files.
fn cards(
    programs: &[String],
    fitted: &fitting::Comparison,
    bulk: fitting::Bulk,
) -> Result<Vec<(String, String)>, MeasuredError> {
    let mut cards = Vec::new();
    for text in programs {
        let program: fitting::Program = text.parse()?;
        let mut refused = None;
        let before = cards.len();
        for (law, fit) in fitted.fits() {
            match fitting::card(program, law, fit, bulk) {
                Ok(card) => {
                    let name = law.to_string().replace(':', "-");
                    cards.push((format!("{text}-{name}.{}", program.ending()), card));
                }
                Err(error) => refused = Some(error),
            }
        }
        if let Some(error) = refused.filter(|_| cards.len() == before) {
            return Err(error);
        }
    }
    Ok(cards)
}

fn request(arguments: &FitArguments) -> Result<Request, MeasuredError> {
    let laws = match arguments.laws.as_slice() {
        [] => Request::usual_laws()?,
        names => names.iter().map(|name| Ok(name.parse()?)).collect::<Result<_, MeasuredError>>()?,
    };
    let mut request = Request::of(laws);
    if let Some(weights) = &arguments.mode_weights {
        request.weights = Request::weights(weights)?;
    }
    request.bounds = arguments.bounds.iter().map(|text| text.parse()).collect::<Result<_, _>>()?;
    if arguments.equal_errors {
        request.weighting = fitting::Weighting::Equal;
    }
    if arguments.allow_unstable {
        request.stability = fitting::Stability::Free;
    }
    request.confidence = arguments.confidence;
    request.cross_validation = arguments.cross_validate;
    request.intervals = arguments.intervals.kind()?;
    Ok(request)
}
