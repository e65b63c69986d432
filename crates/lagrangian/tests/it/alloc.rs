//! Evaluations and steps allocate nothing after set-up.

use piola_integrators::Field;
use piola_lagrangian::{Forces, Holonomic, Lagrangian, Potential, Workspace};
use piola_testkit::allocations_in;

use crate::any::{Law, for_all_systems};

struct NoAllocation;
impl Law for NoAllocation {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) {
        let n = q.len();
        let mut work = Workspace::default();
        let (mut out, mut metric, mut rate) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; 2 * n]);
        let state = [q, v].concat();
        let (mut motion, mut canonical) = (lagrangian.motion(n), lagrangian.canonical_motion(n));
        let mut all = || {
            lagrangian.acceleration_into(&mut work, q, v, t, &mut out).unwrap();
            lagrangian.energies_with(&mut work, q, v, t).unwrap();
            lagrangian.inertia_metric_into(&mut work, q, t, &mut metric).unwrap();
            lagrangian.momenta_into(&mut work, q, v, t, &mut out).unwrap();
            lagrangian.velocities_into(&mut work, q, v, t, &mut out).unwrap();
            motion.rate(t, &state, &mut rate).unwrap();
            canonical.rate(t, &state, &mut rate).unwrap();
        };
        all();
        let (count, ()) = allocations_in(all);
        assert_eq!(count, 0, "{name}");
    }
}

#[test]
fn evaluations_allocate_nothing() {
    for_all_systems(&NoAllocation, &[0.25, -0.5, 0.75, 0.125, -0.25, 0.5], &[1.0, -0.5, 0.25, 0.75, 0.5, -1.0], 0.25);
}
