//! Stiff problems with known ends.

use core::convert::Infallible;

use piola_integrators::Field;
use piola_numerics::Real;

/// Makes each component's error relative to its own size.
macro_rules! componentwise {
    ($T:ident) => {
        fn magnitudes(&self, y: &[$T], magnitudes: &mut [f64]) {
            for (magnitude, y) in magnitudes.iter_mut().zip(y) {
                *magnitude = y.primal(0).abs();
            }
        }
    };
}

/// x' = v, ε v' = (1 − x²) v − x with ε = 1e-6, to t = 2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VanDerPol;
impl<T: Real> Field<T> for VanDerPol {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        rate[0] = y[1];
        rate[1] = ((T::one() - y[0] * y[0]) * y[1] - y[0]) / T::lit(1e-6);
        Ok(())
    }
    componentwise!(T);
}

/// Robertson's autocatalytic reaction, to t = 1e11.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Robertson;
impl<T: Real> Field<T> for Robertson {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        3
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let slow = T::lit(0.04) * y[0];
        let back = T::lit(1e4) * y[1] * y[2];
        let fast = T::lit(3e7) * y[1] * y[1];
        rate[0] = back - slow;
        rate[1] = slow - back - fast;
        rate[2] = fast;
        Ok(())
    }
    componentwise!(T);
}

/// HIRES: high irradiance responses of photomorphogenesis (Schäfer 1975), to t = 321.8122.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hires;
impl<T: Real> Field<T> for Hires {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        8
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let c = T::lit;
        rate[0] = c(-1.71) * y[0] + c(0.43) * y[1] + c(8.32) * y[2] + c(0.0007);
        rate[1] = c(1.71) * y[0] - c(8.75) * y[1];
        rate[2] = c(-10.03) * y[2] + c(0.43) * y[3] + c(0.035) * y[4];
        rate[3] = c(8.32) * y[1] + c(1.71) * y[2] - c(1.12) * y[3];
        rate[4] = c(-1.745) * y[4] + c(0.43) * (y[5] + y[6]);
        let binding = c(280.0) * y[5] * y[7];
        rate[5] = -binding + c(0.69) * y[3] + c(1.71) * y[4] - c(0.43) * y[5] + c(0.69) * y[6];
        rate[6] = binding - c(1.81) * y[6];
        rate[7] = -rate[6];
        Ok(())
    }
    componentwise!(T);
}

/// The Oregonator of the Belousov–Zhabotinskii reaction, to t = 360.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Oregonator;
impl<T: Real> Field<T> for Oregonator {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        3
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let (one, s) = (T::one(), T::lit(77.27));
        rate[0] = s * (y[1] + y[0] * (one - T::lit(8.375e-6) * y[0] - y[1]));
        rate[1] = (y[2] - (one + y[0]) * y[1]) / s;
        rate[2] = T::lit(0.161) * (y[0] - y[2]);
        Ok(())
    }
    componentwise!(T);
}

/// A mass of one on a spring of length 1, stiffness 1e6 and critical damping along it, in gravity 1: (x, y, ẋ, ẏ).
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpringPendulum;
impl<T: Real> Field<T> for SpringPendulum {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        4
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let length = (y[0] * y[0] + y[1] * y[1]).sqrt();
        let stretching = (y[0] * y[2] + y[1] * y[3]) / length;
        let pull = (T::lit(1e6) * (length - T::one()) + T::lit(2e3) * stretching) / length;
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = -pull * y[0];
        rate[3] = -pull * y[1] - T::one();
        Ok(())
    }
}
