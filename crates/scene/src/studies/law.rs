//! The law of a solid, read from `[law]`.

use piola_numerics::Real;
use piola_solids::isochoric::{ArrudaBoyce, Gent, Isochoric, MooneyRivlin, NeoHookean, Yeoh};
use piola_solids::{AnyIsochoric, SolidsError};

use super::panel::quantity;
use crate::model::Builder;
use piola_document::Record;

/// The law of an incompressible isotropic solid: the one type for which the solutions are compiled.
///
/// # Example
/// ```
/// use piola_scene::studies::Law;
/// use piola_solids::isochoric::{Isochoric, NeoHookean};
/// let law = Law::from(NeoHookean::new(0.5e6)?);
/// assert_eq!(law.shear_modulus(), 0.5e6);
/// # Ok::<(), piola_solids::SolidsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Law(AnyIsochoric);

impl<I: Into<AnyIsochoric>> From<I> for Law {
    fn from(law: I) -> Self {
        Self(law.into())
    }
}

/// Each function is compiled once for a scalar, not in each integrand that calls it.
impl Isochoric for Law {
    const SECOND: bool = true;

    #[inline(never)]
    fn energy<T: Real>(&self, first: T, second: T) -> T {
        self.0.energy(first, second)
    }
    #[inline(never)]
    fn slopes<T: Real>(&self, first: T, second: T) -> [T; 2] {
        self.0.slopes(first, second)
    }
    #[inline(never)]
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
        self.0.curvatures(first, second)
    }
    fn check(&self, first: f64, second: f64) -> Result<(), SolidsError> {
        self.0.check(first, second)
    }
}

impl Law {
    /// The energy.
    #[must_use]
    pub const fn isochoric(&self) -> &AnyIsochoric {
        &self.0
    }

    /// Its name for a reader.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self.0 {
            AnyIsochoric::NeoHookean(_) => "neo-Hookean",
            AnyIsochoric::MooneyRivlin(_) => "Mooney–Rivlin",
            AnyIsochoric::Yeoh(_) => "Yeoh",
            AnyIsochoric::Rivlin(_) => "Rivlin",
            AnyIsochoric::Gent(_) => "Gent",
            AnyIsochoric::ArrudaBoyce(_) => "Arruda–Boyce",
            _ => "incompressible",
        }
    }
}

/// A law in words, with the scale of its stresses.
pub(super) fn material(law: &Law) -> String {
    format!("{} rubber of shear modulus {}", law.name(), quantity("Pa", law.shear_modulus()))
}

impl Builder<'_> {
    /// The law of a scene of the kind `name`.
    pub(super) fn law(&mut self, scene: &Record, name: &str) -> Option<Law> {
        let Some(table) = scene.record("law") else {
            if !scene.has("law") {
                self.refuse(
                    scene.place_of(name),
                    format!("[{name}] without a law"),
                    "a table [law], as type = \"neo-hookean\" and shear_modulus = \"0.4 MPa\"",
                );
            }
            return None;
        };
        let number = |key: &str| table.number(key);
        let (made, key) = match table.text("type")? {
            "neo-hookean" => (NeoHookean::new(number("shear_modulus")?).map(Law::from), "shear_modulus"),
            "mooney-rivlin" => (MooneyRivlin::new(number("c10")?, number("c01")?).map(Law::from), "c10"),
            "yeoh" => (Yeoh::new(number("c1")?, number("c2")?, number("c3")?).map(Law::from), "c1"),
            "gent" => (Gent::new(number("shear_modulus")?, number("limit")?).map(Law::from), "limit"),
            _ => (ArrudaBoyce::new(number("rubbery_modulus")?, number("links")?).map(Law::from), "links"),
        };
        match made {
            Ok(law) => Some(law),
            Err(error) => {
                let valid = match &error {
                    SolidsError::OutOfBounds { bound, .. } => format!("numbers with {bound}"),
                    _ => "finite numbers".to_string(),
                };
                self.refused(table.place_of(key), error.to_string(), valid)
            }
        }
    }
}
