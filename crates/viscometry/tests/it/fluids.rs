//! Fluids of the tests.

use std::cell::Cell;

use piola_fluids::FluidsError;
use piola_fluids::{FlowMoment, ViscometricFluid};
use piola_numerics::Real;

/// A thinning fluid with both normal stress differences, none of them a power: τ = k/(1 + |k|)^½, N₁ = k²/(1 + k²)^½, N₂ = −N₁/4.
#[derive(Clone, Copy, Debug)]
pub(super) struct Normal;

impl ViscometricFluid for Normal {
    const NAME: &'static str = "fluid with normal stresses";
    const NORMAL_STRESSES: bool = true;

    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        shear_rate / (T::one() + shear_rate.abs()).sqrt()
    }

    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        let square = shear_rate * shear_rate;
        T::lit(-0.25) * square / (T::one() + square).sqrt()
    }

    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        let square = shear_rate * shear_rate;
        T::lit(0.75) * square / (T::one() + square).sqrt()
    }
}

/// Another fluid without its closed forms.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numerical<F>(pub(super) F);

impl<F: ViscometricFluid> ViscometricFluid for Numerical<F> {
    const NAME: &'static str = F::NAME;
    const NORMAL_STRESSES: bool = F::NORMAL_STRESSES;

    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        self.0.shear_stress(shear_rate)
    }

    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        self.0.sigma1(shear_rate)
    }

    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        self.0.sigma2(shear_rate)
    }

    fn yield_stress(&self) -> f64 {
        self.0.yield_stress()
    }

    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        self.0.shear_rate(shear_stress)
    }
}

/// Another fluid, with counts of what it is asked.
#[derive(Debug, Default)]
pub(super) struct Counted<F> {
    pub(super) fluid: F,
    pub(super) stresses: Cell<usize>,
    pub(super) rates: Cell<usize>,
    pub(super) normals: Cell<usize>,
}

impl<F> Counted<F> {
    pub(super) fn new(fluid: F) -> Self {
        Self { fluid, stresses: Cell::new(0), rates: Cell::new(0), normals: Cell::new(0) }
    }

    /// What was asked since the last time: stresses, rates, normal stresses.
    pub(super) fn take(&self) -> [usize; 3] {
        [&self.stresses, &self.rates, &self.normals].map(Cell::take)
    }
}

impl<F: ViscometricFluid> ViscometricFluid for Counted<F> {
    const NAME: &'static str = F::NAME;
    const NORMAL_STRESSES: bool = F::NORMAL_STRESSES;

    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        self.stresses.set(self.stresses.get() + 1);
        self.fluid.shear_stress(shear_rate)
    }

    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        self.normals.set(self.normals.get() + 1);
        self.fluid.sigma1(shear_rate)
    }

    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        self.normals.set(self.normals.get() + 1);
        self.fluid.sigma2(shear_rate)
    }

    fn yield_stress(&self) -> f64 {
        self.fluid.yield_stress()
    }

    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        self.rates.set(self.rates.get() + 1);
        self.fluid.shear_rate(shear_stress)
    }

    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        self.fluid.flow_moment(moment, from, to)
    }
}
