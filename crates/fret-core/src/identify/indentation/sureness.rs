//! How sure the numbers of an indentation are: linear about the solution, and beside a number that is not told for all values of that which the
//! points allow.
//!
//! Linear intervals mean nothing where a number is at the end of what it may be, or may be many times as large: a film that hardly matters
//! where it is found may matter much where it could be as well. It is held at values farther and farther away, and the others are
//! fitted anew, as long as the points allow it by the likelihood ratio, `n ln(S/S_least) < q^2` with the sum of squares `S`, as many independent
//! points `n` as there are by their correlation, and the quantile `q` of the intervals. Those of the others are the union of what
//! they are on the way, also behind values that the points do not allow.

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::{DMatrix, DVector};

use super::super::found::TOLD;
use super::super::intervals::{Left, Sureness, quantile, sureness};
use super::fit::{FARTHEST, Fit};
use super::indenter::Pressing;

/// Numbers whose derivatives are parallel to this part differ by what the grid does to them: they act as one.
const PARALLEL: f64 = 0.03;
/// First step of the logarithm of a number that is not told away from where it is; each next one is twice as long.
const FIRST_STEP: f64 = 0.5;
/// Steps between the last value that the points allow and the first that they do not.
const BISECTIONS: usize = 4;
/// Step of the logarithm behind the first value that the points do not allow.
const BEHIND: f64 = 1.0;
/// Steps that are shorter lead nowhere.
const CLOSE: f64 = 1e-6;

/// Where parameters may lie: so far below and above where they are.
pub struct Sides {
    pub of: Vec<[f64; 2]>,
    /// Numbers beside which the others were fitted anew.
    pub beside: Vec<usize>,
    /// How many histories that took.
    pub histories: usize,
}

impl Sides {
    /// Those of linear theory.
    pub fn linear(sure: &Sureness) -> Self {
        Self { of: sure.halves.iter().map(|half| [*half; 2]).collect(), beside: Vec::new(), histories: 0 }
    }

    /// Whether a parameter is bounded closely enough.
    pub fn tell(&self, place: usize) -> bool {
        self.of[place].iter().all(|side| *side < TOLD)
    }

    /// Takes an interval of a parameter in.
    fn take_in(&mut self, place: usize, [low, high]: [f64; 2]) {
        let [below, above] = self.of[place];
        self.of[place] = [below.max(-low), above.max(high)];
    }
}

impl<P: Pressing> Fit<'_, P> {
    /// How sure the parameters are; a frame that is held at zero counts as one that is fitted, but where all that are held are `given`.
    pub fn sureness(&self, given: bool) -> Option<Sureness> {
        let residuals = self.residuals()?;
        let jacobian =
            self.derivatives(|place| !self.held[place] || (!given && self.place_of_frame() == Some(place)))?;
        let of_force: Vec<f64> =
            self.feet.iter().map(|foot| (foot.weight * self.noises[1]).powi(2)).collect();
        let nothing = DVector::zeros(residuals.len());
        let mut sure = sureness(&Left {
            jacobian: &jacobian,
            residuals: &residuals,
            of_force: &of_force,
            bend: (nothing, 0.0),
        })?;
        for k in self.acting_as_one(&jacobian) {
            sure.halves[k] = f64::INFINITY;
        }
        Some(sure)
    }

    /// Numbers of the case whose derivatives are those of others but for what the grid does: modulus and radius of a sphere act by
    /// `E sqrt(R)`. A thin residual of a clean log would otherwise tell them by the error of the grid.
    fn acting_as_one(&self, jacobian: &DMatrix<f64>) -> Vec<usize> {
        let mut columns = jacobian.columns(0, self.start.len()).into_owned();
        for mut column in columns.column_iter_mut() {
            let size = column.norm();
            if size > 0.0 {
                column /= size;
            }
        }
        if columns.ncols() < 2 {
            return Vec::new();
        }
        let decomposition = columns.svd(false, true);
        let Some(directions) = decomposition.v_t else { return Vec::new() };
        let values = &decomposition.singular_values;
        let has_part = |k: &usize| {
            (0..values.len()).any(|row| values[row] < PARALLEL && directions[(row, *k)].abs() > 0.1)
        };
        (0..self.start.len()).filter(has_part).collect()
    }
}

