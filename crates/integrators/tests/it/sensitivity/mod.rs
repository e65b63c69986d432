//! Derivatives of the end of a run: against closed forms, references, extended precision and each other.

mod adjoint;
mod checkpoints;
mod failures;
mod forward;
mod references;

use core::cell::Cell;
use core::convert::Infallible;

use piola_integrators::{
    AdjointSensitivity, ForwardSensitivity, JacobianProduct, Objective, ObjectiveGradient, ParametricField, RungeKutta,
    RungeKuttaPair, Sensitivities, SensitivityInputs, State, Tolerance,
};
use piola_numerics::Real;

/// Declares a field that never fails.
macro_rules! field {
    ($name:ty, $n:expr, $m:expr, |$this:ident, $t:ident, $y:ident, $p:ident, $rate:ident| $body:block) => {
        impl ParametricField for $name {
            type Error = Infallible;
            fn dimension(&self) -> usize {
                $n
            }
            fn parameters(&self) -> usize {
                let $this = self;
                $m
            }
            fn rate<T: Real>(&self, $t: f64, $y: &[T], $p: &[T], $rate: &mut [T]) -> Result<(), Infallible> {
                $body
                Ok(())
            }
        }
    };
}

/// ẍ = −p² x.
pub(crate) struct Oscillator;
field!(Oscillator, 2, 1, |_this, _t, y, p, rate| {
    rate[0] = y[1];
    rate[1] = -p[0] * p[0] * y[0];
});

/// The exact motion, ∂y/∂y₀ and ∂y/∂p at a time.
pub(crate) fn oscillation(start: [f64; 2], p: f64, t: f64) -> ([f64; 2], [f64; 4], [f64; 2]) {
    let (sine, cosine) = (p * t).sin_cos();
    let [x, v] = start;
    let end = [x * cosine + v / p * sine, v * cosine - p * x * sine];
    let by_start = [cosine, sine / p, -p * sine, cosine];
    let by_parameter =
        [-t * x * sine + v * (t * cosine / p - sine / (p * p)), -t * v * sine - x * (sine + p * t * cosine)];
    (end, by_start, by_parameter)
}

/// q̈ = −p q/|q|³ in the plane.
pub(crate) struct Kepler;
field!(Kepler, 4, 1, |_this, _t, y, p, rate| {
    let square = y[0] * y[0] + y[1] * y[1];
    let factor = p[0] / (square * square.sqrt());
    rate[0] = y[2];
    rate[1] = y[3];
    rate[2] = -y[0] * factor;
    rate[3] = -y[1] * factor;
});

/// The predator–prey equations of Lotka and Volterra.
pub(crate) struct LotkaVolterra;
field!(LotkaVolterra, 2, 4, |_this, _t, y, p, rate| {
    rate[0] = p[0] * y[0] - p[1] * y[0] * y[1];
    rate[1] = p[3] * y[0] * y[1] - p[2] * y[1];
});

/// A damped pendulum whose torque is Σ pₖ cos((k + 1) t/8).
pub(crate) struct Driven {
    pub(crate) coefficients: usize,
}
field!(Driven, 2, 1 + this.coefficients, |this, t, y, p, rate| {
    let mut torque = T::zero();
    for (k, &p) in p[1..].iter().enumerate() {
        torque += p * T::lit((0.125 * (k as f64 + 1.0) * t).cos());
    }
    rate[0] = y[1];
    rate[1] = torque - y[0].sin() - p[0] * y[1];
});

/// Smooth coefficients of the driven pendulum.
pub(crate) fn coefficients(m: usize) -> Vec<f64> {
    (0..=m).map(|k| 0.5 / (1.0 + k as f64)).collect()
}

/// [`Driven`] with its product in closed form.
pub(crate) struct DrivenWithProduct(pub(crate) Driven);
impl ParametricField for DrivenWithProduct {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn parameters(&self) -> usize {
        self.0.parameters()
    }
    fn rate<T: Real>(&self, t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        self.0.rate(t, y, p, rate)
    }
    fn vector_jacobian_product<T: Real>(
        &self,
        t: f64,
        y: &[T],
        p: &[T],
        product: &mut JacobianProduct<T>,
    ) -> Result<(), Infallible> {
        let (covector, by_state, by_parameters) = product.parts();
        let (first, second) = (covector[0], covector[1]);
        by_state[0] -= second * y[0].cos();
        by_state[1] += first - second * p[0];
        by_parameters[0] -= second * y[1];
        for (k, sum) in by_parameters[1..].iter_mut().enumerate() {
            *sum += second * T::lit((0.125 * (k as f64 + 1.0) * t).cos());
        }
        Ok(())
    }
}

