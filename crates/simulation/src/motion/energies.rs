//! The energy of a mechanism by parts: of motion and of weight for each particle and body, stored for each force.

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Holonomic, Placement, RigidBody};
use piola_numerics::Dual;

use crate::joints::Mechanism;

/// Names of the energies in their order.
pub(super) fn names(system: &Mechanism) -> Vec<String> {
    let parts = system
        .parts
        .iter()
        .flat_map(|part| [format!("kinetic energy of {} (J)", part.name), format!("weight of {} (J)", part.name)]);
    let stores = system.forces.iter().filter(|force| force.kind.stores());
    parts.chain(stores.map(|force| format!("energy of {} (J)", force.name))).collect()
}

/// The energies, J; their sum is the energy of the whole.
pub(super) fn energies(system: &Mechanism, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
    let moving: Vec<Dual<f64>> = q.iter().zip(v).map(|(q, v)| Dual::new(*q, *v)).collect();
    let mut parts = Parts { gravity: system.gravity, energies: Vec::new() };
    system.tree.place(&moving, Dual::constant(t), &mut parts);
    let stores = system.forces.iter().filter(|force| force.kind.stores());
    parts.energies.extend(stores.map(|force| force.kind.energy(&system.tree, &|i| q[i], t)));
    parts.energies
}

struct Parts {
    gravity: [f64; 3],
    energies: Vec<f64>,
}

impl Placement<Dual<f64>> for Parts {
    fn particle(&mut self, mass: f64, position: Vector3<Dual<f64>>) {
        let square: f64 = position.iter().map(|x| x.tangent * x.tangent).sum();
        let fall: f64 = position.iter().zip(self.gravity).map(|(x, g)| x.value * g).sum();
        self.energies.extend([0.5 * mass * square, -mass * fall]);
    }

    fn body(&mut self, body: &RigidBody, centre: Vector3<Dual<f64>>, attitude: Attitude<Dual<f64>>) {
        let first = self.energies.len();
        self.particle(body.mass(), centre);
        let Attitude { w, x, y, z } = attitude;
        let still = Attitude { w: w.value, x: x.value, y: y.value, z: z.value };
        let spin = still.angular_velocity_in_body([w, x, y, z].map(|component| component.tangent));
        self.energies[first] += 0.5 * spin.dot(&(body.inertia().matrix() * spin));
    }
}
