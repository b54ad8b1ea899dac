//! Every term of a linearised increment, and the whole of it, has the transpose that it goes backwards by: `<y, A x> = <A^T y, x>` on random vectors.

use std::sync::Arc;

use super::after::After;
use super::cell::MOTIONS;
use super::change::{Change, Solution};
use super::contact::{Asked, Contact, Drive};
use super::fields::Fields;
use super::friction_change::FrictionChange;
use super::gradient::{Snapshots, end_blocks};
use super::increment::Increment;
use super::krylov::LinearProblem;
use super::linearised::Linearised;
use super::loads::Load;
use super::operators::Operators;
use super::replay::Replay;
use super::rule::{Cells, PathChange, Rule};
use super::scene::Scene;
use super::snapshot::Snapshot;
use super::solved::Solved;
use super::transposed::Transposed;
use crate::case::Case;
use crate::fields::dot;
use crate::model::Zone;
use crate::model::controls::FREEDOMS;
use crate::plan::Plan;
use crate::random::Random;
use crate::run::{PairCompliance, Silent, Simulation};

/// Two coatings under an elastic body, forces that grow together, slip that turns, the far end of a spring, a load that falls; bound by a strength.
const COUPLED: &str = r#"
[grid]
cells = [16, 16]
size = [2.0, 2.0]
[upper]
substrate = { young = 5.0, poisson = 0.2 }
[lower]
coatings = [{ thickness = 0.3, young = 3.0, poisson = 0.35 }]
substrate = { young = 1.0, poisson = 0.3 }
[profile.ellipsoid]
radius_x = 4.0
radius_y = 6.0
[friction]
coefficient = 0.25
max_shear = 0.03
[rig]
tangential_stiffness = 2.0
[solver]
tolerance = 1e-11
[[load]]
normal_force = 0.15
tangential_force = [0.02, 0.004]
increments = 4
ramp = "cubic"
[[load]]
actuator = [0.02, 0.015]
increments = 3
[[load]]
normal_force = 0.1
shift = [0.0, 0.0]
increments = 3
"#;

/// A rigid ball on a like half-space, on a quarter of its grid; tilted, torsion on the whole.
const SIMILAR: &str = r"
[grid]
cells = [24, 24]
size = [3.0, 3.0]
[upper]
rigid = true
[lower]
substrate = { young = 1.0, poisson = 0.5 }
[profile.sphere]
radius = 5.0
[friction]
coefficient = 0.3
[solver]
tolerance = 1e-11
[[load]]
normal_force = 0.15
increments = 3
[[load]]
tangential_force = [0.03, 0.0]
cycles = 1
increments = 8
";

/// Surfaces that wear by the energy that friction dissipates, in jumps over two cycles, under a bulk stress.
const WORN: &str = r"
[grid]
cells = [16, 16]
size = [3.0, 3.0]
[upper]
rigid = true
[lower]
substrate = { young = 1.0, poisson = 0.3 }
[profile.sphere]
radius = 5.0
[friction]
coefficient = 0.3
[wear]
coefficient = 0.3
every = 2
largest_step = 1.0
[solver]
tolerance = 1e-11
[[load]]
normal_force = 0.15
increments = 3
[[load]]
tangential_force = [0.03, 0.0]
bulk_stress = [0.01, 0.004]
cycles = 4
increments = 8
";

/// The same through a film, by coefficients of layers and of both bodies, more at the rim; with debris that flows out, and friction that follows the energy.
fn worn_through_layers() -> String {
    let layers = "lower]\ncoatings = [{ thickness = 1.5e-4, young = 3.0, poisson = 0.3, wear_coefficient = 0.3 }]\n\
                  substrate = { young = 1.0, poisson = 0.3, wear_coefficient = 0.1 }";
    WORN.replace("lower]\nsubstrate = { young = 1.0, poisson = 0.3 }", layers)
        .replace("rigid = true", "rigid = true\nwear_coefficient = 0.2")
        .replace("[wear]\ncoefficient = 0.3\n", "[wear]\n")
        .replace("[solver]", "[wear.rim]\nwidth = 0.3\ninterior = 0.5\n[wear.debris]\nfraction = 0.5\noutflow_length = 0.1\n[solver]")
        .replace(
            "[wear]",
            "evolution = { by = \"energy\", last = 0.5, scale = 2e-3, tolerance = 1.0 }\n[wear]",
        )
}

