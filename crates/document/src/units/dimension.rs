//! Physical dimensions: products of powers of length, mass, time and angle.

use core::fmt;

/// The exponents of length, mass, time and angle.
///
/// # Example
/// ```
/// use piola_document::units::Dimension;
/// let acceleration = Dimension::LENGTH.over(Dimension::TIME.power(2));
/// assert_eq!(acceleration, Dimension::ACCELERATION);
/// assert_eq!(acceleration.to_string(), "length/time^2");
/// assert_eq!(acceleration.si_unit(), "m/s^2");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of length (m).
    pub length: i16,
    /// Exponent of mass (kg).
    pub mass: i16,
    /// Exponent of time (s).
    pub time: i16,
    /// Exponent of angle (rad).
    pub angle: i16,
}

impl Dimension {
    /// A pure number.
    pub const NONE: Self = Self { length: 0, mass: 0, time: 0, angle: 0 };
    /// Length, m.
    pub const LENGTH: Self = Self { length: 1, ..Self::NONE };
    /// Mass, kg.
    pub const MASS: Self = Self { mass: 1, ..Self::NONE };
    /// Time, s.
    pub const TIME: Self = Self { time: 1, ..Self::NONE };
    /// Angle, rad.
    pub const ANGLE: Self = Self { angle: 1, ..Self::NONE };
    /// Speed, m/s.
    pub const SPEED: Self = Self { length: 1, time: -1, ..Self::NONE };
    /// Acceleration, m/s^2.
    pub const ACCELERATION: Self = Self { length: 1, time: -2, ..Self::NONE };
    /// Angular rate, rad/s.
    pub const ANGULAR_RATE: Self = Self { angle: 1, time: -1, ..Self::NONE };
    /// Moment of inertia, kg m^2.
    pub const INERTIA: Self = Self { mass: 1, length: 2, ..Self::NONE };
    /// Gravitational parameter GM, m^3/s^2.
    pub const GRAVITATIONAL_PARAMETER: Self = Self { length: 3, time: -2, ..Self::NONE };

    /// Force, N.
    pub const FORCE: Self = Self { mass: 1, ..Self::ACCELERATION };
    /// Pressure and stress, Pa.
    pub const PRESSURE: Self = Self { length: -1, mass: 1, time: -2, angle: 0 };
    /// Moment of a force, N m.
    pub const MOMENT: Self = Self { length: 2, ..Self::FORCE };

    /// The dimension of a product. Exponents stop at those of the type.
    #[must_use]
    pub const fn times(self, other: Self) -> Self {
        Self {
            length: self.length.saturating_add(other.length),
            mass: self.mass.saturating_add(other.mass),
            time: self.time.saturating_add(other.time),
            angle: self.angle.saturating_add(other.angle),
        }
    }
    /// The dimension of a quotient.
    #[must_use]
    pub const fn over(self, other: Self) -> Self {
        self.times(other.power(-1))
    }
    /// The dimension of a power. Exponents stop at those of the type.
    #[must_use]
    pub const fn power(self, n: i16) -> Self {
        Self {
            length: self.length.saturating_mul(n),
            mass: self.mass.saturating_mul(n),
            time: self.time.saturating_mul(n),
            angle: self.angle.saturating_mul(n),
        }
    }

    /// The largest exponent, without its sign.
    pub(super) fn largest_exponent(self) -> u16 {
        [self.length, self.mass, self.time, self.angle].map(i16::unsigned_abs).into_iter().max().unwrap_or(0)
    }
    /// The SI unit, as a document would write it: `kg m^2`, `m/s^2`, `Pa`; empty for a pure number.
    #[must_use]
    pub fn si_unit(self) -> String {
        let named = [(Self::FORCE, "N"), (Self::PRESSURE, "Pa"), (Self::MOMENT, "N m")];
        if let Some((_, name)) = named.iter().find(|(dimension, _)| *dimension == self) {
            return (*name).to_string();
        }
        self.written(["kg", "m", "rad", "s"], " ")
    }

    fn written(self, names: [&str; 4], product: &str) -> String {
        let powers = [self.mass, self.length, self.angle, self.time];
        let side = |sign: i16| {
            let factors: Vec<String> = names
                .iter()
                .zip(powers)
                .filter(|(_, p)| 0 < p * sign)
                .map(|(name, p)| if p * sign == 1 { (*name).to_string() } else { format!("{name}^{}", p * sign) })
                .collect();
            (factors.len(), factors.join(product))
        };
        match (side(1), side(-1)) {
            ((_, above), (0, _)) => above,
            ((0, _), (1, below)) => format!("1/{below}"),
            ((0, _), (_, below)) => format!("1/({below})"),
            ((_, above), (1, below)) => format!("{above}/{below}"),
            ((_, above), (_, below)) => format!("{above}/({below})"),
        }
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::NONE {
            f.write_str("a pure number")
        } else {
            f.write_str(&self.written(["mass", "length", "angle", "time"], " "))
        }
    }
}
