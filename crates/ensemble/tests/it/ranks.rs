//! Several processes, here threads that speak through channels: the same bytes, nothing lost and nothing done twice.

use core::ops::ControlFlow;
use std::cell::Cell;
use std::path::Path;
use std::sync::mpsc::{Receiver, Sender, channel};

use piola_ensemble::{Computed, Ensemble, EnsembleError, Options, Ranks, agree, compute_across};

use crate::journal::{Folder, bytes, ensemble, orbit, run};

/// Ends of channels in place of processes.
struct Threads {
    rank: usize,
    others: Vec<Sender<(usize, Vec<u8>)>>,
    inbox: Receiver<(usize, Vec<u8>)>,
    /// To whom a message arrives garbled, and how many before it do not.
    garbled: Option<(usize, Cell<usize>)>,
}

impl Threads {
    fn new(count: usize) -> Vec<Self> {
        let (others, inboxes): (Vec<_>, Vec<_>) = (0..count).map(|_| channel()).unzip();
        let threads = inboxes.into_iter().enumerate();
        threads.map(|(rank, inbox)| Self { rank, others: others.clone(), inbox, garbled: None }).collect()
    }
}

impl Ranks for Threads {
    fn rank(&self) -> usize {
        self.rank
    }
    fn count(&self) -> usize {
        self.others.len()
    }
    fn send(&self, to: usize, message: &[u8]) {
        let garbled = self.garbled.as_ref().filter(|(whom, _)| *whom == to).is_some_and(|(_, before)| {
            let left = before.get();
            before.set(left.wrapping_sub(1));
            left == 0
        });
        let message = if garbled { b"{\"Fini".to_vec() } else { message.to_vec() };
        // A thread that has ended reads nothing.
        let _ = self.others[to].send((self.rank, message));
    }
    fn receive(&self) -> Option<(usize, Vec<u8>)> {
        self.inbox.try_recv().ok()
    }
}

type Ended = Result<Computed, EnsembleError>;

/// One ensemble on several threads that are processes; process 0 stops after `most` members.
fn across(ensembles: &[Ensemble], folder: &Path, options: Options, most: usize) -> Vec<Ended> {
    each(Threads::new(3), ensembles, folder, |_| options, most)
}

