//! Scenes as the planner runs them and as one general method runs all: time at equal error.
//!
//! The general method is Dormand's and Prince's adaptive pair, which takes every system. It runs each scene at thirteen tolerances. Its
//! time at the error of the planned run is read off that curve, by straight lines of the logarithms.
//!
//! The error is the largest difference of a record from that of Verner's pair at the least tolerance, relative to the largest number;
//! where the planner has a closed form, that is the reference. Below three times the difference of the two general methods at the least
//! tolerance errors are not told apart: there the general method need not come nearer. The runs take turns in one process, and the
//! least time of each counts, of longer ones the mean time of the processor.
//!
//! ```sh
//! taskset -c 1 cargo run --release -p piola-scene --example skip
//! ```
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::ops::ControlFlow;

use piola_scene::plan::Method;
use piola_scene::run::{self, Outcome, Run};
use piola_scene::{Document, Plan, Scene};

/// Scenes without `[integrator]`, each with its name.
const SCENES: [(&str, &str); 12] = [
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
    ("a slow and a fast double pendulum, 5 s", ISLANDS),
    ("a pendulum of twelve parts, with twelve on the ground, 20 s", PARTS),
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

const ISLANDS: &str = "
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
[[joint]]
name = 'c'
type = 'revolute'
axis = [0, 1, 0]
offset = [3, 0, 0]
angle = 1.0
[[joint]]
name = 'd'
parent = 'c'
type = 'revolute'
axis = [0, 1, 0]
offset = [0, 0, -0.01]
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
[[particle]]
name = 'r'
joint = 'c'
mass = 1
at = [0, 0, -0.01]
[[particle]]
name = 's'
joint = 'd'
mass = 1
at = [0, 0, -0.01]
[time]
end = 5";

/// Twelve bodies on a pendulum and twelve on the ground, on fixed joints of their own; filled in by [`parts`].
const PARTS: &str = "
[mechanism]
[[joint]]
name = 'pin'
type = 'revolute'
axis = [0, 1, 0]
angle = 1.0
[time]
end = 20
";

fn parts() -> String {
    let part = |i: u32| {
        let parent = if i < 12 { "pin" } else { "ground" };
        let place = format!("[0, {:.1}, {:.1}]", 0.1 * f64::from(i % 3), -0.1 * f64::from(1 + i % 12));
        format!(
            "[[joint]]\nname = 'j{i}'\nparent = '{parent}'\ntype = 'fixed'\noffset = {place}\n\
             [[rigid_body]]\nname = 'b{i}'\njoint = 'j{i}'\nmass = 1\ninertia = [0.1, 0.1, 0.1]\n"
        )
    };
    PARTS.to_string() + &(0..24).map(part).collect::<Vec<_>>().concat()
}

const OUTPUT: &str = "\n[output]\nsamples = 201\n";

/// Runs of each: the least time counts.
const ROUNDS: usize = 7;

/// What is asked of the planner: nothing, or a tolerance.
const ASKED: [Option<f64>; 3] = [None, Some(1e-10), Some(1e-6)];

/// Tolerances of the general method.
const TOLERANCES: [f64; 13] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, LEAST];
const LEAST: f64 = 4.5e-16;

const HEAD: &str = "\
| scene | tolerance asked | planned method | error | evaluations: general, planned | ms: general, planned | times faster |
|---|---|---|---|---|---|---|";

fn scene(text: &str, integrator: &str) -> Scene {
    let text = format!("{text}\n[integrator]\n{integrator}{OUTPUT}");
    Scene::from_document(&Document::parse("skip.toml", &text)).unwrap_or_else(|error| panic!("{error}"))
}

/// A scene with its plan and a run.
struct Candidate {
    scene: Scene,
    plan: Plan,
    best: Run,
    /// Runs and their processor time, s.
    rounds: f64,
    processor: f64,
}

impl Candidate {
    fn of(text: &str, integrator: &str) -> Self {
        let scene = scene(text, integrator);
        let plan = Plan::of(&scene);
        let best = once(&scene, &plan);
        Self { scene, plan, best, rounds: 0.0, processor: 0.0 }
    }

