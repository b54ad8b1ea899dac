//! A run that is resumed after any of its increments has the bits of the unbroken one: within a cycle, between cycles, with
//! wear, and where a stage or the whole history ends early. The judge is the unbroken run, compared exactly.

use std::ops::ControlFlow;

use fret_core::case::Case;
use fret_core::history::{History, Start, StepRecord};
use fret_core::plan::{LeaveOut, Plan, Simplification};
use fret_core::run::{Checkpoint, CheckpointError, Observer, RunError, Silent, Simulation, Waypoint};

/// Pressed with 1 N: contact radius 32e-6, approach 0.1e-6.
const HEAD: &str = r#"
[grid]
cells = [16, 14]
size = [160e-6, 140e-6]
[upper]
rigid = true
[lower]
substrate = { young = 210e9, poisson = 0.3 }
[profile.sphere]
radius = 10e-3
[friction]
coefficient = 0.2
[output]
fields = ["pressure", "shear", "slip", "gap", "zone", "worn_depth"]
every = 3
[[load]]
normal_force = 1.0
increments = 3
"#;

/// Rubbed in two directions, with controls that change their kind.
const TURNED: &str = r"
[[load]]
tangential_force = [0.1, 0.05]
cycles = 1
increments = 8
[[load]]
shift = [30e-9, 0.0]
increments = 3
";

/// Cycles, each computed one for up to four, then a stage without cycles and an unloading that starts on coarse grids.
const WORN: &str = r"
[[load]]
shift = [60e-9, 0.0]
increments = 6
cycles = 14
[[load]]
shift = [30e-9, 20e-9]
increments = 3
[[load]]
normal_force = 0.3
increments = 2
[wear]
coefficient = 2e-11
every = 4
largest_step = 0.1
";

/// The second stage ends when it is steady; the last one prescribes an approach where there was a force.
const STEADY: &str = r"
[[load]]
tangential_force = [0.15, 0.0]
increments = 6
until_steady = { tolerance = 5e-3, most_cycles = 12 }
[[load]]
shift = [40e-9, 10e-9]
increments = 3
[[load]]
approach = 60e-9
increments = 2
";

fn plan(text: &str) -> Plan {
    Plan::new(Case::from_toml(text, "case.toml").unwrap()).unwrap()
}

fn coated() -> String {
    HEAD.replace("[lower]\n", "[lower]\ncoatings = [{ thickness = 20e-6, young = 400e9, poisson = 0.25 }]\n")
}

/// Pulled along x alone, on a coating or between elastically similar bodies: a half and a quarter of the grid are solved.
fn mirrored(loads: &str) -> [(String, usize); 2] {
    let alike = HEAD.replace("rigid = true", "substrate = { young = 210e9, poisson = 0.3 }");
    [(coated(), 2), (alike, 4)].map(|(head, copies)| {
        let head = head.replace("[16, 14]", "[16, 16]").replace("140e-6", "160e-6");
        let text = head + &loads.replace("0.1, 0.05]", "0.1, 0.0]").replace("30e-9, 20e-9]", "30e-9, 0.0]");
        assert_eq!(plan(&text).symmetry.copies(), copies);
        (text, copies)
    })
}

/// Keeps the bytes of every waypoint.
struct Keeper(Vec<Vec<u8>>);

impl Observer for Keeper {
    fn reached(&mut self, waypoint: &Waypoint<'_>) -> ControlFlow<()> {
        let mut bytes = Vec::new();
        waypoint.write(&mut bytes).unwrap();
        self.0.push(bytes);
        ControlFlow::Continue(())
    }
}

fn timeless(steps: &[StepRecord]) -> Vec<StepRecord> {
    steps.iter().map(|step| StepRecord { wall_s: 0.0, ..step.clone() }).collect()
}

