//! SVG charts of results, and the folder that results are written to.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod canvas;
mod contour;
mod error;
mod figure;
mod folder;
mod panels;
mod plane;
mod ticks;
mod time;

pub use canvas::{Canvas, Window, between, colour_bar, viridis};
pub use contour::Lattice;
pub use error::ChartsError;
pub use figure::{
    Area, Drawn, FINE, FONT, GRID, INK, MOST_NAMED, colour, figure, format_short, legend, length_unit, pixels,
    power_of_ten,
};
pub use folder::{Folder, Written};
pub use panels::{LogPanel, Panel, residuals};
pub use plane::{Plane, discs, line, plane_chart, thinned};
pub use plotters::style::{Color, RGBColor, ShapeStyle, WHITE};
pub use time::{TimeCurve, time_figure};
