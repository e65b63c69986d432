//! Identities on random paths: no dependence on the observer, no negative dissipation, no rate where there is none.

use core::error::Error;

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_inelastic::{
    Evolution, GivenGrowth, InSeries, InelasticPoint, OverHistory, StepControl, Thermal, ThermalExpansion,
};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_solids::{Hencky, NeoHookeanCiarlet};
use piola_specimens::checks::{Search, history_indifference};
use piola_testkit::spectral::{Random, with_stretches};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close};

use super::paths::{bergstrom_boyce, driven_growth, kinematic, mullins, reese_govindjee, viscoplastic};

type Fallible = Result<(), Box<dyn Error>>;

/// A path of random deformations with stretches between 0.75 and 1.35.
pub(crate) fn path(seed: u64, count: usize) -> Vec<DeformationGradient> {
    let mut random = Random::new(seed);
    let one = |random: &mut Random| {
        let stretches = core::array::from_fn(|_| (0.3 * random.symmetric()).exp());
        // Stretches about turned axes: every F between two of them has a positive determinant.
        let turn = random.rotation();
        DeformationGradient::from_rows(with_stretches(&turn, stretches, &turn)).expect("0 < det F")
    };
    (0..count).map(|_| one(&mut random)).collect()
}

fn check_dissipation<L: Evolution<S, X>, const S: usize, const X: usize>(what: &str, law: &L) -> Fallible {
    // A thousand and twenty increments.
    for seed in 30..30 + u64::from(random_cases(170)) {
        let mut point = InelasticPoint::new(law);
        for to in path(seed, 6) {
            let before = *point.state();
            let after = point.advance(&to, 0.25, &StepControl::one_step())?.state;
            let work = law.dissipated(&before, &rows_of(to.matrix()), &after);
            assert!(-1e-14 <= work, "{what}: {work:e} J/m³ in a step");
        }
    }
    Ok(())
}

#[test]
fn dissipation_of_steps_on_random_paths_is_not_negative() -> Fallible {
    check_dissipation("Bergström–Boyce", &bergstrom_boyce()?)?;
    check_dissipation("Reese–Govindjee", &reese_govindjee()?)?;
    check_dissipation("viscoplastic", &viscoplastic(0.5)?)?;
    check_dissipation("plastic", &viscoplastic(0.0)?)?;
    check_dissipation("kinematic", &kinematic(0.0)?)?;
    check_dissipation("kinematic, viscous", &kinematic(0.5)?)?;
    check_dissipation("in series", &in_series()?)
}

/// Work of a closed path that ends where it began, by the trapezoidal rule: Mullins' law stores nothing that it does not give back.
#[test]
fn work_of_mullins_law_on_closed_random_paths_is_not_negative() -> Fallible {
    let law = mullins()?;
    for seed in 40..40 + u64::from(random_cases(40)) {
        let mut point = InelasticPoint::new(&law);
        let mut corners = path(seed, 4);
        corners.push(DeformationGradient::identity());
        let (mut work, mut here) = (0.0, Matrix3::identity());
        let mut stress = Matrix3::zeros();
        for corner in corners {
            let start = here;
            for k in 1..=400 {
                let next = start + (corner.matrix() - start) * (f64::from(k) / 400.0);
                let then =
                    point.advance(&DeformationGradient::new(next)?, 0.0, &StepControl::one_step())?.first_piola.0;
                work += 0.5 * (stress + then).dot(&(next - here));
                (here, stress) = (next, then);
            }
        }
        assert!(0.0 <= work, "{work:e} J/m³");
    }
    Ok(())
}

