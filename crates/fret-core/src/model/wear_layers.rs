//! Wear through the layers of both bodies: who loses how much, in which layer, and the bodies that are left.
//!
//! Both bodies receive the same work by area `w` (dissipated energy, or pressure times slip); each loses the coefficient of the layer at its
//! surface times it, until that layer is gone and the next one is at the surface. The depth of each is a piecewise linear function of `w`,
//! and so is their sum: what each has lost follows from the sum alone.

use serde::{Deserialize, Deserializer, Serialize};

use super::half_space::{Body, Coating, ContactPair, HalfSpace, MaterialError};

/// A layer that wears.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WornLayer {
    /// Thickness [length]; infinite at the bottom.
    #[serde(deserialize_with = "thickness")]
    pub thickness: f64,
    /// Depth for work by area [1/pressure].
    pub coefficient: f64,
}

/// JSON has no infinity: there it is `null`.
fn thickness<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    if deserializer.is_human_readable() {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    } else {
        f64::deserialize(deserializer)
    }
}

/// Layers of both bodies from their surfaces down; none of a body that does not wear.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WearLayers {
    lower: Vec<WornLayer>,
    upper: Vec<WornLayer>,
}

/// What has worn off in a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worn {
    /// Work by area [pressure x length].
    pub work: f64,
    /// Depth off the lower and the upper body [length].
    pub depths: [f64; 2],
}

impl Worn {
    /// Depth off both bodies together [length].
    pub fn depth(&self) -> f64 {
        self.depths[0] + self.depths[1]
    }
}

/// How the depth off both bodies together changes at a depth.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthSlopes {
    /// By the work [1/pressure]: the coefficients at the surfaces.
    pub by_work: f64,
    /// At the same work by coefficient [pressure x length] and thickness [-] of each layer, first those of the lower body.
    pub by_layers: Vec<[f64; 2]>,
}

/// Depths are rounded: so near to its end a layer is gone.
const ROUNDING: f64 = 1e-12;

/// How far surfaces wear.
#[derive(Debug, Clone, Copy)]
enum Until {
    Work(f64),
    Depth(f64),
    /// Depth of one body (0: lower, 1: upper).
    DepthOf(usize, f64),
}

impl WearLayers {
    /// Layers of the lower and the upper body, each from the surface down; the last one of a body goes on for ever.
    pub fn new([lower, upper]: [Vec<WornLayer>; 2]) -> Self {
        Self { lower, upper }
    }

    /// Layers of the lower and the upper body.
    pub fn bodies(&self) -> [&[WornLayer]; 2] {
        [&self.lower, &self.upper]
    }

    /// Those of one body (0: lower, 1: upper); the other one does not wear.
    #[must_use]
    pub fn of_body(&self, body: usize) -> Self {
        let mut layers = [Vec::new(), Vec::new()];
        layers[body] = self.bodies()[body].to_vec();
        Self::new(layers)
    }

    /// The largest sum of coefficients that can be at the surfaces [1/pressure].
    pub fn largest_rate(&self) -> f64 {
        let largest = |layers: &[WornLayer]| layers.iter().map(|layer| layer.coefficient).fold(0.0, f64::max);
        self.bodies().into_iter().map(largest).sum()
    }

    /// What is worn where the gap has opened by `depth` [length].
    pub fn at_depth(&self, depth: f64) -> Worn {
        self.worn(Until::Depth(depth))
    }

    /// What is worn after work by area [pressure x length].
    pub fn after(&self, work: f64) -> Worn {
        self.worn(Until::Work(work))
    }

    /// What is worn when a body (0: lower, 1: upper) has lost a depth [length]; `None` when it never does.
    pub fn when_body_has_lost(&self, body: usize, depth: f64) -> Option<Worn> {
        let worn = self.worn(Until::DepthOf(body, depth));
        worn.work.is_finite().then_some(worn)
    }

