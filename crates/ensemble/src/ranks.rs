//! The processes of one run, as MPI starts them, and their messages: to agree on the sweep, to share out members.

use core::time::Duration;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::{Ensemble, EnsembleError, Member};

/// The processes of one run and the messages between them. [`OneProcess`] is a usual run.
///
/// The program `piola` of the folder `mpi` of the repository has them from MPI. Messages between two processes arrive in the order in which they were sent.
///
/// # Example
/// ```
/// use piola_ensemble::{OneProcess, Ranks};
/// assert_eq!((OneProcess.rank(), OneProcess.count(), OneProcess.receive()), (0, 1, None));
/// ```
pub trait Ranks {
    /// Which process this is, from 0. Process 0 keeps the journal and writes the results.
    fn rank(&self) -> usize;
    /// The number of processes.
    fn count(&self) -> usize;
    /// Sends a message to another process.
    fn send(&self, to: usize, message: &[u8]);
    /// A message that has arrived, with its sender; `None` when there is none yet.
    fn receive(&self) -> Option<(usize, Vec<u8>)>;
}

/// One process.
///
/// # Example
/// See [`Ranks`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OneProcess;

impl Ranks for OneProcess {
    fn rank(&self) -> usize {
        0
    }
    fn count(&self) -> usize {
        1
    }
    fn send(&self, _to: usize, _message: &[u8]) {}
    fn receive(&self) -> Option<(usize, Vec<u8>)> {
        None
    }
}

/// What a process says to process 0. It then waits for the [`Reply`], so that neither waits for the other to receive.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Request {
    /// The identity of its ensemble.
    Ready(String),
    /// Why it cannot begin or cannot go on.
    Refused(String),
    /// Members that are finished, the number of those in work, and of those wanted besides.
    Finished { members: Vec<Member>, unfinished: u64, wanted: u64 },
}

/// The answer of process 0.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Reply {
    /// Members to compute; perhaps none now.
    Take(Vec<u64>),
    /// Stop, and send the members that are finished.
    Stop,
    /// There is nothing more to do.
    End,
}

/// How long a process sleeps between two looks for messages.
pub(crate) const PAUSE: Duration = Duration::from_millis(1);

pub(crate) fn say<T: Serialize>(ranks: &dyn Ranks, to: usize, message: &T) {
    ranks.send(to, &serde_json::to_vec(message).unwrap_or_default());
}

/// The next message, if there is one, with its sender; or why it is not understood.
pub(crate) fn heard<T: DeserializeOwned>(ranks: &dyn Ranks) -> Option<(usize, Result<T, String>)> {
    let (rank, message) = ranks.receive()?;
    let read = serde_json::from_slice(&message);
    Some((rank, read.map_err(|error| format!("its message is not understood: {error}"))))
}

/// Asks process 0 and waits for its answer.
pub(crate) fn ask(ranks: &dyn Ranks, request: &Request) -> Result<Reply, EnsembleError> {
    say(ranks, 0, request);
    loop {
        if let Some((rank, reply)) = heard(ranks) {
            return reply.map_err(|cause| EnsembleError::Process { rank, cause });
        }
        std::thread::sleep(PAUSE);
    }
}

/// Lets all processes begin, or none: each must have read the same ensemble. All of them call this once.
///
/// `prepared` is the ensemble that this process has read, or why it could not.
///
/// # Errors
/// [`EnsembleError::Process`] on every process when one of them has no ensemble or another one.
///
/// # Example
/// ```
/// use piola_ensemble::{OneProcess, agree};
/// assert!(agree(&OneProcess, Err("the scene is missing".to_owned())).is_err());
/// ```
pub fn agree(ranks: &dyn Ranks, prepared: Result<&Ensemble, String>) -> Result<(), EnsembleError> {
    let own = prepared.map(Ensemble::identity);
    if ranks.rank() != 0 {
        let request = own.map_or_else(Request::Refused, Request::Ready);
        return match ask(ranks, &request)? {
            Reply::Take(_) => Ok(()),
            Reply::Stop | Reply::End => {
                Err(EnsembleError::Process { rank: 0, cause: "it does not begin; it says why".into() })
            }
        };
    }
    let mut refused = own.as_ref().err().map(|cause| (0, cause.clone()));
    for _ in 1..ranks.count() {
        let (rank, cause) = loop {
            match heard(ranks) {
                Some((rank, Ok(request))) => break (rank, objection(request, own.as_ref().ok())),
                // Another version, perhaps.
                Some((rank, Err(cause))) => break (rank, Some(cause)),
                None => std::thread::sleep(PAUSE),
            }
        };
        refused = refused.or(cause.map(|cause| (rank, cause)));
    }
    let reply = if refused.is_some() { Reply::End } else { Reply::Take(Vec::new()) };
    (1..ranks.count()).for_each(|rank| say(ranks, rank, &reply));
    refused.map_or(Ok(()), |(rank, cause)| Err(EnsembleError::Process { rank, cause }))
}

/// Why a process that says this does not begin beside one with this ensemble.
fn objection(request: Request, own: Option<&String>) -> Option<String> {
    match request {
        Request::Refused(cause) => Some(cause),
        // Where process 0 has no ensemble, it says why.
        Request::Ready(other) if own.is_none_or(|own| other == *own) => None,
        Request::Ready(_) | Request::Finished { .. } => {
            Some("it has read another scene, or is another version".to_owned())
        }
    }
}
