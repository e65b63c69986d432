//! The coefficients of eight stages, in columns that fill the lanes of one number.
//!
//! Made with sixty digits and rounded once. Source: the zeros of the Legendre polynomial P₈(2c − 1) = 0, and integrals
//! of the Lagrange polynomials on them; Hairer, Lubich & Wanner, *Geometric Numerical Integration*, II.1.3.

use piola_numerics::Lanes;

/// A number for each of the eight stages.
pub(super) type Stages = Lanes<f64, 8>;
/// A number for each pair of mirrored stages.
pub(super) type Half = Lanes<f64, 4>;

/// c, mirrored.
pub(super) const NODES: Stages = mirrored(Lanes([
    0.019855071751231884,
    0.10166676129318664,
    0.2372337950418355,
    0.4082826787521751,
    0.591717321247825,
    0.7627662049581645,
    0.8983332387068134,
    0.9801449282487681,
]));
/// b of the first four stages.
pub(super) const WEIGHTS: Half =
    Lanes([0.05061426814518813, 0.11119051722668724, 0.15685332293894363, 0.181341891689181]);
/// b (½ − c) of the first four stages; of the others −b (½ − c): a step back undoes a step, and rounding of coefficients causes no drift.
pub(super) const POSITION_WEIGHTS: Half =
    Lanes([0.024302184146935264, 0.04429087884039205, 0.04121575240374363, 0.016632192535744883]);
/// c − ½ of the first four stages.
pub(super) const OFFSETS: Half =
    Lanes([-0.48014492824876814, -0.39833323870681336, -0.2627662049581645, -0.0917173212478249]);
