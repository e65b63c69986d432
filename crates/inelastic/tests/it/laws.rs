//! Identities on random paths: no dependence on the observer, no negative dissipation, no rate where there is none.

use core::error::Error;

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_inelastic::{Evolution, InelasticPoint, OverHistory, StepControl};
use piola_numerics::linear::matrix3::rows_of;
use piola_specimens::checks::{Search, history_indifference};
use piola_testkit::spectral::{Random, with_stretches};
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
    for seed in 30..36 {
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
    check_dissipation("kinematic", &kinematic(0.0)?)
}

/// Work of a closed path that ends where it began, by the trapezoidal rule: Mullins' law stores nothing that it does not give back.
#[test]
fn work_of_mullins_law_on_closed_random_paths_is_not_negative() -> Fallible {
    let law = mullins()?;
    for seed in 40..44 {
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
    check_observer("driven growth", &driven_growth()?)?;
    check_observer("Mullins", &mullins()?)
}

/// The checker's observers spin while the body deforms: with one step for each of its times the law sees only their places.
#[test]
fn the_checker_of_histories_finds_no_dependence_on_the_observer() -> Fallible {
    let search = Search { samples: 10, strain: 0.15, ..Search::default() };
    let plastic = viscoplastic(0.0)?;
    let material = OverHistory::new(&plastic, 1.0, 20, StepControl::one_step())?;
    let report = history_indifference(&material, 1.0, &search);
    assert!(report.passes(), "{report:?}, {:?}", material.failure());
    let kinematic = kinematic(0.0)?;
    let material = OverHistory::new(&kinematic, 1.0, 10, StepControl::one_step())?;
    let report = history_indifference(&material, 1.0, &search);
    assert!(report.passes(), "{report:?}, {:?}", material.failure());
    let flowing = bergstrom_boyce()?;
    let material = OverHistory::new(&flowing, 1.0, 20, StepControl::one_step())?;
    let report = history_indifference(&material, 1.0, &search);
    assert!(report.passes(), "{report:?}, {:?}", material.failure());
    Ok(())
}

/// With η = 0, and in Mullins' law, the time of an increment does not matter.
#[test]
fn stresses_of_laws_without_a_rate_do_not_depend_on_the_time() -> Fallible {
    fn check<L: Evolution<S, X>, const S: usize, const X: usize>(what: &str, law: &L) -> Fallible {
        let (mut slow, mut fast) = (InelasticPoint::new(law), InelasticPoint::new(law));
        for to in path(60, 6) {
            let a = slow.advance(&to, 1e3, &StepControl::one_step())?;
            let b = fast.advance(&to, 1e-3, &StepControl::one_step())?;
            assert_eq!(a.first_piola, b.first_piola, "{what}");
        }
        Ok(())
    }
    check("plastic", &viscoplastic(0.0)?)?;
    check("kinematic", &kinematic(0.0)?)?;
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