fn vector(random: &mut Random, size: usize) -> Vec<f64> {
    (0..size).map(|_| random.between(-1.0, 1.0)).collect()
}

fn array<const N: usize>(random: &mut Random) -> [f64; N] {
    std::array::from_fn(|_| random.between(-1.0, 1.0))
}

fn fields(random: &mut Random, size: usize) -> Fields {
    [(); 3].map(|()| vector(random, size))
}

/// No change, of surfaces that may wear and of which slip is asked for.
fn no_change(cells: usize) -> Change {
    Change::none(cells).of_wear(true).of_debris(true).of_slip(true).of_evolution(true)
}

fn change(random: &mut Random, cells: usize) -> Change {
    let mut tangential = || [(); 2].map(|()| vector(random, cells));
    let [shear, slid, drift, slip] = [(); 4].map(|()| tangential());
    Change {
        worn: vector(random, cells),
        collected: vector(random, cells),
        debris: vector(random, cells),
        path: vector(random, cells),
        slipped: vector(random, cells),
        slipping: vector(random, cells),
        slip,
        pressure: vector(random, cells),
        shear,
        gap: vector(random, cells),
        slid,
        drift,
        motions: array(random),
        strain: array(random),
        energies: array(random),
        reached: [(); 6].map(|()| array(random)),
        start: array(random),
        held: array(random),
        from: array(random),
        load: array(random),
        ratio: random.between(-1.0, 1.0),
    }
}

fn drive(random: &mut Random, scene: &Scene<'_>) -> Drive {
    let cells = scene.region.len();
    let mut found = Drive::none(scene);
    let in_cells = vector(random, found.friction.cells.len());
    found.friction = FrictionChange { everywhere: array(random), cells: in_cells };
    if scene.evolves() {
        found.friction.everywhere[0] = 0.0; // it is that of the cells
    }
    found.layers = (0..found.layers.len()).map(|_| array(random)).collect();
    (found.gap, found.response) = (vector(random, cells), fields(random, cells));
    Drive { rig: array(random), wear: array(random), strain: array(random), ..found }
}

fn paths(random: &mut Random, cells: usize) -> PathChange {
    let mut found = PathChange::none(cells);
    found.loads = random.between(-1.0, 1.0);
    for field in found.turn.iter_mut().chain(&mut found.ahead).chain([&mut found.touch]) {
        *field = vector(random, cells);
    }
    found
}

fn of_fields(a: &Fields, b: &Fields) -> f64 {
    a.iter().zip(b).map(|(a, b)| dot(a, b)).sum()
}

fn of_changes(a: &Change, b: &Change) -> f64 {
    a.parts().zip(b.parts()).map(|(a, b)| dot(a, b)).sum()
}

fn of_drives(a: &Drive, b: &Drive) -> f64 {
    dot(&a.gap, &b.gap)
        + dot(&a.friction.everywhere, &b.friction.everywhere)
        + dot(&a.friction.cells, &b.friction.cells)
        + dot(&a.rig, &b.rig)
        + dot(&a.wear, &b.wear)
        + dot(a.layers.as_flattened(), b.layers.as_flattened())
        + dot(&a.strain, &b.strain)
        + of_fields(&a.response, &b.response)
}

fn of_paths(a: &PathChange, b: &PathChange) -> f64 {
    let pairs = a.turn.iter().chain(&a.ahead).zip(b.turn.iter().chain(&b.ahead));
    a.loads * b.loads + dot(&a.touch, &b.touch) + pairs.map(|(a, b)| dot(a, b)).sum::<f64>()
}

/// Checks the equality of two products, to rounding of their size: the sums have a few thousand parts.
fn alike(term: &str, forward: f64, backward: f64, bound: f64) {
    assert!(forward != 0.0, "{term}: nothing");
    let off = (forward - backward).abs() / (1.0 + forward.abs());
    assert!(off < bound, "{term}: {forward:e} {backward:e} {off:.1e}");
}

