//! Fatigue parameters over the last cycle, on the section nearest to y = 0 and, for Ruiz, along its surface.

use std::fmt::Write as _;

use fret_core::case::FatigueRequest;
use fret_core::model::{Base, ElasticMaterial, HalfSpace};
use fret_core::subsurface::fatigue::{
    SurfacePoint, crossland, dang_van, fatemi_socie, line_mean, ruiz, smith_watson_topper,
};
use fret_core::subsurface::rim::at_rims;
use fret_core::subsurface::{DepthPoint, LoadedSurface, StressField, StressTensor};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::figures::figure;

/// Collects the stresses of a cycle, one depth at a time.
pub struct Fatigue<'a> {
    request: FatigueRequest,
    half_space: &'a HalfSpace,
    points: &'a [DepthPoint],
    surfaces: &'a [LoadedSurface],
    /// Indices of the surfaces of the cycle.
    cycle: Vec<usize>,
    row: usize,
    /// Stresses of the depth at hand, `[i][increment of the cycle]`.
    here: Vec<Vec<StressTensor>>,
    /// Names and values `[point][i]` of the parameters.
    fields: Vec<(&'static str, Vec<Vec<f64>>)>,
    /// The largest value at a rim of the surface, of each parameter, and its place along x [cells].
    at_rims: Vec<Option<(f64, f64)>>,
    /// Ruiz's parameters along the surface.
    ruiz: Option<Vec<[f64; 2]>>,
}

/// Fatigue parameters on a section along x.
#[derive(Debug, Clone)]
pub struct Section {
    /// Names and values `[point][i]`; a depth in a rigid base has none.
    pub fields: Vec<(&'static str, Vec<Vec<f64>>)>,
    /// Ruiz's F1 and F2 along the surface, where it was among the depths and its slip is known.
    pub ruiz: Option<Vec<[f64; 2]>>,
}

/// A name and its values `[point][i]`.
pub type Picture = (String, Vec<Vec<f64>>);

/// What is told at the end.
pub struct Finished {
    /// For `stress.json`.
    pub record: Value,
    /// For a person.
    pub table: String,
    /// To be drawn.
    pub pictures: Vec<Picture>,
}

impl<'a> Fatigue<'a> {
    /// Nothing collected yet.
    pub fn new(
        request: FatigueRequest,
        half_space: &'a HalfSpace,
        points: &'a [DepthPoint],
        surfaces: &'a [LoadedSurface],
        cycle: Vec<usize>,
        row: usize,
    ) -> Self {
        let mut names = vec!["smith_watson_topper"];
        if request.yield_strength.is_some() {
            names.push("fatemi_socie");
        }
        if request.endurance.is_some() {
            names.extend(["crossland", "dang_van"]);
        }
        let at_rims = vec![None; names.len()];
        let fields = names.into_iter().map(|name| (name, Vec::new())).collect();
        Self {
            request,
            half_space,
            points,
            surfaces,
            cycle,
            row,
            here: Vec::new(),
            fields,
            at_rims,
            ruiz: None,
        }
    }

    /// Takes the stress at one depth in one increment.
    pub fn look(&mut self, point: usize, surface: usize, field: &StressField) {
        let (Some(&first), Some(&last)) = (self.cycle.first(), self.cycle.last()) else { return };
        if !self.cycle.contains(&surface) {
            return;
        }
        let nx = field.components[0].nrows();
        if surface == first {
            self.here = vec![Vec::with_capacity(self.cycle.len()); nx];
        }
        for (i, stresses) in self.here.iter_mut().enumerate() {
            stresses.push(field.at(i, self.row));
        }
        if surface == last {
            self.judge(point);
        }
    }

    fn material(&self, layer: usize) -> Option<ElasticMaterial> {
        let coating = self.half_space.coatings().get(layer).map(|coating| *coating.material());
        coating.or(match self.half_space.base() {
            Base::Elastic(material) => Some(*material),
            Base::Rigid => None,
        })
    }

    fn judge(&mut self, point: usize) {
        let place = self.points[point];
        let Some(material) = self.material(place.layer) else { return };
        let request = self.request;
        for (name, values) in &mut self.fields {
            let value = |cycle: &Vec<StressTensor>| match (*name, request.endurance, request.yield_strength) {
                ("crossland", Some(endurance), _) => crossland(cycle, &endurance),
                ("dang_van", Some(endurance), _) => dang_van(cycle, &endurance),
                ("fatemi_socie", _, Some(strength)) => {
                    fatemi_socie(cycle, &material, strength, request.normal_stress_sensitivity).value
                }
                _ => smith_watson_topper(cycle, &material).value,
            };
            values.push(self.here.par_iter().map(value).collect());
        }
        if place.depth == 0.0 {
            self.ruiz = self.along_surface();
            self.at_rims = self.rims();
        }
    }

