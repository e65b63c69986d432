//! A motion is that of its parts, whoever meets in them.

use super::critical::Sizes;
use super::encounters::Encounters;
use crate::kepler::Increment;
use crate::wisdom_holman::planets::{PlanetMasses, Planets};
use crate::wisdom_holman::run::{Moment, Near};

/// The planets after a time, in so many motions, and the nearest approach.
fn moved(masses: &PlanetMasses, sizes: &Sizes, state: &[f64], time: f64, motions: u32) -> (Vec<[f64; 3]>, f64) {
    let mut planets = Planets::new(masses, state);
    let mut near = Encounters::new(masses, sizes);
    let mut increments = vec![Increment { position: [0.0; 3], velocity: [0.0; 3] }; masses.planets.len()];
    for motion in 0..motions {
        let part = time / f64::from(motions);
        planets.keplerian(masses, part, &mut increments);
        let moment = Moment { t: f64::from(motion) * part, is_of_run: true };
        near.correct(masses, &planets, part, moment, &mut increments).unwrap();
        planets.add(&increments);
    }
    let places = planets.planets.iter().map(|planet| planet.position).collect();
    (places, near.closest.map_or(f64::INFINITY, |closest| closest.distance))
}

fn largest_difference(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.concat().iter().zip(b.concat()).fold(0.0, |largest: f64, (a, b)| largest.max((a - b).abs()))
}

/// The state by components of bodies given one by one, the central one at rest in the origin.
fn state(planets: &[[f64; 6]]) -> Vec<f64> {
    (0..6).flat_map(|component| [0.0].into_iter().chain(planets.iter().map(move |x| x[component]))).collect()
}

/// Two planets turn each other by a right angle within the motion; the second one then meets a third, which neither of their
/// Keplerian arcs comes near.
#[test]
fn planet_thrown_off_its_arc_meets_a_third() {
    let masses = PlanetMasses::new(&[1.0, 1e-6, 1e-6, 0.0]);
    let sizes = Sizes { critical: vec![0.0, 0.006, 0.006, 0.0], radii: Vec::new(), least: 0.0 };
    let pair = |third: [f64; 3]| {
        let first = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let second = [1.001, -0.004, 0.0, 0.0, 1.03, 0.0];
        // The third one beside the first, on a circle.
        let r = third[0].hypot(third[1]);
        let speed = r.powf(-1.5);
        state(&[first, second, [third[0], third[1], third[2], -speed * third[1], speed * third[0], 0.0]])
    };
    let far_away = [-1.0, 0.0, 0.0];
    let time = 0.5;
    let (alone, closest) = moved(&masses, &sizes, &pair(far_away), time, 1);
    assert!(closest < 2e-3, "{closest}");
    let arcs = Sizes { critical: vec![0.0; 4], ..sizes.clone() };
    let (straight, _) = moved(&masses, &arcs, &pair(far_away), time, 1);
    let thrown = [0, 1].map(|axis| alone[1][axis] - straight[1][axis]);
    assert!(0.008 < thrown[0].hypot(thrown[1]), "{thrown:?}");
    // Where the second one ends, turned back by the time along a circle of the same radius.
    let [x, y, z] = alone[1];
    let r = x.hypot(y);
    let angle = y.atan2(x) - time * r.powf(-1.5);
    let start = pair([r * angle.cos(), r * angle.sin(), z + 0.002]);
    let (one, _) = moved(&masses, &sizes, &start, time, 1);
    let (many, _) = moved(&masses, &sizes, &start, time, 64);
    let (unmet, _) = moved(&masses, &arcs, &start, time, 1);
    let apart = largest_difference(&one[2..], &unmet[2..]);
    assert!(1e-6 < apart, "the third planet keeps to its arc: {apart}");
    // Planets that turn each other in a passage of a hundredth of the whole motion: rounding grows a hundredfold.
    let error = largest_difference(&one, &many);
    assert!(error < 1e-12, "{error} of {apart}");
}

/// Random planets close together, in one motion and in sixteen.
#[test]
fn motion_is_that_of_its_parts() {
    let mut seed = 7_u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 24) - 0.5
    };
    let masses = PlanetMasses::new(&[1.0, 1e-5, 2e-5, 0.0, 1e-5]);
    let sizes = Sizes { critical: vec![0.0, 0.03, 0.03, 0.0, 0.02], radii: Vec::new(), least: 0.0 };
    let (mut met, mut apart) = (0, 0);
    for _ in 0..60 {
        let bodies: [[f64; 6]; 4] = core::array::from_fn(|_| {
            let x = [1.0 + 0.1 * random(), 0.1 * random(), 0.02 * random()];
            [x[0], x[1], x[2], 0.2 * random(), 1.0 + 0.2 * random(), 0.02 * random()]
        });
        let start = state(&bodies);
        let time = 0.6 * random();
        let (one, closest) = moved(&masses, &sizes, &start, time, 1);
        let (many, again) = moved(&masses, &sizes, &start, time, 16);
        if closest < 0.002 {
            continue;
        }
        if closest.is_finite() {
            met += 1;
            assert!((closest - again).abs() < 1e-10, "{closest} and {again}");
        } else {
            apart += 1;
        }
        let error = largest_difference(&one, &many);
        assert!(error < 1e-12, "{error}, nearest {closest}, in {time} from {start:?}");
    }
    assert!(20 < met && 2 < apart, "{met} and {apart}");
}