/// An increment with all that its terms are made from.
struct At<'a> {
    scene: &'a Scene<'a>,
    snapshot: &'a Snapshot,
    load: &'a Load,
    now: &'a Solved,
    past: [&'a Solved; 2],
}

/// Shows every increment of a history that is linearised.
fn each_increment(text: &str, mut show: impl FnMut(At<'_>, &mut Operators)) {
    let plan = Plan::new(Case::from_toml(text, "case.toml").unwrap()).unwrap();
    let mut silent = Silent;
    let mut run = Snapshots::heard_by(&mut silent, true);
    Simulation::new(&plan).run(&mut run).unwrap();
    let Snapshots { mut steps, cycles, .. } = run;
    end_blocks(&mut steps, &cycles);
    let scene = Scene::new(&plan, &steps);
    let mut operators = scene.operators(&Arc::new(PairCompliance::of(&plan))).unwrap();
    let mut replay = Replay::new(&scene);
    let mut past = [replay.start.clone(), replay.start.clone()];
    for (number, snapshot) in steps.iter().enumerate() {
        let last = number.checked_sub(1).map(|last| &steps[last]);
        let next = replay.next((snapshot, last), past.each_ref().map(Some), (&mut operators, None));
        let now = next.solved.unwrap();
        let at = At { scene: &scene, snapshot, load: &next.load, now: &now, past: past.each_ref() };
        show(at, &mut operators);
        let [before, former] = &mut past;
        *former = std::mem::replace(before, now);
    }
}

fn rule_of(at: &At<'_>) -> Rule {
    let zones: Vec<Zone> = at.now.contact.cells().map(|cell| at.now.zone_of(cell)).collect();
    Rule::new(at.scene, (at.load, at.snapshot.by_end_points), at.past, (&at.now.contact, &zones), Cells::All)
}

/// 1e-12: rounding of sums of some thousand products, whose parts cancel to a hundredth.
#[test]
fn every_term_goes_backwards_by_its_transpose() {
    let mut random = Random::seeded(41);
    let mut kinds = [0; 3];
    for text in [COUPLED, SIMILAR, WORN, &worn_through_layers()] {
        each_increment(text, |at, operators| {
            let cells = at.scene.region.len();
            let contact_cells = at.now.contact.len();
            let rule = rule_of(&at);
            for (sum, kind) in kinds.iter_mut().zip(rule.kinds()) {
                *sum += kind;
            }
            let random = &mut random;
            loads(random, &at, cells);
            paths_of_slip(random, &at, &rule);
            let law = at.past[0].law_at(at.scene, at.load.stage);
            let contact = Contact::new(at.scene, (at.now, at.past[0]), (at.load, &law, &rule));
            what_is_asked(random, &contact, (at.scene, contact_cells));
            let after = After::new(at.scene, [at.now, at.past[0]], (&law, &rule));
            what_follows(random, &after, (at.scene, contact_cells));
            equations(random, &contact, operators, cells);
        });
    }
    assert!(kinds.iter().all(|kind| *kind > 10), "cells that slipped, stuck, were open: {kinds:?}");
}

fn loads(random: &mut Random, at: &At<'_>, cells: usize) {
    let before = change(random, cells);
    let numbers: [f64; FREEDOMS] = array(random);
    let mut next = no_change(cells);
    at.load.forward(&before, &numbers, &mut next);
    let y = change(random, cells);
    let only_loads = Change { start: y.start, held: y.held, from: y.from, load: y.load, ..no_change(cells) };
    let (mut back, mut of_numbers) = (no_change(cells), [0.0; FREEDOMS]);
    at.load.transposed(&only_loads, &mut back, &mut of_numbers);
    let backward = of_changes(&back, &before) + dot(&of_numbers, &numbers);
    alike("loads", of_changes(&only_loads, &next), backward, 1e-12);
}

fn paths_of_slip(random: &mut Random, at: &At<'_>, rule: &Rule) {
    if rule.kinds() == [0; 3] {
        return;
    }
    let cells = at.scene.region.len();
    let [before, former, next] = [(); 3].map(|()| change(random, cells));
    let y = paths(random, at.now.contact.len());
    let forward = of_paths(&y, &rule.forward([&before, &former, &next]));
    let [mut to_before, mut to_former, mut to_next] = [(); 3].map(|()| no_change(cells));
    rule.transposed(y, [&mut to_before, &mut to_former, &mut to_next]);
    let pairs = [(&to_before, &before), (&to_former, &former), (&to_next, &next)];
    alike("paths", forward, pairs.map(|(a, b)| of_changes(a, b)).iter().sum(), 1e-12);
}

fn what_is_asked(random: &mut Random, contact: &Contact<'_>, (scene, contact_cells): (&Scene<'_>, usize)) {
    let cells = scene.region.len();
    let [before, next] = [(); 2].map(|()| change(random, cells));
    let (of_paths_in, mut of_drive) = (paths(random, contact_cells), drive(random, scene));
    of_drive.friction = Drive::none(scene).friction;
    let asked = contact.asked(&before, &next, (&of_paths_in, &of_drive));
    let mut y = Asked { displacements: fields(random, contact_cells), amounts: array(random) };
    for (place, cell) in contact.cells.iter().enumerate() {
        if cell.row().is_some() {
            y.displacements[2][place] = 0.0; // there is one row across the shear
        }
    }
    let forward = of_fields(&y.displacements, &asked.displacements) + dot(&y.amounts, &asked.amounts);
    let [mut to_before, mut to_next] = [(); 2].map(|()| no_change(cells));
    let (mut to_paths, mut to_drive) = (PathChange::none(contact_cells), Drive::none(scene));
    contact.asked_transposed(&y, [&mut to_before, &mut to_next], (&mut to_paths, &mut to_drive));
    let backward = of_changes(&to_before, &before)
        + of_changes(&to_next, &next)
        + of_paths(&to_paths, &of_paths_in)
        + of_drives(&to_drive, &of_drive);
    alike("asked", forward, backward, 1e-12);
    let (friction, tractions) = (drive(random, scene).friction, fields(random, contact_cells));
    let given = contact.given(&friction, cells).map(|field| contact.set.packed(&field));
    let mut back = Drive::none(scene).friction;
    if scene.evolves() {
        contact.given_transposed_in_cells(&tractions, &mut back);
    } else {
        back.everywhere = contact.given_transposed(&tractions);
    }
    let forward = dot(&given[0], &tractions[1]) + dot(&given[1], &tractions[2]);
    if contact.cells.iter().any(|cell| cell.along != [0.0; 2]) {
        let backward = dot(&back.everywhere, &friction.everywhere) + dot(&back.cells, &friction.cells);
        alike("given", forward, backward, 1e-12);
    }
}

