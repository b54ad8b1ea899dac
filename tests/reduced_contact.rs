//! A sphere as a row of independent springs: the method of dimensionality reduction (Popov & Hess 2015, *Method of
//! Dimensionality Reduction in Contact Mechanics and Friction*, ch. 5), which for a parabolic profile, similar bodies and
//! nu = 0 gives force, shift, approach and traction of Mindlin and Deresiewicz's problem for any history of normal force
//! and of tangential force along one line. Nothing here is shared with the product.

use std::f64::consts::PI;

/// Springs under half of the contact.
const SPRINGS: usize = 4000;

/// The row of springs.
pub struct Springs {
    radius: f64,
    normal: f64,
    tangential: f64,
    friction: f64,
    step: f64,
    /// Elongation of each spring along x.
    pulled: Vec<f64>,
    /// Approach.
    pub approach: f64,
    /// Shift.
    pub shift: f64,
    /// Work of friction.
    pub dissipated: f64,
}

impl Springs {
    /// Springs of a sphere of `radius`, moduli E* and G* (`1/G* = sum (2 - nu)/G`), under at most `widest`.
    pub fn new(radius: f64, modulus: f64, shear_modulus: f64, friction: f64, widest: f64) -> Self {
        Self {
            radius,
            normal: modulus,
            tangential: 4.0 * shear_modulus,
            friction,
            step: widest / SPRINGS as f64,
            pulled: vec![0.0; SPRINGS],
            approach: 0.0,
            shift: 0.0,
            dissipated: 0.0,
        }
    }

    fn place(&self, index: usize) -> f64 {
        (index as f64 + 0.5) * self.step
    }

    fn pressed(&self, index: usize) -> f64 {
        (self.approach - self.place(index).powi(2) / self.radius).max(0.0)
    }

    fn bound(&self, index: usize) -> f64 {
        self.friction * self.normal * self.pressed(index) / self.tangential
    }

    /// Normal force; `P = 4 E* sqrt(R) d^(3/2) / 3`.
    pub fn press(&mut self, force: f64) {
        self.approach = (0.75 * force / (self.normal * self.radius.sqrt())).powf(2.0 / 3.0);
    }

    /// Tangential force after a motion to `shift`, without making it.
    fn force_at(&self, shift: f64) -> f64 {
        let sum: f64 = (0..SPRINGS)
            .map(|index| {
                let bound = self.bound(index);
                (self.pulled[index] + shift - self.shift).clamp(-bound, bound)
            })
            .sum();
        2.0 * self.tangential * self.step * sum
    }

    /// Moves to a shift; springs at their bound slip.
    pub fn slide(&mut self, shift: f64) {
        for index in 0..SPRINGS {
            let bound = self.bound(index);
            let free = self.pulled[index] + shift - self.shift;
            let held = free.clamp(-bound, bound);
            if self.pressed(index) > 0.0 {
                self.dissipated += 2.0 * self.tangential * self.step * held * (free - held);
            }
            self.pulled[index] = held;
        }
        self.shift = shift;
    }

    /// Moves until the tangential force is `force` (of a size that friction carries).
    pub fn pull(&mut self, force: f64) {
        let reach = 4.0 * self.friction * self.normal * self.approach / self.tangential;
        let (mut low, mut high) = (self.shift - 4.0 * reach, self.shift + 4.0 * reach);
        for _ in 0..200 {
            let middle = f64::midpoint(low, high);
            if self.force_at(middle) < force {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.slide(f64::midpoint(low, high));
    }

    /// Shear at distance `r`: `-(Gs / pi) int_r u'(x) / sqrt(x^2 - r^2) dx`, u linear from spring to spring.
    pub fn shear(&self, r: f64) -> f64 {
        let mut sum = 0.0;
        for index in 0..SPRINGS - 1 {
            let (from, to) = (self.place(index), self.place(index + 1));
            if to <= r {
                continue;
            }
            let slope = (self.pulled[index + 1] - self.pulled[index]) / self.step;
            let area = |x: f64| (x.max(r) / r.max(1e-300)).acosh();
            sum -= slope * (area(to) - area(from));
        }
        self.tangential / PI * sum
    }
}
