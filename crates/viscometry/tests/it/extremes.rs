//! Every flow of every fluid from 10⁻⁸ to 10⁸ 1/s, of exponents from 0.05 to 2: answers lie between bounds that hold for any fluid
//! whose stress rises with the rate, and drives are found again.

use std::f64::consts::PI;

use piola_fluids::{
    Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, HerschelBulkley, Newtonian, Papanastasiou, PowerLaw, Sisko,
    ViscometricFluid,
};
use piola_numerics::Dual;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use piola_viscometry::{
    Annulus, Channel, ConeAndPlate, Couette, FallingFilm, ParallelPlates, PlaneCouette, Poiseuille,
};

use super::every::every;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const RATES: [f64; 5] = [1e-8, 1e-4, 1.0, 1e4, 1e8];

/// Between two bounds, to rounding.
fn between(what: &str, value: f64, [low, high]: [f64; 2]) {
    let slack = 1e-12 * high.abs();
    assert!(low - slack <= value && value <= high + slack, "{what}: {value:e} is not in {low:e} .. {high:e}");
}

/// All flows with a shear rate at their walls.
fn flows<F: ViscometricFluid>(fluid: &F, rate: f64) -> Outcome {
    let wall = fluid.shear_stress(rate);
    let what = format!("{} at {rate:e}", F::NAME);
    // Answers are nearly constant in the drive close to the yield stress: drives are compared by the stress at their walls.
    let yields = fluid.yield_stress();
    // Where the stress does not exceed that of yield by a digit, at rest is as good an answer.
    let is_resolved = 1e-10 * wall < wall - yields;
    let again = |drive: f64, found: f64| {
        if is_resolved {
            assert_close(&what, &[found], &[drive], Tol::stated(1e-9, "a search"));
        }
    };
    let flowing = |answer: f64| assert!(!is_resolved || 0.0 < answer, "{what}: {answer:e} is no flow");
    let (radius, gap) = (0.01_f64, 0.001);

    let pipe = Poiseuille::new(radius, 2.0 * wall / radius)?;
    let discharge = pipe.discharge(fluid)?.value;
    between(&what, discharge, [0.0, PI * radius.powi(3) * rate / 3.0]);
    flowing(discharge);
    between(&what, pipe.velocity(fluid, 0.0)?.value, [discharge / (PI * radius * radius), radius * rate]);
    again(pipe.wall_stress(), Poiseuille::with_discharge(radius, discharge, fluid)?.wall_stress());

    let channel = Channel::new(gap, wall / gap)?;
    let discharge = channel.discharge(fluid)?.value;
    between(&what, discharge, [0.0, gap * gap * rate]);
    flowing(discharge);
    again(channel.wall_stress(), Channel::with_discharge(gap, discharge, fluid)?.wall_stress());

    let film = FallingFilm::new(gap, 1.0, wall / gap, PI / 2.0)?;
    let discharge = film.discharge(fluid)?.value;
    between(&what, discharge, [0.0, 0.5 * gap * gap * rate]);
    flowing(discharge);

    let couette = Couette::new(radius, 2.0 * radius, wall * 2.0 * PI * radius * radius)?;
    let difference = couette.speed_difference(fluid)?.value;
    between(&what, difference, [0.0, 2.0_f64.ln() * rate]);
    flowing(difference);
    again(couette.moment(), Couette::with_speed_difference(radius, 2.0 * radius, difference, fluid)?.moment());

    let plane = PlaneCouette::new(gap, gap * rate)?;
    assert_close(&what, &[plane.shear_stress(fluid)?], &[wall], Tol::ulps(4.0));
    let found = PlaneCouette::with_shear_stress(gap, wall, fluid)?;
    // The rate is found as well as the stress above yield has digits.
    if is_resolved {
        let condition = wall / (wall - yields) * 20.0;
        assert_close(&what, &[found.speed()], &[gap * rate], Tol::stated(1e-12, "a search").times(condition));
    }

    let at = plane.stresses(fluid)?;
    let [first, second]: [f64; 2] =
        [fluid.first_normal_stress_difference(rate), fluid.second_normal_stress_difference(rate)];
    let differences = [at.first_normal_stress_difference(), at.second_normal_stress_difference()];
    assert_close_at_scale(&what, &differences, &[first, second], first.abs(), Tol::ulps(16.0));

    let cone = ConeAndPlate::new(radius, 0.05, 0.05 * rate)?;
    assert_close(&what, &[cone.thrust(fluid)?.value], &[0.5 * PI * radius * radius * first], Tol::ulps(16.0));
    assert_close(&what, &[cone.torque(fluid)?.value], &[PI * radius.powi(3) * wall / 1.5], Tol::ulps(8.0));

    let discs = ParallelPlates::new(radius, gap, rate * gap / radius)?;
    let torque = discs.torque(fluid)?.value;
    between(&what, torque, [2.0 * PI * radius.powi(3) * yields / 3.0, 2.0 * PI * radius.powi(3) * wall / 3.0]);
    let found = ParallelPlates::with_torque(radius, gap, torque, fluid)?;
    again(wall, fluid.shear_stress(found.rim_shear_rate()));

    let annulus = Annulus::new(radius, radius + gap, 2.0 * wall / gap)?;
    let discharge = annulus.discharge(fluid)?.value;
    // The stress at the inner wall is larger than the mean by less than the share of the gap.
    let most = fluid.shear_rate(1.1 * wall)?;
    between(&what, discharge, [0.0, 0.5 * PI * gap * gap * (radius + gap) * most]);
    flowing(discharge);
    Ok(())
}

