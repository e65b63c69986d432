//! The precisions in which fields are stored and computed.

use piola_numerics::{Element, Real};

/// `f32` or `f64`: the precision of the samples of a field.
///
/// # Example
/// ```
/// use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, Walls};
/// let grid = BoxGrid::cells([4, 4], [1.0, 1.0])?;
/// let single = BoxSolver::<f32, 2>::new(grid, Walls::Sliding, BoxOperator::membrane(1.0)?);
/// assert!(single.is_ok());
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
pub trait Precision: Element + Real + rustfft::FftNum + sealed::Transforms {}

impl Precision for f32 {}
impl Precision for f64 {}

pub(crate) mod sealed {
    use piola_numerics::dispatch;

    use crate::transform::InLanes;

    /// Runs transforms in code that is compiled in this crate.
    pub trait Transforms: Sized {
        #[doc(hidden)]
        fn unit_roundoff() -> f64;
        #[doc(hidden)]
        fn transform(task: InLanes<'_, Self>);
    }

    impl Transforms for f32 {
        fn unit_roundoff() -> f64 {
            f64::from(Self::EPSILON)
        }
        fn transform(task: InLanes<'_, Self>) {
            dispatch(task);
        }
    }

    impl Transforms for f64 {
        fn unit_roundoff() -> f64 {
            Self::EPSILON
        }
        fn transform(task: InLanes<'_, Self>) {
            dispatch(task);
        }
    }
}
