//! Deformations and their decompositions, ours and by other means.
//!
//! | module | what |
//! |---|---|
//! | [`methods`] | polar decomposition, logarithm and eigenvectors: ours, nalgebra's, the closed form |
//! | [`trigonometric`] | eigenvalues by the arccosine, eigenvectors by cross products |
//! | [`accuracy`] | time and worst error of each method on adversarial deformations |
//! | [`sheet`] | these as a figure and as tables |

pub mod accuracy;
pub mod methods;
pub mod sheet;
pub mod trigonometric;

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;

/// So many ordinary deformations, stretch ratios below 10, in no order.
///
/// # Panics
/// Never: their entries differ from those of 1 by less than 0.3.
#[must_use]
pub fn ordinary_deformations(count: usize) -> Vec<DeformationGradient> {
    let entry = |i: usize, k: usize| 0.29 * (2.0 * (0.5 + i as f64 * STEPS[k]).fract() - 1.0);
    (0..count)
        .map(|i| {
            let matrix = Matrix3::from_fn(|r, c| f64::from(u8::from(r == c)) + entry(i, 3 * r + c));
            DeformationGradient::new(matrix).expect("diagonally dominant, or nearly: 0 < det F")
        })
        .collect()
}

/// Irrational steps: sequences that fill the interval evenly and are not in step with one another.
const STEPS: [f64; 9] = [
    0.618_033_988_749_895,
    0.754_877_666_246_693,
    0.569_840_290_998_053,
    0.819_172_513_396_164,
    0.671_043_606_703_789,
    0.549_700_477_901_970,
    0.856_674_883_854_503,
    0.733_891_856_627_126,
    0.628_706_721_026_386,
];
