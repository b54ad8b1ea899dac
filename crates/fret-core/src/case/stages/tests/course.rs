use crate::case::check::tests::{BALL, read};
use crate::case::{Attachments, Case};
use crate::model::Control::{self, FarEnd, Force, Motion};
use crate::model::LoadStep;
use crate::model::stage::{Path, Stage};
use crate::model::{KnownLoads, walk};

/// The stages of a case with these tables [[load]] behind its first.
fn stages(loads: &str, table: &str) -> Vec<Stage> {
    let text = format!(
        "[grid]\ncells = [16, 16]\nsize = [3.0, 3.0]\n[upper]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n[lower]\n\
         substrate = {{ young = 1.0, poisson = 0.3 }}\n[profile.sphere]\nradius = 100.0\n\
         [friction]\ncoefficient = 0.51\n[rig]\nnormal_stiffness = 1.0\ntangential_stiffness = 1.0\n\
         [[load]]\nnormal_force = 64.0\nincrements = 4\nramp = \"cubic\"\n{loads}"
    );
    let files = |_: &str| Ok(table.as_bytes().to_vec());
    Case::from_toml_with(&text, "case.toml", Attachments::files(&files)).unwrap().stages
}

fn normal(stage: &Stage, start: f64) -> Vec<f64> {
    let control = stage.normal.as_ref().unwrap();
    (1..=stage.increments_in_all()).map(|k| stage.value(control, start, k, stage.times().as_ref())).collect()
}

#[test]
fn ramps_go_from_where_the_stage_starts_to_their_end() {
    let stages = stages(
        "[[load]]\napproach = 32.0\nincrements = 4\nramp = \"cubic\"\n[[load]]\nnormal_force = 5.0\nincrements = 4\n\
         [[load]]\nactuator_approach = 16.0\nincrements = 4\nramp = \"cubic\"\n",
        "",
    );
    // forces with the third power, motions with the second, straight lines with the first
    assert_eq!(normal(&stages[0], 0.0), [1.0, 8.0, 27.0, 64.0]);
    assert_eq!(normal(&stages[1], 16.0), [17.0, 20.0, 25.0, 32.0]);
    assert_eq!(normal(&stages[2], 3.0), [3.5, 4.0, 4.5, 5.0]);
    assert_eq!(normal(&stages[3], 0.0), [1.0, 4.0, 9.0, 16.0]);
    for stage in &stages {
        assert_eq!((stage.increments_in_all(), stage.cycles()), (4, None));
        assert!((1..=4).all(|k| !stage.ends_cycle(k)));
    }
}

#[test]
fn a_square_ramp_takes_forces_and_motions_through_the_same_contacts_of_a_sphere() {
    let stages = stages(
        "[[load]]\nnormal_force = 80.0\ntangential_force = [16.0, -32.0]\nincrements = 4\nramp = \"square\"\n\
         [[load]]\napproach = 162.0\nshift = [32.0, \"held\"]\nincrements = 8\nramp = \"square\"\n\
         [[load]]\nactuator_approach = 16.0\nincrements = 8\nramp = \"square\"\n\
         [[load]]\nnormal_force = 64.0\nincrements = 16\nramp = \"square\"\n\
         [[load]]\napproach = 16.0\nincrements = 16\nramp = \"square\"\n",
        "",
    );
    // forces with the second power, from where they were, each control its own way
    assert_eq!(normal(&stages[1], 64.0), [65.0, 68.0, 73.0, 80.0]);
    let start = LoadStep { normal: Force(64.0), ..LoadStep::FREE };
    let pulled: Vec<_> = (1..=4).map(|k| stages[1].load(&start, k).tangential).collect();
    assert_eq!(pulled, [[1.0, -2.0], [4.0, -8.0], [9.0, -18.0], [16.0, -32.0]].map(|both| both.map(Force)));
    // motions with the power 4/3: an eighth of the way is a sixteenth of the motion, exactly, as the cube root of 1/8 is a half
    assert_eq!(normal(&stages[2], 2.0)[0], 12.0);
    assert_eq!(normal(&stages[2], 2.0)[7], 162.0);
    assert_eq!(stages[2].load(&start, 1).tangential, [Motion(2.0), Force(0.0)]);
    assert_eq!(normal(&stages[3], 0.0)[0], 1.0);
    // Hertz: the force goes with the power 3/2 of the approach, at every increment; to rounding
    for (force, approach) in normal(&stages[4], 0.0).into_iter().zip(normal(&stages[5], 0.0)) {
        assert!((approach.powf(1.5) / force - 1.0).abs() < 1e-14, "{force} {approach}");
    }
    for stage in &stages[1..] {
        assert_eq!((stage.increments_in_all(), stage.cycles()), (stage.increments, None));
    }
    // The run's resolved case tells the word.
    assert_eq!(serde_json::to_value(&stages[1]).unwrap()["course"], "square");
}

