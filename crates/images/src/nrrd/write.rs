//! The bytes of a NRRD file, packed by gzip.

use std::fmt::Write as _;
use std::path::Path;

use crate::contents::Contents;
use crate::error::ImagesError;
use crate::file;
use crate::sample_type::{Order, SampleType};

pub(crate) fn encode(path: &Path, contents: &Contents) -> Result<Vec<u8>, ImagesError> {
    let contents = contents.unscaled();
    let axes = contents.sizes.len();
    let is_vector = 1 < contents.components;
    let name = match contents.sample_type {
        SampleType::I8 => "int8",
        SampleType::U8 => "uint8",
        SampleType::I16 => "int16",
        SampleType::U16 => "uint16",
        SampleType::I32 => "int32",
        SampleType::U32 => "uint32",
        SampleType::F32 => "float",
        SampleType::F64 => "double",
    };
    let is_in_plane = axes == 2
        && contents.origin[2].abs() <= 0.0
        && contents.directions.iter().all(|direction| direction[2].abs() <= 0.0);
    let dimension = if is_in_plane { 2 } else { 3 };
    let vector = |numbers: [f64; 3]| {
        let texts: Vec<_> = numbers[..dimension].iter().map(ToString::to_string).collect();
        format!("({})", texts.join(","))
    };
    let (mut sizes, mut directions, mut kinds) = (String::new(), String::new(), String::new());
    if is_vector {
        let _ = write!(sizes, " {}", contents.components);
        directions.push_str(" none");
        kinds.push_str(" vector");
    }
    for axis in (0..axes).rev() {
        let spacing = contents.spacing[axis];
        let _ = write!(sizes, " {}", contents.sizes[axis]);
        let _ = write!(directions, " {}", vector(contents.directions[axis].map(|component| spacing * component)));
        kinds.push_str(" domain");
    }
    let space = if is_in_plane { "space dimension: 2" } else { "space: left-posterior-superior" };
    let header = format!(
        "NRRD0004\n# piola\ntype: {name}\ndimension: {}\n{space}\nsizes:{sizes}\nspace directions:{directions}\n\
         kinds:{kinds}\nendian: little\nencoding: gzip\nspace origin: {}\n\n",
        axes + usize::from(is_vector),
        vector(contents.origin),
    );
    let mut content = header.into_bytes();
    let samples = contents.sample_type.encode(contents.values.iter().copied(), Order::Little);
    content.extend(file::deflate(path, &samples)?);
    Ok(content)
}
