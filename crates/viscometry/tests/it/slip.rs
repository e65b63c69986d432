//! Slip at the walls of turning gaps and of an annulus.

use std::f64::consts::PI;

use piola_fluids::{Bingham, CarreauYasuda, HerschelBulkley, Newtonian, ViscometricFluid};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use piola_viscometry::{Annulus, Channel, ConeAndPlate, ParallelPlates, WallSlip, quadrature};

use super::fluids::Normal;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const QUADRATURE: Tol = Tol::stated(1e-10, "a quadrature over stresses that are found by a search");

#[test]
fn torques_of_a_newtonian_fluid_that_slips_equal_closed_forms() -> Outcome {
    // With v_s = b τ: τ = Ω r/(h/μ + 2 b) between plates, Ω r/(α r/μ + 2 b) under a cone.
    let (oil, slip) = (Newtonian::new(0.75)?, WallSlip::new(0.2, 1.0)?);
    let (radius, gap, angle, speed) = (0.5_f64, 0.125, 0.05, 3.0);
    let discs = ParallelPlates::new(radius, gap, speed)?.with_slip(slip);
    let exact = 0.5 * PI * speed * radius.powi(4) / (gap / 0.75 + 0.4);
    assert_close("discs", &[discs.torque(&oil)?.value], &[exact], QUADRATURE);
    let cone = ConeAndPlate::new(radius, angle, -speed)?.with_slip(slip);
    let (a, c) = (angle / 0.75, 0.4);
    let x = a * radius / c;
    // ∫ r³/(a r + c) dr by its series in x = a R/c: R⁴/c Σ (−x)ⁿ/(n + 4).
    let series: f64 = (0..60).map(|n| (-x).powi(n) / f64::from(n + 4)).sum();
    let exact = -2.0 * PI * speed * radius.powi(4) / c * series;
    assert_close("cone", &[cone.torque(&oil)?.value], &[exact], QUADRATURE);
    for r in [0.1, 0.5] {
        let stress = cone.shear_stress(&oil, r)?;
        assert_close("stress", &[stress], &[-speed * r / (a * r + c)], QUADRATURE);
        // From plate to cone the velocity goes from slip to the cone's less slip.
        let [bottom, top] = [cone.velocity(&oil, r, 0.0)?, cone.velocity(&oil, r, 1.0)?];
        assert_close("plate", &[bottom], &[slip.speed(stress)], QUADRATURE);
        assert_close("cone", &[top], &[-speed * r - slip.speed(stress)], QUADRATURE);
        assert_close("rate", &[discs.shear_rate(&oil, r)?], &[discs.shear_stress(&oil, r)? / 0.75], QUADRATURE);
    }
    Ok(())
}

#[test]
fn flows_that_hardly_slip_equal_those_that_stick() -> Outcome {
    let fluid = CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?;
    let slip = WallSlip::new(1e-13, 1.0)?;
    let discs = ParallelPlates::new(0.5, 0.125, 3.0)?;
    assert_close("discs", &[discs.with_slip(slip).torque(&fluid)?.value], &[discs.torque(&fluid)?.value], QUADRATURE);
    let cone = ConeAndPlate::new(0.5, 0.05, 3.0)?;
    assert_close("cone", &[cone.with_slip(slip).torque(&fluid)?.value], &[cone.torque(&fluid)?.value], QUADRATURE);
    let [slips, sticks] = [cone.with_slip(slip).thrust(&Normal)?.value, cone.thrust(&Normal)?.value];
    assert_close("thrust", &[slips], &[sticks], QUADRATURE);
    let annulus = Annulus::new(0.4, 1.0, 9.0)?;
    let [slips, sticks] = [annulus.with_slip(slip).discharge(&fluid)?.value, annulus.discharge(&fluid)?.value];
    assert_close("annulus", &[slips], &[sticks], QUADRATURE);
    Ok(())
}

/// Torques and discharges give back their drives, thrusts are those of the stresses.
fn consistent<F: ViscometricFluid>(fluid: &F, slip: WallSlip) -> Outcome {
    let inverse = Tol::stated(1e-9, "a solution and what it was made from");
    for speed in [3.0, -0.2] {
        let discs = ParallelPlates::new(0.5, 0.125, speed)?.with_slip(slip);
        let again = ParallelPlates::with_slip_and_torque(0.5, 0.125, slip, discs.torque(fluid)?.value, fluid)?;
        assert_close(F::NAME, &[again.speed()], &[speed], inverse);
        let cone = ConeAndPlate::new(0.5, 0.05, speed)?.with_slip(slip);
        let again = ConeAndPlate::with_slip_and_torque(0.5, 0.05, slip, cone.torque(fluid)?.value, fluid)?;
        assert_close(F::NAME, &[again.speed()], &[speed], inverse);
        let annulus = Annulus::new(0.4, 1.0, 10.0 * speed)?.with_slip(slip);
        let discharge = annulus.discharge(fluid)?.value;
        let again = Annulus::with_slip_and_discharge(0.4, 1.0, slip, discharge, fluid)?;
        assert_close(F::NAME, &[again.pressure_gradient()], &[10.0 * speed], inverse);
        let [inner, outer] = annulus.plug(fluid)?;
        let mut added = 0.0;
        for ends in [[0.4, inner], [inner, outer], [outer, 1.0]] {
            if ends[0] < ends[1] {
                added += quadrature::integrate(&ends, |r| Ok(2.0 * PI * r * annulus.velocity(fluid, r)?.value))?.value;
            }
        }
        assert_close(F::NAME, &[added], &[discharge], Tol::stated(1e-8, "kinks of the profile at the plug"));
        let walls = [0.4, 1.0].map(|r| annulus.velocity(fluid, r).map(|v| v.value.abs()));
        let stresses = [0.4, 1.0].map(|r| annulus.shear_stress(fluid, r).map(f64::abs));
        for (velocity, stress) in walls.into_iter().zip(stresses) {
            assert_close("slip", &[velocity?], &[slip.speed(stress?)], inverse);
        }
    }
    Ok(())
}

