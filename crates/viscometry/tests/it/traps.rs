//! Where flows go wrong: nothing moves, nearly nothing moves, gaps vanish, numbers are extreme or bad.

use std::f64::consts::PI;

use piola_fluids::{Bingham, CarreauYasuda, Casson, HerschelBulkley, Newtonian, PowerLaw, ViscometricFluid};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};
use piola_viscometry::{
    Annulus, Channel, ConeAndPlate, Couette, Estimate, FallingFilm, ParallelPlates, PlaneCouette, Poiseuille, Validity,
    ViscometryError, WallSlip, Warning, quadrature,
};

use super::fluids::{Counted, Normal, Numerical};
use super::numbers::equal;

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn answers_below_the_yield_stress_equal_zero() -> Outcome {
    let stiff = HerschelBulkley::new(50.0, 1.1, 0.4)?;
    let pipe = Poiseuille::new(1.0, 99.0)?;
    assert_eq!(pipe.discharge(&stiff)?, Estimate::ZERO);
    assert_eq!(pipe.velocity(&stiff, 0.3)?, Estimate::ZERO);
    equal([pipe.plug_radius(&stiff)], [1.0]);
    equal([pipe.shear_rate(&stiff, 1.0)?], [0.0]);
    equal([pipe.validity(&stiff, 1000.0, 100.0)?.reynolds_number], [0.0]);
    assert_eq!(Channel::new(1.0, 49.0)?.discharge(&stiff)?, Estimate::ZERO);
    let couette = Couette::new(1.0, 1.5, 300.0)?.with_density(10.0)?;
    assert_eq!(couette.speed_difference(&stiff)?, Estimate::ZERO);
    assert_eq!(couette.yield_radius(&stiff), Some(1.0));
    equal([couette.stresses(&stiff, 1.5)?.gradient], [0.0]);
    let annulus = Annulus::new(1.0, 2.0, 99.0)?;
    assert_eq!(annulus.discharge(&stiff)?, Estimate::ZERO);
    equal(annulus.plug(&stiff)?, [1.0, 2.0]);
    assert_eq!(annulus.velocity(&stiff, 1.5)?, Estimate::ZERO);
    assert_eq!(FallingFilm::new(1.0, 4.0, 9.8, 1.0)?.discharge(&stiff)?, Estimate::ZERO);
    equal([ConeAndPlate::with_torque(1.0, 0.1, 100.0, &stiff)?.speed()], [0.0]);
    equal([ParallelPlates::with_torque(1.0, 0.1, 100.0, &stiff)?.speed()], [0.0]);
    equal([PlaneCouette::with_shear_stress(1.0, -49.0, &stiff)?.speed()], [0.0]);
    Ok(())
}

#[test]
fn answers_at_rest_equal_zero_for_every_fluid() -> Outcome {
    fn still<F: ViscometricFluid>(fluid: &F) -> Outcome {
        let pipe = Poiseuille::with_discharge(1.0, 0.0, fluid)?;
        equal([pipe.pressure_gradient(), pipe.discharge(fluid)?.value], [0.0; 2]);
        let at = pipe.stresses(fluid, 1.0, 3.0)?;
        equal([at.gradient, at.flow, at.neutral], [0.0; 3]);
        let couette = Couette::with_speed_difference(1.0, 2.0, 0.0, fluid)?;
        equal([couette.moment(), couette.speed_difference(fluid)?.value], [0.0; 2]);
        assert!(couette.validity(fluid, 1.0, 100.0)?.is_valid());
        let plane = PlaneCouette::new(1.0, 0.0)?;
        equal([plane.stresses(fluid)?.shear], [0.0]);
        equal([plane.validity(fluid, 1.0, 100.0)?.reynolds_number], [0.0]);
        assert_eq!(ConeAndPlate::new(1.0, 0.1, 0.0)?.torque(fluid)?, Estimate::ZERO);
        let discs = ParallelPlates::new(1.0, 0.1, 0.0)?;
        assert_eq!([discs.torque(fluid)?, discs.thrust(fluid)?], [Estimate::ZERO; 2]);
        let annulus = Annulus::with_discharge(1.0, 2.0, 0.0, fluid)?;
        assert_eq!(annulus.velocity(fluid, 1.5)?, Estimate::ZERO);
        Ok(())
    }
    still(&Newtonian::new(0.7)?)?;
    still(&PowerLaw::new(0.7, 0.05)?)?;
    still(&PowerLaw::new(0.7, 2.0)?)?;
    still(&Casson::new(0.7, 0.3)?)?;
    still(&Normal)
}

