//! Small motions: equilibria, linearisation about any state, vibration modes, stability.
//!
//! ```text
//! M δq̈ + (C + G) δq̇ + (K + N) δq = W δu
//! ```
//!
//! | | matrix | symmetric? | does work |
//! |---|---|---|---|
//! | M | mass | symmetric, positive definite | – |
//! | C | damping | symmetric | takes q̇·C q̇ out of the motion |
//! | G | gyroscopic | skew | none |
//! | K | stiffness | symmetric | kept as the potential ½ q·K q |
//! | N | circulatory | skew | feeds or drains a motion round a loop |
//!
//! All four are exact derivatives of the [equations of motion](crate::Lagrangian::equations_into):
//! no step length, no symbols.
//!
//! | to get | call |
//! |---|---|
//! | q where nothing moves | [`Lagrangian::equilibrium`](crate::Lagrangian::equilibrium) |
//! | M, C, G, K, N at any state | [`Lagrangian::linearise`](crate::Lagrangian::linearise) |
//! | ẋ = A x + B u for control | [`Linearisation::state_matrix`], [`Linearisation::input_matrix`] |
//! | frequencies and shapes without damping | [`Linearisation::normal_modes`] |
//! | complex frequencies and shapes, damping ratios | [`Linearisation::complex_modes`] |
//! | does it stay? | [`Linearisation::stability`] |
//!
//! # References
//! L. Meirovitch, *Methods of Analytical Dynamics* (1970), chapters 5 and 6; P. C. Müller, *Stabilität und
//! Matrizen* (1977), for the split into five matrices and the theorems on stability; F. Tisseur, K. Meerbergen,
//! *The quadratic eigenvalue problem*, SIAM Rev. 43 (2001).

mod complex_modes;
mod equilibrium;
mod linearisation;
mod normal_modes;
mod reduction;
mod stability;

pub use complex_modes::{ComplexMode, ComplexModes};
pub use equilibrium::Equilibrium;
pub use linearisation::Linearisation;
pub use normal_modes::{ModeMotion, NormalModes};
pub use stability::Stability;
