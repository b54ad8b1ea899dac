//! The two bodies together. The place where the sign of the upper body's coupling is decided.

use super::complex::Wavenumber;
use super::frequency_response::{FrequencyResponse, Response, ResponseTimesK};
use super::stack_layer::LayerChanges;
use crate::fields::{Dual, Scalar};
use crate::model::{Body, Conductor, ContactPair};

/// Composite frequency response of a pair: displacements of the lower surface minus those of the upper one, as the contact
/// sees them.
///
/// Self terms (`zz`, `rr`, `tt`) of the two bodies add. The coupling `rz` is the lower body's minus the upper's: shear acts on
/// the upper body in the opposite sense and its depth points the other way. Two bodies of one elasticity do not couple.
#[derive(Clone, Debug)]
pub struct PairResponse<C = f64> {
    lower: Option<FrequencyResponse<C>>,
    upper: Option<FrequencyResponse<C>>,
}

impl PairResponse {
    /// Prepares the response of a pair.
    pub fn new(pair: &ContactPair) -> Self {
        let prepare = |body: &Body| match body {
            Body::Rigid => None,
            Body::Elastic(half_space) => Some(FrequencyResponse::new(half_space)),
        };
        Self { lower: prepare(pair.lower()), upper: prepare(pair.upper()) }
    }

    /// The same response with every layer in its place, also those that do not differ from what lies below them; a body without
    /// any gets one of its own material and `thickness` [length]. Nothing is taken from constancy or equality.
    pub fn all_layers(pair: &ContactPair, thickness: f64) -> Self {
        let prepare = |body: &Body| match body {
            Body::Rigid => None,
            Body::Elastic(half_space) => Some(FrequencyResponse::all_layers(half_space, thickness)),
        };
        Self { lower: prepare(pair.lower()), upper: prepare(pair.upper()) }
    }

    /// Potentials of both surfaces by a flux out of one into the other, see [`FrequencyResponse::conduction`]; a body that is absent adds
    /// nothing.
    pub fn conduction(conductors: [Option<&Conductor>; 2]) -> Self {
        let [lower, upper] = conductors.map(|conductor| conductor.map(FrequencyResponse::conduction));
        Self { lower, upper }
    }

    /// `C(k)` at a wavenumber `k > 0` [rad/length]: [length/pressure].
    pub fn at(&self, k: f64) -> Response {
        self.times_k(k).over(k)
    }

    /// `k C(k)` [1/pressure].
    pub fn times_k(&self, k: f64) -> Response {
        let ResponseTimesK { zz, rr, rz, tt } = self.times_wavenumber(k);
        Response { zz, rr, rz, tt }
    }

    /// The response of a pair with the derivatives of the constants of the layers of its lower and of its upper body by a parameter; see
    /// [`FrequencyResponse::with_changes`].
    pub(crate) fn with_changes(pair: &ContactPair, changes: [&[LayerChanges]; 2]) -> PairResponse<Dual> {
        let prepare = |body: &Body, changes: &[LayerChanges]| match body {
            Body::Rigid => None,
            Body::Elastic(half_space) => Some(FrequencyResponse::with_changes(half_space, changes)),
        };
        PairResponse { lower: prepare(pair.lower(), changes[0]), upper: prepare(pair.upper(), changes[1]) }
    }

    /// The response times k where it does not depend on k: two homogeneous bodies, or one and a rigid one.
    pub(crate) fn constant(&self) -> Option<Response> {
        self.is_homogeneous().then(|| self.times_k(1.0))
    }

    /// Whether pressure causes no tangential displacement and shear no normal one: `rz = 0` at every wavenumber, as for two
    /// bodies of one elasticity, or incompressible half-spaces.
    ///
    /// Judged on wavenumbers from far below the longest length of the bodies to far above the shortest one, eight per e-fold:
    /// `max |k rz| <= 1e-14 max(k sqrt(rr zz))`, what is left by rounding.
    pub fn is_uncoupled(&self) -> bool {
        self.vanishes(|response| (response.rz, (response.rr * response.zz).sqrt()))
    }

