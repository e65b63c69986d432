//! Why a quantity has no value at a point.

use core::error::Error;
use core::fmt::{Display, Formatter, Result};
use std::sync::Arc;

/// The error of a [`Quantity`](crate::Quantity) that has no value at a point, such as a law beyond its limit.
///
/// Two of them are equal if they say the same.
///
/// # Example
/// ```
/// use piola_batch::Refusal;
/// use piola_continuum::ContinuumError;
/// let refusal = Refusal::new(ContinuumError::NonPositiveJacobian { determinant: -1.0 });
/// assert!(refusal.downcast_ref::<ContinuumError>().is_some());
/// ```
#[derive(Clone, Debug)]
pub struct Refusal(Arc<dyn Error + Send + Sync>);

impl Refusal {
    /// The refusal for this reason.
    #[must_use]
    pub fn new(reason: impl Error + Send + Sync + 'static) -> Self {
        Self(Arc::new(reason))
    }

    /// The reason, if it is of this type.
    #[must_use]
    pub fn downcast_ref<E: Error + 'static>(&self) -> Option<&E> {
        self.0.downcast_ref()
    }
}

impl PartialEq for Refusal {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.to_string() == other.to_string()
    }
}

impl Display for Refusal {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        self.0.fmt(formatter)
    }
}

impl Error for Refusal {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.0.source()
    }
}
