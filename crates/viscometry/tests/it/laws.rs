//! Identities of the flows.

use std::f64::consts::PI;

use piola_fluids::{
    Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, HerschelBulkley, Newtonian, OldroydB, Papanastasiou,
    PowerLaw, Sisko, ViscometricFluid,
};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use piola_viscometry::{
    Annulus, Channel, ConeAndPlate, Couette, Estimate, FallingFilm, ParallelPlates, PlaneCouette, Poiseuille, WallSlip,
    quadrature,
};
use proptest::prelude::*;

use super::fluids::{Normal, Numerical};
use super::numbers::equal;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const QUADRATURE: Tol = Tol::stated(1e-11, "two quadratures");
const INVERSE: Tol = Tol::stated(1e-10, "a solution and what it was made from");

/// One number beside another.
fn same(what: &str, actual: f64, expected: f64, tolerance: Tol) {
    assert_close(what, &[actual], &[expected], tolerance);
}

/// Fluids of every kind, of parameters about 1.
fn each_fluid(thinning: f64, yields: f64, mut visit: impl Visit) -> Outcome {
    visit.visit(&Newtonian::new(0.7)?)?;
    visit.visit(&PowerLaw::new(1.3, thinning)?)?;
    visit.visit(&CarreauYasuda::new(2.0, 0.05, 1.5, thinning.min(0.95), 1.25)?)?;
    visit.visit(&Bingham::new(yields, 0.7)?)?;
    visit.visit(&Casson::new(yields, 0.7)?)?;
    visit.visit(&HerschelBulkley::new(yields, 1.1, thinning)?)?;
    visit.visit(&Ellis::new(1.4, 0.8, 1.0 / thinning.min(1.0))?)?;
    visit.visit(&Sisko::new(0.1, 0.9, thinning)?)?;
    visit.visit(&OldroydB::new(0.2, 0.6, thinning)?)?;
    visit.visit(&Normal)
}

/// What is done with each fluid.
pub(super) trait Visit {
    fn visit<F: ViscometricFluid>(&mut self, fluid: &F) -> Outcome;
}

/// Q against the integral of v.
pub(super) struct ProfilesAdd {
    pub(super) drive: f64,
}

impl Visit for ProfilesAdd {
    fn visit<F: ViscometricFluid>(&mut self, fluid: &F) -> Outcome {
        let slip = WallSlip::new(0.1, 1.5)?;
        let pipe = Poiseuille::new(0.8, self.drive)?.with_slip(slip);
        let plug = pipe.plug_radius(fluid);
        let added = quadrature::integrate(&[plug, 0.8], |r| Ok(2.0 * PI * r * pipe.velocity(fluid, r)?.value))?;
        let rigid = PI * plug * plug * pipe.velocity(fluid, 0.0)?.value;
        same(F::NAME, added.value + rigid, pipe.discharge(fluid)?.value, QUADRATURE);

        let channel = Channel::new(0.8, self.drive)?.with_slip(slip);
        let plug = channel.plug_half_width(fluid);
        let added = quadrature::integrate(&[plug, 0.8], |x| Ok(2.0 * channel.velocity(fluid, x)?.value))?;
        let rigid = 2.0 * plug * channel.velocity(fluid, 0.0)?.value;
        same(F::NAME, added.value + rigid, channel.discharge(fluid)?.value, QUADRATURE);

        let film = FallingFilm::new(0.8, 1.0, self.drive, 1.1)?.with_slip(slip);
        let yields = 0.8 - film.plug_thickness(fluid);
        let added = quadrature::integrate(&[0.0, yields], |x| Ok(film.velocity(fluid, x)?.value))?;
        let rigid = (0.8 - yields) * film.velocity(fluid, 0.8)?.value;
        same(F::NAME, added.value + rigid, film.discharge(fluid)?.value, QUADRATURE);

        // The speeds of cylinders add up from the rates, the torque of discs from the stresses.
        let couette = Couette::new(0.4, 0.8, self.drive)?;
        let ends = couette.yield_radius(fluid).unwrap_or(0.8);
        let added = quadrature::integrate(&[0.4, ends], |r| Ok(couette.shear_rate(fluid, r)? / r))?;
        same(F::NAME, added.value, couette.speed_difference(fluid)?.value, QUADRATURE);
        let discs = ParallelPlates::new(0.8, 0.1, self.drive)?;
        let added = quadrature::integrate(&[0.0, 1e-6, 1e-3, 0.05, 0.8], |r| {
            Ok(2.0 * PI * r * r * discs.shear_stress(fluid, r)?)
        })?;
        same(F::NAME, added.value, discs.torque(fluid)?.value, QUADRATURE);
        Ok(())
    }
}

