//! The types of samples in files, and their bytes.

/// The type of the samples in a file.
///
/// In memory every sample is an `f64`, which holds all of these exactly.
///
/// # Example
/// ```
/// use piola_images::SampleType;
/// assert_eq!(SampleType::I16.bytes(), 2);
/// assert_eq!(SampleType::U8.nearest(300.4), 255.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SampleType {
    /// Whole numbers 0 … 255.
    U8,
    /// Whole numbers −128 … 127.
    I8,
    /// Whole numbers 0 … 65 535.
    U16,
    /// Whole numbers −32 768 … 32 767.
    I16,
    /// Whole numbers 0 … 2³² − 1.
    U32,
    /// Whole numbers −2³¹ … 2³¹ − 1.
    I32,
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

/// The byte order of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    Little,
    Big,
}

impl SampleType {
    /// The bytes of a sample.
    #[must_use]
    pub fn bytes(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The least and the greatest number of the type.
    #[must_use]
    pub fn range(self) -> [f64; 2] {
        match self {
            Self::U8 => [0.0, f64::from(u8::MAX)],
            Self::I8 => [f64::from(i8::MIN), f64::from(i8::MAX)],
            Self::U16 => [0.0, f64::from(u16::MAX)],
            Self::I16 => [f64::from(i16::MIN), f64::from(i16::MAX)],
            Self::U32 => [0.0, f64::from(u32::MAX)],
            Self::I32 => [f64::from(i32::MIN), f64::from(i32::MAX)],
            Self::F32 => [f64::from(f32::MIN), f64::from(f32::MAX)],
            Self::F64 => [f64::MIN, f64::MAX],
        }
    }

    /// The number of the type nearest to `value`; values beyond the range become its end.
    #[must_use]
    pub fn nearest(self, value: f64) -> f64 {
        let [least, greatest] = self.range();
        match self {
            Self::F64 => value,
            Self::F32 => f64::from(single(value.clamp(least, greatest))),
            _ => value.clamp(least, greatest).round(),
        }
    }

    /// The numbers whose bytes these are.
    pub(crate) fn decode(self, bytes: &[u8], order: Order) -> Vec<f64> {
        macro_rules! of {
            ($number:ty) => {
                bytes
                    .as_chunks()
                    .0
                    .iter()
                    .map(|&chunk| match order {
                        Order::Little => f64::from(<$number>::from_le_bytes(chunk)),
                        Order::Big => f64::from(<$number>::from_be_bytes(chunk)),
                    })
                    .collect()
            };
        }
        match self {
            Self::U8 => of!(u8),
            Self::I8 => of!(i8),
            Self::U16 => of!(u16),
            Self::I16 => of!(i16),
            Self::U32 => of!(u32),
            Self::I32 => of!(i32),
            Self::F32 => of!(f32),
            Self::F64 => of!(f64),
        }
    }

    /// The bytes of the nearest numbers, the least significant first.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "`nearest` lies in the range of the type"
    )]
    pub(crate) fn encode(self, values: impl Iterator<Item = f64>, order: Order) -> Vec<u8> {
        macro_rules! of {
            ($number:ty) => {
                values
                    .flat_map(|value| {
                        let number = self.nearest(value) as $number;
                        match order {
                            Order::Little => number.to_le_bytes(),
                            Order::Big => number.to_be_bytes(),
                        }
                    })
                    .collect()
            };
        }
        match self {
            Self::U8 => of!(u8),
            Self::I8 => of!(i8),
            Self::U16 => of!(u16),
            Self::I16 => of!(i16),
            Self::U32 => of!(u32),
            Self::I32 => of!(i32),
            Self::F32 => of!(f32),
            Self::F64 => of!(f64),
        }
    }
}

/// The nearest number of single precision.
#[expect(clippy::cast_possible_truncation, reason = "rounds to the nearest")]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}
