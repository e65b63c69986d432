//! Residual stress of a body that is left to itself, to first order in its natural strain.
//!
//! ```text
//! ε* = ½ (M − 1)                                   natural strain: what the metric asks for
//! T = C : (sym ∇u − ε*),   Div T = 0,   T N = 0    u lets neighbours meet; what is left of ε* is stress
//! η = inc ε* ,   η_KL = sym ε_KAC ∂_A α_CL         no stress where η = 0: it comes from the dislocations (Kröner)
//! ```
//!
//! | the metric is | use |
//! |---|---|
//! | any, the strains small | [`LinearResidualStress`] on a mesh |
//! | a function of one coordinate, the strains of any size | [`laminated`](crate::laminated): plate, tube, sphere at rest |

use nalgebra::Vector3;
use piola_continuum::{CauchyStress, FirstPiola};
use piola_fields::Field;
use piola_fields::integral::{MaterialPoint, TetrahedralElements};
use piola_numerics::{Dual, Real};
use piola_solids::Stiffness;
use piola_tensor::{MajorSymmetric, PairSymmetric, Symmetric};

use crate::UniformityError;
use crate::burgers::DislocationDensity;
use crate::error::{check_bound, check_finite};
use crate::indices::{second, variables};
use crate::map::UniformityMap;

/// ε* = ½ (M − 1), the strain from the reference to the natural lengths.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::Symmetric;
/// use piola_fields::{Field, Uniform};
/// use piola_uniformity::residual_stress::NaturalStrain;
/// let swollen = NaturalStrain(Uniform(Symmetric::diagonal([1.5, 1.0, 1.0])));
/// assert_eq!(swollen.at(&Vector3::<f64>::zeros(), 0.0).components[0], 0.25);
/// ```
#[doc(alias("eigenstrain", "inherent strain", "plastic strain"))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NaturalStrain<G>(
    /// M(X), as by [`CharacteristicMetric`](crate::CharacteristicMetric).
    pub G,
);

impl<G: Field<Value = Symmetric>> Field for NaturalStrain<G> {
    type Value = Symmetric;
    fn at<T: Real>(&self, place: &Vector3<T>, t: T) -> Symmetric<T> {
        (self.0.at(place, t) - Symmetric::identity()) * T::lit(0.5)
    }
}

/// `η_KL = sym ε_KAC ∂_A α_CL`, 1/m²: the incompatibility that a density of dislocations makes, to first order in K − 1.
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | K(X) | `map`, near 1 | 3×3 | – |
/// | η | returned | 3×3 symmetric | 1/m² |
///
/// It equals inc sym K⁻¹; [`incompatibility`](piola_fields::compatibility::incompatibility) has inc of any strain.
///
/// # Errors
/// What the map refuses; [`UniformityError::NotFinite`].
///
/// # Example
/// Screws of constant density bend no lattice: η = 0.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_numerics::Real;
/// use piola_uniformity::{InverseMap, UniformityMap, residual_stress};
/// struct Screws;
/// impl UniformityMap for Screws {
///     fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
///         let mut dual = Matrix3::identity();
///         dual[(2, 0)] = T::lit(-1e-3) * reference.y;
///         dual[(2, 1)] = T::lit(1e-3) * reference.x;
///         dual
///     }
/// }
/// let eta = residual_stress::incompatibility_of_dislocations(&InverseMap(Screws), &Vector3::new(1.0, 2.0, 0.0))?;
/// assert!(eta.components.iter().all(|eta| eta.abs() < 1e-18));
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
///
/// # Source
/// E. Kröner, *Kontinuumstheorie der Versetzungen und Eigenspannungen* (1958).
#[doc(alias = "Kröner")]
pub fn incompatibility_of_dislocations<T: Real>(
    map: &impl UniformityMap,
    place: &Vector3<T>,
) -> Result<Symmetric<T>, UniformityError> {
    let density = DislocationDensity::of(map, &variables(place))?.value;
    let slope = |along: usize, c: usize, l: usize| density[(c, l)].partials[along];
    let curl = second(|k, l| {
        let (a, c) = ((k + 1) % 3, (k + 2) % 3);
        slope(a, c, l) - slope(c, a, l)
    });
    let incompatibility = Symmetric::symmetric_part(curl);
    check_finite("incompatibility", &incompatibility.components)?;
    Ok(incompatibility)
}

