//! A fixed sequence of samples: rotations, directions, deformations.

use nalgebra::Matrix3;

/// Numbers that look random but are the same for the same seed (the `SplitMix64` sequence).
///
/// # Example
/// ```
/// use piola_specimens::checks::Sampler;
/// let (mut once, mut again) = (Sampler::new(7), Sampler::new(7));
/// assert_eq!(once.rotation(), again.rotation());
/// ```
///
/// # Source
/// G. L. Steele, D. Lea, C. H. Flood, *Fast splittable pseudorandom number generators*, OOPSLA (2014); K. Shoemake, *Uniform
/// random rotations*, Graphics Gems III (1992).
#[derive(Clone, Debug)]
pub struct Sampler {
    state: u64,
}

impl Sampler {
    /// The sequence of a seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number of [0, 1).
    pub fn unit(&mut self) -> f64 {
        // 53 bits.
        (self.bits() >> 11) as f64 * (0.5 * f64::EPSILON)
    }

    /// A number of [−1, 1).
    pub fn balanced(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// A direction, uniformly distributed.
    pub fn direction(&mut self) -> [f64; 3] {
        let height = self.balanced();
        let (sine, cosine) = (core::f64::consts::TAU * self.unit()).sin_cos();
        let radius = ((1.0 - height) * (1.0 + height)).sqrt();
        [radius * cosine, radius * sine, height]
    }

    /// A rotation, uniformly distributed.
    pub fn rotation(&mut self) -> Matrix3<f64> {
        let share = self.unit();
        let (r, s) = (share.sqrt(), (1.0 - share).sqrt());
        let (a, b) = (core::f64::consts::TAU * self.unit(), core::f64::consts::TAU * self.unit());
        let (w, x, y, z) = (r * a.cos(), r * a.sin(), s * b.cos(), s * b.sin());
        Matrix3::new(
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
        )
    }

    /// Three stretches with |ln λ| up to `strain`.
    pub fn stretches(&mut self, strain: f64) -> [f64; 3] {
        core::array::from_fn(|_| (strain * self.balanced()).exp())
    }

    /// A deformation gradient with such stretches along axes of any direction, and any rotation.
    pub fn gradient(&mut self, strain: f64) -> Matrix3<f64> {
        let stretch = Matrix3::from_diagonal(&self.stretches(strain).into());
        self.rotation() * stretch * self.rotation()
    }
}
