use super::super::super::contact_set::ContactSet;
use super::super::super::prescribed::TangentialLoads;
use super::super::friction::FrictionBound;
use super::super::rigid_motions::CellPositions;
use super::*;
use crate::random::Random;

#[test]
fn tension_is_cut_off_and_the_load_stays() {
    let mut pressure = [3.0, -2.0, 1.0];
    assert!(project_pressure(&mut pressure, Some(8.0), None));
    assert_eq!(pressure, [6.0, 0.0, 2.0]);
    let mut free = [3.0, -2.0, 1.0];
    assert!(project_pressure(&mut free, None, None));
    assert_eq!(free, [3.0, 0.0, 1.0]);
    // Nothing is left that could carry a load; no load is carried by nothing.
    assert!(!project_pressure(&mut [-1.0, 0.0], Some(1.0), None));
    assert!(project_pressure(&mut [-1.0, 0.0], Some(0.0), None));
}

/// A contact of 5 x 5 cells about the origin under the bounds `bound(cell)`, and its shear projected.
struct Scene {
    bound: Vec<f64>,
    motions: RigidMotions,
    resultant: [f64; 3],
}

const CELLS: usize = 25;

impl Scene {
    fn new(by_force: [bool; 3], resultant: [f64; 3]) -> Self {
        let centres: Vec<f64> = (-2..=2).map(f64::from).collect();
        let loads = TangentialLoads { by_force, ..TangentialLoads::default() };
        let motions = CellPositions::new(centres.clone(), centres, true)
            .motions_of(&ContactSet::of(CELLS, |_| true), loads);
        let bound = (0..CELLS).map(|cell| 1.0 + 0.5 * f64::from(u8::try_from(cell % 3).unwrap())).collect();
        Self { bound, motions, resultant }
    }

    /// Sums of shear times the three motions.
    fn found(&self, shear: &TangentialField) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for cell in 0..CELLS {
            let ([x, y], [a, b]) = (shear.at(cell), self.motions.rotation.at(cell));
            sums = [sums[0] + x, sums[1] + y, sums[2] + x * a + y * b];
        }
        sums
    }

    /// Projects: `slipping` cells slip along x.
    fn project(&self, shear: &TangentialField, slipping: impl Fn(usize) -> bool) -> TangentialField {
        let mut sets = ActiveSets::of(
            shear,
            &TangentialField::zeros(CELLS),
            &FrictionBound { bound: self.bound.clone(), slope: vec![0.0; CELLS] },
            1.0,
        );
        for cell in 0..CELLS {
            let slips = f64::from(u8::from(slipping(cell)));
            (sets.slip[cell], sets.stick[cell], sets.direction.x[cell]) = (slips, 1.0 - slips, slips);
            sets.direction.y[cell] = 0.0;
        }
        let Self { bound, motions, resultant } = self;
        let mut projected = shear.clone();
        ShearProjection::default().project(&mut projected, &sets, bound, motions, *resultant);
        projected
    }

    fn size(&self, shear: &TangentialField, cell: usize) -> f64 {
        let [x, y] = shear.at(cell);
        x.hypot(y) / self.bound[cell]
    }
}

fn shear(mut at: impl FnMut(usize) -> [f64; 2]) -> TangentialField {
    let mut field = TangentialField::zeros(CELLS);
    (0..CELLS).for_each(|cell| field.set(cell, at(cell)));
    field
}

/// Where motions are prescribed no resultant is to be held: the projection is the nearest point of every disc by itself.
#[test]
fn every_cell_goes_to_the_nearest_point_of_its_disc() {
    let scene = Scene::new([false; 3], [0.0; 3]);
    let given = shear(|cell| if cell < 5 { [3.0, 4.0] } else { [0.3, -0.4] });
    let found = scene.project(&given, |_| false);
    for cell in 0..CELLS {
        let expected =
            if cell < 5 { [0.6 * scene.bound[cell], 0.8 * scene.bound[cell]] } else { [0.3, -0.4] };
        for (found, expected) in found.at(cell).iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15, "{cell}");
        }
    }
    // Slipping cells go onto their circles, from inside too; without shear along their slip.
    let slipping =
        scene.project(&shear(|cell| if cell == 7 { [0.0; 2] } else { [0.3, -0.4] }), |cell| cell < 10);
    assert_eq!(slipping.at(7), [scene.bound[7], 0.0]);
    for cell in 0..CELLS {
        let expected = if cell < 10 { 1.0 } else { 0.5 / scene.bound[cell] };
        assert!((scene.size(&slipping, cell) - expected).abs() < 1e-15, "{cell}");
    }
}

