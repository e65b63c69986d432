//! Checkpoints of a run in the folder of its results.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use piola_charts::{ChartsError, Folder};
use piola_simulation::SimulationError;
use piola_simulation::motion::{CheckpointKeeper, MotionCheckpoint};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::model::Scene;
use crate::plan::{self, Plan};
use crate::{CheckpointError, SceneError};

/// The checkpoints of a run: the last one stands in a file beside the results, until the run is done.
///
/// The file appears complete or not at all. A run that was killed and goes on from it writes the same tables and figures as
/// one that was never stopped; in `summary.json` only the wall time differs.
///
/// # Example
/// ```
/// use piola_charts::Folder;
/// use piola_scene::run::{self, Checkpoints};
/// use piola_scene::{Document, Plan, Scene};
/// use std::{ops::ControlFlow, time::Duration};
/// let document = Document::parse("orbit.toml", "
///     [central]
///     gm = 1.0
///     [[body]]
///     name = 'comet'
///     semi_major_axis = 1.0
///     eccentricity = 0.5
///     [time]
///     revolutions = 3
/// ");
/// let scene = Scene::from_document(&document)?;
/// let plan = Plan::of(&scene);
/// let folder = Folder::prepare(&std::env::temp_dir().join("piola-checkpoints-example"))?;
/// // Stopped after 40 steps, then continued.
/// let mut checkpoints = Checkpoints::new(&folder, Duration::ZERO);
/// let stop = |step: run::Progress| if step.steps < 40 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
/// run::run_with_checkpoints(&scene, &plan, None, &mut checkpoints, stop)?;
/// let kept = checkpoints.last(&scene, &plan)?;
/// assert!(kept.is_some());
/// let go_on = |_| ControlFlow::Continue(());
/// let continued = run::run_with_checkpoints(&scene, &plan, kept, &mut checkpoints, go_on)?;
/// let whole = run::run(&scene, &plan, go_on);
/// assert_eq!(continued.history, whole.history);
/// # std::fs::remove_dir_all(folder.path()).ok();
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
#[derive(Debug)]
pub struct Checkpoints {
    folder: Folder,
    /// Time between checkpoints, as asked for and as it is now.
    asked: Duration,
    pause: Duration,
    written: Instant,
    /// Time from the last checkpoint to the last look at the clock.
    seen: Duration,
    /// Calls until the next look at the clock.
    unwatched: u32,
    failure: Option<ChartsError>,
}

/// The name of the file.
const FILE: &str = ".piola-checkpoint";

impl Checkpoints {
    /// Checkpoints in a folder, written when `pause` has gone by since the one before, and where a run is stopped. The pause grows to
    /// twenty times what writing takes.
    #[must_use]
    pub fn new(folder: &Folder, pause: Duration) -> Self {
        Self {
            folder: folder.clone(),
            asked: pause,
            pause,
            written: Instant::now(),
            seen: Duration::ZERO,
            unwatched: 0,
            failure: None,
        }
    }

    /// The checkpoint that a run before has left in the folder; `None` if there is none.
    ///
    /// # Errors
    /// [`CheckpointError`] in a [`SceneError`]: it cannot be read, or it is of another run or of another version of Piola.
    pub fn last(&self, scene: &Scene, plan: &Plan) -> Result<Option<MotionCheckpoint>, SceneError> {
        self.read(|checkpoint: &MotionCheckpoint| checkpoint.check(&scene.system, plan.method, &plan::timetable(scene)))
    }

    /// The checkpoint in the folder, if there is one and it passes a check.
    pub(crate) fn read<C: DeserializeOwned>(
        &self,
        check: impl FnOnce(&C) -> Result<(), SimulationError>,
    ) -> Result<Option<C>, SceneError> {
        let path = self.path();
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(cause) if cause.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(cause) => return Err(CheckpointError::Unreadable { path, cause: cause.to_string() }.into()),
        };
        let checkpoint: C = serde_json::from_str(&text)
            .map_err(|cause| CheckpointError::Unreadable { path: path.clone(), cause: cause.to_string() })?;
        check(&checkpoint).map_err(|cause| CheckpointError::Foreign { path, cause })?;
        Ok(Some(checkpoint))
    }

    /// Writes a checkpoint into the folder.
    fn write(&mut self, checkpoint: &impl Serialize) {
        /// A checkpoint holds the whole record: of a long one more than a part of the time would go into writing.
        const SHARE: u32 = 20;
        let begun = Instant::now();
        // All keys are texts: nothing here can fail to serialise.
        let text = serde_json::to_string(checkpoint).unwrap_or_default();
        self.failure = self.folder.write(FILE, &text).err();
        (self.written, self.seen, self.unwatched) = (Instant::now(), Duration::ZERO, 0);
        self.pause = self.asked.max(SHARE * begun.elapsed());
        if self.asked.is_zero() {
            self.pause = Duration::ZERO;
        }
    }

    /// Removes the checkpoint: the run is done.
    pub fn remove(&self) {
        // What is not there needs no removing, and what stays is refused or serves again.
        let _ = std::fs::remove_file(self.path());
    }

    /// Why the last checkpoint could not be written, if it could not.
    #[must_use]
    pub const fn failure(&self) -> Option<&ChartsError> {
        self.failure.as_ref()
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join(FILE)
    }
}

impl Checkpoints {
    /// Whether the pause is over.
    fn pause_is_over(&mut self) -> bool {
        /// Calls that are passed over where they come fast: of steps that take a microsecond a look at the clock at each would be felt.
        const STRIDE: u32 = 8;
        /// Calls come fast if less than this part of the pause goes by between two looks.
        const FAST: u32 = 100;
        if 0 < self.unwatched {
            self.unwatched -= 1;
            return false;
        }
        let gone = self.written.elapsed();
        self.unwatched = if FAST * gone.saturating_sub(self.seen) < self.pause { STRIDE } else { 0 };
        self.seen = gone;
        self.pause <= gone
    }
}

impl CheckpointKeeper for Checkpoints {
    fn is_due(&mut self) -> bool {
        self.pause_is_over()
    }

    fn keep(&mut self, checkpoint: &MotionCheckpoint) {
        self.write(checkpoint);
    }
}

#[cfg(any(feature = "robots", feature = "spectral"))]
impl<C: Serialize> piola_studies::StudyCheckpointKeeper<C> for Checkpoints {
    fn is_due(&mut self) -> bool {
        self.pause_is_over()
    }

    fn keep(&mut self, checkpoint: &C) {
        self.write(checkpoint);
    }
}