#[test]
fn a_fluid_that_slips_below_its_yield_stress_moves_as_a_plug() -> Outcome {
    let stiff = Bingham::new(50.0, 1.0)?;
    let slip = WallSlip::new(0.02, 1.0)?;
    let pipe = Poiseuille::new(1.0, 40.0)?.with_slip(slip);
    equal([pipe.velocity(&stiff, 0.3)?.value], [0.4]);
    let again = Poiseuille::with_slip_and_discharge(1.0, slip, pipe.discharge(&stiff)?.value, &stiff)?;
    assert_close("drive", &[again.pressure_gradient()], &[40.0], Tol::ulps(8.0));
    let couette = Couette::new(1.0, 2.0, 100.0)?.with_slip(slip);
    let difference = couette.speed_difference(&stiff)?.value;
    let again = Couette::with_slip_and_speed_difference(1.0, 2.0, slip, difference, &stiff)?;
    assert_close("moment", &[again.moment()], &[100.0], Tol::ulps(16.0));
    Ok(())
}

#[test]
fn buckingham_reiner_and_casson_close_to_yield_equal_their_leading_terms() -> Outcome {
    // τ_w = τ_y (1 + ε): Q = π R³ ε² τ_y/(2 μ) (1 − …) of Bingham, and ε³/12 of Casson, where textbook formulas lose ε² of digits.
    for power in [10, 20, 26] {
        let share = 0.5_f64.powi(power);
        let pipe = Poiseuille::new(1.0, 1.0 + share)?;
        let bingham = pipe.discharge(&Bingham::new(0.5, 0.75)?)?.value;
        let leading = PI * 0.5 * share * share / 1.5;
        let tolerance = Tol::stated(3.0 * share, "the next term");
        assert_close("Bingham", &[bingham], &[leading], tolerance);
        let casson = pipe.discharge(&Casson::new(0.5, 0.75)?)?.value;
        // ζ = (√s − √τ_y)²/μ = τ_y ε²/(4 μ)
        let leading = PI * 0.5 * share.powi(3) / (12.0 * 0.75);
        assert_close("Casson", &[casson], &[leading], tolerance);
        let inverse = Poiseuille::with_discharge(1.0, casson, &Casson::new(0.5, 0.75)?)?;
        let excess = inverse.wall_stress() - 0.5;
        let digits = Tol::stated(2e-16 / share, "the digits of the excess stress").or(Tol::stated(1e-12, "search"));
        assert_close("excess", &[excess], &[0.5 * share], digits);
    }
    Ok(())
}

/// All of a fluid's flows at a rate, beside the numbers of its power law.
fn power_flows(consistency: f64, n: f64, rate: f64) -> Outcome {
    let fluid = PowerLaw::new(consistency, n)?;
    let numerical = Numerical(fluid);
    let wall = consistency * rate.powf(n);
    let pipe = Poiseuille::new(0.01, 2.0 * wall / 0.01)?;
    let expected = PI * 1e-6 * rate / (3.0 + 1.0 / n);
    // |ln k| and 1/n roundings of the exponent.
    let tolerance = Tol::ulps(16.0).times((1.0 + 1.0 / n) * (1.0 + rate.ln().abs() + wall.ln().abs()));
    assert_close("closed", &[pipe.discharge(&fluid)?.value], &[expected], tolerance);
    assert_close("quadrature", &[pipe.discharge(&numerical)?.value], &[expected], tolerance);
    let again = Poiseuille::with_discharge(0.01, expected, &numerical)?;
    assert_close("drive", &[again.wall_stress()], &[wall], tolerance);
    let ratio: f64 = 0.5;
    let couette = Couette::new(0.01, 0.02, wall * 2.0 * PI * 1e-4)?;
    let expected = 0.5 * n * rate * (1.0 - ratio.powf(2.0 / n));
    assert_close("closed", &[couette.speed_difference(&fluid)?.value], &[expected], tolerance);
    assert_close("quadrature", &[couette.speed_difference(&numerical)?.value], &[expected], tolerance);
    let discs = ParallelPlates::new(0.01, 0.001, rate * 0.1)?;
    let expected = 2.0 * PI * 1e-6 * wall / (3.0 + n);
    assert_close("torque", &[discs.torque(&fluid)?.value], &[expected], tolerance);
    assert_close(
        "speed",
        &[ParallelPlates::with_torque(0.01, 0.001, expected, &fluid)?.speed()],
        &[rate * 0.1],
        tolerance,
    );
    Ok(())
}

