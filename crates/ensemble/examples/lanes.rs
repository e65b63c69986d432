//! Members of a sweep of three attracting bodies: integrated together, in lanes, and each alone.
//!
//! `cargo run --release -p piola-ensemble --example lanes -- 200`

#![expect(clippy::print_stdout, reason = "the times are its output")]

use std::time::Instant;

use piola_ensemble::Ensemble;
use piola_scene::Document;

/// Rounds: each way takes its turn in each, and the least time counts.
const ROUNDS: usize = 5;

/// A sun, a planet and its moon for ten turns, in 1000 steps of order 8.
const SCENE: &str = "
[gravity]
[[body]]
name = 'sun'
gm = 1.0
position = [0, 0, 0]
velocity = [0, 0, 0]
[[body]]
name = 'planet'
gm = 1e-3
position = [1, 0, 0]
velocity = [0, 1, 0]
[[body]]
name = 'moon'
gm = 1e-9
position = [1.01, 0, 0]
velocity = [0, 1.3, 0]
[time]
end = 62.83185307179586
[output]
samples = 2
[integrator]
method = 'composition-8'
step = 0.06283185307179587
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let members = std::env::args().nth(1).map_or(Ok(200_u64), |count| count.parse())?;
    let range = format!("body.moon.velocity[1]=1.25:1.35:{members}").parse()?;
    let ensemble = Ensemble::new(Document::parse("three.toml", SCENE), vec![range], Vec::new(), 1, 0)?;
    let all: Vec<u64> = (0..members).collect();
    let mut least = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        let begun = Instant::now();
        let alone: Vec<_> = all.iter().map(|&member| Some(ensemble.member(member))).collect();
        least[0] = least[0].min(begun.elapsed().as_secs_f64());
        let begun = Instant::now();
        let together = ensemble.together(&all, || false);
        least[1] = least[1].min(begun.elapsed().as_secs_f64());
        assert!(alone == together, "the numbers differ");
    }
    let [alone, together] = least.map(|least| 1e3 * least / members as f64);
    println!("alone {alone:.3} ms a member, together {together:.3} ms: {:.2} times as fast", alone / together);
    Ok(())
}
