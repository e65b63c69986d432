//! Evaluations and steps allocate nothing once their buffers have grown.

use core::ops::ControlFlow;

use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_lagrangian::constraints::{Rattle, Workspace};
use piola_testkit::allocations_in;

use crate::bricard::{bricard, state};
use crate::systems::{System, Ties, mechanism};

#[test]
fn evaluations_and_projections_allocate_nothing() {
    let loops = bricard();
    let (q, v) = state(0.9, 1.0);
    let mut work = Workspace::default();
    let (mut six, mut multipliers) = ([0.0; 6], [0.0; 6]);
    let mut evaluate = || {
        loops.acceleration_into(&mut work, &q, &v, 0.0, &mut six).unwrap();
        loops.solve_into(&mut work, &q, &v, 0.0, &mut six, &mut multipliers).unwrap();
        loops.reactions_into(&mut work, &q, &v, 0.0, &mut six).unwrap();
    };
    evaluate();
    assert_eq!(allocations_in(evaluate).0, 0);

    let start: Vec<f64> = q.iter().chain(&v).copied().collect();
    let mut state = State::new(0.0, start).unwrap();
    let mut method = DormandPrince853::new(Tolerance::relative(1e-10).unwrap());
    let mut motion = loops.motion(6);
    method.integrate_to(&mut motion, &mut state, 0.5).unwrap();
    let (few, _) = allocations_in(|| method.integrate_to(&mut motion, &mut state, 1.0).unwrap());
    let (many, report) = allocations_in(|| method.integrate_to(&mut motion, &mut state, 3.0).unwrap());
    assert!(10 < report.steps && many <= few, "{few} then {many} allocations in {} steps", report.steps);
}

#[test]
fn steps_of_rattle_allocate_nothing() {
    let loops = mechanism(System::Bricard { sixth: true }, [0.0, 0.0, -1.0], 0.0).with_constraints(Ties::Bricard);
    let (q, v) = state(0.9, 1.0);
    let mut y = loops.canonical_state(&q, &v, 0.0).unwrap();
    let mut rattle = Rattle::new(0.01).unwrap();
    rattle.integrate_to(&loops, &mut y, 0.1).unwrap();
    let mut run =
        |end: f64| allocations_in(|| rattle.integrate(&loops, &mut y, end, |_| ControlFlow::Continue(())).unwrap());
    let (few, _) = run(0.2);
    let (many, report) = run(1.2);
    assert_eq!((many, report.steps), (few, 100));
}