#[test]
fn power_laws_of_every_exponent_and_rate_equal_their_formulas() -> Outcome {
    for n in [0.05, 0.1, 0.3, 0.5, 1.0, 1.5, 2.0] {
        for rate in [1e-8, 1e-4, 1.0, 1e4, 1e8] {
            for consistency in [1e-3, 1.0, 1e3] {
                power_flows(consistency, n, rate)?;
            }
        }
    }
    Ok(())
}

#[test]
fn a_film_is_found_from_where_the_rates_are_no_numbers() -> Outcome {
    // ρ g = 1, n = 1/20: Q = ∫ ξ (ξ/K)²⁰ dξ = δ²²/(22 K²⁰). A film of a Newtonian fluid of viscosity K has k = 10⁻⁴⁰⁰.
    let thick = PowerLaw::new(1e30, 0.05)?;
    let film = FallingFilm::with_discharge(1.0, 1.0, 1.0, PI / 2.0, &thick)?;
    let expected = ((22.0_f64.ln() + 20.0 * 1e30_f64.ln()) / 22.0).exp();
    assert_close("δ", &[film.thickness()], &[expected], Tol::ulps_because(256.0, "logarithms of 63, of few ulp each"));
    Ok(())
}

#[test]
fn extreme_flows_of_a_carreau_fluid_equal_those_of_its_plateaus() -> Outcome {
    let fluid = CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?;
    let slow = Poiseuille::new(1.0, 4e-8)?.discharge(&fluid)?.value;
    assert_close("slow", &[slow], &[PI * 4e-8 / 16.0], Tol::stated(1e-8, "(λ k)^a of the first plateau"));
    let fast = Poiseuille::new(1.0, 0.1 * 1e8)?.discharge(&fluid)?.value;
    let last = PI * 0.1 * 1e8 / 0.4;
    assert_close("fast", &[fast], &[last], Tol::stated(1e-3, "(λ k)^(n − 1) of the last plateau"));
    Ok(())
}

#[test]
fn couette_flows_of_vanishing_gaps_equal_the_rate_at_the_wall_times_the_gap() -> Outcome {
    let fluid = CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?;
    for power in [10, 20, 30, 40, 50] {
        let share = 0.5_f64.powi(power);
        let couette = Couette::new(1.0, 1.0 + share, 12.0)?;
        let difference = couette.speed_difference(&fluid)?;
        let expected = share * couette.shear_rate(&fluid, 1.0)?;
        let tolerance = Tol::stated(6.0 * share, "the curvature of the gap").or(Tol::ulps(16.0));
        assert_close("ΔΩ", &[difference.value], &[expected], tolerance);
        let again = Couette::with_speed_difference(1.0, 1.0 + share, difference.value, &fluid)?;
        assert_close("moment", &[again.moment()], &[12.0], Tol::stated(1e-13, "search"));
    }
    Ok(())
}