    /// The parameters of the surface at the rims that the contact has in the cycle.
    fn rims(&self) -> Vec<Option<(f64, f64)>> {
        let largest = |values: &[f64]| {
            let of = |surface: &usize| {
                let pressure = self.surfaces[*surface].pressure.column(self.row).to_vec();
                at_rims(values, &pressure)
            };
            let all = self.cycle.iter().flat_map(of).map(|rim| (rim.value, rim.cell as f64 + rim.off));
            all.reduce(|most, next| if next.0 > most.0 { next } else { most })
        };
        self.fields.iter().map(|(_, values)| values.last().and_then(|values| largest(values))).collect()
    }

    fn along_surface(&self) -> Option<Vec<[f64; 2]>> {
        let (here, row) = (&self.here, self.row);
        (0..here.len())
            .map(|i| {
                let history: Option<Vec<SurfacePoint>> = self
                    .cycle
                    .iter()
                    .enumerate()
                    .map(|(n, &surface)| {
                        let surface = &self.surfaces[surface];
                        let (shear, slip) = (surface.shear.as_ref()?, surface.slip.as_ref()?);
                        Some(SurfacePoint {
                            shear: [shear[0][[i, row]], shear[1][[i, row]]],
                            slip: [slip[0][[i, row]], slip[1][[i, row]]],
                            stress: here[i][n],
                        })
                    })
                    .collect();
                let found = ruiz(&history?);
                Some([found.f1, found.f2])
            })
            .collect()
    }

    /// All values.
    pub fn section(self) -> Section {
        Section { fields: self.fields, ruiz: self.ruiz }
    }

    /// The largest values, and the means over the critical distance.
    pub fn finished(self, x: &[f64], _interfaces: &[f64]) -> Finished {
        let increments: Vec<usize> = self.cycle.iter().map(|&n| self.surfaces[n].increment).collect();
        let depths: Vec<f64> = self.points.iter().map(|point| point.depth).collect();
        let mut parameters = serde_json::Map::new();
        let mut table = format!(
            "  fatigue over increments {} to {}, section nearest to y = 0\n",
            increments.first().copied().unwrap_or(0),
            increments.last().copied().unwrap_or(0)
        );
        let from_surface = depths.first() == Some(&0.0) && depths.windows(2).all(|pair| pair[0] <= pair[1]);
        for ((name, values), rim) in self.fields.iter().zip(&self.at_rims) {
            let Some((point, i)) = largest_of(values) else { continue };
            let (mut value, mut at, mut point) = (values[point][i], x[i], point);
            if let Some((most, place)) = *rim
                && most > value
                && let Some(surface) = depths.iter().position(|depth| *depth == 0.0)
            {
                let cell = x.get(1).map_or(0.0, |next| next - x[0]);
                (value, at, point) = (most, x[0] + place * cell, surface);
            }
            let mut entry = json!({ "largest": value, "x": at, "depth": depths[point], "layer": self.points[point].layer });
            let _ = write!(
                table,
                "  {:<20} {:<12} at x {:<12} depth {:<12}",
                name.replace('_', " "),
                figure(value),
                figure(at),
                figure(depths[point])
            );
            if let (Some(distance), true) = (self.request.critical_distance, from_surface) {
                let means: Vec<f64> = (0..x.len())
                    .map(|i| {
                        let line: Vec<f64> = values.iter().map(|row| row[i]).collect();
                        line_mean(&depths, &line, distance)
                    })
                    .collect();
                let most = (0..x.len()).max_by(|&a, &b| means[a].total_cmp(&means[b])).unwrap_or(0);
                entry["largest_mean"] = json!({ "value": means[most], "x": x[most], "distance": distance });
                let _ = write!(table, " mean {} at x {}", figure(means[most]), figure(x[most]));
            }
            table.truncate(table.trim_end().len());
            table.push('\n');
            parameters.insert((*name).to_owned(), entry);
        }
        if let Some(ruiz) = &self.ruiz {
            for (part, name) in ["ruiz_f1", "ruiz_f2"].into_iter().enumerate() {
                let most =
                    (0..ruiz.len()).max_by(|&a, &b| ruiz[a][part].total_cmp(&ruiz[b][part])).unwrap_or(0);
                let value = ruiz[most][part];
                parameters.insert(name.to_owned(), json!({ "largest": value, "x": x[most], "depth": 0.0 }));
                let _ = writeln!(
                    table,
                    "  {:<20} {:<12} at x {:<12} surface",
                    name.replace('_', " "),
                    figure(value),
                    figure(x[most])
                );
            }
        }
        let pictures = self
            .fields
            .iter()
            .filter(|(_, values)| values.len() == depths.len())
            .map(|(name, values)| ((*name).to_owned(), values.clone()))
            .collect();
        let record = json!({ "increments": increments, "parameters": parameters });
        Finished { record, table, pictures }
    }
}

fn largest_of(values: &[Vec<f64>]) -> Option<(usize, usize)> {
    let mut best: Option<(usize, usize)> = None;
    for (point, row) in values.iter().enumerate() {
        for (i, &value) in row.iter().enumerate() {
            if best.is_none_or(|(p, c)| value > values[p][c]) {
                best = Some((point, i));
            }
        }
    }
    best
}
