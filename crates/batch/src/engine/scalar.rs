//! The scalars of batches.

use piola_numerics::{Element, LaneKernel, Real, dispatch_lanes};

/// `f64` or `f32`, with the number of lanes that was measured to be the fastest.
pub trait BatchScalar: Element + Real {
    #[doc(hidden)]
    fn in_lanes<K: LaneKernel>(kernel: K) -> K::Output;
}

macro_rules! scalar {
    ($float:ident: $base:literal $avx2:literal $avx512:literal) => {
        impl BatchScalar for $float {
            fn in_lanes<K: LaneKernel>(kernel: K) -> K::Output {
                dispatch_lanes::<_, $base, $avx2, $avx512>(kernel)
            }
        }
    };
}
scalar!(f64: 2 4 8);
scalar!(f32: 4 8 16);
