//! Normal stresses of fluids with density, recovered from what cylinders would show.

use piola_fluids::{Giesekus, LinearPhanThienTanner, SecondOrder, ViscometricFluid};
use piola_testkit::{Tol, assert_close};
use piola_viscometry::recover::{self, FlowTable, NormalStressRecovery, Options, RadialStressRow};
use piola_viscometry::{Couette, ViscometryError};

const INNER: f64 = 1.0;

/// What cylinders with the inner one at Ω₁ = `spin` ΔΩ show of a fluid, at torques from T₁ = `lowest` on over a factor of e⁴.
fn shown<F: ViscometricFluid>(
    fluid: &F,
    (outer, lowest, spin): (f64, f64, f64),
    density: f64,
) -> Result<(FlowTableRows, Vec<RadialStressRow>), ViscometryError> {
    let (mut speeds, mut rows) = (Vec::new(), Vec::new());
    for i in 0..33 {
        let torque = core::f64::consts::TAU * lowest * (0.125 * f64::from(i)).exp();
        let still = Couette::new(INNER, outer, torque)?;
        let difference = still.speed_difference(fluid)?.value;
        let inner_speed = spin * difference;
        let turning = still.with_inner_speed(inner_speed)?.with_density(density)?;
        speeds.push([torque, difference]);
        rows.push(RadialStressRow { torque, difference: turning.radial_difference(fluid)?.value, inner_speed });
    }
    Ok((speeds, rows))
}

type FlowTableRows = Vec<[f64; 2]>;

fn recovered<F: ViscometricFluid>(
    fluid: &F,
    setting: (f64, f64, f64),
    density: f64,
) -> Result<NormalStressRecovery, ViscometryError> {
    let (speeds, rows) = shown(fluid, setting, density)?;
    let speeds = FlowTable::couette(INNER, setting.0, &speeds)?;
    recover::normal_stress_with_inertia(&speeds, &rows, density, Options::default())
}

/// The errors of N₁ over the measured stresses, sorted.
fn errors<F: ViscometricFluid>(fluid: &F, found: &NormalStressRecovery) -> Vec<f64> {
    let errors = found.normal.points().map(|point| {
        let point = point.expect("measured");
        let rate: f64 = fluid.shear_rate(point.shear_stress).expect("a rate");
        (point.first_normal_stress_difference / fluid.first_normal_stress_difference(rate) - 1.0).abs()
    });
    let mut errors: Vec<f64> = errors.collect();
    errors.sort_by(f64::total_cmp);
    errors
}

#[test]
fn normal_stresses_of_fluids_with_density_that_are_not_newtonian_are_recovered_from_what_cylinders_show() {
    let giesekus = Giesekus::new(0.1, 1.0, 0.5, 0.2).expect("a fluid");
    let tanner = LinearPhanThienTanner::new(0.1, 1.0, 0.5, 0.2).expect("a fluid");
    let mut compared = 0;
    // Narrow and wider gaps, the inner cylinder at rest, turning backwards, and turning with the outer one.
    for (outer, spin, median) in [(1.02, -1.0, 1e-6), (1.25, 0.0, 1e-5), (1.25, -1.0, 1e-5), (1.25, 0.5, 1e-5)] {
        let setting = (outer, 0.3, spin);
        let light = recovered(&giesekus, setting, 0.0).expect("a curve");
        assert!(light.centrifugal.iter().all(|x| x.abs() <= 0.0));
        for density in [0.5, 3.0] {
            let heavy = recovered(&giesekus, setting, density).expect("a curve");
            let wrong = errors(&giesekus, &heavy);
            assert!(wrong[16] < median, "Giesekus, R₂ = {outer}, spin {spin}, density {density}: {wrong:?}");
            let wrong = errors(&tanner, &recovered(&tanner, setting, density).expect("a curve"));
            assert!(wrong[16] < median, "Phan-Thien and Tanner, R₂ = {outer}, spin {spin}: {wrong:?}");
            compared += 2;
            // The inertia is no small part, and the flow tells it.
            let (_, rows) = shown(&giesekus, setting, density).expect("rows");
            let (_, without) = shown(&giesekus, setting, 0.0).expect("rows");
            for (index, ((row, without), centrifugal)) in rows.iter().zip(&without).zip(&heavy.centrifugal).enumerate()
            {
                let truth = without.difference - row.difference;
                // Within a factor of e of the smallest torque much of ΔΩ is below what the table tells of ζ.
                let asked = if index < 8 { 1e-3 } else { 1e-4 };
                assert!((centrifugal / truth - 1.0).abs() < asked, "row {index}: {centrifugal} {truth}");
            }
        }
    }
    assert_eq!(compared, 16);
}

#[test]
fn inertia_that_is_left_out_falsifies_normal_stresses() {
    let giesekus = Giesekus::new(0.1, 1.0, 0.5, 0.2).expect("a fluid");
    let setting = (1.25, 0.3, 0.0);
    let (speeds, rows) = shown(&giesekus, setting, 3.0).expect("rows");
    let speeds = FlowTable::couette(INNER, 1.25, &speeds).expect("a table");
    let ignored = recover::normal_stress_with_inertia(&speeds, &rows, 0.0, Options::default());
    // Where the rows can be recovered from at all, N₁ is off by the centrifugal part.
    if let Ok(found) = ignored {
        assert!(1e-2 < errors(&giesekus, &found)[16]);
    }
}

#[test]
fn quadratic_normal_stresses_of_a_newtonian_flow_are_exact_whatever_the_density() {
    let fluid = SecondOrder::new(2.0, -0.3, 0.1).expect("a fluid");
    let found = recovered(&fluid, (1.25, 0.3, -0.5), 2.0).expect("a curve");
    let tol = Tol::stated(1e-10, "rounding through the derivatives of two splines of degree 7");
    let mut compared = 0;
    for point in found.normal.points() {
        let point = point.expect("measured");
        let rate: f64 = fluid.shear_rate(point.shear_stress).expect("a rate");
        let truth = fluid.first_normal_stress_difference(rate);
        assert_close("N1", &[point.first_normal_stress_difference], &[truth], tol);
        compared += 1;
    }
    assert_eq!(compared, 33);
}

#[test]
fn rows_beyond_the_flow_table_and_negative_densities_are_refused() {
    let fluid = SecondOrder::new(2.0, -0.3, 0.1).expect("a fluid");
    let (speeds, mut rows) = shown(&fluid, (1.25, 0.3, 0.0), 1.0).expect("rows");
    let speeds = FlowTable::couette(INNER, 1.25, &speeds).expect("a table");
    let negative = recover::normal_stress_with_inertia(&speeds, &rows, -1.0, Options::default());
    assert!(matches!(negative, Err(ViscometryError::OutOfBounds { quantity: "density", .. })));
    rows[0].torque *= 0.5;
    let below = recover::normal_stress_with_inertia(&speeds, &rows, 1.0, Options::default());
    assert!(matches!(below, Err(ViscometryError::NotMeasured { .. })), "{below:?}");
}
