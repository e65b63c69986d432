//! What differs between members: values from a range, or random ones.

use core::str::FromStr;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng as _;
use rand_distr::{Distribution as _, Normal, Uniform};

use crate::EnsembleError;

/// A value of the scene that takes evenly spaced values: `PATH=FROM:TO:COUNT UNIT`.
///
/// # Example
/// ```
/// use piola_ensemble::ValueRange;
/// let angles: ValueRange = "joint.elbow.angle=0:90:4 deg".parse()?;
/// assert_eq!((angles.count, angles.setting(3)), (4, "joint.elbow.angle=90.0 deg".to_owned()));
/// assert!("joint.elbow.angle=0:90".parse::<ValueRange>().is_err());
/// # Ok::<(), piola_ensemble::EnsembleError>(())
/// ```
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct ValueRange {
    /// The path of the value, as of `--set`.
    pub path: String,
    /// The first value.
    pub from: f64,
    /// The last value.
    pub to: f64,
    /// How many.
    pub count: u64,
    /// The unit; empty for none.
    pub unit: String,
}

const RANGE: &str = "PATH=FROM:TO:COUNT UNIT, as 'joint.elbow.angle=0:90:10 deg'";
const RANDOM: &str =
    "PATH=normal(MEAN, DEVIATION) UNIT or PATH=uniform(FROM, TO) UNIT, as 'body.moon.mass=normal(7.3e22, 1e20) kg'";

fn finite(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|x: &f64| x.is_finite())
}

/// A setting of the scene.
fn setting(path: &str, value: f64, unit: &str) -> String {
    if unit.is_empty() { format!("{path}={value:?}") } else { format!("{path}={value:?} {unit}") }
}

impl FromStr for ValueRange {
    type Err = EnsembleError;

    fn from_str(text: &str) -> Result<Self, EnsembleError> {
        let parsed = || {
            let (path, values) = text.split_once('=')?;
            let [from, to, rest] = values.splitn(3, ':').collect::<Vec<_>>().try_into().ok()?;
            let (from, to) = (finite(from)?, finite(to)?);
            let rest: &str = rest;
            let digits = rest.trim_start().bytes().take_while(u8::is_ascii_digit).count();
            let (count, unit) = rest.trim_start().split_at(digits);
            let count = count.parse().ok().filter(|count| 1 <= *count)?;
            Some(Self { path: path.trim().to_owned(), from, to, count, unit: unit.trim().to_owned() })
        };
        let is_whole = |range: &Self| !range.path.is_empty() && (range.to - range.from).is_finite();
        parsed().filter(is_whole).ok_or_else(|| EnsembleError::Argument { argument: text.to_owned(), valid: RANGE })
    }
}

impl ValueRange {
    /// The value of this number.
    #[must_use]
    pub fn value(&self, index: u64) -> f64 {
        if self.count < 2 {
            return self.from;
        }
        let share = index as f64 / (self.count - 1) as f64;
        self.from * (1.0 - share) + self.to * share
    }

    /// The setting of this number.
    #[must_use]
    pub fn setting(&self, index: u64) -> String {
        setting(&self.path, self.value(index), &self.unit)
    }
}

/// The law of a random value.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Law {
    /// Mean and standard deviation.
    Normal(f64, f64),
    /// Least and greatest value.
    Uniform(f64, f64),
}

/// A value of the scene that is random: `PATH=normal(MEAN, DEVIATION) UNIT` or `PATH=uniform(FROM, TO) UNIT`.
///
/// The value of a member depends on its number and the seed alone, not on the order in which members are computed.
///
/// # Example
/// ```
/// use piola_ensemble::Random;
/// let mass: Random = "particle.bob.mass=uniform(1, 2) kg".parse()?;
/// let value = mass.value(7, 0, 3);
/// assert!(1.0 <= value && value < 2.0);
/// assert_eq!(value.to_bits(), mass.value(7, 0, 3).to_bits());
/// # Ok::<(), piola_ensemble::EnsembleError>(())
/// ```
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct Random {
    /// The path of the value, as of `--set`.
    pub path: String,
    /// Its law.
    pub law: Law,
    /// The unit; empty for none.
    pub unit: String,
}

impl FromStr for Random {
    type Err = EnsembleError;

    fn from_str(text: &str) -> Result<Self, EnsembleError> {
        let parsed = || {
            let (path, values) = text.split_once('=')?;
            let (name, rest) = values.split_once('(')?;
            let (numbers, unit) = rest.split_once(')')?;
            let (first, second) = numbers.split_once(',')?;
            let (first, second) = (finite(first)?, finite(second)?);
            let law = match name.trim() {
                "normal" if 0.0 < second => Law::Normal(first, second),
                "uniform" if first < second && (second - first).is_finite() => Law::Uniform(first, second),
                _ => return None,
            };
            let path = path.trim().to_owned();
            (!path.is_empty()).then(|| Self { path, law, unit: unit.trim().to_owned() })
        };
        parsed().ok_or_else(|| EnsembleError::Argument { argument: text.to_owned(), valid: RANDOM })
    }
}

impl Random {
    /// The value of a member: `which` is the number of this value among those of the member.
    #[must_use]
    pub fn value(&self, seed: u64, which: u64, member: u64) -> f64 {
        let mut random = ChaCha8Rng::seed_from_u64(seed ^ which.rotate_left(32));
        random.set_stream(member);
        match self.law {
            // Both laws were checked when they were read; what a file of another program holds gives its first number.
            Law::Normal(mean, deviation) => Normal::new(mean, deviation).map_or(mean, |law| law.sample(&mut random)),
            Law::Uniform(from, to) => Uniform::new(from, to).map_or(from, |law| law.sample(&mut random)),
        }
    }

    /// The setting of a member.
    #[must_use]
    pub fn setting(&self, seed: u64, which: u64, member: u64) -> String {
        setting(&self.path, self.value(seed, which, member), &self.unit)
    }
}
