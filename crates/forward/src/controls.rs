//! What a homogeneous test prescribes: names of components, their units and their controls.

use piola_document::units::Dimension;
use piola_specimens::homogeneous::{Control, Controls};

use crate::ForwardError;
use crate::quantity::{parts, value};

/// A homogeneous test.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Test {
    Uniaxial,
    Equibiaxial,
    Biaxial,
    Planar,
    SimpleShear,
    Volumetric,
    Mixed,
}

/// What a name prescribes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// Fᵢⱼ.
    Gradient,
    /// Fᵢᵢ − 1.
    Strain,
    /// det F, by equal stretches.
    Volume,
    /// Pᵢⱼ.
    FirstPiola,
    /// Tᵢⱼ.
    Cauchy,
    /// −Tᵢᵢ.
    Pressure,
}

/// A prescribed quantity: its name as written, and the components that have its value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Prescribed {
    pub(crate) name: String,
    kind: Kind,
    components: Vec<(usize, usize)>,
}

impl Test {
    pub(crate) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "uniaxial" => Self::Uniaxial,
            "equibiaxial" => Self::Equibiaxial,
            "biaxial" => Self::Biaxial,
            "planar" => Self::Planar,
            "simple-shear" => Self::SimpleShear,
            "volumetric" => Self::Volumetric,
            "mixed" => Self::Mixed,
            _ => return None,
        })
    }

    /// What is prescribed unless the path or a condition says otherwise: free sides, and nothing sheared.
    pub(crate) const fn components(self) -> [[Control; 3]; 3] {
        const O: Control = Control::HELD;
        let second = if matches!(self, Self::Planar | Self::SimpleShear) { O } else { Control::FREE };
        let first = if matches!(self, Self::SimpleShear) { O } else { Control::FREE };
        [[first, O, O], [O, second, O], [O, O, Control::FREE]]
    }

    /// What is shown in the figure.
    pub(crate) const fn shown(self) -> &'static [&'static str] {
        match self {
            Self::Uniaxial => &["P11", "T11", "F22", "energy"],
            Self::Equibiaxial => &["P11", "T11", "F33", "energy"],
            Self::Biaxial | Self::Planar => &["P11", "P22", "F33", "energy"],
            Self::SimpleShear => &["T12", "T11", "T22", "energy"],
            Self::Volumetric => &["T11", "energy"],
            Self::Mixed => &["P11", "P22", "T12", "energy"],
        }
    }

    /// A quantity of this test by its name.
    pub(crate) fn prescribed(self, name: &str) -> Option<Prescribed> {
        let first: &[(usize, usize)] = if self == Self::Equibiaxial { &[(0, 0), (1, 1)] } else { &[(0, 0)] };
        let is_pulled = matches!(self, Self::Uniaxial | Self::Equibiaxial | Self::Biaxial | Self::Planar);
        let (kind, components): (_, &[_]) = match (name, self) {
            ("stretch", _) if is_pulled => (Kind::Gradient, first),
            ("strain", _) if is_pulled => (Kind::Strain, first),
            ("stress", _) if is_pulled => (Kind::FirstPiola, first),
            ("true_stress", _) if is_pulled => (Kind::Cauchy, first),
            ("second_stretch", Self::Biaxial) => (Kind::Gradient, &[(1, 1)]),
            ("second_stress", Self::Biaxial) => (Kind::FirstPiola, &[(1, 1)]),
            ("shear", Self::SimpleShear) => (Kind::Gradient, &[(1, 0)]),
            ("shear_stress", Self::SimpleShear) => (Kind::Cauchy, &[(1, 0)]),
            ("volume", Self::Volumetric) => (Kind::Volume, &[(0, 0), (1, 1), (2, 2)]),
            ("pressure", Self::Volumetric) => (Kind::Pressure, &[(0, 0), (1, 1), (2, 2)]),
            _ => return component(name),
        };
        Some(Prescribed { name: name.to_owned(), kind, components: components.to_vec() })
    }

    /// The names of this test, for who wrote another.
    pub(crate) const fn names(self) -> &'static str {
        match self {
            Self::Uniaxial | Self::Equibiaxial | Self::Planar => {
                "stretch, strain, stress, true_stress, or a component F11 to F33, P11 to P33, T11 to T33"
            }
            Self::Biaxial => {
                "stretch, strain, stress, true_stress, second_stretch, second_stress, or a component F11 to F33, P11 to P33, \
                 T11 to T33"
            }
            Self::SimpleShear => "shear, shear_stress, or a component F11 to F33, P11 to P33, T11 to T33",
            Self::Volumetric => "volume, pressure, or a component F11 to F33, P11 to P33, T11 to T33",
            Self::Mixed => "a component F11 to F33, P11 to P33, T11 to T33",
        }
    }
}