/// Runs a case, and what is left of it after each increment; the unbroken history.
fn resumed_anywhere(text: &str) -> History {
    let plan = plan(text);
    let simulation = Simulation::new(&plan);
    let mut keeper = Keeper(Vec::new());
    let whole = simulation.run(&mut keeper).unwrap();
    assert_eq!(keeper.0.len(), whole.steps.len());
    for (increment, bytes) in keeper.0.iter().enumerate() {
        let checkpoint = Checkpoint::read(bytes, &plan).unwrap();
        assert_eq!(checkpoint.solved(), increment + 1);
        let rest = simulation.resume(checkpoint, &mut Silent).unwrap();
        assert_eq!(timeless(&rest.steps), timeless(&whole.steps[increment + 1..]), "after {increment}");
        let later = whole.cycles.iter().filter(|cycle| cycle.last_increment > increment);
        assert_eq!(rest.cycles, later.cloned().collect::<Vec<_>>(), "after {increment}");
        let later = whole.fields.iter().filter(|kept| kept.increment > increment);
        assert_eq!(rest.fields, later.cloned().collect::<Vec<_>>(), "after {increment}");
        assert_eq!(rest.state, whole.state, "after {increment}");
        assert_eq!(rest.worn_through, whole.worn_through, "after {increment}");
    }
    whole
}

#[test]
fn with_controls_that_change_their_kind() {
    assert_eq!(resumed_anywhere(&(coated() + TURNED)).steps.len(), 3 + 8 + 3);
}

/// Driven at the far end of springs along, across and into the surface.
#[test]
fn behind_a_machine_that_gives() {
    let driven = "[rig]\ntangential_stiffness = [2e6, 3e6]\nnormal_stiffness = 8e6\n[[load]]\nactuator_approach = 0.4e-6\n\
        increments = 2\n[[load]]\nactuator = [80e-9, 30e-9]\ncycles = 2\nincrements = 6\n[[load]]\ntangential_force = [0.05, 0.0]\nincrements = 2\n";
    for head in [HEAD.to_owned(), coated()] {
        let whole = resumed_anywhere(&(head + driven));
        assert_eq!(whole.steps.len(), 3 + 2 + 12 + 2);
        let rubbed = &whole.steps[3 + 2 + 8];
        assert!(rubbed.actuator[0] != rubbed.shift[0] && rubbed.dissipated_energy > 0.0, "the springs give");
    }
}

/// Surfaces that yield while they are pressed, and again under a larger force: of bodies that couple and of bodies that do not.
#[test]
fn with_surfaces_that_yield() {
    let more = "[[load]]\nnormal_force = 0.2\nincrements = 1\n[[load]]\nnormal_force = 1.3\nincrements = 2\n";
    for (head, name) in [
        (HEAD.replace("rigid = true", "substrate = { young = 210e9, poisson = 0.3 }"), "alike"),
        (coated(), "coated"),
    ] {
        let head = head
            .replace("[lower]\n", "[lower]\nhardness = 250e6\n")
            .replace("\"worn_depth\"", "\"plastic_depth\"");
        let whole = resumed_anywhere(&(head + TURNED + more));
        let volumes: Vec<f64> = whole.steps.iter().map(|step| step.plastic.volume).collect();
        println!("{name}: plastic volumes {volumes:?}");
        assert!(volumes[2] > 0.0 && volumes.last() > volumes.get(2), "{volumes:?}");
        assert!(whole.state.plastic_depth.is_some());
    }
}

#[test]
fn with_wear_in_blocks_of_cycles() {
    for head in [HEAD.to_owned(), coated()] {
        let whole = resumed_anywhere(&(head + WORN));
        let blocks: Vec<usize> = whole.cycles.iter().map(|cycle| cycle.stands_for).collect();
        assert_eq!(blocks, [4, 4, 4, 2], "the case shall have blocks of more than one cycle");
        let worn = whole.cycles.iter().map(|cycle| cycle.worn_volume).collect::<Vec<_>>();
        assert!(worn.windows(2).all(|pair| 0.0 < pair[0] && pair[0] < pair[1]), "{worn:?}");
        assert_eq!(whole.steps.len(), 3 + 4 * 6 + 3 + 2);
    }
}

