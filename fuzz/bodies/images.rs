//! A file of an image or of a displacement field is refused in words, or its numbers are finite and as many as its sizes say.

use piola_images::{AnyPicture, DisplacementField, ImagesError};

/// The name of a file that begins like this.
fn name(data: &[u8]) -> &'static str {
    match data {
        [0x89, b'P', ..] => "fuzz.png",
        [b'I', b'I', ..] | [b'M', b'M', ..] => "fuzz.tif",
        [0x1f, 0x8b, ..] => "fuzz.nii.gz",
        [b'N', b'R', ..] => "fuzz.nrrd",
        _ => "fuzz.nii",
    }
}

fn check(values: &[f64], sizes: &[usize]) {
    assert_eq!(values.len(), sizes.iter().product::<usize>());
    assert!(values.iter().all(|value| value.is_finite()));
}

fn words<T>(read: Result<T, ImagesError>) -> Option<T> {
    read.map_err(|error| assert!(!error.to_string().is_empty())).ok()
}

/// Whether the image or the field is accepted.
pub(super) fn run(data: &[u8]) -> bool {
    let name = name(data);
    let picture = words(AnyPicture::from_content(name, data));
    match &picture {
        Some(AnyPicture::Plane(plane)) => check(plane.values(), &plane.sizes()),
        Some(AnyPicture::Space(space)) => check(space.values(), &space.sizes()),
        None => {}
    }
    let field = words(DisplacementField::<3>::from_content(name, data));
    if let Some(field) = &field {
        let displacements = field.map.displacements().as_flattened();
        check(displacements, &[3, field.map.grid().len()]);
    }
    picture.is_some() || field.is_some()
}
