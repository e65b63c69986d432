//! The two placements of a NIfTI header, `qform` and `sform`, as they stand there.

/// The numbers of the header that place a picture, in RAS and mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Forms {
    /// The handedness, then the spacings along the axes of the file.
    pub(crate) pixdim: [f32; 4],
    pub(crate) qform_code: i16,
    /// b, c, d of the unit quaternion, then the offset.
    pub(crate) quaternion: [f32; 6],
    pub(crate) sform_code: i16,
    /// The rows of the affine map.
    pub(crate) rows: [[f32; 4]; 3],
}
