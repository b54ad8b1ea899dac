use std::f64::consts::PI;

use super::*;
use crate::Case;
use crate::history::Concern::{
    ApproachOverContactRadius, ApproachOverLayerThickness, ComplianceSpread, ContactNearEdge,
    ContactRadiusOverBodyRadius, FewCells, FrictionChangesInOneCycle, PressingInFewIncrements,
    ShiftOverContactRadius, WearDepthOverCoatingThickness,
};
use crate::plan::{Coupling, ExpectedContact};
use crate::run::{Silent, Simulation};
use crate::solver::Regime;

/// A rigid shape on layers, cells of 0.1 by 0.2, cycles of shift at the end.
fn plan(lower: &str, profile: &str, loads: &str) -> Plan {
    let text = format!(
        "[grid]\ncells = [40, 20]\nsize = [4.0, 4.0]\n[upper]\nrigid = true\n[lower]\n{lower}\n{profile}\n\
         [friction]\ncoefficient = 0.5\n{loads}"
    );
    Plan::new(Case::from_toml(&text, "case.toml").unwrap()).unwrap()
}

const STEEL: &str = "substrate = { young = 1.0, poisson = 0.3 }";
const BALL: &str = "[profile.sphere]\nradius = 100.0";
const PRESS: &str = "[[load]]\nnormal_force = 0.01\nincrements = 1\n";

fn expecting(mut plan: Plan, half_widths: [f64; 2], approach: f64) -> Vec<(Concern, f64)> {
    plan.expected = Some(ExpectedContact { half_widths, approach });
    numbers(&of_plan(&plan))
}

fn numbers(warnings: &[Warning]) -> Vec<(Concern, f64)> {
    warnings.iter().map(|warning| (warning.name, warning.value)).collect()
}

/// The same concerns, and their numbers to rounding.
fn same(found: &[(Concern, f64)], exact: &[(Concern, f64)]) {
    assert!(
        found.len() == exact.len()
            && found.iter().zip(exact).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() <= 1e-14 * b.1.abs()),
        "{found:?}, not {exact:?}"
    );
}

#[test]
fn what_the_expected_contact_tells_is_in_its_own_lengths() {
    let ball = || plan(STEEL, BALL, PRESS);
    // cells of 0.1 by 0.2: 6 cells along y are 1.2, and a twentieth that the coarse grid may err by
    same(&expecting(ball(), [1.5, 1.5], 0.01), &[]);
    same(&expecting(ball(), [1.5, 1.0], 0.01), &[(FewCells, 1.05 * 1.0 / 0.2)]);
    same(&expecting(ball(), [0.5, 1.5], 0.01), &[(FewCells, 1.05 * 0.5 / 0.1)]);
    // contact over body radius, the larger of both axes; approach over the narrower half-width
    same(&expecting(ball(), [30.0, 15.0], 0.01), &[(ContactRadiusOverBodyRadius, 0.3)]);
    same(&expecting(ball(), [15.0, 30.0], 0.01), &[(ContactRadiusOverBodyRadius, 0.3)]);
    same(&expecting(ball(), [1.5, 3.0], 0.6), &[(ApproachOverContactRadius, 0.6 / 1.5)]);
    let barrel = || plan(STEEL, "[profile.ellipsoid]\nradius_x = 10.0\nradius_y = 100.0", PRESS);
    same(&expecting(barrel(), [3.0, 3.0], 0.01), &[(ContactRadiusOverBodyRadius, 0.3)]);
    same(&expecting(barrel(), [1.5, 15.0], 0.01), &[]);
}

#[test]
fn layers_on_a_rigid_base_are_strained_by_the_approach() {
    let layers = "coatings = [{ young = 1.0, poisson = 0.3, thickness = 0.5 }, { young = 2.0, poisson = 0.3, thickness = 1.5 }]";
    let on = |base: &str| plan(&format!("{layers}\n{base}"), BALL, PRESS);
    same(&expecting(on("base = \"rigid\""), [3.0, 3.0], 0.5), &[(ApproachOverLayerThickness, 0.25)]);
    same(&expecting(on("base = \"rigid\""), [3.0, 3.0], 0.3), &[]);
    same(&expecting(on(STEEL), [3.0, 3.0], 0.5), &[]);
}

