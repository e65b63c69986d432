//! The header of a NRRD file.

use std::collections::HashMap;
use std::path::Path;

use super::Encoding;
use crate::error::ImagesError;
use crate::sample_type::{Order, SampleType};

/// The most axes that the format allows.
const MOST_AXES: usize = 16;

/// The most bytes of a header.
const MOST_OF_A_HEADER: usize = 1 << 20;

/// The fields by their names, in lower case.
pub(super) struct Header<'f> {
    path: &'f Path,
    fields: HashMap<String, String>,
}

/// Places, for the axes in reverse, in mm and LPS.
pub(super) struct Geometry {
    pub(super) spacing: Vec<f64>,
    pub(super) origin: [f64; 3],
    pub(super) directions: Option<Vec<[f64; 3]>>,
}

impl<'f> Header<'f> {
    /// The header, and what follows it.
    pub(super) fn parse(path: &'f Path, content: &'f [u8]) -> Result<(Self, &'f [u8]), ImagesError> {
        let malformed = |cause: String| ImagesError::malformed(path, "NRRD", cause);
        let mut fields = HashMap::new();
        let mut rest = content;
        let mut is_first = true;
        loop {
            let within = &rest[..rest.len().min(MOST_OF_A_HEADER)];
            let Some(end) = within.iter().position(|byte| *byte == b'\n') else {
                return Err(malformed("its header has no end, which is an empty line".into()));
            };
            let line = String::from_utf8_lossy(&rest[..end]);
            let line = line.trim_end_matches('\r');
            rest = &rest[end + 1..];
            if is_first {
                let version = line.strip_prefix("NRRD000").and_then(|version| version.parse::<u8>().ok());
                if !version.is_some_and(|version| (1..=5).contains(&version)) {
                    return Err(malformed("it does not begin with NRRD0001 to NRRD0005".into()));
                }
                is_first = false;
            } else if line.is_empty() {
                return Ok((Self { path, fields }, rest));
            } else if !line.starts_with('#')
                && let Some((name, value)) = line.split_once(": ")
                && !name.ends_with(':')
            {
                fields.insert(name.trim().to_lowercase(), value.trim().to_owned());
            }
            if MOST_OF_A_HEADER < content.len() - rest.len() {
                return Err(malformed(format!("its header has more than {MOST_OF_A_HEADER} bytes")));
            }
        }
    }

    fn malformed(&self, cause: String) -> ImagesError {
        ImagesError::malformed(self.path, "NRRD", cause)
    }

    fn get(&self, names: &[&str]) -> Option<&str> {
        names.iter().find_map(|name| self.fields.get(*name)).map(String::as_str)
    }

    fn needed(&self, name: &str) -> Result<&str, ImagesError> {
        self.get(&[name]).ok_or_else(|| self.malformed(format!("the field `{name}` is missing")))
    }

    /// The sizes in the order of the file.
    pub(super) fn sizes(&self) -> Result<Vec<u64>, ImagesError> {
        let dimension = self.needed("dimension")?;
        let axes = dimension.parse::<usize>().ok().filter(|axes| (1..=MOST_AXES).contains(axes));
        let axes = axes.ok_or_else(|| self.malformed(format!("dimension: {dimension}; 1 to 16 are valid")))?;
        let text = self.needed("sizes")?;
        let sizes: Option<Vec<u64>> = text.split_ascii_whitespace().map(|size| size.parse().ok()).collect();
        match sizes {
            Some(sizes) if sizes.len() == axes => Ok(sizes),
            _ => Err(self.malformed(format!("sizes: {text}; {axes} whole numbers are expected"))),
        }
    }

