//! Studies beside closed forms, and their mistakes.

use std::ops::ControlFlow;

use piola_scene::run::Outcome;
use piola_scene::studies::room::Outline;
use piola_scene::studies::{self, Findings, StudyPlan, StudyRun};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use crate::support::{PAIR, assert_mistake, assert_small, replaced, study};

const LENS: &str = r#"
[wavefront]
type = "plane"
position = "[-1.5, 0] m"
width = "1.9 m"
length = 3.0
fronts = 1
rays = 41

[[medium]]
type = "luneburg"
radius = "1 m"
"#;

const ROOM: &str = r#"
[room]
type = "ellipse"
semi_axes = "[5, 3] m"
speed = "2 m/s"
grid = 61
"#;

fn run(text: &str) -> StudyRun {
    let run = studies::run(&study(text), |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

fn fronts(run: &StudyRun) -> &studies::wavefront::Fronts {
    match &run.findings {
        Findings::Wavefront(found) => found,
        other => panic!("{other:?}"),
    }
}

fn arrivals(run: &StudyRun) -> &studies::room::Arrivals {
    match &run.findings {
        Findings::Room(found) => found,
        other => panic!("{other:?}"),
    }
}

#[test]
fn luneburgs_lens_brings_a_plane_wave_to_the_far_end_of_its_rim() {
    // n = √(2 − r²): 1/2 to the rim, then ∫ n dx = 1 + π/2 through the middle, and the same along every ray.
    let length = 1.5 + core::f64::consts::FRAC_PI_2;
    let text = replaced(LENS, "length = 3.0", &format!("length = {length:?}"));
    let run = run(&replaced(&text, "1.9 m", "1.6 m"));
    let front = &fronts(&run).fronts[0].pieces[0];
    assert_eq!(front.len(), 41);
    for place in front {
        // ∂n jumps by one on the rim: the step across it, 1/3840 of the way, is of order one.
        let tolerance = Tol::stated(3e-3, "four times the jump of the gradient times the step over the rim");
        assert_close("the focus", place, &[1.0, 0.0], tolerance);
    }
}

#[test]
fn front_of_a_lens_trimmed_to_first_arrival_has_no_ray_beyond_a_caustic() {
    let text = LENS.replace("luneburg", "gaussian").replace("radius = \"1 m\"", "radius = 0.6\namplitude = 0.6");
    let text = replaced(&replaced(&text, "length = 3.0", "length = 6.0"), "1.9 m", "3 m");
    let (all, first) = (run(&text), run(&replaced(&text, "fronts = 1", "fronts = 1\nkeep = \"first\"")));
    let (all, first) = (fronts(&all), fronts(&first));
    assert!(0 < all.fronts[0].beyond_caustic && !all.caustic.is_empty());
    let count = |found: &studies::wavefront::Fronts| found.fronts[0].pieces.iter().map(Vec::len).sum::<usize>();
    assert!(count(first) + all.fronts[0].beyond_caustic <= count(all) + 2);
    // By symmetry the two branches meet on the axis.
    let crossing = first.fronts[0].pieces.iter().flatten().map(|place| place[1].abs()).fold(f64::INFINITY, f64::min);
    assert_small(
        "crossing",
        crossing,
        Tol::stated(1e-9, "tolerance of the rays over the angle at which the branches cross"),
    );
    assert_small("H", all.residual, Tol::stated(1e-10, "tolerance of the rays, a thousand steps"));
}

#[test]
fn first_loss_in_an_ellipse_is_its_smallest_radius_of_curvature() {
    let run = run(ROOM);
    let found = arrivals(&run);
    let Some(loss) = found.first_loss else { panic!("characteristics cross") };
    // b²/a = 9/5 at the speed 2, at a − b²/a from the centre.
    let tolerance = Tol::stated(1e-9, "tolerance of the characteristics, 1e-13, over the flat minimum");
    assert_close("time", &[loss.time], &[0.9], tolerance);
    assert_close("place", &[loss.place[0].abs(), loss.place[1].abs()], &[3.2, 0.0], tolerance);
    assert_eq!(found.closed_form_of_first_loss, Some(0.9));
    assert!(found.uncovered <= 2);
    assert_small("drift", found.drift, Tol::stated(1e-12, "tolerance of the characteristics, 1e-13"));
    assert_small(
        "residual",
        found.residual,
        Tol::stated(1e-3, "the resolution, 1/2000 of the semi-axis, over the speed"),
    );
    assert_small("difference", found.difference, Tol::stated(1e-5, "s; interpolation across 1/2000 of the semi-axis"));
}

#[test]
fn signal_from_a_circle_arrives_after_the_distance_from_it() {
    let run = run(&replaced(ROOM, "grid = 61", "grid = 61\nsignal = \"circle\"\ncentre = [1.0, 0.5]\nradius = 0.8"));
    let mut seen = 0;
    for (place, time) in &arrivals(&run).arrival {
        if let Some(time) = time {
            let distance = ((place[0] - 1.0).hypot(place[1] - 0.5) - 0.8).abs();
            // The resolution is 1/2000 of the shorter semi-axis.
            assert_close_at_scale("time", &[*time], &[0.5 * distance], 1.0, Tol::stated(1e-3, "resolution over speed"));
            seen += 1;
        }
    }
    assert!(1000 < seen && arrivals(&run).uncovered <= 1, "{seen}");
}

#[test]
fn characteristics_from_a_circle_run_to_the_wall_over_a_grid_of_even_spacing() {
    let circle = "grid = 61\nsignal = \"circle\"\ncentre = [1.0, 0.5]\nradius = 0.8";
    let mut told = Vec::new();
    let run = studies::run(&study(&replaced(ROOM, "grid = 61", circle)), |done| {
        assert!(told.last().is_none_or(|before| *before <= done), "{told:?}, {done}");
        told.push(done);
        ControlFlow::Continue(())
    });
    assert!(8 < told.len());
    told.retain(|done| (8.0 * done).fract() <= 0.0 && 0.0 < *done);
    assert_eq!(run.outcome, Outcome::Completed);
    // Four stages outside of the circle, and four inside.
    assert_eq!(told, [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0]);
    let found = arrivals(&run);
    // 10 m and 6 m in spacings of 1/6 m, and a point beyond the wall at each end.
    assert_eq!((found.across, found.arrival.len()), (63, 63 * 39));
    let corners = [found.arrival[0].0, found.arrival[63 * 39 - 1].0].concat();
    let [right, top] = [5.0 + 1.0 / 6.0, 3.0 + 1.0 / 6.0];
    assert_close("corners", &corners, &[-right, -top, right, top], Tol::ulps(4.0));
    let distance = |[x, y]: [f64; 2]| (x - 1.0).hypot(y - 0.5);
    let mut count = 0;
    for curve in found.characteristics.iter().filter(|curve| 0.8 < distance(curve[1])) {
        let [x, y] = curve[curve.len() - 1];
        // They have places every 1.02 (√1.25 + √34)/32 = 0.222 m, and end with the grid.
        assert!(right - 0.222 < x.abs() || top - 0.222 < y.abs(), "{x} {y}");
        count += 1;
    }
    assert!((90..=120).contains(&count), "{count}");
}

#[test]
fn wall_of_a_superellipse_is_its_level_one_in_the_direction_of_its_angle() {
    for exponent in [2, 4, 6] {
        let wall = Outline { centre: [1.0, -2.0], semi_axes: [5.0, 3.0], exponent };
        for step in 0..12 {
            let angle = 0.5 * f64::from(step);
            let place = wall.place(angle);
            assert_close("level", &[wall.level(place)], &[1.0], Tol::ulps(32.0));
            let direction = ((place[1] + 2.0) / 3.0).atan2((place[0] - 1.0) / 5.0);
            assert_small("direction", (direction - angle).sin(), Tol::ulps(16.0));
        }
    }
}

#[test]
fn point_without_a_last_direction_sends_a_full_turn_from_the_first() {
    let text = "[wavefront]\ntype = 'point'\nfrom = '30 deg'\nlength = 3.0\nfronts = 1\n[[medium]]\ntype = 'uniform'\nindex = 1.5\n";
    let run = run(text);
    let front = &fronts(&run).fronts[0].pieces[0];
    let tolerance = Tol::ulps_because(512.0, "960 steps along straight rays");
    for place in [front[0], front[front.len() - 1]] {
        assert_close("place", &place, &[3.0_f64.sqrt(), 1.0], tolerance);
    }
    assert!(front.iter().any(|[x, y]| (x + 3.0_f64.sqrt()).hypot(y + 1.0) < 0.1));
}

#[test]
fn interrupted_study_keeps_what_it_found() {
    let study = study(&replaced(LENS, "fronts = 1", "fronts = 10"));
    let run = studies::run(&study, |done| if done < 0.5 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) });
    assert_eq!(run.outcome, Outcome::Interrupted);
    assert!((4..6).contains(&fronts(&run).fronts.len()));
    let summary = run.summary(&StudyPlan::of(&study));
    assert!(summary.contains("\"status\": \"interrupted\""), "{summary}");
}

