//! Studies of solids as one subject, and what they share.

use core::fmt::Write as _;

use piola_solids::isochoric::Isochoric;
use serde_json::Value;

use super::balloon::{Balloon, BalloonCurve};
use super::bending::{BendingCurve, BentBlockStudy};
use super::dislocation::{BurgersCircuits, ScrewDislocations};
use super::laminated_tube::{LayeredTube, TubeStresses};
use super::panel::quantity;
use super::run::Observer;
use super::torsion::{RodCurves, TwistedRod};
use super::{StudyPlan, Subject};
use crate::document::Mistake;
use crate::model::Builder;
use crate::run::Outcome;
use crate::validation::Record;

/// A study of a solid.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum SolidStudy {
    /// A balloon.
    Balloon(Balloon),
    /// A twisted rod.
    Torsion(TwistedRod),
    /// A bent block.
    Bending(BentBlockStudy),
    /// A crystal with screw dislocations.
    Dislocation(ScrewDislocations),
    /// A tube with residual stress.
    LaminatedTube(LayeredTube),
}

/// The results of a study of a solid.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum SolidFindings {
    /// Of a balloon.
    Balloon(BalloonCurve),
    /// Of a twisted rod.
    Torsion(RodCurves),
    /// Of a bent block.
    Bending(BendingCurve),
    /// Of a crystal with screw dislocations.
    Dislocation(BurgersCircuits),
    /// Of a tube with residual stress.
    LaminatedTube(TubeStresses),
}

/// The principal normal stresses of a particle with its coordinates.
///
/// # Example
/// See [`Balloon`](super::Balloon).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressAt {
    /// X or R in the reference, m.
    pub reference: f64,
    /// r, m.
    pub radius: f64,
    /// `T_rr`, `T_θθ`, `T_zz` (of a sphere `T_φφ`) and `T_θz`, Pa.
    pub stress: [f64; 4],
}

/// Names of the components of [`StressAt`].
pub(super) const COMPONENTS: [&str; 4] = ["T_rr", "T_θθ", "T_zz", "T_θz"];

impl StressAt {
    /// Of components in the order rr, θθ, zz, rθ, θz, rz.
    pub(super) const fn of(reference: f64, radius: f64, [rr, tt, zz, _, tz, _]: [f64; 6]) -> Self {
        Self { reference, radius, stress: [rr, tt, zz, tz] }
    }
}

/// A table of stresses: a state, its particles.
pub(super) fn stress_table<'s>(states: impl Iterator<Item = (String, &'s [StressAt])>) -> String {
    let mut text = String::from("state,reference_m,radius_m,T_rr_Pa,T_tt_Pa,T_zz_Pa,T_tz_Pa\n");
    for (state, particles) in states {
        for StressAt { reference, radius, stress: [rr, tt, zz, tz] } in particles {
            let _ = writeln!(text, "{state},{reference:?},{radius:?},{rr:?},{tt:?},{zz:?},{tz:?}");
        }
    }
    text
}

/// Places from the inner to the outer face, both among them.
pub(super) fn through([inner, outer]: [f64; 2], parts: u32) -> impl Iterator<Item = f64> {
    (0..=parts).map(move |i| match i {
        0 => inner,
        _ if i == parts => outer,
        _ => inner + (outer - inner) * f64::from(i) / f64::from(parts),
    })
}

