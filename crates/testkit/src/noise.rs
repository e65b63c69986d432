//! Noise of a normal distribution.

/// Normally distributed numbers of mean 0 and deviation 1, the same for the same seed: `SplitMix64` with the transform of Box and Muller.
///
/// # Example
/// ```
/// use piola_testkit::NormalNoise;
/// let mut noise = NormalNoise(1);
/// let squares: f64 = (0..1000).map(|_| noise.draw().powi(2)).sum();
/// assert!((squares / 1000.0 - 1.0).abs() < 0.15); // the deviation of the mean is √(2/1000)
/// assert_eq!(NormalNoise(7).draw(), NormalNoise(7).draw());
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NormalNoise(pub u64);

impl NormalNoise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The next number.
    pub fn draw(&mut self) -> f64 {
        let (u, v) = (1.0 - self.uniform(), self.uniform());
        (-2.0 * u.ln()).sqrt() * (core::f64::consts::TAU * v).cos()
    }
}
