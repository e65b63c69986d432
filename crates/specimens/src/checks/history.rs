//! Frame indifference and symmetry of simple materials, over histories.

use nalgebra::{Matrix3, Rotation3, Vector3};
use piola_solids::memory::SimpleMaterial;

use super::{Observers, Report, Sampler, Search, SymmetryGroup};

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
/// use piola_solids::SaintVenantKirchhoff;
/// use piola_solids::memory::{Prony, PronyTerm, Remembered, Viscoelastic};
/// use piola_specimens::checks::{Search, history_indifference};
/// let prony = Prony::new(vec![PronyTerm { weight: 0.5, time: 1.0 }])?;
/// let solid = Viscoelastic::relaxing(SaintVenantKirchhoff::new(1.0, 2.0)?, prony)?;
/// let search = Search { samples: 20, ..Search::default() };
/// assert!(history_indifference(&Remembered::new(&solid, 5.0, 50)?, 1.0, &search).passes());
/// # Ok::<(), piola_solids::SolidsError>(())
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

/// A history, and the same after a change of the reference that should not be felt: present values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HistoryImages {
    /// F now.
    pub gradient: Matrix3<f64>,
    /// H of the group.
    pub element: Matrix3<f64>,
    /// The stress of the history F(t − s), Pa.
    pub stress: Matrix3<f64>,
    /// The stress of the history F(t − s) H, Pa: should be the same.
    pub image: Matrix3<f64>,
}

/// Tries to refute G(F(t − s) H) = G(F(t − s)) for H of the group, W(18.27) and, for all rotations, W(19.36), for histories that change
/// within about `time` seconds.
///
/// # Example
/// A viscoelastic solid of isotropic laws is isotropic, and equals its form by relative stretches.
/// ```
/// use piola_solids::SaintVenantKirchhoff;
/// use piola_solids::memory::{IsotropicForm, Prony, PronyTerm, Remembered, Viscoelastic};
/// use piola_specimens::checks::{Search, SymmetryGroup, history_indifference, history_symmetry};
/// let prony = Prony::new(vec![PronyTerm { weight: 0.5, time: 1.0 }])?;
/// let solid = Viscoelastic::relaxing(SaintVenantKirchhoff::new(1.0, 2.0)?, prony)?;
/// let material = Remembered::new(&solid, 5.0, 20)?;
/// let search = Search { samples: 20, ..Search::default() };
/// assert!(history_symmetry(&material, &SymmetryGroup::isotropic(), 1.0, &search).passes());
/// assert!(history_indifference(&IsotropicForm(material), 1.0, &search).passes());
/// # Ok::<(), piola_solids::SolidsError>(())
/// ```
#[must_use]
pub fn history_symmetry(
    material: &impl SimpleMaterial,
    group: &SymmetryGroup,
    time: f64,
    search: &Search,
) -> Report<HistoryImages> {
    let mut sampler = Sampler::new(search.seed);
    let samples = (0..search.samples.max(group.order().unwrap_or(0))).map(|k| {
        let body = Drawn::new(&mut sampler, search.strain, time);
        let element = group.element(k, &mut sampler);
        let stress = material.cauchy(&|elapsed: f64| body.gradient(elapsed));
        let image = material.cauchy(&|elapsed: f64| body.gradient(elapsed) * element);
        let gradient = body.gradient(0.0);
        let scale = stress.norm().max(image.norm());
        Some(((image - stress).norm(), scale, HistoryImages { gradient, element, stress, image }))
    });
    Report::of(search, samples)
}