    pub(super) fn sample_type(&self) -> Result<SampleType, ImagesError> {
        let text = self.needed("type")?;
        let names: [(SampleType, &[&str]); 8] = [
            (SampleType::I8, &["signed char", "int8", "int8_t"]),
            (SampleType::U8, &["uchar", "unsigned char", "uint8", "uint8_t"]),
            (SampleType::I16, &["short", "short int", "signed short", "signed short int", "int16", "int16_t"]),
            (SampleType::U16, &["ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"]),
            (SampleType::I32, &["int", "signed int", "int32", "int32_t"]),
            (SampleType::U32, &["uint", "unsigned int", "uint32", "uint32_t"]),
            (SampleType::F32, &["float"]),
            (SampleType::F64, &["double"]),
        ];
        let found = names.into_iter().find(|(_, names)| names.contains(&text));
        found.map(|(sample_type, _)| sample_type).ok_or_else(|| {
            let valid = "int8, uint8, int16, uint16, int32, uint32, float, double";
            ImagesError::unsupported(self.path, format!("samples of type `{text}`"), valid)
        })
    }

    pub(super) fn encoding(&self) -> Result<Encoding, ImagesError> {
        match self.needed("encoding")? {
            "raw" => Ok(Encoding::Raw),
            "gzip" | "gz" => Ok(Encoding::Gzip),
            "ascii" | "text" | "txt" => Ok(Encoding::Text),
            other => Err(ImagesError::unsupported(self.path, format!("the encoding `{other}`"), "raw, gzip, ascii")),
        }
    }

    pub(super) fn order(&self, sample_type: SampleType, encoding: Encoding) -> Result<Order, ImagesError> {
        if sample_type.bytes() == 1 || encoding == Encoding::Text {
            return Ok(Order::Little);
        }
        match self.needed("endian")? {
            "little" => Ok(Order::Little),
            "big" => Ok(Order::Big),
            other => Err(self.malformed(format!("endian: {other}; little and big are valid"))),
        }
    }

    /// Refuses samples in another file, or behind something else.
    pub(super) fn check_skips(&self) -> Result<(), ImagesError> {
        if self.get(&["data file", "datafile"]).is_some() {
            return Err(ImagesError::unsupported(
                self.path,
                "its samples in another file",
                "header and samples in one file",
            ));
        }
        for name in ["line skip", "lineskip", "byte skip", "byteskip"] {
            if let Some(value) = self.get(&[name]).filter(|value| *value != "0") {
                return Err(ImagesError::unsupported(self.path, format!("`{name}: {value}`"), "0"));
            }
        }
        Ok(())
    }

    /// The size of the first axis where it counts components.
    pub(super) fn components(&self, sizes: &[u64]) -> Result<Option<usize>, ImagesError> {
        let kinds: Vec<_> =
            self.get(&["kinds"]).map(|kinds| kinds.split_ascii_whitespace().collect()).unwrap_or_default();
        let vectors = self.get(&["space directions"]).map(|text| directions(text, sizes.len()));
        let is_component = |axis: usize| {
            let is_none = matches!(&vectors, Some(Some(vectors)) if vectors[axis].is_none());
            is_none || kinds.get(axis).is_some_and(|kind| !matches!(*kind, "domain" | "space" | "???" | "none"))
        };
        if let Some(axis) = (1..sizes.len()).find(|&axis| is_component(axis)) {
            let found = format!("axis {axis} of kind `{}`", kinds.get(axis).unwrap_or(&"none"));
            return Err(ImagesError::unsupported(
                self.path,
                found,
                "axes of space, and components along the first axis",
            ));
        }
        let first = is_component(0).then(|| sizes[0]);
        Ok(first.map(|size| usize::try_from(size).unwrap_or(usize::MAX)))
    }