#[test]
fn coatings_are_measured_by_the_longer_side_of_a_cell() {
    let film = |thickness: f64| {
        let film = format!("coatings = [{{ young = 2.0, poisson = 0.3, thickness = {thickness} }}]\n{STEEL}");
        let with = |more: &str| expecting(plan(&film, BALL, &format!("{PRESS}{more}")), [1.5, 1.5], 0.01);
        // Nobody asks for stresses inside.
        same(&with(""), &[]);
        with("[stress]\ndepths = [0.05]\n")
    };
    same(&film(0.2), &[]);
    same(&film(0.15), &[(Concern::CoatingThinnerThanCell, 0.75)]);
}

#[test]
fn moduli_are_told_by_that_of_diamond_where_their_unit_is_known() {
    // in mm and N moduli are in MPa; diamond 1.25e6
    let stiff = |lower: &str, units: &str| {
        let press = "[[load]]\nnormal_force = 13e3\nincrements = 1\n";
        expecting(plan(lower, BALL, &format!("{press}{units}")), [1.5, 1.5], 0.01)
    };
    let units = |length: &str| format!("[units]\nlength = \"{length}\"\nforce = \"N\"\n");
    let body = "substrate = { young = 1.3e6, poisson = 0.3 }";
    same(&stiff(body, &units("mm")), &[(Concern::StifferThanDiamond, 1.04)]);
    same(&stiff(&body.replace("1.3e6", "1.2e6"), &units("mm")), &[]);
    same(&stiff(body, &units("m")), &[]);
    same(&stiff(body, &units("in")), &[]);
    same(&stiff(body, ""), &[]);
    let coated = format!("coatings = [{{ young = 2.5e6, poisson = 0.3, thickness = 0.5 }}]\n{body}");
    same(&stiff(&coated, &units("mm")), &[(Concern::StifferThanDiamond, 2.0)]);
}

#[test]
fn the_largest_shift_of_any_stage_counts() {
    let loads = format!(
        "{PRESS}[[load]]\nshift = [0.3, 0.4]\nincrements = 2\n[[load]]\nshift = [0.0, 0.0]\nincrements = 2\n"
    );
    let shifted = || plan(STEEL, BALL, &loads);
    // over the radius of a circle of the same area as the ellipse
    same(&expecting(shifted(), [1.25, 1.8], 0.01), &[(Concern::ShiftOverContactRadius, 0.5 / 1.5)]);
    same(&expecting(shifted(), [5.0, 5.0], 0.01), &[]);
    let forced = format!("{PRESS}[[load]]\ntangential_force = [0.003, 0.0]\nincrements = 2\n");
    same(&expecting(plan(STEEL, BALL, &forced), [1.25, 1.8], 0.01), &[]);
}

#[test]
fn slopes_of_topography_are_root_mean_squares_over_the_cells() {
    let rows = |height: &dyn Fn(usize, usize) -> f64| {
        let rows: Vec<Vec<f64>> = (0..4).map(|i| (0..5).map(|j| height(i, j)).collect()).collect();
        let text = format!(
            "[grid]\ncells = [4, 5]\nsize = [0.4, 1.0]\nperiodic = true\n[upper]\nrigid = true\n[lower]\n{STEEL}\n\
             [profile.heights]\nvalues = {rows:?}\n{PRESS}"
        );
        steepest(&Plan::new(Case::from_toml(&text, "case.toml").unwrap()).unwrap())
    };
    // a plane: 0.03 in 0.1 along x, 0.08 in 0.2 along y
    let plane = rows(&|i, j| 0.03 * i as f64 + 0.08 * j as f64);
    assert!((plane - 0.5).abs() < 1e-14, "{plane}");
    // a step of 0.3 across one of three rows of squares, of slope 3
    let step = rows(&|i, _| if i < 2 { 0.0 } else { 0.3 });
    assert!((step - 3.0_f64.sqrt()).abs() < 1e-14, "{step}");
    assert_eq!(steepest(&plan(STEEL, BALL, PRESS)), 0.0);
}

/// A record with round numbers, to be changed: a contact of radius 1 and of 10 cells in it, with nothing to warn of.
fn record(plan: &Plan) -> StepRecord {
    let mut step = Simulation::new(plan).run(&mut Silent).unwrap().steps[0].clone();
    step.contact_area = PI;
    step.contact_cells = 314;
    step.footprint.radius = Some(10.0);
    step.footprint.free = 5;
    step.approach = 0.01;
    step.shift = [0.0; 2];
    step.parts = 1;
    step.max_worn_depth = 0.0;
    step
}

type Told = (Concern, f64, Option<String>);

/// One concern with its number, to rounding, and its stage.
fn told(found: &[Told], name: Concern, value: f64, stage: &str) {
    assert!(
        matches!(found, [(concern, number, Some(place))]
            if *concern == name && (number - value).abs() <= 1e-14 * value && place == stage),
        "{found:?}, not {name:?} {value} in {stage}"
    );
}