#[test]
fn bad_numbers_are_refused_by_name() {
    let bound = |error: Result<(), ViscometryError>| match error {
        Err(ViscometryError::OutOfBounds { quantity, bound, .. }) => (quantity, bound),
        other => unreachable!("{other:?}"),
    };
    assert_eq!(bound(Poiseuille::new(-1.0, 1.0).map(drop)), ("radius", "0 < R"));
    assert_eq!(bound(Channel::new(0.0, 1.0).map(drop)), ("half_width", "0 < d"));
    assert_eq!(bound(Couette::new(2.0, 2.0, 1.0).map(drop)), ("outer_radius", "R₁ < R₂"));
    assert_eq!(bound(Couette::new(3.0, 2.0, 1.0).map(drop)), ("outer_radius", "R₁ < R₂"));
    assert_eq!(bound(Annulus::new(3.0, 2.0, 1.0).map(drop)), ("outer_radius", "R₁ < R₂"));
    assert_eq!(bound(Annulus::new(-3.0, 2.0, 1.0).map(drop)), ("inner_radius", "0 < R₁"));
    assert_eq!(bound(ConeAndPlate::new(1.0, 1.6, 1.0).map(drop)), ("angle", "0 < α < π/2"));
    assert_eq!(bound(ParallelPlates::new(1.0, 0.0, 1.0).map(drop)), ("gap", "0 < h"));
    assert_eq!(bound(PlaneCouette::new(-1.0, 1.0).map(drop)), ("gap", "0 < h"));
    assert_eq!(bound(FallingFilm::new(1.0, 1.0, 9.8, 1.6).map(drop)), ("inclination", "0 ≤ β ≤ π/2"));
    assert_eq!(bound(WallSlip::new(-1.0, 1.0).map(drop)), ("coefficient", "0 ≤ b"));
    let text = Poiseuille::new(-1.0, 1.0).map_err(|error| error.to_string());
    assert_eq!(text, Err("Poiseuille flow: radius = -1e0 violates 0 < R".to_owned()));
    for (error, named) in [
        (Poiseuille::new(f64::NAN, 1.0).map(drop), "radius"),
        (Poiseuille::new(1.0, f64::INFINITY).map(drop), "pressure_gradient"),
        (Couette::new(1.0, f64::INFINITY, 1.0).map(drop), "outer_radius"),
        (Couette::new(1.0, 2.0, f64::NAN).map(drop), "moment"),
        (ParallelPlates::new(1.0, 1.0, f64::NAN).map(drop), "speed"),
    ] {
        assert!(matches!(error, Err(ViscometryError::NotFinite { quantity, .. }) if quantity == named), "{named}");
    }
}

#[test]
fn places_outside_the_fluid_and_bad_questions_are_refused_by_name() -> Outcome {
    let oil = Newtonian::new(1.0)?;
    let pipe = Poiseuille::new(1.0, 1.0)?;
    for r in [-0.1, 1.1] {
        assert!(matches!(pipe.velocity(&oil, r), Err(ViscometryError::OutOfBounds { quantity: "r", .. })));
    }
    assert!(matches!(pipe.velocity(&oil, f64::NAN), Err(ViscometryError::NotFinite { quantity: "r", .. })));
    assert!(matches!(Couette::new(1.0, 2.0, 1.0)?.shear_stress(0.5), Err(ViscometryError::OutOfBounds { .. })));
    let mut room = [Estimate::ZERO; 2];
    let outcome = pipe.profile_into(&oil, &[0.1], &mut room);
    assert!(matches!(outcome, Err(ViscometryError::WrongLength { expected: 1, found: 2, .. })));
    assert!(matches!(pipe.validity(&oil, -1.0, 1.0), Err(ViscometryError::OutOfBounds { quantity: "density", .. })));
    let infinite = Poiseuille::with_discharge(1.0, f64::INFINITY, &oil);
    assert!(matches!(infinite, Err(ViscometryError::NotFinite { quantity: "discharge", .. })));
    let flat = FallingFilm::with_discharge(1.0, 1.0, 9.8, 0.0, &oil);
    assert!(matches!(flat, Err(ViscometryError::NoDrive { .. })));
    let moment = quadrature::moment(&oil, piola_fluids::FlowMoment::First, 1.0, 1.5);
    assert!(matches!(moment, Err(ViscometryError::OutOfBounds { quantity: "share", .. })));
    Ok(())
}

/// τ rises, falls and rises again.
struct Banding;

impl ViscometricFluid for Banding {
    const NAME: &'static str = "banding fluid";

    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        shear_rate / (T::one() + shear_rate * shear_rate) + T::lit(0.01) * shear_rate
    }
}

#[test]
fn a_shear_stress_that_falls_is_refused_with_its_rate() -> Outcome {
    // At the wall the rate is beyond the fall of τ.
    let refused = Poiseuille::new(1.0, 2.0)?.discharge(&Banding);
    let Err(ViscometryError::NotIncreasing { fluid, shear_rate, slope }) = refused else {
        unreachable!("{refused:?}");
    };
    assert_eq!(fluid, "banding fluid");
    assert!(1.0 < shear_rate && slope < 0.0);
    // So is it of every other flow that passes the fall.
    let named = |refused: Result<f64, ViscometryError>| {
        assert!(matches!(refused, Err(ViscometryError::NotIncreasing { .. })), "{refused:?}");
    };
    let value = |answer: Estimate| answer.value;
    named(Channel::new(1.0, 1.0)?.discharge(&Banding).map(value));
    named(FallingFilm::new(1.0, 1.0, 1.0, PI / 2.0)?.discharge(&Banding).map(value));
    named(Couette::new(1.0, 2.0, 2.0 * PI)?.speed_difference(&Banding).map(value));
    named(PlaneCouette::new(1.0, 2.0)?.shear_stress(&Banding));
    named(ConeAndPlate::new(1.0, 0.1, -0.2)?.torque(&Banding).map(value));
    named(ParallelPlates::new(1.0, 1.0, 2.0)?.torque(&Banding).map(value));
    named(Annulus::new(1.0, 2.0, 2.0)?.discharge(&Banding).map(value));
    // Before the fall it flows as any other.
    assert!(Poiseuille::new(1.0, 0.5)?.discharge(&Banding)?.value > 0.0);
    Ok(())
}