    /// Spacing, origin and directions of the axes after the `first` ones.
    pub(super) fn geometry(&self, first: usize, axes: usize) -> Result<Geometry, ImagesError> {
        let signs = self.space()?;
        let unit = |name: &str, axis: usize| {
            let units = self.get(&[name]).unwrap_or_default();
            let unit = units.split('"').filter(|part| !part.trim().is_empty()).nth(axis);
            match unit {
                Some("m") => 1e3,
                Some("um" | "µm" | "micron" | "microns") => 1e-3,
                _ => 1.0,
            }
        };
        let mut origin = [0.0; 3];
        if let Some(text) = self.get(&["space origin"]) {
            let Some(Some(vector)) = directions(text, 1).map(|vectors| vectors[0]) else {
                return Err(self.malformed(format!("space origin: {text}; one vector is expected")));
            };
            origin =
                std::array::from_fn(|component| signs[component] * vector[component] * unit("space units", component));
        }
        if let Some(text) = self.get(&["space directions"]) {
            let Some(vectors) = directions(text, axes) else {
                return Err(self.malformed(format!("space directions: {text}; {axes} vectors are expected")));
            };
            let mut spacing = Vec::new();
            let mut found = Vec::new();
            for vector in vectors.into_iter().skip(first).rev() {
                let vector = vector.unwrap_or([f64::NAN; 3]);
                let vector: [f64; 3] = std::array::from_fn(|component| {
                    signs[component] * vector[component] * unit("space units", component)
                });
                let length = vector[0].hypot(vector[1]).hypot(vector[2]);
                spacing.push(length);
                found.push(vector.map(|component| if 0.0 < length { component / length } else { 0.0 }));
            }
            return Ok(Geometry { spacing, origin, directions: Some(found) });
        }
        let Some(text) = self.get(&["spacings"]) else {
            return Ok(Geometry { spacing: vec![1.0; axes - first], origin, directions: None });
        };
        let numbers: Option<Vec<f64>> = text.split_ascii_whitespace().map(|number| number.parse().ok()).collect();
        match numbers {
            Some(numbers) if numbers.len() == axes => {
                let scaled = numbers.iter().enumerate().skip(first).map(|(axis, number)| number * unit("units", axis));
                // An axis without a spacing has NaN: its samples count as one apart.
                let spacing = scaled.map(|spacing| if spacing.is_nan() { 1.0 } else { spacing.abs() });
                let mut spacing: Vec<_> = spacing.collect();
                spacing.reverse();
                Ok(Geometry { spacing, origin, directions: None })
            }
            _ => Err(self.malformed(format!("spacings: {text}; {axes} numbers are expected"))),
        }
    }

    /// The signs that turn the space of the file to LPS.
    fn space(&self) -> Result<[f64; 3], ImagesError> {
        let space = self.get(&["space"]);
        let signs = match space.map(str::to_lowercase).as_deref() {
            Some("right-anterior-superior" | "ras") => [-1.0, -1.0, 1.0],
            Some("left-anterior-superior" | "las") => [1.0, -1.0, 1.0],
            Some("left-posterior-superior" | "lps" | "scanner-xyz" | "3d-right-handed" | "3d-left-handed") | None => {
                [1.0; 3]
            }
            Some(other) => {
                let valid = "left-posterior-superior, right-anterior-superior, left-anterior-superior, scanner-xyz, \
                             3D-right-handed, 3D-left-handed";
                return Err(ImagesError::unsupported(self.path, format!("the space `{other}`"), valid));
            }
        };
        Ok(signs)
    }
}

/// Vectors of two or three numbers, `none` for an axis without one; `None` where the text is not `count` of them.
fn directions(text: &str, count: usize) -> Option<Vec<Option<[f64; 3]>>> {
    let mut vectors = Vec::new();
    let mut rest = text.trim();
    while !rest.is_empty() {
        if let Some(after) = rest.strip_prefix("none") {
            vectors.push(None);
            rest = after.trim_start();
            continue;
        }
        let (inside, after) = rest.strip_prefix('(')?.split_once(')')?;
        let numbers: Option<Vec<f64>> = inside.split(',').map(|number| number.trim().parse().ok()).collect();
        vectors.push(Some(match numbers?[..] {
            [x, y] => [x, y, 0.0],
            [x, y, z] => [x, y, z],
            _ => return None,
        }));
        rest = after.trim_start();
    }
    (vectors.len() == count).then_some(vectors)
}
