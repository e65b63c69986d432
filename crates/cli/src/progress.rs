//! Progress on standard error: a bar with the time left on a terminal, now and then a line otherwise.

use std::io::{IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressState, ProgressStyle};

/// Parts of the whole that the bar counts.
const PARTS: f64 = 10_000.0;
/// Time between two lines where there is no terminal.
const PAUSE: Duration = Duration::from_secs(5);
/// Steps of an integrator between two looks at the clock.
pub(crate) const STRIDE: u64 = 256;

/// The display of a run's progress.
pub(crate) struct ProgressLine {
    name: String,
    bar: Option<ProgressBar>,
    begun: Instant,
    shown: Instant,
    stride: u64,
    seen: u64,
}

impl ProgressLine {
    /// The display of a run of this name, refreshed every `stride` updates.
    pub(crate) fn new(name: &str, stride: u64) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new(10_000);
            let style = ProgressStyle::with_template("{msg} [{bar:40}] {percent:>3} %, {left} left");
            if let Ok(style) = style {
                // Before the first part is done nobody knows how long the others take.
                let style = style.with_key("left", |state: &ProgressState, text: &mut dyn core::fmt::Write| {
                    let left =
                        if state.pos() == 0 { "?".to_owned() } else { format!("{:.0} s", state.eta().as_secs_f64()) };
                    let _ = text.write_str(&left);
                });
                bar.set_style(style.progress_chars("=> "));
            }
            bar.set_message(name.to_string());
            bar
        });
        let now = Instant::now();
        Self { name: name.to_string(), bar, begun: now, shown: now, stride, seen: 0 }
    }

    /// Shows the finished part of the run, if a refresh is due.
    pub(crate) fn update(&mut self, fraction: f64) {
        self.seen += 1;
        if !self.seen.is_multiple_of(self.stride) {
            return;
        }
        if let Some(bar) = &self.bar {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "between zero and ten thousand"
            )]
            bar.set_position((fraction * PARTS) as u64);
        } else if PAUSE <= self.shown.elapsed() {
            self.shown = Instant::now();
            let spent = self.begun.elapsed().as_secs_f64();
            let percent = 100.0 * fraction;
            // Of the first thousandth nothing can be told.
            let left = if fraction < 1e-3 {
                String::new()
            } else {
                format!(", {:.0} s left", spent * (1.0 - fraction) / fraction)
            };
            let _ = writeln!(std::io::stderr().lock(), "{}: {percent:.0} %{left}", self.name);
        }
    }

    pub(crate) fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}
