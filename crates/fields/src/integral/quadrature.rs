//! Rules of quadrature of a chosen degree: nodes and weights on intervals, circles, triangles and tetrahedra.

use core::num::NonZeroUsize;

use nalgebra::Vector3;
use piola_numerics::Real;

use super::region::{Region, SurfacePoint, VolumePoint};
use crate::FieldsError;
use crate::integrand::{Integrand, RunningIntegral};

/// A node in [0, 1] with its weight; the weights sum to 1.
pub(super) type LineNode = (f64, f64);
/// Barycentric coordinates in a simplex with N vertices, and the weight; the weights sum to 1.
pub(super) type SimplexNode<const N: usize> = ([f64; N], f64);

/// Rules of quadrature that integrate all polynomials of a degree exactly.
///
/// | on | rule | points for degree d |
/// |---|---|---|
/// | interval | Gauss–Legendre | ⌈(d+1)/2⌉ |
/// | circle | equally spaced | d + 1 |
/// | triangle | symmetric, positive weights, of Witherden and Vincent up to d = 20; then collapsed Gauss–Legendre | 1, 3, 6, 6, 7, … |
/// | tetrahedron | the same up to d = 10; then collapsed Gauss–Legendre | 1, 4, 8, 14, 14, … |
///
/// Regions make of these their rules in space: products on boxes, radius × height × circle in balls and
/// cylinders, one simplex after another in meshes. Everything is computed when the rules are made;
/// integrating allocates nothing. They are written as their degree.
///
/// # Accuracy
/// Nodes and weights within a few ulp. Sums are compensated: the rounding of an integral does not grow with
/// the number of points. What the degree leaves out falls like hᵈ⁺¹ with the size h of the elements, or
/// exponentially with d for analytic integrands; [`EstimatedQuadrature`](super::EstimatedQuadrature) measures it.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Cuboid, Quadrature};
/// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let rules = Quadrature::of_degree(2)?;
/// let integral = rules.volume_integral(&unit, |x: &Vector3<f64>| x.x * x.y * 12.0)?;
/// assert!((integral - 3.0).abs() < 1e-15);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// F. D. Witherden, P. E. Vincent, *On the identification of symmetric quadrature rules for finite element
/// methods*, Comput. Math. Appl. 69 (2015); I. Bogaert, *Iteration-free computation of Gauss–Legendre quadrature
/// nodes and weights*, SIAM J. Sci. Comput. 36 (2014).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "usize", into = "usize"))]
pub struct Quadrature {
    degree: usize,
    pub(super) line: Box<[LineNode]>,
    /// Exact to two degrees more, for the factor r² of a radius.
    pub(super) radius: Box<[LineNode]>,
    /// (cos φ, sin φ).
    pub(super) circle: Box<[[f64; 2]]>,
    pub(super) triangle: Box<[SimplexNode<3>]>,
    pub(super) tetrahedron: Box<[SimplexNode<4>]>,
}

impl Quadrature {
    /// The highest degree: its rule in a ball has four million points.
    pub const LIMIT: usize = 256;

    /// Rules that are exact for polynomials of `degree`.
    ///
    /// # Errors
    /// [`FieldsError::DegreeTooHigh`] unless `degree` ≤ [`LIMIT`](Self::LIMIT).
    pub fn of_degree(degree: usize) -> Result<Self, FieldsError> {
        if Self::LIMIT < degree {
            return Err(FieldsError::DegreeTooHigh { degree, limit: Self::LIMIT });
        }
        let line = gauss_legendre(degree);
        let radius = gauss_legendre(degree + 2);
        let triangle = triangle(degree, &line, &gauss_legendre(degree + 1));
        let tetrahedron = tetrahedron(degree, &line, &gauss_legendre(degree + 1), &radius);
        Ok(Self { degree, circle: circle(degree), triangle, tetrahedron, line, radius })
    }

    /// The degree of the polynomials that are integrated exactly.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// ∫ f dV over a region.
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | f | `integrand` | any [`Integrand`] | that of f |
    /// | ∫ f dV | returned | the same | that of f × m³ |
    ///
    /// # Errors
    /// [`FieldsError::IntegrandNotFinite`] with the place; [`FieldsError::NotFinite`] for an integral beyond the
    /// range of numbers; what the region refuses.
    pub fn volume_integral<T: Real, V: Integrand<Scalar = T>, R: Region<T>>(
        &self,
        region: &R,
        mut integrand: impl FnMut(&Vector3<T>) -> V,
    ) -> Result<V, FieldsError> {
        self.volume_integral_of(region, |point| Ok(integrand(&point.position)))
    }

    /// ∫ f dA over the boundary of a region; f depends on the place and the outward unit normal.
    ///
    /// # Errors
    /// As [`volume_integral`](Self::volume_integral).
    pub fn surface_integral<T: Real, V: Integrand<Scalar = T>, R: Region<T>>(
        &self,
        region: &R,
        mut integrand: impl FnMut(&SurfacePoint<T>) -> V,
    ) -> Result<V, FieldsError> {
        self.surface_integral_of(region, |point| Ok(integrand(point)))
    }

