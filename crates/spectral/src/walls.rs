//! What the walls of the box hold, and the products of sines and cosines that obey them.

/// What the walls of the box hold.
///
/// | walls | component normal to the wall | components along the wall | component 1 is made of |
/// |---|---|---|---|
/// | `Sliding` | zero | normal derivative zero | sin cos cos |
/// | `Guided` | normal derivative zero | zero | cos sin sin |
///
/// Between sliding walls the body does not leave the wall and feels no shear there. Guided walls let the wall
/// move along its normal only; they exert no normal traction.
///
/// # Example
/// ```
/// use piola_spectral::{Parity, Walls};
/// assert_eq!(Walls::Sliding.parity(0, 0), Parity::Sine);
/// assert_eq!(Walls::Guided.parity(0, 0), Parity::Cosine);
/// ```
///
/// # Source
/// B(4.87), B(4.88) for sliding walls.
#[doc(alias = "boundary condition")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Walls {
    /// The normal displacement and the normal derivative of the tangential one are zero.
    Sliding,
    /// The tangential displacement and the normal derivative of the normal one are zero.
    Guided,
}

/// A sine or a cosine along one axis.
///
/// # Example
/// ```
/// use piola_spectral::Parity;
/// assert_eq!(Parity::Sine.flipped(), Parity::Cosine);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parity {
    /// sin(iπx/L): odd about the walls.
    Sine,
    /// cos(iπx/L): even about the walls.
    Cosine,
}

impl Parity {
    /// The parity of the derivative.
    #[must_use]
    pub fn flipped(self) -> Self {
        match self {
            Self::Sine => Self::Cosine,
            Self::Cosine => Self::Sine,
        }
    }
}

impl Walls {
    /// The parity of a component of the displacement along an axis.
    #[must_use]
    pub fn parity(self, component: usize, axis: usize) -> Parity {
        if (component == axis) == (self == Self::Sliding) { Parity::Sine } else { Parity::Cosine }
    }
}