    /// Whether shear causes no displacement across it: `rr = tt` at every wavenumber, as for bodies without lateral contraction
    /// (Poisson's ratio 0). Judged as [`PairResponse::is_uncoupled`] is.
    pub fn is_straight(&self) -> bool {
        self.vanishes(|response| (response.rr - response.tt, response.rr.max(response.tt)))
    }

    /// Whether the first of two parts of the response is but rounding of the second at every wavenumber.
    fn vanishes(&self, parts: impl Fn(Response) -> (f64, f64)) -> bool {
        let longest = self.longest_length();
        let shortest = self.bodies().filter_map(FrequencyResponse::shortest_length).fold(longest, f64::min);
        let (first, last) = if longest > 0.0 { (1e-6 / longest, 1e2 / shortest) } else { (1.0, 1.0) };
        let steps = (8.0 * libm::log(last / first)).ceil() as u32;
        let mut part = 0.0_f64;
        let mut whole = 0.0_f64;
        for step in 0..=steps {
            let found = parts(self.times_k(first * libm::exp(f64::from(step) / 8.0)));
            part = part.max(found.0.abs());
            whole = whole.max(found.1);
        }
        part <= 1e-14 * whole
    }
}

impl<C: Scalar> PairResponse<C> {
    /// `k C(k)` at a real or complex wavenumber.
    pub(crate) fn times_wavenumber<T: Wavenumber<Constant = C>>(&self, k: T) -> ResponseTimesK<T> {
        let mut sum = ResponseTimesK { zz: T::zero(), rr: T::zero(), rz: T::zero(), tt: T::zero() };
        for (body, coupling) in [(&self.lower, 1.0), (&self.upper, -1.0)] {
            let Some(body) = body else { continue };
            let body = body.times_wavenumber(k);
            sum = ResponseTimesK {
                zz: sum.zz + body.zz,
                rr: sum.rr + body.rr,
                rz: sum.rz + body.rz * coupling,
                tt: sum.tt + body.tt,
            };
        }
        sum
    }

    fn bodies(&self) -> impl Iterator<Item = &FrequencyResponse<C>> {
        self.lower.iter().chain(&self.upper)
    }

    /// Whether the response times k does not depend on k.
    pub(crate) fn is_homogeneous(&self) -> bool {
        self.bodies().all(FrequencyResponse::is_homogeneous)
    }

