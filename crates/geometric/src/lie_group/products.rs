//! Vectors, and groups made of groups.

use piola_integrators::internal::{compensated_add, largest_lane};
use piola_numerics::Real;

use super::LieGroup;

/// The vectors ℝⁿ with their sum: momenta, angular velocities, positions. The number is n.
///
/// Every method on this group is the classical method of the same coefficients.
///
/// # Example
/// ```
/// use piola_geometric::{MuntheKaas, Translations, group_field};
/// use piola_integrators::{Order, State};
/// let mut growth = group_field(Translations(1), |_t, y: &[f64], rate: &mut [f64]| rate[0] = y[0]);
/// let mut state = State::new(0.0, vec![1.0])?;
/// MuntheKaas::new(Order::Four, 1.0)?.integrate_to(&mut growth, &mut state, 1.0)?;
/// assert!((state.values[0] - (1.0 + 1.0 + 1.0 / 2.0 + 1.0 / 6.0 + 1.0 / 24.0)).abs() < 1e-15);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Translations(pub usize);

impl<T: Real> LieGroup<T> for Translations {
    fn element_length(&self) -> usize {
        self.0
    }
    fn dimension(&self) -> usize {
        self.0
    }
    fn advance(&self, element: &mut [T], carry: &mut [T], displacement: &[T]) {
        for ((element, carry), &displacement) in element.iter_mut().zip(carry).zip(displacement) {
            compensated_add(element, carry, displacement);
        }
    }
    fn inverse_differential(&self, _displacement: &[T], _velocity: &mut [T]) {}
    /// The largest component of the vector.
    fn magnitudes(&self, element: &[T], magnitudes: &mut [f64]) {
        magnitudes.fill(largest(element));
    }
}

/// The largest modulus in any lane.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn largest<T: Real>(values: &[T]) -> f64 {
    values.iter().map(|&x| largest_lane(x)).fold(0.0, f64::max)
}

/// The direct product of two groups: elements of both, one after the other, which move side by side.
///
/// # Example
/// ```
/// use piola_geometric::{DirectProduct, LieGroup, Rotations, Translations};
/// // Attitude and angular momentum of a rigid body.
/// let group = DirectProduct(Rotations, Translations(3));
/// assert_eq!((LieGroup::<f64>::element_length(&group), LieGroup::<f64>::dimension(&group)), (7, 6));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DirectProduct<A, B>(
    /// The group of the first numbers.
    pub A,
    /// The group of the rest.
    pub B,
);

impl<T: Real, A: LieGroup<T>, B: LieGroup<T>> LieGroup<T> for DirectProduct<A, B> {
    fn element_length(&self) -> usize {
        self.0.element_length() + self.1.element_length()
    }
    fn dimension(&self) -> usize {
        self.0.dimension() + self.1.dimension()
    }
    fn advance(&self, element: &mut [T], carry: &mut [T], displacement: &[T]) {
        let (length, dimension) = (self.0.element_length(), self.0.dimension());
        self.0.advance(&mut element[..length], &mut carry[..length], &displacement[..dimension]);
        self.1.advance(&mut element[length..], &mut carry[length..], &displacement[dimension..]);
    }
    fn inverse_differential(&self, displacement: &[T], velocity: &mut [T]) {
        let dimension = self.0.dimension();
        self.0.inverse_differential(&displacement[..dimension], &mut velocity[..dimension]);
        self.1.inverse_differential(&displacement[dimension..], &mut velocity[dimension..]);
    }
    fn renormalise(&self, element: &mut [T], carry: &mut [T]) {
        let length = self.0.element_length();
        self.0.renormalise(&mut element[..length], &mut carry[..length]);
        self.1.renormalise(&mut element[length..], &mut carry[length..]);
    }
    fn magnitudes(&self, element: &[T], magnitudes: &mut [f64]) {
        let (length, dimension) = (self.0.element_length(), self.0.dimension());
        self.0.magnitudes(&element[..length], &mut magnitudes[..dimension]);
        self.1.magnitudes(&element[length..], &mut magnitudes[dimension..]);
    }
    fn defect(&self, element: &[T]) -> Option<(usize, f64)> {
        let length = self.0.element_length();
        let second = || self.1.defect(&element[length..]).map(|(index, defect)| (index + length, defect));
        self.0.defect(&element[..length]).or_else(second)
    }
}

/// The direct product of so many copies of one group: the attitudes of several bodies.
///
/// # Example
/// ```
/// use piola_geometric::{DirectPower, DirectProduct, LieGroup, Rotations, Translations};
/// // Attitudes and angular momenta of five bodies: 5·4 + 15 numbers.
/// let group = DirectProduct(DirectPower { factor: Rotations, count: 5 }, Translations(15));
/// assert_eq!((LieGroup::<f64>::element_length(&group), LieGroup::<f64>::dimension(&group)), (35, 30));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DirectPower<G> {
    /// The group.
    pub factor: G,
    /// The number of copies.
    pub count: usize,
}

impl<G> DirectPower<G> {
    /// The lengths of one element and of one displacement, at least one, by which slices are cut.
    fn lengths<T: Real>(&self) -> (usize, usize)
    where
        G: LieGroup<T>,
    {
        (self.factor.element_length().max(1), self.factor.dimension().max(1))
    }
}

impl<T: Real, G: LieGroup<T>> LieGroup<T> for DirectPower<G> {
    fn element_length(&self) -> usize {
        self.count * self.factor.element_length()
    }
    fn dimension(&self) -> usize {
        self.count * self.factor.dimension()
    }
    fn advance(&self, element: &mut [T], carry: &mut [T], displacement: &[T]) {
        let (length, dimension) = self.lengths();
        let elements = element.chunks_exact_mut(length).zip(carry.chunks_exact_mut(length));
        for ((element, carry), displacement) in elements.zip(displacement.chunks_exact(dimension)) {
            self.factor.advance(element, carry, displacement);
        }
    }
    fn inverse_differential(&self, displacement: &[T], velocity: &mut [T]) {
        let (_, dimension) = self.lengths();
        for (displacement, velocity) in displacement.chunks_exact(dimension).zip(velocity.chunks_exact_mut(dimension)) {
            self.factor.inverse_differential(displacement, velocity);
        }
    }
    fn renormalise(&self, element: &mut [T], carry: &mut [T]) {
        let (length, _) = self.lengths();
        for (element, carry) in element.chunks_exact_mut(length).zip(carry.chunks_exact_mut(length)) {
            self.factor.renormalise(element, carry);
        }
    }
    fn magnitudes(&self, element: &[T], magnitudes: &mut [f64]) {
        let (length, dimension) = self.lengths();
        for (element, magnitudes) in element.chunks_exact(length).zip(magnitudes.chunks_exact_mut(dimension)) {
            self.factor.magnitudes(element, magnitudes);
        }
    }
    fn defect(&self, element: &[T]) -> Option<(usize, f64)> {
        let (length, _) = self.lengths();
        let mut elements = element.chunks_exact(length).enumerate();
        elements
            .find_map(|(i, element)| self.factor.defect(element).map(|(index, defect)| (index + i * length, defect)))
    }
}
