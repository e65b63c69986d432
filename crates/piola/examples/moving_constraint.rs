//! A bead on a hoop that a motor turns: the force of the hoop, and where the energy comes from.
#![expect(clippy::print_stdout, reason = "an example prints")]

use nalgebra::Vector3;
use piola::integrators::Tolerance;
use piola::lagrangian::{Forces, Holonomic, Lagrangian, Placement};
use piola::numerics::Real;

/// 0.2 kg on a hoop of 0.5 m, started from rest: it turns by ½ α t² about its vertical diameter.
/// q = [angle from the lowest point].
struct Bead;

const MASS: f64 = 0.2;
const RADIUS: f64 = 0.5;
const ANGULAR_ACCELERATION: f64 = 2.0;

impl Holonomic for Bead {
    const TIME_DEPENDENT: bool = true;
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        let ((s, c), (st, ct)) = (q[0].sin_cos(), (T::lit(0.5 * ANGULAR_ACCELERATION) * t * t).sin_cos());
        let r = T::lit(RADIUS);
        bodies.particle(MASS, Vector3::new(r * s * ct, r * s * st, -r * c));
    }
}

/// Drag of the air, −0.02 v.
struct Drag;

impl Forces for Drag {
    const ON_PARTS: bool = true;
    fn on_part<T: Real>(&self, _part: usize, _x: [T; 3], velocity: [T; 3], _t: T) -> [T; 3] {
        velocity.map(|v| T::lit(-0.02) * v)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bead = Lagrangian::of(Bead).with_gravity(9.81).with_forces(Drag);
    let tolerance = Tolerance::relative(1e-12)?;
    let (mut q, mut v) = (vec![0.1], vec![0.0]);
    let (mut drive, mut drag) = (0.0, 0.0);
    println!("  t/s   angle/°    |hoop|/N   drive/W     drag/W     E+V/J     work/J   imbalance");
    for second in 0..8 {
        let t = f64::from(second);
        let force = bead.reactions(&q, &v, t)?[0].force().norm();
        let power = bead.power_balance(&q, &v, t)?;
        let energy = bead.energies(&q, &v, t)?.total();
        let account = bead.work_account(&q, &v, t..t + 1.0, tolerance)?;
        println!(
            "{t:5.1} {:9.3} {force:11.6} {:9.5} {:10.6} {energy:9.5} {:10.6}   {:.1e}",
            q[0].to_degrees(),
            power.moving_constraint,
            power.applied,
            drive + drag,
            account.imbalance()
        );
        assert!(account.imbalance() < 1e-10 && power.residual().abs() < 1e-10);
        drive += account.works.moving_constraint;
        drag += account.works.applied;
        (q, v) = (account.coordinates, account.velocities);
    }
    println!("the motor gave {drive:.6} J, the air took {:.6} J", -drag);
    Ok(())
}
