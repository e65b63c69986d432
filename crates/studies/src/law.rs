//! The law of a solid.

use piola_numerics::Real;
use piola_solids::isochoric::Isochoric;
use piola_solids::{AnyIsochoric, SolidsError};

/// The law of an incompressible isotropic solid: the one type for which the solutions are compiled.
///
/// # Example
/// ```
/// use piola_studies::RubberLaw;
/// use piola_solids::isochoric::{Isochoric, NeoHookean};
/// let law = RubberLaw::from(NeoHookean::new(0.5e6)?);
/// assert_eq!(law.shear_modulus(), 0.5e6);
/// # Ok::<(), piola_solids::SolidsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RubberLaw(AnyIsochoric);

impl<I: Into<AnyIsochoric>> From<I> for RubberLaw {
    fn from(law: I) -> Self {
        Self(law.into())
    }
}

/// Each function is compiled once for a scalar, not in each integrand that calls it.
impl Isochoric for RubberLaw {
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

impl RubberLaw {
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