/// A coating that wears thinner, through into the substrate, in jumps of bounded error.
#[test]
fn with_layers_that_wear_thinner() {
    let head = coated()
        .replace(
            "thickness = 20e-6, young = 400e9, poisson = 0.25",
            "thickness = 5e-10, young = 400e9, poisson = 0.25, wear_coefficient = 2e-11",
        )
        .replace(
            "substrate = { young = 210e9, poisson = 0.3 }",
            "substrate = { young = 210e9, poisson = 0.3, wear_coefficient = 4e-11 }",
        );
    let loads = WORN.replace("coefficient = 2e-11\nevery = 4", "tolerance = 0.3\nthinning_tolerance = 0.1");
    let whole = resumed_anywhere(&(head + &loads));
    let blocks: Vec<usize> = whole.cycles.iter().map(|cycle| cycle.stands_for).collect();
    assert!(blocks.iter().any(|block| *block > 1), "{blocks:?}");
    let layers = &whole.worn_by_layer.as_ref().unwrap().lower;
    assert!(layers.iter().all(|volume| *volume > 0.0), "{layers:?} {blocks:?} {:?}", whole.state.worn_depth);
    assert!(whole.cycles.iter().all(|cycle| cycle.compliance_spread.is_some()));
}

/// Surfaces that move with their bodies, by shifts and where a force pushes them; both wear, through a coating that becomes thinner, under
/// friction that evolves.
#[test]
fn with_surfaces_that_move() {
    let head = coated()
        .replace("rigid = true", "rigid = true\nwear_coefficient = 5e-14")
        .replace(
            "thickness = 20e-6, young = 400e9, poisson = 0.25",
            "thickness = 5e-10, young = 400e9, poisson = 0.25, wear_coefficient = 1e-13",
        )
        .replace(
            "substrate = { young = 210e9, poisson = 0.3 }",
            "substrate = { young = 210e9, poisson = 0.3, wear_coefficient = 2e-13 }",
        )
        .replace(
            "coefficient = 0.2\n",
            "coefficient = 0.2\nevolution = { by = \"energy\", last = 0.6, scale = 500.0, every = 3, tolerance = 0.2 }\n",
        )
        .replace("[friction]", "[kinematics]\ndisplacement = \"finite\"\n[friction]");
    let loads = WORN
        .replace("coefficient = 2e-11\nevery = 4", "tolerance = 0.3\nthinning_tolerance = 0.1")
        .replace("[60e-9, 0.0]", "[15e-6, 5e-6]")
        .replace("[30e-9, 20e-9]", "[5e-6, 2e-6]")
        .replace("[wear]", "[[load]]\ntangential_force = [0.02, 0.0]\nincrements = 2\n[wear]");
    let whole = resumed_anywhere(&(head + &loads));
    let worn = whole.worn_by_layer.as_ref().unwrap();
    assert!(worn.lower.iter().chain(&worn.upper).all(|volume| *volume > 0.0), "{worn:?}");
    let kept = whole.fields.last().unwrap().own_worn_depth.as_ref().unwrap();
    assert_eq!(Some(&kept[1]), whole.state.upper_worn_depth.as_ref());
}

