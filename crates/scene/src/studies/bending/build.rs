//! Bent blocks from checked records.

use core::f64::consts::TAU;

use piola_solutions::loads::Block;

use super::BentBlockStudy;
use crate::model::Builder;
use crate::studies::limits::{load_limit, reach};
use piola_document::Record;

impl Builder<'_> {
    pub(in crate::studies) fn bent_block(&mut self, scene: &Record, table: &Record) -> Option<BentBlockStudy> {
        let law = self.law(scene, "bending");
        let block = Block::new(table.number("thickness")?, table.number("length")?, table.number("height")?);
        let angle = table.number("angle")?;
        if TAU * (1.0 + 1e-12) < angle {
            return self.refused(
                table.place_of("angle"),
                format!("an angle of {angle:.6} rad: the ends overlap"),
                "at most a full turn, \"360 deg\"",
            );
        }
        let study = BentBlockStudy {
            block: block.ok()?,
            law: law?,
            angle,
            axial_stretch: table.number("axial_stretch")?,
            moment: table.number("moment"),
            points: table.count("points")?,
        };
        let (least, most) = study.range();
        if let Err(error) = study.state(least) {
            return self.refused(
                table.place_of("axial_stretch"),
                format!("the block cannot be stretched so: {error}"),
                "a stretch nearer to 1",
            );
        }
        if let Err(error) = study.state(most) {
            let most = reach((least, most), |angle| study.state(angle).is_ok());
            return self.refused(table.place_of("angle"), error.to_string(), format!("an angle below {most:.6} rad"));
        }
        if let Some(moment) = study.moment
            && let Err(error) = study.states_at(moment)
        {
            return self.refused(
                table.place_of("moment"),
                format!("no state carries the moment: {error}"),
                load_limit(&error, "N m"),
            );
        }
        Some(study)
    }
}