/// P(Q F) = Q P(F) of each step of a path.
fn check_observer<L: Evolution<S, X>, const S: usize, const X: usize>(what: &str, law: &L) -> Fallible {
    let mut random = Random::new(50);
    for seed in 51..53 {
        // Both observers agree at the start; the second is turned in steps, so that each sees proportional paths of its own.
        let turn = Matrix3::from_fn({
            let rows = random.rotation();
            move |i, j| rows[i][j]
        });
        let first = DeformationGradient::identity();
        let turned = DeformationGradient::new(turn)?;
        let mut one = InelasticPoint::with_state(law, &law.initial(), &first)?;
        let mut other = InelasticPoint::with_state(law, &law.initial(), &turned)?;
        for (number, to) in path(seed, 4).into_iter().enumerate() {
            let (control, tol) = if number < 2 {
                (StepControl::one_step(), Tol::ulps_because(1e3, "rounding of some stiff steps"))
            } else {
                (
                    StepControl::default(),
                    Tol::stated(1e-8, "errors of two increments, each below 1e-10, times the stiffness"),
                )
            };
            let a = one.advance(&to, 0.2, &control)?;
            let b = other.advance(&DeformationGradient::new(turn * to.matrix())?, 0.2, &control)?;
            assert_close(what, b.first_piola.0.as_slice(), (turn * a.first_piola.0).as_slice(), tol);
            assert_close(what, &b.state, &a.state, tol);
        }
    }
    Ok(())
}

#[test]
fn stresses_seen_by_two_observers_are_those_of_one_turned() -> Fallible {
    check_observer("Bergström–Boyce", &bergstrom_boyce()?)?;
    check_observer("Reese–Govindjee", &reese_govindjee()?)?;
    check_observer("in series", &in_series()?)?;
    check_observer("viscoplastic", &viscoplastic(0.5)?)?;
    check_observer("plastic", &viscoplastic(0.0)?)?;
    check_observer("kinematic", &kinematic(0.0)?)?;
    check_observer("driven growth", &driven_growth()?)?;
    check_observer("given growth", &grown()?)?;
    check_observer("thermal", &hot()?)?;
    check_observer("Mullins", &mullins()?)
}

fn spring() -> Result<NeoHookeanCiarlet, Box<dyn Error>> {
    Ok(NeoHookeanCiarlet::with_constants(1.0, 5.0)?)
}

pub(crate) fn in_series() -> Result<InSeries<NeoHookeanCiarlet, Hencky>, Box<dyn Error>> {
    Ok(InSeries::new(spring()?, Hencky::new(3.0, 2.0)?, 0.5)?)
}

/// A body that is 120 K hotter than at its reference temperature.
pub(crate) fn hot() -> Result<Begun<Thermal<NeoHookeanCiarlet>, 1>, Box<dyn Error>> {
    let expansion = ThermalExpansion { coefficient: 1e-3, reference_temperature: 300.0 };
    Ok(Begun(Thermal::new(spring()?, expansion)?, [420.0]))
}

/// A body that has grown by different amounts along different axes.
pub(crate) fn grown() -> Result<Begun<GivenGrowth<NeoHookeanCiarlet>, 9>, Box<dyn Error>> {
    Ok(Begun(GivenGrowth::new(spring()?), [1.25, 0.125, 0.0, 0.0, 1.0, 0.25, 0.0, 0.0, 0.875]))
}

/// A body that is hot, or has grown, from the start.
pub(crate) struct Begun<L, const S: usize>(L, [f64; S]);

impl<L: Evolution<S, X>, const S: usize, const X: usize> Evolution<S, X> for Begun<L, S> {
    fn initial(&self) -> [f64; S] {
        self.1
    }
    fn residual<T: Real>(&self, from: &[T; S], f: &[[T; 3]; 3], x: &[T; X], dt: f64) -> [T; X] {
        self.0.residual(from, f, x, dt)
    }
    fn updated<T: Real>(&self, from: &[T; S], f: &[[T; 3]; 3], x: &[T; X], dt: f64) -> [T; S] {
        self.0.updated(from, f, x, dt)
    }
    fn first_piola<T: Real>(&self, f: &[[T; 3]; 3], state: &[T; S]) -> [[T; 3]; 3] {
        self.0.first_piola(f, state)
    }
}

