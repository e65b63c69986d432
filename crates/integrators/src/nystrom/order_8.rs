//! The coefficients of the Nyström pair of orders eight and six.
//!
//! Each row lists only the stages that take part, as (stage, coefficient), stages counted from zero. Accelerations aᵢⱼ belong
//! to positions, in units of h²; `B` to the position at the end, `B_VELOCITY` to its velocity; `E` and `E_VELOCITY` are these
//! weights less those of the formula of lower order.
//!
//! Source: J. R. Dormand, M. E. A. El-Mikkawy & P. J. Prince, *Families of Runge–Kutta–Nyström formulae*, IMA J. Numer. Anal. 7
//! (1987) 235–250: RKN8(6)9FM, whose last stage is the first of the next step.

/// The nodes of the stages.
pub(super) const C: [f64; 9] = [0.0, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.0];
/// The stages after the first.
pub(super) const ROWS: [&[(usize, f64)]; 8] = [&A2, &A3, &A4, &A5, &A6, &A7, &A8, &A9];
/// Stage 2.
const A2: [(usize, f64); 1] = [(0, 0.00125)];
/// Stage 3.
const A3: [(usize, f64); 2] = [(0, 0.0016666666666666668), (1, 0.0033333333333333335)];
/// Stage 4.
const A4: [(usize, f64); 3] = [(0, 0.045), (1, -0.09), (2, 0.09)];
/// Stage 5.
const A5: [(usize, f64); 4] =
    [(0, -0.3379798532571243), (1, 0.8611516478170984), (2, -0.48613644655235316), (3, 0.0879646519923791)];
/// Stage 6.
const A6: [(usize, f64); 5] = [
    (0, 0.7461462641043086),
    (1, -1.804347430246737),
    (2, 1.2761518285888953),
    (3, -0.031220932716737166),
    (4, 0.05827027027027027),
];
/// Stage 7.
const A7: [(usize, f64); 6] = [
    (0, -1.2551623461807584),
    (1, 3.257463187064823),
    (2, -2.068866619575089),
    (3, 0.4206478455603251),
    (4, -0.018382978723404254),
    (5, 0.06930091185410335),
];
/// Stage 8.
const A8: [(usize, f64); 7] = [
    (0, 3.772901830095941),
    (1, -9.669613121677195),
    (2, 6.7991544547851674),
    (3, -0.8490343907823893),
    (4, 0.4671734865470852),
    (5, -0.04939742152466368),
    (6, 0.028815162556053812),
];
/// Stage 9.
const A9: [(usize, f64); 6] = [
    (0, 0.028092718568909044),
    (2, 0.1457093253968254),
    (3, 0.1529431216931217),
    (4, 0.09151785714285714),
    (5, 0.06554705215419501),
    (6, 0.01618992504409171),
];
/// The weights of the position.
pub(super) const B: [(usize, f64); 6] = [
    (0, 0.028092718568909044),
    (2, 0.1457093253968254),
    (3, 0.1529431216931217),
    (4, 0.09151785714285714),
    (5, 0.06554705215419501),
    (6, 0.01618992504409171),
];
/// The weights of the velocity.
pub(super) const B_VELOCITY: [(usize, f64); 7] = [
    (0, 0.028092718568909044),
    (2, 0.1618992504409171),
    (3, 0.2184901738473167),
    (4, 0.18303571428571427),
    (5, 0.2184901738473167),
    (6, 0.1618992504409171),
    (7, 0.028092718568909044),
];
/// The error of the position.
pub(super) const E: [(usize, f64); 6] = [
    (0, -0.044557986852984274),
    (2, 0.10965442077101599),
    (3, -0.14620589436135464),
    (4, 0.1315853049252192),
    (5, -0.06265966901200913),
    (6, 0.012183824530112887),
];
/// The error of the velocity.
pub(super) const E_VELOCITY: [(usize, f64); 8] = [
    (0, -0.044557986852984274),
    (2, 0.12183824530112887),
    (3, -0.2088655633733638),
    (4, 0.2631706098504384),
    (5, -0.2088655633733638),
    (6, 0.12183824530112887),
    (7, 0.10544201314701572),
    (8, -0.15),
];
