//! Bodies about a centre beside Kepler's motion.

use core::ops::ControlFlow;

use piola_gravitation::kepler::KeplerMotion;
use piola_integrators::Order;
use piola_simulation::Outcome;
use piola_simulation::motion::{Central, Method, MotionRun, Orbiter, System, TimeSpan, Timetable, simulate};
use piola_testkit::{Tol, assert_close};

/// Two bodies of 2 and 3 kg about a centre of 1.5 m³/s², 5 m and 3 m from it.
fn pair() -> Central {
    let body = |name: &str, mass, position, velocity| Orbiter { name: name.into(), mass, position, velocity };
    let far = body("far", 2.0, [3.0, 4.0, 0.0], [-0.2, 0.1, 0.3]);
    let near = body("near", 3.0, [-1.0, 2.0, 2.0], [0.5, 0.3, -0.2]);
    Central { gm: 1.5, bodies: vec![far, near] }
}

const SPAN: TimeSpan = TimeSpan { start: 1.0, end: 4.0 };

fn complete(method: Method) -> MotionRun {
    let timetable = Timetable::new(SPAN, 7, &[]);
    let run = simulate(&System::Central(pair()), method, &timetable, &mut |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

#[test]
fn bodies_about_a_centre_follow_keplers_motion_and_keep_their_invariants() {
    let tolerance = Tol::stated(1e-9, "1e-12 of each adaptive step, and h⁸ of fixed steps of 1/100 s over a few turns");
    let methods = [
        Method::DormandPrince { tolerance: 1e-12 },
        Method::Composition { order: Order::Eight, step: 0.01 },
        Method::GaussLegendre { order: Order::Eight, step: 0.01 },
    ];
    for method in methods {
        let run = complete(method);
        assert_eq!(run.history.times, [1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
        for (number, body) in pair().bodies.iter().enumerate() {
            let Ok(motion) = KeplerMotion::new(1.5, body.position, body.velocity) else { panic!("a bound orbit") };
            for (time, places) in run.history.times.iter().zip(&run.history.positions) {
                assert_close(&body.name, &places[number], &motion.position(time - SPAN.start), tolerance);
            }
        }
        let drifts = run.history.drifts();
        let drifts = [drifts.energy, drifts.angular_momentum].map(|drift| drift.map(|drift| drift.max_relative));
        assert!(drifts.iter().all(|drift| drift.is_some_and(|drift| drift < 1e-9)), "{method}: {drifts:?}");
    }
}

#[test]
fn energy_and_angular_momentum_of_orbiters_are_sums_over_bodies() {
    let run = complete(Method::DormandPrince { tolerance: 1e-12 });
    let first = run.history.invariants[0];
    // ½ m v² − m Gm/r: v² is 0.14 and 0.38 m²/s².
    let energy = 2.0 * (0.5 * 0.14 - 1.5 / 5.0) + 3.0 * (0.5 * 0.38 - 1.5 / 3.0);
    assert_close("energy", &[first.energy], &[energy], Tol::ulps(8.0));
    // r × v is (1.2, −0.9, 1.1) and (−1, 0.8, −1.3) m²/s.
    let moment = [2.0 * 1.2 - 3.0 * 1.0, -2.0 * 0.9 + 3.0 * 0.8, 2.0 * 1.1 - 3.0 * 1.3];
    let sizes = 2.0 * (1.44_f64 + 0.81 + 1.21).sqrt() + 3.0 * (1.0_f64 + 0.64 + 1.69).sqrt();
    let Some((found, scale)) = first.angular_momentum else { panic!("it is conserved") };
    assert_close("angular momentum", &found, &moment, Tol::ulps(8.0));
    assert_close("its scale", &[scale], &[sizes], Tol::ulps(8.0));
    assert_eq!(first.momentum, None);
}

#[test]
fn observer_is_told_the_share_of_the_span_that_is_done() {
    for span in [SPAN, TimeSpan { start: 4.0, end: 1.0 }] {
        let mut seen = Vec::new();
        let method = Method::Composition { order: Order::Four, step: 0.1 };
        let run = simulate(&System::Central(pair()), method, &Timetable::new(span, 2, &[]), &mut |progress| {
            assert_close("share", &[progress.fraction], &[(progress.time - span.start).abs() / 3.0], Tol::ulps(2.0));
            seen.push((progress.steps, progress.fraction));
            ControlFlow::Continue(())
        });
        assert_eq!((seen.len(), seen.last()), (30, Some(&(run.steps, 1.0))));
    }
}

#[test]
fn a_closed_form_gives_keplers_motion_itself_and_refuses_what_is_no_ellipse() {
    let run = complete(Method::ClosedForm);
    assert_eq!((run.steps, run.force_evaluations), (6, 0));
    for (number, body) in pair().bodies.iter().enumerate() {
        let Ok(motion) = KeplerMotion::new(1.5, body.position, body.velocity) else { panic!("a bound orbit") };
        for (t, places) in run.history.times.iter().zip(&run.history.positions).skip(1) {
            assert_eq!(places[number].map(f64::to_bits), motion.position(t - SPAN.start).map(f64::to_bits));
        }
    }
    let drift = run.history.drifts().energy.map_or(f64::NAN, |drift| drift.max_relative);
    assert_close("energy", &[drift], &[0.0], Tol::ulps(16.0));
    let mut fast = pair();
    fast.bodies[1].velocity = [5.0, 0.0, 0.0];
    let timetable = Timetable::new(SPAN, 7, &[]);
    let run = simulate(&System::Central(fast), Method::ClosedForm, &timetable, &mut |_| ControlFlow::Continue(()));
    let Outcome::Failed(why) = run.outcome else { panic!("{:?}", run.outcome) };
    assert!(why.contains("the closed form of near") && why.contains("not an ellipse"), "{why}");
    // Beyond 2⁵³ turns the closed form would give finite nonsense.
    let timetable = Timetable::new(TimeSpan { start: 0.0, end: 1e30 }, 7, &[]);
    let run = simulate(&System::Central(pair()), Method::ClosedForm, &timetable, &mut |_| ControlFlow::Continue(()));
    let Outcome::Failed(why) = run.outcome else { panic!("{:?}", run.outcome) };
    assert!(why.ends_with("turns; at most 1e12 are valid"), "{why}");
}