/// Counts evaluations with and without derivatives.
pub(crate) struct Counted<F> {
    field: F,
    plain: Cell<u64>,
    differentiated: Cell<u64>,
}
impl<F> Counted<F> {
    pub(crate) const fn new(field: F) -> Self {
        Self { field, plain: Cell::new(0), differentiated: Cell::new(0) }
    }
}
impl<F: ParametricField> ParametricField for Counted<F> {
    type Error = F::Error;
    fn dimension(&self) -> usize {
        self.field.dimension()
    }
    fn parameters(&self) -> usize {
        self.field.parameters()
    }
    fn rate<T: Real>(&self, t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), F::Error> {
        let count = if T::ORDER == 0 { &self.plain } else { &self.differentiated };
        count.set(count.get() + 1);
        self.field.rate(t, y, p, rate)
    }
}

/// J = Σ cᵢ yᵢ at the end.
pub(crate) struct Linear(pub(crate) Vec<f64>);
impl Objective for Linear {
    fn terminal<T: Real>(&self, _t: f64, y: &[T], _p: &[T]) -> T {
        y.iter().zip(&self.0).fold(T::zero(), |sum, (&y, &c)| sum + T::lit(c) * y)
    }
    fn running<T: Real>(&self, _t: f64, _y: &[T], _p: &[T]) -> T {
        unreachable!("no integral was asked for")
    }
}

/// J = y₀(t₁)² + p₀ y₁(t₁) + ∫ (y₀² + t p₀ y₁) dt.
pub(crate) struct Mixed;
impl Objective for Mixed {
    const RUNNING: bool = true;
    fn terminal<T: Real>(&self, _t: f64, y: &[T], p: &[T]) -> T {
        y[0] * y[0] + p[0] * y[1]
    }
    fn running<T: Real>(&self, t: f64, y: &[T], p: &[T]) -> T {
        y[0] * y[0] + T::lit(t) * p[0] * y[1]
    }
}

pub(crate) fn method<P: RungeKuttaPair, T: Real>(tolerance: f64) -> RungeKutta<P, T> {
    RungeKutta::new(Tolerance::relative(tolerance).unwrap())
}

/// A method with steps of one length.
pub(crate) fn fixed<P: RungeKuttaPair, T: Real>(step: f64) -> RungeKutta<P, T> {
    method(0.99).with_first_step(step).unwrap().with_longest_step(step).unwrap()
}

/// The end of a run with all derivatives.
pub(crate) fn forward<P: RungeKuttaPair, F: ParametricField<Error = Infallible>>(
    method: RungeKutta<P>,
    field: &F,
    start: &[f64],
    p: &[f64],
    end: f64,
) -> (State, Sensitivities) {
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut sensitivities = Sensitivities::at_start(start.len(), p.len(), SensitivityInputs::StartAndParameters);
    let mut method = ForwardSensitivity::new(method);
    method.integrate_to(field, p, &mut state, &mut sensitivities, end).unwrap();
    (state, sensitivities)
}

/// The gradient of an objective.
pub(crate) fn adjoint<P: RungeKuttaPair, F: ParametricField<Error = Infallible>, G: Objective>(
    method: RungeKutta<P>,
    checkpoints: usize,
    field: &F,
    objective: &G,
    (start, p): (&[f64], &[f64]),
    end: f64,
) -> ObjectiveGradient {
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut method = AdjointSensitivity::new(method, checkpoints);
    method.integrate_to(field, p, &mut state, end).unwrap();
    let mut gradient = ObjectiveGradient::default();
    method.gradient(field, objective, &mut gradient).unwrap();
    gradient
}

/// cᵀM of a row-major matrix.
pub(crate) fn covector_times(c: &[f64], matrix: &[f64]) -> Vec<f64> {
    let columns = matrix.len() / c.len();
    (0..columns).map(|j| c.iter().enumerate().map(|(i, c)| c * matrix[i * columns + j]).sum()).collect()
}

/// |c|ᵀ|M|: the sizes of the terms of cᵀM.
pub(crate) fn sizes_of_terms(c: &[f64], matrix: &[f64]) -> Vec<f64> {
    let absolute = |x: &[f64]| x.iter().map(|x| x.abs()).collect::<Vec<_>>();
    covector_times(&absolute(c), &absolute(matrix))
}
