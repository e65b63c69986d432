//! The program `piola` on the processes of MPI. Started alone it is the same program.

use std::process::ExitCode;

use mpi::Threading;
use mpi::point_to_point::traits::{Destination as _, MatchedReceiveVec as _, Source as _};
use mpi::topology::{Communicator as _, SimpleCommunicator};
use piola_ensemble::{OneProcess, Ranks};

/// The processes of `MPI_COMM_WORLD`.
struct World(SimpleCommunicator);

fn place(rank: mpi::Rank) -> usize {
    usize::try_from(rank).unwrap_or_default()
}

impl Ranks for World {
    fn rank(&self) -> usize {
        place(self.0.rank())
    }
    fn count(&self) -> usize {
        place(self.0.size())
    }
    fn send(&self, to: usize, message: &[u8]) {
        // A rank of MPI is an `int`.
        self.0.process_at_rank(to.try_into().unwrap_or_default()).send(message);
    }
    fn receive(&self) -> Option<(usize, Vec<u8>)> {
        let (content, status) = self.0.any_process().immediate_matched_probe()?.matched_receive_vec();
        Some((place(status.source_rank()), content))
    }
}

fn main() -> ExitCode {
    // Threads compute; this one alone speaks to the other processes.
    let Some((universe, _)) = mpi::initialize_with_threading(Threading::Funneled) else {
        return piola_cli::program(&OneProcess);
    };
    let exit = piola_cli::program(&World(universe.world()));
    // Ends MPI: every process comes here.
    drop(universe);
    exit
}