/// Resultants are made exactly by cells inside their discs and by turning those on their circles, which stay there; no cell leaves
/// its disc.
#[test]
fn resultants_are_held_and_circles_kept() {
    for by_force in [[true, true, true], [true, false, false], [true, true, false]] {
        let scene = Scene::new(by_force, [9.0, -3.0, 2.5]);
        let given = shear(|cell| [0.7 - 0.1 * (cell % 7) as f64, 0.05 * (cell % 5) as f64 - 0.1]);
        let found = scene.project(&given, |cell| cell % 4 == 0);
        let total: f64 = scene.bound.iter().sum();
        for mode in (0..3).filter(|&mode| by_force[mode]) {
            let off = scene.found(&found)[mode] - scene.resultant[mode];
            // Rounding of a sum of the bounds' size.
            assert!(off.abs() < 1e-14 * total, "{by_force:?} {mode}: {off:e}");
        }
        for cell in 0..CELLS {
            let size = scene.size(&found, cell);
            assert!(size < 1.0 + 1e-14, "{cell}: {size}");
            if cell % 4 == 0 {
                assert!((size - 1.0).abs() < 1e-14, "{cell}: {size}");
            }
        }
    }
}

/// Slipping cells without shear, which just came into contact, go onto their circles along their slip, whatever its direction.
#[test]
fn a_slipping_cell_without_shear_goes_along_its_slip() {
    let (bound, stick, along) = ([2.0], [0.0], [[0.6], [-0.8]]);
    let (mut x, mut y, mut on) = ([0.0], [0.0], [0.0]);
    let read: [&[f64]; 6] = [&bound, &stick, &along[0], &along[1], &[], &[]];
    let sums = each_cell(&ToDiscs, read, [&mut x[..], &mut y, &mut on]);
    assert!((x[0] - 1.2).abs() < 1e-15 && (y[0] + 1.6).abs() < 1e-15 && on[0] == 1.0);
    assert_eq!([sums[0], sums[1]], [x[0], y[0]]);
}

/// Cells inside their discs and on their circles, at oblique places and under oblique shear: `(bound, shear, on, rotation)`.
const SAMPLES: [(f64, [f64; 2], f64, [f64; 2]); 4] = [
    (2.0, [1.2, 1.6], 1.0, [-0.3, 0.7]),
    (0.5, [0.3, -0.4], 1.0, [0.9, 0.2]),
    (3.0, [0.5, -0.7], 0.0, [0.4, -0.6]),
    (1.5, [-0.2, 0.1], 0.0, [-0.8, -0.5]),
];

fn pushed(sample: (f64, [f64; 2], f64, [f64; 2]), amounts: [f64; 3]) -> ([f64; 3], [f64; 9]) {
    let (bound, [x, y], on, [a, b]) = sample;
    let (mut to_x, mut to_y, mut to_on) = ([0.0], [0.0], [0.0]);
    let read: [&[f64]; 6] = [&[bound], &[x], &[y], &[on], &[a], &[b]];
    let sums = each_cell(&Push(amounts), read, [&mut to_x[..], &mut to_y, &mut to_on]);
    ([to_x[0], to_y[0], to_on[0]], sums)
}

/// What a cell adds to the system for the amounts of a push is the derivative of its resultants by them.
#[test]
fn the_answer_to_a_push_is_the_derivative_of_the_resultants() {
    for sample in SAMPLES {
        let [_, _, _, xx, yy, rr, xy, xr, yr] = pushed(sample, [0.0; 3]).1;
        let matrix = [[xx, xy, xr], [xy, yy, yr], [xr, yr, rr]];
        let step = 1e-5;
        for motion in 0..3 {
            let resultants = [step, -step].map(|step| {
                let mut amounts = [0.0; 3];
                amounts[motion] = step;
                pushed(sample, amounts).1
            });
            for mode in 0..3 {
                let slope = (resultants[0][mode] - resultants[1][mode]) / (2.0 * step);
                // Third derivative times step^2, and rounding over the step.
                assert!((slope - matrix[mode][motion]).abs() < 1e-9, "{sample:?} {motion} {mode}");
            }
        }
    }
}

