//! A batch gives the numbers of single points, to the last bit, at any place and on any number of threads.
//!
//! A binary of its own: `cargo xtask test` runs it a second time, compiled for every set of instructions.

#[path = "../cases/mod.rs"]
mod cases;

use nalgebra::Matrix3;
use piola_batch as batch;
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::strain::{GreenStrain, LeftCauchyGreen, RightCauchyGreen};
use piola_continuum::{Deformation, DeformationGradient, FirstPiola, Symmetric};
use piola_numerics::Lanes;
use piola_numerics::linear::matrix3::from_rows;
use piola_testkit::{Tol, assert_close};

use cases::{deformations, stresses};

/// R, U and ln U of a batch.
#[derive(Clone, PartialEq, Debug)]
struct Polar {
    rotations: Vec<Matrix3<f64>>,
    stretches: Vec<Symmetric>,
    logarithms: Vec<Symmetric>,
    slow_path: usize,
}

fn polar(f: &[DeformationGradient]) -> Polar {
    let (m, s) = (Matrix3::zeros(), Symmetric::zero());
    let mut polar =
        Polar { rotations: vec![m; f.len()], stretches: vec![s; f.len()], logarithms: vec![s; f.len()], slow_path: 0 };
    let requests = (
        batch::rotation(&mut polar.rotations[..]),
        batch::right_stretch(&mut polar.stretches[..]),
        batch::hencky(&mut polar.logarithms[..]),
    );
    polar.slow_path = batch::evaluate(f, requests).expect("deformations").slow_path;
    polar
}

#[test]
fn a_batch_equals_its_points_to_the_last_bit() {
    let f = deformations(2003);
    let polar = polar(&f);
    let mut slow = 0;
    for (index, f) in f.iter().enumerate() {
        let stretch = StretchAnalysis::of(f);
        assert_eq!(polar.rotations[index], from_rows(stretch.rotation()), "R of point {index}");
        assert_eq!(polar.stretches[index], stretch.right_stretch(), "U of point {index}");
        // The logarithm in lanes is its own, within 2 ulp.
        let (one, batch) = (stretch.hencky_material(), polar.logarithms[index]);
        assert_close("ln U", &batch.components, &one.components, Tol::ulps(16.0));
        slow += usize::from(stretch.slow_path());
    }
    assert_eq!(polar.slow_path, slow);
    assert!(0 < slow && slow < f.len() / 2);
}

#[test]
fn logarithms_of_a_batch_equal_those_of_one_lane_to_the_last_bit() {
    let f = deformations(501);
    let polar = polar(&f);
    for (index, f) in f.iter().enumerate() {
        let lane = f.matrix().map(|x| Lanes([x]));
        let lane = DeformationGradient::new(lane).expect("a deformation");
        let components = StretchAnalysis::of(&lane).hencky_material().components.map(|x| x.0[0]);
        assert_eq!(polar.logarithms[index], Symmetric { components }, "point {index}");
    }
}

#[test]
fn a_point_gives_the_same_at_every_place_of_a_batch() {
    let f = deformations(300);
    let whole = polar(&f);
    for first in [1, 3, 8, 13, 297] {
        let part = polar(&f[first..]);
        assert_eq!(part.rotations, whole.rotations[first..]);
        assert_eq!(part.stretches, whole.stretches[first..]);
        assert_eq!(part.logarithms, whole.logarithms[first..]);
    }
    for count in 0..20 {
        assert_eq!(polar(&f[..count]).logarithms, whole.logarithms[..count]);
    }
}

#[cfg(feature = "rayon")]
#[test]
fn results_are_identical_for_any_number_of_threads() {
    let f = deformations(batch::PARALLEL_POINTS + 12_345);
    let [one, two, five] = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| polar(&f))
    });
    assert_eq!(one, two);
    assert_eq!(one, five);
}

#[test]
fn strains_and_stresses_of_a_batch_equal_those_of_its_points() {
    let (f, t) = (deformations(203), stresses(203));
    let s = Symmetric::zero();
    let (mut j, mut c, mut e, mut a) = (vec![0.0; 203], vec![s; 203], vec![s; 203], vec![s; 203]);
    let (mut p, mut back, mut equivalent) = (vec![FirstPiola::zero(); 203], vec![t[0]; 203], vec![0.0; 203]);
    let requests = (
        batch::jacobian(&mut j[..]),
        batch::right_cauchy_green(&mut c[..]),
        batch::green_strain(&mut e[..]),
        batch::left_cauchy_green(&mut a[..]),
        batch::cauchy_to_first_piola(&t[..], &mut p[..]),
        batch::von_mises(&t[..], &mut equivalent[..]),
    );
    batch::evaluate(&f[..], requests).expect("deformations");
    batch::evaluate(&f[..], batch::first_piola_to_cauchy(&p[..], &mut back[..])).expect("deformations");
    for (i, (f, t)) in f.iter().zip(&t).enumerate() {
        assert_eq!(j[i].to_bits(), f.jacobian().to_bits());
        assert_eq!(c[i], RightCauchyGreen::of(f).0);
        assert_eq!(e[i], GreenStrain::of(f).0);
        assert_eq!(a[i], LeftCauchyGreen::of(f).0);
        assert_eq!(p[i], t.first_piola(f));
        assert_eq!(back[i], p[i].cauchy(f));
        assert_eq!(equivalent[i].to_bits(), t.von_mises().to_bits());
    }
}

#[test]
fn single_precision_batches_equal_single_precision_points() {
    let f: Vec<DeformationGradient<f32>> = deformations(203)
        .iter()
        .filter_map(|f| DeformationGradient::new(f.matrix().map(num_traits::AsPrimitive::<f32>::as_)).ok())
        .collect();
    let mut stretches = vec![Symmetric::<f32>::zero(); f.len()];
    batch::evaluate(&f[..], batch::right_stretch(&mut stretches[..])).expect("deformations");
    for (f, u) in f.iter().zip(&stretches) {
        assert_eq!(*u, StretchAnalysis::of(f).right_stretch());
    }
}
