//! Symmetry groups: of isotropic solids, fluids, fibre-reinforced solids and crystals.

use nalgebra::{Matrix3, Vector3};

use super::Sampler;
use super::law::jacobian;
use crate::SpecimensError;

const GROUP: &str = "symmetry group";

/// The rotation groups of crystals: of the 32 classes, those that differ by the inversion alone have the same.
///
/// The principal axis is e₃, a twofold axis across it is e₁, cubes lie along the coordinates.
///
/// | class | order | crystal classes (Hermann–Mauguin) | generators |
/// |---|---|---|---|
/// | `Triclinic` | 1 | 1, -1 | |
/// | `Monoclinic` | 2 | 2, m, 2/m | 2 about e₃ |
/// | `Rhombic` | 4 | 222, mm2, mmm | 2 about e₃, e₁ |
/// | `TetragonalLow` | 4 | 4, -4, 4/m | 4 about e₃ |
/// | `TetragonalHigh` | 8 | 422, 4mm, -42m, 4/mmm | 4 about e₃, 2 about e₁ |
/// | `TrigonalLow` | 3 | 3, -3 | 3 about e₃ |
/// | `TrigonalHigh` | 6 | 32, 3m, -3m | 3 about e₃, 2 about e₁ |
/// | `HexagonalLow` | 6 | 6, -6, 6/m | 6 about e₃ |
/// | `HexagonalHigh` | 12 | 622, 6mm, -6m2, 6/mmm | 6 about e₃, 2 about e₁ |
/// | `CubicLow` | 12 | 23, m-3 | 2 about e₃, 3 about (1, 1, 1) |
/// | `CubicHigh` | 24 | 432, -43m, m-3m | 4 about e₃, 3 about (1, 1, 1) |
///
/// An elastic response cannot tell F H from F (−H): the central inversion adds nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[expect(missing_docs, reason = "the table above says what each is")]
pub enum CrystalClass {
    Triclinic,
    Monoclinic,
    Rhombic,
    TetragonalLow,
    TetragonalHigh,
    TrigonalLow,
    TrigonalHigh,
    HexagonalLow,
    HexagonalHigh,
    CubicLow,
    CubicHigh,
}

impl CrystalClass {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Triclinic,
        Self::Monoclinic,
        Self::Rhombic,
        Self::TetragonalLow,
        Self::TetragonalHigh,
        Self::TrigonalLow,
        Self::TrigonalHigh,
        Self::HexagonalLow,
        Self::HexagonalHigh,
        Self::CubicLow,
        Self::CubicHigh,
    ];

    /// The number of rotations.
    #[must_use]
    pub const fn order(self) -> usize {
        match self {
            Self::Triclinic => 1,
            Self::Monoclinic => 2,
            Self::TrigonalLow => 3,
            Self::Rhombic | Self::TetragonalLow => 4,
            Self::TrigonalHigh | Self::HexagonalLow => 6,
            Self::TetragonalHigh => 8,
            Self::HexagonalHigh | Self::CubicLow => 12,
            Self::CubicHigh => 24,
        }
    }

    /// Of one of the 32 crystal classes, by its Hermann–Mauguin symbol with a minus for a bar, in any setting.
    ///
    /// The axes are those of the table, whatever the setting: in 312, 31m and -31m the axis e₁ of the half turn is across
    /// the crystal's axis a, in 321, 3m1 and -3m1 along it.
    ///
    /// # Example
    /// ```
    /// use piola_specimens::checks::CrystalClass;
    /// assert_eq!(CrystalClass::of_symbol("m-3m"), Some(CrystalClass::CubicHigh));
    /// assert_eq!(CrystalClass::of_symbol("7"), None);
    /// ```
    #[must_use]
    pub fn of_symbol(symbol: &str) -> Option<Self> {
        Some(match symbol {
            "1" | "-1" => Self::Triclinic,
            "2" | "m" | "2/m" => Self::Monoclinic,
            "222" | "mm2" | "m2m" | "2mm" | "mmm" => Self::Rhombic,
            "4" | "-4" | "4/m" => Self::TetragonalLow,
            "422" | "4mm" | "-42m" | "-4m2" | "4/mmm" => Self::TetragonalHigh,
            "3" | "-3" => Self::TrigonalLow,
            "32" | "321" | "312" | "3m" | "3m1" | "31m" | "-3m" | "-3m1" | "-31m" => Self::TrigonalHigh,
            "6" | "-6" | "6/m" => Self::HexagonalLow,
            "622" | "6mm" | "-6m2" | "-62m" | "6/mmm" => Self::HexagonalHigh,
            "23" | "m-3" | "m3" => Self::CubicLow,
            "432" | "-43m" | "m-3m" | "m3m" => Self::CubicHigh,
            _ => return None,
        })
    }

    /// Rotations that generate the group.
    #[must_use]
    pub fn generators(self) -> Vec<Matrix3<f64>> {
        let principal = |fold: f64| turn(Vector3::z(), fold);
        let across = turn(Vector3::x(), 2.0);
        // e₁ → e₂ → e₃ → e₁.
        let diagonal = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
        match self {
            Self::Triclinic => vec![],
            Self::Monoclinic => vec![principal(2.0)],
            Self::Rhombic => vec![principal(2.0), across],
            Self::TetragonalLow => vec![principal(4.0)],
            Self::TetragonalHigh => vec![principal(4.0), across],
            Self::TrigonalLow => vec![principal(3.0)],
            Self::TrigonalHigh => vec![principal(3.0), across],
            Self::HexagonalLow => vec![principal(6.0)],
            Self::HexagonalHigh => vec![principal(6.0), across],
            Self::CubicLow => vec![principal(2.0), diagonal],
            Self::CubicHigh => vec![principal(4.0), diagonal],
        }
    }
}

