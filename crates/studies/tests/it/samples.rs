//! Values between the points of a grid.

use piola_studies::PlaneSamples;

/// A bilinear function is its own interpolation.
#[test]
fn values_between_the_points_are_bilinear() {
    let value = |[x, y]: [f64; 2]| 1.0 + 2.0 * x - 3.0 * y + 4.0 * x * y;
    let (origin, spacing, points) = ([-1.0, 2.0], [1.0, 0.5], [4, 5]);
    let place = |k: usize| [origin[0] + (k % 4) as f64 * spacing[0], origin[1] + (k / 4) as f64 * spacing[1]];
    let samples = PlaneSamples { origin, spacing, points, values: (0..20).map(|k| value(place(k))).collect() };
    for x in [[-1.0, 2.0], [-0.75, 2.125], [0.5, 3.25], [1.25, 2.75], [1.5, 3.875], [2.0, 4.0]] {
        // Sums of a few parts, each below 64.
        let found = samples.at(x).unwrap();
        assert!((found - value(x)).abs() < 64.0 * f64::EPSILON, "{x:?}: {found}");
    }
    assert_eq!([[-1.25, 3.0], [2.25, 3.0], [0.0, 1.75], [0.0, 4.25]].map(|x| samples.at(x)), [None; 4]);
}
