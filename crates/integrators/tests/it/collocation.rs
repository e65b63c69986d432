//! What both collocation methods for q̈ = f(t, q, q̇) do alike: rest, return, stops, walls, collisions, refusals.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    Ending, GaussLegendre16, GaussRadau15, IntegratorsError, Report, SecondOrder, State, Tolerance,
};
use piola_numerics::Real;
use piola_testkit::{Tol, allocations_in, assert_close};

use crate::problems::{DoublePendulum, kepler, kepler_at};

/// q̈ = tᵏ
pub(crate) struct Power(pub(crate) i32);
impl<T: Real> SecondOrder<T> for Power {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        1
    }
    fn acceleration(&mut self, t: T, _q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
        acceleration[0] = t.powi(self.0);
        Ok(())
    }
}

/// q̈ = −ω²q
pub(crate) struct Oscillator(pub(crate) f64);
impl<T: Real> SecondOrder<T> for Oscillator {
    type Error = Infallible;
    const VELOCITY_DEPENDENT: bool = false;
    fn freedom(&self) -> usize {
        1
    }
    fn acceleration(&mut self, _t: T, q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
        acceleration[0] = -T::lit(self.0 * self.0) * q[0];
        Ok(())
    }
}

/// q̈ = 0 before a wall at q = 1, where there is no field, or a root of it that is not a number.
struct Walled {
    refuses: bool,
}
#[derive(Debug, PartialEq, thiserror::Error)]
#[error("there is a wall")]
struct Wall;
impl<T: Real> SecondOrder<T> for Walled {
    type Error = Wall;
    fn freedom(&self) -> usize {
        1
    }
    fn acceleration(&mut self, _t: T, q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Wall> {
        let beyond = (0..T::LANES).any(|lane| 1.0 < q[0].primal(lane));
        acceleration[0] = if self.refuses { T::zero() } else { (T::one() - q[0]).sqrt() * T::lit(1e-3) };
        if self.refuses && beyond { Err(Wall) } else { Ok(()) }
    }
}

/// The tests of one method.
macro_rules! tests_of {
    ($module:ident, $Method:ty) => {
        mod $module {
            use super::*;

            fn adaptive(tolerance: f64) -> $Method {
                <$Method>::new(Tolerance::relative(tolerance).unwrap())
            }

            fn both_paces(step: f64) -> [$Method; 2] {
                [adaptive(1e-9), <$Method>::with_step(step).unwrap()]
            }

            #[test]
            fn runs_of_any_length_allocate_alike() {
                let counts = [1.0, 100.0, 10_000.0].map(|end| {
                    let mut state = State::new(0.0, kepler_at(0.5, 0.0).to_vec()).unwrap();
                    let mut method = adaptive(1e-9);
                    let run = || method.integrate_to(&mut kepler(), &mut state, end).unwrap().steps;
                    let (count, steps) = allocations_in(run);
                    assert!((steps as f64) < 1.0 + 20.0 * end);
                    count
                });
                assert_eq!(counts, [counts[0]; 3]);
            }

            #[test]
            fn equilibrium_stays_to_the_last_bit_and_rest_is_left() {
                let mut pendulum = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 9.81 };
                let start = State::new(0.0, vec![0.0; 4]).unwrap();
                let mut state = start.clone();
                adaptive(1e-12).integrate_to(&mut pendulum, &mut state, 100.0).unwrap();
                assert_eq!(state.values, start.values);
                // From rest at the origin the drive alone moves it.
                let mut state = State::new(0.0, vec![0.0, 0.0]).unwrap();
                adaptive(1e-12).integrate_to(&mut Power(3), &mut state, 2.0).unwrap();
                assert_close("drive", &state.values, &[32.0 / 20.0, 4.0], Tol::ulps(16.0));
            }

            #[test]
            fn backward_run_returns_to_the_start() {
                // To the rounding of both runs, which the pericentre enlarges.
                for (e, tol) in [(0.0, 2e-14), (0.7, 2e-13)] {
                    let mut state = State::new(0.0, kepler_at(e, 0.0).to_vec()).unwrap();
                    let mut method = adaptive(1e-16);
                    method.integrate_to(&mut kepler(), &mut state, 10.0).unwrap();
                    method.integrate_to(&mut kepler(), &mut state, 0.0).unwrap();
                    let tol = Tol::stated(tol, "two revolutions, twice");
                    assert_close("return", &state.values, &kepler_at(e, 0.0), tol);
                }
            }

            #[test]
            fn runs_of_zero_length_and_stopped_runs_end_where_they_say() {
                let nothing = Report::begin();
                for mut method in both_paces(0.1) {
                    let start = State::new(2.0, kepler_at(0.3, 2.0).to_vec()).unwrap();
                    let mut state = start.clone();
                    assert_eq!(method.integrate_to(&mut kepler(), &mut state, 2.0).unwrap(), nothing);
                    assert_eq!(state, start);
                    let mut times = Vec::new();
                    let report = method
                        .integrate(&mut kepler(), &mut state, 10.0, |step| {
                            assert_eq!(step.start().to_bits(), times.last().copied().unwrap_or(2.0_f64).to_bits());
                            times.push(step.time());
                            if step.number() == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                        })
                        .unwrap();
                    assert_eq!((report.steps, report.ending, times.len()), (3, Ending::Stopped, 3));
                    assert_eq!(times.last().map(|t| t.to_bits()), Some(state.time.to_bits()));
                }
            }

            #[test]
            fn fields_that_end_leave_the_last_good_state() {
                for refuses in [true, false] {
                    for mut method in both_paces(0.125) {
                        let mut state = State::new(0.0, vec![0.0, 1.0]).unwrap();
                        let mut seen = 0.0;
                        let error = method
                            .integrate(&mut Walled { refuses }, &mut state, 10.0, |step| {
                                seen = step.time();
                                ControlFlow::Continue(())
                            })
                            .unwrap_err();
                        if refuses {
                            assert!(matches!(error, IntegratorsError::Field { source: Wall, .. }), "{error:?}");
                        } else {
                            // The root has no derivative at the wall: no step comes quite to it.
                            let expected = matches!(
                                error,
                                IntegratorsError::NotFinite { quantity: "rate", index: 0, .. }
                                    | IntegratorsError::StepTooSmall { .. }
                            );
                            assert!(expected, "{error:?}");
                        }
                        assert_eq!(state.time.to_bits(), seen.to_bits());
                        // The end of a step may lie beyond: no stage does, and the last is before the end.
                        assert!(0.8 < state.values[0] && state.values[0] < 1.03, "{state:?}");
                    }
                }
            }

            #[test]
            fn collision_ends_with_a_step_too_small_and_stiff_steps_are_refused() {
                // Two bodies that fall onto each other from rest meet after π/(2√2).
                let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0]).unwrap();
                let error = adaptive(1e-9).integrate_to(&mut kepler(), &mut state, 2.0).unwrap_err();
                let named = matches!(error, IntegratorsError::StepTooSmall { .. } | IntegratorsError::NotFinite { .. });
                assert!(named, "{error:?}");
                let time = core::f64::consts::PI / 8.0_f64.sqrt();
                let tol = Tol::stated(1e-6, "tolerance 1e-9 where the error grows as r^(-3/2)");
                assert_close("collision", &[state.time], &[time], tol);

                let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
                let mut method = <$Method>::with_step(0.5).unwrap();
                let error = method.integrate_to(&mut Oscillator(1e3), &mut state, 1.0).unwrap_err();
                assert!(matches!(error, IntegratorsError::StagesDiverged { .. }), "{error:?}");
                assert_eq!(state.values, [1.0, 0.0]);
                // The adaptive method shortens its steps instead.
                adaptive(1e-9).integrate_to(&mut Oscillator(1e3), &mut state, 1.0).unwrap();
                let tol = Tol::stated(1e-6, "160 revolutions");
                assert_close("oscillator", &state.values[..1], &[1e3_f64.cos()], tol);
            }

            #[test]
            fn bad_input_is_refused_by_name() {
                for step in [0.0, f64::NAN] {
                    assert!(matches!(<$Method>::with_step(step), Err(IntegratorsError::InvalidStep { .. })));
                }
                let mut state = State::new(0.0, vec![1.0; 3]).unwrap();
                let error = adaptive(1e-9).integrate_to(&mut kepler(), &mut state, 1.0).unwrap_err();
                let expected = IntegratorsError::WrongLength { quantity: "state", expected: 4, found: 3 };
                assert_eq!(error, expected);
                let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
                let error = adaptive(1e-9).integrate_to(&mut kepler(), &mut state, f64::NAN).unwrap_err();
                assert!(matches!(error, IntegratorsError::NotFinite { quantity: "end", .. }));
                let mut method = adaptive(1e-9).with_most_steps(2);
                let error = method.integrate_to(&mut kepler(), &mut state, 100.0).unwrap_err();
                assert_eq!(error, IntegratorsError::TooManySteps { t: state.time, steps: 2 });
            }
        }
    };
}

tests_of!(gauss_legendre_16, GaussLegendre16);
tests_of!(gauss_radau_15, GaussRadau15<f64>);
