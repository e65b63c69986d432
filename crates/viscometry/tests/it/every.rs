//! Every flow of every fluid: forces balance at points, stresses are those of the fluid's history whoever looks on.

use std::f64::consts::PI;

use nalgebra::Matrix3;
use piola_continuum::rates::HomogeneousMotion;
use piola_fluids::{
    AnyFluid, Bingham, CarreauYasuda, Casson, ConstantCoefficients, Cross, Ellis, ExponentialDamping,
    ExponentialPhanThienTanner, Eyring, Giesekus, HerschelBulkley, Kbkz, LinearPhanThienTanner, Modes, Newtonian,
    OldroydB, Papanastasiou, PowerLaw, RationalDamping, ReinerRivlin, Relaxation, SecondOrder, SimpleFluid, Sisko,
    Slipping, UpperConvectedMaxwell, ViscometricFluid,
};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use piola_viscometry::{
    Annulus, Channel, ConeAndPlate, Couette, FallingFilm, ParallelPlates, PlaneCouette, Poiseuille, Stresses,
    ViscometryError, quadrature,
};

use super::laws::{Annular, Inverses, Momentum, Odd, ProfilesAdd, Visit};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// One fluid of each kind whose stress rises with the rate.
pub(super) fn every() -> Result<Vec<AnyFluid>, piola_fluids::FluidsError> {
    let memory = || vec![Relaxation { viscosity: 0.5, time: 0.4 }, Relaxation { viscosity: 0.25, time: 0.05 }];
    let oldroyd = OldroydB::new(0.5, 0.75, 0.4)?;
    let giesekus = Giesekus::new(0.25, 0.75, 0.4, 0.3)?;
    let linear = LinearPhanThienTanner::new(0.25, 0.75, 0.4, 0.3)?;
    let exponential = ExponentialPhanThienTanner::new(0.5, 0.75, 0.4, 0.3)?;
    Ok(vec![
        Newtonian::new(0.75)?.into(),
        PowerLaw::new(1.25, 0.4)?.into(),
        Bingham::new(0.25, 0.75)?.into(),
        HerschelBulkley::new(0.25, 1.25, 0.4)?.into(),
        Casson::new(0.25, 0.75)?.into(),
        CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?.into(),
        Cross::new(2.0, 0.05, 1.5, 0.6)?.into(),
        Ellis::new(1.5, 0.75, 2.5)?.into(),
        Eyring::new(2.0, 1.5)?.into(),
        Sisko::new(0.125, 1.0, 0.4)?.into(),
        Papanastasiou::new(0.25, 1.25, 0.8, 10.0)?.into(),
        ReinerRivlin(ConstantCoefficients::new(1.5, 0.5)?).into(),
        SecondOrder::new(0.75, -0.25, 0.375)?.into(),
        UpperConvectedMaxwell::new(0.75, 0.4)?.into(),
        oldroyd.into(),
        giesekus.into(),
        linear.into(),
        exponential.into(),
        Slipping::new(oldroyd, 0.125)?.into(),
        Slipping::new(linear, 0.125)?.into(),
        Slipping::new(exponential, 0.125)?.into(),
        Modes::new(vec![oldroyd, OldroydB::new(0.0, 0.25, 0.05)?])?.into(),
        Modes::new(vec![giesekus, Giesekus::new(0.0, 0.25, 0.05, 0.1)?])?.into(),
        Modes::new(vec![linear, LinearPhanThienTanner::new(0.0, 0.25, 0.05, 0.1)?])?.into(),
        Modes::new(vec![exponential])?.into(),
        Kbkz::new(memory(), RationalDamping::new(8.0, 0.5)?)?.into(),
        Kbkz::new(memory(), ExponentialDamping::new(0.05, 0.5)?)?.into(),
    ])
}

#[test]
fn opposite_drives_of_every_fluid_have_opposite_answers() -> Outcome {
    for fluid in every()? {
        Odd { drive: 2.5 }.visit(&fluid)?;
    }
    Ok(())
}

#[test]
fn the_discharge_of_every_fluid_equals_the_integral_of_the_profile() -> Outcome {
    for fluid in every()? {
        ProfilesAdd { drive: 2.5 }.visit(&fluid)?;
    }
    Ok(())
}

