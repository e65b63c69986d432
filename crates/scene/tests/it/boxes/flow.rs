//! Creeping flows beside closed forms.

use core::f64::consts::PI;
use std::ops::ControlFlow;

use piola_scene::run::Outcome;
use piola_scene::studies;
use piola_testkit::{Tol, assert_close};

use super::{flow_of, in_box, in_rectangle, run};
use crate::support::{replaced, study};

/// λ + 2μ = 2: the velocity along x is sin(πx).
fn pushed() -> String {
    format!(
        "[box]\ntype = 'flow'\nsides = [1.0, 1.0]\npoints = [32, 4]\nshear_viscosity = 1.0\nduration = 0.3\n\
         [[load]]\ntype = 'mode'\nindices = [1, 0]\nforce_per_volume = [{:?}, 0.0]\n\
         [[probe]]\nname = 'a'\nat = [0.7, 0.5]\n[[probe]]\nname = 'wall'\nat = [1.0, 1.0]\n",
        2.0 * PI * PI
    )
}

#[test]
fn particles_of_a_push_came_from_where_the_closed_form_says() {
    let run = run(&pushed());
    let found = flow_of(in_rectangle(&run));
    // dx/dt = sin(πx): tan(πx/2) grows as exp(πt).
    let at_first = 2.0 / PI * ((0.5 * PI * 0.7).tan() * (-0.3 * PI).exp()).atan();
    let tolerance = Tol::stated(2e-5, "cubic interpolation and steps of order four over 32 spacings");
    assert_close("x", &found.probes[0].1, &[at_first, 0.5], tolerance);
    assert_close("the corner", &found.probes[1].1, &[1.0, 1.0], Tol::ulps(8.0));
    let Some(last) = found.instants.last() else { panic!("no steps") };
    assert_close("time", &[last.time], &[0.3], Tol::ulps(1.0));
    // ∂x₀/∂x at the far wall is exp(πt): at the near wall exp(−πt) is the least one.
    let least = (-0.3 * PI).exp();
    assert!(least < last.certified_jacobian * 1.1 && 0.3 < last.certified_jacobian, "{last:?}");
}

#[test]
fn map_of_a_long_flow_is_put_away_again_and_again_and_stays_invertible() {
    let text = r#"
[box]
type = "flow"
sides = "[100, 100] mm"
points = [24, 24]
shear_viscosity = "10 Pa s"
duration = "12 s"
least_jacobian = 0.7
[[load]]
type = "mode"
indices = [1, 1]
force_per_volume = "[-200, 200] N/m^3"
[[load]]
type = "mode"
indices = [1, 1]
force_per_volume = "[80, 80] N/m^3"
"#;
    let run = run(text);
    let found = flow_of(in_rectangle(&run));
    let Some(last) = found.instants.last() else { panic!("no steps") };
    assert!(2 <= last.regriddings, "{last:?}");
    assert!(0.0 < last.certified_jacobian);
    for at in &found.instants {
        assert!(0.7 < at.least_jacobian && at.courant_number <= 0.5, "{at:?}");
    }
    // Bounds do not grow, and the displacement is put away at most once in a step.
    for pair in found.instants.windows(2).filter(|pair| pair[0].regriddings < pair[1].regriddings) {
        assert!(pair[1].certified_jacobian < pair[0].certified_jacobian);
        assert_eq!(pair[1].regriddings, pair[0].regriddings + 1);
    }
    for (_, at_first) in &found.particles {
        assert!(at_first.iter().all(|x| (0.0..=0.1 + 1e-15).contains(x)), "{at_first:?}");
    }
}

#[test]
fn flow_in_a_box_has_the_velocity_of_its_rectangle() {
    let plane = run(&pushed());
    let text = pushed().replace("[1.0, 1.0]", "[1.0, 1.0, 1.0]").replace("[32, 4]", "[32, 4, 4]");
    let text = text
        .replace("[1, 0]", "[1, 0, 0]")
        .replace(", 0.0]\n", ", 0.0, 0.0]\n")
        .replace("[0.7, 0.5]", "[0.7, 0.5, 0.5]");
    let box_ = run(&text);
    let (plane, found) = (flow_of(in_rectangle(&plane)), flow_of(in_box(&box_)));
    let [x, y] = plane.probes[0].1;
    assert_close("x", &found.probes[0].1, &[x, y, 0.5], Tol::ulps(256.0));
    assert_eq!(plane.instants.len(), found.instants.len());
}

#[test]
fn step_that_would_fold_the_map_is_halved_until_it_does_not() {
    // The velocity sin(31 πx) changes its sign from cell to cell: of 2.56 steps that cross half a spacing three are made, and
    // ∂u/∂x = 31 π · 0.04/3 folds.
    let text = replaced(&replaced(&pushed(), "[1, 0]", "[31, 0]"), "duration = 0.3", "duration = 0.04");
    let force = format!("{:?}", 2.0 * PI * PI);
    let run = run(&replaced(&text, &force, &format!("{:?}", 2.0 * PI * PI * 961.0)));
    let found = flow_of(in_rectangle(&run));
    let mut before = 0.0;
    for at in &found.instants {
        assert!(at.time - before < 0.04 / 6.0 * (1.0 + 1e-9) && 0.0 < at.least_jacobian, "{at:?}");
        before = at.time;
    }
    assert_close("end", &[before], &[0.04], Tol::ulps(1.0));
}

#[test]
fn step_that_is_not_stable_is_refused_with_one_that_is() {
    let run = studies::run(&study(&replaced(&pushed(), "duration = 0.3", "duration = 0.3\nstep = 0.1")), |_| {
        ControlFlow::Continue(())
    });
    let Outcome::Failed(why) = &run.outcome else { panic!("{:?}", run.outcome) };
    assert!(why.contains("0.8 are stable") && why.contains("`step` of at most 2.5"), "{why}");
    // The velocity was found.
    assert_eq!(flow_of(in_rectangle(&run)).velocity[0].len(), 128);
}

#[test]
fn interrupted_flow_keeps_its_map_until_then() {
    let run =
        studies::run(
            &study(&pushed()),
            |done| {
                if done < 0.5 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            },
        );
    assert_eq!(run.outcome, Outcome::Interrupted);
    let found = flow_of(in_rectangle(&run));
    let Some(last) = found.instants.last() else { panic!("no steps") };
    let at_first = 2.0 / PI * ((0.5 * PI * 0.7).tan() * (-last.time * PI).exp()).atan();
    assert!((0.14..0.2).contains(&last.time));
    assert_close("x", &[found.probes[0].1[0]], &[at_first], Tol::stated(2e-5, "as of the whole flow"));
}
