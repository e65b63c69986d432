//! The results of an ensemble: a table of its members, their statistics, a figure.

use core::fmt::Write as _;
use std::path::Path;

use piola_charts::{Folder, Panel, Written, figure};
use serde_json::json;

use crate::journal::collected;
use crate::{Ensemble, EnsembleError, Member};

/// All members of an ensemble in their order.
///
/// # Example
/// ```
/// use piola_ensemble::{Ensemble, Options, Results, compute};
/// use piola_scene::Document;
/// let scene = Document::parse("orbit.toml", "
///     [central]
///     gm = 1.0
///     [[body]]
///     name = 'comet'
///     semi_major_axis = 1.0
///     eccentricity = 0.5
///     [time]
///     revolutions = 1
/// ");
/// let ensemble = Ensemble::new(scene, vec!["body.comet.semi_major_axis=1:4:4".parse()?], Vec::new(), 1, 0)?;
/// let folder = std::env::temp_dir().join("piola-ensemble-example");
/// std::fs::create_dir_all(&folder).ok();
/// compute(&ensemble, &folder, Options::default(), |_| std::ops::ControlFlow::Continue(()))?;
/// let results = Results::collect(&ensemble, &folder)?;
/// let times = results.column("time (s)").expect("there");
/// assert!((times[3] - 8.0 * times[0]).abs() < 1e-9); // Kepler's third law: 4^(3/2)
/// # std::fs::remove_dir_all(&folder).ok();
/// # Ok::<(), piola_ensemble::EnsembleError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Results<'e> {
    pub(crate) ensemble: &'e Ensemble,
    pub(crate) members: Vec<Member>,
}

/// Statistics of one quantity.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Statistics {
    /// Members that have it.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation; none of fewer than two.
    pub deviation: Option<f64>,
    /// The least, the quantiles 0.05, 0.5 and 0.95, and the greatest.
    pub quantiles: [f64; 5],
}

impl Statistics {
    /// The statistics of the finite values; `None` when there are none.
    #[must_use]
    pub fn of(values: &[f64]) -> Option<Self> {
        let mut sorted: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len();
        let last = count.checked_sub(1)?;
        let mean = sorted.iter().map(|x| x / count as f64).sum::<f64>();
        let squares = sorted.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
        let deviation = (0 < last).then(|| (squares / last as f64).sqrt());
        // Between neighbours.
        let quantile = |share: f64| {
            let place = share * last as f64;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in the list")]
            let low = (place.floor() as usize).min(last);
            let high = (low + 1).min(last);
            let part = place - low as f64;
            sorted[low] * (1.0 - part) + sorted[high] * part
        };
        Some(Self { count, mean, deviation, quantiles: [0.0, 0.05, 0.5, 0.95, 1.0].map(quantile) })
    }
}

impl<'e> Results<'e> {
    /// From the journals of a folder.
    ///
    /// # Errors
    /// [`EnsembleError::Missing`] when members are not computed yet; [`EnsembleError::OtherEnsemble`], [`EnsembleError::Journal`].
    pub fn collect(ensemble: &'e Ensemble, folder: &Path) -> Result<Self, EnsembleError> {
        let found = collected(folder, ensemble)?;
        let members = ensemble.members();
        let missing = members - found.len() as u64;
        if 0 < missing {
            let first = (0..members).find(|member| !found.contains_key(member)).unwrap_or_default();
            return Err(EnsembleError::Missing { missing, members, first });
        }
        Ok(Self { ensemble, members: found.into_values().collect() })
    }