/// Each process with its options.
fn each(
    processes: Vec<Threads>,
    ensembles: &[Ensemble],
    folder: &Path,
    options: impl Fn(usize) -> Options + Sync,
    most: usize,
) -> Vec<Ended> {
    let work = |ranks: &Threads| {
        let ensemble = &ensembles[ranks.rank().min(ensembles.len() - 1)];
        agree(ranks, Ok(ensemble))?;
        let mut seen = 0;
        compute_across(ensemble, folder, options(ranks.rank()), ranks, |_| {
            seen += 1;
            if seen == most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
    };
    let work = &work;
    std::thread::scope(|scope| {
        let threads = processes.into_iter().map(|ranks| scope.spawn(move || work(&ranks)));
        let threads: Vec<_> = threads.collect();
        threads.into_iter().map(|thread| thread.join().unwrap_or_else(|_| panic!("a thread ended"))).collect()
    })
}

fn ended(ended: &[Ended]) -> Vec<Computed> {
    ended.iter().map(|ended| ended.clone().unwrap_or_else(|error| panic!("{error}"))).collect()
}

fn lines(folder: &Folder) -> usize {
    let journal = folder.path().join("members-1-of-1.journal");
    std::fs::read_to_string(journal).unwrap_or_else(|error| panic!("{error}")).lines().count()
}

#[test]
fn three_processes_give_the_bytes_of_one() {
    let ensemble = ensemble();
    let (one, three) = (Folder::new("one-process"), Folder::new("three-processes"));
    run(&ensemble, &one, Options::default());
    let found =
        ended(&across(core::slice::from_ref(&ensemble), three.path(), Options::default().with_threads(2), usize::MAX));
    assert_eq!((found[0].computed, found[0].kept, found[0].interrupted), (40, 0, false));
    // Some by each; what process 0 has not computed itself was sent to it.
    assert!(found[1].computed + found[2].computed <= 40, "{found:?}");
    assert_eq!(bytes(&ensemble, &three), bytes(&ensemble, &one));
    assert_eq!(lines(&three), 41);
}

#[test]
fn interrupted_processes_go_on_as_one_and_as_three_and_do_nothing_twice() {
    let ensemble = ensemble();
    let (whole, cut) = (Folder::new("whole-processes"), Folder::new("cut-processes"));
    run(&ensemble, &whole, Options::default());
    let options = Options::default().with_threads(1);
    let first = ended(&across(core::slice::from_ref(&ensemble), cut.path(), options, 5));
    assert!(first[0].interrupted && 5 <= first[0].computed && first[0].computed < 40, "{first:?}");
    let again = ended(&across(core::slice::from_ref(&ensemble), cut.path(), options.with_resume(), 3));
    assert_eq!(again[0].kept, first[0].computed);
    run(&ensemble, &cut, Options::default().with_resume());
    assert_eq!(bytes(&ensemble, &cut), bytes(&ensemble, &whole));
    assert_eq!(lines(&cut), 41);
}

#[test]
fn processes_with_different_scenes_do_not_begin() {
    let other = Ensemble::new(orbit(), Vec::new(), Vec::new(), 1, 0).unwrap_or_else(|error| panic!("{error}"));
    let folder = Folder::new("different-processes");
    let found = across(&[ensemble(), ensemble(), other], folder.path(), Options::default(), usize::MAX);
    let words = "process 2 of the run: it has read another scene, or is another version";
    assert_eq!(found[0].as_ref().map_err(ToString::to_string).err().as_deref(), Some(words));
    assert!(found.iter().all(|ended| matches!(ended, Err(EnsembleError::Process { .. }))), "{found:?}");
    assert!(std::fs::read_dir(folder.path()).is_ok_and(|mut entries| entries.next().is_none()));
}

#[test]
fn a_journal_that_cannot_be_written_ends_all_processes() {
    let ensemble = ensemble();
    let folder = Folder::new("no-folder-processes");
    let missing = folder.path().join("missing");
    let found = across(&[ensemble], &missing, Options::default(), usize::MAX);
    assert!(matches!(found[0], Err(EnsembleError::Journal { .. })), "{found:?}");
    assert!(found[1..].iter().all(Result::is_ok), "{found:?}");
}

fn word(ended: &Ended) -> String {
    ended.as_ref().map_or_else(ToString::to_string, |computed| format!("{computed:?}"))
}

/// Resumed by one process, the folder has the bytes of a run that nothing disturbed, and no member twice.
fn goes_on(ensemble: &Ensemble, folder: &Folder, name: &str) {
    let whole = Folder::new(name);
    run(ensemble, &whole, Options::default());
    run(ensemble, folder, Options::default().with_resume());
    assert_eq!(bytes(ensemble, folder), bytes(ensemble, &whole));
    assert_eq!(lines(folder), 41);
}

/// More threads than a pool may have.
fn too_many(failing: usize) -> impl Fn(usize) -> Options + Sync {
    move |rank| Options::default().with_threads(if rank == failing { usize::MAX } else { 1 })
}

#[test]
fn a_process_without_threads_ends_all_and_process_0_says_why() {
    let ensemble = ensemble();
    let folder = Folder::new("no-threads-process");
    let found = each(Threads::new(3), core::slice::from_ref(&ensemble), folder.path(), too_many(2), usize::MAX);
    let why = word(&found[2]);
    assert!(matches!(&found[2], Err(EnsembleError::Argument { .. })) && why.contains("threads"), "{found:?}");
    assert_eq!(word(&found[0]), format!("process 2 of the run: {why}"));
    assert!(found[1].is_ok(), "{found:?}");
    goes_on(&ensemble, &folder, "no-threads-whole");
}

#[test]
fn process_0_without_threads_ends_all() {
    let ensemble = ensemble();
    let folder = Folder::new("no-threads-process-0");
    let found = each(Threads::new(3), core::slice::from_ref(&ensemble), folder.path(), too_many(0), usize::MAX);
    assert!(matches!(found[0], Err(EnsembleError::Argument { .. })), "{found:?}");
    assert!(found[1..].iter().all(Result::is_ok), "{found:?}");
    assert!(std::fs::read_dir(folder.path()).is_ok_and(|mut entries| entries.next().is_none()));
}

#[test]
fn a_request_that_is_not_understood_ends_all_processes() {
    let ensemble = ensemble();
    let folder = Folder::new("garbled-request");
    let mut processes = Threads::new(3);
    // The first message after the one of `agree`.
    processes[1].garbled = Some((0, Cell::new(1)));
    let options = |_| Options::default().with_threads(1);
    let found = each(processes, core::slice::from_ref(&ensemble), folder.path(), options, usize::MAX);
    assert!(word(&found[0]).starts_with("process 1 of the run: its message is not understood"), "{found:?}");
    assert!(found[1..].iter().all(Result::is_ok), "{found:?}");
    goes_on(&ensemble, &folder, "garbled-request-whole");
}

#[test]
fn an_answer_that_is_not_understood_ends_all_processes() {
    let ensemble = ensemble();
    let folder = Folder::new("garbled-answer");
    let mut processes = Threads::new(3);
    processes[0].garbled = Some((2, Cell::new(1)));
    let options = |_| Options::default().with_threads(1);
    let found = each(processes, core::slice::from_ref(&ensemble), folder.path(), options, usize::MAX);
    assert!(word(&found[2]).starts_with("process 0 of the run: its message is not understood"), "{found:?}");
    assert!(found[1].is_ok(), "{found:?}");
    // Where that answer was the last one, process 0 has ended well.
    if found[0].is_err() {
        assert!(word(&found[0]).starts_with("process 2 of the run: process 0 of the run: "), "{found:?}");
    }
    goes_on(&ensemble, &folder, "garbled-answer-whole");
}
