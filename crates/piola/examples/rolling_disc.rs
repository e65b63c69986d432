//! A coin set rolling on a table: the path of its point of contact, the force there, and how well energy is kept.
#![expect(clippy::print_stdout, reason = "an example prints")]

use piola::integrators::{DormandPrince853, State, Tolerance};
use piola::lagrangian::anholonomic::rolling::RollingDisc;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 5.7 g, 24 mm across: a coin. It knows its placement (one body), its frame (what rolls and what would slip),
    // and that nothing slips.
    let (mass, gravity) = (5.7e-3, 9.81);
    let coin = RollingDisc::homogeneous(mass, 12e-3)?.on_plane([0.0, 0.0, -gravity]);

    // The point of contact, the angle of the track, the axis 5° from level (lean), the spin; and their rates.
    let q = [0.0, 0.0, 0.0, 85_f64.to_radians(), 0.0];
    let rates = [0.0, 0.0, -40.0]; // rolls along y with R · 40 rad/s = 0.48 m/s
    let start = coin.energies(&q, &rates, 0.0)?.total();

    let mut state = State::new(0.0, [q.as_slice(), &rates].concat())?;
    let mut motion = coin.motion(q.len());
    let mut method = DormandPrince853::new(Tolerance::relative(1e-12)?);
    let mut worst = 0.0_f64;
    println!(" t/s     x/mm     y/mm   lean/°   friction/weight   normal/weight   energy error");
    for step in 0..=10 {
        method.integrate_to(&mut motion, &mut state, 0.1 * f64::from(step))?;
        let (q, rates) = state.values.split_at(q.len());
        // The force that the table exerts, in space: friction along x and y, the normal force along z.
        let force = coin.part_reactions(q, rates, state.time)?[0].force() / (mass * gravity);
        let error = coin.energies(q, rates, state.time)?.total() / start - 1.0;
        println!(
            "{:4.1} {:8.2} {:8.2} {:8.2} {:17.6} {:15.6} {error:14.1e}",
            state.time,
            1e3 * q[0],
            1e3 * q[1],
            90.0 - q[3].to_degrees(),
            force.x.hypot(force.y),
            force.z,
        );
        worst = worst.max(error.abs());
    }
    assert!(worst < 1e-10);
    Ok(())
}