/// A push far along: cells inside are moved by it up to their circles, cells on their circles along the tangent and back to them.
#[test]
fn pushes_leave_every_cell_in_its_disc() {
    for sample in SAMPLES {
        let (bound, [x, y], on, [a, b]) = sample;
        for amounts in [[0.3, -0.2, 0.4], [-2.0, 1.0, 3.0], [0.01, 0.02, -0.01]] {
            let push = [bound * (amounts[0] + amounts[2] * a), bound * (amounts[1] + amounts[2] * b)];
            let (along, out) = if on > 0.0 {
                let along = [x / bound, y / bound];
                (along, push[0] * along[0] + push[1] * along[1])
            } else {
                ([0.0; 2], 0.0)
            };
            let moved = [x + push[0] - out * along[0], y + push[1] - out * along[1]];
            let size = moved[0].hypot(moved[1]);
            let cut = on > 0.0 || size > bound;
            let scale = if cut { bound / size } else { 1.0 };
            let ([to_x, to_y, to_on], sums) = pushed(sample, amounts);
            assert!((to_x - moved[0] * scale).abs() < 1e-14 && (to_y - moved[1] * scale).abs() < 1e-14);
            assert_eq!(to_on, f64::from(u8::from(cut)));
            assert!((sums[2] - (to_x * a + to_y * b)).abs() < 1e-14);
        }
    }
}

/// Any resultants that some shear within its bounds has are held, whatever shear and active sets it starts from; cells never leave
/// their discs. In other units the same bits.
#[test]
fn resultants_that_friction_carries_are_held_from_any_start() {
    let mut random = Random::seeded(17);
    for number in 0..300 {
        let mut scene = Scene::new([true, number % 3 > 0, number % 2 > 0], [0.0; 3]);
        for bound in &mut scene.bound {
            *bound = random.log_uniform(0.05, 2.0);
        }
        let mut any = |most: f64| {
            shear(|cell| {
                let (size, angle) = (most * random.uniform().sqrt(), random.between(0.0, 6.3));
                [size * scene.bound[cell] * angle.cos(), size * scene.bound[cell] * angle.sin()]
            })
        };
        let (carried, given) = (any(0.9), any(1.5));
        let slipping: Vec<bool> = (0..CELLS).map(|_| random.chance(0.4)).collect();
        scene.resultant = scene.motions.loads.only_by_force(scene.found(&carried));
        let found = scene.project(&given, |cell| slipping[cell]);
        let total: f64 = scene.bound.iter().sum();
        for mode in (0..3).filter(|&mode| scene.motions.loads.by_force[mode]) {
            let off = (scene.found(&found)[mode] - scene.resultant[mode]) / total;
            // Rounding of the sums.
            assert!(off.abs() < 1e-14, "{number}, {mode}: {off:e}");
        }
        assert!((0..CELLS).all(|cell| scene.size(&found, cell) < 1.0 + 1e-14), "{number}");
        let unit = 2.0_f64.powi(-40);
        scene.bound.iter_mut().for_each(|bound| *bound *= unit);
        scene.resultant = scene.resultant.map(|part| part * unit);
        let scaled = |field: &TangentialField| shear(|cell| field.at(cell).map(|part| part * unit));
        let small = scene.project(&scaled(&given), |cell| slipping[cell]);
        assert!((0..CELLS).all(|cell| small.at(cell) == scaled(&found).at(cell)), "{number}");
    }
}

/// All cells slip, along x, and little force is asked for: turning alone would need them to face each other; they come off their
/// circles instead.
#[test]
fn cells_come_off_their_circles_where_turning_is_not_enough() {
    let scene = Scene::new([true, true, true], [1.0, 0.5, 0.25]);
    let found = scene.project(&shear(|_| [2.0, 0.0]), |_| true);
    let total: f64 = scene.bound.iter().sum();
    for (found, asked) in scene.found(&found).iter().zip(scene.resultant) {
        assert!((found - asked).abs() < 1e-12 * total, "{found} {asked}");
    }
    assert!((0..CELLS).all(|cell| scene.size(&found, cell) < 1.0 + 1e-14));
}

/// What moves no force is left alone: shear that already is feasible and has its resultants.
#[test]
fn feasible_shear_stays_as_it_is() {
    let given = shear(|cell| [0.02 * cell as f64, 0.3 - 0.01 * cell as f64]);
    let mut scene = Scene::new([true; 3], [0.0; 3]);
    scene.resultant = scene.found(&given);
    let found = scene.project(&given, |_| false);
    for cell in 0..CELLS {
        let ([x, y], [u, v]) = (given.at(cell), found.at(cell));
        assert!((x - u).abs() < 1e-15 && (y - v).abs() < 1e-15);
    }
}
