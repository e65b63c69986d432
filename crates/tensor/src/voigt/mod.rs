//! Symmetric tensors as vectors of six numbers and their tangents as 6×6 matrices, every convention a type.
//!
//! | type | shears | maps |
//! |---|---|---|
//! | [`StressVector`] | as they are | |
//! | [`StrainVector`] | doubled: engineering shears γᵢⱼ = 2 εᵢⱼ | |
//! | [`MandelVector`] | times √2 | |
//! | [`StiffnessMatrix`] | entries `C_ijkl` | strain vector ↦ stress vector |
//! | [`ComplianceMatrix`] | entries times 2 for one pair of shears, 4 for two | stress vector ↦ strain vector |
//! | [`MandelMatrix`] | entries times √2 for one pair of shears, 2 for two | Mandel vector ↦ Mandel vector |
//!
//! Only Mandel's vectors keep norms and products, and his matrices products and inverses, of the tensors; the product
//! of a stress vector and a strain vector is T : ε.
//!
//! The order of the components is a type too: [`Piola`] 11, 22, 33, 12, 23, 13 (also that of Ansys); [`Abaqus`] and
//! [`BroNielsen`] B(4.73) 11, 22, 33, 12, 13, 23; [`Classical`] 11, 22, 33, 23, 13, 12. `reordered` goes from one to
//! another; what is in different orders does not add or multiply.
//!
//! ```
//! use piola_tensor::Symmetric;
//! use piola_tensor::voigt::{Abaqus, StiffnessMatrix, StrainVector, StressVector};
//! use piola_tensor::MajorSymmetric;
//! let stiffness = StiffnessMatrix::<f64, Abaqus>::of(&MajorSymmetric::isotropic(1.0, 3.0));
//! let strain = StrainVector::<f64, Abaqus>::of(&Symmetric::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.5));
//! assert_eq!(strain.components, [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]); // γ₁₃ is the fifth
//! let stress: StressVector<f64, Abaqus> = stiffness * strain;
//! assert_eq!(stress.tensor()[(0, 2)], 3.0); // μ γ
//! ```

mod matrix;
mod order;
mod vector;

pub use matrix::{ComplianceMatrix, MandelMatrix, StiffnessMatrix};
pub use order::{Abaqus, BroNielsen, Classical, Piola, VoigtOrder};
pub use vector::{MandelVector, StrainVector, StressVector};