fn gauged(plan: &Plan, steps: &[StepRecord]) -> Vec<Told> {
    let mut gauge = Gauge::of(plan);
    for step in steps {
        gauge.add(step);
    }
    gauge.warnings(plan).into_iter().map(|warning| (warning.name, warning.value, warning.stage)).collect()
}

/// Three named stages on a rigid base, without coupling between pressure and shear but for what the case says.
fn staged(lower: &str) -> Plan {
    plan(
        lower,
        BALL,
        "[[load]]\nname = \"press\"\nnormal_force = 0.01\nincrements = 2\n[[load]]\nname = \"pull\"\n\
         tangential_force = [0.001, 0.0]\nincrements = 2\n[[load]]\nname = \"rest\"\ntangential_force = [0.0, 0.0]\nincrements = 1\n",
    )
}

#[test]
fn the_worst_end_of_a_stage_is_told_with_its_stage() {
    let plan = staged("substrate = { young = 1.0, poisson = 0.5 }");
    assert_ne!(plan.coupling, Coupling::Coupled);
    let good = record(&plan);
    let at = |stage: usize, change: &dyn Fn(&mut StepRecord)| {
        let mut step = StepRecord { stage, ..good.clone() };
        change(&mut step);
        step
    };
    let plain = |stage: usize| at(stage, &|_| {});
    assert!(gauged(&plan, &[plain(0), plain(0), plain(1), plain(2)]).is_empty());
    let few = |stage: usize, cells: f64| at(stage, &move |step| step.footprint.radius = Some(cells));
    // the fewest cells of the ends of stages; on the way there may be fewer
    let steps = [few(0, 5.0), few(0, 4.0), few(1, 3.0), few(2, 5.0)];
    told(&gauged(&plan, &steps), FewCells, 3.0, "pull");
    told(&gauged(&plan, &[few(0, 3.0), few(0, 5.5), plain(1)]), FewCells, 5.5, "press");
    assert!(gauged(&plan, &[plain(0), at(1, &|step| step.footprint.radius = None)]).is_empty());
    let free = |stage: usize, free: usize| at(stage, &move |step| step.footprint.free = free);
    told(&gauged(&plan, &[free(0, 2), free(1, 1), free(2, 0)]), ContactNearEdge, 0.0, "rest");
    assert!(gauged(&plan, &[free(0, 2), free(1, 2)]).is_empty());
    let deep = |stage: usize, approach: f64| at(stage, &move |step| step.approach = approach);
    told(&gauged(&plan, &[deep(0, 0.5), deep(1, 0.25)]), ApproachOverContactRadius, 0.5, "press");
    // a circle of area 900 pi has the radius 30, on a ball of 100
    let wide = at(1, &|step| step.contact_area = 900.0 * PI);
    told(&gauged(&plan, &[plain(0), wide]), ContactRadiusOverBodyRadius, 0.3, "pull");
    // shifts count wherever they are met, over the radius there
    let shifted = |stage: usize, shift: [f64; 2]| at(stage, &move |step| step.shift = shift);
    let steps = [plain(0), shifted(1, [0.3, 0.4]), shifted(1, [0.0, 0.25]), plain(2)];
    told(&gauged(&plan, &steps), ShiftOverContactRadius, 0.5, "pull");
    let small = at(1, &|step| (step.shift, step.contact_area) = ([0.3, 0.4], 100.0 * PI));
    assert!(gauged(&plan, &[plain(0), small]).is_empty());
    // bodies apart have no radius, whatever their shift is
    let apart = at(1, &|step| {
        (step.contact_cells, step.contact_area, step.footprint.radius) = (0, 0.0, None);
        (step.footprint.free, step.approach, step.shift) = (0, -1.0, [9.0, 0.0]);
    });
    assert!(gauged(&plan, &[plain(0), apart]).is_empty());
}

#[test]
fn approach_of_layers_and_wear_of_coatings_are_measured_by_their_thickness() {
    let layer = "coatings = [{ young = 1.0, poisson = 0.3, thickness = 2.0 }]\nbase = \"rigid\"";
    let plan = staged(layer);
    let good = record(&plan);
    let deep = StepRecord { approach: 0.5, contact_area: 100.0 * PI, ..good.clone() };
    let names: Vec<_> =
        gauged(&plan, &[deep]).into_iter().filter(|found| found.0 != PressingInFewIncrements).collect();
    told(&names, ApproachOverLayerThickness, 0.25, "press");
    let coated = staged(&format!("coatings = [{{ young = 2.0, poisson = 0.3, thickness = 0.5 }}]\n{STEEL}"));
    let worn = |depth: f64| {
        let last = StepRecord { stage: 1, max_worn_depth: depth, ..good.clone() };
        let found = gauged(&coated, &[good.clone(), last]);
        found.into_iter().filter(|found| found.0 == WearDepthOverCoatingThickness).collect::<Vec<_>>()
    };
    told(&worn(0.2), WearDepthOverCoatingThickness, 0.4, "pull");
    assert!(worn(0.1).is_empty());
}

