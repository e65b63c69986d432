//! Progress on standard error: a bar with the time left on a terminal, now and then a line otherwise.

use std::io::{IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use piola_scene::Plan;
use piola_scene::run::Progress;

/// Parts of the whole that the bar counts.
const PARTS: f64 = 10_000.0;
/// Time between two lines where there is no terminal.
const PAUSE: Duration = Duration::from_secs(5);
/// Time between two looks at the clock, in steps.
const STRIDE: u64 = 256;

/// The display of a run's progress.
pub(crate) struct ProgressLine {
    name: String,
    bar: Option<ProgressBar>,
    begun: Instant,
    shown: Instant,
    seen: u64,
}

impl ProgressLine {
    pub(crate) fn new(plan: &Plan) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new(10_000);
            let style = ProgressStyle::with_template("{msg} [{bar:40}] {percent:>3} %, {eta} left");
            if let Ok(style) = style {
                bar.set_style(style.progress_chars("=> "));
            }
            bar.set_message(plan.name.clone());
            bar
        });
        let now = Instant::now();
        Self { name: plan.name.clone(), bar, begun: now, shown: now, seen: 0 }
    }

    /// Shows a step, if it is time to.
    pub(crate) fn update(&mut self, progress: Progress) {
        self.seen += 1;
        if !self.seen.is_multiple_of(STRIDE) {
            return;
        }
        if let Some(bar) = &self.bar {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "between zero and ten thousand"
            )]
            bar.set_position((progress.fraction * PARTS) as u64);
        } else if PAUSE <= self.shown.elapsed() {
            self.shown = Instant::now();
            let spent = self.begun.elapsed().as_secs_f64();
            let left = spent * (1.0 - progress.fraction) / progress.fraction.max(1e-9);
            let percent = 100.0 * progress.fraction;
            let _ = writeln!(std::io::stderr().lock(), "{}: {percent:.0} %, {left:.0} s left", self.name);
        }
    }

    pub(crate) fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}
