//! Columns of tests of solids, with their units.

use piola_document::units::Dimension;
use piola_fit::sides::Loading;

use crate::fitting::TableMistake;
use crate::sheet::{Row, Sheet, spelled, units_of, unknown};

pub(crate) const MODE: &[&str] = &["mode", "test", "test type", "loading", "deformation mode"];
pub(crate) const ANGLE: &[&str] = &["angle", "direction", "orientation"];
pub(crate) const STRETCH: &[&str] = &["stretch", "stretch ratio", "lambda", "λ", "volume ratio", "j"];
pub(crate) const STRAIN: &[&str] = &["strain", "engineering strain", "nominal strain", "epsilon", "ε"];
pub(crate) const STRESS: &[&str] =
    &["stress", "nominal stress", "engineering stress", "first piola stress", "pk1", "p", "pressure"];
pub(crate) const SIDE: &[&str] = &["lateral stretch", "transverse stretch", "lambda t", "λt", "λₜ"];
pub(crate) const SIDE_STRAIN: &[&str] = &["lateral strain", "transverse strain"];
const ALL: [&[&str]; 7] = [MODE, ANGLE, STRETCH, STRAIN, STRESS, SIDE, SIDE_STRAIN];

/// Whether a column of this plain name is read.
pub(super) fn is_known(plain: &str) -> bool {
    ALL.iter().any(|names| names.contains(&plain))
}

/// A stretch, or a strain, in its column.
#[derive(Clone, Copy)]
pub(crate) struct Column {
    pub(crate) at: usize,
    unit: f64,
    pub(crate) is_strain: bool,
}

impl Column {
    /// The column of a stretch, or of a strain; its unit must be that of a pure number.
    pub(crate) fn of(
        sheet: &Sheet,
        stretch: &'static [&str],
        strain: &'static [&str],
    ) -> Result<Option<Self>, TableMistake> {
        let (at, is_strain) = match (sheet.column(stretch)?, sheet.column(strain)?) {
            (Some(at), _) => (at, false),
            (None, Some(at)) => (at, true),
            (None, None) => return Ok(None),
        };
        let unit = match sheet.headings[at].unit.as_deref().map(|text| (text, spelled(text))) {
            None => 1.0,
            Some((_, Some(unit))) if unit.dimension == Dimension::NONE => unit.to_si(1.0),
            Some((text, _)) => {
                let what = format!("`{text}` is not a unit of a stretch or strain");
                return Err(TableMistake::new(sheet.header_line, what, "%, or - for a pure number"));
            }
        };
        Ok(Some(Self { at, unit, is_strain }))
    }

    /// The stretch of a number; simple shear has an amount, which is no strain of a length.
    pub(crate) fn stretch(self, x: f64, loading: Loading) -> f64 {
        let x = self.unit * x;
        if self.is_strain && loading != Loading::SimpleShear { 1.0 + x } else { x }
    }
}

/// The unit of the stresses, of their column or of a comment.
pub(crate) fn stress_unit(sheet: &Sheet, at: usize) -> Result<Option<String>, TableMistake> {
    let unit = sheet.headings[at].unit.clone().or_else(|| {
        let stated = sheet.settings.iter().find(|setting| matches!(setting.key.as_str(), "unit" | "stress unit"));
        stated.map(|setting| setting.value.clone())
    });
    if let Some(unit) = &unit
        && spelled(unit).is_none_or(|found| found.dimension != Dimension::PRESSURE)
    {
        let valid = format!("one of {}", units_of(Dimension::PRESSURE));
        return Err(TableMistake::new(sheet.header_line, unknown(unit), valid));
    }
    Ok(unit)
}

/// A field of a row that is not blank.
pub(crate) fn field(row: &Row, at: Option<usize>) -> Option<&str> {
    at.and_then(|at| row.fields.get(at)).map(str::trim).filter(|text| !text.is_empty())
}

/// The loading that the mode of a row names.
pub(crate) fn loading(row: &Row, modes: Option<usize>) -> Result<Loading, TableMistake> {
    let Some(label) = field(row, modes) else { return Ok(Loading::Uniaxial) };
    match label.to_lowercase().as_str() {
        "uniaxial" | "ut" | "tension" | "compression" | "uc" => Ok(Loading::Uniaxial),
        "transverse" => Ok(Loading::Transverse),
        "equibiaxial" | "biaxial" | "et" | "eb" | "bt" => Ok(Loading::Equibiaxial),
        "planar" | "pure shear" | "pure_shear" | "ps" | "pt" => Ok(Loading::Planar),
        "simple shear" | "simple_shear" | "ss" => Ok(Loading::SimpleShear),
        "volumetric" | "hydrostatic" | "vt" => Ok(Loading::Volumetric),
        _ => {
            let valid = "uniaxial, transverse, equibiaxial, planar, simple shear, volumetric";
            Err(TableMistake::new(row.line, format!("the mode is `{label}`"), valid))
        }
    }
}
