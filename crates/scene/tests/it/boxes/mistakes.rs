//! Every mistake in a scene of a box is answered at its place.

use std::time::{Duration, Instant};

use super::STIR;
use crate::support::{PAIR, assert_mistake, replaced, study};

const PLATE: &str = r#"
[box]
type = "static"
sides = [2.0, 1.0]
points = [16, 8]
young_modulus = 3.0
poisson_ratio = 0.25

[[load]]
type = "mode"
indices = [2, 3]
force_per_volume = [1.0, 3.5]

[[load]]
type = "gaussian"
at = [0.5, 0.75]
radius = 0.3
force_per_volume = [0.0, 1.0]

[[probe]]
name = "middle"
at = [1.0, 0.5]
"#;

const BAR: &str = r#"
[box]
type = "motion"
sides = [1.0, 1.0]
modes = [3, 2]
first_lame_parameter = 2.0
shear_modulus = 1.0
density = 2.0
duration = 10.0

[[start]]
type = "mode"
indices = [1, 0]
displacement = [0.01, 0.0]

[[load]]
type = "uniform"
force_per_volume = [1.0, 0.0]
from = 2.0
until = 4.0
"#;

#[test]
fn sides_and_points_that_make_no_grid_are_refused() {
    let at = |old: &str, new: &str, words: &[&str]| assert_mistake(&replaced(PLATE, old, new), new, words);
    at("[2.0, 1.0]", "[2.0, 0.0]", &["sides of [2, 0] m", "lengths greater than zero"]);
    at("[2.0, 1.0]", "[-2.0, 1.0]", &["sides of [-2, 1] m"]);
    at("[2.0, 1.0]", "[2e80, 1.0]", &["side = 2e80 violates 1e-70 < L < 1e70"]);
    at("[2.0, 1.0]", "[2.0]", &["`sides` is a list of 1", "a list of 2 or 3 numbers"]);
    at("[16, 8]", "[16, 1]", &["axis 1 has 1 points; at least 2 are needed"]);
    at("[16, 8]", "[0, 8]", &["axis 0 has 0 points", "at least 2 along each axis"]);
    at("[16, 8]", "[16, 8.5]", &["`points` is [16, 8.5]", "whole numbers"]);
    at("[16, 8]", "[-16, 8]", &["`points` is [-16, 8]", "not negative"]);
    at("[16, 8]", "[16, 8, 8]", &["`points` has 3 numbers in a [box] of 2 sides", "a list of 2 numbers"]);
    let nodes = replaced(PLATE, "points = [16, 8]", "points = [16, 2]\nlocation = \"nodes\"");
    assert_mistake(&nodes, "[16, 2]", &["axis 1 has 2 points; at least 3 are needed"]);
    let modes = replaced(PLATE, "points = [16, 8]", "points = [16, 8]\nmodes = [4, 8]");
    assert_mistake(&modes, "[4, 8]", &["modes up to [4, 8] are more than the grid can tell apart", "at most [15, 7]"]);
}

#[test]
fn what_does_not_fit_into_memory_is_refused_at_once() {
    let begun = Instant::now();
    let words = ["of memory", "at most 1.0737 GB"];
    assert_mistake(&replaced(PLATE, "[16, 8]", "[20000, 20000]"), "[20000, 20000]", &words);
    assert_mistake(&replaced(PLATE, "[16, 8]", "[1e9, 1e9]"), "[1e9, 1e9]", &words[..1]);
    assert_mistake(&replaced(STIR, "[8, 8]", "[100000, 100000]"), "[100000, 100000]", &words);
    assert_mistake(&replaced(BAR, "[3, 2]", "[30000, 30000]"), "[30000, 30000]", &words);
    let narrow = "type = \"gaussian\"\nat = [0.5, 0.5]\nradius = 1e-6\ndisplacement";
    let text = replaced(BAR, "type = \"mode\"\nindices = [1, 0]\ndisplacement", narrow);
    assert_mistake(&text, "[3, 2]", &["with the nodes that their functions need", words[0]]);
    let deep = replaced(STIR, "[1.0, 1.0]", "[1.0, 1.0, 1.0]");
    let deep = replaced(&deep, "[8, 8]", "[1e9, 1e9, 1e9]");
    assert_mistake(&deep, "[1e9, 1e9, 1e9]", &["is too large to address"]);
    assert!(begun.elapsed() < Duration::from_secs(5));
}

