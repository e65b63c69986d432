//! Tables and the figure.

use core::cell::RefCell;
use core::fmt::Write as _;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Sections;
use super::run::{allowed, square_across};
use crate::output::figures::{FINE, FONT, GRID, INK, figure, pixels};
use crate::studies::chart::{Canvas, Window, between, colour_bar, with_paths};

const REGULAR: RGBColor = RGBColor(0, 90, 160);
const MIDDLE: RGBColor = RGBColor(190, 190, 60);
const CHAOTIC: RGBColor = RGBColor(205, 50, 30);

/// Blue for zero, red for the largest.
fn shade(share: f64) -> RGBColor {
    if share < 0.5 { between(REGULAR, MIDDLE, 2.0 * share) } else { between(MIDDLE, CHAOTIC, 2.0 * share - 1.0) }
}

impl Sections {
    pub(in crate::studies) fn file(&self, title: &str, name: &str) -> Option<String> {
        match name {
            "section.csv" => Some(self.section_table()),
            "exponents.csv" => Some(self.exponents_table()),
            "section.svg" => Some(self.figure(title)),
            _ => None,
        }
    }

    fn section_table(&self) -> String {
        let mut text = String::from("energy,motion,y,p_y\n");
        for section in &self.sections {
            for (number, motion) in section.motions.iter().enumerate() {
                for [y, p] in &motion.crossings {
                    let _ = writeln!(text, "{:?},{number},{y:?},{p:?}", section.energy);
                }
            }
        }
        text
    }

    fn exponents_table(&self) -> String {
        let mut text = String::from("energy,motion,y,p_y,exponent,energy_error\n");
        for section in &self.sections {
            for (number, motion) in section.motions.iter().enumerate() {
                let [y, p] = motion.crossings.first().copied().unwrap_or([f64::NAN; 2]);
                let (energy, exponent) = (section.energy, motion.exponent);
                let _ = writeln!(text, "{energy:?},{number},{y:?},{p:?},{exponent:?},{:?}", motion.energy_error);
            }
        }
        text
    }

    fn figure(&self, title: &str) -> String {
        const PANEL: u32 = 430;
        let exponents = self.sections.iter().flat_map(|section| &section.motions).map(|motion| motion.exponent);
        let largest = exponents.fold(self.threshold(), f64::max);
        let paths = RefCell::new(Vec::new());
        let panels = u32::try_from(self.sections.len()).unwrap_or(1).max(1);
        let drawn = figure((PANEL * panels + 130, 500), title, |area| {
            paths.borrow_mut().clear();
            let (width, _) = area.dim_in_pixel();
            let (plots, bar) = area.split_horizontally(width - 90 * FINE);
            for (plot, section) in plots.split_evenly((1, panels as usize)).iter().zip(&self.sections) {
                let [low, high] = allowed(section.energy);
                let border = border(section.energy, low, high);
                let window = Window::around(border.iter().copied());
                let mut canvas = Canvas::new(plot, window, ("", 1.0), ("y", "p"))?;
                canvas.curve(&border, GRID.stroke_width(3 * FINE))?;
                for motion in &section.motions {
                    let share = motion.exponent / largest;
                    paths.borrow_mut().push((canvas.dots(&motion.crossings), shade(share)));
                }
                let style = (FONT, pixels(15)).into_font().color(&INK).pos(Pos::new(HPos::Right, VPos::Top));
                let (right, _) = plot.dim_in_pixel();
                let name = format!("E = {}", (1e4 * section.energy).round() / 1e4);
                plot.draw(&Text::new(name, (i32::try_from(right)? - pixels(16), pixels(14)), style))?;
            }
            let colours: Vec<RGBColor> = (0..24).map(|step| shade(f64::from(step) / 23.0)).collect();
            colour_bar(&bar, "exponent", &colours, (0.0, largest))
        });
        with_paths(&drawn, &paths.into_inner(), 3 * FINE / 2)
    }
}

/// The border of what the energy allows.
fn border(energy: f64, low: f64, high: f64) -> Vec<[f64; 2]> {
    const HALF: u32 = 200;
    let place = |i: u32, sign: f64| {
        let y =
            0.5 * (low + high) - 0.5 * (high - low) * (core::f64::consts::PI * f64::from(i) / f64::from(HALF)).cos();
        [y, sign * square_across(energy, y, 0.0).max(0.0).sqrt()]
    };
    (0..=HALF).map(|i| place(i, 1.0)).chain((0..=HALF).rev().map(|i| place(i, -1.0))).collect()
}
