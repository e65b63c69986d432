//! Stresses without tangents: the numbers of the update with tangents, and no derivative by F computed.

use core::cell::Cell;
use core::error::Error;

use piola_inelastic::{Evolution, InelasticPoint, StepControl};
use piola_numerics::{Gradient, Real};
use piola_testkit::{Tol, assert_close_at_scale};

use super::laws::{grown, hot, in_series, path};
use super::paths::{bergstrom_boyce, driven_growth, kinematic, mullins, reese_govindjee, viscoplastic};

type Fallible = Result<(), Box<dyn Error>>;

fn check<L: Evolution<S, X>, const S: usize, const X: usize>(what: &str, law: &L) -> Fallible {
    for (seed, control) in [(70, StepControl::one_step()), (71, StepControl::new(1e-6)?)] {
        let (mut with, mut without) = (InelasticPoint::new(law), InelasticPoint::new(law));
        for to in path(seed, 4) {
            let advanced = with.advance(&to, 0.2, &control)?;
            let (stress, effort) = without.advance_stress(&to, 0.2, &control)?;
            assert_eq!((effort.parts, effort.steps), (advanced.effort.parts, advanced.effort.steps), "{what}");
            let tol = Tol::ulps_because(1e4, "two roundings of the last iteration of each of some hundred steps");
            let scale = advanced.first_piola.0.norm().max(1.0);
            assert_close_at_scale(what, stress.0.as_slice(), advanced.first_piola.0.as_slice(), scale, tol);
            let scale = advanced.state.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            assert_close_at_scale(what, without.state(), &advanced.state, scale, tol);
        }
    }
    Ok(())
}

#[test]
fn stresses_without_tangents_equal_those_with_them() -> Fallible {
    check("Bergström–Boyce", &bergstrom_boyce()?)?;
    check("Reese–Govindjee", &reese_govindjee()?)?;
    check("in series", &in_series()?)?;
    check("viscoplastic", &viscoplastic(0.5)?)?;
    check("plastic", &viscoplastic(0.0)?)?;
    check("kinematic", &kinematic(0.0)?)?;
    check("Mullins", &mullins()?)?;
    check("driven growth", &driven_growth()?)?;
    check("given growth", &grown()?)?;
    check("thermal", &hot()?)
}

/// A law that is shared, and counts its evaluations by numbers with derivatives by F.
pub(crate) struct Counted<'a, L> {
    law: &'a L,
    by_deformation: Cell<usize>,
}

impl<'a, L> Counted<'a, L> {
    pub(crate) fn of(law: &'a L) -> Self {
        Self { law, by_deformation: Cell::new(0) }
    }

    fn count<T: Real>(&self) {
        if size_of::<T>() == size_of::<Gradient<f64, 9>>() {
            self.by_deformation.set(self.by_deformation.get() + 1);
        }
    }
}

impl<L: Evolution<S, X>, const S: usize, const X: usize> Evolution<S, X> for Counted<'_, L> {
    fn initial(&self) -> [f64; S] {
        self.law.initial()
    }
    fn evolves(&self, from: &[f64; S], f: &[[f64; 3]; 3], dt: f64) -> bool {
        self.law.evolves(from, f, dt)
    }
    fn residual<T: Real>(&self, from: &[T; S], f: &[[T; 3]; 3], x: &[T; X], dt: f64) -> [T; X] {
        self.count::<T>();
        self.law.residual(from, f, x, dt)
    }
    fn updated<T: Real>(&self, from: &[T; S], f: &[[T; 3]; 3], x: &[T; X], dt: f64) -> [T; S] {
        self.count::<T>();
        self.law.updated(from, f, x, dt)
    }
    fn first_piola<T: Real>(&self, f: &[[T; 3]; 3], state: &[T; S]) -> [[T; 3]; 3] {
        self.count::<T>();
        self.law.first_piola(f, state)
    }
}

#[test]
fn evaluations_with_derivatives_by_the_deformation_equal_zero() -> Fallible {
    let law = reese_govindjee()?;
    let counted = Counted::of(&law);
    let mut point = InelasticPoint::new(&counted);
    let to = &path(72, 1)[0];
    point.advance_stress(to, 0.2, &StepControl::new(1e-6)?)?;
    assert_eq!(counted.by_deformation.get(), 0);
    point.advance(to, 0.2, &StepControl::one_step())?;
    assert_eq!(counted.by_deformation.get(), 3); // equations, state, stress
    Ok(())
}
