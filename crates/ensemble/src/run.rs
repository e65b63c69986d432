//! Computes members on all cores.

use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, Ordering};
use std::path::Path;
use std::sync::mpsc;

use piola_scene::{SceneFile, run};
use rayon::prelude::*;

use crate::journal::{Journal, collected};
use crate::{Ensemble, EnsembleError, Portion};

/// How an ensemble is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Options {
    /// Threads; all cores for none.
    pub threads: Option<usize>,
    /// Which members.
    pub part: Portion,
    /// Whether members of a run before are kept.
    pub resume: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { threads: None, part: Portion::WHOLE, resume: false }
    }
}

impl Options {
    /// On a number of threads.
    #[must_use]
    pub const fn with_threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads);
        self
    }

    /// A part.
    #[must_use]
    pub const fn with_part(mut self, part: Portion) -> Self {
        self.part = part;
        self
    }

    /// With what a run before computed.
    #[must_use]
    pub const fn with_resume(mut self) -> Self {
        self.resume = true;
        self
    }
}

/// How a run of an ensemble ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Computed {
    /// Members that were computed now.
    pub computed: u64,
    /// Members that a run before had computed.
    pub kept: u64,
    /// Whether it was stopped.
    pub interrupted: bool,
}

/// Computes the members of an ensemble and writes each into the journal of the folder.
///
/// Members are independent: their numbers are the same on any number of threads, in any number of parts, and after any
/// interruption. The observer gets the finished share and may stop it.
///
/// # Errors
/// [`EnsembleError::OtherEnsemble`] when a run before was of another ensemble; [`EnsembleError::Journal`].
///
/// # Example
/// See [`Results`](crate::Results).
pub fn compute(
    ensemble: &Ensemble,
    folder: &Path,
    options: Options,
    mut observer: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Computed, EnsembleError> {
    let mut journal = Journal::open(folder, ensemble, options.part, options.resume)?;
    let done = if options.resume { collected(folder, ensemble)? } else { std::collections::BTreeMap::new() };
    let members = (0..ensemble.members()).filter(|&member| options.part.has(member));
    let (kept, left): (Vec<u64>, Vec<u64>) = members.partition(|member| done.contains_key(member));
    drop(done);
    let all = (kept.len() + left.len()).max(1) as f64;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads.unwrap_or(0)).build();
    let pool = pool.map_err(|error| EnsembleError::Argument {
        argument: error.to_string(),
        valid: "a number of threads that the machine starts",
    })?;
    let stop = AtomicBool::new(false);
    let (sender, receiver) = mpsc::channel();
    let mut computed = 0;
    let mut failure = None;
    std::thread::scope(|scope| {
        let (stop, left) = (&stop, &left);
        scope.spawn(move || {
            pool.install(|| {
                left.par_iter().with_max_len(1).for_each_with(sender, |sender, &member| {
                    let stopped = || stop.load(Ordering::Relaxed);
                    if !stopped()
                        && let Some(computed) = ensemble.member_until(member, stopped)
                    {
                        // Nobody listens any more only where the journal could not be written.
                        let _ = sender.send(computed);
                    }
                });
            });
        });
        for member in receiver {
            if let Err(error) = journal.add(&member) {
                failure = Some(error);
                stop.store(true, Ordering::Relaxed);
                break;
            }
            computed += 1;
            if observer((kept.len() as f64 + computed as f64) / all).is_break() {
                stop.store(true, Ordering::Relaxed);
            }
        }
    });
    if let Some(error) = failure {
        return Err(error);
    }
    let interrupted = computed < left.len() as u64;
    Ok(Computed { computed, kept: kept.len() as u64, interrupted })
}

/// About how many seconds of one core the members of a part take, by a trial of the first member.
///
/// # Errors
/// [`EnsembleError::Invalid`] when the first member fails at its start.
pub fn predicted_seconds(ensemble: &Ensemble, part: Portion) -> Result<Option<f64>, EnsembleError> {
    let SceneFile::Motion(scene) = ensemble.scene(0)? else { return Ok(None) };
    let trial = run::trial(&scene, &piola_scene::Plan::of(&scene));
    let trial = trial.map_err(|cause| EnsembleError::Invalid { member: 0, cause })?;
    Ok(Some(trial.seconds * ensemble.members() as f64 / part.parts as f64))
}
