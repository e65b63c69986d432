//! The coefficients of one to four stages.
//!
//! The couplings are stored so that μᵢⱼ + μⱼᵢ = 1 exactly: 1 − x is exact for x between ½ and 2.
//!
//! Source: the zeros of the Legendre polynomials, P(2c − 1) = 0, and integrals of the Lagrange polynomials on
//! them; Hairer, Lubich & Wanner, *Geometric Numerical Integration*, II.1.3.

/// The coefficients for S stages.
pub(super) struct Tableau<const S: usize> {
    /// c
    pub(super) nodes: [f64; S],
    /// b
    pub(super) weights: [f64; S],
    /// μ
    pub(super) couplings: [[f64; S]; S],
    /// Lᵢ of the next step from the Lⱼ of this one, by continuing the collocation polynomial.
    pub(super) extrapolation: [[f64; S]; S],
}

pub(super) const STAGES_1: Tableau<1> =
    Tableau { nodes: [0.5], weights: [1.0], couplings: [[0.5]], extrapolation: [[1.0]] };
pub(super) const STAGES_2: Tableau<2> = Tableau {
    nodes: [0.2113248654051871, 0.7886751345948129],
    weights: [0.5, 0.5],
    couplings: [[0.5, 1.0 - 1.0773502691896257], [1.0773502691896257, 0.5]],
    extrapolation: [[-0.7320508075688773, 1.7320508075688772], [-1.7320508075688772, 2.732050807568877]],
};
pub(super) const STAGES_3: Tableau<3> = Tableau {
    nodes: [0.11270166537925831, 0.5, 0.8872983346207417],
    weights: [0.2777777777777778, 0.4444444444444444, 0.2777777777777778],
    couplings: [
        [0.5, 1.0 - 1.0809475019311126, 1.0 - 0.96475800154489],
        [1.0809475019311126, 0.5, 1.0 - 1.0809475019311126],
        [0.96475800154489, 1.0809475019311126, 0.5],
    ],
    extrapolation: [
        [0.46034998712591646, -0.9391805448271526, 2.0423388845975277],
        [3.2677422153560443, -5.666666666666667, 7.398924451310623],
        [4.624327782069139, -7.39415278850618, 8.20631667954075],
    ],
};
pub(super) const STAGES_4: Tableau<4> = Tableau {
    nodes: [0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263],
    weights: [0.17392742256872692, 0.32607257743127305, 0.32607257743127305, 0.17392742256872692],
    couplings: [
        [0.5, 1.0 - 1.08158975003228, 1.0 - 0.9612740734321142, 1.0 - 1.0204404206840407],
        [1.08158975003228, 0.5, 1.0 - 1.0855037514105192, 1.0 - 0.9612740734321142],
        [0.9612740734321142, 1.0855037514105192, 0.5, 1.0 - 1.08158975003228],
        [1.0204404206840407, 0.9612740734321142, 1.08158975003228, 0.5],
    ],
    extrapolation: [
        [-0.3043475322896335, 0.5560939709183108, -1.0294085679737872, 2.191699902136537],
        [-3.667677403095109, 6.246427614654768, -9.46401244076669, 11.574646496723345],
        [-13.783927085129498, 22.244205449220566, -29.80681363156252, 29.836782226170214],
        [-14.971892910590412, 23.52091860319091, -29.864571097947245, 27.864733549197386],
    ],
};