#[test]
fn waves_grow_with_their_envelope_and_start_where_the_control_is() {
    let stages = stages(
        "[[load]]\nnormal_force = 8.0\nincrements = 4\ncycles = 2\nenvelope = [0.5, 1.5]\n\
         [[load]]\nnormal_force = 8.0\nincrements = 4\ncycles = 2\nenvelope = [0.5, 1.5]\nphase = { normal_force = 90.0 }\n",
        "",
    );
    // shares of 5/8, 6/8, ... of a wave of 8
    assert_eq!(normal(&stages[1], 40.0), [45.0, 40.0, 33.0, 40.0, 49.0, 40.0, 29.0, 40.0]);
    // a quarter ahead: from the top, 0.5 * 8 above the middle
    assert_eq!(normal(&stages[2], 40.0), [36.0, 30.0, 36.0, 44.0, 36.0, 26.0, 36.0, 48.0]);
    assert_eq!(stages[1].increments_in_all(), 8);
    let ends: Vec<usize> = (1..=8).filter(|&k| stages[1].ends_cycle(k)).collect();
    assert_eq!(ends, [4, 8]);
    assert_eq!(stages[1].cycles().unwrap().most, 2);
}

/// Least and largest of some values.
fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    values
        .into_iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], v| [least.min(v), most.max(v)])
}

#[test]
fn a_force_ahead_by_a_twelfth_runs_through_the_same_loads_with_any_number_of_increments() {
    // Amplitude 2, ahead by 30 degrees: it starts at half of its amplitude above the middle, so from 0 it goes from -3 to +1.
    for increments in [4, 5, 6, 7, 8, 12, 16, 20, 24, 32] {
        for waveform in ["sine", "triangle"] {
            let stages = stages(
                &format!(
                    "[[load]]\ntangential_force = [2.0, 0.0]\nincrements = {increments}\ncycles = 1\nwaveform = \"{waveform}\"\n\
                     phase = {{ tangential_force = [30, 0] }}\n"
                ),
                "",
            );
            let force = |k| match stages[1].load(&LoadStep::FREE, k).tangential {
                [Force(x), Force(y)] => {
                    assert_eq!(y, 0.0);
                    x
                }
                other => panic!("{other:?}"),
            };
            let middle = if waveform == "sine" { -1.0 } else { -2.0 / 3.0 };
            let [least, most] = range((0..=increments).map(force));
            // Rounding of a sum of a few numbers of order 1.
            assert!(
                (least - middle + 2.0).abs() < 1e-14 && (most - middle - 2.0).abs() < 1e-14,
                "{increments} {waveform}: {least} {most}"
            );
            assert_eq!((force(0), force(increments)), (0.0, 0.0), "{increments} {waveform}");
        }
    }
}

#[test]
fn every_control_of_a_cycle_reaches_its_extremes() {
    let loads = |increments: usize| {
        format!(
            "[[load]]\nnormal_force = 5.0\ntangential_force = [2.0, 3.0]\ntwist_moment = 1.5\ntilt = [0.5, \"held\"]\n\
             bulk_stress = [7.0, \"held\"]\nupper_bulk_stress = [\"held\", 4.0]\ncycles = 2\nwaveform = \"sine\"\nincrements = {increments}\n\
             phase = {{ normal_force = 60, tangential_force = [10, -35], twist_moment = 145, tilt = [20, 0], bulk_stress = [300, 0], \
             upper_bulk_stress = [0, 777] }}\n"
        )
    };
    let start = LoadStep { normal: Force(64.0), ..LoadStep::FREE };
    for increments in [13, 16, 17, 23, 40] {
        let stage = &stages(&loads(increments), "")[1];
        let all = |of: fn(LoadStep) -> f64| range((1..=increments).map(|k| of(stage.load(&start, k))));
        let found = [
            all(|load| load.normal.value()),
            all(|load| load.tangential[0].value()),
            all(|load| load.tangential[1].value()),
            all(|load| load.twist.value()),
            all(|load| load.tilt[0].value()),
            all(|load| load.bulk_stress[0][0]),
            all(|load| load.bulk_stress[1][1]),
        ];
        let controls = [
            (64.0, 5.0, 60.0_f64),
            (0.0, 2.0, 10.0),
            (0.0, 3.0, -35.0),
            (0.0, 1.5, 145.0),
            (0.0, 0.5, 20.0),
            (0.0, 7.0, 300.0),
            (0.0, 4.0, 777.0),
        ];
        for ([least, most], (from, amplitude, phase)) in found.into_iter().zip(controls) {
            let middle = from - amplitude * phase.to_radians().sin();
            // Rounding of the phase in degrees, and of sums of numbers up to 70.
            assert!((least - middle + amplitude).abs() < 1e-12, "{increments} {phase}: {least} {middle}");
            assert!((most - middle - amplitude).abs() < 1e-12, "{increments} {phase}: {most} {middle}");
        }
    }
    // Seven waves, two of which are half a cycle apart, turn twelve times.
    assert_eq!(stages(&loads(16), "")[1].fewest_increments(), 13);
    assert_eq!(stages(&loads(16), "")[0].fewest_increments(), 1);
}

