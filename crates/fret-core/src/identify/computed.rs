//! The loop that the solver computes, between its points.
//!
//! A contact that slides does so from a corner on, which lies between two points. Before it the force lacks `L - Q` of the friction force
//! `L`, in proportion to a power 3/2 of the contact's own displacement to the corner (Mindlin: the one is as `c^3`, the other as `c^2`,
//! where the radius `c` sticks; of a line both are as `c^2`). So it is `(L - Q)^(2/3)` that is interpolated, over the contact's own
//! displacement, by cubics; the rig in series is added.

/// A point that lacks less than this part of all is taken for the corner.
const AT_CORNER: f64 = 1e-3;
/// Places nearer to one another than this part of the way to the turn are one.
const CLOSE: f64 = 1e-6;
/// Steps to the displacement of the contact below one of the actuator, at the most.
const STEPS: usize = 60;

/// A computed loop, between the same two turns again and again.
pub struct Loop {
    pub normal_force: f64,
    /// On the way down and on the way up.
    pub branches: [Branch; 2],
    /// Stiffness of the contact directly after reversal [force/length].
    pub contact_stiffness: f64,
    /// Whether all of the contact slides before it turns.
    pub slides: bool,
    /// Whether any of it slips.
    pub slips: bool,
}

/// One way between the turns, as if it were that down: that up has its signs turned.
pub struct Branch {
    /// Displacement of the actuator, force and shift of the contact, from the turn on.
    points: Vec<[f64; 3]>,
    /// Displacements and forces, from the lowest displacement on.
    nodes: Vec<[f64; 2]>,
    corner: Option<Corner>,
}

/// Where a branch begins to slide.
struct Corner {
    /// Displacement and force.
    at: [f64; 2],
    /// Displacements of the contact and powers of what the force lacks, from the corner to the turn.
    nodes: Vec<[f64; 2]>,
    /// That power.
    power: f64,
    /// Of the rig [length/force].
    compliance: f64,
}

impl Branch {
    /// Of points from a turn on, in which of these the contact sticks anywhere, compliance of the rig, and whether the contact is a line.
    pub fn new(points: Vec<[f64; 3]>, sticks: &[bool], compliance: f64, is_line: bool) -> Self {
        let power = if is_line { 1.0 } else { 2.0 / 3.0 };
        let nodes = points.iter().rev().map(|point| [point[0], point[1]]).collect();
        let corner = Corner::of(&points, sticks, compliance, power);
        Self { points, nodes, corner }
    }

    fn at(&self, displacement: f64) -> [f64; 2] {
        let last = self.nodes.len() - 1;
        let Some(corner) = &self.corner else { return interpolated(&self.nodes, displacement) };
        if displacement <= corner.at[0] {
            return [corner.at[1], 0.0];
        }
        let turn = self.nodes[last];
        let inside = displacement.min(turn[0]);
        let [force, slope] = corner.force_at(inside);
        [force + slope * (displacement - inside), slope]
    }
}

impl Corner {
    /// `None` where nothing slides, or all does at once.
    fn of(points: &[[f64; 3]], sticks: &[bool], compliance: f64, power: f64) -> Option<Self> {
        let slid = sticks.iter().skip(1).position(|sticks| !sticks)? + 1;
        let limit = points[slid][1];
        let lacks = |point: &[f64; 3]| (point[1] - limit).max(0.0).powf(power);
        let all = lacks(&points[0]);
        let sticking: Vec<&[f64; 3]> =
            points[..slid].iter().filter(|point| lacks(point) > AT_CORNER * all).collect();
        let near = &sticking[sticking.len().saturating_sub(3)..];
        if near.len() < 2 {
            return None;
        }
        // The shift at which nothing is lacking, by the parabola (or the line) through the last points.
        let shift: f64 = near
            .iter()
            .map(|point| {
                let others = near.iter().filter(|other| other[1] != point[1]);
                point[2] * others.map(|other| lacks(other) / (lacks(other) - lacks(point))).product::<f64>()
            })
            .sum();
        let shift = shift.clamp(points[slid][2], near[near.len() - 1][2]);
        let mut nodes = vec![[shift, 0.0]];
        nodes.extend(sticking.iter().rev().map(|point| [point[2], lacks(point)]));
        // Places that fall together, but for rounding, determine no slope.
        let close = CLOSE * (points[0][2] - shift);
        nodes.dedup_by(|next, before| next[0] - before[0] <= close);
        let at = [shift + compliance * limit, limit];
        (nodes.len() > 2).then_some(Self { at, nodes, power, compliance })
    }

    /// Force and its slope at a displacement of the contact.
    fn of_contact(&self, shift: f64) -> [f64; 2] {
        let [value, slope] = interpolated(&self.nodes, shift);
        let (value, inverse) = (value.max(0.0), 1.0 / self.power);
        [self.at[1] + value.powf(inverse), inverse * value.powf(inverse - 1.0) * slope]
    }

