//! Rooms from checked records.

use super::{Outline, Room, Speed};
use crate::model::Builder;
use piola_document::Record;
use piola_document::words;

/// The part of the largest speed below which rounding of the place changes the speed by too much.
const LEAST_PART: f64 = 1e-5;

impl Builder<'_> {
    pub(in crate::studies) fn room(&mut self, table: &Record) -> Option<Room> {
        let outline = self.outline(table);
        let speed = Speed { at_origin: table.number("speed")?, gradient: table.pair("speed_gradient")? };
        let outline = outline?;
        let [a, b] = outline.semi_axes;
        let room = Room {
            outline,
            speed,
            circle: None,
            resolution: table.number("resolution").unwrap_or(a.min(b) / 2000.0),
            grid: table.count("grid")?,
        };
        let least = room.least_speed();
        let largest = 2.0 * speed.at_origin - least;
        if least.is_nan() || least < LEAST_PART * largest {
            return self.refused(
                table.place_of("speed_gradient"),
                format!("the speed falls to {} m/s at a corner of the rectangle around the room", words::number(least)),
                "a gradient so small that it is at least 1e-5 of the largest speed there",
            );
        }
        let circle = if table.text("signal")? == "circle" { Some(self.circle(table, &outline)?) } else { None };
        if circle.is_none()
            && let Some(key) = ["centre", "radius"].into_iter().find(|key| table.has(key))
        {
            self.refuse(
                table.place_of(key),
                format!("`{key}` with a signal from the wall"),
                "signal = \"circle\", or nothing",
            );
        }
        Some(Room { circle, ..room })
    }

    fn outline(&mut self, table: &Record) -> Option<Outline> {
        let semi_axes = table.pair("semi_axes")?;
        let [least, most] = [semi_axes[0].min(semi_axes[1]), semi_axes[0].max(semi_axes[1])];
        if least < 1e-12 || 1e12 < most || 1e3 * least < most {
            return self.refused(
                table.place_of("semi_axes"),
                format!("semi-axes of {} m", words::numbers(&semi_axes)),
                "two lengths from 1e-12 m to 1e12 m, one at most 1000 times the other",
            );
        }
        let mut exponent = 2;
        if table.text("type")? == "superellipse" {
            let count = table.count("exponent")?;
            if !count.is_multiple_of(2) {
                return self.refused(
                    table.place_of("exponent"),
                    format!("the exponent {count} is odd"),
                    "an even number from 2 to 12",
                );
            }
            exponent = i32::try_from(count).ok()?;
        }
        Some(Outline { centre: [0.0; 2], semi_axes, exponent })
    }

    fn circle(&mut self, table: &Record, room: &Outline) -> Option<Outline> {
        if !table.has("radius") {
            return self.refused(
                table.place.clone(),
                "a signal from a circle lacks `radius`",
                "radius = a length greater than zero",
            );
        }
        let radius = table.number("radius")?;
        let circle = Outline { centre: table.pair("centre")?, semi_axes: [radius; 2], exponent: 2 };
        let inside = (0..360).all(|degree| room.level(circle.place(f64::from(degree).to_radians())) < 1.0);
        if !inside {
            return self.refused(
                table.place_of("radius"),
                "the circle is not within the room",
                "a smaller radius, or another centre",
            );
        }
        Some(circle)
    }
}
