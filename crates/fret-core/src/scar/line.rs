//! Heights along a line, as a profilometer writes them.

use crate::measured::{self, Kind, MeasuredError, Role, refused, scales};
use crate::model::Dimension;
use crate::units::Units;

/// Position along the line, and height there.
static ROLES: [Role; 2] = [
    Role {
        name: "position",
        known: &["position", "x", "x_position", "distance", "lateral", "length", "weg", "strecke"],
        is_needed: true,
        kind: Kind::Length,
        example: "x",
    },
    Role {
        name: "height",
        known: &[
            "height",
            "z",
            "y",
            "profile",
            "depth",
            "worn_depth",
            "wear_depth",
            "hoehe",
            "höhe",
            "tiefe",
        ],
        is_needed: true,
        kind: Kind::Length,
        example: "z",
    },
];

/// Points of a line, at the least.
const FEWEST_POINTS: usize = 12;

pub use crate::measured::Asked;

/// Points along a line, by rising position.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Positions [length].
    pub x: Vec<f64>,
    /// Heights or depths there [length].
    pub z: Vec<f64>,
}

/// A line as it was measured, in the units of the case.
#[derive(Debug, Clone)]
pub struct Measured {
    /// Its name.
    pub name: String,
    /// Position and height, as the instrument counts them.
    pub line: Line,
    /// The unit that the heights were taken in, where one is known.
    pub unit: Option<String>,
    /// What was taken for granted while it was read.
    pub notes: Vec<String>,
}

/// Reads a line of heights.
///
/// # Errors
/// When its columns are not known, a row has no numbers, or there are too few.
pub fn read(
    (name, bytes): (&str, &[u8]),
    asked: &Asked,
    units: Option<&Units>,
) -> Result<Measured, MeasuredError> {
    let table = measured::read((name, bytes), (&ROLES, "line of heights"), asked, true)?;
    let mut notes = Vec::new();
    let scale = scales(&table, (&ROLES, asked), (units, Dimension::Plane), &mut notes)?;
    let named = asked.unit_of(ROLES[1].name).map(str::to_owned);
    let named = named.or_else(|| table.columns.get(1)?.as_ref()?.unit.clone());
    let unit = named.or_else(|| units.map(|units| units.length.clone()));
    if table.lines.len() < FEWEST_POINTS {
        let what = format!("{} points: a scar needs at least {FEWEST_POINTS}", table.lines.len());
        return Err(refused(name, &what, "some hundred points serve well"));
    }
    let mut points: Vec<[f64; 2]> =
        table.of(0).iter().zip(table.of(1)).map(|(x, z)| [x * scale[0], z * scale[1]]).collect();
    points.sort_by(|one, other| one[0].total_cmp(&other[0]));
    if let Some(pair) = points.windows(2).find(|pair| pair[0][0] == pair[1][0]) {
        let what = format!("two heights at the position {:?}", pair[0][0] / scale[0]);
        return Err(refused(name, &what, "one line at a time: each position once"));
    }
    let (x, z) = points.into_iter().map(|[x, z]| (x, z)).unzip();
    Ok(Measured { name: name.to_owned(), line: Line { x, z }, unit, notes })
}