/// The answers of every flow change sign with the drive; normal stresses do not.
pub(super) struct Odd {
    pub(super) drive: f64,
}

impl Visit for Odd {
    fn visit<F: ViscometricFluid>(&mut self, fluid: &F) -> Outcome {
        let slip = WallSlip::new(0.1, 1.5)?;
        let pipes = [1.0, -1.0].map(|sign| Poiseuille::new(0.8, sign * self.drive).map(|flow| flow.with_slip(slip)));
        let [pipe, back] = pipes;
        let (pipe, back) = (pipe?, back?);
        assert_eq!(pipe.discharge(fluid)?, Estimate { value: -back.discharge(fluid)?.value, ..pipe.discharge(fluid)? });
        equal([pipe.velocity(fluid, 0.3)?.value], [-back.velocity(fluid, 0.3)?.value]);
        let (there, here) = (pipe.stresses(fluid, 0.5, 0.0)?, back.stresses(fluid, 0.5, 0.0)?);
        equal([there.shear, there.gradient, there.flow], [-here.shear, here.gradient, here.flow]);
        let [couette, back] = [Couette::new(0.5, 1.0, self.drive)?, Couette::new(0.5, 1.0, -self.drive)?];
        equal([couette.speed_difference(fluid)?.value], [-back.speed_difference(fluid)?.value]);
        let (there, here) = (couette.stresses(fluid, 0.7)?, back.stresses(fluid, 0.7)?);
        equal([there.shear, there.gradient, there.flow], [-here.shear, here.gradient, here.flow]);
        let [annulus, back] = [Annulus::new(0.5, 1.0, 9.0)?, Annulus::new(0.5, 1.0, -9.0)?];
        equal([annulus.discharge(fluid)?.value], [-back.discharge(fluid)?.value]);
        let [discs, back] = [ParallelPlates::new(0.5, 0.1, 3.0)?, ParallelPlates::new(0.5, 0.1, -3.0)?];
        equal([discs.torque(fluid)?.value], [-back.torque(fluid)?.value]);
        assert_eq!(discs.thrust(fluid)?, back.thrust(fluid)?);
        let [channel, back] = [Channel::new(0.8, self.drive)?, Channel::new(0.8, -self.drive)?];
        equal([channel.discharge(fluid)?.value], [-back.discharge(fluid)?.value]);
        let (there, here) = (channel.stresses(fluid, 0.5, 0.0)?, back.stresses(fluid, 0.5, 0.0)?);
        equal([there.shear, there.gradient, there.flow], [-here.shear, here.gradient, here.flow]);
        let [plane, back] = [PlaneCouette::new(0.8, self.drive)?, PlaneCouette::new(0.8, -self.drive)?];
        let (there, here) = (plane.stresses(fluid)?, back.stresses(fluid)?);
        equal([there.shear, there.flow, there.neutral], [-here.shear, here.flow, here.neutral]);
        let [cone, back] = [ConeAndPlate::new(0.8, 0.05, self.drive)?, ConeAndPlate::new(0.8, 0.05, -self.drive)?];
        equal(
            [cone.torque(fluid)?.value, cone.thrust(fluid)?.value],
            [-back.torque(fluid)?.value, back.thrust(fluid)?.value],
        );
        Ok(())
    }
}

/// A drive that was found, within the error that is stated, which is small.
fn off(what: &str, found: f64, drive: f64, error: f64) {
    assert!((found - drive).abs() <= error, "{what}: {found:e} is off {drive:e} by more than {error:e}");
    // Ten times what two answers may differ by: the bound is not idle.
    assert!(error <= INVERSE.times(10.0).value() * drive.abs(), "{what}: {error:e} of {drive:e}");
}

/// Given the answer, the drive.
pub(super) struct Inverses {
    pub(super) drive: f64,
}