#[test]
fn the_drive_of_every_fluid_equals_that_found_from_the_answer() -> Outcome {
    for fluid in every()? {
        Inverses { drive: 2.5 }.visit(&fluid)?;
    }
    Ok(())
}

#[test]
fn forces_on_rings_of_every_fluid_equal_zero() -> Outcome {
    for fluid in every()? {
        Momentum { drive: 2.5 }.visit(&fluid)?;
    }
    Ok(())
}

#[test]
fn answers_of_an_annulus_of_every_fluid_equal_one_another() -> Outcome {
    // λ is sought anew for every place of the profile: of a kind with a spectrum or with slip one is enough.
    let again = |fluid: &AnyFluid| {
        matches!(
            fluid,
            AnyFluid::KbkzExponential(_)
                | AnyFluid::SlippingLinearPhanThienTanner(_)
                | AnyFluid::SlippingExponentialPhanThienTanner(_)
                | AnyFluid::LinearPhanThienTannerModes(_)
                | AnyFluid::ExponentialPhanThienTannerModes(_)
        )
    };
    for fluid in every()?.into_iter().filter(|fluid| !again(fluid)) {
        Annular { drive: 1.0 }.visit(&fluid)?;
    }
    Ok(())
}

/// df/dx by eight places about x: the error is of the order h⁸.
fn slope(f: impl Fn(f64) -> Result<f64, ViscometryError>, x: f64) -> Result<f64, ViscometryError> {
    const STEP: f64 = 1.0 / 512.0;
    let mut sum = 0.0;
    for (k, weight) in [(1.0, 4.0 / 5.0), (2.0, -1.0 / 5.0), (3.0, 4.0 / 105.0), (4.0, -1.0 / 280.0)] {
        sum += weight * (f(x + k * STEP)? - f(x - k * STEP)?);
    }
    Ok(sum / STEP)
}

/// A sum of forces is zero beside the largest of them.
fn balanced(what: &str, forces: &[f64]) {
    let largest = forces.iter().fold(1.0_f64, |a, x| a.max(x.abs()));
    let differences = Tol::stated(1e-10, "differences of the order 8 of stresses of 13 digits");
    assert_close_at_scale(what, &[forces.iter().sum()], &[0.0], largest, differences);
}