    fn again(&mut self) {
        let before = processor_time();
        let again = once(&self.scene, &self.plan);
        self.processor += before.zip(processor_time()).map_or(f64::NAN, |(before, after)| after - before);
        self.rounds += 1.0;
        if again.wall_time < self.best.wall_time {
            self.best = again;
        }
    }

    /// ms of a run: the least on a clock of short runs, which other programs seldom interrupt; of longer ones the mean time of the
    /// processor, which is counted in steps of some milliseconds.
    fn time(&self) -> f64 {
        const SHORT: f64 = 3e-3;
        let mean = self.processor / self.rounds;
        1e3 * if SHORT < self.best.wall_time && 0.0 < mean {
            self.best.wall_time.min(mean)
        } else {
            self.best.wall_time
        }
    }
}

/// Processor time of this thread so far, s, on Linux.
fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * text.split(' ').next()?.parse::<f64>().ok()?)
}

fn once(scene: &Scene, plan: &Plan) -> Run {
    let run = run::run(scene, plan, |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed, "{}", plan.system);
    run
}

/// The largest difference of two records, of positions or of coordinates, over their largest size.
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

/// Time (ms) and evaluations of the general method where it first has this error; its least error where it does not reach it.
fn at_error(curve: &[(f64, f64, f64)], error: f64) -> Result<(f64, f64), (f64, f64, f64)> {
    let mut before: Option<(f64, f64, f64)> = None;
    for &(found, time, count) in curve {
        if found <= error {
            let Some((first, first_time, first_count)) = before else { return Ok((time, count)) };
            let part = (first / error).ln() / (first / found).ln();
            return Ok((first_time * (time / first_time).powf(part), first_count * (count / first_count).powf(part)));
        }
        before = Some((found, time, count));
    }
    let least = curve.iter().copied().min_by(|a, b| a.0.total_cmp(&b.0));
    Err(least.unwrap_or((f64::NAN, f64::NAN, f64::NAN)))
}

fn main() {
    println!("{HEAD}");
    for (name, text) in SCENES {
        let text = if text == PARTS { parts() } else { text.to_string() };
        let general =
            |tolerance: f64| format!("method = 'dormand-prince-853'\nsimplify = false\ntolerance = {tolerance:e}\n");
        let mut theirs: Vec<Candidate> = TOLERANCES.iter().map(|t| Candidate::of(&text, &general(*t))).collect();
        let asked = |tolerance: &Option<f64>| tolerance.map_or_else(String::new, |t| format!("tolerance = {t:e}\n"));
        let mut ours: Vec<Candidate> = ASKED.iter().map(|tolerance| Candidate::of(&text, &asked(tolerance))).collect();
        for _ in 1..ROUNDS {
            ours.iter_mut().chain(&mut theirs).for_each(Candidate::again);
        }
        let closed = ours[0].plan.method == Method::ClosedForm;
        let verner = Candidate::of(&text, &format!("method = 'verner-98'\nsimplify = false\ntolerance = {LEAST:e}\n"));
        let reference = if closed { &ours[0].best } else { &verner.best };
        let floor = if closed { 0.0 } else { 3.0 * difference(reference, &theirs[TOLERANCES.len() - 1].best) };
        let curve: Vec<(f64, f64, f64)> = theirs
            .iter()
            .map(|one| (difference(reference, &one.best), one.time(), one.best.force_evaluations as f64))
            .collect();
        for (tolerance, one) in ASKED.iter().zip(&ours) {
            let error = difference(reference, &one.best);
            let (time, count) = (one.time(), one.best.force_evaluations);
            let tolerance = tolerance.map_or_else(|| "none".to_string(), |t| format!("{t:.0e}"));
            let (shown, (general, evaluations)) = match at_error(&curve, error.max(floor)) {
                Ok(found) => (if error < floor { format!("< {floor:.0e}") } else { format!("{error:.0e}") }, found),
                Err((least, time, count)) => (format!("not measured; general {least:.0e}"), (time, count)),
            };
            println!(
                "| {name} | {tolerance} | {} | {shown} | {evaluations:.0}, {count} | {general:.2}, {time:.2} | {:.1} |",
                one.plan.method,
                general / time,
            );
        }
    }
}