/// Debris that fills the gap and flows out, of wear by the distance from the rim, in jumps of bounded error; also of surfaces that move, and of a
/// part with symmetry reduction.
#[test]
fn with_debris_between_the_surfaces() {
    let third =
        "[wear.debris]\nfraction = 0.5\noutflow_length = 1e-6\n[wear.rim]\nwidth = 12e-6\ninterior = 0.3\n";
    let jumps =
        WORN.replace("coefficient = 2e-11\nevery = 4", "coefficient = 2e-11\ntolerance = 0.4") + third;
    let kept = |text: &str| text.replace("\"worn_depth\"", "\"worn_depth\", \"debris\"");
    let mut texts = vec![kept(HEAD) + &jumps];
    texts.extend(mirrored(&jumps).map(|(text, _)| kept(&text)));
    let moving = HEAD
        .replace("rigid = true", "rigid = true\nwear_coefficient = 5e-14")
        .replace("poisson = 0.3 }", "poisson = 0.3, wear_coefficient = 2e-13 }")
        .replace("[friction]", "[kinematics]\ndisplacement = \"finite\"\n[friction]");
    let far = jumps
        .replace("coefficient = 2e-11\n", "")
        .replace("[60e-9, 0.0]", "[15e-6, 5e-6]")
        .replace("[30e-9, 20e-9]", "[5e-6, 2e-6]")
        .replace("outflow_length = 1e-6", "outflow_length = 3e-4");
    texts.push(kept(&moving) + &far + "upper_interior = 0.1\n");
    for text in texts {
        let whole = resumed_anywhere(&text);
        let blocks: Vec<usize> = whole.cycles.iter().map(|cycle| cycle.stands_for).collect();
        assert!(blocks.iter().any(|block| *block > 1), "{blocks:?}");
        let last = whole.steps.last().unwrap();
        assert!(last.debris.volume > 0.0 && last.debris.outflow > 0.0);
        let kept = whole.fields.last().unwrap().debris.as_ref();
        assert_eq!(kept, whole.state.debris.as_ref());
    }
}

/// Back and forth with wear on a grid fixed to the bodies; far and steadily on one that goes with the contact.
#[test]
fn with_a_contact_that_rolls() {
    let loads = WORN.replace("shift = [60e-9, 0.0]", "roll = [15e-6, 5e-6]");
    let whole = resumed_anywhere(&(coated() + &loads));
    assert!(whole.steps.last().unwrap().worn_volume > 0.0);
    let head = coated().replace("[friction]", "[kinematics]\nframe = \"contact\"\n[friction]");
    let loads = "[[load]]\ntangential_force = [0.05, 0.0]\nincrements = 2\n[[load]]\nroll = [60e-6, 0.0]\nspin = 2.0\nincrements = 6\n\
                 [[load]]\nroll = \"steady\"\ntangential_force = [0.1, \"held\"]\nspin = 0.0\nincrements = 2\n";
    let whole = resumed_anywhere(&(head + loads));
    assert!(whole.steps.last().unwrap().creepage.unwrap()[0] > 0.0);
}

/// Friction that follows the energy of each cell in cycle jumps, with wear and without.
#[test]
fn with_friction_that_evolves() {
    let evolution = "coefficient = 0.2\nevolution = { by = \"energy\", last = 0.6, scale = 5.0, every = 3, tolerance = 0.2 }";
    for head in [HEAD.to_owned(), coated()] {
        let head = head
            .replace("coefficient = 0.2", evolution)
            .replace("\"worn_depth\"", "\"worn_depth\", \"friction\"");
        let unworn = WORN.split("[wear]").next().unwrap();
        for loads in [WORN, unworn] {
            let whole = resumed_anywhere(&(head.clone() + loads));
            let blocks: Vec<usize> = whole.cycles.iter().map(|cycle| cycle.stands_for).collect();
            assert!(blocks.iter().any(|block| *block > 1), "{blocks:?}");
            let friction: Vec<f64> = whole.cycles.iter().map(|cycle| cycle.friction_coefficient).collect();
            assert!(friction.windows(2).all(|pair| pair[0] < pair[1]), "{friction:?}");
        }
    }
}

#[test]
fn with_a_stage_that_ends_when_it_is_steady() {
    for head in [HEAD.to_owned(), coated()] {
        let whole = resumed_anywhere(&(head + STEADY));
        let computed = whole.cycles.len();
        assert!(whole.cycles[computed - 1].steady && (2..12).contains(&computed), "{computed} cycles");
        assert_eq!(whole.steps.len(), 3 + 6 * computed + 3 + 2);
    }
}

