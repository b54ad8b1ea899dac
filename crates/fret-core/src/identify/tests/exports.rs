//! Logs as machines export them. One synthetic loop in `tests/golden/logs` (springs: mu = 0.45, rig 30 kN/mm; 3 cycles of 100 points, 0.5 % of
//! noise, made elsewhere by an independent program), in the forms of several exports.

use super::{Identification, Request, constant, identified, refusal};
use crate::identify::Direction;
use crate::measured::Asked;

pub const LOOP: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/logs/loop.csv"));
/// As a tribometer exports it: two steps with a head each, grams of force, millimetres.
const BLOCKS: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/logs/umt.csv"));

fn columns(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
    pairs.iter().map(|(what, name)| ((*what).to_owned(), (*name).to_owned())).collect()
}

/// Rows of the loop, displacement in um and force in N.
pub fn rows() -> Vec<[f64; 2]> {
    let number = |cell: &str| cell.parse::<f64>().unwrap();
    LOOP.lines()
        .skip(1)
        .map(|line| line.split_once(',').map(|(d, q)| [number(d), number(q)]).unwrap())
        .collect()
}

fn written(head: &str, row: impl Fn([f64; 2]) -> String) -> String {
    rows().into_iter().fold(head.to_owned(), |text, at| text + &row(at) + "\n")
}

/// The constants that the loop was made with: friction 0.450, rig 3.0e4. With 0.5 % of noise friction is told to 0.1 %, the rig to 1 %.
#[track_caller]
fn is_the_loop(log: &str, request: &Request) -> Identification {
    let found = identified(log, request);
    let [friction, stiffness] = [0, 1].map(|place| constant(&found, place)[0]);
    assert!((friction / 0.45 - 1.0).abs() < 2e-3, "{friction}");
    assert!((stiffness / 3e4 - 1.0).abs() < 0.025, "{stiffness}");
    found
}

#[test]
fn the_loop_as_it_is() {
    let found = is_the_loop(LOOP, &Request::default());
    assert_eq!(found.turned, Direction::default());
}

/// Force of the other body, displacement of the other sense, rows from the last to the first, and both of these.
#[test]
fn loops_that_run_backwards_are_turned_and_said_to_be() {
    let head = "displacement [um],force [N]\n";
    let backwards = |sign: f64| {
        let rows = rows();
        rows.iter().rev().fold(head.to_owned(), |text, [d, q]| text + &format!("{d},{}\n", sign * q))
    };
    for (log, force, order, words) in [
        (written(head, |[d, q]| format!("{d},{}", -q)), true, false, "the sign of the force was turned"),
        (written(head, |[d, q]| format!("{},{q}", -d)), true, false, "the sign of the force was turned"),
        (backwards(1.0), false, true, "read from the last to the first"),
        (backwards(-1.0), true, true, "the sign of the force was turned, and the rows were read"),
        (written(head, |[d, q]| format!("{},{}", -d, -q)), false, false, ""),
    ] {
        let found = is_the_loop(&log, &Request::default());
        assert_eq!(found.turned, Direction { turned: force, backwards: order }, "{words}");
        assert!(found.notes.concat().contains(words), "{words}: {:?}", found.notes);
        assert!(found.cycles[0].quantities.unwrap().dissipated_energy > 0.0);
        if force || order {
            let strict = Request { strict: true, ..Request::default() };
            assert!(refusal(&log, &strict).contains("leave out --strict"), "{words}");
        }
    }
}

/// Micrometres taken for millimetres: the rule is asked for, and following it helps.
#[test]
fn a_log_without_units_is_asked_for_them() {
    let bare = LOOP.replacen("displacement [um],force [N]", "displacement,force", 1);
    let told = refusal(&bare, &Request::default());
    assert!(told.contains("is the unit of the displacement right?") && !told.contains("inf"), "{told}");
    let units = columns(&[("displacement", "um"), ("force", "N")]);
    is_the_loop(&bare, &Request { asked: Asked { units, ..Asked::default() }, ..Request::default() });
}

