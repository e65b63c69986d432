//! Twisted rods from checked records.

use piola_solutions::SolutionsError;
use piola_solutions::loads::{Tube, TwistedTube};

use super::TwistedRod;
use crate::model::Builder;
use crate::studies::limits::{load_limit, reach};
use piola_document::Record;

/// The state of one of the rods at a twist.
type StateAt = fn(&TwistedRod, f64) -> Result<TwistedTube, SolutionsError>;

impl Builder<'_> {
    pub(in crate::studies) fn twisted_rod(&mut self, scene: &Record, table: &Record) -> Option<TwistedRod> {
        let law = self.law(scene, "torsion");
        let [inner, outer] = self.radii(table)?;
        let tube = if inner <= 0.0 { Tube::solid(outer) } else { Tube::new(inner, outer) };
        let rod = TwistedRod {
            tube: tube.ok()?,
            law: law?,
            twist: table.number("twist")?,
            axial_stretch: table.number("axial_stretch")?,
            axial_force: table.number("axial_force")?,
            torque: table.number("torque"),
            points: table.count("points")?,
        };
        // What cannot be had without twist is a mistake of the end, otherwise of the twist.
        let ends: [(&str, StateAt); 2] =
            [("axial_stretch", TwistedRod::held_at), ("axial_force", TwistedRod::pulled_at)];
        for (key, state) in ends {
            if let Err(error) = state(&rod, 0.0) {
                let found = format!("the rod cannot be held so without twist: {error}");
                let valid = if key == "axial_force" { "a force nearer to zero" } else { "a stretch nearer to 1" };
                return self.refused(table.place_of(key), found, valid);
            }
            if let Err(error) = state(&rod, rod.twist) {
                let most = reach((0.0, rod.twist), |twist| state(&rod, twist).is_ok());
                return self.refused(
                    table.place_of("twist"),
                    error.to_string(),
                    format!("a twist below {most:.6e} rad/m"),
                );
            }
        }
        if let Some(torque) = rod.torque
            && let Err(error) = rod.states_at(torque)
        {
            return self.refused(
                table.place_of("torque"),
                format!("no state carries the torque: {error}"),
                load_limit(&error, "N m"),
            );
        }
        Some(rod)
    }
}