impl Visit for Inverses {
    fn visit<F: ViscometricFluid>(&mut self, fluid: &F) -> Outcome {
        for slip in [WallSlip::NONE, WallSlip::new(0.3, 1.5)?] {
            let pipe = Poiseuille::new(0.8, -self.drive)?.with_slip(slip);
            let discharge = pipe.discharge(fluid)?.value;
            let again = Poiseuille::with_slip_and_discharge(0.8, slip, discharge, fluid)?;
            same(F::NAME, again.pressure_gradient(), pipe.pressure_gradient(), INVERSE);
            let error = again.pressure_gradient_error(fluid, discharge)?;
            off(F::NAME, again.pressure_gradient(), pipe.pressure_gradient(), error);
            let channel = Channel::new(0.8, self.drive)?.with_slip(slip);
            let discharge = channel.discharge(fluid)?.value;
            let again = Channel::with_slip_and_discharge(0.8, slip, discharge, fluid)?;
            same(F::NAME, again.pressure_gradient(), channel.pressure_gradient(), INVERSE);
            let error = again.pressure_gradient_error(fluid, discharge)?;
            off(F::NAME, again.pressure_gradient(), channel.pressure_gradient(), error);
            let couette = Couette::new(0.6, 0.8, self.drive)?.with_slip(slip);
            let difference = couette.speed_difference(fluid)?.value;
            let again = Couette::with_slip_and_speed_difference(0.6, 0.8, slip, difference, fluid)?;
            same(F::NAME, again.moment(), couette.moment(), INVERSE);
            off(F::NAME, again.moment(), couette.moment(), again.moment_error(fluid, difference)?);
            let plane = PlaneCouette::new(0.6, self.drive)?.with_slip(slip);
            let stress = plane.shear_stress(fluid)?;
            let speed = 0.6 * fluid.shear_rate(stress)? + 2.0 * slip.speed(stress);
            same(F::NAME, speed, plane.speed(), INVERSE);
        }
        let cone = ConeAndPlate::new(0.6, 0.05, self.drive)?;
        let torque = cone.torque(fluid)?.value;
        let again = ConeAndPlate::with_torque(0.6, 0.05, torque, fluid)?;
        same(F::NAME, again.speed(), cone.speed(), INVERSE);
        off(F::NAME, again.speed(), cone.speed(), again.speed_error(fluid, torque)?);
        let discs = ParallelPlates::new(0.6, 0.05, -self.drive)?;
        let torque = discs.torque(fluid)?.value;
        let again = ParallelPlates::with_torque(0.6, 0.05, torque, fluid)?;
        same(F::NAME, again.speed(), discs.speed(), INVERSE);
        off(F::NAME, again.speed(), discs.speed(), again.speed_error(fluid, torque)?);
        let film = FallingFilm::new(0.3, 2.0, self.drive, 1.1)?;
        let discharge = film.discharge(fluid)?.value;
        let again = FallingFilm::with_discharge(discharge, 2.0, self.drive, 1.1, fluid)?;
        same(F::NAME, again.thickness(), film.thickness(), INVERSE);
        off(F::NAME, again.thickness(), film.thickness(), again.thickness_error(fluid, discharge)?);
        Ok(())
    }
}

/// Radial momentum, `∂T_rr/∂r + (T_rr − T_θθ)/r + ρ r ω² = 0`, and its kin, added up between two radii.
pub(super) struct Momentum {
    pub(super) drive: f64,
}