/// Heads in the middle, lines above each, grams of force that point the other way.
#[test]
fn blocks_with_a_head_each_are_read_one_after_the_other() {
    let asked = columns(&[("displacement", "X"), ("force", "Fx"), ("normal_force", "Fz")]);
    let request = Request { asked: Asked { columns: asked, ..Asked::default() }, ..Request::default() };
    let found = is_the_loop(BLOCKS, &request);
    let notes = found.notes.concat();
    assert!(notes.contains("2 blocks with a head each"), "{notes}");
    assert!(notes.contains("taken as the weight of that mass"), "{notes}");
    // The measured normal force is that of the case: 10197.162 g weigh 100 N.
    assert!(!notes.contains("the measured normal force is"), "{notes}");
    assert!(found.bad_rows.is_empty());
    // A second block in other units is another file.
    let (first, second) = BLOCKS.split_at(BLOCKS.rfind("g,g,mm").unwrap());
    let told = refusal(&(first.to_owned() + &second.replacen("g,g,mm", "N,N,mm", 1)), &request);
    assert!(told.contains("the units below this head are others") && told.contains("cut the file"), "{told}");
}

/// Weights of a gram, of a kilogram and of a pound, of which load cells write the mass alone.
#[test]
fn units_of_weight_are_known() {
    for (unit, newtons) in
        [("g", 9.80665e-3), ("gf", 9.80665e-3), ("kgf", 9.80665), ("lbf", 4.448_221_615_260_5), ("mN", 1e-3)]
    {
        let log = written(&format!("displacement [um],force [{unit}]\n"), |[d, q]| {
            format!("{d},{:.9e}", q / newtons)
        });
        is_the_loop(&log, &Request::default());
    }
}

#[test]
fn columns_are_named_by_numbers_where_they_have_no_names() {
    let spaced = written("", |[d, q]| format!("{d:.5}   {q:.5}"));
    let told = refusal(&spaced, &Request::default());
    assert!(told.contains("there are no names") && told.contains("displacement=1,force=2"), "{told}");
    let units = columns(&[("displacement", "um")]);
    let by_number = |pairs: &[(&str, &str)]| Request {
        asked: Asked { columns: columns(pairs), units: units.clone() },
        ..Request::default()
    };
    is_the_loop(&spaced, &by_number(&[("displacement", "1"), ("force", "2")]));
    let commas = written("", |[d, q]| format!("0;{q:.5};{d:.5}").replace('.', ","));
    is_the_loop(&commas, &by_number(&[("displacement", "3"), ("force", "2")]));
    // Units above the numbers are read there; a head without known names serves by its numbers, too.
    let titled = written("Rig 3\ns1;s2\nN;um\n", |[d, q]| format!("{q:.5};{d:.5}"));
    let asked = Asked { columns: columns(&[("displacement", "2"), ("force", "1")]), ..Asked::default() };
    let titled_by = Request { asked, ..Request::default() };
    is_the_loop(&titled, &titled_by);
    assert!(refusal(&spaced, &by_number(&[("displacement", "1"), ("force", "1")])).contains("one column"));
    let far = refusal(&spaced, &by_number(&[("displacement", "1"), ("force", "9")]));
    assert!(far.contains("no line names the columns"), "{far}");
}

#[test]
fn heads_behind_a_remark_sign_are_read_with_their_units() {
    is_the_loop(
        &written("#f:15,P:100\n#displacement,force\n#um,N\n", |[d, q]| format!("{d:.5}, {q:.5}")),
        &Request::default(),
    );
    is_the_loop(&written("# displacement force\n# um N\n", |[d, q]| format!("{d} {q}")), &Request::default());
}

/// The names of a head that is not known are shown, not the units below it.
#[test]
fn an_unknown_head_is_shown_and_not_its_units() {
    let log = written("Versuch 7;Kugel;Platte\nZeit;Taster;Zelle\ns;um;N\n", |[d, q]| format!("0,1;{d};{q}"));
    let told = refusal(&log, &Request::default());
    assert!(told.contains("it has: Zeit | Taster | Zelle"), "{told}");
}

/// One sample that is no number, in the middle of the cycle that is fitted.
#[test]
fn a_bad_sample_is_skipped_and_named() {
    for bad in ["NaN", "", "OVER"] {
        let lines: Vec<String> = LOOP
            .lines()
            .enumerate()
            .map(|(k, line)| if k == 150 { format!("0.502857,{bad}") } else { line.to_owned() })
            .collect();
        let log = lines.join("\n");
        let words = is_the_loop(&log, &Request::default()).bad_rows.concat();
        assert!(words.contains("line 151"), "{words}");
        let strict = Request { strict: true, ..Request::default() };
        assert!(refusal(&log, &strict).contains("line 151"), "{bad}");
    }
}
