//! Benchmarks of Piola beside its peers.
//!
//! | module | what |
//! |---|---|
//! | [`advice`] | such tables as the data of `piola_integrators::advise` |
//! | [`boxes`] | static solutions on a cube: ours, other transforms, differences |
//! | [`error_bars`] | estimates of the error of whole runs beside the true errors |
//! | [`problems`] | initial value problems with known solutions, hand-coded as their authors' peers would |
//! | [`methods`] | our methods for planets, tops and stiff equations, as [`work_precision`] runs them |
//! | [`program`] | the program `work-precision`, to which crates of their own add peers |
//! | [`peers`] | the same equations given to other crates |
//! | [`chain`] | pendulum chains three ways: by placement, hand-coded, by the dual numbers of another crate |
//! | [`golden_systems`] | the systems of the reference data, hand-coded |
//! | [`stability`] | rounding at inputs made to spoil the result |
//! | [`work_precision`] | error against time for many methods and parameters, measured in turn |
//! | [`constitutive`] | laws by the formulas of textbooks, in nalgebra and in lanes |
//! | [`continuum`] | decompositions of deformations, ours and by other means |
//! | [`viscometry`] | flows that shear a fluid: ours, plain quadrature, closed forms |
//! | [`figure`] | such a table as a figure |
//! | [`notes`] | what a bench knows beside its time |

pub mod advice;
pub mod boxes;
pub mod chain;
pub mod constitutive;
pub mod continuum;
pub mod error_bars;
pub mod figure;
pub mod golden_systems;
pub mod methods;
pub mod notes;
pub mod peers;
pub mod problems;
pub mod program;
pub mod stability;
pub mod viscometry;
pub mod work_precision;