impl Visit for Momentum {
    fn visit<F: ViscometricFluid>(&mut self, fluid: &F) -> Outcome {
        let [a, b] = [0.45, 0.95];
        let couette = Couette::new(0.4, 1.0, self.drive)?.with_density(1.3)?.with_inner_speed(0.5)?;
        // The yield radius is a kink of the stresses.
        let kink = couette.yield_radius(fluid).map_or(a, |radius| radius.clamp(a, b));
        let mut force = 0.0;
        for ends in [[a, kink], [kink, b]] {
            if ends[0] < ends[1] {
                force += quadrature::integrate(&ends, |r| {
                    let at = couette.stresses(fluid, r)?;
                    Ok((at.gradient - at.flow) / r + 1.3 * r * couette.angular_velocity(fluid, r)?.value.powi(2))
                })?
                .value;
            }
        }
        let gained = couette.stresses(fluid, b)?.gradient - couette.stresses(fluid, a)?.gradient;
        assert_close_at_scale(F::NAME, &[gained + force], &[0.0], force.abs(), QUADRATURE);
        let circumference = |r: f64| couette.shear_stress(r).map(|stress| stress * r * r);
        same(F::NAME, circumference(a)?, circumference(b)?, Tol::ulps(8.0));

        let pipe = Poiseuille::new(1.0, 3.0 * self.drive)?;
        let kink = pipe.plug_radius(fluid).clamp(a, b);
        let mut force = 0.0;
        for ends in [[a, kink], [kink, b]] {
            if ends[0] < ends[1] {
                force += quadrature::integrate(&ends, |r| {
                    let at = pipe.stresses(fluid, r, 0.0)?;
                    Ok((at.gradient - at.neutral) / r)
                })?
                .value;
            }
        }
        let gained = pipe.stresses(fluid, b, 0.0)?.gradient - pipe.stresses(fluid, a, 0.0)?.gradient;
        assert_close_at_scale(F::NAME, &[gained + force], &[0.0], force.abs(), QUADRATURE);
        let along = pipe.stresses(fluid, a, 1.0)?.flow - pipe.stresses(fluid, a, 0.0)?.flow;
        let across = (b * pipe.shear_stress(b)? - a * pipe.shear_stress(a)?) / (0.5 * (b * b - a * a));
        same(F::NAME, across, -along, Tol::stated(1e-12, "a difference of stresses along the pipe"));

        // ∂T₁₂/∂x₁ + ∂T₂₂/∂x₂ = 0, and T₁₁ does not change across.
        let channel = Channel::new(1.0, self.drive)?;
        let [near, far] = [channel.stresses(fluid, a, 0.0)?, channel.stresses(fluid, b, 0.0)?];
        let along = channel.stresses(fluid, a, 1.0)?.flow - near.flow;
        same(F::NAME, (far.shear - near.shear) / (b - a), -along, Tol::stated(1e-12, "differences of stresses"));
        equal([near.gradient], [far.gradient]);
        // A film is held by its weight along the wall and across.
        let film = FallingFilm::new(1.0, 2.0, self.drive, 1.1)?;
        let [near, far] = [film.stresses(fluid, a)?, film.stresses(fluid, b)?];
        let close = Tol::stated(1e-12, "differences of stresses");
        same(F::NAME, (far.shear - near.shear) / (b - a), -2.0 * self.drive * 1.1_f64.sin(), close);
        same(F::NAME, (far.gradient - near.gradient) / (b - a), 2.0 * self.drive * 1.1_f64.cos(), close);

        let discs = ParallelPlates::new(1.0, 0.1, self.drive)?;
        let force = quadrature::integrate(&[a, b], |r| {
            let at = discs.stresses(fluid, r)?;
            Ok((at.neutral - at.flow) / r)
        })?
        .value;
        let gained = discs.stresses(fluid, b)?.neutral - discs.stresses(fluid, a)?.neutral;
        assert_close_at_scale(F::NAME, &[gained + force], &[0.0], force.abs(), QUADRATURE);
        let thrust = quadrature::integrate(&[0.0, 1.0], |r| Ok(-2.0 * PI * r * discs.stresses(fluid, r)?.gradient))?;
        assert_close_at_scale(F::NAME, &[thrust.value], &[discs.thrust(fluid)?.value], force.abs(), QUADRATURE);

        let cone = ConeAndPlate::new(1.0, 0.1, self.drive)?;
        // In ln r, so that the logarithm at the apex is a straight line.
        let thrust = quadrature::integrate(&[0.0, 2.0, 6.0, 20.0], |x| {
            let r = (-x).exp();
            Ok(-2.0 * PI * r * r * cone.stresses(fluid, r)?.gradient)
        })?;
        let pressed = cone.stresses(fluid, 1.0)?.gradient.abs().max(1e-300);
        let apex = Tol::stated(1e-10, "the apex is left out");
        assert_close_at_scale(F::NAME, &[thrust.value], &[cone.thrust(fluid)?.value], pressed, apex);
        Ok(())
    }
}

/// The annulus, whose place of rest is sought anew for each answer: the profile adds up, rings are in balance, the drive is found.
pub(super) struct Annular {
    pub(super) drive: f64,
}