fn what_follows(random: &mut Random, after: &After<'_>, (scene, contact_cells): (&Scene<'_>, usize)) {
    let cells = scene.region.len();
    let before = change(random, cells);
    let (of_paths_in, of_drive) = (paths(random, contact_cells), drive(random, scene));
    let solution = Solution {
        tractions: fields(random, cells),
        displacements: fields(random, cells),
        motions: array(random),
    };
    let mut next = no_change(cells);
    after.forward((&solution, &of_paths_in, &of_drive), &before, &mut next);
    let none = [0.0; FREEDOMS];
    let y = Change { start: none, held: none, from: none, load: none, ..change(random, cells) };
    let forward = of_changes(&y, &next);
    let (mut to_paths, mut to_drive) = (PathChange::none(contact_cells), Drive::none(scene));
    let mut to_before = no_change(cells);
    let back = after.transposed(&mut y.clone(), &mut to_before, (&mut to_paths, &mut to_drive));
    let backward = of_changes(&to_before, &before)
        + of_paths(&to_paths, &of_paths_in)
        + of_drives(&to_drive, &of_drive)
        + of_fields(&back.tractions, &solution.tractions)
        + of_fields(&back.displacements, &solution.displacements)
        + dot(&back.motions, &solution.motions);
    alike("after", forward, backward, 1e-12);
}