    /// The members.
    #[must_use]
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// A quantity of all members.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let index = self.ensemble.columns().iter().position(|other| other == name)?;
        Some(self.members.iter().map(|member| member.values[index]).collect())
    }

    /// The number of failed members.
    #[must_use]
    pub fn failures(&self) -> usize {
        self.members.iter().filter(|member| member.failure.is_some()).count()
    }

    /// The table of members as CSV. A row has the number of the member, the varied values, the quantities, and why the member failed.
    #[must_use]
    pub fn table(&self) -> String {
        let quoted = |text: &String| {
            if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.clone() }
        };
        let heads = self.ensemble.varied().into_iter().chain(self.ensemble.columns().iter().cloned());
        let mut text = format!("member,{},failure\n", heads.map(|head| quoted(&head)).collect::<Vec<_>>().join(","));
        for member in &self.members {
            let _ = write!(text, "{}", member.member);
            for value in self.ensemble.settings(member.member).iter().chain(&member.values) {
                let _ = if value.is_finite() { write!(text, ",{value:?}") } else { write!(text, ",") };
            }
            let _ = writeln!(text, ",{}", member.failure.as_ref().map(quoted).unwrap_or_default());
        }
        text
    }

    /// Statistics of every quantity.
    #[must_use]
    pub fn statistics(&self) -> Vec<(String, Option<Statistics>)> {
        let of = |name: &String| (name.clone(), Statistics::of(&self.column(name).unwrap_or_default()));
        self.ensemble.columns().iter().map(of).collect()
    }

    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self) -> String {
        let statistics: serde_json::Map<String, serde_json::Value> = self
            .statistics()
            .into_iter()
            .map(|(name, statistics)| (name, serde_json::to_value(statistics).unwrap_or_default()))
            .collect();
        let summary = json!({
            "scene": self.ensemble.name(),
            "varied": self.ensemble.varied(),
            "members": self.members.len(),
            "failures": self.failures(),
            "statistics": statistics,
        });
        let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
        text.push('\n');
        text
    }

    /// A text for a reader.
    #[must_use]
    pub fn report(&self) -> String {
        let mut text = format!("{} members of {}", self.members.len(), self.ensemble.name());
        match self.failures() {
            0 => text.push_str("\n\n"),
            failures => {
                let _ = write!(text, "; {failures} without a result\n\n");
            }
        }
        let heads = ["mean", "deviation", "least", "5 %", "median", "95 %", "greatest"];
        let _ = write!(text, "{:<36}", "at the end");
        for head in heads {
            let _ = write!(text, "{head:>14}");
        }
        text.push('\n');
        for (name, statistics) in self.statistics() {
            let Some(Statistics { mean, deviation, quantiles, .. }) = statistics else { continue };
            let _ = write!(text, "{name:<36}{mean:>14.5e}");
            let _ = match deviation {
                Some(deviation) => write!(text, "{deviation:>14.5e}"),
                None => write!(text, "{:>14}", ""),
            };
            for quantile in quantiles {
                let _ = write!(text, "{quantile:>14.5e}");
            }
            text.push('\n');
        }
        text
    }

    /// Writes the table, the summary and the figure.
    #[must_use]
    pub fn write(&self, folder: &Folder) -> Written {
        self.write_with(folder, [])
    }

    /// [`write`](Self::write) with other files in the same set: a folder with `summary.json` has them too.
    #[must_use]
    pub fn write_with<'n>(&self, folder: &Folder, others: impl IntoIterator<Item = (&'n str, Vec<u8>)>) -> Written {
        let own = [("members.csv", self.table()), ("summary.json", self.summary()), ("members.svg", self.figure())];
        Written::of(folder, own.map(|(name, text)| (name, text.into_bytes())).into_iter().chain(others))
    }

    /// The first quantities over the first value that is varied.
    fn figure(&self) -> String {
        /// Points in a panel, at most.
        const POINTS: usize = 4000;
        let varied = self.ensemble.varied();
        let abscissa = varied.first().map_or("member", String::as_str);
        let stride = self.members.len().div_ceil(POINTS).max(1);
        let shown = self.members.iter().step_by(stride).filter(|member| member.failure.is_none());
        let shown: Vec<(f64, &Member)> = shown
            .map(|member| {
                let first = self.ensemble.settings(member.member).first().copied();
                (first.unwrap_or(member.member as f64), member)
            })
            .collect();
        let panel = |index: usize, name: &String| {
            let points = shown.iter().map(|(x, member)| (*x, member.values[index]));
            let points: Vec<(f64, f64)> = points.filter(|(_, y)| y.is_finite()).collect();
            Panel {
                name: name.clone(),
                axes: [abscissa.to_owned(), name.clone()],
                points,
                curves: Vec::new(),
                is_curve: true,
            }
        };
        // After the time, which is the same for all in most ensembles.
        let columns = self.ensemble.columns().iter().enumerate();
        let panels: Vec<Panel> =
            columns.filter(|(_, name)| *name != "time (s)").take(4).map(|(index, name)| panel(index, name)).collect();
        let rows = panels.len().div_ceil(2).max(1);
        figure((860, if rows < 2 { 420 } else { 760 }), &format!("members of {}", self.ensemble.name()), &|area| {
            for (panel, part) in panels.iter().zip(area.split_evenly((rows, 2))) {
                panel.draw(&part)?;
            }
            Ok(())
        })
    }
}