impl Visit for Annular {
    fn visit<F: ViscometricFluid>(&mut self, fluid: &F) -> Outcome {
        let annulus = Annulus::new(0.4, 1.0, 4.0 * self.drive)?;
        let [inner, outer] = annulus.plug(fluid)?;
        let flow = |r: f64| Ok(2.0 * PI * r * annulus.velocity(fluid, r)?.value);
        let mut added = 0.0;
        for ends in [[0.4, inner], [inner, outer], [outer, 1.0]] {
            if ends[0] < ends[1] {
                added += quadrature::integrate(&ends, flow)?.value;
            }
        }
        same(F::NAME, added, annulus.discharge(fluid)?.value, Tol::stated(1e-9, "kinks of the profile at the plug"));
        let [a, b] = [0.45, 0.95];
        let [inner, outer] = [inner, outer].map(|radius: f64| radius.clamp(a, b));
        let mut force = 0.0;
        for ends in [[a, inner], [inner, outer], [outer, b]] {
            if F::NORMAL_STRESSES && ends[0] < ends[1] {
                force += quadrature::integrate(&ends, |r| {
                    let at = annulus.stresses(fluid, r, 0.0)?;
                    Ok((at.gradient - at.neutral) / r)
                })?
                .value;
            }
        }
        let gained = annulus.stresses(fluid, b, 0.0)?.gradient - annulus.stresses(fluid, a, 0.0)?.gradient;
        assert_close_at_scale(F::NAME, &[gained + force], &[0.0], force.abs(), QUADRATURE);

        let annulus = Annulus::new(0.4, 1.0, -4.0 * self.drive)?;
        let discharge = annulus.discharge(fluid)?.value;
        let again = Annulus::with_discharge(0.4, 1.0, discharge, fluid)?;
        same(F::NAME, again.pressure_gradient(), annulus.pressure_gradient(), INVERSE);
        let error = again.pressure_gradient_error(fluid, discharge)?;
        off(F::NAME, again.pressure_gradient(), annulus.pressure_gradient(), error);
        Ok(())
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2))]

    #[test]
    fn the_answers_of_an_annulus_equal_one_another(drive in 2.0..30.0, n in 0.2..1.8, yields in 0.05..0.6) {
        each_fluid(n, yields, Annular { drive }).expect("flows");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn the_discharge_equals_the_integral_of_the_profile(drive in 2.0..30.0, n in 0.2..1.8, yields in 0.05..0.6) {
        each_fluid(n, yields, ProfilesAdd { drive }).expect("flows");
    }

    #[test]
    fn answers_to_the_opposite_drive_equal_the_opposite_answers(drive in 0.1..30.0, n in 0.2..1.8, yields in 0.05..0.6) {
        each_fluid(n, yields, Odd { drive }).expect("flows");
    }

    #[test]
    fn the_drive_found_from_an_answer_equals_the_drive(drive in 2.0..30.0, n in 0.2..1.8, yields in 0.05..0.6) {
        each_fluid(n, yields, Inverses { drive }).expect("flows");
    }

    #[test]
    fn what_drives_a_ring_of_fluid_equals_zero(drive in 2.0..30.0, n in 0.2..1.8, yields in 0.05..0.6) {
        each_fluid(n, yields, Momentum { drive }).expect("flows");
    }
}

/// A pair of numbers, within the sum of their errors.
fn within(what: &str, one: Estimate, other: Estimate) {
    // Four roundings for the factors of each.
    let allowed = one.error + other.error + 8.0 * f64::EPSILON * one.value.abs();
    assert!((one.value - other.value).abs() <= allowed, "{what}: {one:?} {other:?}");
}

