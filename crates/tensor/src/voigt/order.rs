//! Orders of the six components, as types.

use core::fmt::Debug;

/// An order of the six components of a symmetric tensor.
///
/// # Example
/// ```
/// use piola_tensor::voigt::{Abaqus, VoigtOrder};
/// assert_eq!(Abaqus::PLACES, [0, 1, 2, 3, 5, 4]);
/// ```
pub trait VoigtOrder: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// Which of Piola's components 11, 22, 33, 12, 23, 13, counted from 0, stands at each place.
    ///
    /// The first three are the normal components.
    const PLACES: [usize; 6];
}

macro_rules! orders {
    ($($(#[$documentation:meta])* $name:ident $places:expr;)*) => {$(
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;
        impl VoigtOrder for $name {
            const PLACES: [usize; 6] = $places;
        }
    )*};
}

orders! {
    /// Piola's own: 11, 22, 33, 12, 23, 13.
    Piola [0, 1, 2, 3, 4, 5];
    /// That of Abaqus: 11, 22, 33, 12, 13, 23.
    Abaqus [0, 1, 2, 3, 5, 4];
    /// That of B(4.73): `u_x, v_y, w_z, u_y + v_x, u_z + w_x, v_z + w_y`, so 11, 22, 33, 12, 13, 23.
    BroNielsen [0, 1, 2, 3, 5, 4];
    /// That of crystal physics: 11, 22, 33, 23, 13, 12.
    Classical [0, 1, 2, 4, 5, 3];
}
