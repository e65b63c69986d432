//! One field in two frames: as a function of the particle X (Lagrange) or of the place x (Euler), B(4.13–4.15).
//!
//! ```text
//! Ψ(x, t) at x = x(X, t) is Ψ(X, t)        Ψ̇ = ∂Ψ/∂t|_X = ∂Ψ/∂t|_x + (grad Ψ) v   W(14.19), B(4.19)
//! ```
//!
//! | you have | you want | use |
//! |---|---|---|
//! | Ψ(x, t), x(X, t) | Ψ as a function of X | [`Spatial::following`] |
//! | Ψ(X, t), x(X, t) | Ψ as a function of x | [`Eulerian::field`] |
//! | x(X, t) | X, u, v, a as functions of x | [`Eulerian`] |
//! | Ψ(x, t), v(x, t) | Ψ̇ | [`Spatial::material_derivative`] |
//! | Ψ(x, t), x(X, t) | Ψ̇ | [`Spatial::rate_following`] |
//! | Ψ(X, t) | Ψ̇ | [`Material::rate`] |

mod eulerian;
mod inversion;
mod material;
mod spatial;

pub use eulerian::Eulerian;
pub use inversion::{Inversion, Preimage};
pub use material::Material;
pub use spatial::{Following, Spatial};