#[test]
fn materials_that_are_not_elliptic_are_refused() {
    let at = |old: &str, new: &str, words: &[&str]| assert_mistake(&replaced(PLATE, old, new), new, words);
    at("0.25", "0.5", &["ν = 5e-1 violates -1 < ν < 1/2"]);
    at("0.25", "-1.0", &["ν = -1e0 violates -1 < ν < 1/2"]);
    at("3.0", "-3.0", &["`young_modulus` is negative", "greater than zero"]);
    at("3.0", "nan", &["`young_modulus` is nan, not a number"]);
    assert_mistake(
        &replaced(BAR, "= 2.0\nshear", "= -2.5\nshear"),
        "-2.5",
        &["λ = -2.5e0 and μ = 1e0 violate 0 < λ + 2μ"],
    );
    assert_mistake(
        &replaced(BAR, "shear_modulus = 1.0\n", ""),
        "2.0\ndensity",
        &["a material of `first_lame_parameter`"],
    );
    let both = replaced(PLATE, "poisson_ratio = 0.25", "poisson_ratio = 0.25\nshear_modulus = 1.125");
    assert_mistake(&both, "1.125", &["a material of `young_modulus`, `poisson_ratio`, `shear_modulus`"]);
    let none = replaced(PLATE, "young_modulus = 3.0\npoisson_ratio = 0.25\n", "");
    assert_mistake(&none, "[box]", &["an elastic [box] without a material", "`young_modulus` and `poisson_ratio`"]);
    assert_mistake(&replaced(STIR, "1.5", "-1.5"), "-1.5", &["`shear_viscosity` is negative"]);
    let thin = replaced(STIR, "duration", "second_viscosity = -3.25\nduration");
    assert_mistake(&thin, "-3.25", &["violate 0 < λ + 2μ"]);
    assert_mistake(
        &replaced(STIR, "duration", "young_modulus = 1.0\nduration"),
        "young_modulus",
        &["no key of a flow box"],
    );
    assert_mistake(&replaced(BAR, "density = 2.0", "density = 0.0"), "0.0\nduration", &["`density` is the number 0"]);
}

#[test]
fn places_outside_of_the_box_and_modes_that_vanish_are_refused() {
    let at = |old: &str, new: &str, words: &[&str]| assert_mistake(&replaced(PLATE, old, new), new, words);
    at("[1.0, 0.5]", "[1.0, 1.5]", &["y = 1.5 m is outside of the box", "from 0 m to 1 m along y"]);
    at("[0.5, 0.75]", "[-0.5, 0.75]", &["x = -0.5 m is outside of the box"]);
    at("[0.5, 0.75]", "[0.5, 0.75, 1.0]", &["`at` has 3 numbers in a [box] of 2 sides"]);
    at("0.3", "0.1", &["the radius 0.1 m is less than the spacing 0.125 m of the grid"]);
    at("[2, 3]", "[0, 3]", &["the x component of the mode [0, 3] vanishes everywhere", "at least 1 along x"]);
    at("[2, 3]", "[2, 0]", &["the y component of the mode [2, 0] vanishes everywhere"]);
    at("[2, 3]", "[2, 9]", &["the mode [2, 9] is beyond the highest, [15, 7]"]);
    at("[2, 3]", "[2, -3]", &["`indices` is [2, -3]", "whole numbers"]);
    assert_mistake(&replaced(PLATE, "3.5", "inf"), "inf", &["`force_per_volume` is inf, not finite"]);
    let guided = replaced(PLATE, "points", "walls = \"guided\"\npoints");
    let text = replaced(&guided, "[2, 3]", "[2, 0]");
    assert_mistake(&text, "[2, 0]", &["the x component of the mode [2, 0] vanishes everywhere", "at least 1 along y"]);
    assert_mistake(&replaced(BAR, "[1, 0]", "[0, 0]"), "[0, 0]", &["the x component of the mode [0, 0] vanishes"]);
    let point = replaced(PLATE, "type = \"gaussian\"", "type = \"point\"");
    let point = replaced(&point, "radius = 0.3\nforce_per_volume = [0.0, 1.0]", "force = [0.0, 1.0]");
    assert_mistake(&point, "\"point\"", &["a point load in a [box] of 2 sides", "type = \"line\""]);
}