    /// ∫ f dV with an integrand that knows the point of the rule and may fail.
    ///
    /// # Errors
    /// The integrand's first error; as [`volume_integral`](Self::volume_integral).
    pub fn volume_integral_of<T: Real, V: Integrand<Scalar = T>, R: Region<T>>(
        &self,
        region: &R,
        mut integrand: impl FnMut(&VolumePoint<T>) -> Result<V, FieldsError>,
    ) -> Result<V, FieldsError> {
        let mut integral = RunningIntegral::new();
        region.volume_points(self, |point| integral.add(&integrand(&point)?, point.weight, &point.position))?;
        integral.value()
    }

    /// ∫ f dA with an integrand that may fail.
    ///
    /// # Errors
    /// The integrand's first error; as [`volume_integral`](Self::volume_integral).
    pub fn surface_integral_of<T: Real, V: Integrand<Scalar = T>, R: Region<T>>(
        &self,
        region: &R,
        mut integrand: impl FnMut(&SurfacePoint<T>) -> Result<V, FieldsError>,
    ) -> Result<V, FieldsError> {
        let mut integral = RunningIntegral::new();
        region.surface_points(self, |point| integral.add(&integrand(&point)?, point.weight, &point.position))?;
        integral.value()
    }
}

/// As [`Quadrature::of_degree`].
impl TryFrom<usize> for Quadrature {
    type Error = FieldsError;
    fn try_from(degree: usize) -> Result<Self, FieldsError> {
        Self::of_degree(degree)
    }
}

/// The degree.
impl From<Quadrature> for usize {
    fn from(rules: Quadrature) -> Self {
        rules.degree
    }
}

/// Gauss–Legendre on [0, 1], exact for `degree`.
fn gauss_legendre(degree: usize) -> Box<[LineNode]> {
    let count = NonZeroUsize::MIN.saturating_add(degree / 2);
    gauss_quad::GaussLegendre::new(count)
        .as_node_weight_pairs()
        .iter()
        .map(|&(node, weight)| (0.5 * (1.0 + node), 0.5 * weight))
        .collect()
}

/// Equally spaced directions, exact for trigonometric polynomials of `degree`.
fn circle(degree: usize) -> Box<[[f64; 2]]> {
    let count = degree + 1;
    let angle = |k: usize| core::f64::consts::TAU * (k as f64 + 0.5) / count as f64;
    (0..count).map(|k| [angle(k).cos(), angle(k).sin()]).collect()
}

/// From the square by (u, v) ↦ (u, (1 − u) v), whose Jacobian 1 − u asks for one degree more in u.
fn triangle(degree: usize, line: &[LineNode], raised: &[LineNode]) -> Box<[SimplexNode<3>]> {
    if let Ok((weights, points)) = fenris_quadrature::polyquad::triangle(degree) {
        let points = points.iter().map(|&[x, y]| barycentric([0.5 * (1.0 + x), 0.5 * (1.0 + y)]));
        return normalised(points.zip(weights).collect());
    }
    let at = |&(u, a): &LineNode| line.iter().map(move |&(v, b)| (barycentric([u, (1.0 - u) * v]), a * b * (1.0 - u)));
    normalised(raised.iter().flat_map(at).collect())
}

/// From the cube by (u, v, w) ↦ (u, (1 − u) v, (1 − u)(1 − v) w), with Jacobian (1 − u)² (1 − v).
fn tetrahedron(degree: usize, line: &[LineNode], once: &[LineNode], twice: &[LineNode]) -> Box<[SimplexNode<4>]> {
    if let Ok((weights, points)) = fenris_quadrature::polyquad::tetrahedron(degree) {
        let points = points.iter().map(|&p| barycentric(p.map(|x| 0.5 * (1.0 + x))));
        return normalised(points.zip(weights).collect());
    }
    let mut nodes = Vec::with_capacity(line.len() * once.len() * twice.len());
    for &(u, a) in twice {
        for &(v, b) in once {
            for &(w, c) in line {
                let point = barycentric([u, (1.0 - u) * v, (1.0 - u) * (1.0 - v) * w]);
                nodes.push((point, a * b * c * (1.0 - u) * (1.0 - u) * (1.0 - v)));
            }
        }
    }
    normalised(nodes)
}

/// Barycentric coordinates of a point of the unit simplex.
fn barycentric<const D: usize, const N: usize>(point: [f64; D]) -> [f64; N] {
    let mut coordinates = [0.0; N];
    coordinates[0] = 1.0 - point.iter().sum::<f64>();
    coordinates[1..].copy_from_slice(&point);
    coordinates
}

/// The same nodes with weights that sum to 1.
fn normalised<const N: usize>(mut nodes: Vec<SimplexNode<N>>) -> Box<[SimplexNode<N>]> {
    let weights: Vec<f64> = nodes.iter().map(|node| node.1).collect();
    let total = piola_numerics::sums::compensated_sum(&weights);
    for node in &mut nodes {
        node.1 /= total;
    }
    nodes.into_boxed_slice()
}
