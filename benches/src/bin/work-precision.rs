//! Error against time on fourteen problems, our methods and the peers': see [`piola_benches::program`].

use piola_benches::program::{DormandPrincePeers, program};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    program(&DormandPrincePeers)
}
