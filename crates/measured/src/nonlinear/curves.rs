//! Flows in words, and the curves of fitted fluids through them.

use piola_fit::FitError;
use piola_fit::nonlinear::{Extension, NonlinearData, NonlinearFlow, NonlinearModel, ShearResponse};

use super::FittedNonlinear;

/// "start-up of shear at 2 1/s, N1": a flow in words.
pub(super) fn words(flow: NonlinearFlow) -> String {
    let of_shear = |response| match response {
        ShearResponse::ShearStress => "shear stress",
        ShearResponse::FirstNormalStressDifference => "N1",
        ShearResponse::SecondNormalStressDifference => "N2",
    };
    let of_extension = |extension| match extension {
        Extension::Uniaxial => "uniaxial",
        Extension::Planar => "planar",
        Extension::Biaxial => "biaxial",
    };
    match flow {
        NonlinearFlow::SteadyShear(response) => format!("steady shear, {}", of_shear(response)),
        NonlinearFlow::ShearStartUp { shear_rate, response } => {
            format!("start-up of shear at {shear_rate} 1/s, {}", of_shear(response))
        }
        NonlinearFlow::SteadyExtension(extension) => format!("steady {} extension", of_extension(extension)),
        NonlinearFlow::ExtensionStartUp { extension, rate } => {
            format!("start-up of {} extension at {rate} 1/s", of_extension(extension))
        }
        _ => "another flow".to_owned(),
    }
}

/// A curve through the drives of a flow.
pub(super) struct Curve {
    /// (drive, answer), evenly in the logarithms of the drives, as far as the fluid has answers.
    pub(super) points: Vec<[f64; 2]>,
    /// Why there are no more; none where the curve is whole.
    stops: Option<FitError>,
}

impl Curve {
    /// "the curve of steady shear, N1 stops after 3.2 1/s: …"; none where it is whole.
    pub(super) fn in_words(&self, flow: NonlinearFlow) -> Option<String> {
        let (flow_in_words, why) = (words(flow), self.stops.as_ref()?);
        Some(match self.points.last() {
            Some([last, _]) => {
                format!(
                    "the curve of {flow_in_words} stops after {} {}: {why}",
                    significant(*last),
                    unit_of_drive(flow)
                )
            }
            None => format!("no curve of {flow_in_words}: {why}"),
        })
    }
}

/// A positive number to three significant digits, not as a power of ten where it is near one.
pub(super) fn significant(x: f64) -> String {
    if (1e-3..1e4).contains(&x) {
        let decimals = (2.0 - x.log10().floor()).clamp(0.0, 5.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 5")]
        let decimals = decimals as usize;
        format!("{x:.decimals$}")
    } else {
        format!("{x:.2e}")
    }
}

/// The unit of what changes in a flow: a rate, or in start-up the time.
pub(super) const fn unit_of_drive(flow: NonlinearFlow) -> &'static str {
    match flow {
        NonlinearFlow::SteadyShear(_) | NonlinearFlow::SteadyExtension(_) => "1/s",
        _ => "s",
    }
}

impl FittedNonlinear {
    /// The curve of a flow. A fluid may have answers up to some drive only, as in an extension that is too fast for it.
    pub(super) fn curve(&self, model: NonlinearModel, set: &NonlinearData) -> Curve {
        const POINTS: usize = 60;
        let drives: Vec<f64> = match set.rows() {
            [first, .., last] if first[0] < last[0] => {
                let share = |k: usize| k as f64 / (POINTS - 1) as f64;
                (0..POINTS).map(|k| first[0] * (last[0] / first[0]).powf(share(k))).collect()
            }
            rows => rows.iter().map(|row| row[0]).take(1).collect(),
        };
        let values: Vec<f64> = self.fit.parameters.iter().map(|parameter| parameter.value).collect();
        let answers = |count: usize| model.answers(&self.modes, &values, set.flow(), &drives[..count]);
        let (found, stops) = match answers(drives.len()) {
            Ok(all) => (all, None),
            Err(error) => (longest(drives.len(), answers), Some(error)),
        };
        Curve { points: drives.into_iter().zip(found).map(|(drive, answer)| [drive, answer]).collect(), stops }
    }
}

/// The answers to as many of the first drives as have some, of `count` that have not.
fn longest(count: usize, answers: impl Fn(usize) -> Result<Vec<f64>, FitError>) -> Vec<f64> {
    let (mut best, mut fails) = (Vec::new(), count);
    while best.len() + 1 < fails {
        let middle = usize::midpoint(best.len(), fails);
        match answers(middle) {
            Ok(found) if found.len() == middle => best = found,
            _ => fails = middle,
        }
    }
    best
}
