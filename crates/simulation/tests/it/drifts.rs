//! Drifts of invariants by their definitions.

use piola_simulation::motion::{History, Invariants, Scaled};
use piola_testkit::{Tol, assert_close};

fn record(time: f64, energy: f64, energy_scale: f64, momentum: Scaled) -> Invariants {
    Invariants {
        work: 0.0,
        time,
        energy,
        energy_scale,
        post_newtonian_energy: Some(4.0 * energy),
        momentum: Some(momentum),
        angular_momentum: None,
    }
}

/// Energies −2, −2.5 and −1.75 J; the momentum leaves (1, 2, 2) by (2, 3, 6), of length 7.
fn history(energy_scale: f64) -> History {
    let mut history = History::default();
    history.invariants = vec![
        record(0.0, -2.0, 0.0, ([1.0, 2.0, 2.0], 3.0)),
        record(1.0, -2.5, energy_scale, ([3.0, 5.0, 8.0], 28.0)),
        record(2.0, -1.75, 0.0, ([1.0, 2.0, 2.0], 28.0)),
    ];
    history
}

#[test]
fn drift_is_the_change_since_the_start_over_its_scale() {
    // Over |E₀| = 2 J, or over the largest kinetic energy, 8 J, where that is more.
    for (kinetic, scale) in [(0.0, 2.0), (1.0, 2.0), (8.0, 8.0)] {
        let drifts = history(kinetic).drifts();
        let (Some(energy), Some(relativistic), Some(momentum)) =
            (drifts.energy, drifts.post_newtonian_energy, drifts.momentum)
        else {
            panic!("energies and momentum are recorded")
        };
        let found = [energy.max_relative, energy.last_relative, relativistic.max_relative, relativistic.last_relative];
        assert_close("energy", &found, &[0.5 / scale, 0.25 / scale, 2.0 / 8.0, 1.0 / 8.0], Tol::ulps(2.0));
        assert_close("momentum", &[momentum.max_relative, momentum.last_relative], &[0.25, 0.0], Tol::ulps(2.0));
        assert_eq!(drifts.angular_momentum, None);
    }
}
