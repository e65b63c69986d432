//! Loads and parts of the state at the start.

use piola_spectral::{Parity, Walls};

use super::numbers::in_words;
use crate::model::Builder;
use crate::studies::boxes::{AXES, Form, Load, Start};
use piola_document::{Record, words};

/// What the forms of a scene must fit.
#[derive(Clone, Copy)]
pub(super) struct Frame<const D: usize> {
    pub(super) sides: [f64; D],
    pub(super) walls: Walls,
    /// The highest indices.
    pub(super) highest: [usize; D],
    /// The largest spacing of the grid that samples them, m; 0 without a grid.
    pub(super) spacing: f64,
}

impl Builder<'_> {
    /// The loads; `end` is that of a motion.
    pub(super) fn loads<const D: usize>(
        &mut self,
        scene: &Record,
        frame: Frame<D>,
        end: Option<f64>,
    ) -> Option<Vec<Load<D>>> {
        let loads: Vec<_> = scene.records("load").iter().map(|record| self.load(record, frame, end)).collect();
        loads.into_iter().collect()
    }

    fn load<const D: usize>(&mut self, record: &Record, frame: Frame<D>, end: Option<f64>) -> Option<Load<D>> {
        let span = self.span(record, end);
        let form = match record.text("type")? {
            name @ ("point" | "line") => {
                let [dimensions, key, other] =
                    if name == "point" { ["3", "force", "line"] } else { ["2", "force_per_length", "point"] };
                if dimensions != D.to_string() {
                    return self.refused(
                        record.place_of("type"),
                        format!("a {name} load in a [box] of {D} sides"),
                        format!("type = \"{other}\""),
                    );
                }
                Form::Point { total: self.each_axis(record, key)?, at: self.place_in_box(record, frame.sides)? }
            }
            name => self.form(record, name, "force_per_volume", frame)?,
        };
        Some(Load { form, span: span?, course: record.numbers("course")?.to_vec() })
    }

    fn span(&mut self, record: &Record, end: Option<f64>) -> Option<[f64; 2]> {
        let Some(end) = end else {
            if let Some(key) = ["from", "until", "course"].into_iter().find(|key| record.has(key)) {
                return self.refused(
                    record.place_of(key),
                    format!("`{key}` of a steady load"),
                    "nothing: only the loads of a motion change with time",
                );
            }
            return Some([0.0, f64::INFINITY]);
        };
        let (from, until) = (record.number("from")?, record.number("until"));
        if record.has("until") && until.is_none() {
            return None;
        }
        let until = until.unwrap_or(end);
        if from < until {
            return Some([from, until]);
        }
        let key = if record.has("until") { "until" } else { "from" };
        self.refused(
            record.place_of(key),
            format!("the load ends at {} s and begins at {} s", words::number(until), words::number(from)),
            "an end after the beginning; without `until` it is the end of the motion",
        )
    }

    /// The parts of the state at the start.
    pub(super) fn starts<const D: usize>(&mut self, scene: &Record, frame: Frame<D>) -> Option<Vec<Start<D>>> {
        let starts: Vec<_> = scene.records("start").iter().map(|record| self.start(record, frame)).collect();
        starts.into_iter().collect()
    }

    fn start<const D: usize>(&mut self, record: &Record, frame: Frame<D>) -> Option<Start<D>> {
        let is_velocity = record.has("velocity");
        if is_velocity == record.has("displacement") {
            let (place, what) = if is_velocity {
                (record.place_of("velocity"), "both `displacement` and `velocity`")
            } else {
                (record.place.clone(), "neither `displacement` nor `velocity`")
            };
            return self.refused(place, format!("a [[start]] with {what}"), "one of them in each [[start]]");
        }
        let key = if is_velocity { "velocity" } else { "displacement" };
        Some(Start { form: self.form(record, record.text("type")?, key, frame)?, is_velocity })
    }

    /// A uniform field, a Gaussian or a mode, with its components in a key.
    fn form<const D: usize>(&mut self, record: &Record, name: &str, key: &str, frame: Frame<D>) -> Option<Form<D>> {
        let value: Option<[f64; D]> = self.each_axis(record, key);
        match name {
            "uniform" => Some(Form::Uniform { value: value? }),
            "gaussian" => {
                let at = self.place_in_box(record, frame.sides);
                let radius = record.number("radius")?;
                if radius < frame.spacing {
                    let (radius, spacing) = (words::number(radius), words::number(frame.spacing));
                    return self.refused(
                        record.place_of("radius"),
                        format!("the radius {radius} m is less than the spacing {spacing} m of the grid"),
                        format!("at least {spacing} m, or more `points`"),
                    );
                }
                Some(Form::Gaussian { value: value?, at: at?, radius })
            }
            _ => {
                let indices = self.whole(record, "indices");
                self.mode(record, value?, indices?, frame)
            }
        }
    }

    fn mode<const D: usize>(
        &mut self,
        record: &Record,
        amplitudes: [f64; D],
        indices: [usize; D],
        Frame { walls, highest, .. }: Frame<D>,
    ) -> Option<Form<D>> {
        if indices.iter().zip(highest).any(|(index, highest)| highest < *index) {
            return self.refused(
                record.place_of("indices"),
                format!("the mode {} is beyond the highest, {}", in_words(&indices), in_words(&highest)),
                "a lower mode, or more `points` or `modes` of the [box]",
            );
        }
        for (component, amplitude) in amplitudes.iter().enumerate() {
            let vanishes = |axis: &usize| indices[*axis] == 0 && walls.parity(component, *axis) == Parity::Sine;
            if amplitude.abs() <= 0.0 {
                continue;
            }
            if let Some(axis) = (0..D).find(vanishes) {
                let (of, along) = (AXES[component], AXES[axis]);
                return self.refused(
                    record.place_of("indices"),
                    format!("the {of} component of the mode {} vanishes everywhere", in_words(&indices)),
                    format!("at least 1 along {along}, or the amplitude 0 of the {of} component"),
                );
            }
        }
        Some(Form::Mode { amplitudes, indices })
    }
}