#[test]
fn rings_are_counted_in_cells_and_in_parts_where_pressure_and_shear_are_coupled() {
    let coupled = staged(STEEL);
    assert_eq!(coupled.coupling, Coupling::Coupled);
    let uncoupled = staged("substrate = { young = 1.0, poisson = 0.5 }");
    let good = record(&coupled);
    // contacts of radii in cells of 0.1 by 0.2, whose shear is 0.4 of what friction allows
    let cells = |radius: f64, parts: usize| StepRecord {
        contact_area: PI * radius * radius * 0.1 * 0.2,
        parts,
        max_pressure: 1.0,
        friction_coefficient: 0.5,
        max_shear: 0.2,
        regime: Regime::PartialSlip,
        ..good.clone()
    };
    let ring = |plan: &Plan, steps: &[StepRecord]| {
        let found = gauged(plan, steps);
        found.iter().find(|found| found.0 == PressingInFewIncrements).map(|found| found.1)
    };
    // rounding of roots
    let near = |found: Option<f64>, exact: f64| {
        let found = found.unwrap();
        assert!((found - exact).abs() < 1e-12, "{found}, not {exact}");
    };
    let grows = [cells(20.0, 30), cells(23.0, 1), cells(25.0, 1)];
    near(ring(&coupled, &grows), 3.0);
    assert_eq!(ring(&uncoupled, &grows), None);
    // four parts make less than a cell each
    assert_eq!(ring(&coupled, &[cells(20.0, 30), cells(23.0, 4), cells(25.0, 3)]), None);
    near(ring(&coupled, &[cells(20.0, 30), cells(26.0, 2)]), 3.0);
    // shrinking leaves none, and a contact that was lost begins anew
    assert_eq!(ring(&coupled, &[cells(20.0, 30), cells(15.0, 1)]), None);
    let apart = StepRecord { contact_cells: 0, contact_area: 0.0, ..good.clone() };
    assert_eq!(ring(&coupled, &[cells(20.0, 30), apart, cells(25.0, 1)]), None);
    // the first increment is a ring of its own when it makes more than half of the largest radius
    near(ring(&coupled, &[cells(11.0, 1), cells(20.0, 100)]), 11.0);
    assert_eq!(ring(&coupled, &[cells(9.0, 1), cells(20.0, 20)]), None);
    assert_eq!(ring(&coupled, &[cells(15.0, 2), cells(20.0, 20)]), None);
    // but not of a run that was resumed
    let later = StepRecord { increment: 7, ..cells(11.0, 1) };
    assert_eq!(ring(&coupled, &[later, cells(20.0, 100)]), None);
    // on fine grids a sixteenth of the radius is the bound
    assert_eq!(ring(&coupled, &[cells(60.0, 100), cells(63.9, 1), cells(64.0, 1)]), None);
    near(ring(&coupled, &[cells(60.0, 100), cells(65.0, 1), cells(64.0, 1)]), 5.0);
}