#[test]
fn a_discharge_beyond_the_fluid_is_refused() -> Outcome {
    /// τ never exceeds 1.
    struct Bounded;
    impl ViscometricFluid for Bounded {
        const NAME: &'static str = "bounded";
        fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
            shear_rate / (T::one() + shear_rate.abs())
        }
    }
    assert!(matches!(Poiseuille::new(1.0, 3.0)?.discharge(&Bounded), Err(ViscometryError::Fluids(_))));
    let half = Poiseuille::with_discharge(1.0, 0.1, &Bounded)?;
    assert_close("discharge", &[half.discharge(&Bounded)?.value], &[0.1], Tol::stated(1e-12, "search"));
    Ok(())
}

#[test]
fn a_question_costs_what_it_returns_and_nothing_else() -> Outcome {
    // A closed form: neither a stress nor a rate is asked for.
    let counted = Counted::new(HerschelBulkley::new(0.3, 1.1, 0.4)?);
    let pipe = Poiseuille::new(0.8, 5.0)?;
    pipe.discharge(&counted)?;
    assert_eq!(counted.take(), [0, 0, 0]);
    // By quadrature: the discharge costs what one velocity does, and no normal stress is asked for.
    let counted = Counted::new(Normal);
    pipe.velocity(&counted, 0.0)?;
    let [of_velocity, _, _] = counted.take();
    pipe.discharge(&counted)?;
    let [of_discharge, rates, normals] = counted.take();
    assert_eq!((rates, normals), (1, 0));
    assert!(of_discharge <= 2 * of_velocity && of_discharge < 200, "{of_discharge} {of_velocity}");
    // A profile costs as many velocities as it has places.
    let mut profile = [Estimate::ZERO; 50];
    let places: [f64; 50] = std::array::from_fn(|i| 0.8 * i as f64 / 50.0);
    pipe.profile_into(&counted, &places, &mut profile)?;
    assert!(counted.take()[0] > 10 * of_discharge);
    // A fluid without normal stresses is not asked for them, nor for a rate.
    let counted = Counted::new(CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?);
    pipe.stresses(&counted, 0.5, 0.0)?;
    assert_eq!(counted.take(), [0, 0, 0]);
    // Without a density nothing is integrated for centrifugal pressures.
    let couette = Couette::new(0.5, 0.8, 3.0)?;
    couette.stresses(&counted, 0.6)?;
    assert_eq!(counted.take(), [0, 0, 0]);
    couette.with_density(1.0)?.stresses(&counted, 0.6)?;
    assert!(counted.take()[0] > 0);
    Ok(())
}

