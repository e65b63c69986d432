//! What was measured, row by row.

/// What was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Response {
    /// G′ and G″ over the angular frequency ω.
    Oscillation,
    /// G over the time t after a step of strain.
    Relaxation,
    /// J over the time t after a step of stress.
    Creep,
}

/// A measured row in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ResponseRow {
    /// ω, rad/s, or t, s.
    pub at: f64,
    /// G′ and G″, Pa; or G twice; or J, 1/Pa, twice.
    pub moduli: [f64; 2],
}

/// The rows of one temperature, in the order of ω or t.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Isotherm {
    /// The mean temperature of the rows, K, if it is told.
    pub temperature: Option<f64>,
    /// The rows.
    pub rows: Vec<ResponseRow>,
}
