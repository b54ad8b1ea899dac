//! What is left out changes the work, never the answer: every shortcut against the same run without it, and against the run
//! that computes everything. `docs/developers/simplifications-measured.md` is the table of the same cases on finer grids.

use fret_core::case::Case;
use fret_core::plan::{LeaveOut, Plan, Simplification};
use fret_validation::Sphere;
use fret_validation::shortcuts::{TOLERANCE, cases, difference, solved};
use ndarray::Array2;

/// A residual of one tolerance leaves an error of the tractions of at most about a hundred: it is measured in the mean over the
/// cells, the error in the worst one.
const AGREES: f64 = 100.0 * TOLERANCE;

#[test]
fn leaving_out_changes_the_work_and_not_the_answer() {
    for case in cases(32) {
        let name = case.name;
        let short = solved(&case.text, LeaveOut::ALL).history;
        let full = solved(&case.text, LeaveOut::NONE).history;
        let everything = difference(&full, &short);
        assert!(everything < AGREES, "{name}: {everything:e}");
        // Read between the cells from pressure and gap: as far as these agree, in the last cells.
        for (one, other) in short.steps.iter().zip(&full.steps) {
            let off = one.contact_area - other.contact_area;
            assert!(
                off.abs() <= 1e-5 * other.contact_area,
                "{name}: area {off:e} of {:e}",
                other.contact_area
            );
        }
        let (least, most) = (short.work(), full.work());
        assert!(least.full_grid_convolutions < most.full_grid_convolutions, "{name}: {least:?} {most:?}");
        let Some(shortcut) = case.shortcut else {
            assert!(3.0 * least.full_grid_convolutions < most.full_grid_convolutions, "{name}");
            continue;
        };
        let without = solved(&case.text, LeaveOut::all_but(shortcut)).history;
        let alone = difference(&without, &short);
        println!("{name}: {shortcut:?} {alone:e}, all {everything:e}");
        assert!(alone < AGREES, "{name}: {alone:e}");
        let more = without.work();
        let increments = short.steps.len();
        let times = |factor: f64| factor * least.full_grid_convolutions < more.full_grid_convolutions;
        let [planned, planned_without] = [LeaveOut::ALL, LeaveOut::all_but(shortcut)].map(|leave_out| {
            let case = Case::from_toml(&case.text, "case.toml").unwrap();
            Plan::leaving_out(case, leave_out).unwrap()
        });
        match shortcut {
            // Nothing is approximated: the same numbers are reached by one convolution an increment more.
            Simplification::Pressure => {
                assert!(least.convolutions + 7 <= more.convolutions, "{name}: {least:?} {more:?}");
            }
            Simplification::Region => assert!(times(2.0), "{name}: {least:?} {more:?}"),
            // A convolution of a half or a quarter of the cells; pressure first and then shear, instead of both in every step.
            Simplification::Mirror | Simplification::Coupling => {
                assert!(times(1.6), "{name}: {least:?} {more:?}");
            }
            // No convolution of shear in any increment, and none of it to the bit.
            Simplification::Tangential => {
                assert!(least.convolutions + increments <= more.convolutions, "{name}: {least:?} {more:?}");
                assert_eq!(alone, 0.0, "{name}");
                assert!(short.fields.iter().flat_map(|kept| kept.shear.iter().flatten()).all(is_nothing));
            }
            // Other roundings, on a way as long: they may end Newton's method one iteration later in one of the eight increments, which is 2 %;
            // of the coated contact on 72, 80, 96, 112 cells a side 0 to 1.1 %. What it saves is half of the numbers' size.
            Simplification::Precision => {
                assert!(planned.single_precision && !planned_without.single_precision, "{name}");
                assert!(alone > 0.0, "{name}: no other digits");
                let most = 1.03 * more.full_grid_convolutions;
                assert!(least.full_grid_convolutions <= most, "{name}: {least:?} {more:?}");
            }
            // The same steps, each of one component less; that component holds roundings, which may end a Krylov iteration one step later.
            Simplification::Transverse => {
                assert!(planned.along == Some(0) && planned_without.along.is_none(), "{name}");
                let steps = [least, more].map(|work| work.convolutions as f64);
                assert!((steps[0] / steps[1] - 1.0).abs() < 0.02, "{name}: {least:?} {more:?}");
                assert!(
                    short.fields.iter().all(|kept| is_nothing(&kept.shear.as_ref().unwrap()[1])),
                    "{name}"
                );
            }
            // The same steps, but for coefficients of other roundings, which may end a Krylov iteration one step later; what it saves
            // is before them, and timed in `tests/examples/leaving_out.rs`.
            Simplification::LayeredResponse => {
                let steps = [least, more].map(|work| work.convolutions as f64);
                assert!((steps[0] / steps[1] - 1.0).abs() < 0.02, "{name}: {least:?} {more:?}");
            }
        }
    }
}

