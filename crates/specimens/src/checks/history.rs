//! Do simple materials turn with the observer, whatever their history?

use nalgebra::{Matrix3, Rotation3, Vector3};
use piola_solids::memory::SimpleMaterial;

use super::{Observers, Report, Sampler, Search};

/// A smooth history drawn by the sampler, with periods about `time`.
struct Drawn {
    rotations: [Matrix3<f64>; 2],
    spin: Vector3<f64>,
    strain: f64,
    phases: [f64; 3],
    rates: [f64; 3],
}

impl Drawn {
    fn new(sampler: &mut Sampler, strain: f64, time: f64) -> Self {
        let mut numbers = |scale: f64| core::array::from_fn(|_| scale * sampler.balanced());
        let (phases, rates) = (numbers(core::f64::consts::PI), numbers(4.0 / time));
        let spin = Vector3::from(numbers(3.0 / time));
        Self { rotations: [sampler.rotation(), sampler.rotation()], spin, strain, phases, rates }
    }

    fn rotation(&self, elapsed: f64) -> Matrix3<f64> {
        self.rotations[0] * Rotation3::new(self.spin * elapsed).into_inner()
    }

    fn gradient(&self, elapsed: f64) -> Matrix3<f64> {
        let stretch: [f64; 3] =
            core::array::from_fn(|i| (self.strain * (self.rates[i] * elapsed + self.phases[i]).cos()).exp());
        self.rotation(elapsed) * Matrix3::from_diagonal(&stretch.into()) * self.rotations[1]
    }
}

/// Tries to refute G(Q(t − s) F(t − s)) = Q(t) G(F(t − s)) Q(t)ᵀ, W(18.3), for histories that change within about `time`
/// seconds, and observers that spin as fast.
///
/// The report holds the present values of the worst histories.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_solids::memory::{History, Reduced, SimpleMaterial};
/// use piola_specimens::checks::{Search, history_indifference};
///
/// struct Mine;
/// impl SimpleMaterial for Mine {
///     fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
///         let (now, then) = (history.gradient(0.0), history.gradient(1.0));
///         now + now.transpose() - then - then.transpose()
///     }
/// }
///
/// let search = Search { samples: 50, ..Search::default() };
/// assert!(!history_indifference(&Mine, 1.0, &search).passes());
/// assert!(history_indifference(&Reduced(Mine), 1.0, &search).passes());
/// ```
#[must_use]
pub fn history_indifference(material: &impl SimpleMaterial, time: f64, search: &Search) -> Report<Observers> {
    let mut sampler = Sampler::new(search.seed);
    let samples = (0..search.samples).map(|_| {
        let body = Drawn::new(&mut sampler, search.strain, time);
        let observer = Drawn::new(&mut sampler, 0.0, time);
        let stress = material.cauchy(&|elapsed: f64| body.gradient(elapsed));
        let seen = material.cauchy(&|elapsed: f64| observer.rotation(elapsed) * body.gradient(elapsed));
        let (gradient, rotation) = (body.gradient(0.0), observer.rotation(0.0));
        let violation = (seen - rotation * stress * rotation.transpose()).norm();
        Some((violation, stress.norm().max(seen.norm()), Observers { gradient, rotation, stress, seen }))
    });
    Report::of(search, samples)
}
