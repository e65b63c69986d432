//! Members a second of a sweep of double pendulums, on one thread and on two.
//!
//! `cargo run --release -p piola-ensemble --example pendulums -- 10000`

#![expect(clippy::print_stdout, reason = "the times are its output")]

use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use piola_ensemble::{Ensemble, EnsembleError, Options, Results, compute};
use piola_scene::{Document, SceneError};

/// Rounds: each number of threads takes its turn in each, and the least time counts.
const ROUNDS: usize = 3;

/// The double pendulum of scenes/, for 2 s at a tolerance of 1e-10, from as many angles as there are members.
fn ensemble(members: u64) -> Result<Ensemble, EnsembleError> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/double-pendulum.toml");
    let settings = ["time.end=2 s", "output.samples=2", "integrator.tolerance=1e-10"].map(str::to_owned);
    let scene = Document::read_with(&path, &settings).map_err(SceneError::from)?;
    Ensemble::new(scene, vec![format!("joint.elbow.angle=0:1.5:{members} rad").parse()?], Vec::new(), 1, 0)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let members = std::env::args().nth(1).map_or(Ok(2000), |count| count.parse())?;
    let folder = std::env::temp_dir().join(format!("piola-pendulums-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let ensemble = ensemble(members)?;
    let mut least = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        for (threads, least) in (1..).zip(&mut least) {
            let begun = Instant::now();
            let options = Options::default().with_threads(threads);
            compute(&ensemble, &folder, options, |_| ControlFlow::Continue(()))?;
            *least = least.min(begun.elapsed().as_secs_f64());
        }
    }
    let results = Results::collect(&ensemble, &folder)?;
    println!("{}", results.report());
    for (threads, least) in (1..).zip(least) {
        println!("threads: {threads}, members a second: {:.0}", members as f64 / least);
    }
    std::fs::remove_dir_all(&folder)?;
    Ok(())
}