impl<P: Pressing> Fit<'_, P> {
    /// Where the parameters may lie: linear theory bounds them as it is given, and the residuals of neighbours have such a correlation.
    pub fn sides(&self, name: &str, mut found: Sides, correlation: f64) -> Sides {
        let is_told = |place: usize| found.tell(place) && !self.is_bound(place);
        let (told, untold): (Vec<usize>, Vec<usize>) =
            (0..self.parameters.len()).partition(|place| is_told(*place));
        let untold: Vec<usize> = untold.into_iter().filter(|place| *place < self.start.len()).collect();
        if told.is_empty() {
            return found;
        }
        for place in untold {
            for direction in [-1.0, 1.0] {
                self.walk(name, (place, direction), (&told, correlation), &mut found);
            }
            found.beside.push(place);
        }
        found
    }

    /// Holds a number at values farther and farther away, as long as the points allow it, and takes in what the others are there.
    fn walk(
        &self,
        name: &str,
        (place, direction): (usize, f64),
        (told, correlation): (&[usize], f64),
        found: &mut Sides,
    ) {
        let count = self.loads.len() as f64 * (1.0 - correlation) / (1.0 + correlation);
        let most = quantile(count - self.parameters.len() as f64);
        let squares =
            |fit: &Self| fit.residuals().map_or(f64::INFINITY, |residuals| residuals.norm_squared());
        // The least sum of squares may lie on the way.
        let mut least = squares(self);
        let away = |fit: &Self, least: f64| (count * (squares(fit) / least).ln()).max(0.0).sqrt();
        let (mut near, mut far) = (self.clone(), None);
        let mut step = FIRST_STEP;
        let mut bisections = None;
        // Behind values that the points do not allow there may be others that they do: a film that is so stiff that it carries as a plate.
        let mut behind = Vec::new();
        while bisections != Some(BISECTIONS) {
            let from = near.parameters[place];
            let to = (from + direction * step).clamp(-FARTHEST, FARTHEST);
            if (to - from).abs() < CLOSE {
                break;
            }
            let begun = near.histories;
            let there = near.clone().held_at(name, place, to).ok();
            found.histories += there.as_ref().map_or(1, |there| there.histories - begun);
            let there = there.and_then(|there| Some((there.sureness(true)?.halves, there)));
            least = there.as_ref().map_or(least, |(_, there)| least.min(squares(there)));
            match there {
                Some((halves, there)) if away(&there, least) <= most => {
                    for &other in told {
                        let moved = there.parameters[other] - self.parameters[other];
                        found.take_in(other, [moved - halves[other], moved + halves[other]]);
                    }
                    if told.iter().all(|other| !found.tell(*other)) {
                        return;
                    }
                    near = there;
                    if bisections.is_none() {
                        step *= 2.0;
                    }
                }
                there => {
                    far = there;
                    if bisections.is_none() {
                        bisections = Some(0);
                        let most = (2.0 * FARTHEST / BEHIND) as usize;
                        let steps = (1..=most).map(|k| to + direction * BEHIND * k as f64);
                        behind = steps.filter(|at| at.abs() <= FARTHEST).collect();
                    }
                }
            }
            if let Some(bisections) = &mut bisections {
                *bisections += 1;
                step *= 0.5;
            }
        }
        if let Some((halves, far)) = far {
            // Up to where the likelihood ratio is the limit: its root grows with the distance.
            let [before, after] = [&near, &far].map(|fit| away(fit, least));
            let part = ((most - before) / (after - before)).clamp(0.0, 1.0);
            for &other in told {
                let between = (1.0 - part) * near.parameters[other] + part * far.parameters[other];
                let moved = between - self.parameters[other];
                found.take_in(other, [moved - halves[other], moved + halves[other]]);
            }
        }
        for to in behind {
            let begun = near.histories;
            let Ok(there) = near.clone().held_at(name, place, to) else { continue };
            found.histories += there.histories - begun;
            least = least.min(squares(&there));
            let Some(sure) = there.sureness(true) else { continue };
            if away(&there, least) <= most {
                for &other in told {
                    let moved = there.parameters[other] - self.parameters[other];
                    found.take_in(other, [moved - sure.halves[other], moved + sure.halves[other]]);
                }
            }
            near = there;
        }
    }
}