#[test]
#[ignore = "long: 7 s"]
fn with_increments_divided_by_the_program() {
    for head in [HEAD.to_owned(), coated()] {
        let text = (head + WORN).replace("increments = 3", "increments = \"auto\"");
        let whole = resumed_anywhere(&format!("[solver]\nhistory_tolerance = 0.02\n{text}"));
        assert!(
            whole.steps.iter().any(|step| step.parts > 2),
            "the case shall have increments of several parts"
        );
    }
}

#[test]
fn with_surfaces_that_are_worn_through() {
    let thin = WORN.to_owned() + "limit = 0.3e-9\n";
    let [(half, _), (quarter, _)] = mirrored(&thin);
    for text in [HEAD.to_owned() + &thin, half, quarter] {
        let whole = resumed_anywhere(&text);
        let worn = whole.worn_through.unwrap();
        assert_eq!((worn.stage, worn.increment + 1), (1, whole.steps.len()));
        assert!(worn.cycles < 14, "{worn:?}");
        let depth = whole.state.worn_depth.as_ref().unwrap();
        assert_eq!(depth.iter().copied().fold(0.0, f64::max), depth[worn.cell]);
        assert_eq!(worn.place, [0, 1].map(|axis| whole.grid.centre(axis, worn.cell[axis])));
    }
}

/// In front of mirrors, with wear and friction that evolves. What is told of the contact is whole: its fields are their own mirror images,
/// and those that are kept at the end are those of the last state.
#[test]
fn with_surfaces_that_change_in_front_of_mirrors() {
    let evolution = "coefficient = 0.2\nevolution = { by = \"energy\", last = 0.6, scale = 5.0, every = 3, tolerance = 0.2 }";
    for (text, copies) in mirrored(WORN) {
        let whole = resumed_anywhere(&text.replace("coefficient = 0.2", evolution));
        let symmetry = plan(&text).symmetry;
        assert!(symmetry.keeps_state(&whole.state), "{copies} parts");
        assert!(whole.state.is_sound([16, 16]) && whole.end.state.worn_depth == whole.state.worn_depth);
        let last = whole.fields.last().unwrap();
        for name in ["pressure", "shear_x", "shear_y", "slip_x", "slip_y"] {
            assert_eq!(last.field(name), whole.state.field(name), "{name}");
        }
        assert_eq!(last.zone.as_ref(), Some(&whole.state.zone));
        assert_eq!(last.worn_depth, whole.state.worn_depth);
        assert_eq!(last.gap.as_ref().unwrap().dim(), (16, 16));
        let (step, area) = (whole.steps.last().unwrap(), whole.grid.cell_area());
        let volume = last.worn_depth.as_ref().unwrap().sum() * area;
        assert!((step.worn_volume / volume - 1.0).abs() < 1e-12, "{} {volume}", step.worn_volume);
        let force = last.pressure.as_ref().unwrap().sum() * area;
        assert!((step.normal_force / force - 1.0).abs() < 1e-12, "{} {force}", step.normal_force);
    }
}

/// Stops a run after so many increments.
struct Stopper(usize);

