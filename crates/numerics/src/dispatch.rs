//! Running a kernel with the widest vector instructions of the machine.
//!
//! A crate compiled for "any x86-64" may use two lanes of `f64`; most machines have four or eight. A
//! [`Kernel`] is compiled once for each [`Level`] and [`dispatch`] picks at run time:
//!
//! ```
//! use piola_numerics::{Kernel, Lanes, Real, dispatch};
//!
//! struct Cosines<'a>(&'a [Lanes<f64, 8>], &'a mut [Lanes<f64, 8>]);
//! impl Kernel for Cosines<'_> {
//!     type Output = ();
//!     #[cfg_attr(not(debug_assertions), inline(always))] // and so on everything it calls
//!     fn run(self) {
//!         for (x, y) in self.0.iter().zip(self.1) {
//!             *y = x.cos();
//!         }
//!     }
//! }
//! let mut y = [Lanes::splat(0.0)];
//! dispatch(Cosines(&[Lanes::splat(0.0)], &mut y));
//! assert_eq!(y[0], Lanes::splat(1.0));
//! ```
//! **Everything that a kernel calls must be `#[cfg_attr(not(debug_assertions), inline(always))]`**: a function that is not inlined is
//! compiled for the base level, and each call to it saves and restores the wide registers. Closures cannot
//! be marked; large ones are better written as functions.
//!
//! Results are bit-identical at every level: the compiler neither reorders floating-point operations nor
//! contracts a product and a sum into a fused multiply-add, and no kernel of Piola calls `mul_add`. Fusing
//! would save about a third of the operations of a polynomial, at the price of answers that depend on the
//! machine.
//!
//! A build with debug assertions compiles each kernel once, for [`Level::Base`]: it gets the same results, and nobody
//! measures its speed.

use std::sync::OnceLock;

/// A computation that is compiled once for each [`Level`].
pub trait Kernel {
    /// What it returns.
    type Output;
    /// Computes; to be marked `#[cfg_attr(not(debug_assertions), inline(always))]`.
    fn run(self) -> Self::Output;
}

/// A set of instructions.
///
/// # Example
/// ```
/// use piola_numerics::Level;
/// assert!(Level::Base <= Level::best());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Level {
    /// What every machine of the target has: two `f64` a register on x86-64 and on aarch64.
    Base,
    /// x86-64 with AVX2 and FMA: four `f64` a register.
    Avx2,
    /// x86-64 with AVX-512 F, DQ and VL: eight `f64` a register.
    Avx512,
}

impl Level {
    /// The best level that this machine has and kernels are compiled for, found out once.
    #[must_use]
    pub fn best() -> Self {
        static BEST: OnceLock<Level> = OnceLock::new();
        *BEST.get_or_init(detect)
    }

    /// All levels up to the best, which is the last.
    pub fn available() -> impl Iterator<Item = Self> {
        [Self::Base, Self::Avx2, Self::Avx512].into_iter().filter(|level| *level <= Self::best())
    }
}

#[cfg(all(target_arch = "x86_64", not(debug_assertions)))]
fn detect() -> Level {
    let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    let avx512 = is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl");
    match (avx2, avx512) {
        (true, true) => Level::Avx512,
        (true, false) => Level::Avx2,
        _ => Level::Base,
    }
}

#[cfg(not(all(target_arch = "x86_64", not(debug_assertions))))]
fn detect() -> Level {
    Level::Base
}

/// Runs a kernel at the best level of this machine.
#[inline]
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    dispatch_at(Level::Avx512, kernel)
}

/// Runs a kernel at a given level, or at the best of this machine if it lacks that: for tests and benches.
#[inline]
pub fn dispatch_at<K: Kernel>(level: Level, kernel: K) -> K::Output {
    dispatch_one_of(level, kernel, |kernel| kernel, |kernel| kernel, |kernel| kernel)
}

/// A computation over any number of lanes.
pub trait LaneKernel {
    /// What it returns.
    type Output;
    /// Computes with N lanes; to be marked `#[cfg_attr(not(debug_assertions), inline(always))]`.
    fn run<const N: usize>(self) -> Self::Output;
}

/// Runs a kernel at the best level of this machine, with a number of lanes for each level.
///
/// More lanes than a register holds, and fewer, are both slower: the compiler then mixes neighbouring values into
/// one register, and shuffles them.
///
/// # Example
/// ```
/// use piola_numerics::{LaneKernel, Lanes, dispatch_lanes};
/// struct Sum<'a>(&'a [f64]);
/// impl LaneKernel for Sum<'_> {
///     type Output = f64;
///     #[cfg_attr(not(debug_assertions), inline(always))]
///     fn run<const N: usize>(self) -> f64 {
///         let chunks = self.0.chunks(N).map(|chunk| Lanes::<f64, N>::load(chunk, 0.0));
///         chunks.fold(Lanes::splat(0.0), |sum, chunk| sum + chunk).0.iter().sum()
///     }
/// }
/// assert_eq!(dispatch_lanes::<_, 2, 4, 8>(Sum(&[1.0; 11])), 11.0);
/// ```
#[inline]
pub fn dispatch_lanes<K: LaneKernel, const BASE: usize, const AVX2: usize, const AVX512: usize>(
    kernel: K,
) -> K::Output {
    dispatch_one_of(Level::Avx512, kernel, Of::<K, BASE>, Of::<K, AVX2>, Of::<K, AVX512>)
}

/// A kernel with its number of lanes.
struct Of<K, const N: usize>(K);

impl<K: LaneKernel, const N: usize> Kernel for Of<K, N> {
    type Output = K::Output;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> K::Output {
        self.0.run::<N>()
    }
}

/// Runs the kernel that is made for the level.
#[inline]
#[cfg(all(target_arch = "x86_64", not(debug_assertions)))]
#[expect(unsafe_code, reason = "the only way to call a function compiled for features found at run time")]
fn dispatch_one_of<K, O, A, B, C>(
    level: Level,
    kernel: K,
    base: impl FnOnce(K) -> A,
    avx2: impl FnOnce(K) -> B,
    avx512: impl FnOnce(K) -> C,
) -> O
where
    A: Kernel<Output = O>,
    B: Kernel<Output = O>,
    C: Kernel<Output = O>,
{
    match level.min(Level::best()) {
        Level::Base => base(kernel).run(),
        // SAFETY: `best` is at least `Avx2` only when the processor has its features.
        Level::Avx2 => unsafe { run_avx2(avx2(kernel)) },
        // SAFETY: `best` is `Avx512` only when the processor has its features.
        Level::Avx512 => unsafe { run_avx512(avx512(kernel)) },
    }
}

/// Runs a kernel: this architecture, or a build with debug assertions, has one level.
#[inline]
#[cfg(not(all(target_arch = "x86_64", not(debug_assertions))))]
fn dispatch_one_of<K, O, A, B, C>(
    _level: Level,
    kernel: K,
    base: impl FnOnce(K) -> A,
    _avx2: impl FnOnce(K) -> B,
    _avx512: impl FnOnce(K) -> C,
) -> O
where
    A: Kernel<Output = O>,
    B: Kernel<Output = O>,
    C: Kernel<Output = O>,
{
    base(kernel).run()
}

#[cfg(all(target_arch = "x86_64", not(debug_assertions)))]
#[inline(never)]
#[target_feature(enable = "avx2,fma")]
fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

#[cfg(all(target_arch = "x86_64", not(debug_assertions)))]
#[inline(never)]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
fn run_avx512<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}
