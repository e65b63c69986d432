//! Ten scenes as the planner runs them and as one general method runs all: time, evaluations of the forces, agreement.
//!
//! The general method is Dormand's and Prince's adaptive pair, which takes every system. Its tolerance is that of the planned method;
//! where that has none, the least one, 4.5e-16. The accuracy of the two is not matched: see the columns of the energy drift and of the
//! difference. The two take turns in one process, and the least time of seven runs of each counts.
//!
//! ```sh
//! taskset -c 0 cargo run --release -p piola-scene --example skip
//! ```
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::ops::ControlFlow;

use piola_scene::plan::Method;
use piola_scene::run::{self, Outcome, Run};
use piola_scene::{Document, Plan, Scene};

/// Scenes without `[integrator]`, each with its name.
const SCENES: [(&str, &str); 10] = [
    ("a comet, e = 0.99, 100 turns", COMET),
    ("a satellite on a circle, 1000 turns", SATELLITE),
    ("three bodies about a centre, 1000 s", CENTRE),
    ("a double star, e = 0.8, 100 turns", DOUBLE_STAR),
    ("a sun with two planets, 100 turns", PLANETS),
    ("stars in a galaxy, 1000 s", STARS),
    ("a pendulum by its Hamiltonian, 1000 s", PENDULUM),
    ("a double pendulum, 5 s", DOUBLE_PENDULUM),
    ("a heavy top, 5 s", TOP),
    ("a cart on a spring with a bob, 20 s", CART),
];

const COMET: &str = "
[central]
gm = 1
[[body]]
name = 'comet'
semi_major_axis = 1
eccentricity = 0.99
[time]
revolutions = 100";

const SATELLITE: &str = "
[central]
gm = 1
[[body]]
name = 'satellite'
semi_major_axis = 1
eccentricity = 0
[time]
revolutions = 1000";

const CENTRE: &str = "
[central]
gm = 1
[[body]]
name = 'a'
semi_major_axis = 1
eccentricity = 0.8
[[body]]
name = 'b'
semi_major_axis = 9
eccentricity = 0.1
[[body]]
name = 'c'
semi_major_axis = 30
eccentricity = 0.3
[time]
end = 1000";

const DOUBLE_STAR: &str = "
[gravity]
[[body]]
name = 'a'
gm = 0.5
position = [0.1, 0, 0]
velocity = [0, 1.5, 0]
[[body]]
name = 'b'
gm = 0.5
position = [-0.1, 0, 0]
velocity = [0, -1.5, 0]
[time]
end = 628";

const PLANETS: &str = "
[gravity]
[[body]]
name = 'sun'
gm = 1
position = [0, 0, 0]
velocity = [0, 0, 0]
[[body]]
name = 'inner'
gm = 1e-5
position = [1, 0, 0]
velocity = [0, 1, 0]
[[body]]
name = 'outer'
gm = 1e-4
position = [0, 3, 0]
velocity = [-0.577, 0, 0.1]
[time]
end = 628";

const STARS: &str = "
[hamiltonian]
energy = '(px^2 + py^2 + x^2 + y^2)/2 + x^2*y - y^3/3'
[[coordinate]]
name = 'x'
momentum = 'px'
momentum_at_start = 0.3
[[coordinate]]
name = 'y'
momentum = 'py'
start = 0.1
[time]
end = 1000";

const PENDULUM: &str = "
[hamiltonian]
energy = 'p^2/2 - cos(q)'
[[coordinate]]
name = 'q'
momentum = 'p'
start = 1.0
[time]
end = 1000";

const DOUBLE_PENDULUM: &str = "
[mechanism]
[[joint]]
name = 'a'
type = 'revolute'
axis = [0, 1, 0]
angle = 1.0
[[joint]]
name = 'b'
parent = 'a'
type = 'revolute'
axis = [0, 1, 0]
offset = [0, 0, -1]
angle = 0.5
[[particle]]
name = 'p'
joint = 'a'
mass = 1
at = [0, 0, -1]
[[particle]]
name = 'q'
joint = 'b'
mass = 1
at = [0, 0, -1]
[time]
end = 5";