#[test]
fn warnings_equal_what_is_wrong() -> Outcome {
    let water = Newtonian::new(0.001)?;
    let warned = |validity: Validity| validity.warnings().map(|warning| warning.to_string()).collect::<Vec<_>>();
    let calm = Poiseuille::with_discharge(0.001, 1e-7, &water)?.validity(&water, 1000.0, 1.0)?;
    // ρ V D/μ with V = Q/(π R²)
    assert_close("Re", &[calm.reynolds_number], &[1e-7 / (PI * 1e-6) * 2.0 / 1e-3], Tol::stated(1e-12, "search"));
    assert!(calm.is_valid() && warned(calm).is_empty());
    let short = Poiseuille::with_discharge(0.001, 1e-6, &water)?.validity(&water, 1000.0, 0.01)?;
    assert!(matches!(short.warnings().next(), Some(Warning::Entry { .. })));
    let wild = Channel::with_discharge(0.001, 0.01, &water)?.validity(&water, 1000.0, 1000.0)?;
    assert_close("Re", &[wild.reynolds_number], &[2.0 * 0.01 / 1e-6], Tol::stated(1e-12, "search"));
    assert!(matches!(wild.warnings().next(), Some(Warning::Turbulence { .. })));
    let annulus = Annulus::with_discharge(0.01, 0.011, 1e-5, &water)?.validity(&water, 1000.0, 10.0)?;
    let mean = 1e-5 / (PI * (0.011_f64.powi(2) - 0.01_f64.powi(2)));
    assert_close("Re", &[annulus.reynolds_number], &[mean * 0.002 / 1e-6], Tol::stated(1e-10, "search"));
    // Only the inner cylinder turns: vortices; only the outer: none.
    let inner = Couette::with_speed_difference(0.1, 0.11, -10.0, &water)?.with_inner_speed(10.0)?;
    assert!(matches!(inner.validity(&water, 1000.0, 1.0)?.warnings().next(), Some(Warning::Vortices { .. })));
    let outer = Couette::with_speed_difference(0.1, 0.11, 10.0, &water)?;
    assert!(outer.validity(&water, 1000.0, 1.0)?.is_valid());
    assert!(matches!(outer.validity(&water, 1000.0, 0.05)?.warnings().next(), Some(Warning::Ends { .. })));
    let cone = ConeAndPlate::new(0.05, 0.2, 10.0)?.validity(&water, 1000.0)?;
    assert_eq!(warned(cone).len(), 2);
    let discs = ParallelPlates::new(0.05, 0.001, 1.0)?.validity(&water, 1000.0)?;
    assert!(discs.is_valid());
    assert_close("Re", &[discs.reynolds_number], &[1.0], Tol::ulps(8.0));
    let film = FallingFilm::new(1e-3, 1000.0, 9.8, PI / 2.0)?.validity(&water)?;
    assert!(matches!(film.warnings().next(), Some(Warning::Waves { .. })));
    // On a slope long waves grow from 5/6 cot β.
    let critical = 5.0 / (6.0 * 0.1_f64.tan());
    let slope = FallingFilm::new(1e-3, 1000.0, 9.8, 0.1)?.validity(&water)?;
    let Some(Warning::Waves { critical: found, .. }) = slope.warnings().next() else { panic!("{slope:?}") };
    assert_close("Re", &[found], &[critical], Tol::ulps(8.0));
    let plane = PlaneCouette::new(1e-3, 10.0)?.validity(&water, 1000.0, 1.0)?;
    assert_close("Re", &[plane.reynolds_number], &[1e4], Tol::ulps(8.0));
    assert!(matches!(plane.warnings().next(), Some(Warning::Turbulence { .. })));
    Ok(())
}

#[cfg(feature = "serde")]
#[test]
fn flows_read_back_equal_themselves_and_bad_ones_are_refused() -> Outcome {
    let couette = Couette::new(1.0, 2.0, 3.0)?.with_density(4.0)?.with_inner_speed(5.0)?;
    let couette = couette.with_slip(WallSlip::new(0.5, 1.5)?);
    assert_eq!(serde_json::from_str::<Couette>(&serde_json::to_string(&couette)?)?, couette);
    let short = serde_json::from_str::<Couette>(r#"{"inner_radius": 1.0, "outer_radius": 2.0, "moment": 3.0}"#)?;
    assert_eq!(short, Couette::new(1.0, 2.0, 3.0)?);
    let annulus = Annulus::new(1.0, 2.0, 3.0)?;
    assert_eq!(serde_json::from_str::<Annulus>(&serde_json::to_string(&annulus)?)?, annulus);
    let bad = serde_json::from_str::<Poiseuille>(r#"{"radius": -1.0, "pressure_gradient": 2.0}"#);
    assert!(bad.is_err_and(|error| error.to_string().contains("radius = -1e0 violates 0 < R")));
    let bad = serde_json::from_str::<Couette>(
        r#"{"inner_radius": 1.0, "outer_radius": 2.0, "moment": 3.0, "density": -1.0}"#,
    );
    assert!(bad.is_err_and(|error| error.to_string().contains("density")));
    let typo = serde_json::from_str::<Poiseuille>(r#"{"radius": 1.0, "pressure_gradient": 2.0, "slipp": 1.0}"#);
    assert!(typo.is_err());
    Ok(())
}