#[test]
fn drives_found_from_answers_of_fluids_that_slip_equal_the_drives() -> Outcome {
    for slip in [WallSlip::new(0.1, 1.0)?, WallSlip::new(0.05, 2.0)?] {
        consistent(&CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?, slip)?;
        consistent(&HerschelBulkley::new(0.4, 1.1, 0.5)?, slip)?;
        consistent(&Normal, slip)?;
    }
    Ok(())
}

#[test]
fn thrusts_of_fluids_that_slip_equal_the_integral_of_the_stresses() -> Outcome {
    let slip = WallSlip::new(0.1, 1.0)?;
    let discs = ParallelPlates::new(0.5, 0.125, 3.0)?.with_slip(slip);
    let cone = ConeAndPlate::new(0.5, 0.05, 3.0)?.with_slip(slip);
    let pressed = Tol::stated(1e-8, "integrals of integrals");
    let over_discs = quadrature::integrate(&[0.0, 0.5], |r| Ok(-2.0 * PI * r * discs.stresses(&Normal, r)?.gradient))?;
    assert_close("discs", &[over_discs.value], &[discs.thrust(&Normal)?.value], pressed);
    let over_cone = quadrature::integrate(&[0.0, 0.5], |r| {
        if r > 0.0 { Ok(-2.0 * PI * r * cone.stresses(&Normal, r)?.gradient) } else { Ok(0.0) }
    })?;
    assert_close("cone", &[over_cone.value], &[cone.thrust(&Normal)?.value], pressed);
    Ok(())
}

#[test]
fn fluids_that_slip_below_their_yield_stress_turn_and_move_as_plugs() -> Outcome {
    let (stiff, slip) = (Bingham::new(50.0, 1.0)?, WallSlip::new(0.02, 2.0)?);
    // τ = (Ω r/2b)^½: M = 2π R³ τ_R/3.5.
    let discs = ParallelPlates::new(0.5, 0.01, 4.0)?.with_slip(slip);
    let rim = (4.0_f64 * 0.5 / 0.04).sqrt();
    let exact = 2.0 * PI * 0.125 * rim / 3.5;
    assert_close("discs", &[discs.torque(&stiff)?.value], &[exact], Tol::ulps(16.0));
    let cone = ConeAndPlate::new(0.5, 0.05, 4.0)?.with_slip(slip);
    assert_close("cone", &[cone.torque(&stiff)?.value], &[exact], Tol::ulps(16.0));
    assert_close_at_scale("rate", &[cone.shear_rate(&stiff, 0.5)?], &[0.0], 1.0, Tol::ulps(0.0));
    let again = ConeAndPlate::with_slip_and_torque(0.5, 0.05, slip, exact, &stiff)?;
    assert_close("speed", &[again.speed()], &[4.0], QUADRATURE);
    // τ_w = ½ c (R₂ − R₁) at both walls.
    let annulus = Annulus::new(1.0, 2.0, -40.0)?.with_slip(slip);
    assert_close("annulus", &[annulus.velocity(&stiff, 1.5)?.value], &[-8.0], Tol::ulps(4.0));
    assert_close("annulus", &[annulus.discharge(&stiff)?.value], &[-24.0 * PI], Tol::ulps(8.0));
    let again = Annulus::with_slip_and_discharge(1.0, 2.0, slip, -24.0 * PI, &stiff)?;
    assert_close("drive", &[again.pressure_gradient()], &[-40.0], Tol::ulps(8.0));
    Ok(())
}

#[test]
fn a_narrow_annulus_that_slips_equals_a_channel_that_slips() -> Outcome {
    let (fluid, slip) = (CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?, WallSlip::new(1e-6, 1.5)?);
    let gap = 2.0_f64.powi(-16);
    let annulus = Annulus::new(1.0, 1.0 + gap, 8.0 / gap)?.with_slip(slip);
    let channel = Channel::new(0.5 * gap, 8.0 / gap)?.with_slip(slip);
    let around = channel.discharge(&fluid)?.value * 2.0 * PI * (1.0 + 0.5 * gap);
    let close = Tol::stated(gap * gap, "the curvature of the gap").or(Tol::stated(1e-10, "two quadratures"));
    assert_close("discharge", &[annulus.discharge(&fluid)?.value], &[around], close);
    Ok(())
}
