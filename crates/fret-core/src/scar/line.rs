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
    Ok(Measured { name: name.to_owned(), line: Line { x, z }, notes })
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
        for (head, comma) in [("x [um];z [nm]\n", true), ("# probe 3\nX (um)\tZ (nm)\n", false)] {
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
}
