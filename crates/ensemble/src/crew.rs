//! The threads of one process, and the members they compute.

use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::sync::mpsc::{Receiver, Sender, channel};

use crate::{Ensemble, EnsembleError, Member};

/// Members that are computed or wait for a thread.
pub(crate) struct Crew<'c> {
    ensemble: &'c Ensemble,
    stop: &'c AtomicBool,
    sender: Sender<Option<Member>>,
    receiver: Receiver<Option<Member>>,
    unfinished: usize,
}

/// Says that a member is done with, even when its thread panics.
struct Report {
    member: Option<Member>,
    sender: Sender<Option<Member>>,
}

impl Drop for Report {
    fn drop(&mut self) {
        // Nobody listens any more only after a panic.
        let _ = self.sender.send(self.member.take());
    }
}

impl<'c> Crew<'c> {
    pub(crate) fn new(ensemble: &'c Ensemble, stop: &'c AtomicBool) -> Self {
        let (sender, receiver) = channel();
        Self { ensemble, stop, sender, receiver, unfinished: 0 }
    }

    pub(crate) const fn at_once(&self) -> usize {
        self.ensemble.at_once()
    }

    pub(crate) const fn unfinished(&self) -> usize {
        self.unfinished
    }

    /// Hands members to the threads, in groups that are computed together.
    pub(crate) fn take(&mut self, scope: &rayon::Scope<'c>, members: &[u64]) {
        let (ensemble, stop) = (self.ensemble, self.stop);
        for members in members.chunks(ensemble.at_once()) {
            let report = || Report { member: None, sender: self.sender.clone() };
            let (members, reports): (Vec<u64>, Vec<Report>) = members.iter().map(|&member| (member, report())).unzip();
            self.unfinished += members.len();
            scope.spawn(move |_| {
                let found = ensemble.together(&members, || stop.load(Ordering::Relaxed));
                for (mut report, member) in reports.into_iter().zip(found) {
                    report.member = member;
                    drop(report);
                }
            });
        }
    }

    /// A member that is finished, after no more than `wait`.
    pub(crate) fn finished(&mut self, wait: Duration) -> Option<Member> {
        let member = self.receiver.recv_timeout(wait).ok()?;
        self.unfinished -= 1;
        member
    }

    pub(crate) fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

pub(crate) fn pool(threads: Option<usize>) -> Result<rayon::ThreadPool, EnsembleError> {
    let threads = threads.unwrap_or(0);
    let refused = |argument| EnsembleError::Argument { argument, valid: "a number of threads that the machine starts" };
    // Of more the pool would start fewer and say nothing.
    if rayon::max_num_threads() < threads {
        return Err(refused(format!("{threads} threads")));
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|error| refused(error.to_string()))
}