/// The rotation by a full turn over `fold` about a unit vector.
fn turn(axis: Vector3<f64>, fold: f64) -> Matrix3<f64> {
    rotation(axis, core::f64::consts::TAU / fold)
}

/// The rotation by an angle about a unit vector (Rodrigues).
fn rotation(axis: Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let (sine, cosine) = angle.sin_cos();
    Matrix3::identity() * cosine + axis.cross_matrix() * sine + axis * axis.transpose() * (1.0 - cosine)
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Finite(Vec<Matrix3<f64>>),
    AboutAxis(Vector3<f64>),
    AllRotations,
    Unimodular,
}

/// The changes of a reference configuration that a material does not feel, W(18.27).
///
/// # Example
/// ```
/// use piola_specimens::checks::{CrystalClass, SymmetryGroup};
/// assert_eq!(SymmetryGroup::crystal(CrystalClass::CubicHigh).order(), Some(24));
/// assert_eq!(SymmetryGroup::isotropic().order(), None); // not finite
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetryGroup {
    kind: Kind,
    /// K and K⁻¹ of K H K⁻¹.
    change: Option<(Matrix3<f64>, Matrix3<f64>)>,
}

impl SymmetryGroup {
    const fn of(kind: Kind) -> Self {
        Self { kind, change: None }
    }

    /// All rotations: an isotropic solid in an undistorted reference.
    #[must_use]
    pub const fn isotropic() -> Self {
        Self::of(Kind::AllRotations)
    }

    /// All changes without change of volume, det H = 1: a fluid, W(19.12).
    #[must_use]
    pub const fn fluid() -> Self {
        Self::of(Kind::Unimodular)
    }

    /// All rotations about an axis, and half turns across it.
    ///
    /// # Errors
    /// [`SpecimensError::OutOfBounds`] for an axis without direction.
    pub fn transversely_isotropic(axis: [f64; 3]) -> Result<Self, SpecimensError> {
        let axis = Vector3::from(axis);
        let length = axis.norm();
        crate::error::check_bound(GROUP, "axis", length, "0 < |axis|", 0.0 < length)?;
        Ok(Self::of(Kind::AboutAxis(axis / length)))
    }

    /// Half turns about the coordinate axes.
    #[must_use]
    pub fn orthotropic() -> Self {
        Self::crystal(CrystalClass::Rhombic)
    }

    /// Of a crystal, axes along the coordinates; for others see [`under`](Self::under).
    #[must_use]
    pub fn crystal(class: CrystalClass) -> Self {
        Self::of(Kind::Finite(closure(&class.generators(), class.order()).unwrap_or_default()))
    }

    /// Generated by any changes without change of volume.
    ///
    /// # Errors
    /// [`SpecimensError::OutOfBounds`] for a generator whose determinant is not 1 to 1e-12, or when more than `limit`
    /// elements are generated.
    pub fn generated(generators: &[Matrix3<f64>], limit: usize) -> Result<Self, SpecimensError> {
        for generator in generators {
            let determinant = jacobian(generator);
            let unimodular = (determinant - 1.0).abs() <= 1e-12;
            crate::error::check_bound(GROUP, "det H of a generator", determinant, "det H = 1", unimodular)?;
        }
        let elements = closure(generators, limit).ok_or(SpecimensError::OutOfBounds {
            law: GROUP,
            parameter: "number of elements",
            value: limit as f64 + 1.0,
            bound: "at most the limit",
        })?;
        Ok(Self::of(Kind::Finite(elements)))
    }

