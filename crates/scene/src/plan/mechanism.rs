//! What the plan says of forces and constraints of a mechanism.

use piola_simulation::constraints::{Constraint, ConstraintKind};
use piola_simulation::forces::Force;
use piola_simulation::questions::MechanismQuestions;

use super::{Method, Plan};
use crate::model::Mechanism;

/// The number of works that are integrated with the motion.
pub(super) fn works(system: &Mechanism) -> usize {
    system.work_names().len()
}

/// The tables of works and reactions.
pub(super) fn tables(system: &Mechanism) -> impl Iterator<Item = &'static str> {
    let asked = system.reactions;
    let tables = [
        ("works.csv", 0 < works(system)),
        ("reactions.csv", asked),
        ("energies.csv", system.questions.energies),
        ("modes.csv", system.questions.modes),
        ("constraints.csv", asked && !system.constraints.is_empty()),
    ];
    tables.into_iter().filter(|(_, written)| *written).map(|(name, _)| name)
}

impl Plan {
    /// Whether each independent part of a mechanism takes steps of its own.
    pub(crate) fn integrates_islands(&self, system: &Mechanism) -> bool {
        let adapts = self.method.step().is_none() && self.method != Method::ClosedForm;
        adapts && system.simplify
    }

    /// How the motion is found, and what of the mechanism its steps do not see.
    pub(super) fn evaluation_items(&mut self, system: &Mechanism) {
        if self.method == Method::ClosedForm {
            self.compute("top of Lagrange", "in closed form at every recorded instant");
            self.skip("accelerations and steps", "the closed form needs neither");
            return;
        }
        self.compute("accelerations", "inertia metric and bias in one pass, by exact derivatives of the placement");
        let islands = if self.integrates_islands(system) { system.islands().len() } else { 1 };
        if !system.simplify {
            self.skip("simplifications", "integrator.simplify = false");
            return;
        }
        if 1 < islands {
            let why = "they share no coordinate, force or constraint: each is integrated with steps of its own";
            self.compute(&format!("{islands} independent parts"), why);
            self.skip("influence of independent parts on each other", "there is none");
        }
        let reduction = system.reduction();
        if !reduction.still.is_empty() {
            let names: Vec<&str> = reduction.still.iter().map(|part| system.parts[*part].name.as_str()).collect();
            self.skip("parts that stand still", format!("no coordinate moves them: {}", names.join(", ")));
        }
        if 0 < reduction.merged_joints {
            let count = reduction.merged_joints;
            self.skip("fixed joints", format!("merged with the joints that carry them: {count}"));
        }
        if 0 < reduction.merged_parts {
            let count = reduction.merged_parts;
            self.skip("parts of one joint", format!("evaluated as one body: {count} fewer"));
        }
    }

    pub(super) fn force_items(&mut self, system: &Mechanism) {
        for Force { name, kind } in &system.forces {
            let what = match (kind.stores(), kind.works()) {
                (true, true) => "stores energy, and works: its power is integrated with the motion",
                (true, false) => "stores energy: by exact derivatives",
                (false, true) => "works: its power is integrated with the motion",
                (false, false) => {
                    self.skip(name, "neither stiffness nor damping");
                    continue;
                }
            };
            self.compute(&format!("force `{name}`"), what);
        }
        if system.forces.is_empty() {
            self.skip("forces besides gravity", "no [[force]]");
        }
        if 0 < works(system) {
            self.compute("energy less work", "conserved: at every recorded instant");
        } else {
            self.compute("energy", "conserved: at every recorded instant");
            self.skip("work", "nothing takes energy or gives it");
        }
    }

    /// What holds the mechanism, and how far its start must move for that.
    pub(super) fn constraint_items(&mut self, system: &Mechanism, start: f64) {
        for Constraint { name, kind } in &system.constraints {
            let what = match kind {
                ConstraintKind::Distance { length, .. } => format!("a distance of {length} m, by a multiplier"),
                ConstraintKind::Rolling { radius, axis, .. } => {
                    let what = if axis.is_some() { "disc" } else { "sphere" };
                    format!(
                        "a {what} of radius {radius} m rolls: the rates that are free are integrated, nothing slips"
                    )
                }
                ConstraintKind::Loop { .. } => "a closed loop, by three multipliers".to_string(),
                ConstraintKind::Prescribed { .. } => {
                    "a prescribed motion, by a multiplier: its drive works".to_string()
                }
            };
            self.compute(&format!("constraint `{name}`"), what);
        }
        if system.constraints.is_empty() {
            self.skip("multipliers", "no [[constraint]]");
        } else if system.rolls() {
            self.skip("multipliers", "bodies that roll need none");
        } else {
            let constrained = system.constrained();
            let why = match constrained.assemble(&system.position, &system.velocity, start) {
                Err(error) => format!("no start is found: {error}"),
                Ok(closed) => {
                    let moves = closed.coordinates.iter().zip(&system.position).map(|(a, b)| (a - b).abs());
                    let free = constrained.degrees_of_freedom(&closed.coordinates, start).unwrap_or_default();
                    let most = moves.fold(0.0, f64::max);
                    format!("coordinates move by at most {most:.1e} to satisfy it; {free} degrees of freedom are left")
                }
            };
            self.compute("start under constraints", why);
        }
        let MechanismQuestions { equilibrium, modes, energies } = system.questions;
        for (asked, what, key) in [
            (equilibrium || modes, "equilibrium and its stability", "equilibrium"),
            (modes, "modes of small motions", "modes"),
            (energies, "energies by part", "energies"),
        ] {
            if asked {
                self.compute(what, "[questions] asks for it");
            } else {
                self.skip(what, format!("questions.{key} = false"));
            }
        }
        if system.reactions {
            self.compute("reactions", "output.reactions = true: at every recorded instant");
        } else {
            self.skip("reactions", "output.reactions = false");
        }
    }
}
