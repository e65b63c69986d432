//! Bad input is refused by name; an update that fails keeps the last admissible state and says where.

use core::error::Error;

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_inelastic::{
    Evolution, Hardening, InelasticError, InelasticPoint, Mullins, PowerFlow, StepControl, Viscoplastic, advance_all,
    advance_components,
};
use piola_numerics::Real;
use piola_solids::{Hencky, NeoHookeanCiarlet};
use piola_tensor::FourthOrder;

use super::paths::{bergstrom_boyce, reese_govindjee};

type Fallible = Result<(), Box<dyn Error>>;

/// A law that was never checked refuses a spring that cannot flow when it is advanced.
#[cfg(feature = "any")]
#[test]
fn laws_that_were_not_checked_refuse_anisotropic_springs() -> Fallible {
    use piola_inelastic::{AnyInelastic, ByTangent, InSeries};
    use piola_solids::{AnySolid, Fibre, ReinforcedNeoHookean};
    let tissue = ReinforcedNeoHookean::new(1.0, 2.0, 3.0, Fibre::new([1.0, 0.0, 0.0])?)?;
    let spring = ByTangent(AnySolid::from(tissue));
    let law = AnyInelastic::InSeries(InSeries::new(spring.clone(), spring, 0.5)?);
    let mut state = [0.0; 9];
    law.initial_into(&mut state)?;
    let f = DeformationGradient::identity();
    let error = law.advance(&mut state, [&f, &f], 1.0, &StepControl::one_step()).err();
    assert!(
        matches!(error, Some(InelasticError::WrongSpring { part: "first", found: "anisotropic", .. })),
        "{error:?}"
    );
    Ok(())
}

/// (x − 1)² = 3/2 − F₁₁: no solution beyond F₁₁ = 3/2.
#[derive(Debug)]
struct Ends;

impl Evolution<1, 1> for Ends {
    fn initial(&self) -> [f64; 1] {
        [0.0]
    }
    fn residual<T: Real>(&self, _from: &[T; 1], f: &[[T; 3]; 3], x: &[T; 1], _dt: f64) -> [T; 1] {
        let shifted = x[0] - T::lit(1.0);
        [shifted * shifted - (T::lit(1.5) - f[0][0])]
    }
    fn updated<T: Real>(&self, _from: &[T; 1], _f: &[[T; 3]; 3], x: &[T; 1], _dt: f64) -> [T; 1] {
        [x[0]]
    }
    fn first_piola<T: Real>(&self, f: &[[T; 3]; 3], state: &[T; 1]) -> [[T; 3]; 3] {
        f.map(|row| row.map(|entry| entry * state[0]))
    }
}

#[test]
fn an_update_that_fails_keeps_the_last_admissible_state_and_says_where() -> Fallible {
    let mut point = InelasticPoint::new(&Ends);
    let error = point.advance(&DeformationGradient::diagonal([2.0, 1.0, 1.0])?, 1.0, &StepControl::one_step());
    let Err(InelasticError::NotConverged { share, gradient, .. }) = error else {
        return Err("an update without a solution".into());
    };
    // The last solvable F₁₁ is 3/2, half of the way.
    assert!(0.499 < share && share <= 0.5, "{share}");
    assert_eq!(gradient[0][0].to_bits(), point.deformation().matrix()[(0, 0)].to_bits());
    assert!((gradient[0][0] - (1.0 + share)).abs() < 1e-12);
    // x = 1 ± √(3/2 − F₁₁)
    let square = (point.state()[0] - 1.0) * (point.state()[0] - 1.0);
    assert!((square - (1.5 - gradient[0][0])).abs() < 1e-9, "{point:?}");
    Ok(())
}

#[test]
fn times_states_and_parameters_are_refused_by_name() -> Fallible {
    let law = reese_govindjee()?;
    let mut point = InelasticPoint::new(&law);
    let shear = DeformationGradient::simple_shear(0.1)?;
    let error = point.advance(&shear, -1.0, &StepControl::default());
    assert!(matches!(error, Err(InelasticError::OutOfBounds { parameter: "dt", .. })), "{error:?}");
    let error = point.advance(&shear, f64::NAN, &StepControl::default());
    assert!(matches!(error, Err(InelasticError::NotFinite { quantity: "dt", .. })), "{error:?}");
    let error = InelasticPoint::with_state(&law, &[1.0; 8], &shear).map(|_| ());
    assert!(matches!(error, Err(InelasticError::WrongLength { quantity: "state", expected: 9, found: 8 })));
    let mut state = law.initial();
    state[4] = f64::INFINITY;
    let error = InelasticPoint::with_state(&law, &state, &shear).map(|_| ());
    assert!(matches!(error, Err(InelasticError::NotFinite { quantity: "state", index: 4, .. })));
    let error = Mullins::new(NeoHookeanCiarlet::with_constants(1.0, 2.0)?, 0.5, 1.0, 0.0).map(|_| ());
    assert!(matches!(error, Err(InelasticError::OutOfBounds { parameter: "softening", .. })));
    let soft = Hardening { yield_stress: 1.0, linear: 0.0, saturation: 0.5, saturation_exponent: 1.0 };
    let error = Viscoplastic::new(Hencky::new(1.0, 1.0)?, soft, 0.0).map(|_| ());
    assert!(matches!(error, Err(InelasticError::OutOfBounds { parameter: "saturation", .. })));
    let flow =
        PowerFlow { rate: f64::NAN, stress: 1.0, stress_exponent: 1.0, stretch_exponent: 0.0, perturbation: 1.0 };
    assert!(matches!(flow.checked(), Err(InelasticError::NotFinite { quantity: "rate", .. })));
    Ok(())
}