/// The largest number up to `high` at which a test succeeds, where it does at `low` and not at `high`.
pub(super) fn reach((low, high): (f64, f64), succeeds: impl Fn(f64) -> bool) -> f64 {
    let (mut good, mut bad) = (low, high);
    for _ in 0..40 {
        let middle = f64::midpoint(good, bad);
        if succeeds(middle) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    good
}

/// The end of a run whose steps may have failed.
pub(super) fn outcome<E: core::fmt::Display>(result: Result<bool, E>) -> Outcome {
    match result {
        Ok(true) => Outcome::Completed,
        Ok(false) => Outcome::Interrupted,
        Err(error) => Outcome::Failed(error.to_string()),
    }
}

/// A law in words, with the scale of its stresses.
pub(super) fn material(law: &super::Law) -> String {
    format!("{} rubber of shear modulus {}", law.name(), quantity("Pa", law.shear_modulus()))
}

impl Builder<'_> {
    /// The study of a solid of the kind `name`.
    pub(super) fn solid(&mut self, scene: &Record, table: &Record, name: &str) -> Option<Subject> {
        let study = match name {
            "balloon" => SolidStudy::Balloon(self.balloon(scene, table)?),
            "torsion" => SolidStudy::Torsion(self.twisted_rod(scene, table)?),
            "bending" => SolidStudy::Bending(self.bent_block(scene, table)?),
            "dislocation" => SolidStudy::Dislocation(self.screw_dislocations(table)?),
            _ => SolidStudy::LaminatedTube(self.layered_tube(scene, table)?),
        };
        Some(Subject::Solid(study))
    }

    /// Refuses radii that do not increase.
    pub(super) fn radii(&mut self, table: &Record) -> Option<[f64; 2]> {
        let radii = [table.number("inner_radius")?, table.number("outer_radius")?];
        if radii[0] < radii[1] {
            return Some(radii);
        }
        self.wrong(
            Mistake::new(
                table.place_of("outer_radius"),
                format!("the outer radius {} m is not above the inner radius {} m", radii[1], radii[0]),
            )
            .see(table.place_of("inner_radius"), "the inner radius")
            .valid(format!("more than {} m", radii[0])),
        );
        None
    }
}

impl SolidStudy {
    /// Fills a plan; the tables and figures of this study.
    pub(super) fn plan(&self, plan: &mut StudyPlan) -> (&'static [&'static str], &'static [&'static str]) {
        match self {
            Self::Balloon(study) => study.plan(plan),
            Self::Torsion(study) => study.plan(plan),
            Self::Bending(study) => study.plan(plan),
            Self::Dislocation(study) => study.plan(plan),
            Self::LaminatedTube(study) => study.plan(plan),
        }
    }

    pub(super) fn run(&self, observer: &mut Observer<'_>) -> (SolidFindings, Outcome) {
        match self {
            Self::Balloon(study) => with(SolidFindings::Balloon, study.run(observer)),
            Self::Torsion(study) => with(SolidFindings::Torsion, study.run(observer)),
            Self::Bending(study) => with(SolidFindings::Bending, study.run(observer)),
            Self::Dislocation(study) => with(SolidFindings::Dislocation, study.run(observer)),
            Self::LaminatedTube(study) => with(SolidFindings::LaminatedTube, study.run(observer)),
        }
    }
}

fn with<F>(make: fn(F) -> SolidFindings, (found, outcome): (F, Outcome)) -> (SolidFindings, Outcome) {
    (make(found), outcome)
}

impl SolidFindings {
    pub(super) fn results(&self) -> Value {
        match self {
            Self::Balloon(found) => found.results(),
            Self::Torsion(found) => found.results(),
            Self::Bending(found) => found.results(),
            Self::Dislocation(found) => found.results(),
            Self::LaminatedTube(found) => found.results(),
        }
    }

    pub(super) fn file(&self, asked: &SolidStudy, title: &str, name: &str) -> Option<String> {
        match (self, asked) {
            (Self::Balloon(found), SolidStudy::Balloon(asked)) => found.file(asked, title, name),
            (Self::Torsion(found), SolidStudy::Torsion(asked)) => found.file(asked, title, name),
            (Self::Bending(found), SolidStudy::Bending(asked)) => found.file(asked, title, name),
            (Self::Dislocation(found), SolidStudy::Dislocation(asked)) => found.file(asked, title, name),
            (Self::LaminatedTube(found), SolidStudy::LaminatedTube(asked)) => found.file(asked, title, name),
            _ => None,
        }
    }
}