/// div T + ρ b − ρ a at points of each flow, in its own coordinates.
fn forces<F: ViscometricFluid>(what: &str, fluid: &F) -> Outcome {
    let density = 1.25;
    let couette = Couette::new(0.4, 1.0, 2.5)?.with_density(density)?.with_inner_speed(-0.75)?;
    let pipe = Poiseuille::new(1.0, 7.5)?;
    let annulus = Annulus::new(0.4, 1.0, 9.0)?;
    let discs = ParallelPlates::new(1.0, 0.1, 0.25)?;
    let cone = ConeAndPlate::new(1.0, 0.1, 0.25)?;
    for (r, is_sought) in [(0.5, true), (0.53, false), (0.86, false), (0.94, true)] {
        // r: ∂T_rr/∂r + (T_rr − T_θθ)/r + ρ r ω²; θ: ∂T_rθ/∂r + 2 T_rθ/r. Stresses bend where the fluid begins to yield.
        let at = couette.stresses(fluid, r)?;
        let bends = couette.yield_radius(fluid).is_some_and(|radius| (radius - r).abs() < 0.04);
        if !bends {
            let gradient = slope(|r| Ok(couette.stresses(fluid, r)?.gradient), r)?;
            let omega = couette.angular_velocity(fluid, r)?.value;
            balanced(what, &[gradient, at.gradient / r, -at.flow / r, density * r * omega * omega]);
        }
        balanced(what, &[slope(|r| couette.shear_stress(r), r)?, 2.0 * at.shear / r]);
        // r: ∂T_rr/∂r + (T_rr − T_θθ)/r; z: ∂T_rz/∂r + T_rz/r + ∂T_zz/∂z.
        let at = pipe.stresses(fluid, r, 0.25)?;
        let gradient = slope(|r| Ok(pipe.stresses(fluid, r, 0.25)?.gradient), r)?;
        balanced(what, &[gradient, at.gradient / r, -at.neutral / r]);
        let along = slope(|z| Ok(pipe.stresses(fluid, r, z)?.flow), 0.25)?;
        balanced(what, &[slope(|r| pipe.shear_stress(r), r)?, at.shear / r, along]);
        // λ is sought anew for every stress.
        if is_sought {
            let at = annulus.stresses(fluid, r, 0.25)?;
            let gradient = slope(|r| Ok(annulus.stresses(fluid, r, 0.25)?.gradient), r)?;
            balanced(what, &[gradient, at.gradient / r, -at.neutral / r]);
            balanced(what, &[slope(|r| annulus.shear_stress(fluid, r), r)?, at.shear / r, 9.0]);
        }
        // Spheres about the apex: ∂T_rr/∂r + (2 T_rr − T_θθ − T_φφ)/r; cylinders: ∂T_rr/∂r + (T_rr − T_θθ)/r.
        let at = cone.stresses(fluid, r)?;
        let gradient = slope(|r| Ok(cone.stresses(fluid, r)?.neutral), r)?;
        balanced(what, &[gradient, 2.0 * at.neutral / r, -at.gradient / r, -at.flow / r]);
        let at = discs.stresses(fluid, r)?;
        let gradient = slope(|r| Ok(discs.stresses(fluid, r)?.neutral), r)?;
        balanced(what, &[gradient, at.neutral / r, -at.flow / r]);
    }
    // Between planes: ∂T₁₁/∂x₁ and ∂T₁₂/∂x₁ + ∂T₂₂/∂x₂, with the weight of a film.
    let channel = Channel::new(1.0, 2.5)?;
    let film = FallingFilm::new(1.0, 2.0, 2.5, 1.1)?;
    for x in [0.1, 0.4, 0.8] {
        balanced(what, &[slope(|x| Ok(channel.stresses(fluid, x, 0.25)?.gradient), x)?]);
        let along = slope(|z| Ok(channel.stresses(fluid, x, z)?.flow), 0.25)?;
        balanced(what, &[slope(|x| Ok(channel.stresses(fluid, x, 0.25)?.shear), x)?, along]);
        balanced(what, &[slope(|x| Ok(film.stresses(fluid, x)?.gradient), x)?, -5.0 * 1.1_f64.cos()]);
        balanced(what, &[slope(|x| Ok(film.stresses(fluid, x)?.shear), x)?, 5.0 * 1.1_f64.sin()]);
    }
    Ok(())
}

#[test]
fn the_divergence_of_the_stress_equals_the_inertia_and_weight_at_points_of_every_flow() -> Outcome {
    for fluid in every()? {
        forces(fluid.name(), &fluid)?;
    }
    Ok(())
}

/// Simple shear at the rate k as an observer sees it who turns: F = R(ωt) (1 + k t e₂ ⊗ e₁).
struct Turning {
    spin: f64,
    rate: f64,
}

impl Turning {
    fn rotation<T: Real>(&self, time: T) -> Matrix3<T> {
        let (sin, cos) = (T::lit(self.spin) * time).sin_cos();
        let (zero, one) = (T::zero(), T::one());
        Matrix3::new(cos, -sin, zero, sin, cos, zero, zero, zero, one)
    }
}

impl HomogeneousMotion for Turning {
    fn gradient<T: Real>(&self, time: T) -> Matrix3<T> {
        let mut shear = Matrix3::from_diagonal_element(T::one());
        shear[(1, 0)] = T::lit(self.rate) * time;
        self.rotation(time) * shear
    }
}

