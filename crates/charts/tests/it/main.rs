//! Figures read back from their SVG: marks stand where the labels of the axes say.

mod colours;
mod drawing;
mod lattice;
mod panels;
mod plane;
mod time;
