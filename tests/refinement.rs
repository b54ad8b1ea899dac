//! Ladders of refinement: the orders they show against the known ones, their limit against closed forms, what they advise.

use fret_core::case::Case;
use fret_core::plan::Plan;
use fret_core::run::Silent;
use fret_core::study::{
    Climb, ClosedForm, Form, Kind, Ladder, LadderError, Line, Quantity, Source, Truth, climbed,
};
use fret_validation::Sphere;

fn planned(text: &str) -> Plan {
    Plan::new(Case::from_toml(text, "case.toml").unwrap()).unwrap()
}

fn solved(plan: &Plan, ladder: Ladder) -> Climb {
    let rung = |place| (place, climbed(&ladder.at(place).planned(plan).unwrap(), &mut Silent).unwrap());
    let rungs = ladder.places().into_iter().map(rung).collect();
    Climb::new(ladder, rungs)
}

fn line(lines: &[Line], kind: Kind) -> &Line {
    lines.iter().find(|line| line.kind == kind).unwrap()
}

/// Order over a whole line: from its first rung to its last.
fn order(line: &Line, steps: f64, error: impl Fn(&fret_core::study::Errors) -> Option<f64>) -> f64 {
    let of = |k: usize| error(&line.rungs[k].errors).unwrap();
    (of(0) / of(line.rungs.len() - 1)).ln() / steps.ln()
}

/// Tractions uniform in cells meet a smooth displacement to second order. At the edge of a Hertz contact the pressure goes as
/// the root of the distance, so that cells along it, a share h of all, are off by h^(1/2): first order in the mean square.
#[test]
fn cells_show_the_orders_of_a_hertz_contact() {
    let plan = planned(&Sphere::default().pressed(1.0, 1, "linear"));
    let climb = solved(&plan, Ladder::new(&plan, &[16, 32, 64, 128], &[], &[]).unwrap());
    let truth = Truth::closed(ClosedForm::of(&plan).unwrap());
    let lines = climb.judged(&truth);
    assert_eq!(lines.len(), 1, "one grid kind, one number of increments, one tolerance");
    let line = line(&lines, Kind::Cells);
    let approach = order(line, 8.0, |errors| errors.between[Quantity::Approach as usize]);
    let pressure = order(line, 8.0, |errors| errors.pressure);
    println!("approach {approach:.2}, pressure in the mean square {pressure:.2}");
    // Three halvings: the place of the edge between the cells, which changes from rung to rung, moves an order by some tenths.
    assert!((1.7..2.5).contains(&approach), "{approach}");
    assert!((0.85..1.25).contains(&pressure), "{pressure}");
    // Closed form and limit of the ladder are two ways to one value.
    let limit = climb.limit().unwrap();
    assert_eq!(limit.source(Quantity::Approach), Some(Source::Limit));
    let [exact, near] = [&truth, &limit].map(|truth| truth.of(Quantity::Approach)[0].unwrap()[0]);
    let finest = climb.finest().unwrap().ends[0].approach;
    assert!((near - exact).abs() < (finest - exact).abs(), "limit {near}, finest {finest}, exact {exact}");
    // The advice is a rung of the ladder where that is good enough, and its errors keep what is promised.
    let advice = climb.advice(&truth, 1e-2);
    let advised =
        line.rungs.iter().find(|rung| Some(climb.ladder().cells[rung.place[0]][0]) == advice.cells).unwrap();
    assert!(!advice.concluded && advised.errors.worst(Form::Between).unwrap() <= 1e-2);
}

