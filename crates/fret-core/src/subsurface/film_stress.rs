//! Mean stress over the thickness of the outermost coating, and the energy that its cracks would release.

use ndarray::Array2;
use rayon::prelude::*;
use serde::Serialize;

use super::coating_fracture::{Film, Released};
use super::depths::DepthPoint;
use super::fatigue::FatigueConstants;
use super::tensor::StressField;

/// Collects the stress in the plane of the film from the surface down, under all cells in all increments.
pub struct FilmStress {
    film: Film,
    /// Integrals over the depth of xx, yy, xy, one triple an increment.
    integrals: Vec<[Array2<f64>; 3]>,
    /// The depth before, and the stresses there.
    last: Vec<(f64, [Array2<f64>; 3])>,
}

/// The most severe stress of the film, and the energy it releases.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FilmCrack {
    /// Mean stress over the thickness across the crack [pressure], tension positive.
    pub stress: f64,
    /// Angle of the direction of this stress to the x axis [degrees]; a crack runs across it.
    pub direction: f64,
    /// Index of the surface.
    pub surface: usize,
    /// Cell `[i, j]`.
    pub cell: [usize; 2],
    /// Energy released.
    pub released: Released,
}

impl FilmStress {
    /// Nothing collected yet.
    pub fn new(film: Film) -> Self {
        Self { film, integrals: Vec::new(), last: Vec::new() }
    }

    /// Takes the stress at one depth in one increment; depths from 0 on, not falling.
    pub fn look(&mut self, point: DepthPoint, surface: usize, field: &StressField) {
        if !self.film.holds(point.layer) {
            return;
        }
        let [xx, yy, _, xy, ..] = &field.components;
        let here = [xx, yy, xy];
        let Some((depth, above)) = self.last.get_mut(surface) else {
            if point.depth == 0.0 && self.last.len() == surface {
                self.integrals.push(here.map(|part| Array2::zeros(part.dim())));
                self.last.push((0.0, here.map(Array2::clone)));
            }
            return;
        };
        let half = 0.5 * (point.depth - *depth);
        self.integrals[surface].par_iter_mut().zip(above).zip(here).for_each(|((integral, above), here)| {
            ndarray::Zip::from(integral).and(above).and(here).for_each(|sum, above, &here| {
                *sum += half * (*above + here);
                *above = here;
            });
        });
        *depth = point.depth;
    }

    /// The largest tension and the largest compression of the film; none where the depths do not go from the surface to its lower face.
    pub fn most_severe(&self, constants: &FatigueConstants) -> Vec<FilmCrack> {
        let thickness = self.film.thickness();
        let whole = |(depth, _): &(f64, [Array2<f64>; 3])| (depth - thickness).abs() <= 1e-9 * thickness;
        if self.last.is_empty() || !self.last.iter().all(whole) {
            return Vec::new();
        }
        let mut found: [Option<FilmCrack>; 2] = [None; 2];
        for (surface, [xx, yy, xy]) in self.integrals.iter().enumerate() {
            for ((i, j), &xx) in xx.indexed_iter() {
                let [xx, yy, xy] = [xx, yy[[i, j]], xy[[i, j]]].map(|integral| integral / thickness);
                let (mean, radius) = (f64::midpoint(xx, yy), (0.5 * (xx - yy)).hypot(xy));
                let along = (0.5 * (2.0 * xy).atan2(xx - yy)).to_degrees();
                for (slot, stress, direction) in [(0, mean + radius, along), (1, mean - radius, along + 90.0)]
                {
                    let sign = if slot == 0 { 1.0 } else { -1.0 };
                    let is_more = found[slot].is_none_or(|known| sign * stress > sign * known.stress);
                    if is_more && sign * stress > 0.0 {
                        let released = self.film.released(
                            stress,
                            constants.channelling_factor,
                            constants.interface_phase,
                        );
                        found[slot] = Some(FilmCrack { stress, direction, surface, cell: [i, j], released });
                    }
                }
            }
        }
        found.into_iter().flatten().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Base, Coating, ElasticMaterial, HalfSpace};

    /// A stress that falls linearly over the film has its middle value as mean; shear alone is tension and compression at 45 degrees.
    #[test]
    fn the_mean_over_the_thickness_by_hand() {
        let material = ElasticMaterial::new(100.0, 0.25).unwrap();
        let body =
            HalfSpace::new(vec![Coating::new(material, 2.0).unwrap()], Base::Elastic(material)).unwrap();
        let mut film = FilmStress::new(Film::outermost(&body).unwrap());
        for (depth, layer) in [(0.0, 0), (0.5, 0), (2.0, 0), (2.0, 1)] {
            let mut field = StressField::zeros([2, 1]);
            field.components[0][[0, 0]] = 8.0 - depth;
            field.components[3][[1, 0]] = 5.0;
            film.look(DepthPoint { depth, layer }, 0, &field);
        }
        let found = film.most_severe(&FatigueConstants::default());
        assert_eq!(found.len(), 2);
        assert!(
            (found[0].stress - 7.0).abs() < 1e-14 && found[0].cell == [0, 0] && found[0].direction == 0.0
        );
        assert!((found[1].stress + 5.0).abs() < 1e-14 && found[1].cell == [1, 0]);
        assert!((found[1].direction - 135.0).abs() < 1e-12 && found[1].released.channelling == Some(0.0));
    }

    /// The mean goes over all layers of a film: one that is cut at a third of its thickness gives the numbers of the whole one, and of
    /// stress that jumps from sublayer to sublayer each counts by its thickness.
    #[test]
    fn the_mean_goes_over_all_layers_of_the_film() {
        let [film, base] = [200.0, 100.0].map(|young| ElasticMaterial::new(young, 0.25).unwrap());
        let found = |layers: Vec<Coating>, stresses: &[(f64, usize, f64)]| {
            let body = HalfSpace::new(layers, Base::Elastic(base)).unwrap();
            let mut collected = FilmStress::new(Film::outermost(&body).unwrap());
            for &(depth, layer, stress) in stresses {
                let mut field = StressField::zeros([1, 1]);
                field.components[0][[0, 0]] = stress;
                collected.look(DepthPoint { depth, layer }, 0, &field);
            }
            collected.most_severe(&FatigueConstants::default())
        };
        let layer = |thickness: f64| Coating::new(film, thickness).unwrap();
        let whole = found(vec![layer(3.0)], &[(0.0, 0, 8.0), (1.0, 0, 6.0), (3.0, 0, 2.0), (3.0, 1, 9.0)]);
        let stresses = [(0.0, 0, 8.0), (1.0, 0, 6.0), (1.0, 1, 6.0), (3.0, 1, 2.0), (3.0, 2, 9.0)];
        assert_eq!(found(vec![layer(1.0), layer(2.0)], &stresses), whole);
        assert!((whole[0].stress - 5.0).abs() < 1e-14 && whole.len() == 1);
        let stiffer = Coating::new(ElasticMaterial::new(400.0, 0.25).unwrap(), 1.0).unwrap();
        let jumps = [(0.0, 0, 8.0), (1.0, 0, 8.0), (1.0, 1, 2.0), (3.0, 1, 2.0), (3.0, 2, 9.0)];
        let graded = found(vec![stiffer.continued(), layer(2.0)], &jumps);
        assert!((graded[0].stress - 4.0).abs() < 1e-14, "{graded:?}");
    }
}
