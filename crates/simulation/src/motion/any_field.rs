//! Systems and steps behind pointers, so that the integrators are compiled once, not once for each system.

use core::fmt::Display;

use piola_integrators::{
    Checkpoint, DenseStep, Field, NystromPair, NystromStep, RungeKuttaPair, SecondOrder, Separable,
};

/// A field behind a pointer, so that the integrators are compiled once, not once for each system.
/// It costs a call through a pointer, some nanoseconds an evaluation.
pub(super) struct AnyField<'f, F: ?Sized>(pub(super) &'f mut F);

/// What an integrator asks of a field, with errors as text.
pub(super) trait FieldWithText {
    fn dimension(&self) -> usize;
    fn is_second_order(&self) -> bool;
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), String>;
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), String>;
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]);
}

impl<F: Field<Error: Display>> FieldWithText for F {
    fn dimension(&self) -> usize {
        Field::dimension(self)
    }
    fn is_second_order(&self) -> bool {
        Field::is_second_order(self)
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), String> {
        Field::rate(self, t, y, rate).map_err(|error| error.to_string())
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), String> {
        Field::project(self, t, y).map_err(|error| error.to_string())
    }
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        Field::magnitudes(self, y, magnitudes);
    }
}

impl Field for AnyField<'_, dyn FieldWithText + '_> {
    type Error = String;
    fn dimension(&self) -> usize {
        self.0.dimension()
    }
    fn is_second_order(&self) -> bool {
        self.0.is_second_order()
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), String> {
        self.0.rate(t, y, rate)
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), String> {
        self.0.project(t, y)
    }
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        self.0.magnitudes(y, magnitudes);
    }
}

/// What a composition asks of a separable pair, with errors as text.
pub(super) trait SeparableWithText {
    fn freedom(&self) -> usize;
    fn velocity(&mut self, t: f64, momentum: &[f64], velocity: &mut [f64]) -> Result<(), String>;
    fn force(&mut self, t: f64, position: &[f64], force: &mut [f64]) -> Result<(), String>;
}

impl<F: Separable<Error: Display>> SeparableWithText for F {
    fn freedom(&self) -> usize {
        Separable::freedom(self)
    }
    fn velocity(&mut self, t: f64, momentum: &[f64], velocity: &mut [f64]) -> Result<(), String> {
        Separable::velocity(self, t, momentum, velocity).map_err(|error| error.to_string())
    }
    fn force(&mut self, t: f64, position: &[f64], force: &mut [f64]) -> Result<(), String> {
        Separable::force(self, t, position, force).map_err(|error| error.to_string())
    }
}

impl Separable for AnyField<'_, dyn SeparableWithText + '_> {
    type Error = String;
    fn freedom(&self) -> usize {
        self.0.freedom()
    }
    fn velocity(&mut self, t: f64, momentum: &[f64], velocity: &mut [f64]) -> Result<(), String> {
        self.0.velocity(t, momentum, velocity)
    }
    fn force(&mut self, t: f64, position: &[f64], force: &mut [f64]) -> Result<(), String> {
        self.0.force(t, position, force)
    }
}

/// What a Nyström pair asks of a system, with errors as text.
pub(super) trait SecondOrderWithText {
    fn freedom(&self) -> usize;
    fn is_velocity_dependent(&self) -> bool;
    fn acceleration(&mut self, t: f64, q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), String>;
    fn magnitudes(&self, state: &[f64], magnitudes: &mut [f64]);
}

impl<F: SecondOrder<f64, Error: Display>> SecondOrderWithText for F {
    fn freedom(&self) -> usize {
        SecondOrder::freedom(self)
    }
    fn is_velocity_dependent(&self) -> bool {
        SecondOrder::is_velocity_dependent(self)
    }
    fn acceleration(&mut self, t: f64, q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), String> {
        SecondOrder::acceleration(self, t, q, v, acceleration).map_err(|error| error.to_string())
    }
    fn magnitudes(&self, state: &[f64], magnitudes: &mut [f64]) {
        SecondOrder::magnitudes(self, state, magnitudes);
    }
}

impl SecondOrder for AnyField<'_, dyn SecondOrderWithText + '_> {
    type Error = String;
    const OWN_MAGNITUDES: bool = true;
    fn freedom(&self) -> usize {
        self.0.freedom()
    }
    fn is_velocity_dependent(&self) -> bool {
        self.0.is_velocity_dependent()
    }
    fn acceleration(&mut self, t: f64, q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), String> {
        self.0.acceleration(t, q, v, acceleration)
    }
    fn magnitudes(&self, state: &[f64], magnitudes: &mut [f64]) {
        self.0.magnitudes(state, magnitudes);
    }
}

/// An accepted step of an adaptive method.
pub(super) trait AdaptiveStep {
    fn time(&self) -> f64;
    fn values(&self) -> &[f64];
    fn at(&mut self, t: f64, values: &mut [f64]) -> Result<(), String>;
    fn checkpoint(&self) -> Checkpoint;
}

impl<P: RungeKuttaPair, F: Field<f64, Error: Display>> AdaptiveStep for DenseStep<'_, P, f64, F> {
    fn time(&self) -> f64 {
        self.time()
    }
    fn values(&self) -> &[f64] {
        self.values()
    }
    fn at(&mut self, t: f64, values: &mut [f64]) -> Result<(), String> {
        self.at(t, values).map_err(|error| error.to_string())
    }
    fn checkpoint(&self) -> Checkpoint {
        self.checkpoint()
    }
}

impl<P: NystromPair, F: SecondOrder<f64, Error: Display>> AdaptiveStep for NystromStep<'_, P, f64, F> {
    fn time(&self) -> f64 {
        self.time()
    }
    fn values(&self) -> &[f64] {
        self.values()
    }
    fn at(&mut self, t: f64, values: &mut [f64]) -> Result<(), String> {
        self.at(t, values).map_err(|error| error.to_string())
    }
    fn checkpoint(&self) -> Checkpoint {
        self.checkpoint()
    }
}