    /// 𝒢′ = K 𝒢 K⁻¹: the group for the reference that K changes this one into, W(19.3).
    ///
    /// # Errors
    /// [`SpecimensError::OutOfBounds`] unless 0 < |det K|.
    pub fn under(&self, change: &Matrix3<f64>) -> Result<Self, SpecimensError> {
        let determinant = jacobian(change);
        let inverse = change.try_inverse().filter(|_| 0.0 < determinant.abs());
        crate::error::check_bound(GROUP, "det K", determinant, "0 < |det K|", inverse.is_some())?;
        let inverse = inverse.unwrap_or_else(Matrix3::identity);
        let (change, inverse) = match &self.change {
            Some((first, undone)) => (change * first, undone * inverse),
            None => (*change, inverse),
        };
        Ok(Self { kind: self.kind.clone(), change: Some((change, inverse)) })
    }

    /// The number of elements, if finite.
    #[must_use]
    pub fn order(&self) -> Option<usize> {
        match &self.kind {
            Kind::Finite(elements) => Some(elements.len()),
            _ => None,
        }
    }

    /// How far the group is from being one of rotations: the largest |Hᵀ H − 1| of its elements, of an infinite group of as many as
    /// are drawn. Zero in an undistorted reference of a solid, W(19.35), where the group is a part of the orthogonal group.
    ///
    /// Solids have undistorted references; the group of a fluid, all det H = 1, has none.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_specimens::checks::SymmetryGroup;
    /// let isotropic = SymmetryGroup::isotropic();
    /// assert!(isotropic.distortion(100, 1) < 1e-14);
    /// // Twice as large, the reference is still undistorted; drawn out along one axis it is not.
    /// assert!(isotropic.under(&(Matrix3::identity() * 2.0))?.distortion(100, 1) < 1e-14);
    /// let drawn = isotropic.under(&Matrix3::from_diagonal(&Vector3::new(2.0, 1.0, 1.0)))?;
    /// assert!(1.0 < drawn.distortion(100, 1));
    /// # Ok::<(), piola_specimens::SpecimensError>(())
    /// ```
    #[must_use]
    pub fn distortion(&self, draws: usize, seed: u64) -> f64 {
        let mut sampler = Sampler::new(seed);
        (0..self.order().unwrap_or(draws)).fold(0.0, |largest, k| {
            let element = self.element(k, &mut sampler);
            largest.max((element.transpose() * element - Matrix3::identity()).norm())
        })
    }

    /// The k-th element, counted around; for an infinite group one drawn by the sampler.
    pub fn element(&self, k: usize, sampler: &mut Sampler) -> Matrix3<f64> {
        let element = match &self.kind {
            Kind::Finite(elements) if elements.is_empty() => Matrix3::identity(),
            Kind::Finite(elements) => elements[k % elements.len()],
            Kind::AboutAxis(axis) => {
                let about = rotation(*axis, core::f64::consts::TAU * sampler.unit());
                // Every other sample with a half turn across.
                let aside = axis.cross(&Vector3::from(sampler.direction()));
                let length = aside.norm();
                if k % 2 == 1 && 1e-3 < length { about * turn(aside / length, 2.0) } else { about }
            }
            Kind::AllRotations => sampler.rotation(),
            Kind::Unimodular => {
                let element = sampler.gradient(0.5);
                element / jacobian(&element).cbrt()
            }
        };
        match &self.change {
            Some((change, inverse)) => change * element * inverse,
            None => element,
        }
    }
}

/// The group that the generators generate, the identity first; none if it has more than `limit` elements.
fn closure(generators: &[Matrix3<f64>], limit: usize) -> Option<Vec<Matrix3<f64>>> {
    let mut elements = vec![Matrix3::identity()];
    let mut next = 0;
    while next < elements.len() {
        for generator in generators {
            let product = elements[next] * generator;
            // Elements of finite groups of rotations are far apart.
            if elements.iter().all(|known| 1e-6 < (known - product).norm()) {
                if elements.len() == limit {
                    return None;
                }
                elements.push(product);
            }
        }
        next += 1;
    }
    Some(elements)
}