    /// Depth off both bodies together [length] when a body (0: lower, 1: upper) has lost a depth [length]; where both have one coefficient, and
    /// no layers, all of it is taken for that body's. `None` when it never does.
    pub fn depth_when_lost(layers: Option<&Self>, body: usize, depth: f64) -> Option<f64> {
        match layers {
            None => Some(depth),
            Some(layers) => layers.when_body_has_lost(body, depth).map(|worn| worn.depth()),
        }
    }

    /// Depths [length] lost by each layer of the lower and the upper body, where these have lost `depths`.
    pub fn by_layer(&self, depths: [f64; 2]) -> [Vec<f64>; 2] {
        let [lower, upper] = self.bodies();
        let of = |layers: &[WornLayer], depth: f64| {
            let mut left = depth;
            let mut lost = Vec::with_capacity(layers.len());
            for layer in layers {
                let here = left.min(layer.thickness);
                lost.push(here);
                left -= here;
            }
            lost
        };
        [of(lower, depths[0]), of(upper, depths[1])]
    }

    /// How the depth off both bodies together changes where it is `depth` [length].
    ///
    /// In layer `l` of a body, of coefficient `k` and thickness `h`, that has lost `d` of it: by the coefficient of this layer `d / k`, and by the
    /// numbers of a layer `i` above it `k h_i / k_i^2` and `1 - k / k_i`, since less of the work is left when that is gone.
    pub fn slopes_at(&self, depth: f64) -> DepthSlopes {
        let depths = self.at_depth(depth).depths;
        let mut found = DepthSlopes { by_work: 0.0, by_layers: Vec::new() };
        for (layers, depth) in self.bodies().into_iter().zip(depths) {
            let mut left = depth;
            let gone = |layer: &&WornLayer| {
                let is_gone = left >= layer.thickness * (1.0 - ROUNDING);
                if is_gone {
                    left -= layer.thickness;
                }
                is_gone
            };
            let above = layers.iter().take_while(gone).count();
            let Some(here) = layers.get(above) else { continue };
            found.by_work += here.coefficient;
            found.by_layers.extend(layers[..above].iter().map(|layer| {
                let ratio = here.coefficient / layer.coefficient;
                [ratio * layer.thickness / layer.coefficient, 1.0 - ratio]
            }));
            let by_own = if here.coefficient > 0.0 { left.max(0.0) / here.coefficient } else { 0.0 };
            found.by_layers.push([by_own, 0.0]);
            found.by_layers.extend(layers[above + 1..].iter().map(|_| [0.0; 2]));
        }
        found
    }

    fn worn(&self, until: Until) -> Worn {
        let bodies = self.bodies();
        let mut worn = Worn { work: 0.0, depths: [0.0; 2] };
        let mut layer = [0; 2];
        // Depths at which the layers at the surfaces end.
        let mut ends = [0, 1].map(|body| bodies[body].first().map_or(f64::INFINITY, |layer| layer.thickness));
        loop {
            let rates = [0, 1]
                .map(|body| bodies[body].get(layer[body]).map_or(0.0, |layer: &WornLayer| layer.coefficient));
            let rate = rates[0] + rates[1];
            let to_end = [0, 1].map(|body| {
                if rates[body] > 0.0 { (ends[body] - worn.depths[body]) / rates[body] } else { f64::INFINITY }
            });
            let next = to_end[0].min(to_end[1]);
            let needed = match until {
                Until::Work(work) => work - worn.work,
                Until::Depth(depth) if rate > 0.0 => (depth - worn.depth()) / rate,
                Until::DepthOf(body, depth) if rates[body] > 0.0 => (depth - worn.depths[body]) / rates[body],
                // Nothing wears any more: no work leads there, but where it is there already.
                Until::Depth(_) => 0.0,
                Until::DepthOf(..) => f64::INFINITY,
            };
            if needed <= next {
                for body in 0..2 {
                    if rates[body] > 0.0 {
                        worn.depths[body] += rates[body] * needed;
                    }
                }
                worn.work += needed;
                return worn;
            }
            for body in 0..2 {
                if to_end[body] <= next {
                    // Exactly there, whatever the products round to.
                    worn.depths[body] = ends[body];
                    layer[body] += 1;
                    ends[body] +=
                        bodies[body].get(layer[body]).map_or(f64::INFINITY, |layer| layer.thickness);
                } else {
                    worn.depths[body] += rates[body] * next;
                }
            }
            worn.work += next;
        }
    }
}