    /// The longest length in either body, see [`FrequencyResponse::longest_length`].
    pub(crate) fn longest_length(&self) -> f64 {
        self.bodies().map(FrequencyResponse::longest_length).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::super::quadrature::GaussRule;
    use super::super::radial::RadialKernels;
    use super::super::samples::{Random, material, stack};
    use super::*;
    use crate::model::{ConductingLayer, HalfSpace};
    use pulp::Scalar;

    fn two(upper: &HalfSpace, lower: &HalfSpace) -> PairResponse {
        let pair = ContactPair::new(Body::Elastic(upper.clone()), Body::Elastic(lower.clone())).unwrap();
        PairResponse::new(&pair)
    }

    #[test]
    fn self_terms_add_and_coupling_subtracts() {
        let upper = stack(&[(3.0, 0.2, 0.5)], Some((1.0, 0.4)));
        let lower = stack(&[], Some((2.0, 0.1)));
        let (one, other) = (FrequencyResponse::new(&lower).at(0.7), FrequencyResponse::new(&upper).at(0.7));
        let found = two(&upper, &lower).at(0.7);
        assert!((found.zz - (one.zz + other.zz)).abs() < 1e-15 * found.zz);
        assert!((found.rr - (one.rr + other.rr)).abs() < 1e-15 * found.rr);
        assert!((found.tt - (one.tt + other.tt)).abs() < 1e-15 * found.tt);
        assert!((found.rz - (one.rz - other.rz)).abs() < 1e-15 * one.rz);
        let turned = two(&lower, &upper).at(0.7);
        assert_eq!(turned.rz, -found.rz);
        assert_eq!(turned.zz, found.zz);
    }

    #[test]
    fn bodies_of_one_elasticity_do_not_couple() {
        let mut random = Random::seeded(5);
        for _ in 0..20 {
            let body = random.half_space(4, 1e3, false);
            assert!(two(&body, &body).is_uncoupled());
        }
        // Dundurs: (1 - 2 nu)/G is what counts
        let one = HalfSpace::homogeneous(material((1.0, 0.3)));
        let young = 0.2 / 0.4 * 1.4 / 1.3; // G doubled by the ratio of 1 - 2 nu: (0.2/0.4) (1.3 -> 1.4)
        let other = HalfSpace::homogeneous(material((young, 0.4)));
        assert!(two(&one, &other).is_uncoupled());
        assert!(!two(&one, &HalfSpace::homogeneous(material((young, 0.3)))).is_uncoupled());
    }

    #[test]
    fn incompressible_half_spaces_do_not_couple_but_incompressible_coatings_do() {
        let incompressible = HalfSpace::homogeneous(material((1.0, 0.5)));
        let pair = ContactPair::new(Body::Rigid, Body::Elastic(incompressible)).unwrap();
        assert!(PairResponse::new(&pair).is_uncoupled());
        let coated = stack(&[(2.0, 0.5, 1.0)], Some((1.0, 0.5)));
        let pair = ContactPair::new(Body::Rigid, Body::Elastic(coated)).unwrap();
        assert!(!PairResponse::new(&pair).is_uncoupled());
    }

    #[test]
    fn a_difference_deep_down_is_noticed() {
        let lower = stack(&[(1.0, 0.3, 1.0)], Some((2.0, 0.3)));
        let upper = stack(&[(1.0, 0.3, 1.0)], Some((2.0, 0.31)));
        assert!(!two(&upper, &lower).is_uncoupled());
    }

    /// Lengths and moduli over many decades: what couples is found, and bodies of one elasticity do not; half-spaces without lateral
    /// contraction move along the shear.
    #[test]
    fn bodies_couple_or_not_in_every_unit() {
        for length in [1e-9, 1.0, 1e9] {
            for modulus in [1e-16, 1.0, 1e16] {
                let body = |poisson: f64, base: f64| {
                    stack(&[(modulus, poisson, length)], Some((2.0 * modulus, base)))
                };
                assert!(two(&body(0.3, 0.3), &body(0.3, 0.3)).is_uncoupled());
                assert!(!two(&body(0.3, 0.31), &body(0.3, 0.3)).is_uncoupled(), "{length:e} {modulus:e}");
                // Where layers differ lateral contraction is not all that turns shear.
                assert!(!two(&body(0.0, 0.0), &body(0.0, 0.0)).is_straight(), "{length:e} {modulus:e}");
                let plain = |poisson: f64| {
                    let body = HalfSpace::homogeneous(material((modulus, poisson)));
                    PairResponse::new(&ContactPair::new(Body::Rigid, Body::Elastic(body)).unwrap())
                };
                assert!(!plain(0.3).is_uncoupled() && plain(0.5).is_uncoupled());
                assert!(!plain(0.3).is_straight() && plain(0.0).is_straight());
            }
        }
    }

    /// What only waves near a film's own thickness feel is looked for there; what rounding leaves is not found in any unit.
    #[test]
    fn a_film_that_only_short_waves_feel_couples() {
        for length in [1e-6, 1.0, 1e6] {
            let body = |nu: f64| stack(&[(1.0, nu, 1e-12 * length), (2.0, 0.3, length)], Some((1.0, 0.3)));
            assert!(!two(&body(0.2), &body(0.3)).is_uncoupled(), "{length:e}");
            assert!(two(&body(0.2), &body(0.2)).is_uncoupled(), "{length:e}");
        }
        for modulus in [1e-16, 1.0, 1e16] {
            // as above: G doubled by the ratio of 1 - 2 nu
            let of = |young: f64, nu: f64| HalfSpace::homogeneous(material((young * modulus, nu)));
            let [one, other] = [of(1.0, 0.3), of(0.2 / 0.4 * 1.4 / 1.3, 0.4)];
            assert!(two(&one, &other).is_uncoupled(), "{modulus:e}");
        }
    }

    /// Temperature times k1/(q a) at the centre of a heated disc of radius 1 on a layer, by images at the depths 2 n h: of a uniform flux,
    /// and of `sqrt(1 - r^2)`.
    fn by_images(ratio: f64, thickness: f64) -> [f64; 2] {
        let lambda = (ratio - 1.0) / (ratio + 1.0);
        let of = |z: f64| {
            [
                (1.0 + z * z).sqrt() - z,
                0.5 * ((1.0 + z * z) * (0.5 * std::f64::consts::PI - libm::atan(z)) - z),
            ]
        };
        let mut sum = of(0.0);
        for n in 1..=400 {
            let image = of(2.0 * f64::from(n) * thickness);
            let strength = 2.0 * libm::pow(lambda, f64::from(n));
            sum = [0, 1].map(|flux| sum[flux] + strength * image[flux]);
        }
        sum
    }

    #[test]
    fn conduction_through_a_layer_is_its_image_series() {
        for (ratio, thickness) in
            [(0.1, 0.1), (0.1, 1.0), (0.5, 0.5), (2.0, 0.1), (2.0, 1.0), (10.0, 0.5), (10.0, 1.0)]
        {
            let layer = ConductingLayer { thickness, conductivity: ratio };
            let body = Conductor::new(vec![layer], 1.0).unwrap();
            let response = PairResponse::conduction([Some(&body), None]);
            let [disc, hertz] = by_images(ratio, thickness);
            let whole = RadialKernels::of_surface(&response, 1.0, 2.0).innermost()[0][0] * ratio;
            assert!((whole / disc - 1.0).abs() < 1e-12, "{ratio}, {thickness}: {whole} {disc}"); // rounding of 400 images
            // the flux over a small disc around the middle is one but for 5e-9 of 1e-4; beyond by Gauss points in the angle of sin = r
            let least = 1e-4_f64;
            let kernels = RadialKernels::of_surface(&response, least, 2.0);
            let from = libm::asin(least);
            let half = 0.5 * (std::f64::consts::FRAC_PI_2 - from);
            let beyond: f64 = GaussRule::new(40)
                .points
                .iter()
                .map(|(point, weight)| {
                    let angle = from + half * (1.0 + point);
                    let (r, flux) = (libm::sin(angle), libm::cos(angle));
                    weight
                        * half
                        * flux
                        * flux
                        * std::f64::consts::TAU
                        * r
                        * kernels.at_square::<Scalar>(r * r)[0][0]
                })
                .sum();
            let found = ratio * (kernels.innermost()[0][0] + beyond);
            assert!((found / hertz - 1.0).abs() < 1e-11, "{ratio}, {thickness}: {found} {hertz}");
        }
    }

    #[test]
    fn the_response_of_a_layer_that_conducts_is_the_closed_form() {
        let (k1, k2, h) = (0.3, 4.0, 0.7);
        let body = Conductor::new(vec![ConductingLayer { thickness: h, conductivity: k1 }], k2).unwrap();
        let lambda = (k1 - k2) / (k1 + k2);
        for k in [1e-6, 0.1, 1.0, 7.0, 300.0] {
            let e = lambda * libm::exp(-2.0 * k * h);
            let exact = (1.0 + e) / (k1 * k * (1.0 - e));
            let found = PairResponse::conduction([Some(&body), None]).at(k);
            assert!((found.zz / exact - 1.0).abs() < 1e-14 && found.rz == 0.0, "{k}");
        }
        // layers of one conductivity are none
        let layer = ConductingLayer { thickness: h, conductivity: k2 };
        let same = Conductor::new(vec![layer, layer], k2).unwrap();
        assert!(PairResponse::conduction([Some(&same), None]).constant().is_some());
    }
}
