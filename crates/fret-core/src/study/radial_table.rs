//! The pressure of a rounded punch over the radius, in a table: one value of it is an integral, and cell means ask for it at many places.

/// Parts of either side of the rim of the flat.
const PARTS: usize = 240;

/// Pressure between the axis, the rim of the flat at `flat` and the edge of contact at `edge`, by cubics through its values.
///
/// Inside of the rim `p sqrt(a^2 - r^2)` is interpolated, outside of it `p / sqrt(a^2 - r^2)`, in the fourth root of the distance from the
/// rim, where the slope of the pressure is infinite.
#[derive(Debug, Clone)]
pub struct RadialTable {
    flat: f64,
    edge: f64,
    inside: Vec<f64>,
    outside: Vec<f64>,
}

impl RadialTable {
    /// A table of a pressure, which is asked for at 481 radii, whatever the number of cells.
    pub fn new(flat: f64, edge: f64, mut pressure: impl FnMut(f64) -> f64) -> Self {
        let part = |number: usize| (number as f64 / PARTS as f64).powi(4);
        let root = |r: f64| ((edge - r) * (edge + r)).sqrt();
        let inside = (0..=PARTS).map(|number| {
            let r = flat * (1.0 - part(number));
            pressure(r) * root(r)
        });
        let inside = inside.collect();
        let mut outside: Vec<f64> = (0..PARTS)
            .map(|number| {
                let r = flat + (edge - flat) * part(number);
                pressure(r) / root(r)
            })
            .collect();
        let [.., a, b, c, d] = outside[..] else { unreachable!("more than four parts") };
        outside.push(4.0 * (d + b) - 6.0 * c - a); // at the edge both vanish: on the cubic through the last four
        Self { flat, edge, inside, outside }
    }

    /// Pressure at a distance from the axis [pressure]; zero outside of the contact.
    pub fn at(&self, r: f64) -> f64 {
        if r >= self.edge {
            return 0.0;
        }
        let root = ((self.edge - r) * (self.edge + r)).sqrt();
        if r < self.flat {
            cubic(&self.inside, ((self.flat - r) / self.flat).sqrt().sqrt()) / root
        } else {
            cubic(&self.outside, ((r - self.flat) / (self.edge - self.flat)).sqrt().sqrt()) * root
        }
    }
}

/// The cubic through the four values around a place between 0 and 1.
fn cubic(values: &[f64], place: f64) -> f64 {
    let place = place * PARTS as f64;
    let first = (place as usize).saturating_sub(1).min(PARTS - 3);
    let t = place - first as f64;
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| values[first + k]);
    let [s, u, v] = [t - 1.0, t - 2.0, t - 3.0];
    -a * s * u * v / 6.0 + b * t * u * v / 2.0 - c * t * s * v / 2.0 + d * t * s * u / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analytic::RoundedPunch;

    /// Against the integral itself, with edges from sharp to round and contacts from hardly beyond the flat to far beyond it; relative to
    /// the pressure there, but for the last thousandth before the edge.
    #[test]
    fn the_table_is_the_integral() {
        for (flat, edge_radius, force) in
            [(0.9, 1.0, 1e-3), (0.9, 0.1, 1e-3), (0.9, 0.01, 1e-3), (0.01, 5.0, 1.0), (1.0, 1.0, 1e-6)]
        {
            let punch = RoundedPunch::new(flat, edge_radius, force, 1.1).unwrap();
            let a = punch.contact_radius;
            let mut asked = 0;
            let table = RadialTable::new(flat, a, |r| {
                asked += 1;
                punch.pressure(r)
            });
            assert_eq!(asked, 2 * PARTS + 1);
            let mut worst = 0.0_f64;
            for number in 0..400 {
                let place = (f64::from(number) + 0.37) / 400.0;
                for r in [
                    a * place * 0.999,
                    flat * (1.0 - place.powi(6)),
                    flat + (a - flat) * place.powi(6) * 0.999,
                ] {
                    worst = worst.max((table.at(r) / punch.pressure(r) - 1.0).abs());
                }
            }
            println!("{flat} {edge_radius} {force}: a {a}, {worst:e}");
            // what a study tells of the mean square is no better than 1e-5
            assert!(worst < 1e-5, "{flat} {edge_radius} {force}: {worst:e}");
            assert_eq!(table.at(a), 0.0);
        }
    }
}
