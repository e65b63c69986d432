//! Reactions put back, and what they do in virtual displacements.

use nalgebra::{DVector, Vector3};
use piola_lagrangian::newton_euler::{NewtonEuler, moment_about_origin, particle_acceleration};
use piola_lagrangian::{ConstraintVerdict, Forces, Holonomic, Lagrangian, PartForce, Placement, Reaction, Workspace};
use piola_numerics::{Dual, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use crate::systems::*;

proptest! {
    #[test]
    fn lagrange_equals_newton_euler_with_reactions_put_back((q, v, t) in states()) {
        let system = driven();
        let a = system.acceleration(&q, &v, t).unwrap();
        let motions = motions(system.system(), (&q, &v, a.as_slice()), t);
        let external = external_forces(&motions, t);
        let reactions = system.reactions(&q, &v, t).unwrap();
        let (particles, body) = motions;

        let tol = Tol::ulps(64.0).times(condition(&system, (&q, &v, t)));
        for (part, mass, motion) in [(0, 1.5, particles[0]), (2, 0.5, particles[1])] {
            let force = external[part].force + reactions[part].force();
            let free = particle_acceleration(mass, &force).unwrap();
            assert_close_at_scale("particle", free.as_slice(), motion.acceleration.as_slice(), 10.0, tol);
            assert_eq!(reactions[part].position(), &motion.position);
        }
        let laws = NewtonEuler::of(system.system().body()).unwrap();
        let free = laws.acceleration(&(external[1].force + reactions[1].force()));
        assert_close_at_scale("body", free.as_slice(), body.acceleration.as_slice(), 10.0, tol);
        let moment = external[1].moment + reactions[1].moment_in_body();
        let free = laws.angular_acceleration(&moment, &body.angular_velocity);
        assert_close_at_scale("rotation", free.as_slice(), body.angular_acceleration.as_slice(), 10.0, tol);
        let in_space = body.attitude.to_space(&reactions[1].moment_in_body());
        assert_close("in space", reactions[1].moment_in_space().as_slice(), in_space.as_slice(), Tol::ulps(0.0));
    }

    #[test]
    fn reactions_do_no_virtual_work((q, v, t) in states()) {
        let system = driven();
        let reactions: Vec<PartForce> =
            system.reactions(&q, &v, t).unwrap().into_iter().map(PartForce::from).collect();
        let test = system.ideal_constraint_test(&reactions, &q, t).unwrap();
        let tol = Tol::ulps(64.0).times(condition(&system, (&q, &v, t)));
        prop_assert_eq!(test.verdict(tol.value()), ConstraintVerdict::Ideal);
        let work = system.virtual_work(&reactions, &q, t).unwrap();
        assert_close("power", test.powers(), work.as_slice(), Tol::ulps(0.0));
        let of_motion = system.reaction_test(&q, &v, t).unwrap();
        prop_assert_eq!(of_motion.verdict(tol.value()), ConstraintVerdict::Ideal);
        assert_close("power", of_motion.powers(), work.as_slice(), Tol::ulps(0.0));
    }

    /// What a potential and generalised forces do is in the reactions, and no more.
    #[test]
    fn virtual_work_of_reactions_equals_forces_known_by_their_work_alone((q, v, t) in states()) {
        let system = everything();
        let a = system.acceleration(&q, &v, t).unwrap();
        let reactions: Vec<PartForce> =
            system.reactions(&q, &v, t).unwrap().into_iter().map(PartForce::from).collect();
        let work = system.virtual_work(&reactions, &q, t).unwrap();
        // Without potential and generalised forces something is left over of the equations: −Q.
        let rest = driven().driving_forces(&q, &v, a.as_slice(), t).unwrap();
        let tol = Tol::ulps(16.0).times(condition(&system, (&q, &v, t)));
        assert_close_at_scale("Q", work.as_slice(), rest.as_slice(), 10.0, tol);
    }

    #[test]
    fn rate_of_momentum_equals_forces_and_rate_of_angular_momentum_equals_moments((q, v, t) in states()) {
        let system = driven();
        let a = system.acceleration(&q, &v, t).unwrap();
        let along = |x: &[f64], rate: &[f64]| -> Vec<Dual<f64>> {
            x.iter().zip(rate).map(|(&x, &rate)| Dual::new(x, rate)).collect()
        };
        let about = Vector3::new(0.5, -0.25, 1.0);
        let moving = system
            .system_momentum(&along(&q, &v), &along(&v, a.as_slice()), Dual::variable(t), &about.map(Dual::constant))
            .unwrap();
        let motions = motions(system.system(), (&q, &v, a.as_slice()), t);
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (external, reaction) in external_forces(&motions, t).iter().zip(system.reactions(&q, &v, t).unwrap()) {
            force += external.force + reaction.force();
            let couple = match reaction {
                Reaction::Body { attitude, .. } => attitude.to_space(&external.moment),
                Reaction::Particle { .. } => Vector3::zeros(),
            };
            let arm = reaction.position() - about;
            moment += moment_about_origin(&arm, &external.force, &couple) + reaction.moment_about(&about);
        }
        let tol = Tol::ulps(8.0).times(condition(&system, (&q, &v, t)));
        let rates = moving.momentum.map(|x| x.tangent);
        assert_close_at_scale("force", rates.as_slice(), force.as_slice(), 50.0, tol);
        let rates = moving.angular_momentum.map(|x| x.tangent);
        assert_close_at_scale("moment", rates.as_slice(), moment.as_slice(), 50.0, tol);
    }

    #[test]
    fn driving_forces_of_the_acceleration_vanish_and_others_are_the_metric_times_what_is_added((q, v, t) in states()) {
        let system = everything();
        let a = system.acceleration(&q, &v, t).unwrap();
        let more = DVector::from_vec(vec![1.0, -2.0, 0.5]);
        let tol = Tol::ulps(16.0).times(condition(&system, (&q, &v, t)));
        let none = system.driving_forces(&q, &v, a.as_slice(), t).unwrap();
        assert_close_at_scale("at rest", none.as_slice(), &[0.0; 3], 50.0, tol);
        let (mut mass_matrix, mut forcing) = (nalgebra::DMatrix::zeros(3, 3), [0.0; 3]);
        let mut work = Workspace::default();
        system.equations_into(&mut work, &q, &v, t, mass_matrix.as_mut_slice(), &mut forcing).unwrap();
        let some = system.driving_forces(&q, &v, (a + &more).as_slice(), t).unwrap();
        assert_close_at_scale("driven", some.as_slice(), (mass_matrix * more).as_slice(), 50.0, tol);
    }
}

/// A bead on a straight rough wire, slope 3 to 4.
struct Wire;
impl Holonomic for Wire {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        bodies.particle(2.0, Vector3::new(T::lit(0.8) * q[0], T::zero(), T::lit(-0.6) * q[0]));
    }
}