/// The equations and their approximate inverse, with the steps before and after them.
fn equations(random: &mut Random, contact: &Contact<'_>, operators: &mut Operators, cells: usize) {
    let set = (contact.set, &contact.cells[..]);
    let mut problem = Linearised::new(operators, set, contact.prescribed, cells).unwrap();
    let size = problem.len();
    let (x, y) = (vector(random, size), vector(random, size));
    let (mut forward, mut back) = (vec![0.0; size], vec![0.0; size]);
    problem.apply(&x, &mut forward);
    Transposed::of(&mut problem, contact).apply(&y, &mut back);
    alike("equations", dot(&y, &forward), dot(&back, &x), 1e-12);
    problem.invert(&x, &mut forward);
    Transposed::of(&mut problem, contact).invert(&y, &mut back);
    // The small matrix of the motions is inverted twice, by elimination.
    alike("approximate inverse", dot(&y, &forward), dot(&back, &x), 1e-9);
    let (asked, amounts) = (fields(random, contact.cells.len()), array::<MOTIONS>(random));
    let right = problem.right_side(&asked, &amounts);
    let (to_asked, to_amounts) = problem.right_side_transposed(&y);
    alike("right side", dot(&right, &y), of_fields(&to_asked, &asked) + dot(&to_amounts, &amounts), 1e-12);
    let (tractions, motions) = problem.parted(&x);
    let mut counts = Solution {
        tractions: fields(random, cells),
        displacements: super::fields::zeros(cells),
        motions: array(random),
    };
    let (unknowns, _) = problem.left_of(&counts, &vec![0.0; size]);
    let forward = of_fields(&counts.tractions, &tractions) + dot(&counts.motions, &motions);
    alike("tractions", forward, dot(&unknowns, &x), 1e-12);
    // Of what displacements count on the whole region, multipliers take off what they make of it.
    counts.displacements = fields(random, cells);
    let mut multipliers = y;
    multipliers[size - MOTIONS..].fill(0.0);
    let (left, _) = problem.left_of(&counts, &multipliers);
    Transposed::of(&mut problem, contact).apply(&multipliers, &mut back);
    let displaced = problem.operators.displacements(&tractions);
    let forward = forward + of_fields(&counts.displacements, &displaced);
    alike("what is left", forward, dot(&left, &x) + dot(&back, &x), 1e-12);
}

/// What an increment is made from: what the two before it left, what it depends on by a number, its controls.
struct Made {
    before: Change,
    former: Change,
    drive: Drive,
    numbers: [f64; FREEDOMS],
}

impl Made {
    fn none(scene: &Scene<'_>) -> Self {
        let [before, former] = [(); 2].map(|()| no_change(scene.region.len()));
        Self { before, former, drive: Drive::none(scene), numbers: [0.0; FREEDOMS] }
    }

    fn random(random: &mut Random, scene: &Scene<'_>) -> Self {
        let [before, former] = [(); 2].map(|()| change(random, scene.region.len()));
        Self { before, former, drive: drive(random, scene), numbers: array(random) }
    }

    fn times(&self, other: &Self) -> f64 {
        of_changes(&self.before, &other.before)
            + of_changes(&self.former, &other.former)
            + of_drives(&self.drive, &other.drive)
            + dot(&self.numbers, &other.numbers)
    }

    /// One of its blocks alone.
    fn only(&self, block: usize, scene: &Scene<'_>) -> Self {
        let mut found = Self::none(scene);
        let count = BLOCKS.len();
        match block {
            at if at < count => (BLOCKS[at].1)(&mut found.before, &self.before),
            at if at < 2 * count => (BLOCKS[at - count].1)(&mut found.former, &self.former),
            at => match at - 2 * count {
                0 => found.drive.gap.clone_from(&self.drive.gap),
                1 => found.drive.friction.clone_from(&self.drive.friction),
                2 => found.drive.rig = self.drive.rig,
                3 => found.drive.wear = self.drive.wear,
                4 => found.drive.strain = self.drive.strain,
                5 => found.drive.response.clone_from(&self.drive.response),
                6 => found.drive.layers.clone_from(&self.drive.layers),
                _ => found.numbers = self.numbers,
            },
        }
        found
    }
}

/// Copies one block of a change.
type Copies = fn(&mut Change, &Change);

