//! Material connections of a uniform body.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;
use piola_tensor::internal::rows::{product, sum as added};

use super::{AffineConnection, ConnectionCoefficients};
use crate::UniformityError;
use crate::error::check_finite;
use crate::group::LieAlgebra;
use crate::indices::{Third, largest, second, sum, third};
use crate::map::{LocalMap, UniformityMap};

/// The material connection of K(X) with a symmetry algebra 𝔤: the one with the least torsion, W(27.33).
///
/// ```text
/// Γ is material  ⇔  K⁻¹(∂_D K + Γ_D K) ∈ 𝔤        Γ_D = −(∂_D K) K⁻¹ + K ω_D K⁻¹,  ω_D ∈ 𝔤        (Γ_D)^C_A = Γ^C_AD
/// ```
///
/// ω minimises the norm of the torsion in the crystal's frame, `Σ (Y^c_ab)²`. For the algebra of a solid there is one minimum, and it does
/// not depend on the choice of K; for a fluid it is the minimum with the least ω.
///
/// | symmetry | algebra | ω | torsion |
/// |---|---|---|---|
/// | a crystal of any class | [`LieAlgebra::trivial`] | 0 | dislocations: see [`DislocationDensity`](crate::DislocationDensity) |
/// | transverse isotropy | [`LieAlgebra::rotations_about`] | 3 numbers | what turning about the axis cannot remove |
/// | isotropy | [`LieAlgebra::rotations`] | 9 numbers | 0: Christoffel's symbols of M = K⁻ᵀK⁻¹ |
///
/// # Example
/// A lattice that turns with X₁ has torsion; an isotropic solid does not feel the turn.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_numerics::Real;
/// use piola_uniformity::{AffineConnection, LieAlgebra, MaterialConnection, UniformityMap};
/// #[derive(Clone, Copy)]
/// struct Turning;
/// impl UniformityMap for Turning {
///     fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
///         let ((s, c), o) = (reference.x.sin_cos(), T::zero());
///         Matrix3::new(c, -s, o, s, c, o, o, o, T::one())
///     }
/// }
/// let crystal = MaterialConnection::of_crystal(Turning);
/// assert_eq!(crystal.torsion(&Vector3::<f64>::zeros())?.components[0][1][0], 1.0); // Γ¹₂₁ = −∂₁K¹₂
/// let isotropic = MaterialConnection::new(Turning, LieAlgebra::rotations());
/// assert!(isotropic.coefficients(&Vector3::<f64>::zeros())?.components[0][1][0].abs() < 1e-15);
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
///
/// # Source
/// W(27.29–27.33).
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialConnection<M> {
    /// K(X).
    pub map: M,
    /// 𝔤, in the crystal's frame.
    pub algebra: LieAlgebra,
}

impl<M: UniformityMap> MaterialConnection<M> {
    /// Of a body and its symmetry algebra.
    #[must_use]
    pub const fn new(map: M, algebra: LieAlgebra) -> Self {
        Self { map, algebra }
    }

    /// Of a crystal of any class: its symmetry is discrete, 𝔤 = 0, and the columns of K are parallel.
    #[must_use]
    pub fn of_crystal(map: M) -> Self {
        Self { map, algebra: LieAlgebra::trivial() }
    }
}

impl<M: UniformityMap> AffineConnection for MaterialConnection<M> {
    fn at<T: Real>(&self, place: &Vector3<T>) -> ConnectionCoefficients<T> {
        let map = LocalMap::of(&self.map, place);
        let gamma = distant_parallelism(&map);
        let Some(correction) = self.algebra.correction() else { return ConnectionCoefficients { components: gamma } };
        // Y^c_ab of the crystal's frame.
        let (k, inverse) = (&map.value, &map.inverse);
        let torsion = third(|c, a, b| gamma[c][a][b] - gamma[c][b][a]);
        let raised = third(|c, a, b| sum(|e| inverse[c][e] * torsion[e][a][b]));
        let half = third(|c, a, b| sum(|e| raised[c][e][b] * k[e][a]));
        let crystal = third(|c, a, b| sum(|e| half[c][a][e] * k[e][b]));
        // ω^c_ab, and K ω K⁻¹ with both lower indices in the reference.
        let omega = correction.of(&crystal);
        let lowered = third(|c, a, b| sum(|e| sum(|f| omega[c][e][f] * inverse[e][a] * inverse[f][b])));
        let components = third(|c, a, b| gamma[c][a][b] + sum(|e| k[c][e] * lowered[e][a][b]));
        ConnectionCoefficients { components }
    }

    fn check_domain<T: Real>(&self, place: &Vector3<T>) -> Result<(), UniformityError> {
        self.map.value(place).map(|_| ())
    }
}

/// `Γ^C_AB = −(∂_B K^C_a)(K⁻¹)^a_A`, for which the columns of K are parallel.
#[inline]
pub(crate) fn distant_parallelism<T: Real>(map: &LocalMap<T>) -> Third<T> {
    third(|c, a, b| -sum(|e| map.partials[b][c][e] * map.inverse[e][a]))
}

/// What W(27.33) leaves: the part of `K⁻¹(∂_D K + Γ_D K)` outside the symmetry algebra.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialityResidual<T = f64> {
    /// For each direction D the part outside 𝔤, in the crystal's frame, 1/m.
    pub value: [Matrix3<T>; 3],
    /// The largest of `|K⁻¹∂_D K| + |K⁻¹Γ_D K|`, 1/m.
    pub scale: T,
}

impl<T: Real> MaterialityResidual<T> {
    /// Of any connection, for the body K with the algebra 𝔤: zero where the connection is material.
    ///
    /// # Errors
    /// What the map and the connection refuse.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_uniformity::{ConstantMap, LieAlgebra, MaterialConnection, MaterialityResidual};
    /// let map = ConstantMap(Matrix3::identity());
    /// let connection = MaterialConnection::of_crystal(map);
    /// let residual = MaterialityResidual::of(&connection, &map, &LieAlgebra::trivial(), &Vector3::<f64>::zeros())?;
    /// assert_eq!(residual.relative(), 0.0);
    /// # Ok::<(), piola_uniformity::UniformityError>(())
    /// ```
    pub fn of(
        connection: &impl AffineConnection,
        map: &impl UniformityMap,
        algebra: &LieAlgebra,
        place: &Vector3<T>,
    ) -> Result<Self, UniformityError> {
        let gamma = connection.coefficients(place)?.components;
        map.value(place)?;
        let map = LocalMap::of(map, place);
        let mut scale = T::zero();
        let value = [0, 1, 2].map(|d: usize| {
            let of_connection = product(second(|c, a| gamma[c][a][d]), map.value);
            let inner = product(map.inverse, added(map.partials[d], of_connection));
            let terms = [product(map.inverse, map.partials[d]), product(map.inverse, of_connection)];
            let sizes = terms.map(|term| largest(term.as_flattened().iter().copied()));
            scale = scale.max(sizes[0] + sizes[1]);
            let inner = from_rows(inner);
            inner - algebra.projection(&inner)
        });
        check_finite("materiality", value.map(|m| largest(m.iter().copied())).as_slice())?;
        Ok(Self { value, scale })
    }

    /// The largest component divided by the scale; zero when all terms are.
    #[must_use]
    pub fn relative(&self) -> T {
        let value = largest(self.value.iter().flat_map(|m| m.iter().copied()));
        piola_fields::Residual { value, scale: self.scale }.relative()
    }
}