#[test]
fn ray_into_an_index_of_zero_fails_and_says_so() {
    let text = LENS.replace("type = \"luneburg\"\nradius = \"1 m\"", "type = \"layers\"\ngradient = 1.0\nheight = 1.0");
    let run = studies::run(&study(&text), |_| ControlFlow::Continue(()));
    // At y = 0 the index is zero: no momentum has the length n there.
    assert!(matches!(run.outcome, Outcome::Failed(_)), "{:?}", run.outcome);
}

#[test]
fn summary_says_how_far_neighbours_on_fronts_are_apart() {
    let study = study(&replaced(LENS, "fronts = 1", "fronts = 1\nspacing = 0.1"));
    let run = studies::run(&study, |_| ControlFlow::Continue(()));
    let found = fronts(&run);
    assert!(0.0 < found.widest && found.widest <= 0.1 && found.too_wide == 0, "{}", found.widest);
    let summary = run.summary(&StudyPlan::of(&study));
    assert!(summary.contains("\"fronts_on_which_it_exceeds_the_spacing\": 0"), "{summary}");
}

#[test]
fn plan_of_a_study_lists_what_is_skipped_and_written() {
    let plan = StudyPlan::of(&study(&format!("{ROOM}[output]\nfigures = false\n")));
    assert_eq!(plan.files, ["summary.json", "arrival.csv", "caustic.csv"]);
    let shown = plan.to_string();
    assert!(shown.contains("reflection") && shown.contains("output.figures = false"), "{shown}");
}

