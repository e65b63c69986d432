//! Nothing is computed that was not asked for: how often the system is placed, and with which scalars.

use std::any::type_name;
use std::cell::RefCell;

use nalgebra::Vector3;
use piola_lagrangian::{Holonomic, Lagrangian, PartForce, PartPower, Placement, Reaction, Workspace};
use piola_numerics::{Jet, Real};

/// Two particles on lines that note the scalars they are placed with.
#[derive(Default)]
struct Counted<const TIME_DEPENDENT: bool>(RefCell<Vec<&'static str>>);

impl<const TIME_DEPENDENT: bool> Holonomic for Counted<TIME_DEPENDENT> {
    const TIME_DEPENDENT: bool = TIME_DEPENDENT;
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        self.0.borrow_mut().push(type_name::<T>());
        for &q in q {
            bodies.particle(1.0, Vector3::new(q, T::zero(), T::zero()));
        }
    }
}

/// The scalars of the placements during a call.
fn placed<const TIME_DEPENDENT: bool>(
    run: impl FnOnce(&Lagrangian<Counted<TIME_DEPENDENT>>, &mut Workspace),
) -> Vec<&'static str> {
    let system = Lagrangian::of(Counted::default());
    run(&system, &mut Workspace::default());
    system.system().0.take()
}

const STATE: (&[f64], &[f64], &[f64]) = (&[0.25, 0.5], &[1.0, 2.0], &[0.5, 0.25]);

#[test]
fn reactions_of_a_given_motion_place_the_system_once_along_it() {
    let mut out = [Reaction::none(); 2];
    let reactions = |system: &Lagrangian<Counted<true>>, work: &mut Workspace| {
        system.reactions_at_acceleration_into(work, STATE.0, STATE.1, STATE.2, 0.0, &mut out).unwrap();
    };
    assert_eq!(placed(reactions), [type_name::<Jet<f64, 0>>()]);
}

#[test]
fn powers_carry_the_derivative_along_the_time_only_where_it_is_declared() {
    let moving = placed::<true>(|system, work| {
        system.power_balance_at_acceleration(work, STATE.0, STATE.1, STATE.2, 0.0).unwrap();
    });
    assert_eq!(moving, [type_name::<Jet<f64, 1>>()]);
    let still = placed::<false>(|system, work| {
        system.power_balance_at_acceleration(work, STATE.0, STATE.1, STATE.2, 0.0).unwrap();
        system.force_along_time(STATE.0, STATE.1, 0.0).unwrap();
    });
    assert_eq!(still, [type_name::<Jet<f64, 0>>()], "no force along the time is sought");
}

#[test]
fn powers_of_actuators_and_virtual_work_need_no_accelerations() {
    let (mut parts, mut coordinates) = ([PartPower::default(); 2], [0.0; 2]);
    let placements = placed::<false>(|system, work| {
        system.actuator_powers_into(work, STATE.0, STATE.1, 0.0, &mut parts, &mut coordinates).unwrap();
        let forces = [PartForce::force([1.0, 0.0, 0.0]); 2];
        system.virtual_work_into(work, &forces, STATE.0, 0.0, &mut coordinates).unwrap();
    });
    assert_eq!(placements.len(), 2);
}
