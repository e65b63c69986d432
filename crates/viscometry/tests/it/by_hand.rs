//! Flows of a fluid with two normal stress differences, and the thrust of inertia, against integrals by hand.
//!
//! The second-order fluid with μ = 2, α₁ = −½, α₂ = ¾: ζ = s/2, σ₁ = −¼ k², σ₂ = ¾ k², N₁ = k², N₂ = −¼ k².

use std::f64::consts::PI;

use piola_fluids::{Bingham, Newtonian, SecondOrder, ViscometricFluid};
use piola_testkit::{Tol, assert_close, assert_each_close};
use piola_viscometry::{Channel, ConeAndPlate, Couette, ParallelPlates, Poiseuille, Stresses};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Some ten operations on numbers of one size.
const CLOSED: Tol = Tol::ulps(8.0);

fn fluid() -> SecondOrder {
    SecondOrder::new(2.0, -0.5, 0.75).expect("bounds")
}

/// T₁₂, T₁₁, T₂₂, T₃₃.
fn four(stresses: &Stresses) -> [f64; 4] {
    [stresses.shear, stresses.gradient, stresses.flow, stresses.neutral]
}

#[test]
fn channel_with_normal_stresses_equals_values_by_hand() -> Outcome {
    // c = 4, d = 3/2: k = −2 x₁.
    let (fluid, channel) = (fluid(), Channel::new(1.5, 4.0)?);
    for (x1, rate) in [(0.5, -1.0), (-0.5, 1.0), (1.5, -3.0), (0.0, 0.0)] {
        let square = rate * rate;
        for x2 in [0.0, 3.0, -0.5] {
            // T₁₁ = c x₂, T₃₃ = T₁₁ − σ₁, T₂₂ = T₃₃ + σ₂.
            let expected = [-4.0 * x1, 4.0 * x2, 4.0 * x2 + square, 4.0 * x2 + 0.25 * square];
            let found = channel.stresses(&fluid, x1, x2)?;
            assert_each_close(&format!("T at {x1}, {x2}"), &four(&found), &expected, CLOSED);
        }
        assert_each_close("dv/dx₁", &[channel.shear_rate(&fluid, x1)?], &[rate], CLOSED);
        // v = c (d² − x₁²)/(2 μ).
        assert_each_close("v", &[channel.velocity(&fluid, x1)?.value], &[2.25 - x1 * x1], CLOSED);
    }
    // Q = 2 c d³/(3 μ), and −T₁₁ at the walls.
    assert_each_close("Q", &[channel.discharge(&fluid)?.value], &[4.5], CLOSED);
    assert_each_close("p", &[channel.wall_pressure(3.0)], &[-12.0], CLOSED);
    assert_each_close("c Q", &[channel.dissipation(&fluid)?.value], &[18.0], CLOSED);
    // The other way round: the same speeds backwards, the same normal stresses at x₂ = 0.
    let back = Channel::new(1.5, -4.0)?;
    let found = back.stresses(&fluid, 0.5, 3.0)?;
    assert_each_close("backwards", &four(&found), &[2.0, -12.0, -11.0, -11.75], CLOSED);
    assert_each_close("backwards", &[back.velocity(&fluid, 0.5)?.value], &[-2.0], CLOSED);
    Ok(())
}

#[test]
fn pipe_with_normal_stresses_equals_values_by_hand() -> Outcome {
    // c = 8, R = 2: k = −2 r.
    let (fluid, pipe) = (fluid(), Poiseuille::new(2.0, 8.0)?);
    for (r, z) in [(1.0, 0.0), (1.0, 0.5), (2.0, -1.0), (0.5, 3.0)] {
        let square = 4.0 * r * r;
        // T_rr = c z + ∫ σ₁ dξ/ξ from r to R = c z − ½ (R² − r²), T_θθ = T_rr − σ₁, T_zz = T_θθ + σ₂.
        let radial = 8.0 * z - 0.5 * (4.0 - r * r);
        let hoop = radial + 0.25 * square;
        let expected = [-4.0 * r, radial, hoop + 0.75 * square, hoop];
        let found = pipe.stresses(&fluid, r, z)?;
        // T_rr and c z cancel in part.
        assert_close(&format!("T at {r}, {z}"), &four(&found), &expected, CLOSED);
    }
    Ok(())
}

#[test]
fn couette_flow_with_normal_stresses_equals_values_by_hand() -> Outcome {
    // M = 16 π: T_rθ = 8/r², k = 4/r², ω = ω₁ + 2 (1 − 1/r²) between the radii 1 and 2.
    let (fluid, couette) = (fluid(), Couette::new(1.0, 2.0, 16.0 * PI)?.with_inner_speed(-2.0)?.with_density(3.0)?);
    for r in [1.0, 1.25, 2.0_f64] {
        let square = 16.0 * r.powi(-4);
        // ∫ (σ₂ − σ₁) dξ/ξ = 4 (1 − r⁻⁴); ω = −2/r²: ∫ρ ξ ω² dξ = 6 (1 − r⁻²).
        let radial = 4.0 * (1.0 - r.powi(-4)) - 6.0 * (1.0 - r.powi(-2));
        let axial = radial + 0.25 * square;
        let expected = [8.0 * r.powi(-2), radial, axial + 0.75 * square, axial];
        let found = couette.stresses(&fluid, r)?;
        // The centrifugal part is a quadrature.
        assert_close(&format!("T at {r}"), &four(&found), &expected, Tol::ulps(32.0));
        assert_close("ω", &[couette.angular_velocity(&fluid, r)?.value], &[-2.0 * r.powi(-2)], CLOSED);
    }
    Ok(())
}