/// `F12`, `P22`, `T33`.
fn component(name: &str) -> Option<Prescribed> {
    let index = |digit: u8| matches!(digit, b'1'..=b'3').then(|| usize::from(digit - b'1'));
    let [letter, row, column] = *name.as_bytes() else { return None };
    let kind = match letter {
        b'F' => Kind::Gradient,
        b'P' => Kind::FirstPiola,
        b'T' => Kind::Cauchy,
        _ => return None,
    };
    Some(Prescribed { name: name.to_owned(), kind, components: vec![(index(row)?, index(column)?)] })
}

impl Prescribed {
    const fn dimension(&self) -> Dimension {
        match self.kind {
            Kind::Gradient | Kind::Strain | Kind::Volume => Dimension::NONE,
            Kind::FirstPiola | Kind::Cauchy | Kind::Pressure => Dimension::PRESSURE,
        }
    }

    /// The SI unit of its value.
    pub(crate) const fn unit(&self) -> &'static str {
        if matches!(self.kind, Kind::Gradient | Kind::Strain | Kind::Volume) { "" } else { "Pa" }
    }

    /// One value.
    pub(crate) fn value(&self, text: &str) -> Result<f64, ForwardError> {
        value(text, self.dimension()).filter(|x| self.least() < *x).ok_or_else(|| self.refused(text))
    }

    /// Stretches and volumes are above zero; a component of F may have any sign.
    fn least(&self) -> f64 {
        match self.kind {
            Kind::Strain => -1.0,
            Kind::Volume => 0.0,
            Kind::Gradient if self.name.ends_with("stretch") => 0.0,
            _ => f64::NEG_INFINITY,
        }
    }

    /// The two ends of a path, as `1..3` or `0..2 MPa`.
    pub(crate) fn range(&self, text: &str) -> Result<[f64; 2], ForwardError> {
        let above = |ends: &[f64; 2]| ends.iter().all(|x| self.least() < *x);
        range(text, self.dimension()).filter(above).ok_or_else(|| self.refused(text))
    }

    fn refused(&self, text: &str) -> ForwardError {
        let valid = if self.dimension() == Dimension::PRESSURE {
            "stresses with a unit, a path as 0..2 MPa"
        } else {
            "numbers without a unit or in %, a path as 1..3; stretches and volumes are above 0, strains above -100 %"
        };
        ForwardError::Argument { argument: format!("{}={text}", self.name), valid }
    }

    /// Prescribes it.
    pub(crate) fn apply(&self, value: f64, components: &mut [[Control; 3]; 3]) {
        for &(i, j) in &self.components {
            let one = if i == j { 1.0 } else { 0.0 };
            components[i][j] = match self.kind {
                Kind::Gradient => Control::Displacement(value - one),
                Kind::Strain => Control::Displacement(value),
                // ∛J − 1.
                Kind::Volume => Control::Displacement(((value - 1.0).ln_1p() / 3.0).exp_m1()),
                Kind::FirstPiola => Control::FirstPiola(value),
                Kind::Cauchy => Control::Cauchy(value),
                Kind::Pressure => Control::Cauchy(-value),
            };
        }
    }

    /// Whether two prescribe the same component.
    pub(crate) fn meets(&self, other: &Self) -> bool {
        self.components.iter().any(|component| other.components.contains(component))
    }
}

/// Two numbers; the unit of the last is that of the first too, unless it has its own.
pub(crate) fn range(text: &str, dimension: Dimension) -> Option<[f64; 2]> {
    let (from, to) = text.split_once("..")?;
    let last = value(to, dimension)?;
    let (_, unit) = parts(to)?;
    let first = match parts(from)? {
        (_, "") => value(&format!("{} {unit}", from.trim()), dimension)?,
        _ => value(from, dimension)?,
    };
    Some([first, last])
}

/// The controls at a value of the path, with all other conditions.
pub(crate) fn controls(
    test: Test,
    path: (&Prescribed, f64),
    held: &[(Prescribed, f64)],
) -> Result<Controls, piola_specimens::SpecimensError> {
    let mut components = test.components();
    for (prescribed, value) in held {
        prescribed.apply(*value, &mut components);
    }
    path.0.apply(path.1, &mut components);
    Controls::new(components)
}
