use super::{LoopPoint, LoopReading};

/// A loop between displacements of 1 and -1 that slides at forces of 1 and -1: flanks of length 2 k whose force left is that of a power
/// law, and the energy that is dissipated by the area of the loop.
struct Loop {
    k: f64,
    exponent: f64,
}

impl Loop {
    /// Force, and energy dissipated since reversal, at a way from there.
    fn flank(&self, way: f64) -> (f64, f64, f64) {
        let (length, m) = (2.0 * self.k, self.exponent);
        let done = (way / length).min(1.0);
        let force = 2.0 * (1.0 - done).powf(m) - 1.0;
        // Work done by the driving force on the way less the elastic energy gained, which by symmetry is that of a loop of Masing's
        // rule: at its end, where both plateaus store the same, the work alone.
        let work = length * (done - 2.0 / (m + 1.0) * (1.0 - (1.0 - done).powf(m + 1.0)));
        let slid = (way - length).max(0.0);
        (force, slid, if slid > 0.0 { work + slid } else { 0.0 })
    }

    /// Points of a steady cycle that starts at 0 on the upper plateau, a quarter of it `n` increments.
    fn points(&self, n: usize) -> Vec<LoopPoint<f64>> {
        let part = |k: usize| k as f64 / n as f64;
        let mut dissipated = 0.0;
        let mut points = Vec::new();
        for k in 0..=n {
            points.push(LoopPoint { force: 1.0, displacement: part(k), slid: part(1), dissipated: part(k) });
        }
        for side in [1.0, -1.0] {
            let start = points.last().unwrap().dissipated;
            let mut before: f64 = 0.0;
            for k in 1..=(if side > 0.0 { 2 * n } else { n }) {
                let (force, slid, energy) = self.flank(part(k));
                // Inside of the flank the energy is not looked at.
                dissipated = if slid > 0.0 { start + energy } else { dissipated.max(start) };
                points.push(LoopPoint {
                    force: side * force,
                    displacement: side * (1.0 - part(k)),
                    slid: slid - before,
                    dissipated,
                });
                before = slid;
            }
        }
        points
    }
}

#[test]
fn a_loop_that_slides_is_read_the_same_from_few_increments_and_from_many() {
    for (k, exponent) in [(0.1, 1.5), (0.3, 1.5), (0.02, 1.18), (0.2, 1.0), (0.4, 2.0)] {
        let exact = Loop { k, exponent };
        // Where half of the force's change is left; slope of the power at reversal.
        let opening = 1.0 - 2.0 * k * (1.0 - 0.5_f64.powf(1.0 / exponent));
        let slope = exponent / k;
        for n in [1, 2, 3, 4, 8, 25, 400] {
            let read = LoopReading::of(&exact.points(n));
            // Rounding; of a power of small differences.
            assert!((read.opening - opening).abs() < 1e-9, "{k} {exponent} {n}: {} {opening}", read.opening);
            assert!(
                (read.stiffness.unwrap() / slope - 1.0).abs() < 1e-6,
                "{k} {exponent} {n}: {read:?} {slope}"
            );
            assert!(read.slides);
            assert_eq!((read.force_amplitude, read.displacement_amplitude), (1.0, 1.0));
        }
    }
}

#[test]
fn a_loop_that_sticks_somewhere_is_read_by_its_chords() {
    // A parallelogram through (1, 1), (0.5, 0), (-1, -1), (-0.5, 0), whose points say nothing of sliding.
    let corners = [(0.0, -0.5), (1.0, 1.0), (0.0, 0.5), (-1.0, -1.0), (0.0, -0.5)];
    let points =
        corners.map(|(force, displacement)| LoopPoint { force, displacement, slid: 0.0, dissipated: 0.0 });
    let read = LoopReading::of(&points);
    assert_eq!((read.opening, read.stiffness, read.slides), (0.5, Some(2.0), false));
    // Plateaus of unlike forces: the normal force has changed.
    let points = corners.map(|(force, displacement)| LoopPoint {
        force: if force > 0.0 { 2.0 } else { force },
        displacement,
        slid: 0.1,
        dissipated: 0.0,
    });
    assert!(!LoopReading::of(&points).slides);
}

/// A loop of partial slip from rest and back to the middle, whose forces there are rounding, on whichever side: its width is that of its chords.
#[test]
fn forces_at_the_middle_that_are_rounding_do_not_close_a_loop() {
    let point = |force: f64, displacement: f64| LoopPoint { force, displacement, slid: 0.0, dissipated: 0.0 };
    for rounding in [[1e-16, 7e-16, -3e-16], [-3e-16, -7e-16, 1e-16], [0.0; 3]] {
        let [first, way_down, last] = rounding;
        let points = [
            point(first, 0.0),
            point(1.0 + 4e-16, 3.0),
            point(way_down, 1.0),
            point(-1.0 - 1e-15, -2.5),
            point(last, -0.5),
        ];
        let found = LoopReading::of(&points);
        assert!((found.opening - 0.75).abs() < 1e-12, "{rounding:?}: {}", found.opening);
    }
}
