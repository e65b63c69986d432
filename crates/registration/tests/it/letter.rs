//! The disc that becomes a C: what a fluid can do and a linear elastic body cannot.

use piola_registration::{DisplacementMap, Interpolant, Registration, RegistrationError, RegistrationModel};

use crate::fixtures::disc_and_letter;

const N: usize = 96;

/// The mean of |u| in samples.
fn mean(map: &DisplacementMap<2, f64>) -> f64 {
    let lengths = map.displacements().iter().map(|u| u[0].hypot(u[1]));
    lengths.sum::<f64>() / map.displacements().len() as f64 * N as f64
}

#[test]
fn fluid_makes_a_c_of_a_disc_without_folds() -> Result<(), RegistrationError> {
    let [disc, letter] = disc_and_letter(N)?;
    assert!(disc.dice(&letter, 0.5)? < 0.6);
    let found = Registration::new(RegistrationModel::viscous_fluid(0.0, 1.0)?).run(&letter, &disc)?;
    let dice = found.map.warp(&disc, Interpolant::Linear)?.dice(&letter, 0.5)?;
    assert!(0.98 < dice, "{dice}");
    assert!(0.0 < found.map.least_jacobian());
    assert!(0 < found.levels.iter().map(|level| level.regriddings).sum::<usize>());
    let inverse = found.map.inverse()?;
    assert!(0.0 < inverse.least_jacobian() || found.map.least_jacobian() < 0.1);
    // Half a sample is allowed; h(g(y)) = y holds to rounding, and g(h(x)) in the mean.
    assert!(found.map.after(&inverse)?.largest_displacement() < 1e-12);
    let defect = mean(&inverse.after(&found.map)?);
    assert!(defect < 0.5, "{defect}");
    Ok(())
}

#[test]
fn symmetric_fluid_is_inverse_consistent() -> Result<(), RegistrationError> {
    let [disc, letter] = disc_and_letter(N)?;
    let method = Registration::new(RegistrationModel::viscous_fluid(0.0, 1.0)?).symmetric();
    let there = method.run(&letter, &disc)?;
    let back = method.run(&disc, &letter)?;
    for (found, image, other) in [(&there, &disc, &letter), (&back, &letter, &disc)] {
        let dice = found.map.warp(image, Interpolant::Linear)?.dice(other, 0.5)?;
        assert!(0.98 < dice, "{dice}");
        for half in found.halves.iter().flatten() {
            assert!(1e-3 <= half.least_jacobian());
            assert!(half.after(&half.inverse()?)?.largest_displacement() < 1e-12);
        }
    }
    assert!(there.halves.is_some());
    // The run the other way and the inverse of the halves are both the inverse of the map.
    for inverse in [&back.map, &there.inverse()?] {
        let (round, other) = (there.map.after(inverse)?, inverse.after(&there.map)?);
        let [largest, means] = [round.largest_displacement() * N as f64, mean(&round).max(mean(&other))];
        assert!(largest < 0.5 && means < 0.5, "{largest} {means}");
    }
    Ok(())
}

/// The least of energy and measure, or a fold that ends the steps, comes long before the C.
#[test]
fn elastic_body_does_not_reach_the_c() -> Result<(), RegistrationError> {
    let [disc, letter] = disc_and_letter(N)?;
    for symmetric in [false, true] {
        let method = Registration::new(RegistrationModel::elastic(0.0, 0.1)?);
        let found = if symmetric { method.symmetric() } else { method }.run(&letter, &disc)?;
        let dice = found.map.warp(&disc, Interpolant::Linear)?.dice(&letter, 0.5)?;
        assert!(dice < 0.93, "{dice}");
        assert!(disc.dice(&letter, 0.5)? < dice, "{dice}");
    }
    Ok(())
}
