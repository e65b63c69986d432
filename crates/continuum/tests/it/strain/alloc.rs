//! No evaluation of a strain, an invariant or a derivative allocates.

use core::hint::black_box;

use nalgebra::{Matrix3, Vector3};
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::strain::{
    AlmansiStrain, BiotStrain, GreenStrain, HenckyStrain, LeftCauchyGreen, LinearStrain, RightCauchyGreen,
    RightStretch, Rotation, SethHill, SethHillStrain, SpatialHenckyStrain, invariants,
};
use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_testkit::allocations_in;

fn evaluate(f: &impl Deformation<f64>) {
    let direction = Matrix3::new(0.1, 0.2, -0.3, 0.4, 0.5, 0.6, -0.7, 0.8, 0.9);
    black_box((f.jacobian(), f.volume_change(), f.ln_jacobian(), f.inverse_rows(), f.area_element(Vector3::x())));
    black_box((RightCauchyGreen::of(f), LeftCauchyGreen::of(f), GreenStrain::of(f), AlmansiStrain::of(f)));
    black_box((LinearStrain::of(f).engineering(), invariants::first(f), invariants::isochoric_first_minus_three(f)));
    let analysis = StretchAnalysis::of(f);
    black_box((HenckyStrain::from_analysis(&analysis), BiotStrain::from_analysis(&analysis)));
    black_box((Rotation::of(f), SpatialHenckyStrain::of(f), SethHillStrain::of(f, SethHill::ALMANSI)));
    black_box((HenckyStrain::derivative(f, &direction), HenckyStrain::derivative_matrix(f)));
    black_box(RightStretch::second_derivative(f, &direction, &direction));
    let metric = RightCauchyGreen::of(f);
    black_box((HenckyStrain::derivative_by_metric(&metric), invariants::derivatives(&metric.0)));
}

#[test]
fn evaluations_allocate_nothing() {
    let rows = [[1.2, 0.3, -0.1], [0.2, 0.8, 0.4], [-0.3, 0.1, 1.1]];
    let (count, ()) = allocations_in(|| {
        let gradient = DeformationGradient::from_rows(black_box(rows));
        let small = DisplacementGradient::from_rows(black_box(rows.map(|row| row.map(|x| 1e-9 * x))));
        let (gradient, small) = (gradient.expect("0 < det F"), small.expect("0 < det F"));
        evaluate(&gradient);
        evaluate(&small);
        black_box((gradient.compose(&gradient).is_ok(), small.inverse().is_ok()));
    });
    assert_eq!(count, 0);
}
