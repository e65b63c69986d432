//! Wave fronts from checked records.

use core::f64::consts::TAU;

use super::{Medium, MediumPart, Source, Wavefront};
use crate::model::Builder;
use piola_document::Record;
use piola_studies::fronts::MOST_RAYS;

impl Builder<'_> {
    pub(in crate::studies) fn wavefront(&mut self, scene: &Record, table: &Record) -> Option<Wavefront> {
        let records = scene.records("medium");
        if records.is_empty() && !scene.has("medium") {
            self.refuse(
                table.place.clone(),
                "[wavefront] without a medium",
                "at least one [[medium]], as type = \"uniform\"",
            );
        }
        let parts: Vec<Option<MediumPart>> = records.iter().map(|record| self.medium_part(record)).collect();
        let source = self.source(table);
        let length = table.number("length")?;
        let medium = Medium { parts: parts.into_iter().collect::<Option<_>>()? };
        let source = source?;
        if table.has("spacing") {
            let (spacing, most) = (table.number("spacing")?, MOST_RAYS as f64);
            let front = source.front(length, medium.index(source.middle()));
            if most * spacing < front {
                return self.refused(
                    table.place_of("spacing"),
                    format!("a spacing of {spacing:e} m makes {:.1e} rays of a front of {front:.3} m", front / spacing),
                    format!("at least {:.3e} m, for at most {MOST_RAYS} rays", front / most),
                );
            }
        }
        Some(Wavefront {
            source,
            medium,
            length,
            fronts: table.count("fronts")?,
            rays: table.count("rays")?,
            spacing: table.number("spacing").unwrap_or(length / 200.0),
            first_only: table.text("keep")? == "first",
        })
    }

    fn source(&mut self, table: &Record) -> Option<Source> {
        let place = table.pair("position")?;
        if table.text("type")? == "plane" {
            let [u, v] = table.pair("direction")?;
            let size = u.hypot(v);
            if size <= 0.0 {
                return self.refused(
                    table.place_of("direction"),
                    "a direction of no length",
                    "two numbers that are not both zero",
                );
            }
            return Some(Source::Plane {
                middle: place,
                direction: [u / size, v / size],
                width: table.number("width")?,
            });
        }
        let from = table.number("from")?;
        let to = if table.has("to") { table.number("to")? } else { from + TAU };
        if from < to && to - from <= TAU * (1.0 + 1e-12) {
            return Some(Source::Point { place, from, to });
        }
        self.refused(
            table.place_of("to"),
            format!("directions from {from} rad to {to} rad"),
            format!("more than {from} rad, by at most a full turn"),
        )
    }

    fn medium_part(&mut self, record: &Record) -> Option<MediumPart> {
        match record.text("type")? {
            "uniform" => Some(MediumPart::Uniform { index: record.number("index")? }),
            "luneburg" => {
                Some(MediumPart::Luneburg { centre: record.pair("centre")?, radius: record.number("radius")? })
            }
            "layers" => Some(MediumPart::Layers {
                index: record.number("index")?,
                gradient: record.number("gradient")?,
                height: record.number("height")?,
            }),
            _ => {
                let amplitude = record.number("amplitude")?;
                if amplitude <= -1.0 {
                    return self.refused(
                        record.place_of("amplitude"),
                        format!("the amplitude {amplitude} makes the index {} at the centre", 1.0 + amplitude),
                        "a number greater than -1",
                    );
                }
                Some(MediumPart::Gaussian {
                    centre: record.pair("centre")?,
                    radius: record.number("radius")?,
                    amplitude,
                })
            }
        }
    }
}
