//! The history of loads of a case.

use std::f64::consts::TAU;
use std::fmt::Write;

use ndarray::Array2;

use super::Family;
use super::body::Body;
use crate::random::Random;

/// Largest pull on a friction map, as a fraction of what the largest coefficient that can be drawn would carry.
pub(super) const MOST_PULL_ON_MAP: f64 = 0.4;
/// The whole case, of whose approach the force and the maximum pressure are known; and its friction map.
pub(super) fn loaded(body: &Body, random: &mut Random, force: f64, peak: f64) -> (String, Vec<Array2<f64>>) {
    let maps = if body.family == Family::Map { vec![body.map(random)] } else { Vec::new() };
    let friction = if maps.is_empty() {
        format!("coefficient = {:e}", body.friction)
    } else {
        "map = { array = 0 }".to_owned()
    };
    let mut text = body.head(body.family == Family::Periodic, &friction);
    if body.family == Family::Wear {
        // In fractions of what would take a cell's whole pressure off over a slip of the sliding distance.
        let cells = body.cells[0].min(body.cells[1]) as f64;
        let (law, more) = if random.chance(0.5) { ("archard", 1.0) } else { ("energy", body.friction) };
        let coefficient = random.log_uniform(1e-3, 1.0) / (peak * cells * body.friction * more);
        let every = random.whole(1, 3);
        let _ = write!(text, "[wear]\nlaw = \"{law}\"\ncoefficient = {coefficient:e}\nevery = {every}\n");
    }
    let mut loads = Loads { body, random, force, text, pressed: 0.0 };
    loads.write();
    (loads.text, maps)
}

/// The history of loads as it is drawn.
struct Loads<'a> {
    body: &'a Body,
    random: &'a mut Random,
    force: f64,
    text: String,
    /// Normal load so far, as a fraction.
    pressed: f64,
}

impl Loads<'_> {
    fn stage(&mut self, controls: &str, increments: usize) {
        let _ = write!(self.text, "[[load]]\n{controls}increments = {increments}\n");
    }

    fn press(&mut self, fraction: f64, most: usize) {
        self.pressed = fraction;
        let controls = if self.body.by_approach {
            format!("approach = {:e}\n", self.body.approach * fraction)
        } else {
            format!("normal_force = {:e}\n", self.force * fraction)
        };
        let increments = self.random.whole(1, most);
        self.stage(&controls, increments);
    }

    /// All of it.
    fn write(&mut self) {
        let first = self.random.between(0.3, 1.0);
        self.press(first, 4);
        if self.body.friction == 0.0 {
            let next = self.random.uniform();
            self.press(next, 3);
        } else {
            self.rub();
        }
        if self.random.chance(0.2) {
            // Nothing that apart bodies cannot carry.
            match self.body.family {
                _ if self.body.friction == 0.0 => {}
                Family::Periodic => self.stage("tangential_force = [0.0, 0.0]\n", 1),
                Family::Torsion => self.stage("shift = [0.0, 0.0]\ntwist = 0.0\n", 1),
                _ => self.stage("shift = [0.0, 0.0]\n", 1),
            }
            self.press(0.0, 3);
            self.press(0.5, 1);
        }
    }

    /// A few stages along the surface.
    fn rub(&mut self) {
        let body = self.body;
        let slides = body.friction * body.approach;
        let mut by_force = !body.by_approach;
        for number in 0..self.random.whole(1, 3) {
            let turns = body.family == Family::Torsion && (number == 0 || self.random.chance(0.3));
            let kind = self.random.uniform();
            if turns {
                if by_force && self.random.chance(0.5) {
                    // The moment of a Hertz contact that slides about z is 3 pi/16 mu P a; less is shared with a pull.
                    let fraction = self.random.between(-0.25, 0.25);
                    let moment = fraction * body.friction * self.force * self.pressed * body.radius;
                    let increments = self.random.whole(1, 3);
                    self.stage(&format!("twist_moment = {moment:e}\n"), increments);
                } else {
                    let twist = slides / body.radius * self.random.log_uniform(0.1, 3.0);
                    let increments = self.random.whole(1, 3);
                    self.stage(&format!("twist = {twist:e}\n"), increments);
                }
            } else if by_force && (kind < 0.45 || body.family == Family::Periodic) {
                self.pull();
            } else if kind < 0.75 && body.family != Family::Periodic {
                by_force = false;
                let [x, y] = self.direction().map(|part| part * slides);
                let shift = self.random.log_uniform(0.1, 5.0);
                let increments = self.random.whole(1, 4);
                self.stage(&format!("shift = [{:e}, {:e}]\n", x * shift, y * shift), increments);
                if self.random.chance(0.5) {
                    // And back.
                    let back = self.random.between(-1.0, 1.0) * shift;
                    let increments = self.random.whole(1, 4);
                    self.stage(&format!("shift = [{:e}, {:e}]\n", x * back, y * back), increments);
                } else if self.random.chance(0.3) || body.family == Family::Wear {
                    let cycles = self.random.whole(1, 3);
                    let controls = format!("shift = [{:e}, {:e}]\ncycles = {cycles}\n", x * shift, y * shift);
                    self.stage(&controls, 8);
                }
            } else if by_force {
                // The pull so far must stay below what the smaller force carries.
                self.stage("tangential_force = [0.0, 0.0]\n", 1);
                let fraction = self.pressed * self.random.between(0.2, 1.0);
                self.press(fraction, 3);
            } else if body.by_approach && self.random.chance(0.7) {
                let fraction = self.random.between(0.2, 1.0);
                self.press(fraction, 3);
            } else if body.family == Family::Plain {
                // The motions stay, friction changes.
                let other = body.friction * self.random.between(0.0, 1.5);
                self.stage(&format!("friction = {other:e}\n"), 1);
            }
        }
    }

    /// A tangential force that friction carries, and perhaps the opposite one.
    fn pull(&mut self) {
        let body = self.body;
        // Of a map nobody knows yet what it carries; a moment takes its share.
        let most = match body.family {
            Family::Map => MOST_PULL_ON_MAP,
            Family::Torsion => 0.5,
            _ => 0.99,
        };
        let near = most == 0.99 && self.random.chance(0.3);
        let fraction = if near { 0.9999 } else { self.random.between(0.05, most) };
        let pull = fraction * body.friction * self.force * self.pressed;
        let [x, y] = self.direction().map(|part| part * pull);
        let increments = self.random.whole(1, 4);
        self.stage(&format!("tangential_force = [{x:e}, {y:e}]\n"), increments);
        if self.random.chance(0.3) {
            let back = -self.random.uniform();
            let increments = self.random.whole(1, 4);
            self.stage(&format!("tangential_force = [{:e}, {:e}]\n", x * back, y * back), increments);
        }
    }

    /// A unit vector: any, or along an axis, where mirrors help.
    fn direction(&mut self) -> [f64; 2] {
        if self.random.chance(0.25) {
            return if self.random.chance(0.5) { [1.0, 0.0] } else { [0.0, 1.0] };
        }
        let angle = self.random.between(0.0, TAU);
        [angle.cos(), angle.sin()]
    }
}