/// The blocks of a change.
const BLOCKS: [(&str, Copies); 21] = [
    ("pressure", |to, of| to.pressure.clone_from(&of.pressure)),
    ("shear", |to, of| to.shear.clone_from(&of.shear)),
    ("gap", |to, of| to.gap.clone_from(&of.gap)),
    ("slid", |to, of| to.slid.clone_from(&of.slid)),
    ("drift", |to, of| to.drift.clone_from(&of.drift)),
    ("slip", |to, of| to.slip.clone_from(&of.slip)),
    ("worn", |to, of| to.worn.clone_from(&of.worn)),
    ("collected", |to, of| to.collected.clone_from(&of.collected)),
    ("debris", |to, of| to.debris.clone_from(&of.debris)),
    ("path", |to, of| to.path.clone_from(&of.path)),
    ("slipped", |to, of| to.slipped.clone_from(&of.slipped)),
    ("slipping", |to, of| to.slipping.clone_from(&of.slipping)),
    ("motions", |to, of| to.motions = of.motions),
    ("strain", |to, of| to.strain = of.strain),
    ("energies", |to, of| to.energies = of.energies),
    ("reached", |to, of| to.reached = of.reached),
    ("start", |to, of| to.start = of.start),
    ("held", |to, of| to.held = of.held),
    ("from", |to, of| to.from = of.from),
    ("load", |to, of| to.load = of.load),
    ("ratio", |to, of| to.ratio = of.ratio),
];
const OF_DRIVE: [&str; 8] =
    ["gap before deformation", "friction", "rig", "wear", "strain", "response", "layers", "controls"];

/// The whole of an increment, from every block of what it is made from to every block of what it leaves: each pair by its own size, which may be a
/// millionth of the largest. 1e-7 of that, and 1e-11 of all that the block leaves: the linear equations are solved to 1e-12 both ways.
#[test]
fn an_increment_goes_backwards_by_its_transpose_block_by_block() {
    let mut random = Random::seeded(42);
    let (mut pairs, mut smallest) = (0, f64::INFINITY);
    for text in [COUPLED, SIMILAR, WORN, &worn_through_layers()] {
        each_increment(text, |at, operators| {
            let cells = at.scene.region.len();
            let increment = Increment::new(at.scene, (at.snapshot.by_end_points, at.load), at.now, at.past);
            let mut equations = increment.equations(operators).unwrap();
            let (made, y) = (Made::random(&mut random, at.scene), change(&mut random, cells));
            let parts: Vec<Made> =
                (0..2 * BLOCKS.len() + OF_DRIVE.len()).map(|block| made.only(block, at.scene)).collect();
            let left: Vec<Change> = parts
                .iter()
                .map(|Made { before, former, drive, numbers }| {
                    let next = increment.forward(&mut equations, [before, former], (drive, numbers)).unwrap();
                    let next = if next.worn.is_empty() { next.of_wear(true) } else { next };
                    let next = if next.debris.is_empty() { next.of_debris(true) } else { next };
                    if next.slipped.is_empty() { next.of_evolution(true) } else { next }
                })
                .collect();
            for (to, copies) in BLOCKS {
                let of_block = |change: &Change| {
                    let mut found = no_change(cells);
                    copies(&mut found, change);
                    found
                };
                let (y, mut back) = (of_block(&y), Made::none(at.scene));
                let Made { before, former, drive, numbers } = &mut back;
                increment
                    .transposed(&mut equations, y.clone(), [before, former], (drive, numbers), &mut 0.0)
                    .unwrap();
                let norm = |change: &Change| of_changes(change, change).sqrt();
                for (from, (part, left)) in parts.iter().zip(&left).enumerate() {
                    let (forward, backward) = (of_changes(&y, left), back.times(part));
                    let (own, all) = (norm(&of_block(left)), norm(left));
                    let off = (forward - backward).abs() / norm(&y);
                    assert!(
                        off <= 1e-7 * own + 1e-11 * all,
                        "increment {}, from block {from} to {to}: {forward:e} {backward:e}, of {own:.1e} and {all:.1e}",
                        at.snapshot.record.increment
                    );
                    if own > 0.0 {
                        pairs += 1;
                        smallest = smallest.min(own / all);
                    }
                }
            }
        });
    }
    println!("{pairs} pairs of blocks, the smallest {smallest:.1e} of the largest");
    assert!(pairs > 1000, "{pairs}");
}
