//! What is refused, with the offending value.

use piola_spectral::{
    BoxGrid, BoxOperator, BoxSolver, Eigenbasis, LameParameters, ModalMotion, ModalSeries, SpectralError, ViscousFlow,
    Walls,
};

use super::fixtures::{lame, slices};

#[test]
fn impossible_grids_are_refused() {
    let few = |axis, points, least| Some(SpectralError::TooFewPoints { axis, points, least });
    assert_eq!(BoxGrid::cells([0, 4, 4], [1.0; 3]).err(), few(0, 0, 2));
    assert_eq!(BoxGrid::cells([4, 1], [1.0; 2]).err(), few(1, 1, 2));
    assert_eq!(BoxGrid::nodes([4, 4, 2], [1.0; 3]).err(), few(2, 2, 3));
    let spacing = |value| Some(SpectralError::OutOfBounds { quantity: "spacing", value, bound: "0 < h" });
    assert_eq!(BoxGrid::cells([4, 4], [1.0, 0.0]).err(), spacing(0.0));
    assert_eq!(BoxGrid::cells([4, 4], [-2.0, 1.0]).err(), spacing(-2.0));
    let infinite = BoxGrid::cells([4, 4], [f64::INFINITY, 1.0]).err();
    assert_eq!(infinite, Some(SpectralError::NotFinite { quantity: "spacing", index: 0, value: f64::INFINITY }));
    let huge = BoxGrid::cells([usize::MAX, 4], [1.0; 2]).err();
    assert_eq!(huge, Some(SpectralError::TooManyPoints { points: [usize::MAX, 4, 1] }));
}

#[test]
fn operators_that_are_not_elliptic_are_refused() {
    let refused = LameParameters::new(-2.0, 1.0).err();
    assert_eq!(refused, Some(SpectralError::NotElliptic { first: -2.0, shear_modulus: 1.0 }));
    let refused = LameParameters::new(1.0, 0.0).err();
    assert_eq!(refused, Some(SpectralError::OutOfBounds { quantity: "μ", value: 0.0, bound: "0 < μ" }));
    assert!(matches!(
        LameParameters::new(f64::NAN, 1.0),
        Err(SpectralError::NotFinite { quantity: "λ", value, .. }) if value.is_nan()
    ));
    assert!(LameParameters::new(-1.5, 1.0).is_ok(), "negative λ with 0 < λ + 2μ");
    assert!(LameParameters::from_engineering(1.0, 0.5).is_err(), "incompressible");
    let refused = BoxOperator::membrane(-1.0).err();
    assert_eq!(refused, Some(SpectralError::OutOfBounds { quantity: "tension", value: -1.0, bound: "0 < S" }));
    assert!(BoxOperator::plate(f64::INFINITY).is_err());
}

#[test]
fn bad_forces_are_refused_with_their_place() {
    let grid = BoxGrid::cells([4, 5, 6], [1.0; 3]).expect("grid");
    let mut solver = BoxSolver::<f64, 3>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
    let mut fields = [vec![0.0; 120], vec![0.0; 120], vec![0.0; 119]];
    let refused = solver.solve_in_place(slices(&mut fields));
    assert_eq!(refused, Err(SpectralError::WrongLength { quantity: "force", found: 119, expected: 120 }));
    let mut compared = 0;
    for index in [0, 7, 63, 119] {
        for lifted in [false, true] {
            let mut fields = [vec![0.0; 120], vec![0.0; 120], vec![0.0; 120]];
            fields[1][index] = f64::NEG_INFINITY;
            let fields = slices(&mut fields);
            let refused =
                if lifted { solver.solve_lifted_in_place(fields).err() } else { solver.solve_in_place(fields).err() };
            let value = f64::NEG_INFINITY;
            assert_eq!(refused, Some(SpectralError::NotFinite { quantity: "force", index, value }));
            compared += 1;
        }
    }
    assert_eq!(compared, 8);
}

#[test]
fn other_boxes_and_impossible_motions_are_refused() {
    let series = |side, walls, highest| ModalSeries::<2>::zeros([side, 1.0], walls, highest).expect("series");
    let own = series(1.0, Walls::Sliding, [2, 2]);
    let operator = BoxOperator::elastic(lame());
    for other in
        [series(2.0, Walls::Sliding, [2, 2]), series(1.0, Walls::Guided, [2, 2]), series(1.0, Walls::Sliding, [2, 3])]
    {
        let refused = ModalMotion::new(operator, 1.0, 0.0, own.clone(), other.clone()).err();
        assert_eq!(refused, Some(SpectralError::OtherGrid { quantity: "velocity" }));
        let mut motion = ModalMotion::new(operator, 1.0, 0.0, own.clone(), own.clone()).expect("motion");
        assert_eq!(motion.step(0.1, &[other]), Err(SpectralError::OtherGrid { quantity: "force" }));
    }
    let motion = |density, drag| ModalMotion::new(operator, density, drag, own.clone(), own.clone());
    let out = |quantity, value, bound| Some(SpectralError::OutOfBounds { quantity, value, bound });
    assert_eq!(motion(0.0, 0.0).err(), out("ρ", 0.0, "0 < ρ"));
    assert_eq!(motion(1.0, -1.0).err(), out("c", -1.0, "0 <= c"));
    assert_eq!(motion(1.0, 0.0).expect("motion").step(-0.5, &[]).err(), out("h", -0.5, "0 <= h"));
    let forces = vec![own.clone(); 5];
    let refused = motion(1.0, 0.0).expect("motion").step(0.5, &forces).err();
    assert_eq!(refused, Some(SpectralError::WrongLength { quantity: "force", found: 5, expected: 4 }));
    assert!(Eigenbasis::new([1.0, f64::NAN], lame()).is_err());
    let mut own = own;
    assert_eq!(own.set_amplitudes([0, 3], [0.0; 2]).err(), out("index", 3.0, "i <= N"));
}

#[test]
fn flows_that_fold_in_one_step_are_refused() {
    let grid = BoxGrid::cells([16, 16], [1.0 / 16.0; 2]).expect("grid");
    let solver = BoxSolver::<f64, 2>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
    assert!(ViscousFlow::new(solver.clone(), 1.0).is_err());
    let mut flow = ViscousFlow::new(solver, 0.5).expect("flow");
    let fast: Vec<f64> = (0..256).map(|p| (std::f64::consts::PI * grid.position(grid.indices(p))[0]).sin()).collect();
    let rest = vec![0.0; 256];
    let refused = flow.step([&fast, &rest], 0.4);
    assert!(matches!(refused, Err(SpectralError::Folded { jacobian, bound, .. }) if jacobian < 0.5 && 0.5 <= bound));
    assert!(flow.displacement().iter().all(|list| list.iter().all(|u| *u == 0.0)), "as before the step");
    let mut bad = rest.clone();
    bad[17] = f64::INFINITY;
    let refused = flow.step([&rest, &bad], 0.1).err();
    assert_eq!(refused, Some(SpectralError::NotFinite { quantity: "velocity", index: 17, value: f64::INFINITY }));
    assert!(flow.reference_position([0.5, 1.5]).is_err());
}