#[test]
fn what_does_not_move_has_no_reversal_points() {
    let stages = stages(
        "[[load]]\ntangential_force = [2.0, 0.0]\nincrements = 6\ncycles = 1\nphase = { tangential_force = [0, 77] }\n",
        "",
    );
    let pulled: Vec<_> = (1..=6).map(|k| stages[1].load(&LoadStep::FREE, k).tangential[0].value()).collect();
    assert_eq!(pulled, [1.0, 2.0, 0.0, -2.0, -1.0, 0.0]);
}

#[test]
fn an_envelope_grows_with_time_where_increments_are_unequal() {
    let stages = stages(
        "[[load]]\ntangential_force = [8.0, \"held\"]\nincrements = 7\ncycles = 2\nenvelope = [0.0, 1.0]\n",
        "",
    );
    let values: Vec<_> = (1..=14).map(|k| stages[1].load(&LoadStep::FREE, k).tangential[0].value()).collect();
    // Extremes at 1/4, 3/4, 5/4 and 7/4 of two cycles, whatever increment ends there.
    for (k, exact) in [(2, 1.0), (5, -3.0), (9, 5.0), (12, -7.0)] {
        assert!((values[k - 1] - exact).abs() < 1e-14, "{k}: {values:?}");
    }
}

#[test]
fn the_two_axes_of_a_control_have_their_own_phases() {
    let stages = stages(
        "[[load]]\ntangential_force = [8.0, \"held\"]\nshift = [\"held\", 4.0]\nincrements = 4\ncycles = 1\n\
         phase = { tangential_force = [90.0, 33.0], shift = [66.0, 180.0] }\n",
        "",
    );
    let start = LoadStep { tangential: [Force(40.0), Motion(20.0)], ..LoadStep::FREE };
    let found: Vec<_> = (1..=4).map(|k| stages[1].load(&start, k).tangential).collect();
    // from the crest down by 8 a quarter; from the middle down first
    let exact = [[32.0, 16.0], [24.0, 20.0], [32.0, 24.0], [40.0, 20.0]];
    assert_eq!(found, exact.map(|[force, motion]| [Force(force), Motion(motion)]));
}

#[test]
fn tables_are_followed_from_row_to_row_and_again() {
    let stages = stages(
        "[[load]]\ntable = \"path.csv\"\nincrements = 2\n[[load]]\ntable = \"path.csv\"\nincrements = 2\ncycles = 2\n",
        "normal_force,twist\n10,1\n4,0\n6,3\n",
    );
    assert_eq!(stages[1].increments, 6);
    assert_eq!(normal(&stages[1], 2.0), [6.0, 10.0, 7.0, 4.0, 5.0, 6.0]);
    // the second cycle starts from the last row
    let twice = [6.0, 10.0, 7.0, 4.0, 5.0, 6.0, 8.0, 10.0, 7.0, 4.0, 5.0, 6.0];
    assert_eq!(normal(&stages[2], 2.0), twice);
}

#[test]
fn between_the_rows_of_a_table_controls_run_straight() {
    let stages =
        stages("[[load]]\ntable = \"path.csv\"\nincrements = 4\n", "normal_force,twist\n10,1\n2,0\n");
    assert_eq!(normal(&stages[1], 2.0), [4.0, 6.0, 8.0, 10.0, 8.0, 6.0, 4.0, 2.0]);
}