const TOP: &str = "
[mechanism]
[[joint]]
name = 'tip'
type = 'spherical'
angles = [0, 0.5, 0]
rates = [0, 0, 60]
[[rigid_body]]
name = 'top'
joint = 'tip'
mass = 1
inertia = [0.75, 0.75, 0.25]
at = [0, 0, 0.5]
[time]
end = 5";

const CART: &str = "
[mechanism]
[[joint]]
name = 'rail'
type = 'prismatic'
axis = [1, 0, 0]
displacement = 0.5
[[joint]]
name = 'pin'
parent = 'rail'
type = 'revolute'
axis = [0, 1, 0]
[[particle]]
name = 'cart'
joint = 'rail'
mass = 2
[[particle]]
name = 'bob'
joint = 'pin'
mass = 1
at = [0, 0, -1]
[[force]]
name = 'spring'
type = 'joint-spring'
coordinate = 'rail'
stiffness = 8
[time]
end = 20";

/// The general method with the tolerance of the planned one, which aims at rounding where it has fixed steps or none.
fn general(planned: &Plan) -> String {
    let tolerance = match planned.method {
        Method::DormandPrince { tolerance }
        | Method::Verner { tolerance }
        | Method::Nystrom86 { tolerance }
        | Method::Nystrom1210 { tolerance } => tolerance,
        _ => 4.5e-16,
    };
    format!("\n[integrator]\nmethod = 'dormand-prince-853'\ntolerance = {tolerance:e}\n")
}

const OUTPUT: &str = "\n[output]\nsamples = 201\n";

/// Runs of each: the least time counts.
const ROUNDS: usize = 7;

const HEAD: &str = "\
| scene | planned method | evaluations: general, planned | ms: general, planned | times faster \
| energy drift: general, planned | difference |
|---|---|---|---|---|---|---|";

fn scene(text: &str) -> Scene {
    Scene::from_document(&Document::parse("skip.toml", text)).unwrap_or_else(|error| panic!("{error}"))
}

fn once(scene: &Scene, plan: &Plan) -> Run {
    let run = run::run(scene, plan, |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed, "{}", plan.system);
    run
}

/// The largest difference of the two records, of positions or of coordinates, over their largest size.
fn difference(a: &Run, b: &Run) -> f64 {
    let flat = |run: &Run| -> Vec<f64> {
        if run.history.names.is_empty() {
            run.history.coordinates.iter().flatten().copied().collect()
        } else {
            run.history.positions.iter().flatten().flatten().copied().collect()
        }
    };
    let (a, b) = (flat(a), flat(b));
    let size = a.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
}

fn drift(run: &Run) -> f64 {
    run.drifts.energy.map_or(f64::NAN, |drift| drift.max_relative)
}

fn main() {
    println!("{HEAD}");
    for (name, text) in SCENES {
        let planned = scene(&format!("{text}{OUTPUT}"));
        let general = scene(&format!("{text}{}{OUTPUT}", general(&Plan::of(&planned))));
        let plans = [Plan::of(&planned), Plan::of(&general)];
        let (mut ours, mut theirs) = (once(&planned, &plans[0]), once(&general, &plans[1]));
        for _ in 1..ROUNDS {
            for (best, (scene, plan)) in [(&mut ours, (&planned, &plans[0])), (&mut theirs, (&general, &plans[1]))] {
                let again = once(scene, plan);
                if again.wall_time < best.wall_time {
                    *best = again;
                }
            }
        }
        println!(
            "| {name} | {} | {}, {} | {:.2}, {:.2} | {:.1} | {:.0e}, {:.0e} | {:.0e} |",
            plans[0].method,
            theirs.force_evaluations,
            ours.force_evaluations,
            1e3 * theirs.wall_time,
            1e3 * ours.wall_time,
            theirs.wall_time / ours.wall_time,
            drift(&theirs),
            drift(&ours),
            difference(&ours, &theirs),
        );
    }
}