/// The columns of A − ½ 1bᵀ, antisymmetric about the middle to the last bit: entry i of column j.
const VELOCITY: [Stages; 8] = [
    Lanes([
        2.4308653429145085e-63,
        0.029452187694960257,
        0.023280401926318816,
        0.02655838689798717,
        0.024447897488329214,
        0.02592593976784458,
        0.024864331768251827,
        0.025584642399710984,
    ]),
    Lanes([
        -0.0647012019193137,
        4.861730685829017e-63,
        0.06526426638382955,
        0.05059823153500479,
        0.058793072923704386,
        0.05336954383805872,
        0.05716019352429256,
        0.05462250094928436,
    ]),
    Lanes([
        -0.07214583032244135,
        -0.09206645770525348,
        0.0,
        0.0922444728050818,
        0.07118545490824955,
        0.0830701273315763,
        0.07528690848400815,
        0.08034433672410878,
    ]),
    Lanes([
        -0.09515396145764525,
        -0.08252123698622994,
        -0.10664604920646893,
        0.0,
        0.10669198716561551,
        0.08229921312436433,
        0.09588629793373765,
        0.08759245447626371,
    ]),
    Lanes([
        -0.08759245447626371,
        -0.09588629793373765,
        -0.08229921312436433,
        -0.10669198716561551,
        -0.0,
        0.10664604920646893,
        0.08252123698622994,
        0.09515396145764525,
    ]),
    Lanes([
        -0.08034433672410878,
        -0.07528690848400815,
        -0.0830701273315763,
        -0.07118545490824955,
        -0.0922444728050818,
        -0.0,
        0.09206645770525348,
        0.07214583032244135,
    ]),
    Lanes([
        -0.05462250094928436,
        -0.05716019352429256,
        -0.05336954383805872,
        -0.058793072923704386,
        -0.05059823153500479,
        -0.06526426638382955,
        -4.861730685829017e-63,
        0.0647012019193137,
    ]),
    Lanes([
        -0.025584642399710984,
        -0.024864331768251827,
        -0.02592593976784458,
        -0.024447897488329214,
        -0.02655838689798717,
        -0.023280401926318816,
        -0.029452187694960257,
        -2.4308653429145085e-63,
    ]),
];
/// The columns of A² − ½ cbᵀ − ½ 1dᵀ with dⱼ = bⱼ (½ − cⱼ), symmetric about the middle to the last bit.
const POSITION: [Stages; 8] = [
    Lanes([
        -0.012349491288219137,
        -0.010688472368098537,
        -0.007066189398343492,
        -0.0029035687522769946,
        0.0018932750014113394,
        0.0060803886665688174,
        0.009633644125885236,
        0.011611029794184314,
    ]),
    Lanes([
        -0.0234806669052868,
        -0.02637058819821336,
        -0.020641163040546716,
        -0.010466005475883142,
        -0.0008034516458374421,
        0.009176163170634796,
        0.016312939608149092,
        0.02116339744481423,
    ]),
    Lanes([
        -0.02189807989452244,
        -0.02911790585193164,
        -0.036385925710800224,
        -0.026473378071891374,
        -0.010940898225368671,
        0.0016153084499480044,
        0.012944554275340362,
        0.018843089153750454,
    ]),
    Lanes([
        -0.010402968757290288,
        -0.017069128544088184,
        -0.030606507844455337,
        -0.04156066146943395,
        -0.02953927785228141,
        -0.012649035058947792,
        -0.0013103585177133953,
        0.006783266514077005,
    ]),
    Lanes([
        0.006783266514077005,
        -0.0013103585177133953,
        -0.012649035058947792,
        -0.02953927785228141,
        -0.04156066146943395,
        -0.030606507844455337,
        -0.017069128544088184,
        -0.010402968757290288,
    ]),
    Lanes([
        0.018843089153750454,
        0.012944554275340362,
        0.0016153084499480044,
        -0.010940898225368671,
        -0.026473378071891374,
        -0.036385925710800224,
        -0.02911790585193164,
        -0.02189807989452244,
    ]),
    Lanes([
        0.02116339744481423,
        0.016312939608149092,
        0.009176163170634796,
        -0.0008034516458374421,
        -0.010466005475883142,
        -0.020641163040546716,
        -0.02637058819821336,
        -0.0234806669052868,
    ]),
    Lanes([
        0.011611029794184314,
        0.009633644125885236,
        0.0060803886665688174,
        0.0018932750014113394,
        -0.0029035687522769946,
        -0.007066189398343492,
        -0.010688472368098537,
        -0.012349491288219137,
    ]),
];
/// `(2k + 1) bⱼ P_k(2cⱼ − 1)`: row k gives the coefficient of `P_k` in the polynomial through the stages.
pub(super) const LEGENDRE: [Stages; 8] = [
    Lanes([
        0.05061426814518813,
        0.11119051722668724,
        0.15685332293894363,
        0.181341891689181,
        0.181341891689181,
        0.15685332293894363,
        0.11119051722668724,
        0.05061426814518813,
    ]),
    Lanes([
        -0.1458131048816116,
        -0.2657452730423523,
        -0.24729451442246178,
        -0.0997931552144693,
        0.0997931552144693,
        0.24729451442246178,
        0.2657452730423523,
        0.1458131048816116,
    ]),
    Lanes([
        0.22352144354258716,
        0.251299583343215,
        -0.06723010203854733,
        -0.4075909248472548,
        -0.4075909248472548,
        -0.06723010203854733,
        0.251299583343215,
        0.22352144354258716,
    ]),
    Lanes([
        -0.2740188228304149,
        -0.053756356443960325,
        0.4671207500358303,
        0.32968848669588297,
        -0.32968848669588297,
        -0.4671207500358303,
        0.053756356443960325,
        0.2740188228304149,
    ]),
    Lanes([
        0.29030541733775395,
        -0.24289619147803757,
        -0.46158532259653046,
        0.41417609673681405,
        0.41417609673681405,
        -0.46158532259653046,
        -0.24289619147803757,
        0.29030541733775395,
    ]),
    Lanes([
        -0.2688293587786539,
        0.49329537666193685,
        -0.053565811005204404,
        -0.5816088634493217,
        0.5816088634493217,
        0.053565811005204404,
        -0.49329537666193685,
        0.2688293587786539,
    ]),
    Lanes([
        0.2098921910670323,
        -0.5591073831433646,
        0.6166048635025358,
        -0.26738967142620357,
        -0.26738967142620357,
        0.6166048635025358,
        -0.5591073831433646,
        0.2098921910670323,
    ]),
    Lanes([
        -0.11769245644771356,
        0.3778969370845921,
        -0.6317745531190048,
        0.7849065579218132,
        -0.7849065579218132,
        0.6317745531190048,
        -0.3778969370845921,
        0.11769245644771356,
    ]),
];

