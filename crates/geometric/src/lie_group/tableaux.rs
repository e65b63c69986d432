//! The coefficients of the explicit methods.
//!
//! Sources: W. Kutta (1901), order 4; J. C. Butcher, *On Runge–Kutta processes of high order*, J. Austral. Math. Soc. 4 (1964)
//! 179, order 6 with seven stages; order 8 is that of [`DormandPrince853`](piola_integrators::DormandPrince853).

use piola_integrators::internal::dormand_prince as pair;

/// The stages that take part, as (stage, coefficient), stages counted from zero.
pub(super) type Row = &'static [(usize, f64)];

/// The coefficients of an explicit method.
pub(super) struct Tableau {
    /// c
    pub(super) nodes: &'static [f64],
    /// a, one row a stage; that of the first is empty.
    pub(super) rows: &'static [Row],
    /// b
    pub(super) weights: Row,
}

pub(super) const HALF_STEP_2: Tableau = Tableau { nodes: &[0.0, 0.5], rows: &[&[], &[(0, 0.5)]], weights: &[(1, 1.0)] };

pub(super) const KUTTA_4: Tableau = Tableau {
    nodes: &[0.0, 0.5, 0.5, 1.0],
    rows: &[&[], &[(0, 0.5)], &[(1, 0.5)], &[(2, 1.0)]],
    weights: &[(0, 1.0 / 6.0), (1, 1.0 / 3.0), (2, 1.0 / 3.0), (3, 1.0 / 6.0)],
};

pub(super) const SIX: Tableau = Tableau {
    nodes: &[0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0, 5.0 / 6.0, 1.0 / 6.0, 1.0],
    rows: &[
        &[],
        &[(0, 1.0 / 3.0)],
        &[(1, 2.0 / 3.0)],
        &[(0, 1.0 / 12.0), (1, 1.0 / 3.0), (2, -1.0 / 12.0)],
        &[(0, 25.0 / 48.0), (1, -55.0 / 24.0), (2, 35.0 / 48.0), (3, 15.0 / 8.0)],
        &[(0, 3.0 / 20.0), (1, -11.0 / 24.0), (2, -1.0 / 8.0), (3, 0.5), (4, 0.1)],
        &[
            (0, -261.0 / 260.0),
            (1, 33.0 / 13.0),
            (2, 43.0 / 156.0),
            (3, -118.0 / 39.0),
            (4, 32.0 / 195.0),
            (5, 80.0 / 39.0),
        ],
    ],
    weights: &[(0, 13.0 / 200.0), (2, 11.0 / 40.0), (3, 11.0 / 40.0), (4, 0.16), (5, 0.16), (6, 13.0 / 200.0)],
};

pub(super) const DORMAND_PRINCE_8: Tableau = Tableau {
    nodes: &pair::C,
    rows: &[
        &[],
        &pair::A2,
        &pair::A3,
        &pair::A4,
        &pair::A5,
        &pair::A6,
        &pair::A7,
        &pair::A8,
        &pair::A9,
        &pair::A10,
        &pair::A11,
        &pair::A12,
    ],
    weights: &pair::B,
};
