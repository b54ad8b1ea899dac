//! Coatings whose stiffness changes with depth, and how they are cut into uniform sublayers. How many sublayers are enough is
//! for the kernels to say, which know what a surface feels of them.

use super::{Coating, ElasticMaterial, Interface, MaterialError};

/// Relative difference of a table's last depth and the thickness that counts as rounding of decimal numbers.
const SAME_DEPTH: f64 = 1e-9;

/// Why a graded coating was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum GradientError {
    /// A modulus, Poisson's ratio or thickness out of range.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A table of fewer than two rows.
    #[error("{0} rows: a table needs at least two, at depth 0 and at the thickness")]
    Rows(usize),
    /// A table that does not start at the surface.
    #[error("first depth {0:?}: must be 0, the coating's surface")]
    FirstDepth(f64),
    /// A table that does not end at the thickness.
    #[error("last depth {found:?}: must be the coating's thickness, {thickness:?}")]
    LastDepth {
        /// The depth found.
        found: f64,
        /// The coating's thickness.
        thickness: f64,
    },
    /// A depth that is not greater than the one before.
    #[error("row {row}: depth {depth:?} is not greater than the one before")]
    Order {
        /// Row, from 0.
        row: usize,
        /// The depth found.
        depth: f64,
    },
}

/// Young's modulus [pressure] over the depth of a coating.
#[derive(Debug, Clone, PartialEq)]
pub enum YoungGradient {
    /// `top (bottom/top)^(z/h)`.
    Exponential {
        /// At the coating's surface.
        top: f64,
        /// At its lower face.
        bottom: f64,
    },
    /// `top + (bottom - top) z/h`.
    Linear {
        /// At the coating's surface.
        top: f64,
        /// At its lower face.
        bottom: f64,
    },
    /// Rows `[depth, modulus]`, depths rising from 0 to the thickness; linear between them.
    Table(Vec<[f64; 2]>),
}

/// A layer of uniform thickness and Poisson's ratio whose Young's modulus changes with depth.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedCoating {
    young: YoungGradient,
    poisson: f64,
    thickness: f64,
    interface: Interface,
}

impl GradedCoating {
    /// Coating from its modulus over the depth, Poisson's ratio and thickness [length].
    ///
    /// # Errors
    /// When a value is out of its range, or a table does not run from depth 0 to the thickness.
    pub fn new(mut young: YoungGradient, poisson: f64, thickness: f64) -> Result<Self, GradientError> {
        let checked = |modulus: f64| ElasticMaterial::new(modulus, poisson);
        Coating::new(checked(1.0)?, thickness)?;
        match &mut young {
            YoungGradient::Exponential { top, bottom } | YoungGradient::Linear { top, bottom } => {
                checked(*top)?;
                checked(*bottom)?;
            }
            YoungGradient::Table(rows) => {
                check_depths(rows, thickness)?;
                for row in rows.iter() {
                    checked(row[1])?;
                }
                if let Some(last) = rows.last_mut() {
                    last[0] = thickness;
                }
            }
        }
        Ok(Self { young, poisson, thickness, interface: Interface::BONDED })
    }

    /// The same coating on another interface.
    #[must_use]
    pub fn on(self, interface: Interface) -> Self {
        Self { interface, ..self }
    }

    /// Thickness [length].
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Poisson's ratio [-].
    pub fn poisson(&self) -> f64 {
        self.poisson
    }

    /// Young's modulus [pressure] at a depth [length] between 0 and the thickness.
    pub fn young_at(&self, depth: f64) -> f64 {
        let share = depth / self.thickness;
        match &self.young {
            YoungGradient::Exponential { top, bottom } => top * libm::pow(bottom / top, share),
            YoungGradient::Linear { top, bottom } => top + (bottom - top) * share,
            YoungGradient::Table(rows) => {
                let below = rows.partition_point(|row| row[0] < depth).clamp(1, rows.len() - 1);
                let [[upper, top], [lower, bottom]] = [rows[below - 1], rows[below]];
                top + (bottom - top) * ((depth - upper) / (lower - upper))
            }
        }
    }

    /// Whether the modulus is the same at every depth.
    pub fn is_uniform(&self) -> bool {
        match &self.young {
            YoungGradient::Exponential { top, bottom } | YoungGradient::Linear { top, bottom } => {
                top == bottom
            }
            YoungGradient::Table(rows) => rows.iter().all(|row| row[1] == rows[0][1]),
        }
    }

