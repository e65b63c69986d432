//! Closed circuits of fibres that slacken: the work is that of an energy, on each side of the kink.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::DeformationGradient;
use piola_solids::{AnySolid, HolzapfelGasserOgden, Hyperelastic};
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, assert_close_at_scale};

use super::laws::artery;

const WORK: Tol = Tol::stated(1e-12, "rounding of a sum over a circuit, of ∮ |P| |dF|");

/// Nodes and weights of Gauss and Legendre's rule with eight points, by halves.
const RULE: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// Eₐ of a family, whose sign says whether its fibres answer.
fn strain(wall: &HolzapfelGasserOgden, family: usize, f: &Matrix3<f64>) -> f64 {
    let (c, a) = (f.transpose() * f, Vector3::from(wall.fibres()[family].direction()));
    let d = wall.dispersion();
    f.determinant().powf(-2.0 / 3.0) * (d * c.trace() + (1.0 - 3.0 * d) * (c * a).dot(&a)) - 1.0
}

/// Where on the side the fibres of a family become taut or slack.
fn kinks(wall: &HolzapfelGasserOgden, from: &Matrix3<f64>, step: &Matrix3<f64>) -> Vec<f64> {
    const PARTS: u32 = 256;
    let mut places = Vec::new();
    for family in 0..2 {
        let at = |s: f64| strain(wall, family, &(from + step * s));
        for part in 0..PARTS {
            let (mut low, mut high) = (f64::from(part) / f64::from(PARTS), f64::from(part + 1) / f64::from(PARTS));
            let taut = 0.0 < at(low);
            if taut == (0.0 < at(high)) {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if (0.0 < at(middle)) == taut {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            places.push(high);
        }
    }
    places.sort_by(f64::total_cmp);
    places
}

/// (∮ P : dF, ∮ |P| |dF|, the kinks met), each side divided where the stress has a kink.
fn around(wall: &HolzapfelGasserOgden, corners: &[Matrix3<f64>]) -> (f64, f64, usize) {
    let law: AnySolid = (*wall).into();
    let (mut work, mut scale, mut met) = (0.0, 0.0, 0);
    for (k, from) in corners.iter().enumerate() {
        let step = corners[(k + 1) % corners.len()] - from;
        let places = kinks(wall, from, &step);
        met += places.len();
        let mut ends: Vec<f64> = (0..=8).map(|k| f64::from(k) / 8.0).chain(places).collect();
        ends.sort_by(f64::total_cmp);
        for piece in ends.windows(2) {
            let (centre, half) = (0.5 * (piece[0] + piece[1]), 0.5 * (piece[1] - piece[0]));
            for (node, weight) in RULE {
                for side in [-node, node] {
                    let f = DeformationGradient::new(from + step * (centre + half * side)).expect("0 < det F");
                    let stress = law.first_piola(&f).0;
                    work += weight * half * stress.component_mul(&step).sum();
                    scale += weight * half * stress.norm() * step.norm();
                }
            }
        }
    }
    (work, scale, met)
}

/// A triangle of corners about F₀.
fn triangle(random: &mut Random, about: &Matrix3<f64>, size: f64) -> [Matrix3<f64>; 3] {
    [0; 3].map(|_| about + Matrix3::from_fn(|_, _| size * random.symmetric()))
}

#[test]
fn work_around_circuits_of_taut_fibres_equals_zero() {
    let mut random = Random::new(5);
    for dispersion in [0.0, 0.1, 0.3] {
        let wall = artery(dispersion).expect("parameters");
        let pulled = Matrix3::from_diagonal(&Vector3::new(1.3, 1.3, 0.6));
        for _ in 0..200 {
            let (work, scale, met) = around(&wall, &triangle(&mut random, &pulled, 0.05));
            assert_eq!(met, 0, "the fibres stay taut");
            assert_close_at_scale("∮ P : dF", &[work], &[0.0], scale, WORK);
        }
    }
}

/// The stress is continuous where fibres slacken, and its derivative is not: a rule over the kink has an error of second order
/// in its steps, but each side of the kink is smooth.
#[test]
fn work_around_circuits_across_the_kink_equals_zero() {
    let mut random = Random::new(7);
    for dispersion in [0.0, 0.1, 0.3] {
        let wall = artery(dispersion).expect("parameters");
        let mut kinks = 0;
        for _ in 0..200 {
            let (work, scale, met) = around(&wall, &triangle(&mut random, &Matrix3::identity(), 0.15));
            kinks += met;
            assert_close_at_scale("∮ P : dF", &[work], &[0.0], scale, WORK);
        }
        assert!(200 < kinks, "{kinks} kinks");
    }
}
