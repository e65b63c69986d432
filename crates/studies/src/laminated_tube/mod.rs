//! A tube of concentric layers with natural lengths of their own: residual stress, and stress under a pressure inside.
//!
//! ```text
//! M = diag(m², (g_θ R)², g_z²)        m, g_θ, g_z: growth across the layer, around and along the tube     W(29.31)
//! r² = r_i² + 2 ∫ √det M dR/λ,  θ = Θ,  z = λ Z                                                W(29.34)
//! ```

pub(crate) mod pressure;
mod run;

pub use run::{TubeState, TubeStresses};

use piola_numerics::Real;
use piola_uniformity::laminated::{LaminaMetric, Lamination};

use crate::RubberLaw;

/// A tube of layers, and the pressure inside.
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_studies::RubberLaw;
/// use piola_studies::laminated_tube::{Layer, LayeredTube, Layers};
/// use std::ops::ControlFlow;
/// let layer = |hoop: f64| Layer { thickness: 0.5, growth: [1.0, hoop, 1.0] };
/// let layers = Layers::new(1.0, vec![layer(1.1), layer(1.0)]);
/// let tube = LayeredTube { layers, law: RubberLaw::from(NeoHookean::new(1.0)?), pressure: 0.1, stretch: 2.0 };
/// let (found, _) = tube.run(&mut |_| ControlFlow::Continue(()));
/// // Without loads the layer that has grown is pressed by its neighbour.
/// let Some(rest) = &found.at_rest else { panic!() };
/// assert!(rest.stresses[0].stress[1] < 0.0 && 0.0 < rest.stresses[rest.stresses.len() - 1].stress[1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct LayeredTube {
    /// The layers.
    pub layers: Layers,
    /// The law of all layers.
    pub law: RubberLaw,
    /// Pressure inside, Pa.
    pub pressure: f64,
    /// Largest stretch of the inner face over that without loads.
    pub stretch: f64,
}

/// A layer.
///
/// # Example
/// See [`LayeredTube`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Thickness in the reference, m.
    pub thickness: f64,
    /// Natural lengths over those in the reference: across the layer, around and along the tube.
    pub growth: [f64; 3],
}

/// Concentric layers from an inner radius on: the metric of a tube.
///
/// # Example
/// ```
/// use piola_studies::laminated_tube::{Layer, Layers};
/// let layers = Layers::new(1.0, vec![Layer { thickness: 0.5, growth: [1.0, 1.1, 1.0] }]);
/// assert_eq!(layers.radii(), [1.0, 1.5]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Layers {
    inner: f64,
    list: Vec<Layer>,
    /// Outer radii of all layers, m.
    ends: Vec<f64>,
}

impl Layers {
    /// From the inner radius, m, and the layers, the innermost first.
    #[must_use]
    pub fn new(inner: f64, layers: Vec<Layer>) -> Self {
        let mut radius = inner;
        let ends = layers
            .iter()
            .map(|layer| {
                radius += layer.thickness;
                radius
            })
            .collect();
        Self { inner, list: layers, ends }
    }

    /// The radii of the faces in the reference, m.
    #[must_use]
    pub fn radii(&self) -> [f64; 2] {
        [self.inner, self.ends.last().copied().unwrap_or(self.inner)]
    }

    /// The radii of the faces of each layer, m.
    pub(super) fn spans(&self) -> impl Iterator<Item = [f64; 2]> {
        let starts = core::iter::once(&self.inner).chain(&self.ends);
        starts.zip(&self.ends).map(|(from, to)| [*from, *to])
    }

    /// The layers.
    #[must_use]
    pub fn layers(&self) -> &[Layer] {
        &self.list
    }

    /// The same layers without growth.
    #[must_use]
    pub fn homogeneous(&self) -> Self {
        let (inner, ends) = (self.inner, self.ends.clone());
        let list = self.list.iter().map(|layer| Layer { growth: [1.0; 3], ..*layer }).collect();
        Self { inner, list, ends }
    }
}

impl Lamination for Layers {
    fn metric<T: Real>(&self, depth: T) -> LaminaMetric<T> {
        let of_outermost = self.list.last().map_or([1.0; 3], |layer| layer.growth);
        let mut growth = of_outermost.map(T::lit);
        // Inwards: the last layer that ends beyond the depth is the one.
        for (layer, end) in self.list.iter().zip(self.interfaces()).rev() {
            let is_within = depth.less_than(T::lit(*end));
            growth = core::array::from_fn(|k| T::select(is_within, T::lit(layer.growth[k]), growth[k]));
        }
        let [normal, hoop, axial] = growth;
        let around = hoop * depth;
        LaminaMetric { normal, in_plane: [around * around, axial * axial, T::zero()] }
    }

    fn interfaces(&self) -> &[f64] {
        self.ends.split_last().map_or(&[], |(_, ends)| ends)
    }
}