    /// The coating as about `count` uniform sublayers, outermost first, each with the modulus at its middle.
    ///
    /// Faces lie at depths `h (i/count)^2`: thin sublayers at the surface, where short waves live, so that the surface's
    /// response errs by order `1/count^2` at every wavenumber; equal sublayers would err by `k h/count^2`. In a table every row
    /// is a face, and what lies between two rows gets its share of sublayers (at least one) by its extent in the square
    /// root of depth and by its change of stiffness. A uniform coating is one layer, whatever the count.
    ///
    /// # Errors
    /// When a sublayer has no thickness that a floating-point number could hold.
    pub fn sublayers(&self, count: usize) -> Result<Vec<Coating>, MaterialError> {
        let ends = if self.is_uniform() { vec![0.0, self.thickness] } else { self.faces(count.max(1)) };
        let mut sublayers: Vec<Coating> = ends
            .windows(2)
            .map(|ends| {
                let young = self.young_at(0.5 * (ends[0] + ends[1]));
                Coating::new(ElasticMaterial::new(young, self.poisson)?, ends[1] - ends[0])
            })
            .collect::<Result<_, _>>()?;
        if let Some((lowest, above)) = sublayers.split_last_mut() {
            *lowest = lowest.on(self.interface);
            for sublayer in above {
                *sublayer = sublayer.continued();
            }
        }
        Ok(sublayers)
    }

    /// Depths of the sublayers' faces, from 0 to the thickness.
    fn faces(&self, count: usize) -> Vec<f64> {
        let rows: &[[f64; 2]] = match &self.young {
            YoungGradient::Exponential { .. } | YoungGradient::Linear { .. } => &[],
            YoungGradient::Table(rows) => rows,
        };
        let mut depths: Vec<f64> = vec![0.0];
        let change = |pair: &[[f64; 2]]| libm::log(pair[1][1] / pair[0][1]).abs();
        let whole_change: f64 = rows.windows(2).map(change).sum();
        let mut fill = |from: f64, to: f64, parts: usize| {
            let (start, end) = ((from / self.thickness).sqrt(), (to / self.thickness).sqrt());
            for part in 1..parts {
                let root = start + (end - start) * part as f64 / parts as f64;
                depths.push(self.thickness * root * root);
            }
            depths.push(to);
        };
        if rows.is_empty() {
            fill(0.0, self.thickness, count);
        }
        for pair in rows.windows(2) {
            let [from, to] = [pair[0][0], pair[1][0]];
            let extent = (to / self.thickness).sqrt() - (from / self.thickness).sqrt();
            let share = 0.5 * (extent + change(pair) / whole_change);
            fill(from, to, (count as f64 * share).ceil() as usize);
        }
        depths
    }
}

/// Whether the depths of a table rise from 0 to the thickness.
fn check_depths(rows: &[[f64; 2]], thickness: f64) -> Result<(), GradientError> {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return Err(GradientError::Rows(0)) };
    if rows.len() < 2 {
        return Err(GradientError::Rows(1));
    }
    if first[0] != 0.0 {
        return Err(GradientError::FirstDepth(first[0]));
    }
    for row in 1..rows.len() {
        let rises = rows[row][0] > rows[row - 1][0];
        if !rises {
            return Err(GradientError::Order { row, depth: rows[row][0] });
        }
    }
    let ends_there = (last[0] - thickness).abs() <= SAME_DEPTH * thickness;
    if ends_there { Ok(()) } else { Err(GradientError::LastDepth { found: last[0], thickness }) }
}

/// A layer as it is described: uniform, or graded and still to be cut.
#[derive(Debug, Clone, PartialEq)]
pub enum Layer {
    /// One material.
    Uniform(Coating),
    /// A modulus that changes with depth.
    Graded {
        /// The coating.
        coating: GradedCoating,
        /// Number of sublayers; `None`: as many as an error bound asks for.
        sublayers: Option<usize>,
    },
}

impl Layer {
    /// Young's modulus, of a graded layer in its middle, over the thickness [pressure/length].
    pub fn stiffness(&self) -> f64 {
        match self {
            Self::Uniform(coating) => coating.material().young() / coating.thickness(),
            Self::Graded { coating, .. } => coating.young_at(0.5 * coating.thickness()) / coating.thickness(),
        }
    }