/// Closed forms and quadratures, each with its error.
fn closed_within_errors<F: ViscometricFluid + Copy>(fluid: F, drive: f64) -> Outcome {
    let numerical = Numerical(fluid);
    let pipe = Poiseuille::new(0.8, drive)?;
    within(F::NAME, pipe.discharge(&fluid)?, pipe.discharge(&numerical)?);
    for r in [0.0, 0.1, 0.5, 0.799_999] {
        within(F::NAME, pipe.velocity(&fluid, r)?, pipe.velocity(&numerical, r)?);
    }
    let channel = Channel::new(0.8, drive)?;
    within(F::NAME, channel.discharge(&fluid)?, channel.discharge(&numerical)?);
    for outer in [0.500_001, 0.51, 0.6, 5.0] {
        let couette = Couette::new(0.5, outer, drive)?;
        within(F::NAME, couette.speed_difference(&fluid)?, couette.speed_difference(&numerical)?);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn closed_forms_equal_quadratures_within_the_errors_of_both(
        drive in 0.5..300.0, n in 0.2..2.0, yields in 0.05..0.3
    ) {
        closed_within_errors(Newtonian::new(n)?, drive).expect("flows");
        closed_within_errors(PowerLaw::new(1.3, n)?, drive).expect("flows");
        closed_within_errors(Bingham::new(yields, 0.7)?, drive).expect("flows");
        closed_within_errors(Casson::new(yields, 0.7)?, drive).expect("flows");
        closed_within_errors(HerschelBulkley::new(yields, 1.1, n)?, drive).expect("flows");
        closed_within_errors(Sisko::new(0.1, 0.9, n)?, drive).expect("flows");
    }

    #[test]
    fn a_narrow_couette_gap_equals_plane_couette_flow(exponent in -9.0..-3.0, n in 0.2..2.0, stress in 0.5..20.0) {
        let share = 10.0_f64.powf(exponent);
        let fluid = HerschelBulkley::new(0.3, 1.1, n)?;
        let outer = 0.8 * (1.0 + share);
        let gap = outer - 0.8;
        let couette = Couette::new(0.8, outer, stress * 2.0 * PI * 0.64)?;
        let speed = couette.speed_difference(&fluid)?.value * 0.8;
        let plane = PlaneCouette::with_shear_stress(gap, stress, &fluid)?;
        // d ln ζ/d ln s over half of the stresses' width 2 share, and the mean radius.
        let condition = stress / (stress - 0.3) / n + 2.0;
        same("speed", speed, plane.speed(), Tol::stated(2.0 * share, "the curvature of the gap").times(condition));
    }

    #[test]
    fn a_narrow_annulus_equals_a_channel(exponent in -7.0..-3.0, n in 0.2..2.0, drive in 2.0..30.0) {
        let share = 10.0_f64.powf(exponent);
        let fluid = PowerLaw::new(1.1, n)?;
        let gap = 0.8 * share;
        let annulus = Annulus::new(0.8, 0.8 + gap, drive / gap)?;
        let gap = (0.8 + gap) - 0.8;
        let channel = Channel::new(0.5 * gap, drive / (0.8 * share))?;
        let around = channel.discharge(&fluid)?.value * (2.0 * PI * (0.8 + 0.5 * gap));
        let tolerance = Tol::stated(share * share, "the curvature of the gap").times(1.0 + 1.0 / n).or(QUADRATURE);
        same("discharge", annulus.discharge(&fluid)?.value, around, tolerance);
    }
}

/// All flows of two fluids that should be one.
fn same_flows<F: ViscometricFluid, G: ViscometricFluid>(one: &F, other: &G) -> Outcome {
    const CLOSE: Tol = Tol::stated(1e-12, "the same fluid in other words");
    let what = F::NAME;
    let pipe = Poiseuille::new(0.8, 3.0)?;
    same(what, pipe.discharge(one)?.value, pipe.discharge(other)?.value, CLOSE);
    same(what, pipe.velocity(one, 0.2)?.value, pipe.velocity(other, 0.2)?.value, CLOSE);
    let channel = Channel::new(0.8, 3.0)?;
    same(what, channel.discharge(one)?.value, channel.discharge(other)?.value, CLOSE);
    let film = FallingFilm::new(0.2, 2.0, 9.8, 0.4)?;
    same(what, film.discharge(one)?.value, film.discharge(other)?.value, CLOSE);
    let couette = Couette::new(0.8, 0.9, 3.0)?;
    same(what, couette.speed_difference(one)?.value, couette.speed_difference(other)?.value, CLOSE);
    let plane = PlaneCouette::new(0.8, 3.0)?;
    same(what, plane.shear_stress(one)?, plane.shear_stress(other)?, CLOSE);
    let cone = ConeAndPlate::new(0.8, 0.05, 3.0)?;
    same(what, cone.torque(one)?.value, cone.torque(other)?.value, CLOSE);
    let discs = ParallelPlates::new(0.8, 0.05, 3.0)?;
    same(what, discs.torque(one)?.value, discs.torque(other)?.value, CLOSE);
    let annulus = Annulus::new(0.8, 0.9, 3.0)?;
    same(what, annulus.discharge(one)?.value, annulus.discharge(other)?.value, CLOSE);
    Ok(())
}

#[test]
fn flows_of_newtonian_limits_equal_those_of_the_newtonian_fluid() -> Outcome {
    let newtonian = Newtonian::new(0.7)?;
    same_flows(&PowerLaw::new(0.7, 1.0)?, &newtonian)?;
    same_flows(&CarreauYasuda::new(0.7, 0.1, 1.5, 1.0, 2.0)?, &newtonian)?;
    same_flows(&Bingham::new(0.0, 0.7)?, &newtonian)?;
    same_flows(&Casson::new(0.0, 0.7)?, &newtonian)?;
    same_flows(&HerschelBulkley::new(0.0, 0.7, 1.0)?, &newtonian)?;
    same_flows(&Sisko::new(0.7, 0.0, 0.5)?, &newtonian)?;
    // η∞ = η₀, or no time in which to thin.
    same_flows(&Cross::new(0.7, 0.7, 1.5, 0.5)?, &newtonian)?;
    same_flows(&Cross::new(0.7, 0.1, 0.0, 0.5)?, &newtonian)?;
    // α = 1 halves the viscosity at every stress; a half stress that is never reached leaves it.
    same_flows(&Ellis::new(1.4, 0.8, 1.0)?, &newtonian)?;
    same_flows(&Ellis::new(0.7, 1e20, 2.0)?, &newtonian)?;
    // τ₀ arsinh λk = τ₀ λ k (1 − (λk)²/6 …).
    same_flows(&Eyring::new(0.7e8, 1e-8)?, &newtonian)?;
    same_flows(&Papanastasiou::new(0.0, 0.7, 1.0, 100.0)?, &newtonian)?;
    same_flows(&Papanastasiou::new(0.3, 0.7, 1.0, 1e-14)?, &newtonian)?;
    same_flows(&OldroydB::new(0.3, 0.4, 2.0)?, &newtonian)
}

#[test]
fn newtonian_discharges_equal_hagen_poiseuille_and_the_annulus_of_lamb() -> Outcome {
    const CLOSE: Tol = Tol::stated(1e-13, "closed forms");
    let oil = Newtonian::new(0.7)?;
    same("pipe", Poiseuille::new(0.8, 3.0)?.discharge(&oil)?.value, PI * 3.0 * 0.8_f64.powi(4) / 5.6, CLOSE);
    same("channel", Channel::new(0.8, 3.0)?.discharge(&oil)?.value, 2.0 * 3.0 * 0.8_f64.powi(3) / 2.1, CLOSE);
    let annulus = Annulus::new(0.4, 1.0, 3.0)?;
    let squares: f64 = 1.0 - 0.16;
    let lamb = PI * 3.0 / 5.6 * (1.0 - 0.4_f64.powi(4) - squares * squares / 2.5_f64.ln());
    same("annulus", annulus.discharge(&oil)?.value, lamb, Tol::stated(1e-12, "differences of the formula"));
    Ok(())
}

#[test]
fn what_an_observer_on_the_inner_cylinder_sees_equals_what_one_at_rest_does() -> Outcome {
    let [still, turning] =
        [0.0, 3.0].map(|speed| Couette::new(0.5, 0.8, 2.0).and_then(|flow| flow.with_inner_speed(speed)));
    let (still, turning) = (still?, turning?);
    for r in [0.5, 0.6, 0.8] {
        assert_eq!(turning.stresses(&Normal, r)?, still.stresses(&Normal, r)?);
        let seen = turning.angular_velocity(&Normal, r)?.value - 3.0;
        assert_close_at_scale("ω", &[seen], &[still.angular_velocity(&Normal, r)?.value], 3.0, Tol::ulps(4.0));
    }
    assert_eq!(turning.speed_difference(&Normal)?, still.speed_difference(&Normal)?);
    Ok(())
}

#[test]
fn dissipation_equals_the_power_of_the_drive_and_the_integral_of_stress_and_rate() -> Outcome {
    let fluid = Casson::new(0.3, 0.7)?;
    let pipe = Poiseuille::new(0.8, 5.0)?;
    let plug = pipe.plug_radius(&fluid);
    let power = quadrature::integrate(&[plug, 0.8], |r| {
        Ok(2.0 * PI * r * pipe.shear_stress(r)? * pipe.shear_rate(&fluid, r)?)
    })?;
    same("pipe", power.value, pipe.dissipation(&fluid)?.value, QUADRATURE);
    let couette = Couette::new(0.5, 0.8, 5.0)?;
    let power = quadrature::integrate(&[0.5, 0.8], |r| {
        Ok(2.0 * PI * r * couette.shear_stress(r)? * couette.shear_rate(&fluid, r)?)
    })?;
    same("Couette", power.value, couette.dissipation(&fluid)?.value, QUADRATURE);
    Ok(())
}