    /// The same at one of the actuator, between the corner and the turn: by Newton's steps, or halves of where it lies.
    fn force_at(&self, displacement: f64) -> [f64; 2] {
        let [mut low, mut high] = [self.nodes[0][0], self.nodes[self.nodes.len() - 1][0]];
        let mut shift = f64::midpoint(low, high);
        for _ in 0..STEPS {
            let [force, slope] = self.of_contact(shift);
            let off = shift + self.compliance * force - displacement;
            if off > 0.0 {
                high = shift;
            } else {
                low = shift;
            }
            let next = shift - off / (1.0 + self.compliance * slope);
            let next = if (low..=high).contains(&next) { next } else { f64::midpoint(low, high) };
            if next == shift {
                break;
            }
            shift = next;
        }
        let [force, slope] = self.of_contact(shift);
        [force, slope / (1.0 + self.compliance * slope)]
    }
}

impl Loop {
    /// Whether the first increment after the turn tells the stiffness of the contact: it carries less than half of the change of force.
    pub fn tells_stiffness(&self) -> bool {
        let down = &self.branches[0].points;
        let [turn, next, end] = [0, 1, down.len() - 1].map(|k| down[k][1]);
        self.contact_stiffness.is_finite()
            && self.contact_stiffness > 0.0
            && (turn - next).abs() < 0.5 * (turn - end).abs()
    }

    /// Force and its slope at a displacement of the actuator, on the way down or up; beyond the turns along the line there.
    pub fn at(&self, falling: bool, displacement: f64) -> [f64; 2] {
        if falling {
            return self.branches[0].at(displacement);
        }
        let [force, slope] = self.branches[1].at(-displacement);
        [-force, slope]
    }

    /// Displacement of the actuator, force and shift around the loop, from the turn at the top down and up again.
    pub fn around(&self) -> Vec<[f64; 3]> {
        let [down, up] = &self.branches;
        down.points.iter().copied().chain(up.points.iter().map(|point| point.map(|value| -value))).collect()
    }
}

/// Value and slope between points of ascending places, by cubics whose slopes at the points are those of the parabola through three; beyond
/// the points along the line there.
fn interpolated(points: &[[f64; 2]], at: f64) -> [f64; 2] {
    let last = points.len() - 2;
    let place = points.partition_point(|point| point[0] <= at).saturating_sub(1).min(last);
    let slope = |k: usize| (points[k + 1][1] - points[k][1]) / (points[k + 1][0] - points[k][0]);
    let tangent = |k: usize| {
        if k == 0 {
            return slope(0);
        }
        if k == last + 1 {
            return slope(last);
        }
        let (before, after) = (points[k][0] - points[k - 1][0], points[k + 1][0] - points[k][0]);
        (slope(k - 1) * after + slope(k) * before) / (before + after)
    };
    let width = points[place + 1][0] - points[place][0];
    let share = (at - points[place][0]) / width;
    let [from, to] = [tangent(place), tangent(place + 1)];
    if share < 0.0 {
        return [points[place][1] + from * share * width, from];
    }
    if share > 1.0 {
        return [points[place + 1][1] + to * (share - 1.0) * width, to];
    }
    let chord = slope(place);
    let [quadratic, cubic] = [3.0 * chord - 2.0 * from - to, from + to - 2.0 * chord];
    let value = points[place][1] + width * share * (from + share * (quadratic + share * cubic));
    [value, from + share * (2.0 * quadratic + 3.0 * share * cubic)]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Mindlin behind a spring, from just beyond the onset of sliding to six times as far, between 24 points as the solver has them: what is
    /// interpolated is a line. (Cubics through the forces are up to 7 % of the friction force off, in the mean 0.9 %.)
    #[test]
    fn the_corner_of_sliding_is_where_it_is() {
        for spring in [0.05, 1.0, 4.0] {
            // A friction force of 1 and a contact of compliance 1: it slides from a displacement of 1.5 on.
            let onset = 1.5 + spring;
            let of_force = |force: f64| 1.5 * (1.0 - (1.0 - force).powf(2.0 / 3.0)) + spring * force;
            let force_at = |way: f64| {
                if way >= onset {
                    return 1.0;
                }
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if of_force(middle) < way { low = middle } else { high = middle }
                }
                low
            };
            for beyond in [1.02, 1.3, 2.0, 4.0, 6.0] {
                let amplitude = beyond * onset;
                let down = |place: f64| 1.0 - 2.0 * force_at(0.5 * (amplitude - place));
                let points: Vec<[f64; 3]> = (0..=24)
                    .map(|k| amplitude * (PI * f64::from(k) / 24.0).cos())
                    .map(|place| [place, down(place), place - spring * down(place)])
                    .collect();
                let sticks: Vec<bool> = points.iter().map(|point| point[1] > -1.0 + 1e-9).collect();
                let branch = Branch::new(points, &sticks, spring, false);
                for k in 0..=1000 {
                    let place = amplitude * (f64::from(k) / 500.0 - 1.0);
                    let off = (branch.at(place)[0] - down(place)).abs();
                    assert!(off < 1e-9, "{spring} {beyond} {place}: {off}");
                }
            }
        }
    }
}