/// Stages in the order of time, mirrored: 1, 2, 3, 4, 8, 7, 6, 5. And back.
pub(super) const fn mirrored(x: Stages) -> Stages {
    let [a, b, c, d, e, f, g, h] = x.0;
    Lanes([a, b, c, d, h, g, f, e])
}

/// ½ (mᵢⱼ ± mᵢⱼ′), j′ = 9 − j, i, j ≤ 4: half the sum of mirrored rows, or half their difference, of a symmetric or antisymmetric matrix.
const fn block(columns: &[Stages; 8], sign: f64) -> [Half; 4] {
    let mut block = [Lanes([0.0; 4]); 4];
    let mut k = 0;
    while k < 16 {
        let (i, j) = (k % 4, k / 4);
        block[j].0[i] = 0.5 * (columns[j].0[i] + sign * columns[7 - j].0[i]);
        k += 1;
    }
    block
}

/// What sums of mirrored accelerations give to the velocities of mirrored stages, opposite to both.
pub(super) const VELOCITY_OF_SUMS: [Half; 4] = block(&VELOCITY, 1.0);
/// What differences give to the velocities, the same to both.
pub(super) const VELOCITY_OF_DIFFERENCES: [Half; 4] = block(&VELOCITY, -1.0);
/// What sums of mirrored accelerations give to the positions of mirrored stages, the same to both: also to the middle of both ends by the
/// mean of both velocities, ¼ b.
pub(super) const POSITION_OF_SUMS: [Half; 4] = {
    let mut block = block(&POSITION, 1.0);
    let mut k = 0;
    while k < 16 {
        block[k / 4].0[k % 4] += 0.25 * WEIGHTS.0[k / 4];
        k += 1;
    }
    block
};
/// What differences give to the positions, opposite to both.
pub(super) const POSITION_OF_DIFFERENCES: [Half; 4] = block(&POSITION, -1.0);

/// The coefficients of Legendre's polynomials of even degree, by even powers.
const EVEN: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [-0.5, 1.5, 0.0, 0.0], [0.375, -3.75, 4.375, 0.0], [-0.3125, 6.5625, -19.6875, 14.4375]];
/// Those of odd degree, by odd powers.
const ODD: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [-1.5, 2.5, 0.0, 0.0], [1.875, -8.75, 7.875, 0.0], [-2.1875, 19.6875, -43.3125, 26.8125]];

/// The powers of a polynomial of the first `degrees` degrees of one parity, by columns: from sums or differences of mirrored stages.
const fn powers(legendre: &[[f64; 4]; 4], parity: usize, degrees: usize) -> [Half; 4] {
    let mut columns = [Lanes([0.0; 4]); 4];
    let mut k = 0;
    while k < 16 * degrees {
        let (power, stage, degree) = (k % 4, k / 4 % 4, k / 16);
        columns[stage].0[power] += legendre[degree][power] * LEGENDRE[2 * degree + parity].0[stage];
        k += 1;
    }
    columns
}

/// The even and the odd powers of the polynomial of degree seven.
pub(super) const POWERS: [[Half; 4]; 2] = [powers(&EVEN, 0, 4), powers(&ODD, 1, 4)];
/// Those of its first three terms.
pub(super) const FIRST_POWERS: [[Half; 4]; 2] = [powers(&EVEN, 0, 2), powers(&ODD, 1, 1)];
/// The row of the last coefficient, for differences.
pub(super) const LAST: Half = {
    let [a, b, c, d, ..] = LEGENDRE[7].0;
    Lanes([a, b, c, d])
};
