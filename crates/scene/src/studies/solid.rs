//! Studies of solids as one subject.

use serde_json::Value;

use super::balloon::{Balloon, BalloonCurve};
use super::bending::{BendingCurve, BentBlockStudy};
use super::dislocation::{BurgersCircuits, ScrewDislocations};
use super::laminated_tube::{LayeredTube, TubeStresses};
use super::torsion::{RodCurves, TwistedRod};
use super::{StudyPlan, Subject, balloon, bending, dislocation, laminated_tube, torsion};
use crate::model::Builder;
use piola_document::Mistake;
use piola_document::Record;
use piola_studies::{Observer, Outcome};

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
            Self::Balloon(study) => balloon::plan(study, plan),
            Self::Torsion(study) => torsion::plan(study, plan),
            Self::Bending(study) => bending::plan(study, plan),
            Self::Dislocation(study) => dislocation::plan(study, plan),
            Self::LaminatedTube(study) => laminated_tube::plan(study, plan),
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
            Self::Balloon(found) => balloon::results(found),
            Self::Torsion(found) => torsion::results(found),
            Self::Bending(found) => bending::results(found),
            Self::Dislocation(found) => dislocation::results(found),
            Self::LaminatedTube(found) => laminated_tube::results(found),
        }
    }

    pub(super) fn file(&self, asked: &SolidStudy, title: &str, name: &str) -> Option<String> {
        match (self, asked) {
            (Self::Balloon(found), SolidStudy::Balloon(asked)) => balloon::file(found, asked, title, name),
            (Self::Torsion(found), SolidStudy::Torsion(asked)) => torsion::file(found, asked, title, name),
            (Self::Bending(found), SolidStudy::Bending(asked)) => bending::file(found, asked, title, name),
            (Self::Dislocation(found), SolidStudy::Dislocation(asked)) => dislocation::file(found, asked, title, name),
            (Self::LaminatedTube(found), SolidStudy::LaminatedTube(asked)) => {
                laminated_tube::file(found, asked, title, name)
            }
            _ => None,
        }
    }
}