/// Friction −3 N along the wire.
struct Friction;
impl Forces for Friction {
    const ON_PARTS: bool = true;
    fn on_part<T: Real>(&self, _part: usize, _x: [T; 3], _v: [T; 3], _t: T) -> [T; 3] {
        [T::lit(-2.4), T::zero(), T::lit(1.8)]
    }
}

#[test]
fn friction_is_a_working_constraint_force_and_the_normal_force_is_not() {
    let wire = Lagrangian::of(Wire).with_gravity(10.0).with_forces(Friction);
    let (q, v) = ([0.5], [1.0]);
    // m q̈ = 12 − 3
    assert_close("q̈", wire.acceleration(&q, &v, 0.0).unwrap().as_slice(), &[4.5], Tol::ulps(2.0));
    let normal: PartForce = wire.reactions(&q, &v, 0.0).unwrap()[0].into();
    assert_close("normal force", normal.force.as_slice(), &[9.6, 0.0, 12.8], Tol::ulps(8.0)); // m g cos, across
    let verdict = |force: PartForce| wire.ideal_constraint_test(&[force], &q, 0.0).unwrap().verdict(1e-12);
    assert_eq!(verdict(normal), ConstraintVerdict::Ideal);
    let rough = PartForce::force([normal.force.x - 2.4, normal.force.y, normal.force.z + 1.8]);
    let ConstraintVerdict::Working { coordinate: 0, power, .. } = verdict(rough) else {
        panic!("friction has power: {:?}", verdict(rough));
    };
    assert_close("power", &[power], &[-3.0], Tol::ulps(16.0));
}

#[test]
fn reactions_in_single_precision_equal_those_in_double() {
    let wire = Lagrangian::of(Wire).with_gravity(10.0).with_forces(Friction);
    let single = wire.reactions(&[0.5_f32], &[1.0], 0.0).unwrap()[0];
    let actual: Vec<f64> = single.force().iter().map(|&f| f64::from(f)).collect();
    assert_close("normal force", &actual, &[9.6, 0.0, 12.8], Tol::ulps32(8.0));
}

/// Many coordinates in chunks: a chain whose last link alone is pushed.
struct Chain;
impl Holonomic for Chain {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let mut end = Vector3::new(T::zero(), T::zero(), T::zero());
        for angle in q {
            let (s, c) = angle.sin_cos();
            end += Vector3::new(s, T::zero(), -c);
            bodies.particle(1.0, end);
        }
    }
}

#[test]
fn reactions_of_eleven_links_do_no_virtual_work() {
    let chain = Lagrangian::of(Chain).with_gravity(9.8);
    let q: Vec<f64> = (0..11).map(|i| 0.25 * f64::from(i)).collect();
    let v: Vec<f64> = (0..11).map(|i| 1.0 - 0.125 * f64::from(i)).collect();
    let reactions = chain.reactions(&q, &v, 0.0).unwrap();
    let forces: Vec<PartForce> = reactions.iter().copied().map(PartForce::from).collect();
    let test = chain.ideal_constraint_test(&forces, &q, 0.0).unwrap();
    let tol = Tol::ulps(64.0).times(condition(&chain, (&q, &v, 0.0)));
    assert_eq!(test.verdict(tol.value()), ConstraintVerdict::Ideal);
    // The last rod can only pull along itself.
    let (s, c) = q[10].sin_cos();
    let pull = reactions[10].force();
    assert_close_at_scale("rod", &[pull.x * c + pull.z * s, pull.y], &[0.0, 0.0], 10.0, tol);
}
