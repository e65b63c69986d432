//! Bodies that roll on planes, beside closed motions.

use core::f64::consts::FRAC_PI_2;

use piola_scene::Plan;
use piola_scene::run::{self, Outcome, Run};
use piola_testkit::{Tol, assert_close};

use crate::support::{assert_mistake, replaced, scene};

/// A homogeneous sphere of 2 kg and 0.5 m on an incline of 0.3 rad, in whose axes the scene is written.
const SPHERE: &str = "
[mechanism]
gravity = [2.9552020666133956, 0, -9.553364891256061]
[[joint]]
name = 'ball'
type = 'free'
shift = [1, 2, 0.5]
angles = [0, 1.5707963267948966, 0]
rates = [0, 0.4, 0]
[[rigid_body]]
name = 'sphere'
joint = 'ball'
mass = 2
inertia = [0.2, 0.2, 0.2]
[[constraint]]
name = 'contact'
type = 'rolling'
body = 'sphere'
radius = 0.5
[time]
end = 3.0
[output]
samples = 5
reactions = true
";

fn complete(text: &str) -> (Plan, Run) {
    let scene = scene(text);
    let plan = Plan::of(&scene);
    let run = run::run(&scene, &plan, |_| core::ops::ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    (plan, run)
}

#[test]
fn a_sphere_rolls_down_an_incline_with_five_sevenths_of_the_pull() {
    let (plan, run) = complete(SPHERE);
    assert!(plan.skipped.iter().any(|item| item.what == "multipliers"), "{plan}");
    let pull = 2.955_202_066_613_395_6;
    for (t, state) in run.history.times.iter().zip(&run.history.coordinates) {
        // ω = 0.4 rad/s about y moves it along x by R ω.
        let (a, speed) = (5.0 / 7.0 * pull, 0.2);
        let x = speed * t + 0.5 * a * t * t;
        let expected = [
            1.0 + x,
            2.0,
            0.5,
            0.0,
            FRAC_PI_2 + x / 0.5,
            0.0,
            speed + a * t,
            0.0,
            0.0,
            0.0,
            (speed + a * t) / 0.5,
            0.0,
        ];
        assert_close("state", state, &expected, Tol::stated(1e-12, "the tolerance 1e-13 over some ten steps"));
    }
    assert_eq!(run.history.condition_names[0], "force of contact along x (N)");
    for forces in &run.history.conditions {
        // Friction takes 2/7 of the pull, the plane the weight.
        let expected = [-2.0 / 7.0 * 2.0 * pull, 0.0, 2.0 * 9.553_364_891_256_061];
        assert_close("forces", forces, &expected, Tol::stated(1e-12, "of sums of size twenty"));
    }
    let drift = run.drifts.energy.map_or(f64::NAN, |drift| drift.max_relative);
    assert_close("drift", &[drift], &[0.0], Tol::stated(1e-13, "rounding of some ten steps"));
}

#[test]
fn a_disc_that_spins_fast_enough_rolls_evenly_on_a_circle() {
    // M = 2 kg, R = 0.5 m, A = M R²/4, C = M R²/2, θ = 1 rad, Ω = 3 rad/s, g = 10 m/s²:
    // (C + M R²) Ω sin θ (ψ̇ + Ω cos θ) = A Ω² sin θ cos θ − M g R cos θ, W p. 41 ff.
    let (m, r, g, omega, theta) = (2.0_f64, 0.5_f64, 10.0_f64, 3.0_f64, 1.0_f64);
    let (across, along) = (m * r * r / 4.0, m * r * r / 2.0);
    let (sine, cosine) = theta.sin_cos();
    let right = across * omega * omega * sine * cosine - m * g * r * cosine;
    let spin = right / ((along + m * r * r) * omega * sine) - omega * cosine;
    let text = format!(
        "[mechanism]\ngravity = [0, 0, -{g}]\n[[joint]]\nname = 'free'\ntype = 'free'\nshift = [0, 0, {}]\n\
         angles = [0, {theta}, 0]\nrates = [{omega}, 0, {spin:e}]\n[[rigid_body]]\nname = 'disc'\njoint = 'free'\nmass = {m}\n\
         inertia = [{across}, {across}, {along}]\n[[constraint]]\nname = 'edge'\ntype = 'rolling'\nbody = 'disc'\nradius = {r}\n\
         axis = [0, 0, 3]\n[time]\nend = 2\n[output]\nsamples = 9\n",
        r * sine
    );
    let (_, run) = complete(&text);
    // The centre is R cos θ inside the circle of the contact, whose radius is R |ψ̇/Ω|: it goes round with the speed Ω ρ.
    let first = &run.history.coordinates[0];
    let [vx, vy] = [first[6], first[7]];
    for (t, state) in run.history.times.iter().zip(&run.history.coordinates) {
        let (s, c) = (omega * t).sin_cos();
        // The velocity turns with Ω.
        let velocity = [c * vx - s * vy, s * vx + c * vy];
        let place = [(s * vx - (1.0 - c) * vy) / omega, ((1.0 - c) * vx + s * vy) / omega, r * sine];
        let tolerance =
            Tol::stated(1e-10, "the tolerance 1e-13 over some hundred steps, of a motion that is not stable");
        assert_close("places", &state[..3], &place, tolerance);
        assert_close("velocities", &state[6..8], &velocity, tolerance);
        assert_close("angles", &state[3..6], &[omega * t, theta, spin * t], tolerance);
    }
    // v = ω×r at the start: |v| = |R (ψ̇ + Ω cos θ)| less what the contact adds.
    let speed = vx.hypot(vy);
    assert_close("speed", &[speed], &[(r * (spin + omega * cosine)).abs()], Tol::ulps(32.0));
}

#[test]
fn what_cannot_roll_is_refused_at_its_place() {
    let still = replaced(SPHERE, "body = 'sphere'", "body = 'ground'");
    assert_mistake(&still, "'ground'", &["nothing moves the body"]);
    let flat = replaced(SPHERE, "radius = 0.5", "radius = 0.5\nnormal = [0, 0, 0]");
    assert_mistake(&flat, "[0, 0, 0]\n[time]", &["`normal` is zero"]);
    let fixed = format!("{SPHERE}[integrator]\nmethod = 'gauss-legendre-8'\n");
    assert_mistake(&fixed, "'gauss-legendre-8'", &["a fixed step with constraints"]);
}

#[test]
fn a_rate_at_the_start_that_rolling_contradicts_is_refused_at_its_key() {
    let slides = replaced(SPHERE, "rates = [0, 0.4, 0]", "velocity = [1, 0, 0]");
    assert_mistake(&slides, "[1, 0, 0]", &["`ball.shift[0]` is 1", "rolling without slip makes it 0"]);
    let wrong = replaced(SPHERE, "rates = [0, 0.4, 0]", "rates = [0, 0.4, 0]\nvelocity = [0.3, 0, 0]");
    assert_mistake(&wrong, "[0.3, 0, 0]", &["`ball.shift[0]` is 0.3"]);
    // ω = 0.4 rad/s about y: R ω = 0.2 m/s along x.
    let right = replaced(SPHERE, "rates = [0, 0.4, 0]", "rates = [0, 0.4, 0]\nvelocity = [0.2, 0, 0]");
    let (with, without) = (complete(&right).1, complete(SPHERE).1);
    assert_eq!(with.history.coordinates, without.history.coordinates);
}

/// A disc of radius 1 m whose centre slides along x and y, and turns there by a joint.
fn disc_on_two_slides(joint: &str, axis: &str) -> String {
    format!(
        "
[mechanism]
gravity = [0, 0, -9.81]
[[joint]]
name = 'x'
type = 'prismatic'
axis = [1, 0, 0]
[[joint]]
name = 'y'
type = 'prismatic'
axis = [0, 1, 0]
parent = 'x'
[[joint]]
name = 'turn'
parent = 'y'
{joint}
[[rigid_body]]
name = 'disc'
joint = 'turn'
mass = 1
inertia = [1, 1, 2]
[[constraint]]
name = 'edge'
type = 'rolling'
body = 'disc'
radius = 1
axis = {axis}
[time]
end = 1
"
    )
}

#[test]
fn a_disc_that_lies_flat_at_the_start_is_refused_at_its_axis() {
    let disc = |angles: &str, axis: &str| {
        let text = replaced(SPHERE, "radius = 0.5", &format!("radius = 0.5\naxis = {axis}"));
        replaced(&text, "[0, 1.5707963267948966, 0]", angles)
    };
    // The axis is along the normal but for rounding, and exactly.
    let rounded = disc("[0, 1.5707963267948966, 0]", "[1, 0, 0]");
    assert_mistake(&rounded, "[1, 0, 0]", &["`contact` lies flat at the start"]);
    let flat = disc_on_two_slides("type = 'revolute'\naxis = [0, 0, 1]", "[0, 0, 2]");
    assert_mistake(&flat, "[0, 0, 2]", &["`edge` lies flat at the start"]);
}

#[test]
fn a_run_ends_where_a_condition_that_was_left_out_is_violated() {
    // No coordinate is the height of the disc: upright, v·n = 0 holds for every rate, and no longer when the disc leans.
    let joint = "type = 'spherical'\nangles = [0, 1.5707963267948966, 0]\nrates = [0, 0.1, 1]";
    let text = disc_on_two_slides(joint, "[0, 0, 1]");
    let scene = scene(&text);
    let run = run::run(&scene, &Plan::of(&scene), |_| core::ops::ControlFlow::Continue(()));
    assert!(matches!(&run.outcome, Outcome::Failed(why) if why.contains("constraint 0 (edge)")), "{:?}", run.outcome);
}