/// The bodies that are left of a pair when the lower and the upper one have lost `depths` [length] all over: without the layers that are
/// gone, the next one thinner.
///
/// # Errors
/// When nothing elastic is left.
pub fn thinned(pair: &ContactPair, depths: [f64; 2]) -> Result<ContactPair, MaterialError> {
    ContactPair::new(thinned_body(pair.upper(), depths[1])?, thinned_body(pair.lower(), depths[0])?)
}

fn thinned_body(body: &Body, depth: f64) -> Result<Body, MaterialError> {
    let Body::Elastic(half_space) = body else { return Ok(Body::Rigid) };
    let mut gone = 0.0;
    let mut coatings = Vec::with_capacity(half_space.coatings().len());
    for coating in half_space.coatings() {
        let above = (depth - gone).clamp(0.0, coating.thickness());
        gone += coating.thickness();
        if above == 0.0 {
            coatings.push(*coating);
        } else if above < coating.thickness() && Coating::can_be(coating.thickness() - above) {
            coatings.push(coating.of_thickness(coating.thickness() - above)?);
        }
    }
    HalfSpace::new(coatings, *half_space.base()).map(Body::Elastic)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Base, ElasticMaterial};

    fn layers(lower: &[(f64, f64)], upper: &[(f64, f64)]) -> WearLayers {
        let of = |list: &[(f64, f64)]| {
            list.iter().map(|&(thickness, coefficient)| WornLayer { thickness, coefficient }).collect()
        };
        WearLayers::new([of(lower), of(upper)])
    }

    const ENDLESS: f64 = f64::INFINITY;

    /// Lower: 2 of coefficient 0.5, then 1 of 0.1, then 0.25; upper: 3 of 1, then 2. By hand: the upper film is gone at w = 3, the lower
    /// one at 4, its second layer at 14.
    #[test]
    fn depths_are_piecewise_linear_in_the_work() {
        let stack = layers(&[(2.0, 0.5), (1.0, 0.1), (ENDLESS, 0.25)], &[(3.0, 1.0), (ENDLESS, 2.0)]);
        for (work, lower, upper) in [
            (0.0, 0.0, 0.0),
            (1.0, 0.5, 1.0),
            (3.0, 1.5, 3.0),
            (3.5, 1.75, 4.0),
            (4.0, 2.0, 5.0),
            (9.0, 2.5, 15.0),
            (14.0, 3.0, 25.0),
            (18.0, 4.0, 33.0),
        ] {
            for worn in [stack.after(work), stack.at_depth(lower + upper)] {
                let found = [worn.work, worn.depths[0], worn.depths[1]];
                // Rounding of a few operations.
                for (found, expected) in found.into_iter().zip([work, lower, upper]) {
                    assert!((found - expected).abs() <= 1e-14 * work, "{work}: {worn:?}");
                }
            }
        }
        assert_eq!(stack.largest_rate(), 2.5);
        let [lower, upper] = stack.by_layer([4.0, 33.0]);
        assert_eq!((lower, upper), (vec![2.0, 1.0, 1.0], vec![3.0, 30.0]));
        assert!((stack.when_body_has_lost(0, 2.5).unwrap().work - 9.0).abs() < 1e-14);
    }

    /// Against differences of the depth by the work and by each number, away from where a layer ends; a film that wears through, what lies
    /// below it, and the other body. 1e-8: differences in steps of 1e-6 of coefficients from 0.1 on leave 1e-10 of some 30, and rounding
    /// as much.
    #[test]
    fn depths_change_by_every_number_of_the_layers() {
        let numbers = [[[2.0, 0.5], [1.0, 0.1], [ENDLESS, 0.25]], [[3.0, 1.0], [4.0, 0.5], [ENDLESS, 2.0]]];
        let stack = |numbers: [[[f64; 2]; 3]; 2]| {
            let [lower, upper] = numbers.map(|body| body.map(|[thickness, k]| (thickness, k)));
            layers(&lower, &upper)
        };
        for work in [1.0, 3.5, 9.0, 18.0] {
            let depth = |numbers, work: f64| stack(numbers).after(work).depth();
            let found = stack(numbers).slopes_at(depth(numbers, work));
            let by_work = (depth(numbers, work + 1e-6) - depth(numbers, work - 1e-6)) / 2e-6;
            assert!((found.by_work - by_work).abs() < 1e-8, "{work}: {found:?}");
            for (layer, which) in (0..6).flat_map(|layer| [(layer, 0), (layer, 1)]) {
                let moved = |by: f64| {
                    let mut moved = numbers;
                    moved[layer / 3][layer % 3][1 - which] += by;
                    depth(moved, work)
                };
                let expected = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                let by = found.by_layers[layer][which];
                assert!((by - expected).abs() < 1e-8, "{work}, {layer} {which}: {by} {expected}");
            }
        }
        // On a layer that does not wear the depth is that of what lies above it, whatever the work.
        let stops = layers(&[(1.5, 1.0), (1.0, 0.0), (ENDLESS, 5.0)], &[]);
        let at_rest = stops.slopes_at(stops.after(10.0).depth());
        assert_eq!((at_rest.by_work, &at_rest.by_layers[..]), (0.0, &[[0.0, 1.0], [0.0; 2], [0.0; 2]][..]));
    }

    /// A layer that does not wear stops the wear of its body, and of both when the other does not wear either.
    #[test]
    fn a_layer_that_does_not_wear_stays() {
        let stack = layers(&[(1.0, 1.0), (1.0, 0.0), (ENDLESS, 5.0)], &[]);
        let worn = stack.after(10.0);
        assert_eq!((worn.depths, worn.work), ([1.0, 0.0], 10.0));
        assert_eq!(stack.at_depth(1.0).depths, [1.0, 0.0]);
        assert_eq!(stack.when_body_has_lost(0, 1.5), None);
        assert_eq!(stack.when_body_has_lost(1, 0.1), None);
        assert!(stack.when_body_has_lost(0, 1.0).is_some());
    }

    /// What is left is what a case of the thinner coating says, to the bit; through a layer the next one is thinner; at the end the
    /// substrate alone.
    #[test]
    fn a_worn_body_is_that_of_a_thinner_coating() {
        let [soft, hard, steel] = [1.0, 3.0, 2.0].map(|young| ElasticMaterial::new(young, 0.3).unwrap());
        let coating = |material, thickness| Coating::new(material, thickness).unwrap();
        let lower =
            |coatings: Vec<Coating>| Body::Elastic(HalfSpace::new(coatings, Base::Elastic(steel)).unwrap());
        let pair = |coatings| ContactPair::new(Body::Rigid, lower(coatings)).unwrap();
        let whole = pair(vec![coating(soft, 1.0), coating(hard, 0.5)]);
        let left = |depth: f64| thinned(&whole, [depth, 7.0]).unwrap();
        assert_eq!(left(0.0), whole);
        assert_eq!(left(0.25), pair(vec![coating(soft, 0.75), coating(hard, 0.5)]));
        assert_eq!(left(1.0), pair(vec![coating(hard, 0.5)]));
        assert_eq!(left(1.25), pair(vec![coating(hard, 0.25)]));
        assert_eq!(left(1.5), pair(Vec::new()));
        assert_eq!(left(9.0), pair(Vec::new()));
        let film = HalfSpace::new(vec![coating(soft, 1.0)], Base::Rigid).unwrap();
        let film = ContactPair::new(Body::Rigid, Body::Elastic(film)).unwrap();
        assert!(thinned(&film, [0.5, 0.0]).is_ok() && thinned(&film, [1.0, 0.0]).is_err());
    }
}
