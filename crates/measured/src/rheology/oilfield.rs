//! Dial readings of oilfield viscometers: a rotor turns outside a bob that a spring holds.
//!
//! ```text
//! M = 2π R₁² · k₁ k₂ f θ        k₁ = 386 dyn cm/deg,   θ the reading,   f the spring
//! ```
//! k₂ is the effective surface of the bob: its torque counts as that of a bob 4.05 cm high, ends included. With R1 and B1 a degree is
//! 5.107 dyn/cm² at the bob, and a revolution per minute is 1.7023 1/s for a Newtonian fluid.
//!
//! # References
//! Fann Instrument Company, *Model 35 Viscometer Instruction Manual*, No. 208878: radii, k₁, k₂. API RP 13B-1.

use core::f64::consts::PI;

/// The bob inside, from the widest to the narrowest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bob {
    B1,
    B2,
    B3,
}

/// The turning cylinder outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rotor {
    /// R1.
    Standard,
    R2,
    R3,
}

/// A spring: its stiffness over that of F1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spring(f64);

/// k₁, N m/deg.
const TORSION: f64 = 386e-7;

impl Bob {
    pub(super) fn of(text: &str) -> Option<Self> {
        match text.trim().to_ascii_uppercase().as_str() {
            "B1" | "1" => Some(Self::B1),
            "B2" | "2" => Some(Self::B2),
            "B3" | "3" => Some(Self::B3),
            _ => None,
        }
    }

    /// R₁, m.
    pub(super) const fn radius(self) -> f64 {
        match self {
            Self::B1 => 0.017_245,
            Self::B2 => 0.012_276,
            Self::B3 => 0.008_622,
        }
    }

    /// k₂, 1/m³.
    const fn surface(self) -> f64 {
        match self {
            Self::B1 => 0.01323e6,
            Self::B2 => 0.0261e6,
            Self::B3 => 0.0529e6,
        }
    }
}

impl Rotor {
    pub(super) fn of(text: &str) -> Option<Self> {
        match text.trim().to_ascii_uppercase().as_str() {
            "R1" | "1" => Some(Self::Standard),
            "R2" | "2" => Some(Self::R2),
            "R3" | "3" => Some(Self::R3),
            _ => None,
        }
    }

    /// R₂, m.
    pub(super) const fn radius(self) -> f64 {
        match self {
            Self::Standard => 0.018_415,
            Self::R2 => 0.017_588,
            Self::R3 => 0.025_866,
        }
    }
}

impl Spring {
    /// F1.
    pub(super) const STANDARD: Self = Self(1.0);

    pub(super) fn of(text: &str) -> Option<Self> {
        let text = text.trim().to_ascii_uppercase();
        let factor: f64 = text.strip_prefix('F').unwrap_or(&text).parse().ok()?;
        let is_made = [0.2, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 10.0].iter().any(|known| factor.total_cmp(known).is_eq());
        is_made.then_some(Self(factor))
    }
}

/// Torque for each length, N, of a reading of one degree.
pub(super) fn torque_per_length(bob: Bob, Spring(factor): Spring) -> f64 {
    2.0 * PI * bob.radius() * bob.radius() * TORSION * bob.surface() * factor
}

#[cfg(test)]
mod tests {
    use super::{Bob, Rotor, Spring, torque_per_length};

    #[test]
    fn constants_of_the_standard_bob_are_those_of_the_manual() {
        let (bob, rotor) = (Bob::B1.radius(), Rotor::Standard.radius());
        // 5.107 dyn/cm² for each degree.
        let stress = torque_per_length(Bob::B1, Spring::STANDARD) / (2.0 * core::f64::consts::PI * bob * bob);
        assert!((stress - 0.5107).abs() < 5e-5, "{stress}");
        // 1.7023 1/s for each revolution in a minute, to the digits of the radii.
        let rate = core::f64::consts::TAU / 60.0 * 2.0 / (1.0 - (bob / rotor).powi(2));
        assert!((rate - 1.7023).abs() < 5e-4, "{rate}");
        let rate = |bob: Bob, rotor: Rotor| {
            core::f64::consts::TAU / 60.0 * 2.0 / (1.0 - (bob.radius() / rotor.radius()).powi(2))
        };
        for (bob, rotor, known) in [
            (Bob::B2, Rotor::Standard, 0.377),
            (Bob::B3, Rotor::Standard, 0.268),
            (Bob::B1, Rotor::R2, 5.4225),
            (Bob::B1, Rotor::R3, 0.377),
        ] {
            assert!((rate(bob, rotor) / known - 1.0).abs() < 1e-3, "{bob:?} {rotor:?}");
        }
    }
}