#[test]
fn a_stage_prescribes_its_controls_and_leaves_the_others() {
    let stages = stages(
        "[[load]]\ntangential_force = [4.0, \"held\"]\nshift = [\"held\", 8.0]\ntwist_moment = 2.0\ntilt = [\"held\", 6.0]\n\
         bulk_stress = [10.0, \"held\"]\nupper_bulk_stress = [\"held\", 20.0]\nincrements = 2\n\
         [[load]]\nactuator = [2.0, 4.0]\nincrements = 2\n",
        "",
    );
    let before = LoadStep {
        normal: Motion(7.0),
        tangential: [Force(2.0), Motion(4.0)],
        twist: Force(0.0),
        tilt: [Force(1.0), Motion(2.0)],
        bulk_stress: [[2.0, 3.0], [4.0, 5.0]],
        roll: [0.0; 2],
    };
    let half = LoadStep {
        normal: Motion(7.0),
        tangential: [Force(3.0), Motion(6.0)],
        twist: Force(1.0),
        tilt: [Force(1.0), Motion(4.0)],
        bulk_stress: [[6.0, 3.0], [4.0, 12.5]],
        roll: [0.0; 2],
    };
    assert_eq!(stages[1].load(&before, 1), half);
    assert_eq!(stages[2].load(&before, 2).tangential, [FarEnd(2.0), FarEnd(4.0)]);
    let counts: Vec<usize> = stages.iter().map(|stage| stage.controls().count()).collect();
    assert_eq!(counts, [1, 6, 2]);
    let motions: Vec<bool> = stages[1..]
        .iter()
        .flat_map(Stage::controls)
        .map(crate::model::stage::StageControl::is_motion)
        .collect();
    assert_eq!(motions, [false, true, false, true, false, false, true, true]);
    let words = |stage: &Stage| (stage.is_tangential(), stage.tilts(), stage.stretches());
    assert_eq!(words(&stages[0]), (false, false, false));
    assert_eq!(words(&stages[1]), (true, true, true));
    assert_eq!(words(&stages[2]), (true, false, false));
    // what a stage leaves is not written
    let written = |stage: &Stage| serde_json::to_string(stage).unwrap();
    for key in ["\"tilt\"", "\"bulk_stress\""] {
        assert!(written(&stages[1]).contains(key) && !written(&stages[0]).contains(key));
    }
}

#[test]
fn paths_of_zeros_are_zero() {
    assert!(Path::To(0.0).is_zero() && !Path::To(1.0).is_zero());
    for (amplitude, zero) in [(0.0, true), (0.5, false)] {
        assert_eq!(Path::Wave { amplitude, phase: 0.5 }.is_zero(), zero);
        assert_eq!(Path::Through(vec![0.0, amplitude, 0.0]).is_zero(), zero);
    }
}

/// What a walk sees of one control.
fn seen(start: Option<&LoadStep>, stages: &[Stage], index: usize) -> Vec<(usize, Option<Control>)> {
    let mut all = Vec::new();
    walk(start, stages, |number, loads: &KnownLoads| all.push((number, loads[index])));
    all
}

#[test]
fn a_walk_knows_what_follows_from_the_case() {
    let stages = stages(
        "[[load]]\napproach = 2.0\nincrements = 2\n[[load]]\napproach = 3.0\nincrements = 4\ncycles = 5\n\
         [[load]]\ntable = \"path.csv\"\nincrements = 2\n[[load]]\nnormal_force = 4.0\nincrements = 4\ncycles = 1\n",
        "normal_force\n10\n4\n",
    );
    let force = |value: f64| Some(Force(value));
    let motion = |value: f64| Some(Motion(value));
    let first = [1.0, 8.0, 27.0, 64.0].map(|value| (0, force(value)));
    // where the approach begins nobody knows; where it ends, the case says
    let second = [(1, None), (1, motion(2.0))];
    // of five cycles the first and the last
    let third = [5.0, 2.0, -1.0, 2.0].map(|value| (2, motion(value)));
    // a force by rows, from a motion: from the first row on
    let fourth = [None, force(10.0), force(7.0), force(4.0)].map(|value| (3, value));
    let fifth = [8.0, 4.0, 0.0, 4.0].map(|value| (4, force(value)));
    let all = [&first[..], &second, &third, &third, &fourth, &fifth].concat();
    assert_eq!(seen(None, &stages, 0), all);
    // from a solved state: forces of 10 in x
    let start = LoadStep { tangential: [Force(10.0), Force(0.0)], ..LoadStep::FREE };
    assert!(seen(Some(&start), &stages, 1).iter().all(|(_, x)| *x == force(10.0)));
    // a wave of another kind than what was held has no known middle
    let moved = LoadStep { normal: Motion(1.0), ..LoadStep::FREE };
    assert_eq!(seen(Some(&moved), &stages[4..], 0), [(0, None); 4]);
}

#[test]
fn a_walk_visits_the_first_and_the_last_cycle() {
    let stage =
        "[[load]]\ntangential_force = [0.002, 0.0]\nincrements = 4\ncycles = 5\nenvelope = [0.25, 1.0]\n";
    let case = read(&format!("{BALL}{stage}"), &[]);
    let mut forces = Vec::new();
    walk(case.start.as_ref(), &case.stages, |stage, [_, x, ..]| {
        if let (1, Some(Force(force))) = (stage, x) {
            forces.push((force / 0.002 * 80.0).round());
        }
    });
    // the triangle 1, 0, -1, 0 times a share that grows from a quarter by 3/80 an increment
    assert_eq!(forces, [23.0, 0.0, -29.0, 0.0, 71.0, 0.0, -77.0, 0.0]);
}
