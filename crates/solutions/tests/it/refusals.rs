//! Bad input is refused by name, with the number that was wrong.

use nalgebra::Matrix3;
use piola_solids::isochoric::NeoHookean;
use piola_solutions::dynamics::{RadialOscillation, RadialState};
use piola_solutions::families::{
    AzimuthalShearing, BlockBending, Datum, Family, IsochoricDeformation, Orientation, SectorStraightening,
    SphereDeformation, TubeDeformation,
};
use piola_solutions::loads::{Ends, SectorLoads, Shell, SphereInflation, Tube, TubeInflation, everted_tube};
use piola_solutions::{LoadCurve, SolutionsError};
use piola_testkit::{Tol, assert_close};

#[test]
fn constants_that_change_volumes_are_refused_with_the_nearest_valid() {
    let stretched = Matrix3::from_diagonal_element(2.0);
    let refused = [
        (IsochoricDeformation::new(stretched, [0.0; 3]).err(), 0.5),
        (BlockBending::new([1.0, 2.0, 0.0, 0.0, 1.0]).err(), 0.5),
        (SectorStraightening::new([1.0, 2.0, 1.0, 1.0, 1.0]).err(), 1.0),
        (TubeDeformation::new([1.0, 0.0, 1.0, 0.5, 0.0, 4.0]).err(), 0.25),
        (AzimuthalShearing::new([2.0, 0.5, 1.0, 1.0]).err(), 0.25),
    ];
    let mut count = 0;
    for (error, expected) in refused {
        match error {
            Some(SolutionsError::ConstraintViolated { nearest, .. }) => {
                assert_close("nearest", &[nearest], &[expected], Tol::ulps(4.0));
                count += 1;
            }
            // B E − C D = 1 with A = 1 is right.
            None => assert_close("valid", &[expected], &[1.0], Tol::ulps(0.0)),
            other => panic!("{other:?}"),
        }
    }
    assert_eq!(count, 4);
    assert!(matches!(BlockBending::isochoric([1.0, 2.0, 0.5, 1.0]), Err(SolutionsError::OutOfBounds { .. })));
    assert!(matches!(AzimuthalShearing::new([1.0, 0.0, 0.0, 1.0]), Err(SolutionsError::OutOfBounds { .. })));
    assert!(BlockBending::new([f64::NAN; 5]).is_err());
}

#[test]
fn particles_off_the_domain_are_refused_with_the_radicand() {
    let law = NeoHookean::new(1.0).expect("law");
    let block = BlockBending::isochoric([1.0, 0.0, 0.0, 1.0]).expect("constants");
    let tube = TubeDeformation::isochoric([-1.0, 1.0, 0.0, 0.0, 1.0]).expect("constants");
    let everted = TubeDeformation::isochoric([2.0, 1.0, 0.0, 0.0, -1.0]).expect("constants");
    let sphere = SphereDeformation::new(Orientation::Kept, -1.0).expect("A");
    let inside_out = SphereDeformation::new(Orientation::Everted, 2.0).expect("A");
    let value = |result: Result<(), SolutionsError>| match result {
        Err(SolutionsError::OutsideDomain { value, .. }) => value,
        other => panic!("{other:?}"),
    };
    let found = [
        value(block.check_domain([-1.0, 0.0, 0.0])),
        value(tube.check_domain([0.5, 0.0, 0.0])),
        value(everted.check_domain([2.0, 0.0, 0.0])),
        value(sphere.check_domain([0.5, 0.0, 1.0])),
        value(inside_out.check_domain([2.0, 0.0, 1.0])),
        value(tube.check_domain([-1.0, 0.0, 0.0])),
    ];
    assert_close("radicands", &found, &[-2.0, -0.75, -2.0, -0.875, -6.0, -1.0], Tol::ulps(2.0));
    assert!(matches!(sphere.check_domain([f64::INFINITY, 0.0, 1.0]), Err(SolutionsError::NotFinite { .. })));
    // The datum, too, must be a particle.
    let refused = tube.stress(&law, &Datum::free_at([0.5, 0.0, 0.0]), [2.0, 0.0, 0.0]);
    assert!(matches!(refused, Err(SolutionsError::OutsideDomain { .. })));
    // A tube through the axis, and one with a hole that closes.
    let loads = SectorLoads::of_tube(&tube, &law, (0.5, 2.0), 0.0);
    assert!(matches!(loads, Err(SolutionsError::OutsideDomain { .. })));
    let cavity = TubeDeformation::isochoric([1.0, 1.0, 0.0, 0.0, 1.0]).expect("constants");
    assert!(SectorLoads::of_tube(&cavity, &law, (0.0, 1.0), 0.0).is_err());
}

#[test]
fn bodies_and_loads_out_of_bounds_are_refused() {
    let law = NeoHookean::new(1.0).expect("law");
    assert!(Tube::new(0.0, 1.0).is_err() && Tube::new(1.0, 1.0).is_err() && Shell::new(1.0, f64::NAN).is_err());
    let solid = Tube::solid(1.0).expect("rod");
    assert!(everted_tube(&solid, &law).is_err());
    let inflation = TubeInflation { tube: solid, law: &law, ends: Ends::Closed };
    assert!(matches!(inflation.point(1.5), Err(SolutionsError::OutOfBounds { .. })));
    let balloon =
        SphereInflation { shell: Shell::new(1.0, 1.2).expect("shell"), law: &law, orientation: Orientation::Kept };
    assert!(matches!(balloon.point(-1.0), Err(SolutionsError::OutOfBounds { .. })));
    assert!(matches!(balloon.limit_points((2.0, 1.0)), Err(SolutionsError::OutOfBounds { .. })));
    assert!(matches!(balloon.states_at(f64::NAN, (1.0, 2.0)), Err(SolutionsError::NotFinite { .. })));
    let motion = RadialOscillation { body: balloon, density: 0.0, pressure: 0.0 };
    assert!(motion.orbit(RadialState { stretch: 1.1, rate: 0.0 }, (0.5, 2.0)).is_err());
    let tube = Tube::new(1.0, 2.0).expect("tube");
    let closed = TubeInflation { tube, law: &law, ends: Ends::Closed };
    let motion = RadialOscillation { body: closed, density: 1.0, pressure: 0.0 };
    assert!(matches!(
        motion.orbit(RadialState { stretch: 1.1, rate: 0.0 }, (0.5, 2.0)),
        Err(SolutionsError::OutOfBounds { .. })
    ));
}