/// The residual stress of a body of tetrahedra with free faces, to first order in its natural strain.
///
/// # Accuracy
/// That of the elements: with quadratic tetrahedra the stress converges as h², and is exact where ε* = sym ∇u of a quadratic u.
///
/// # Example
/// A block whose natural strain is that of a bend, ε*₁₁ = X₂, is free to take it: no stress.
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::Symmetric;
/// use piola_fields::Field;
/// use piola_fields::integral::{Cuboid, QuadraticTetrahedra, TetrahedralMesh};
/// use piola_numerics::Real;
/// use piola_solids::Stiffness;
/// use piola_uniformity::residual_stress::LinearResidualStress;
/// struct Bend;
/// impl Field for Bend {
///     type Value = Symmetric;
///     fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> Symmetric<T> {
///         Symmetric::diagonal([place.y, T::zero(), T::zero()])
///     }
/// }
/// let block = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let elements = QuadraticTetrahedra::new(TetrahedralMesh::of_cuboid(&block, [1, 1, 1])?, 2)?;
/// let rest = LinearResidualStress::of(&elements, &Stiffness::isotropic(1.0, 1.0)?, &Bend, 1e-12)?;
/// assert!(rest.stresses.iter().all(|(_, stress)| stress.0.components.iter().all(|t| t.abs() < 1e-9)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LinearResidualStress {
    /// u at the nodes, m, up to a rigid motion.
    pub displacement: Vec<f64>,
    /// T at the points of the rule, Pa.
    pub stresses: Vec<(MaterialPoint, CauchyStress)>,
    /// |forces left on the nodes| / |forces of the natural strain|.
    pub residual: f64,
    /// Steps of the method of conjugate gradients.
    pub iterations: usize,
}

impl LinearResidualStress {
    /// Of a body of elements with the stiffness C and the natural strain ε*(X), until the forces on the nodes are below `tolerance`.
    ///
    /// # Errors
    /// [`UniformityError::OutOfBounds`] unless 0 < tolerance; what field and elements refuse; [`UniformityError::NotConverged`].
    pub fn of<const N: usize>(
        elements: &TetrahedralElements<N>,
        stiffness: &Stiffness,
        strain: &impl Field<Value = Symmetric>,
        tolerance: f64,
    ) -> Result<Self, UniformityError> {
        check_bound("tolerance", tolerance, "0 < tolerance", 0.0 < tolerance)?;
        let tensor = stiffness.tensor();
        let natural = |point: &MaterialPoint| tensor.contract(&strain.at(&point.position, 0.0));
        let zero = vec![0.0; elements.components()];
        let mut forces = zero.clone();
        elements.add_stress_forces(&zero, |point, _| Ok(FirstPiola((-natural(point)).matrix())), &mut forces)?;
        check_finite("forces of the natural strain", &forces)?;
        let (displacement, iterations, residual) = conjugate_gradients(elements, tensor, forces, tolerance)?;
        let mut stresses = Vec::with_capacity(elements.point_count());
        elements.integral(&displacement, |point, _, gradient| {
            let strain = Symmetric::symmetric_part(piola_numerics::linear::matrix3::rows_of(gradient));
            stresses.push((*point, CauchyStress(tensor.contract(&strain) - natural(point))));
            Ok([0.0])
        })?;
        Ok(Self { displacement, stresses, residual, iterations })
    }

    /// ∫ T : T dV, Pa² m³, of the points of the rule: zero where no stress is left.
    #[must_use]
    pub fn square_integral(&self) -> f64 {
        self.stresses.iter().map(|(point, stress)| point.weight * stress.0.double_contraction(&stress.0)).sum()
    }
}

/// A u = b by conjugate gradients; rigid motions lie across b and stay out.
fn conjugate_gradients<const N: usize>(
    elements: &TetrahedralElements<N>,
    tensor: &MajorSymmetric,
    forces: Vec<f64>,
    tolerance: f64,
) -> Result<(Vec<f64>, usize, f64), UniformityError> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut displacement = vec![0.0; forces.len()];
    let size = dot(&forces, &forces).sqrt();
    if size <= 0.0 {
        return Ok((displacement, 0, 0.0));
    }
    let stiffness = MajorSymmetric { components: tensor.components.map(Dual::constant) };
    let (mut residual, mut direction) = (forces.clone(), forces);
    let mut square = dot(&residual, &residual);
    let mut varied = vec![Dual::constant(0.0); direction.len()];
    let mut images = varied.clone();
    // Far more than a well-shaped mesh needs.
    let most = 20 * direction.len();
    for iteration in 1..=most {
        for (varied, &p) in varied.iter_mut().zip(&direction) {
            *varied = Dual::new(0.0, p);
        }
        images.fill(Dual::constant(0.0));
        // The derivative of the forces along p at u = 0: exact, and no element is turned inside out by a long step.
        elements.add_stress_forces(
            &varied,
            |_, gradient| {
                let strain = Symmetric::symmetric_part(piola_numerics::linear::matrix3::rows_of(gradient.matrix()));
                Ok(FirstPiola(stiffness.contract(&strain).matrix()))
            },
            &mut images,
        )?;
        let curvature = -direction.iter().zip(&images).map(|(p, image)| p * image.tangent).sum::<f64>();
        let step = square / curvature;
        for ((u, r), (p, image)) in displacement.iter_mut().zip(residual.iter_mut()).zip(direction.iter().zip(&images))
        {
            *u += step * p;
            *r += step * image.tangent;
        }
        let next = dot(&residual, &residual);
        let error = next.sqrt() / size;
        if error <= tolerance {
            return Ok((displacement, iteration, error));
        }
        if !error.is_finite() {
            break;
        }
        let share = next / square;
        square = next;
        for (p, r) in direction.iter_mut().zip(&residual) {
            *p = r + share * *p;
        }
    }
    let error = dot(&residual, &residual).sqrt() / size;
    Err(UniformityError::NotConverged { quantity: "residual stress", error, allowed: tolerance })
}