/// Between like bodies pressure and shear do not act on each other, and while the force runs one way all that slipped goes on
/// slipping: the increments on the way change nothing, here up to the solver's tolerance.
#[test]
fn increments_change_nothing_where_the_way_does_not_matter() {
    let sphere = Sphere { cells: 24, poisson: 0.0, identical: true, friction: 0.3, ..Sphere::default() };
    let there = sphere.pulled(&sphere.pressed(1.0, 1, "linear"), 0.8, 8, None);
    let plan = planned(&sphere.pulled(&there, -0.2, 8, None));
    let climb = solved(&plan, Ladder::new(&plan, &[], &[1, 4, 8], &[]).unwrap());
    assert_eq!(ClosedForm::of(&plan).unwrap().name(), "Hertz; Cattaneo and Mindlin");
    let finest = Truth::finest(climb.finest().unwrap());
    for rung in &line(&climb.judged(&finest), Kind::Increments).rungs {
        let worst = rung.errors.worst(Form::Between).unwrap();
        assert!(worst < 1e-5, "{:?}: {worst:e}", rung.place); // energy and shift stand in differences of the tractions
    }
}

/// Where each traction acts on the other, steps of the load are implicit steps on the way: first order in the tractions. What friction
/// took counts the mean of both ends of each step, which takes the larger part of that error off.
#[test]
fn increments_show_more_than_first_order_in_the_energy_where_the_way_matters() {
    let sphere = Sphere { cells: 24, poisson: 0.0, friction: 0.3, ..Sphere::default() };
    let pressed = sphere.pressed(1.0, 1, "linear");
    let plan = planned(&sphere.pulled(&pressed, 0.5, 8, Some(1)));
    let climb = solved(&plan, Ladder::new(&plan, &[], &[4, 8, 16, 32], &[]).unwrap());
    let lines = climb.judged(&climb.limit().unwrap());
    let losses = order(line(&lines, Kind::Increments), 8.0, |errors| {
        errors.between[Quantity::DissipatedEnergy as usize]
    });
    println!("losses {losses:.2}");
    // Between one and two, measured against the ladder's own limit, which flatters the finest rung a little. With the bound at the
    // end of the steps: below 1.4.
    assert!((1.4..2.2).contains(&losses), "{losses}");
}

/// Which closed form speaks, and where none does.
#[test]
fn closed_forms_are_recognised() {
    let bare = Sphere { cells: 16, ..Sphere::default() };
    let name = |text: &str| ClosedForm::of(&planned(text)).map(|form| form.name());
    assert_eq!(name(&bare.pressed(1.0, 1, "linear")), Some("Hertz"));
    let coated = Sphere { coating: Some((4.0, 0.5)), ..bare.clone() };
    assert_eq!(name(&coated.pressed(1.0, 1, "linear")), None);
    // A coating of the substrate's material is none.
    let alike = Sphere { coating: Some((1.0, 0.5)), ..bare.clone() };
    assert_eq!(name(&alike.pressed(1.0, 1, "linear")), Some("Hertz"));
    // A rigid sphere under friction couples pressure and shear: no closed form.
    let rubbed = Sphere { friction: 0.3, ..bare.clone() };
    assert_eq!(name(&rubbed.pressed(1.0, 1, "linear")), None);
    // Like bodies with a Poisson's ratio: Hertz speaks of the pressure, Cattaneo and Mindlin are not exact.
    let alike = Sphere { identical: true, friction: 0.3, ..bare };
    let form =
        ClosedForm::of(&planned(&alike.pulled(&alike.pressed(1.0, 1, "linear"), 0.5, 4, None))).unwrap();
    assert!(form.ends()[1].of(Quantity::Approach).is_some());
    assert_eq!((form.knows_shear(), form.ends()[1].of(Quantity::Shift)), (false, None));
}

#[test]
fn impossible_ladders_are_refused() {
    let sphere = Sphere { friction: 0.3, ..Sphere::default() };
    let plan = planned(&sphere.pulled(&sphere.pressed(1.0, 1, "linear"), 0.5, 8, Some(1)));
    assert_eq!(Ladder::new(&plan, &[2, 32], &[], &[]), Err(LadderError::Cells(2, 2)));
    assert_eq!(Ladder::new(&plan, &[], &[3], &[]), Err(LadderError::Increments(3, "pull".to_owned(), 4)));
    assert_eq!(Ladder::new(&plan, &[], &[], &[0.5]), Err(LadderError::Tolerance(0.5)));
}