#[test]
fn loads_and_starts_that_do_not_belong_are_refused() {
    let steady = replaced(PLATE, "indices = [2, 3]", "indices = [2, 3]\nuntil = 7.5");
    assert_mistake(&steady, "7.5", &["`until` of a steady load", "only the loads of a motion"]);
    let start = format!("{PLATE}[[start]]\ntype = 'mode'\nindices = [1, 1]\ndisplacement = [1.0, 1.0]\n");
    assert_mistake(&start, "[[start]]", &["[[start]] in a [box] of the type static"]);
    let early = replaced(BAR, "until = 4.0", "until = 1.5");
    assert_mistake(&early, "1.5", &["the load ends at 1.5 s and begins at 2 s"]);
    let late = replaced(BAR, "from = 2.0\nuntil = 4.0", "from = 12.5");
    assert_mistake(&late, "12.5", &["the load ends at 10 s and begins at 12.5 s"]);
    let both = replaced(BAR, "displacement = [0.01, 0.0]", "displacement = [0.01, 0.0]\nvelocity = [0.02, 0.0]");
    assert_mistake(&both, "[0.02, 0.0]", &["both `displacement` and `velocity`"]);
    let neither = replaced(BAR, "displacement = [0.01, 0.0]", "");
    assert_mistake(&neither, "[[start]]", &["neither `displacement` nor `velocity`"]);
    let still = &BAR[..BAR.find("[[start]]").unwrap_or(BAR.len())];
    assert_mistake(still, "[box]", &["neither a [[load]] nor a [[start]]: nothing moves"]);
    let unloaded = &STIR[..STIR.find("[[load]]").unwrap_or(STIR.len())];
    assert_mistake(unloaded, "[box]", &["a [box] of the type flow with no [[load]]"]);
    assert_mistake(&replaced(BAR, "modes = [3, 2]\n", ""), "[box]", &["a [box] of the type motion lacks `modes`"]);
    assert_mistake(
        &format!("{PAIR}[[probe]]\nname = 'p'\nat = [0.0, 0.0]\n"),
        "[[probe]]",
        &["[[probe]] in a scene of [gravity]"],
    );
    let again = format!("{PLATE}[[probe]]\nname = \"middle\"\nat = [0.1, 0.1]\n");
    let report = crate::support::report(&again).to_string();
    assert!(report.contains("the name `middle` is taken"), "{report}");
}

#[test]
fn more_displacements_than_memory_holds_are_refused() {
    let probes = |count: usize| -> String {
        let probe = |index| format!("[[probe]]\nname = \"p{index}\"\nat = [0.5, 0.5]\n");
        (0..count).map(probe).collect()
    };
    let fine = replaced(BAR, "duration = 10.0", "duration = 10.0\ninterval = 1e-4");
    // 100001 instants of each probe.
    let words = ["6000060 displacements over all instants and probes", "at most 5000000: fewer probes"];
    assert_mistake(&format!("{fine}{}", probes(60)), "[[probe]]", &words);
    let _ = study(&format!("{fine}{}", probes(49)));
}

#[test]
fn times_that_need_too_many_steps_are_refused() {
    let fine = replaced(BAR, "duration = 10.0", "duration = 10.0\ninterval = 1e-5");
    assert_mistake(&fine, "1e-5", &["the duration has 1000000 times the interval in it", "at most 100000 times"]);
    let fine = replaced(STIR, "duration = 0.5", "duration = 0.5\nstep = 1e-6");
    assert_mistake(&fine, "1e-6", &["the duration has 500000 times the step in it"]);
    assert_mistake(&replaced(STIR, "duration = 0.5", "duration = -0.5"), "-0.5", &["`duration` is negative"]);
    let whole = replaced(STIR, "duration = 0.5", "duration = 0.5\nleast_jacobian = 1.0");
    assert_mistake(&whole, "1.0\n\n", &["`least_jacobian` is the number 1"]);
    let timed = format!("{PLATE}[time]\nend = '1 s'\n");
    assert_mistake(&timed, "[time]", &["[time] in a scene of [box]", "`duration` in a [box]"]);
}
