//! Laws at millions of points: in lanes, on all cores, only what is asked for.
//!
//! ```
//! use piola_continuum::{DeformationGradient, FirstPiola};
//! use piola_solids::{SaintVenantKirchhoff, batch};
//!
//! let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
//! let f = vec![DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 1000]; // E₁₁ = 3/2
//! let (mut p, mut a) = (vec![FirstPiola::zero(); 1000], vec![[0.0; 45]; 1000]);
//! batch::evaluate(&f[..], batch::first_piola_and_tangent(&law, &mut p[..], &mut a[..]))?;
//! assert_eq!((p[999].0[(0, 0)], a[999][0]), (15.0, 27.5)); // 2 (λ + 2 μ) E₁₁, S₁₁ + F₁₁² (λ + 2 μ)
//! let (mut c, mut t) = (vec![[0.0; 21]; 1000], vec![[0.0; 21]; 1000]);
//! batch::evaluate(&f[..], (batch::material_tangent(&law, &mut c[..]), batch::truesdell_tangent(&law, &mut t[..])))?;
//! assert_eq!((c[999][0], t[999][0]), (5.0, 40.0)); // λ + 2 μ, F₁₁⁴ (λ + 2 μ)/J
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`evaluate`] takes the deformations of the points and requests, one or a tuple of them, which may be of several laws
//! and may stand beside those of [`piola_batch`]. A request is a law and where its answer goes; what is not
//! asked for is not compiled in.
//!
//! | request | what | numbers a point | typed destination |
//! |---|---|---|---|
//! | [`energy`] | W(F) − W(1) | 1 | |
//! | [`first_piola`] | P | 9 | `&mut [FirstPiola<T>]` |
//! | [`second_piola`], [`kirchhoff`], [`cauchy`] | S, τ, T | 6 | `&mut [SecondPiola<T>]`, … |
//! | [`first_piola_tangent`] | the upper triangle of ∂P/∂F | 45 | |
//! | [`first_piola_tangent_square`] | ∂P/∂F | 81 | `&mut [FirstPiolaTangent<T>]` |
//! | [`first_piola_and_tangent`] | P and the upper triangle, from what they share | 9 + 45 | |
//! | [`energy_and_first_piola`], [`energy_first_piola_and_tangent`] | W with P, and with both, from what they share | 1 + 9, 1 + 9 + 45 | |
//! | [`material_tangent`], [`truesdell_tangent`] | ∂S/∂E; c/J | 21 | |
//! | [`second_piola_and_tangent`], [`cauchy_and_tangent`] | S and ∂S/∂E, T and c/J, from what they share | 6 + 21 | |
//! | [`first_piola_derivative`] | (∂P/∂F) : δF of a given δF | 9 | `&mut [FirstPiola<T>]` |
//!
//! Deformations and destinations are the views of [`piola_batch`]: arrays of structures, structures of
//! arrays ([`Components`](piola_batch::Components)), strided numbers and, the fastest, blocks of lanes
//! ([`LaneBlocks`](piola_batch::LaneBlocks)), of `f64` or `f32`. Any
//! [`Hyperelastic`](crate::Hyperelastic) law will do, also one that gives only its energy. At 10⁶ points 81 numbers take longer to store than
//! to compute: 45 hold the same, and a product with a direction needs none.

mod evaluation;
mod requests;
mod tangents;
mod together;

pub use crate::error::BadPoint;
pub use evaluation::evaluate;
pub use piola_batch::Together;
pub use requests::*;
pub use tangents::*;
pub use together::*;
