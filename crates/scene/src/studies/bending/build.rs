//! Bent blocks from checked records.

use core::f64::consts::TAU;

use piola_solutions::LoadCurve;
use piola_solutions::loads::Block;

use super::BentBlockStudy;
use crate::model::Builder;
use crate::studies::limits::{load_limit, reach};
use piola_document::Mistake;
use piola_document::Record;

impl Builder<'_> {
    pub(in crate::studies) fn bent_block(&mut self, scene: &Record, table: &Record) -> Option<BentBlockStudy> {
        let law = self.law(scene, "bending");
        let block = Block::new(table.number("thickness")?, table.number("length")?, table.number("height")?);
        let angle = table.number("angle")?;
        if TAU * (1.0 + 1e-12) < angle {
            self.wrong(
                Mistake::new(table.place_of("angle"), format!("an angle of {angle:.6} rad: the ends overlap"))
                    .valid("at most a full turn, \"360 deg\""),
            );
            return None;
        }
        let study = BentBlockStudy {
            block: block.ok()?,
            law: law?,
            angle,
            axial_stretch: table.number("axial_stretch")?,
            moment: table.number("moment"),
            points: table.count("points")?,
        };
        let bending = study.bending();
        let (least, most) = study.range();
        if let Err(error) = bending.state(least) {
            self.wrong(
                Mistake::new(table.place_of("axial_stretch"), format!("the block cannot be stretched so: {error}"))
                    .valid("a stretch nearer to 1"),
            );
            return None;
        }
        if let Err(error) = bending.state(most) {
            let most = reach((least, most), |angle| bending.state(angle).is_ok());
            self.wrong(
                Mistake::new(table.place_of("angle"), error.to_string()).valid(format!("an angle below {most:.6} rad")),
            );
            return None;
        }
        if let Some(moment) = study.moment
            && let Err(error) = bending.states_at(moment, (least, most))
        {
            self.wrong(
                Mistake::new(table.place_of("moment"), format!("no state carries the moment: {error}"))
                    .valid(load_limit(&error, "N m")),
            );
            return None;
        }
        Some(study)
    }
}