/// All characteristics meet in the middle, which is a point of the grid: its time is known, and the run goes on.
#[test]
fn signal_from_a_circle_about_the_middle_completes() {
    for (grid, radius) in [(41, 0.5), (51, 0.8), (61, 1.0)] {
        let text = replaced(ROOM, "grid = 61", &format!("grid = {grid}\nsignal = \"circle\"\nradius = {radius:?}"));
        let run = run(&text);
        let middle = arrivals(&run).arrival.iter().find(|(place, _)| *place == [0.0, 0.0]);
        let time = middle.and_then(|(_, time)| *time).expect("the time in the middle");
        let tolerance = Tol::stated(2e-3, "interpolation between characteristics, 1/2000 of the shorter semi-axis");
        assert_close("arrival", &[time], &[0.5 * radius], tolerance);
    }
}

#[test]
fn mistakes_of_studies_are_shown_at_their_places() {
    assert_mistake(&format!("{ROOM}[time]\nend = 1.0\n"), "[time]", &["[time] in a scene of [room]", "a study"]);
    assert_mistake(&format!("{ROOM}[output]\nsamples = 10\n"), "10\n", &["`samples` in a scene of [room]"]);
    let text = replaced(ROOM, "type = \"ellipse\"", "type = \"superellipse\"\nexponent = 3");
    assert_mistake(&text, "3\nsemi", &["the exponent 3 is odd", "an even number"]);
    let text = replaced(ROOM, "grid = 61", "signal = \"circle\"\nradius = 4.0");
    assert_mistake(&text, "4.0", &["the circle is not within the room"]);
    let text = replaced(ROOM, "grid = 61", "radius = 4.0");
    assert_mistake(&text, "4.0", &["`radius` with a signal from the wall"]);
    let text = replaced(ROOM, "grid = 61", "speed_gradient = [1.0, 0.0]");
    assert_mistake(&text, "[1.0, 0.0]", &["the speed falls to -3 m/s"]);
    let text = replaced(LENS, "radius = \"1 m\"", "");
    assert_mistake(&text, "[[medium]]", &["lacks `radius`", "Radius of the lens"]);
    let text = replaced(LENS, "width = \"1.9 m\"", "width = \"1.9 s\"");
    assert_mistake(&text, "\"1.9 s\"", &["the dimension time instead of length"]);
    let text = replaced(LENS, "[[medium]]\ntype = \"luneburg\"\nradius = \"1 m\"\n", "");
    assert_mistake(&text, "[wavefront]", &["[wavefront] without a medium"]);
    let text = replaced(LENS, "fronts = 1", "fronts = 1\nspacing = \"1e-6 m\"");
    assert_mistake(&text, "\"1e-6 m\"", &["1e-6 m makes 1.9e6 rays", "at least 4.750e-5 m", "40000 rays"]);
    let text = format!("{PAIR}[[medium]]\ntype = \"uniform\"\n");
    assert_mistake(&text, "[[medium]]", &["[[medium]] in a scene of [gravity]", "[[body]]"]);
}
