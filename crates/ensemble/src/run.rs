//! Computes members on all cores, and on several machines.

use core::ops::ControlFlow;
use core::sync::atomic::AtomicBool;
use core::time::Duration;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::time::Instant;

use piola_scene::{SceneFile, run};

use crate::crew::{Crew, pool};
use crate::journal::{Journal, collected};
use crate::ranks::{PAUSE, Reply, Request, ask, heard, say};
use crate::{Ensemble, EnsembleError, Member, OneProcess, Portion, Ranks};

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
    observer: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Computed, EnsembleError> {
    compute_across(ensemble, folder, options, &OneProcess, observer)
}

/// [`compute`] on the processes of one run, each with its threads. All of them call it, after [`agree`](crate::agree).
///
/// When a process cannot go on, all end, and process 0 has its error: [`EnsembleError::Process`].
///
/// Process 0 hands members out, receives their numbers and keeps the journal; only it uses the folder and the observer. So the
/// machines need not share a folder, and the journal is that of one process: a killed run goes on with any number of processes.
///
/// # Errors
/// Those of [`compute`]; [`EnsembleError::Process`].
///
/// # Example
/// ```no_run
/// # fn example(ensemble: &piola_ensemble::Ensemble, ranks: &dyn piola_ensemble::Ranks) -> Result<(), piola_ensemble::EnsembleError> {
/// use std::ops::ControlFlow;
///
/// use piola_ensemble::{Options, Results, agree, compute_across};
/// let folder = std::path::Path::new("sweep");
/// agree(ranks, Ok(ensemble))?;
/// compute_across(ensemble, folder, Options::default(), ranks, |_| ControlFlow::Continue(()))?;
/// if ranks.rank() == 0 {
///     println!("{}", Results::collect(ensemble, folder)?.report());
/// }
/// # Ok(())
/// # }
/// ```
pub fn compute_across(
    ensemble: &Ensemble,
    folder: &Path,
    options: Options,
    ranks: &dyn Ranks,
    mut observer: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Computed, EnsembleError> {
    let pool = match pool(options.threads) {
        Ok(pool) => pool,
        Err(error) => {
            if ranks.rank() == 0 {
                dismiss(ranks);
            } else {
                ask(ranks, &Request::Refused(error.to_string()))?;
            }
            return Err(error);
        }
    };
    let stop = AtomicBool::new(false);
    let crew = Crew::new(ensemble, &stop);
    if ranks.rank() != 0 {
        return pool.in_place_scope(|scope| follow(ranks, crew, pool.current_num_threads(), scope));
    }
    let journal = Journal::open(folder, ensemble, options.part, options.resume);
    let done = if options.resume { collected(folder, ensemble) } else { Ok(BTreeMap::new()) };
    let journal = journal.and_then(|journal| done.map(|done| (journal, done)));
    let (journal, done) = match journal {
        Ok(opened) => opened,
        Err(error) => {
            dismiss(ranks);
            return Err(error);
        }
    };
    let members = (0..ensemble.members()).filter(|&member| options.part.has(member));
    let (kept, left): (Vec<u64>, Vec<u64>) = members.partition(|member| done.contains_key(member));
    drop(done);
    let mut lead = Lead {
        journal,
        left,
        next: 0,
        kept: kept.len() as u64,
        computed: 0,
        working: (1..ranks.count()).collect(),
        stopped: false,
        failure: None,
    };
    pool.in_place_scope(|scope| lead.run(ranks, crew, pool.current_num_threads(), scope, &mut observer));
    lead.failure.map_or(Ok(()), Err)?;
    let interrupted = lead.computed < lead.left.len() as u64;
    Ok(Computed { computed: lead.computed, kept: lead.kept, interrupted })
}

/// Members for each thread that wait or are computed.
const QUEUE: usize = 8;

/// Process 0.
struct Lead {
    journal: Journal,
    left: Vec<u64>,
    /// The first of `left` that nobody has.
    next: usize,
    kept: u64,
    computed: u64,
    /// Other processes that have not ended.
    working: BTreeSet<usize>,
    stopped: bool,
    failure: Option<EnsembleError>,
}

impl Lead {
    fn run<'c>(
        &mut self,
        ranks: &dyn Ranks,
        mut crew: Crew<'c>,
        threads: usize,
        scope: &rayon::Scope<'c>,
        observer: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) {
        let at_once = crew.at_once();
        loop {
            while !self.stopped && crew.unfinished() < QUEUE * threads * at_once && self.next < self.left.len() {
                let rest = &self.left[self.next..];
                // Towards the end fewer at once, so that no thread is without any.
                let taken = at_once.min(rest.len().div_ceil(threads));
                crew.take(scope, &rest[..taken]);
                self.next += taken;
            }
            if crew.unfinished() == 0 && self.working.is_empty() {
                return;
            }
            if let Some(member) = crew.finished(PAUSE) {
                self.keep(&member, observer);
            }
            while let Some((rank, request)) = heard(ranks) {
                let request = request.unwrap_or_else(Request::Refused);
                let reply = self.answer(rank, request, ranks.count(), observer);
                if matches!(reply, Reply::End) {
                    self.working.remove(&rank);
                }
                say(ranks, rank, &reply);
            }
            if self.stopped {
                crew.stop();
            }
        }
    }

    fn keep(&mut self, member: &Member, observer: &mut dyn FnMut(f64) -> ControlFlow<()>) {
        if matches!(self.failure, Some(EnsembleError::Journal { .. })) {
            return;
        }
        if let Err(error) = self.journal.add(member) {
            (self.failure, self.stopped) = (Some(error), true);
            return;
        }
        self.computed += 1;
        let all = (self.kept + self.left.len() as u64).max(1);
        if observer((self.kept + self.computed) as f64 / all as f64).is_break() {
            self.stopped = true;
        }
    }

    /// A process that cannot go on ends the run: the members that are finished stay in the journal.
    fn answer(
        &mut self,
        rank: usize,
        request: Request,
        count: usize,
        observer: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Reply {
        let (members, unfinished, wanted) = match request {
            Request::Finished { members, unfinished, wanted } => (members, unfinished, wanted),
            Request::Refused(cause) => return self.refuse(rank, cause),
            Request::Ready(_) => return self.refuse(rank, "it begins while the others compute".to_owned()),
        };
        for member in &members {
            self.keep(member, observer);
        }
        let rest = if self.stopped { &[] } else { &self.left[self.next..] };
        if unfinished == 0 && rest.is_empty() {
            return Reply::End;
        }
        if self.stopped {
            return Reply::Stop;
        }
        // Towards the end less and less, so that all processes end at the same time.
        let wanted = usize::try_from(wanted).unwrap_or(usize::MAX);
        let taken = rest[..wanted.min(rest.len().div_ceil(2 * count))].to_vec();
        self.next += taken.len();
        Reply::Take(taken)
    }

    fn refuse(&mut self, rank: usize, cause: String) -> Reply {
        self.failure.get_or_insert(EnsembleError::Process { rank, cause });
        self.stopped = true;
        Reply::End
    }
}

/// Sends the other processes home.
fn dismiss(ranks: &dyn Ranks) {
    let mut working: BTreeSet<usize> = (1..ranks.count()).collect();
    while !working.is_empty() {
        match heard::<Request>(ranks) {
            Some((rank, _)) => {
                say(ranks, rank, &Reply::End);
                working.remove(&rank);
            }
            None => std::thread::sleep(PAUSE),
        }
    }
}

/// Another process: it computes what process 0 hands out.
fn follow<'c>(
    ranks: &dyn Ranks,
    mut crew: Crew<'c>,
    threads: usize,
    scope: &rayon::Scope<'c>,
) -> Result<Computed, EnsembleError> {
    /// Finished members are sent after this time at the latest.
    const LATEST: Duration = Duration::from_millis(20);
    let (mut members, mut computed) = (Vec::new(), 0);
    loop {
        // Short members are finished by the hundred between two messages: the more, the more are wanted at once.
        let wanted = (2 * (threads * crew.at_once() + members.len())).saturating_sub(crew.unfinished()) as u64;
        computed += members.len() as u64;
        let unfinished = crew.unfinished() as u64;
        let finished = Request::Finished { members: core::mem::take(&mut members), unfinished, wanted };
        let reply = ask(ranks, &finished).inspect_err(|error| {
            crew.stop();
            // Nobody answers this one where the run has ended.
            say(ranks, 0, &Request::Refused(error.to_string()));
        })?;
        match reply {
            Reply::Take(taken) => crew.take(scope, &taken),
            Reply::Stop => {
                crew.stop();
                while 0 < crew.unfinished() {
                    members.extend(crew.finished(LATEST));
                }
                continue;
            }
            Reply::End => {
                // Where process 0 has not understood something, members may still be in work.
                crew.stop();
                return Ok(Computed { computed, kept: 0, interrupted: false });
            }
        }
        let begun = Instant::now();
        loop {
            members.extend(crew.finished(PAUSE));
            if LATEST <= begun.elapsed() || (crew.unfinished() < threads * crew.at_once() && !members.is_empty()) {
                break;
            }
        }
    }
}

