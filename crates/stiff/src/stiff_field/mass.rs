//! A constant mass matrix beside a stiff field.

use piola_integrators::{Field, IntegratorsError};

#[cfg(feature = "sparse")]
use super::Sparsity;
use super::{StiffField, delegate_field};

/// A stiff field with a constant mass matrix: M ẏ = f(t, y). M may be singular.
///
/// Rows of zeros are constraints 0 = f(t, y). The start must satisfy them: nothing corrects it.
///
/// # Example
/// ```
/// use piola_integrators::{State, Tolerance, field};
/// use piola_stiff::{DifferenceJacobian, RadauIia, WithMass};
/// // ẋ = −z, 0 = x − z: x = e⁻ᵗ.
/// let constrained = field(2, |_t, y: &[f64], f: &mut [f64]| f.copy_from_slice(&[-y[1], y[0] - y[1]]));
/// let mass = vec![1.0, 0.0, 0.0, 0.0];
/// let mut system = WithMass::new(DifferenceJacobian::new(constrained), mass)?;
/// let mut state = State::new(0.0, vec![1.0, 1.0])?;
/// RadauIia::new(Tolerance::relative(1e-10)?).integrate_to(&mut system, &mut state, 1.0)?;
/// assert!((state.values[0] - (-1.0_f64).exp()).abs() < 1e-9);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("DAE", "differential-algebraic", "constraints"))]
#[derive(Clone, Debug)]
pub struct WithMass<F> {
    field: F,
    mass: Mass,
    /// The components from this one on have index 2.
    first_of_index_two: usize,
}

/// How M is stored.
#[derive(Clone, Debug)]
enum Mass {
    /// n×n, down the columns.
    Columns(Vec<f64>),
    /// (row, column, value).
    Entries(Vec<(usize, usize, f64)>),
}

impl<F: StiffField> WithMass<F> {
    /// Takes a field and its mass matrix, down the columns.
    ///
    /// # Errors
    /// [`IntegratorsError::WrongLength`], [`IntegratorsError::NotFinite`].
    pub fn new(field: F, mass: Vec<f64>) -> Result<Self, IntegratorsError> {
        let (expected, found) = (field.dimension().pow(2), mass.len());
        if expected != found {
            return Err(IntegratorsError::WrongLength { quantity: "mass", expected, found });
        }
        piola_integrators::internal::check_finite("mass", None, &mass)?;
        Ok(Self { field, mass: Mass::Columns(mass), first_of_index_two: usize::MAX })
    }

    /// Takes a field and the nonzero entries (row, column, value) of its mass matrix; repeated entries are added.
    ///
    /// # Errors
    /// [`IntegratorsError::OutsideMatrix`], [`IntegratorsError::NotFinite`] with the number of the entry.
    ///
    /// # Example
    /// ```
    /// use piola_integrators::{State, Tolerance, field};
    /// use piola_stiff::{DifferenceJacobian, RadauIia, WithMass};
    /// // 2 ẏ = −y: y = e^(−t/2).
    /// let decay = field(1, |_t, y: &[f64], f: &mut [f64]| f[0] = -y[0]);
    /// let mut system = WithMass::from_entries(DifferenceJacobian::new(decay), vec![(0, 0, 2.0)])?;
    /// let mut state = State::new(0.0, vec![1.0])?;
    /// RadauIia::new(Tolerance::relative(1e-10)?).integrate_to(&mut system, &mut state, 2.0)?;
    /// assert!((state.values[0] - (-1.0_f64).exp()).abs() < 1e-9);
    /// # Ok::<(), piola_integrators::IntegratorsError>(())
    /// ```
    #[doc(alias("sparse", "triplets", "coordinates"))]
    pub fn from_entries(field: F, entries: Vec<(usize, usize, f64)>) -> Result<Self, IntegratorsError> {
        let dimension = field.dimension();
        for (index, &(row, column, value)) in entries.iter().enumerate() {
            if dimension <= row.max(column) {
                return Err(IntegratorsError::OutsideMatrix { quantity: "mass", row, column, dimension });
            }
            if !value.is_finite() {
                return Err(IntegratorsError::NotFinite { quantity: "mass", index, value, t: None });
            }
        }
        Ok(Self { field, mass: Mass::Entries(entries), first_of_index_two: usize::MAX })
    }

    /// Declares that the components from `first` on have the differentiation index 2.
    #[must_use]
    pub const fn with_index_two_from(mut self, first: usize) -> Self {
        self.first_of_index_two = first;
        self
    }
}

impl<F: StiffField> Field for WithMass<F> {
    delegate_field!(F);
}

impl<F: StiffField> StiffField for WithMass<F> {
    fn jacobian(&mut self, t: f64, y: &[f64], jacobian: &mut [f64]) -> Result<(), Self::Error> {
        self.field.jacobian(t, y, jacobian)
    }
    fn mass(&self) -> Option<&[f64]> {
        match &self.mass {
            Mass::Columns(mass) => Some(mass),
            Mass::Entries(_) => None,
        }
    }
    fn mass_entries(&self) -> Option<&[(usize, usize, f64)]> {
        match &self.mass {
            Mass::Columns(_) => None,
            Mass::Entries(entries) => Some(entries),
        }
    }
    #[cfg(feature = "sparse")]
    fn sparsity(&self) -> Option<&Sparsity> {
        self.field.sparsity()
    }
    fn index(&self, component: usize) -> u32 {
        if component < self.first_of_index_two { self.field.index(component) } else { 2 }
    }
}