#[test]
fn answers_at_extreme_rates_of_extreme_fluids_lie_between_their_bounds() -> Outcome {
    for rate in RATES {
        for n in [0.05, 0.3, 1.0, 2.0] {
            flows(&PowerLaw::new(1.3, n)?, rate)?;
            flows(&HerschelBulkley::new(0.7, 1.1, n)?, rate)?;
            flows(&Sisko::new(0.1, 0.9, n)?, rate)?;
            flows(&Papanastasiou::new(0.7, 1.1, n.clamp(0.3, 1.0), 100.0)?, rate)?;
            flows(&CarreauYasuda::new(2.0, 1e-3, 1.5, n.min(1.0), 2.0)?, rate)?;
            flows(&Cross::new(2.0, 1e-3, 1.5, (1.0 - n).max(0.0) + 0.05)?, rate)?;
            flows(&Ellis::new(2.0, 1.0, (1.0 / n).max(1.0))?, rate)?;
        }
        flows(&Newtonian::new(0.7)?, rate)?;
        flows(&Bingham::new(0.7, 0.3)?, rate)?;
        flows(&Casson::new(0.7, 0.3)?, rate)?;
        flows(&Eyring::new(2.0, 1.5)?, rate)?;
    }
    Ok(())
}

#[test]
fn answers_at_extreme_rates_of_elastic_fluids_lie_between_their_bounds_with_their_normal_stresses() -> Outcome {
    for fluid in every()? {
        for rate in RATES {
            // A stress that no longer rises has no steady flow: that is said, and no number is none.
            let at = fluid.shear_stress(Dual::variable(rate));
            if 1e-3 * at.value < rate * at.tangent {
                flows(&fluid, rate).map_err(|error| format!("{} at {rate:e}: {error}", fluid.name()))?;
            } else {
                let wall = at.value;
                let answers = [
                    Poiseuille::new(0.01, 200.0 * wall)?.discharge(&fluid),
                    Channel::new(0.001, 1000.0 * wall)?.discharge(&fluid),
                    Couette::new(0.01, 0.02, wall * 2e-4 * PI)?.speed_difference(&fluid),
                    Annulus::new(0.01, 0.011, 2000.0 * wall)?.discharge(&fluid),
                ];
                assert!(answers.iter().flatten().all(|answer| answer.value.is_finite()), "{}", fluid.name());
            }
        }
    }
    Ok(())
}
