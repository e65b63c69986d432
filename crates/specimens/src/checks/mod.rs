//! Checks that try to refute what is claimed of a law, and report the worst counterexample.
//!
//! | claim | check | source |
//! |---|---|---|
//! | the response turns with the observer | [`frame_indifference`] | W(18.3) |
//! | the material has these symmetries | [`material_symmetry`] with a [`SymmetryGroup`] | W(18.27), W(19.3) |
//! | with memory too | [`history_indifference`], [`history_symmetry`] | W(19.36) |
//! | the reference is undistorted | [`SymmetryGroup::distortion`] | W(19.35) |
//! | no work is gained in closed circuits | [`hyperelasticity`]; the energy itself: [`potential`] | W(20.31) |
//! | T symmetric ⇔ response indifferent ⇔ energy indifferent | [`noll`] | W(20.18) |
//! | plane waves have real speeds | [`ellipticity`], [`ellipticity_scan`], [`first_loss`] | |
//! | the greater stress is along the greater stretch | [`baker_ericksen`] | |
//! | more strain takes more stress | [`drucker_scan`], [`second_order_work`], [`drucker`], [`drucker_path`] | |
//!
//! Laws are anything that answers F with T ([`Elastic`], closures too) or with an energy
//! ([`Hyperelastic`](piola_solids::Hyperelastic), as [`Stored`] where a response is asked for). Samples are drawn by a fixed
//! sequence from a seed: the same search gives the same report. A check that passes is no proof; one that
//! fails is, and its report holds the deformation to see it with. Samples at which the law has no answer are left out and
//! counted as `refused`; a search that compared nothing does not pass ([`Verdict::NothingTested`]), nor one whose integrals are
//! not exact enough to tell ([`Verdict::Unresolved`]). Samples of incompressible laws keep their volume.

mod circuits;
mod drucker;
mod ellipticity;
mod groups;
mod history;
mod indifference;
mod inequalities;
mod law;
mod noll;
mod quadrature;
mod reference;
mod report;
mod sampler;
mod symmetry;

pub use circuits::{Circuit, Potential, hyperelasticity, potential};
pub use drucker::{
    Drucker, DruckerPath, DruckerScan, SecondOrderWork, drucker, drucker_path, drucker_scan, second_order_work,
};
pub use ellipticity::{
    Ellipticity, EllipticityScan, Kinematics, Loss, acoustic_tensor, ellipticity, ellipticity_scan, first_loss,
};
pub use groups::{CrystalClass, SymmetryGroup};
pub use history::{HistoryImages, history_indifference, history_symmetry};
pub use indifference::{Observers, frame_indifference};
pub use inequalities::{BakerEricksen, baker_ericksen};
pub use law::{Elastic, Stored};
pub use noll::{EnergyOfObservers, NollReport, Skewness, noll};
pub use reference::ChangedReference;
pub use report::{Report, Search, Verdict};
pub use sampler::Sampler;
pub use symmetry::{Images, material_symmetry};