/// The numbers of surfaces that wear and whose friction evolves are those of the whole contact, with and without mirrors: a half is
/// solved with a coating, a quarter of elastically similar bodies.
#[test]
fn a_mirror_changes_no_number_of_surfaces_that_change() {
    let body = "substrate = { young = 1.0, poisson = 0.3 }";
    for (lower, copies) in [("coatings = [{ thickness = 0.3, young = 3.0, poisson = 0.25 }]\n", 2), ("", 4)] {
        let text = format!(
            "[grid]\ncells = [32, 32]\nsize = [3.0, 3.0]\n[upper]\n{body}\n[lower]\n{lower}{body}\n\
             [profile.sphere]\nradius = 1.0\n[solver]\ntolerance = {TOLERANCE}\n[friction]\ncoefficient = 0.3\n\
             evolution = {{ by = \"energy\", last = 0.5, scale = 1e-3, every = 3, tolerance = 0.05 }}\n\
             [wear]\ncoefficient = 0.05\nevery = 3\n\
             [[load]]\nnormal_force = 0.5\nincrements = 4\n\
             [[load]]\ntangential_force = [0.1, 0.0]\nincrements = 8\ncycles = 6\n"
        );
        let [short, full] = [LeaveOut::ALL, LeaveOut::all_but(Simplification::Mirror)].map(|leave_out| {
            let plan = Plan::leaving_out(Case::from_toml(&text, "case.toml").unwrap(), leave_out).unwrap();
            (plan.symmetry.copies(), solved(&text, leave_out).history)
        });
        assert_eq!((short.0, full.0), (copies, 1));
        let (short, full) = (short.1, full.1);
        let off = difference(&short, &full);
        assert!(off < AGREES, "{copies}: {off:e}");
        let near = |name: &str, one: f64, other: f64| {
            assert!((one - other).abs() <= 1e-6 * other.abs(), "{copies}: {name} {one:e} {other:e}");
        };
        assert!(full.cycles.iter().any(|cycle| cycle.stands_for > 1 && cycle.friction_change > Some(0.0)));
        for (one, other) in short.steps.iter().zip(&full.steps) {
            assert_eq!(one.footprint, other.footprint);
            assert_eq!([one.contact_cells, one.stick_cells], [other.contact_cells, other.stick_cells]);
            near("contact area", one.contact_area, other.contact_area);
            near("normal force", one.normal_force, other.normal_force);
            near("dissipated energy", one.dissipated_energy, other.dissipated_energy);
            near("worn volume", one.worn_volume, other.worn_volume);
            near("worn depth", one.max_worn_depth, other.max_worn_depth);
            near("friction", one.friction_coefficient, other.friction_coefficient);
        }
        for (one, other) in short.cycles.iter().zip(&full.cycles) {
            assert_eq!(one.stands_for, other.stands_for);
            assert!(
                (one.closure - other.closure).abs() < 1e-6,
                "{copies}: {} {}",
                one.closure,
                other.closure
            );
        }
    }
}

fn is_nothing(field: &Array2<f64>) -> bool {
    field.iter().all(|value| *value == 0.0)
}

#[test]
fn what_is_left_out_is_said_and_nothing_is_said_of_what_is_computed() {
    let phrases = [
        (Simplification::LayeredResponse, "layered response"),
        (Simplification::Coupling, "normal-tangential coupling"),
        (Simplification::Tangential, "before the first tangential load"),
        (Simplification::Pressure, "normal problem at constant normal load"),
        (Simplification::Transverse, "shear along y"),
        (Simplification::Mirror, "three quarters of the grid"),
        (Simplification::Region, "cells far from the contact"),
        (Simplification::Precision, "double precision, in linear problems"),
    ];
    let text = &cases(64).pop().expect("the last has all").text;
    let said = |leave_out| {
        let case = Case::from_toml(text, "case.toml").unwrap_or_else(|error| panic!("{error}"));
        let plan = Plan::leaving_out(case, leave_out).unwrap_or_else(|error| panic!("{error}"));
        let named = phrases.map(|(_, phrase)| plan.left_out.iter().any(|item| item.what.contains(phrase)));
        (named, plan.left_out)
    };
    assert_eq!(said(LeaveOut::ALL).0, [true; 8], "{:?}", said(LeaveOut::ALL).1);
    assert_eq!(said(LeaveOut::NONE).0, [false; 8], "{:?}", said(LeaveOut::NONE).1);
    for (index, (shortcut, _)) in phrases.into_iter().enumerate() {
        assert!(!said(LeaveOut::all_but(shortcut)).0[index], "{shortcut:?}");
    }
}

/// A round contact that grows with friction meets cells in pairs, fours and eights that are alike, which rounding tells apart: in a quarter
/// and on the whole grid, in other orders of sums, they have to get the same slip. Each increment adds to what the last ones left.
#[test]
fn a_round_contact_that_grows_does_not_depend_on_its_mirrors() {
    let coating = Some((2.0, 1.0));
    let sphere =
        Sphere { cells: 32, size: 2.6, coating, friction: 0.2, tolerance: TOLERANCE, ..Sphere::default() };
    for ramp in ["linear", "cubic"] {
        let text = sphere.pressed(1.0, 8, ramp);
        let [short, full] = [LeaveOut::ALL, LeaveOut::NONE].map(|leave_out| solved(&text, leave_out).history);
        for (one, other) in short.steps.iter().zip(&full.steps) {
            let [one, other] = [one, other].map(|step| step.dissipated_energy);
            assert!((one / other - 1.0).abs() < AGREES, "{ramp}: {one:e} {other:e}");
        }
        assert!(short.steps[7].dissipated_energy > 0.0);
    }
}