impl Line {
    /// Mean of the heights over a cell of `width` around a position, between which they run straight; `None` where the line does not reach.
    pub(super) fn mean_over(&self, position: f64, width: f64) -> Option<f64> {
        let [from, to] = [position - 0.5 * width, position + 0.5 * width];
        if from < *self.x.first()? || to > *self.x.last()? {
            return None;
        }
        let inner = self.x.partition_point(|x| *x <= from)..self.x.partition_point(|x| *x < to);
        let points = std::iter::once([from, self.at(from)])
            .chain(inner.map(|place| [self.x[place], self.z[place]]))
            .chain([[to, self.at(to)]]);
        let points: Vec<[f64; 2]> = points.collect();
        let area: f64 =
            points.windows(2).map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0])).sum();
        Some(area / width)
    }

    /// Means of the heights over a width around each point, or over as much of it as the line reaches on both sides.
    pub(super) fn means(&self, width: f64) -> Self {
        let [first, last] = [self.x[0], self.x[self.x.len() - 1]];
        let mean = |(x, z): (&f64, &f64)| {
            let within = width.min(2.0 * (x - first)).min(2.0 * (last - x)) * (1.0 - f64::EPSILON);
            if within > 0.0 { self.mean_over(*x, within).unwrap_or(*z) } else { *z }
        };
        Self { x: self.x.clone(), z: self.x.iter().zip(&self.z).map(mean).collect() }
    }

    /// Length of the part that is farther than a height from 0, by what of it counts in the mean of the square [length].
    pub(super) fn length_beyond(&self, height: f64) -> f64 {
        let reach = |k: usize| 0.5 * (self.x[(k + 1).min(self.x.len() - 1)] - self.x[k.saturating_sub(1)]);
        let beyond = || self.z.iter().enumerate().filter(|(_, z)| z.abs() > height);
        let sum: f64 = beyond().map(|(k, z)| z.abs() * reach(k)).sum();
        let squares: f64 = beyond().map(|(k, z)| z * z * reach(k)).sum();
        if squares > 0.0 { sum * sum / squares } else { 0.0 }
    }

    /// Height at a position on the line, straight between its points.
    fn at(&self, position: f64) -> f64 {
        let next = self.x.partition_point(|x| *x < position).clamp(1, self.x.len() - 1);
        let share = (position - self.x[next - 1]) / (self.x[next] - self.x[next - 1]);
        self.z[next - 1] + share * (self.z[next] - self.z[next - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(head: &str, row: impl Fn(usize) -> String) -> String {
        (0..20).fold(head.to_owned(), |text, k| text + &row(k) + "\n")
    }

    #[test]
    fn lines_of_profilometers_are_read_in_the_units_of_the_case() {
        let mm = Units::new("mm", "N");
        for (head, comma) in [
            ("x [um];z [nm]\n", true),
            ("# probe 3\nX (um)\tZ (nm)\n", false),
            ("x_um;z_nm\n", true),
            ("X_(microns)\tHeight [nm]\n", false),
            ("Distance_µm;wear_depth_nm\n", true),
        ] {
            let row = |k: usize| {
                // from the right to the left, as some stages move
                let (x, z) = (19.5 - k as f64, 100.0 + k as f64);
                if comma { format!("{x};{z}").replace('.', ",") } else { format!("{x}\t{z}") }
            };
            let found = read(("line.csv", text(head, row).as_bytes()), &Asked::default(), Some(&mm)).unwrap();
            assert!((found.line.x[0] - 0.5e-3).abs() < 1e-18 && (found.line.z[0] - 119e-6).abs() < 1e-18);
            assert_eq!(found.line.x.len(), 20);
        }
    }

    #[test]
    fn what_is_no_line_is_refused() {
        let refusal =
            |text: &str| read(("l.csv", text.as_bytes()), &Asked::default(), None).unwrap_err().what;
        assert!(refusal("x,z\n1,2\n2,3\n").contains("2 points"));
        assert!(
            refusal(&text("x,z\n", |k| format!("{},1", k / 2))).contains("two heights at the position 0.0")
        );
        assert!(
            refusal(&text("x,z\n", |k| if k == 3 { "3,NaN".into() } else { format!("{k},1") }))
                .contains("line 5")
        );
        assert!(refusal(&text("time,force\n", |k| format!("{k},1"))).contains("\"position\" and \"height\""));
    }

    #[test]
    fn means_over_cells_are_those_of_straight_pieces() {
        let line = Line { x: vec![0.0, 1.0, 3.0], z: vec![0.0, 2.0, 0.0] };
        assert_eq!(line.mean_over(0.5, 1.0), Some(1.0));
        assert_eq!(line.mean_over(1.5, 3.0), Some(1.0));
        // half of each piece: 1.75 and 1.5 in the mean over a half, and a whole
        assert!((line.mean_over(1.25, 1.5).unwrap() - (0.5 * 1.5 + 1.0 * 1.5) / 1.5).abs() < 1e-15);
        assert_eq!(line.mean_over(0.2, 1.0), None);
        assert_eq!(line.mean_over(2.9, 1.0), None);
    }

    /// A parabola over 2 a: means over a width w are lower by w^2/12 in units of its curvature; half of it counts by (4/3)^2/(16/15) a = 5/3 a.
    #[test]
    fn means_and_lengths_of_a_parabola_are_those_of_its_integrals() {
        let x: Vec<f64> = (0..=4000).map(|k| -2.0 + 1e-3 * f64::from(k)).collect();
        let z = x.iter().map(|x| (1.0 - x * x).max(0.0)).collect();
        let line = Line { x, z };
        let means = line.means(0.3);
        // of second order in the spacing of the points
        assert!((means.z[2000] - (1.0 - 0.3 * 0.3 / 12.0)).abs() < 1e-6);
        assert!((means.z[1500] - (0.75 - 0.3 * 0.3 / 12.0)).abs() < 1e-6);
        assert_eq!((means.z[0], means.z[4000]), (0.0, 0.0));
        assert!((line.length_beyond(0.0) - 5.0 / 3.0).abs() < 1e-5);
    }
}