/// The rates and stresses at a place of each flow.
fn places<F: ViscometricFluid>(fluid: &F) -> Result<Vec<(&'static str, f64, Stresses)>, ViscometryError> {
    let pipe = Poiseuille::new(0.8, 5.0)?;
    let channel = Channel::new(0.8, -2.5)?;
    let film = FallingFilm::new(0.4, 2.0, 2.5, 1.1)?;
    let annulus = Annulus::new(0.4, 1.0, 9.0)?;
    let couette = Couette::new(0.4, 0.8, 2.5)?.with_inner_speed(3.0)?;
    let plane = PlaneCouette::new(0.8, 1.5)?;
    let cone = ConeAndPlate::new(0.8, 0.1, 0.25)?;
    let discs = ParallelPlates::new(0.8, 0.1, -0.25)?;
    Ok(vec![
        ("pipe", pipe.shear_rate(fluid, 0.7)?, pipe.stresses(fluid, 0.7, 0.5)?),
        ("channel", channel.shear_rate(fluid, 0.6)?, channel.stresses(fluid, 0.6, 0.5)?),
        ("film", film.shear_rate(fluid, 0.05)?, film.stresses(fluid, 0.05)?),
        ("annulus", annulus.shear_rate(fluid, 0.45)?, annulus.stresses(fluid, 0.45, 0.5)?),
        ("cylinders", couette.shear_rate(fluid, 0.5)?, couette.stresses(fluid, 0.5)?),
        ("planes", plane.shear_rate(fluid)?, plane.stresses(fluid)?),
        ("cone", cone.nominal_shear_rate(), cone.stresses(fluid, 0.5)?),
        ("discs", discs.shear_rate(fluid, 0.7)?, discs.stresses(fluid, 0.7)?),
    ])
}

#[test]
fn stresses_of_every_flow_equal_the_answer_of_the_fluid_to_the_history_of_its_particles_as_any_observer_sees_it()
-> Outcome {
    for fluid in every()? {
        for (flow, rate, stresses) in places(&fluid)? {
            if rate.abs() <= 0.0 {
                continue;
            }
            // Forty times of relaxation after rest.
            let (motion, time) = (Turning { spin: 2.5, rate }, 16.0);
            let seen = fluid.response_to_motion(&motion, time, 1e-11)?;
            let turn = motion.rotation(time);
            let local = turn.transpose() * Matrix3::from_fn(|i, j| seen.rows()[i][j]) * turn;
            let what = format!("{} in {flow} at {rate}", fluid.name());
            let found = [
                local[(0, 1)],
                local[(1, 1)] - local[(0, 0)],
                local[(0, 0)] - local[(2, 2)],
                local[(0, 2)],
                local[(1, 2)],
            ];
            let expected = [
                stresses.shear,
                stresses.first_normal_stress_difference(),
                stresses.second_normal_stress_difference(),
                0.0,
                0.0,
            ];
            let scale = expected.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
            let followed = Tol::stated(1e-8, "histories to the tolerance 1e-11");
            assert_close_at_scale(&what, &found, &expected, scale, followed);
        }
    }
    Ok(())
}

#[test]
fn cylinders_that_turn_together_add_a_rigid_rotation_and_its_centrifugal_pressure() -> Outcome {
    let (density, spin) = (1.25, 3.0);
    let [inner, outer] = [0.4, 0.8];
    for fluid in every()? {
        let still = Couette::new(inner, outer, 2.5)?.with_density(density)?;
        let turning = still.with_inner_speed(spin)?;
        assert_eq!(turning.speed_difference(&fluid)?, still.speed_difference(&fluid)?);
        for r in [0.4, 0.6, 0.8] {
            let omega = still.angular_velocity(&fluid, r)?.value;
            let seen = turning.angular_velocity(&fluid, r)?.value;
            assert_close_at_scale(fluid.name(), &[seen - spin], &[omega], spin, Tol::ulps(4.0));
            let [one, other] = [still.stresses(&fluid, r)?, turning.stresses(&fluid, r)?];
            let differences =
                |at: Stresses| [at.shear, at.first_normal_stress_difference(), at.second_normal_stress_difference()];
            let close = Tol::stated(1e-13, "differences beside the centrifugal pressure");
            let scale = other.gradient.abs().max(one.shear.abs());
            assert_close_at_scale(fluid.name(), &differences(other), &differences(one), scale, close);
            // Coriolis' and the centrifugal force: ρ ∫ ξ (2 Ω ω + Ω²) dξ.
            let kink = still.yield_radius(&fluid).map_or(inner, |radius| radius.clamp(inner, r));
            let mut angular = 0.0;
            for ends in [[inner, kink], [kink, r]] {
                if ends[0] < ends[1] {
                    angular +=
                        quadrature::integrate(&ends, |x| Ok(x * still.angular_velocity(&fluid, x)?.value))?.value;
                }
            }
            let pressed = density * (2.0 * spin * angular + 0.5 * spin * spin * (r * r - inner * inner));
            let quadratures = Tol::stated(1e-11, "two quadratures");
            assert_close_at_scale(fluid.name(), &[one.gradient - other.gradient], &[pressed], scale, quadratures);
        }
    }
    Ok(())
}

