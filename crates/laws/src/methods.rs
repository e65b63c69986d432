//! The methods of a law, written once.

/// Writes inlined methods of a law and a deformation: the name, the type and the body of each.
macro_rules! answers {
    (|$law:ident, $deformation:ident| $($method:ident -> $result:ty { $($body:tt)* })+) => { $(
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn $method<T: piola_numerics::Real>(&$law, $deformation: &impl piola_continuum::Deformation<T>) -> $result {
            $($body)*
        }
    )+ };
}
pub(crate) use answers;