/// As [`Evolution::evolves`] asks of a law, without rounding.
#[test]
fn states_after_unknowns_of_zero_are_those_before() -> Fallible {
    fn check<L: Evolution<S, X>, const S: usize, const X: usize>(what: &str, law: &L) -> Fallible {
        let mut point = InelasticPoint::new(law);
        for to in path(62, 6) {
            let before = point.advance(&to, 0.25, &StepControl::one_step())?.state;
            let after = law.updated(&before, &rows_of(to.matrix()), &[0.0; X], 0.25);
            assert_close(what, &after, &before, Tol::ulps(0.0));
        }
        Ok(())
    }
    check("viscoplastic", &viscoplastic(0.5)?)?;
    check("kinematic", &kinematic(0.0)?)
}

/// The checker's observers spin while the body deforms: with one step for each of its times the law sees only their places.
#[test]
fn the_checker_of_histories_finds_no_dependence_on_the_observer() -> Fallible {
    fn check<L: Evolution<S, X>, const S: usize, const X: usize>(what: &str, law: &L, steps: u32) -> Fallible {
        let search = Search { samples: 10, strain: 0.15, ..Search::default() };
        let material = OverHistory::new(law, 1.0, steps, StepControl::one_step())?;
        let report = history_indifference(&material, 1.0, &search);
        assert!(report.passes(), "{what}: {report:?}, {:?}", material.failure());
        Ok(())
    }
    check("plastic", &viscoplastic(0.0)?, 20)?;
    check("viscoplastic", &viscoplastic(0.5)?, 10)?;
    check("kinematic", &kinematic(0.0)?, 10)?;
    check("Bergström–Boyce", &bergstrom_boyce()?, 20)?;
    check("Reese–Govindjee", &reese_govindjee()?, 10)?;
    check("in series", &in_series()?, 10)?;
    check("Mullins", &mullins()?, 20)?;
    check("driven growth", &driven_growth()?, 20)?;
    check("thermal", &hot()?, 20)?;
    check("given growth", &grown()?, 20)
}

/// With η = 0, in Mullins' law, and behind growth and temperatures that are given, the time of an increment does not matter.
#[test]
fn stresses_of_laws_without_a_rate_do_not_depend_on_the_time() -> Fallible {
    fn check<L: Evolution<S, X>, const S: usize, const X: usize>(what: &str, law: &L) -> Fallible {
        let (mut slow, mut fast) = (InelasticPoint::new(law), InelasticPoint::new(law));
        for to in (0..u64::from(random_cases(170))).flat_map(|seed| path(60 + seed, 6)) {
            let a = slow.advance(&to, 1e3, &StepControl::one_step())?;
            let b = fast.advance(&to, 1e-3, &StepControl::one_step())?;
            assert_eq!(a.first_piola, b.first_piola, "{what}");
        }
        Ok(())
    }
    check("plastic", &viscoplastic(0.0)?)?;
    check("kinematic", &kinematic(0.0)?)?;
    check("thermal", &hot()?)?;
    check("given growth", &grown()?)?;
    check("Mullins", &mullins()?)
}

/// For η → 0 the viscoplastic stress tends to the plastic one.
#[test]
fn slow_viscoplastic_stress_equals_the_plastic_one() -> Fallible {
    let (viscous, plastic) = (viscoplastic(1e-9)?, viscoplastic(0.0)?);
    let (mut a, mut b) = (InelasticPoint::new(&viscous), InelasticPoint::new(&plastic));
    for to in path(61, 6) {
        let (p, q) = (a.advance(&to, 1e3, &StepControl::one_step())?, b.advance(&to, 1e3, &StepControl::one_step())?);
        let tol = Tol::stated(1e-10, "η α̇ is 1e-12 of the stress");
        assert_close("P", p.first_piola.0.as_slice(), q.first_piola.0.as_slice(), tol);
    }
    Ok(())
}