/// Whether no rate makes the stress exceed some value.
const fn is_bounded(fluid: &AnyFluid) -> bool {
    matches!(fluid, AnyFluid::KbkzRational(_) | AnyFluid::KbkzExponential(_))
}

#[test]
fn narrow_annuli_of_every_fluid_equal_channels_and_wide_ones_lie_between_pipes() -> Outcome {
    for fluid in every()? {
        let what = fluid.name();
        // R₁/R₂ → 1: the correction is of the order of the square of the gap.
        let gap = 2.0_f64.powi(-20);
        let annulus = Annulus::new(1.0, 1.0 + gap, 4.0 / gap)?;
        let channel = Channel::new(0.5 * gap, 4.0 / gap)?;
        let around = channel.discharge(&fluid)?.value * 2.0 * PI * (1.0 + 0.5 * gap);
        let close = Tol::stated(1e-10, "the square of the gap, and two quadratures");
        assert_close(what, &[annulus.discharge(&fluid)?.value], &[around], close);
        // R₁/R₂ → 0: a pipe of the width of the gap would fit in, and the pipe without its core holds it.
        for inner in [0.1, 1e-3, 1e-6] {
            let annulus = Annulus::new(inner, 1.0, 4.0)?;
            let discharge = match annulus.discharge(&fluid) {
                Ok(discharge) => discharge,
                // About a thin wire the fluids whose stress has a greatest value slip away: no steady flow is left.
                Err(ViscometryError::Fluids(_) | ViscometryError::NotIncreasing { .. }) if is_bounded(&fluid) => {
                    continue;
                }
                Err(error) => return Err(format!("{what}, R₁ = {inner:e}: {error}").into()),
            };
            let inside = Poiseuille::new(0.5 * (1.0 - inner), 4.0)?.discharge(&fluid)?.value;
            let outside = Poiseuille::new(1.0, 4.0)?.discharge(&fluid)?.value;
            assert!(inside < discharge.value && discharge.value < outside, "{what}: {discharge:?}");
            // The error that is stated bounds how far the sides of λ pass one another.
            assert!(discharge.error < 1e-9 * discharge.value, "{what}: {discharge:?}");
            let rest = annulus.rest_radius(&fluid)?;
            assert!(inner < rest && rest < 1.0, "{what}: {rest}");
            let walls = [inner, 1.0].map(|r| annulus.velocity(&fluid, r).map(|v| v.value.abs()));
            for wall in walls {
                assert_close_at_scale(what, &[wall?], &[0.0], discharge.value, Tol::stated(1e-9, "a search for λ"));
            }
        }
    }
    Ok(())
}

#[test]
fn annuli_whose_drive_does_not_exceed_the_yield_stress_are_at_rest() -> Outcome {
    for fluid in every()?.into_iter().filter(|fluid| 0.0 < fluid.yield_stress()) {
        for [inner, outer] in [[1.0, 1.0 + 1e-9], [1.0, 2.0], [1e-6, 1.0]] {
            let gap = outer - inner;
            // 2 τ_y/(R₂ − R₁).
            let annulus = Annulus::new(inner, outer, 1.999 * fluid.yield_stress() / gap)?;
            let answers = [annulus.discharge(&fluid)?.value, annulus.velocity(&fluid, inner + 0.5 * gap)?.value];
            assert!(answers.iter().all(|answer| answer.abs() <= 0.0), "{}: {answers:?}", fluid.name());
            let beyond = Annulus::new(inner, outer, 2.2 * fluid.yield_stress() / gap)?.discharge(&fluid)?.value;
            assert!(0.0 < beyond, "{}: {beyond}", fluid.name());
        }
    }
    Ok(())
}
