//! Viscometric functions at many rates: each is that of one point.

use piola_fluids::{
    CarreauYasuda, ExponentialDamping, FluidsError, Giesekus, HerschelBulkley, Kbkz, Newtonian, Relaxation,
    ViscometricFluid, batch,
};
use piola_testkit::{Tol, allocations_in, assert_close};

type Outcome = Result<(), FluidsError>;
type One<F> = fn(&F, f64) -> f64;
type Many<F> = fn(&F, &[f64], &mut [f64]) -> Outcome;

/// Both signs, eight decades down and up, and rest: a number of entries that no number of lanes divides.
fn rates() -> Vec<f64> {
    (-16..=16)
        .flat_map(|step| [10.0_f64.powf(0.5 * f64::from(step)), -10.0_f64.powf(0.5 * f64::from(step))])
        .chain([0.0])
        .collect()
}

fn compare<F: ViscometricFluid>(fluid: &F, tolerance: Tol) -> Outcome {
    let rates = rates();
    let mut answers = vec![0.0; rates.len()];
    let functions: [(&str, One<F>, Many<F>); 4] = [
        ("τ", |fluid, k| fluid.shear_stress(k), batch::shear_stress),
        ("σ₁", |fluid, k| fluid.sigma1(k), batch::sigma1),
        ("σ₂", |fluid, k| fluid.sigma2(k), batch::sigma2),
        ("η", |fluid, k| fluid.viscosity(k), batch::viscosity),
    ];
    for (name, one, many) in functions {
        for count in [rates.len(), 1, 0] {
            answers.fill(7.0);
            many(fluid, &rates[..count], &mut answers[..count])?;
            for (k, answer) in rates.iter().zip(&answers).take(count) {
                let expected = one(fluid, *k);
                if expected.is_finite() {
                    assert_close(&format!("{} {name} at {k:e}", F::NAME), &[*answer], &[expected], tolerance);
                } else {
                    assert_eq!(answer.to_bits(), expected.to_bits());
                }
            }
            assert_close("beyond the entries", &answers[count..], &vec![7.0; rates.len() - count], Tol::ulps(0.0));
        }
    }
    Ok(())
}

/// ζ at the stresses of all rates.
fn compare_rates<F: ViscometricFluid>(fluid: &F, tolerance: Tol) -> Outcome {
    let stresses: Vec<f64> = rates().into_iter().map(|k| fluid.shear_stress(k)).collect();
    let mut found = vec![0.0; stresses.len()];
    batch::shear_rate(fluid, &stresses, &mut found)?;
    for (stress, rate) in stresses.iter().zip(&found) {
        assert_close(&format!("{} ζ at {stress:e}", F::NAME), &[*rate], &[fluid.shear_rate(*stress)?], tolerance);
    }
    Ok(())
}

#[test]
fn functions_in_lanes_equal_those_of_one_point() -> Outcome {
    compare(&Newtonian::new(0.7)?, Tol::ulps(0.0))?;
    compare(&Giesekus::new(0.1, 1.0, 2.0, 0.3)?, Tol::ulps(8.0))?;
    compare(&CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?, Tol::ulps(16.0))?;
    compare(&HerschelBulkley::new(2.0, 1.5, 0.5)?, Tol::ulps(8.0))?;
    let memory = vec![Relaxation { viscosity: 8.0, time: 1.0 }, Relaxation { viscosity: 1.0, time: 0.1 }];
    let melt = Kbkz::new(memory, ExponentialDamping::new(0.5, 1.0)?)?;
    compare(&melt, Tol::stated(4e-14, "sums that begin at the fastest of the lanes"))
}

#[test]
fn rates_in_lanes_equal_those_of_one_point() -> Outcome {
    compare_rates(&CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?, Tol::ulps(16.0).times(1.0 / 0.4))?;
    compare_rates(&HerschelBulkley::new(2.0, 1.5, 0.5)?, Tol::ulps(8.0).times(2.0))
}

#[test]
fn bad_entries_are_named_and_all_others_computed() -> Outcome {
    let oil = Newtonian::new(2.0)?;
    let rates = [1.0, 2.0, f64::NAN, 4.0, 5.0, 6.0, 7.0, 8.0, f64::INFINITY, 10.0];
    let mut stresses = [0.0; 10];
    let refused = batch::shear_stress(&oil, &rates, &mut stresses);
    let Err(FluidsError::BadEntries { fluid: Newtonian::NAME, index: 2, value, count: 2 }) = refused else {
        unreachable!("{refused:?}")
    };
    assert!(value.is_nan() && stresses[2].is_nan() && stresses[8].is_nan());
    let others = [stresses[0], stresses[3], stresses[7], stresses[9]];
    assert_close("all others", &others, &[2.0, 8.0, 16.0, 20.0], Tol::ulps(0.0));
    // A stress to which no rate belongs.
    let paste = HerschelBulkley::new(1.0, 1.0, 0.5)?;
    let mut rates = [0.0; 3];
    let refused = batch::shear_rate(&paste, &[0.5, 3.0, 1e200], &mut rates);
    assert_eq!(
        refused,
        Err(FluidsError::BadEntries { fluid: HerschelBulkley::NAME, index: 2, value: 1e200, count: 1 })
    );
    assert_close("all others", &rates[..2], &[0.0, 4.0], Tol::ulps(0.0));
    assert!(rates[2].is_nan());
    Ok(())
}

#[test]
fn answers_of_another_number_are_refused() -> Outcome {
    let refused = batch::sigma2(&Newtonian::new(2.0)?, &[1.0; 3], &mut [0.0; 4]);
    assert_eq!(refused, Err(FluidsError::WrongLength { quantity: "answers", found: 4, expected: 3 }));
    Ok(())
}

#[test]
fn allocations_of_a_batch_equal_zero() -> Outcome {
    let melt = CarreauYasuda::new(2.0, 0.05, 1.5, 0.4, 1.25)?;
    let (rates, mut stresses, mut found) = ([3.0; 21], [0.0; 21], [0.0; 21]);
    let (count, outcome) = allocations_in(|| {
        batch::shear_stress(&melt, &rates, &mut stresses)?;
        batch::shear_rate(&melt, &stresses, &mut found)
    });
    outcome?;
    let (refusals, refused) = allocations_in(|| batch::shear_stress(&melt, &[f64::NAN; 21], &mut stresses));
    assert!(refused.is_err());
    assert_eq!([count, refusals], [0, 0]);
    Ok(())
}