/// What the members of a part will cost.
///
/// # Example
/// See [`predicted_cost`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Cost {
    /// The members.
    pub members: u64,
    /// Time on one core, s, about; none of studies.
    pub seconds: Option<f64>,
    /// The table of members, bytes, about.
    pub bytes: f64,
}

/// What the members of a part will cost, by a trial of the first member.
///
/// # Errors
/// [`EnsembleError::Invalid`] when the first member fails at its start.
///
/// # Example
/// ```
/// use piola_ensemble::{Ensemble, Portion, predicted_cost};
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
/// let ensemble = Ensemble::new(scene, vec!["body.comet.semi_major_axis=1:4:1000".parse()?], Vec::new(), 1, 0)?;
/// let cost = predicted_cost(&ensemble, "1/4".parse()?)?;
/// assert_eq!(cost.members, 250);
/// assert!(cost.to_string().starts_with("250 members, about "));
/// # Ok::<(), piola_ensemble::EnsembleError>(())
/// ```
pub fn predicted_cost(ensemble: &Ensemble, part: Portion) -> Result<Cost, EnsembleError> {
    /// Of a number in the table.
    const BYTES: f64 = 20.0;
    let members = (ensemble.members() + part.parts - part.number) / part.parts;
    let columns = 1 + ensemble.varied().len() + ensemble.columns().len();
    let cost = Cost { members, seconds: None, bytes: BYTES * columns as f64 * members as f64 };
    let begun = Instant::now();
    let SceneFile::Motion(scene) = ensemble.scene(0)? else { return Ok(cost) };
    let plan = piola_scene::Plan::brief(&scene);
    let building = begun.elapsed().as_secs_f64();
    let trial = run::trial(&scene, &plan).map_err(|cause| EnsembleError::Invalid { member: 0, cause })?;
    Ok(Cost { seconds: Some((building + trial.seconds) * members as f64), ..cost })
}

impl core::fmt::Display for Cost {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{} member{}", self.members, if self.members == 1 { "" } else { "s" })?;
        if let Some(seconds) = self.seconds {
            write!(f, ", about {} of one core", run::duration(seconds))?;
        }
        write!(f, ", {:.1e} bytes of table", self.bytes)
    }
}
