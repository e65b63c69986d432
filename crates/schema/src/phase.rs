//! The keys of Hamiltonians and of questions.

use piola_document::table;
use piola_document::units::Dimension as D;

use super::Absent::{Default, Optional, Required};
use super::Kind::{Flag, Name, Text};
use super::Range::Any;
use super::{Kind, quantity};

table! {
    /// Coordinates and momenta under a Hamiltonian, q̇ = ∂H/∂p, ṗ = −∂H/∂q, by exact derivatives. All numbers here are pure
    /// numbers, in units of your choice; only the time is in seconds.
    pub(super) static HAMILTONIAN = "hamiltonian" {
        /// H, an expression of coordinates, momenta, `t` and `[parameters]` without units.
        energy: Text, Required;
    }
}

table! {
    /// A coordinate of a `[hamiltonian]` with its momentum.
    pub(super) static COORDINATE = "coordinate" {
        /// Name of the coordinate in expressions: letters, digits and `_`; with spaces or hyphens between backquotes.
        name: Name, Required;
        /// Name of its momentum; `p_` and the name of the coordinate when absent.
        momentum: Name, Optional;
        /// The coordinate at the start.
        start: quantity(D::NONE, Any), Default("0.0");
        /// The momentum at the start.
        momentum_at_start: quantity(D::NONE, Any), Default("0.0");
    }
}

table! {
    /// A Poisson bracket {F, G} = Σ ∂F/∂qᵢ ∂G/∂pᵢ − ∂F/∂pᵢ ∂G/∂qᵢ of a `[hamiltonian]`, by exact derivatives, at every recorded
    /// instant. F without `t` is conserved where its bracket with H vanishes.
    pub(super) static BRACKET = "bracket" {
        /// Name of the bracket, unlike any other.
        name: Name, Required;
        /// F, an expression of coordinates, momenta, `t` and `[parameters]` without units.
        first: Text, Required;
        /// G, such an expression; the Hamiltonian H when absent.
        second: Text, Optional;
    }
}

table! {
    /// A new coordinate of a `[hamiltonian]` with its momentum, as functions of the old ones. There must be one
    /// `[[new_coordinate]]` for each `[[coordinate]]`. At every recorded instant the change of variables is tested for being canonical:
    /// dP ∧ dQ = dp ∧ dq.
    pub(super) static NEW_COORDINATE = "new_coordinate" {
        /// Name of the new coordinate, unlike any other.
        name: Name, Required;
        /// Q, an expression of coordinates, momenta, `t` and `[parameters]` without units.
        coordinate: Text, Required;
        /// P, such an expression.
        momentum: Text, Required;
    }
}

table! {
    /// What is asked besides the motion. The answers stand in `summary.json` and in tables of their own.
    pub(super) static QUESTIONS = "questions" {
        /// Of a `[hamiltonian]`: the surface s = 0 of a Poincaré section, an expression of coordinates, momenta and `t`. Recorded is
        /// where the motion crosses it from s < 0 to s > 0.
        section: Text, Optional;
        /// The most crossings that are sought, until the end of the time.
        crossings: Kind::Count { least: 1, most: 1_000_000 }, Default("1000");
        /// Of a `[hamiltonian]`: the largest Lyapunov exponent, 1/s, estimated over the time, which ends after its start.
        exponent: Flag, Default("false");
        /// Of a `[mechanism]`: the equilibrium that is found from the coordinates at the start, and whether it is stable.
        equilibrium: Flag, Default("false");
        /// Of a `[mechanism]`: the modes of small motions about that equilibrium, with their damping.
        modes: Flag, Default("false");
        /// Of a `[mechanism]`: kinetic energy and weight of every part and the energy that every force stores, at every instant.
        energies: Flag, Default("false");
    }
}