#[test]
fn rings_that_change_nothing_are_not_told_of() {
    let coupled = staged(STEEL);
    let good = record(&coupled);
    let grown = |radius: f64, shear: f64, regime: Regime| StepRecord {
        contact_area: PI * radius * radius * 0.1 * 0.2,
        max_pressure: 1.0,
        friction_coefficient: 0.5,
        max_shear: shear,
        regime,
        ..good.clone()
    };
    let told_of = |plan: &Plan, steps: &[StepRecord]| {
        gauged(plan, steps).iter().any(|found| found.0 == PressingInFewIncrements)
    };
    let pressed = [grown(10.0, 0.2, Regime::PartialSlip), grown(20.0, 0.2, Regime::PartialSlip)];
    assert!(told_of(&coupled, &pressed));
    // sliding as a whole wipes them out; what grows afterwards counts again
    let slid = [&pressed[..], &[grown(20.0, 0.5, Regime::GrossSlip)]].concat();
    assert!(!told_of(&coupled, &slid));
    assert!(told_of(&coupled, &[&slid[..], &[grown(23.0, 0.2, Regime::PartialSlip)]].concat()));
    // shear by pressing of less than a fifth of what friction allows
    assert!(!told_of(&coupled, &pressed.clone().map(|step| StepRecord { max_shear: 0.09, ..step })));
    // flats touch at once: 1.2 is 8.5 cells of 0.1 by 0.2
    let on = |profile: &str| {
        plan(STEEL, profile, "[[load]]\nname = \"press\"\nnormal_force = 0.01\nincrements = 2\n")
    };
    let flat = on("[profile.flat_punch]\nradius = 1.2");
    let rounded = on("[profile.rounded_punch]\nflat_radius = 1.2\nedge_radius = 100.0");
    let steps = |radii: [f64; 2]| radii.map(|radius| grown(radius, 0.2, Regime::PartialSlip));
    assert!(!told_of(&flat, &steps([8.5, 8.5])) && !told_of(&flat, &steps([4.0, 8.5])));
    assert!(!told_of(&rounded, &steps([8.5, 9.4])) && told_of(&rounded, &steps([8.5, 11.0])));
    // what the program divides has a bound of its own
    let auto = plan(STEEL, BALL, "[[load]]\nname = \"press\"\nnormal_force = 0.01\nincrements = \"auto\"\n");
    assert!(!told_of(&auto, &pressed));
}

#[test]
fn cycles_tell_the_largest_change_of_friction_and_spread_of_compliance() {
    let loads = format!("{PRESS}[[load]]\nname = \"rub\"\nshift = [1e-3, 0.0]\ncycles = 1\nincrements = 4\n");
    let plan = plan("substrate = { young = 1.0, poisson = 0.5 }", BALL, &loads);
    let cycle = Simulation::new(&plan).run(&mut Silent).unwrap().cycles[0].clone();
    let gauged = |cycles: &[CycleRecord]| {
        let mut gauge = Gauge::of(&plan);
        for cycle in cycles {
            gauge.add_cycle(cycle);
        }
        let found = gauge.warnings(&plan);
        found.into_iter().map(|warning| (warning.name, warning.value, warning.stage)).collect::<Vec<Told>>()
    };
    let friction = |change: f64, stands_for: usize| CycleRecord {
        friction_coefficient: 0.5,
        friction_change: Some(change),
        compliance_spread: None,
        stands_for,
        ..cycle.clone()
    };
    let cycles = [friction(0.01, 1), friction(0.1, 1), friction(0.075, 1)];
    told(&gauged(&cycles), FrictionChangesInOneCycle, 0.2, "rub");
    assert!(gauged(&[friction(0.04, 1), friction(0.2, 2)]).is_empty());
    let spread =
        |spread: f64| CycleRecord { friction_change: None, compliance_spread: Some(spread), ..cycle.clone() };
    told(&gauged(&[spread(0.15), spread(0.3), spread(0.2)]), ComplianceSpread, 0.3, "rub");
    assert!(gauged(&[spread(0.1), spread(0.05)]).is_empty());
}

#[test]
fn contacts_that_are_not_round_have_no_one_radius() {
    let round = |profile: &str| is_round(&plan(STEEL, profile, PRESS));
    assert!(round(BALL));
    assert!(round("[profile.ellipsoid]\nradius_x = 100.0\nradius_y = 51.0"));
    assert!(round("[profile.ellipsoid]\nradius_x = 51.0\nradius_y = 100.0"));
    assert!(!round("[profile.ellipsoid]\nradius_x = 100.0\nradius_y = 49.0"));
    assert!(!round("[profile.ellipsoid]\nradius_x = 49.0\nradius_y = 100.0"));
    assert!(!round("[profile.flat_punch]\nradius = 1.0"));
}

#[test]
fn on_a_rough_surface_the_approach_has_no_radius_to_be_compared_with() {
    let body = "substrate = { young = 1.0, poisson = 0.5 }";
    let height = |i: usize, j: usize| -0.01 * ((i as f64 - 19.5).powi(2) + 4.0 * (j as f64 - 9.5).powi(2));
    let rows: Vec<Vec<f64>> = (0..40).map(|i| (0..20).map(|j| height(i, j)).collect()).collect();
    let rough = plan(body, &format!("[profile.heights]\nvalues = {rows:?}"), PRESS);
    for (plan, tells) in [(&plan(body, BALL, PRESS), true), (&rough, false)] {
        let found = gauged(plan, &[StepRecord { approach: 0.5, ..record(plan) }]);
        assert_eq!(found.iter().any(|(name, ..)| *name == ApproachOverContactRadius), tells, "{found:?}");
    }
}