/// Inertia turns the fluid over within the gap: ρ v²/r drives it outwards where it is fast, and the pressure inwards elsewhere. With
/// s the share of the height and h the gap, the radial velocity u obeys μ u″/h² = p′ − ρ v²/r and u = 0 at both plates. What passes a
/// cylinder is none: ∫ u ds = 0, so that the pressure is the mean of ρ v²/r by the weight 6 s (1 − s),
///
/// ```text
/// p′ = 6 ρ/r ∫ v² s (1 − s) ds        F = ∫ 2π r p dr = −π ∫ r² p′ dr
/// ```
/// and with v = Ω r s: p′ = 6 (1/4 − 1/5) ρ Ω² r = 3/10 ρ Ω² r, F = −3/40 π ρ Ω² R⁴. The plain mean of v² would give −1/12.
#[test]
fn thrust_of_inertia_equals_the_integral_of_the_pressure_that_lets_no_fluid_pass() -> Outcome {
    // Gauss and Legendre with three nodes on [0, 1]: exact up to the fifth power, and these are of the fourth and third.
    let node = 0.5 * 0.6_f64.sqrt();
    let rule = [(0.5 - node, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + node, 5.0 / 18.0)];
    let fluid = Newtonian::new(0.75)?;
    for (radius, angle, speed, density) in [(0.5, 0.0625, 3.0, 1250.0), (2.0, 0.02, -0.25, 0.5)] {
        let cone = ConeAndPlate::new(radius, angle, speed)?;
        let mut thrust = 0.0;
        for (x, across) in rule {
            let r = radius * x;
            let mut slope = 0.0;
            for (s, weight) in rule {
                slope += weight * 6.0 * density / r * cone.velocity(&fluid, r, s)?.powi(2) * s * (1.0 - s);
            }
            thrust -= across * radius * PI * r * r * slope;
        }
        assert_each_close("F", &[cone.thrust_of_inertia(density)?], &[thrust], Tol::ulps(16.0));
    }
    // In whole numbers: ρ = 40, Ω = 2, R = 1: F = −12 π, towards each other whichever way it turns.
    for speed in [2.0, -2.0] {
        let found = ConeAndPlate::new(1.0, 0.1, speed)?.thrust_of_inertia(40.0)?;
        assert_each_close("−3/40 π ρ Ω² R⁴", &[found], &[-12.0 * PI], Tol::ulps(2.0));
    }
    assert!(ConeAndPlate::new(1.0, 0.1, 2.0)?.thrust_of_inertia(0.0).is_err());
    assert!(ConeAndPlate::new(1.0, 0.1, 2.0)?.thrust_of_inertia(f64::NAN).is_err());
    Ok(())
}

/// Torque 2π R³ τ/3 and thrust ½ π R² N₁ of the cone at k = Ω/α; both normal stresses have one sign each way round.
#[test]
fn cone_with_normal_stresses_equals_values_by_hand() -> Outcome {
    let fluid = fluid();
    for sign in [1.0, -1.0] {
        let cone = ConeAndPlate::new(0.5, 0.125, sign * 0.25)?;
        assert_each_close("k", &[cone.nominal_shear_rate()], &[sign * 2.0], CLOSED);
        assert_each_close("τ", &[fluid.shear_stress(sign * 2.0)], &[sign * 4.0], CLOSED);
        assert_each_close("M", &[cone.torque(&fluid)?.value], &[sign * PI / 3.0], CLOSED);
        assert_each_close("F", &[cone.thrust(&fluid)?.value], &[0.5 * PI], CLOSED);
    }
    Ok(())
}

#[test]
fn velocity_between_discs_equals_the_rate_times_the_height() -> Outcome {
    // R = 2, h = 1/2, Ω = 3: v = Ω r z/h.
    let discs = ParallelPlates::new(2.0, 0.5, 3.0)?;
    for (r, share, velocity) in [(1.0, 0.25, 0.75), (2.0, 0.5, 3.0), (0.5, 1.0, 1.5), (1.5, 0.0, 0.0)] {
        assert_each_close("v", &[discs.velocity(&fluid(), r, share)?], &[velocity], CLOSED);
    }
    Ok(())
}

/// Bingham's fluid with `τ_y` = 1 and μ = 2 between cylinders of radii 1 and 2: T₁ = 2.25, so that it turns rigidly beyond r = 3/2.
#[test]
fn centrifugal_pressure_and_its_error_scale_with_the_unit_of_time() -> Outcome {
    let difference = |unit: f64| -> Result<_, Box<dyn std::error::Error>> {
        let fluid = Bingham::new(unit * unit, 2.0 * unit)?;
        let couette =
            Couette::new(1.0, 2.0, 4.5 * PI * unit * unit)?.with_inner_speed(0.25 * unit)?.with_density(3.0)?;
        Ok(couette.radial_difference(&fluid)?)
    };
    let expected = difference(1.0)?;
    assert!(expected.value < 0.0 && 0.0 < expected.error);
    // Powers of two leave all digits as they are.
    for unit in [1024.0, 1.0 / 1024.0] {
        let found = difference(unit)?;
        let square = unit * unit;
        let scaled = [square * expected.value, square * expected.error];
        assert_each_close("T_rr(R₂) − T_rr(R₁)", &[found.value, found.error], &scaled, Tol::ulps(64.0));
    }
    Ok(())
}