    /// The same layer on another interface.
    #[must_use]
    pub fn on(self, interface: Interface) -> Self {
        match self {
            Self::Uniform(coating) => Self::Uniform(coating.on(interface)),
            Self::Graded { coating, sublayers } => Self::Graded { coating: coating.on(interface), sublayers },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn graded(young: YoungGradient) -> GradedCoating {
        GradedCoating::new(young, 0.3, 2.0).unwrap()
    }

    #[test]
    fn the_modulus_follows_its_law() {
        let exponential = graded(YoungGradient::Exponential { top: 8.0, bottom: 2.0 });
        assert_eq!([0.0, 1.0, 2.0].map(|z| exponential.young_at(z)), [8.0, 4.0, 2.0]);
        let linear = graded(YoungGradient::Linear { top: 8.0, bottom: 2.0 });
        assert_eq!([0.0, 1.0, 2.0].map(|z| linear.young_at(z)), [8.0, 5.0, 2.0]);
        let table = graded(YoungGradient::Table(vec![[0.0, 1.0], [0.5, 3.0], [2.0, 6.0]]));
        assert_eq!([0.0, 0.25, 0.5, 1.25, 2.0].map(|z| table.young_at(z)), [1.0, 2.0, 3.0, 4.5, 6.0]);
    }

    #[test]
    fn sublayers_fill_the_thickness_with_interfaces_at_every_row() {
        let table = vec![[0.0, 1.0], [0.001, 3.0], [0.3, 3.0], [2.0, 6.0]];
        for young in [
            YoungGradient::Exponential { top: 8.0, bottom: 2.0 },
            YoungGradient::Linear { top: 8.0, bottom: 2.0 },
            YoungGradient::Table(table.clone()),
        ] {
            let is_table = matches!(young, YoungGradient::Table(_));
            for count in [1, 2, 7, 200] {
                let sublayers = graded(young.clone()).sublayers(count).unwrap();
                let mut depth = 0.0;
                let depths: Vec<f64> = sublayers
                    .iter()
                    .map(|sublayer| {
                        depth += sublayer.thickness();
                        depth
                    })
                    .collect();
                assert!((depth - 2.0).abs() < 1e-13); // rounding of 200 additions
                if is_table {
                    assert!(sublayers.len() >= count && sublayers.len() <= count + 3);
                    let met = |row: &[f64; 2]| depths.iter().any(|depth| (depth - row[0]).abs() < 1e-13);
                    assert!(table[1..].iter().all(met));
                } else {
                    assert_eq!(sublayers.len(), count);
                }
            }
        }
    }

    #[test]
    fn a_table_of_two_rows_is_the_linear_law() {
        let linear = graded(YoungGradient::Linear { top: 8.0, bottom: 2.0 });
        let table = graded(YoungGradient::Table(vec![[0.0, 8.0], [2.0, 2.0]]));
        assert_eq!(linear.sublayers(20).unwrap(), table.sublayers(20).unwrap());
    }

    #[test]
    fn a_gradient_between_equal_moduli_is_one_uniform_layer() {
        for young in [
            YoungGradient::Exponential { top: 3.0, bottom: 3.0 },
            YoungGradient::Linear { top: 3.0, bottom: 3.0 },
            YoungGradient::Table(vec![[0.0, 3.0], [1.0, 3.0], [2.0, 3.0]]),
        ] {
            let uniform = Coating::new(ElasticMaterial::new(3.0, 0.3).unwrap(), 2.0).unwrap();
            assert_eq!(graded(young).sublayers(40).unwrap(), vec![uniform]);
        }
    }

    #[test]
    fn what_is_no_coating_is_refused_with_the_reason() {
        let refused = |young, poisson, thickness| GradedCoating::new(young, poisson, thickness).unwrap_err();
        let good = YoungGradient::Linear { top: 1.0, bottom: 2.0 };
        let wrong = YoungGradient::Exponential { top: 1.0, bottom: -2.0 };
        assert_eq!(refused(wrong, 0.3, 1.0), MaterialError::Young(-2.0).into());
        assert_eq!(refused(good.clone(), 0.6, 1.0), MaterialError::Poisson(0.6).into());
        assert_eq!(refused(good, 0.3, 0.0), MaterialError::Thickness(0.0).into());
        let table = |rows: &[[f64; 2]]| refused(YoungGradient::Table(rows.to_vec()), 0.3, 1.0);
        assert_eq!(table(&[]), GradientError::Rows(0));
        assert_eq!(table(&[[0.0, 1.0]]), GradientError::Rows(1));
        assert_eq!(table(&[[0.1, 1.0], [1.0, 2.0]]), GradientError::FirstDepth(0.1));
        assert_eq!(table(&[[0.0, 1.0], [0.9, 2.0]]), GradientError::LastDepth { found: 0.9, thickness: 1.0 });
        let order = GradientError::Order { row: 2, depth: 0.5 };
        assert_eq!(table(&[[0.0, 1.0], [0.5, 2.0], [0.5, 3.0], [1.0, 2.0]]), order);
        assert!(matches!(table(&[[0.0, 1.0], [f64::NAN, 2.0], [1.0, 2.0]]), GradientError::Order { .. }));
        assert_eq!(table(&[[0.0, 1.0], [1.0, f64::INFINITY]]), MaterialError::Young(f64::INFINITY).into());
    }
}