#[test]
fn arrays_of_the_wrong_length_are_refused_and_points_that_fail_are_named() -> Fallible {
    let law = bergstrom_boyce()?;
    let rest = DeformationGradient::<f64>::identity();
    let shear = DeformationGradient::simple_shear(0.1)?;
    let mut states = [law.initial(); 3];
    let mut stresses = [FirstPiola::zero(); 3];
    let mut tangents = [FirstPiolaTangent(FourthOrder { components: [[0.0; 9]; 9] }); 3];
    let control = StepControl::one_step();
    let short =
        advance_all(&law, &mut states, [&[rest; 2], &[shear; 3]], (0.1, &control), &mut stresses, &mut tangents);
    let expected = InelasticError::WrongLength { quantity: "deformations before", expected: 3, found: 2 };
    assert_eq!(short, Err(expected));
    states[1][0] = f64::NAN;
    let error =
        advance_all(&law, &mut states, [&[rest; 3], &[shear; 3]], (0.1, &control), &mut stresses, &mut tangents);
    assert!(matches!(error, Err(InelasticError::AtPoint { index: 1, .. })), "{error:?}");
    assert!(stresses[1].0[(0, 0)].is_nan());
    assert_eq!(stresses[2], stresses[0]);
    let single = InelasticPoint::new(&law).advance(&shear, 0.1, &control)?;
    assert_eq!((stresses[2], tangents[2].0, states[2]), (single.first_piola, single.tangent.0, single.state));
    Ok(())
}

#[test]
fn arrays_of_components_give_the_numbers_of_arrays_of_states() -> Fallible {
    let law = bergstrom_boyce()?;
    let control = StepControl::one_step();
    let rest = [DeformationGradient::<f64>::identity(); 3];
    let to = [0.1, 0.2, 0.3].map(|k| DeformationGradient::simple_shear(k).expect("finite"));
    let tangent = FirstPiolaTangent(FourthOrder { components: [[0.0; 9]; 9] });
    let (mut states, mut stresses, mut tangents) = ([law.initial(); 3], [FirstPiola::zero(); 3], [tangent; 3]);
    advance_all(&law, &mut states, [&rest, &to], (0.1, &control), &mut stresses, &mut tangents)?;
    let mut arrays: Vec<Vec<f64>> = law.initial().iter().map(|value| vec![*value; 3]).collect();
    let mut columns = arrays.iter_mut().map(Vec::as_mut_slice);
    let mut columns: [&mut [f64]; 9] = core::array::from_fn(|_| columns.next().expect("nine"));
    let (mut other, mut others) = ([FirstPiola::zero(); 3], [tangent; 3]);
    // The second point has a law that cannot be made.
    let of = |index: usize| {
        if index == 1 { Mullins::new(Hencky::new(1.0, 1.0)?, 0.5, 1.0, 0.0).map(|_| law) } else { Ok(law) }
    };
    let error = advance_components(of, &mut columns, [&rest, &to], (0.1, &control), &mut other, &mut others);
    assert!(matches!(error, Err(InelasticError::AtPoint { index: 1, .. })), "{error:?}");
    assert!(other[1].0[(0, 0)].is_nan());
    for index in [0, 2] {
        let state: Vec<f64> = columns.iter().map(|column| column[index]).collect();
        assert_eq!((&state[..], other[index], others[index]), (&states[index][..], stresses[index], tangents[index]));
    }
    columns[4] = &mut [];
    let error = advance_components(|_| Ok(law), &mut columns, [&rest, &to], (0.1, &control), &mut other, &mut others);
    assert_eq!(error, Err(InelasticError::WrongLength { quantity: "states", expected: 3, found: 0 }));
    // A state that no body has: det Fᵢ = 0.
    let error = InelasticPoint::with_state(&law, &[0.0; 9], &rest[0])?.advance(&to[0], 0.1, &control);
    assert!(error.is_err(), "{error:?}");
    Ok(())
}
