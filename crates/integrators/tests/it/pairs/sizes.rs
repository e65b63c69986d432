//! A size that the compiler knows changes the time of a run and nothing else.

use core::convert::Infallible;

use piola_integrators::{
    DormandPrince853, Field, GaussLegendre16, GaussRadau15, IntegratorsError, Nystrom86, Nystrom1210, SecondOrder,
    State, Tolerance, Verner98, sized_field,
};
use piola_numerics::Real;
use piola_testkit::allocations_in;

use crate::problems::{Attraction, Force, kepler, kepler_at};

/// The attraction in the plane, with a size that it states and one that it has.
struct Sized<const STATED: usize>(usize);

impl<const STATED: usize> Field for Sized<STATED> {
    type Error = Infallible;
    const DIMENSION: Option<usize> = Some(2 * STATED);
    fn dimension(&self) -> usize {
        2 * self.0
    }
    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
        rate[..2].copy_from_slice(&y[2..]);
        Attraction.force(0.0, &y[..2], &mut rate[2..]);
        Ok(())
    }
}

impl<const STATED: usize, T: Real> SecondOrder<T> for Sized<STATED> {
    type Error = Infallible;
    const VELOCITY_DEPENDENT: bool = false;
    const FREEDOM: Option<usize> = Some(STATED);
    fn freedom(&self) -> usize {
        self.0
    }
    fn acceleration(&mut self, _t: T, q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
        Attraction.force(0.0, q, acceleration);
        Ok(())
    }
}

fn start() -> State {
    State::new(0.0, kepler_at(0.7, 0.0).to_vec()).unwrap()
}

macro_rules! same_run {
    ($method:ident) => {{
        let (mut known, mut unknown) = (start(), start());
        let tolerance = Tolerance::relative(1e-10).unwrap();
        let one = $method::new(tolerance).integrate_to(&mut Sized::<2>(2), &mut known, 20.0).unwrap();
        let other = $method::new(tolerance).integrate_to(&mut kepler(), &mut unknown, 20.0).unwrap();
        assert_eq!((one, known), (other, unknown), stringify!($method));
    }};
}

#[test]
fn a_known_size_gives_the_same_run_to_the_last_bit() {
    same_run!(DormandPrince853);
    same_run!(Verner98);
    same_run!(Nystrom86);
    same_run!(Nystrom1210);
    same_run!(GaussLegendre16);
    same_run!(GaussRadau15);
}

#[test]
fn a_field_of_another_size_than_its_type_states_is_refused() {
    let tolerance = Tolerance::relative(1e-10).unwrap();
    let mut state = start();
    let wrong = |expected, found| IntegratorsError::WrongLength { quantity: "field", expected, found };
    let run = DormandPrince853::new(tolerance).integrate_to(&mut Sized::<3>(2), &mut state, 1.0);
    assert_eq!(run, Err(wrong(6, 4)));
    let run = Nystrom86::new(tolerance).integrate_to(&mut Sized::<3>(2), &mut state, 1.0);
    assert_eq!(run, Err(wrong(3, 2)));
    let run = GaussLegendre16::new(tolerance).integrate_to(&mut Sized::<3>(2), &mut state, 1.0);
    assert_eq!(run, Err(wrong(3, 2)));
    let run = GaussRadau15::new(tolerance).integrate_to(&mut Sized::<3>(2), &mut state, 1.0);
    assert_eq!(run, Err(wrong(3, 2)));
    assert_eq!(state, start());
}

#[test]
fn a_function_of_arrays_is_a_field_of_their_size() {
    let mut arrays = sized_field(|_t, y: &[f64; 4], rate: &mut [f64; 4]| {
        rate[..2].copy_from_slice(&y[2..]);
        Attraction.force(0.0, &y[..2], &mut rate[2..]);
    });
    let (mut known, mut unknown) = (start(), start());
    let tolerance = Tolerance::relative(1e-10).unwrap();
    let one = Verner98::new(tolerance).integrate_to(&mut arrays, &mut known, 20.0).unwrap();
    let other = Verner98::new(tolerance).integrate_to(&mut kepler(), &mut unknown, 20.0).unwrap();
    assert_eq!((one, known), (other, unknown));
}

#[test]
fn second_runs_allocate_nothing() {
    let tolerance = Tolerance::relative(1e-10).unwrap();
    let (mut eight, mut twelve, mut nine) =
        (Nystrom86::new(tolerance), Nystrom1210::new(tolerance), Verner98::new(tolerance));
    let mut state = start();
    let mut round = |end: f64| {
        let mut y = [0.0; 4];
        let mut look = |t: f64, at: &mut dyn FnMut(f64, &mut [f64]) -> bool| assert!(at(t, &mut y));
        eight
            .integrate(&mut kepler(), &mut state, end, |step| {
                look(step.start() + 0.3 * (step.time() - step.start()), &mut |t, y| step.at(t, y).is_ok());
                core::ops::ControlFlow::Continue(())
            })
            .unwrap();
        twelve
            .integrate(&mut kepler(), &mut state, end + 0.5, |step| {
                look(step.start() + 0.3 * (step.time() - step.start()), &mut |t, y| step.at(t, y).is_ok());
                core::ops::ControlFlow::Continue(())
            })
            .unwrap();
        nine.integrate(&mut kepler(), &mut state, end + 1.0, |step| {
            look(step.start() + 0.3 * (step.time() - step.start()), &mut |t, y| step.at(t, y).is_ok());
            core::ops::ControlFlow::Continue(())
        })
        .unwrap();
    };
    round(1.0);
    assert_eq!(allocations_in(|| round(100.0)).0, 0);
}