impl Observer for Stopper {
    fn reached(&mut self, waypoint: &Waypoint<'_>) -> ControlFlow<()> {
        if waypoint.solved() < self.0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

/// The worn volume is the coefficient times the dissipated energy: at the end of a cycle, and within one, where what it has worn
/// so far is not yet taken off the surfaces of the run itself but is of the state that another history starts from.
#[test]
fn a_state_within_a_cycle_has_what_that_cycle_wore_so_far() {
    let [(half, _), (quarter, _)] = mirrored(WORN);
    for text in [HEAD.to_owned() + WORN, half, quarter] {
        let text = text.replace("every = 3", "every = 1").replace("every = 4", "every = 1");
        assert_states_hold_what_was_worn(&plan(&text.replace("cycles = 14", "cycles = 2")));
    }
}

fn assert_states_hold_what_was_worn(plan: &Plan) {
    let whole = Simulation::new(plan).run(&mut Silent).unwrap();
    let assert_worn = |history: &History, increment: usize| {
        let start = Start::of(history, increment).unwrap();
        let depth = start.solved.state.worn_depth.unwrap();
        let volume = depth.iter().sum::<f64>() * plan.grid.cell_area();
        let expected = 2e-11 * history.steps[increment].dissipated_energy;
        // Sums of hundreds of cells, in other orders.
        assert!((volume - expected).abs() <= 1e-12 * expected, "{increment}: {volume:e} {expected:e}");
        assert!(increment < 3 || volume > 0.0);
    };
    let all: Vec<usize> = (0..whole.steps.len()).collect();
    assert_eq!(Start::all_of(&whole), all);
    for increment in all {
        assert_worn(&whole, increment);
    }
    // A run that is stopped within a cycle has its last state too, and all before it.
    let (broken, outcome) = Simulation::new(plan).follow(Checkpoint::start(plan), &mut Stopper(3 + 6 + 4));
    assert_eq!(outcome, Err(RunError::Interrupted { increment: 13 }));
    assert_eq!(timeless(&broken.steps), timeless(&whole.steps[..13]));
    assert_eq!(broken.fields, whole.fields[..13]);
    assert_worn(&broken, 12);
    // So has its checkpoint, without what the solver remembers of the gap before.
    let mut keeper = Keeper(Vec::new());
    Simulation::new(plan).run(&mut keeper).unwrap();
    let stored = Checkpoint::start_of(&keeper.0[12], &plan.to_json()).unwrap();
    assert_eq!(stored, Start::of(&broken, 12).unwrap());
    let state = broken.state.worn_depth.as_ref().unwrap().sum();
    let start = Start::of(&broken, 12).unwrap().solved.state.worn_depth.unwrap().sum();
    assert!(state < start, "the cycle is not over: its wear is not taken off in the run itself");
}

#[test]
fn a_checkpoint_of_another_course_is_refused() {
    let mut keeper = Keeper(Vec::new());
    Simulation::new(&plan(&(HEAD.to_owned() + WORN))).run(&mut keeper).unwrap();
    let within_a_cycle = &keeper.0[5];
    let unworn = HEAD.to_owned() + WORN.split("[wear]").next().unwrap();
    for other in [unworn, HEAD.to_owned() + WORN.replace("cycles = 14\n", "").as_str()] {
        assert_eq!(Checkpoint::read(within_a_cycle, &plan(&other)), Err(CheckpointError::Foreign));
    }
    // Fields in front of a mirror are no fields of the whole grid.
    let [(half, _), _] = mirrored(WORN);
    Simulation::new(&plan(&half)).run(&mut keeper).unwrap();
    let everywhere = LeaveOut::all_but(Simplification::Mirror);
    let everywhere = Plan::leaving_out(Case::from_toml(&half, "case.toml").unwrap(), everywhere).unwrap();
    let in_front = keeper.0.last().unwrap();
    assert_eq!(Checkpoint::read(in_front, &everywhere), Err(CheckpointError::Foreign));
}

#[test]
fn bytes_that_are_no_checkpoint_of_the_case_are_refused() {
    let case = HEAD.to_owned() + TURNED;
    let mut keeper = Keeper(Vec::new());
    Simulation::new(&plan(&case)).run(&mut keeper).unwrap();
    let bytes = &keeper.0[5];
    for length in [0, 1, bytes.len() / 2, bytes.len() - 1] {
        let read = Checkpoint::read(&bytes[..length], &plan(&case));
        assert!(matches!(read, Err(CheckpointError::Damaged(_))), "{length} bytes");
    }
    let mut newer = bytes.clone();
    newer[0] = 99;
    assert_eq!(Checkpoint::read(&newer, &plan(&case)), Err(CheckpointError::Format { found: 99 }));
    for other in [case.replace("[16, 14]", "[14, 16]"), case.replacen("increments = 3", "increments = 2", 1)]
    {
        assert_eq!(Checkpoint::read(bytes, &plan(&other)), Err(CheckpointError::Foreign));
    }
}
