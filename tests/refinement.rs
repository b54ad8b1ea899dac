//! Refinement studies: the orders they show against the known ones, their limit against closed forms, what they advise.

use fret_core::case::Case;
use fret_core::plan::Plan;
use fret_core::run::Silent;
use fret_core::study::{
    ClosedForm, Form, Kind, Line, Quantity, Reference, RefinementStudy, ResolutionError, Resolutions, Source,
    companion, error_bars, solved_level,
};
use fret_validation::Sphere;

fn planned(text: &str) -> Plan {
    Plan::new(Case::from_toml(text, "case.toml").unwrap()).unwrap()
}

fn solved(plan: &Plan, resolutions: Resolutions) -> RefinementStudy {
    let level =
        |place| (place, solved_level(&resolutions.at(place).planned(plan).unwrap(), &mut Silent).unwrap());
    let levels = resolutions.places().into_iter().map(level).collect();
    RefinementStudy::new(resolutions, levels)
}

fn line(lines: &[Line], kind: Kind) -> &Line {
    lines.iter().find(|line| line.kind == kind).unwrap()
}

/// Order over a whole line: from its first level to its last.
fn order(line: &Line, steps: f64, error: impl Fn(&fret_core::study::Errors) -> Option<f64>) -> f64 {
    let of = |k: usize| error(&line.levels[k].errors).unwrap();
    (of(0) / of(line.levels.len() - 1)).ln() / steps.ln()
}

/// Tractions uniform in cells meet a smooth displacement to second order. At the edge of a Hertz contact the pressure goes as
/// the root of the distance, so that cells along it, a share h of all, are off by h^(1/2): first order in the mean square.
#[test]
#[ignore = "long: 4 s"]
fn cells_show_the_orders_of_a_hertz_contact() {
    let plan = planned(&Sphere::default().pressed(1.0, 1, "linear"));
    let study = solved(&plan, Resolutions::new(&plan, &[16, 32, 64, 128], &[], &[]).unwrap());
    let reference = Reference::closed(ClosedForm::of(&plan).unwrap());
    let lines = study.judged(&reference);
    assert_eq!(lines.len(), 1, "one grid kind, one number of increments, one tolerance");
    let line = line(&lines, Kind::Cells);
    let approach = order(line, 8.0, |errors| errors.between[Quantity::Approach as usize]);
    let pressure = order(line, 8.0, |errors| errors.pressure);
    println!("approach {approach:.2}, pressure in the mean square {pressure:.2}");
    // Three halvings: the place of the edge between the cells, which changes from level to level, moves an order by some tenths.
    assert!((1.7..2.5).contains(&approach), "{approach}");
    assert!((0.85..1.25).contains(&pressure), "{pressure}");
    // Closed form and limit of the study are two ways to one value.
    // On coarse grids that place makes the approach better or worse by chance (orders 3.4, .8, 2.3 from 16 to 128 cells), and there is no
    // limit to be told; on finer ones it and the closed form are two ways to one value.
    assert_eq!(study.limit().unwrap().source(Quantity::Approach), Some(Source::Finest));
    let finer = solved(&plan, Resolutions::new(&plan, &[64, 128, 256], &[], &[]).unwrap());
    let limit = finer.limit().unwrap();
    assert_eq!(limit.source(Quantity::Approach), Some(Source::Limit));
    let [exact, near] = [&reference, &limit].map(|reference| reference.of(Quantity::Approach)[0].unwrap()[0]);
    let finest = finer.finest().unwrap().ends[0].approach;
    assert!((near - exact).abs() < (finest - exact).abs(), "limit {near}, finest {finest}, exact {exact}");
    // The advice is a level of the study where that is good enough, and its errors keep what is promised.
    let advice = study.advice(&reference, 1e-2);
    let advised = line
        .levels
        .iter()
        .find(|level| Some(study.resolutions().cells[level.place[0]][0]) == advice.cells)
        .unwrap();
    assert!(!advice.concluded && advised.errors.worst(Form::Between).unwrap() <= 1e-2);
}

/// Between elastically similar bodies pressure and shear do not act on each other, and while the force runs one way all that slipped goes on
/// slipping: the increments on the way change nothing, here up to the solver's tolerance.
#[test]
fn increments_change_nothing_where_the_way_does_not_matter() {
    let sphere = Sphere { cells: 24, poisson: 0.0, identical: true, friction: 0.3, ..Sphere::default() };
    let there = sphere.pulled(&sphere.pressed(1.0, 1, "linear"), 0.8, 8, None);
    let plan = planned(&sphere.pulled(&there, -0.2, 8, None));
    let study = solved(&plan, Resolutions::new(&plan, &[], &[1, 4, 8], &[]).unwrap());
    assert_eq!(ClosedForm::of(&plan).unwrap().name(), "Hertz; Cattaneo and Mindlin");
    let finest = Reference::finest(study.finest().unwrap());
    let lines = study.judged(&finest);
    let (own, others) = line(&lines, Kind::Increments).levels.split_last().unwrap();
    assert_eq!(own.errors.worst(Form::Between), None); // a level compared with itself has no error, nor is it without one
    for level in others {
        let worst = level.errors.worst(Form::Between).unwrap();
        assert!(worst < 1e-5, "{:?}: {worst:e}", level.place); // energy and shift stand in differences of the tractions
    }
}

/// Where each traction acts on the other, steps of the load are implicit steps on the way: first order in the tractions. What friction
/// took counts the mean of both ends of each step, which takes the larger part of that error off.
#[test]
fn increments_show_more_than_first_order_in_the_energy_where_the_way_matters() {
    let sphere = Sphere { cells: 24, poisson: 0.0, friction: 0.3, ..Sphere::default() };
    let pressed = sphere.pressed(1.0, 1, "linear");
    let plan = planned(&sphere.pulled(&pressed, 0.5, 8, Some(1)));
    let study = solved(&plan, Resolutions::new(&plan, &[], &[4, 8, 16, 32], &[]).unwrap());
    let lines = study.judged(&study.limit().unwrap());
    let losses = order(line(&lines, Kind::Increments), 8.0, |errors| {
        errors.between[Quantity::DissipatedEnergy as usize]
    });
    println!("losses {losses:.2}");
    // Between one and two, measured against the study's own limit, which flatters the finest level a little. With the bound at the
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
    assert_eq!(Resolutions::new(&plan, &[2, 32], &[], &[]), Err(ResolutionError::Cells(2, 2)));
    assert_eq!(
        Resolutions::new(&plan, &[], &[3], &[]),
        Err(ResolutionError::Increments(3, "pull".to_owned(), 4))
    );
    assert_eq!(Resolutions::new(&plan, &[], &[], &[0.5]), Err(ResolutionError::Tolerance(0.5)));
}

/// The edge of a line contact is two points, whose places between the centres of cells decide its errors: they change their sign from grid to
/// grid, and nothing is extrapolated from them.
#[test]
fn of_line_contacts_nothing_is_extrapolated() {
    let plan = planned(
        "[grid]\ncells = 128\nsize = 3.0\ndatum = 10.0\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = 1.0, poisson = 0.3 }\n\
         [profile.cylinder]\nradius = 100.0\naxis = \"y\"\n[[load]]\nnormal_force = 7e-3\nincrements = 1\n",
    );
    let study = solved(&plan, Resolutions::new(&plan, &[32, 64, 128], &[], &[]).unwrap());
    let reference = Reference::closed(ClosedForm::of(&plan).unwrap());
    let exact = reference.of(Quantity::Approach)[0].unwrap()[0];
    let levels = [0, 1, 2].map(|cells| study.level([cells, 0, 0]).unwrap().ends[0].approach - exact);
    assert!(levels[0] < 0.0 && levels[1] > 0.0, "{levels:?}");
    for level in &line(&study.judged(&reference), Kind::Cells).levels {
        let of = |form| level.errors.of(form)[Quantity::Approach as usize];
        assert!(of(Form::Extrapolated).is_none_or(|error| Some(error) == of(Form::Between)));
    }
    let limit = study.limit().unwrap();
    let off = (limit.of(Quantity::Approach)[0].unwrap()[0] - exact).abs();
    assert!(off <= levels[2].abs(), "the limit is the finest level: {off:e}");
}

/// A level that could not be solved is left out with its count: the limit is that of the levels that were.
#[test]
fn a_limit_passes_over_levels_that_are_missing() {
    let plan = planned(&Sphere::default().pressed(1.0, 1, "linear"));
    let resolutions = Resolutions::new(&plan, &[16, 24, 48], &[], &[]).unwrap();
    let whole = solved(&plan, Resolutions::new(&plan, &[16, 48], &[], &[]).unwrap());
    let levels = [0, 2].map(|cells| {
        let place = [cells, 0, 0];
        (place, solved_level(&resolutions.at(place).planned(&plan).unwrap(), &mut Silent).unwrap())
    });
    let holed = RefinementStudy::new(resolutions, levels.into());
    let approach = |study: &RefinementStudy| study.limit().unwrap().of(Quantity::Approach)[0].unwrap()[0];
    assert_eq!(approach(&holed), approach(&whole));
}

/// A paraboloid as a scan of 96 points a side, with what follows its keys, under a grid that covers its middle 48.
fn scanned(keys: &str, cells: usize) -> Case {
    let spacing = 1.0 / 32.0;
    let place = |point: usize| (point as f64 - 47.5) * spacing;
    let rows: Vec<Vec<f64>> =
        (0..96).map(|i| (0..96).map(|j| -(place(i).powi(2) + place(j).powi(2)) / 2.0).collect()).collect();
    let heights = format!("heights]\nvalues = {rows:?}\nsize = [3.0, 3.0]\n{keys}");
    pressed_to(0.5, &heights, cells)
}

/// A body pressed on a grid of 1.5 by 1.5 until its contact has a radius, were it a sphere of radius 1.
fn pressed_to(radius: f64, profile: &str, cells: usize) -> Case {
    let force = 4.0 / 3.0 * radius.powi(3);
    let text = format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = [1.5, 1.5]\n[upper]\nrigid = true\n\
         [lower]\nsubstrate = {{ young = 1.0, poisson = 0.0 }}\n[solver]\ntolerance = 1e-10\n\
         [profile.{profile}\n[[load]]\nnormal_force = {force}\nincrements = 1\n"
    );
    Case::from_toml(&text, "case.toml").unwrap()
}

/// The mean of a paraboloid over a cell lies as far above the value in its middle for every cell, and so does a surface that is linear
/// between points of which as many lie in each: a study of the scan is that of the paraboloid itself, but that the approach is counted from the
/// middles of the four cells in the middle, h^2/4R away from the tip.
#[test]
fn a_study_of_a_resampled_scan_is_that_of_the_measured_surface() {
    let levels = [12, 24, 48];
    let [scan, sphere] = [scanned("resample = \"linear\"", 48), pressed_to(0.5, "sphere]\nradius = 1.0", 48)]
        .map(|case| {
            let plan = Plan::new(case).unwrap();
            solved(&plan, Resolutions::new(&plan, &levels, &[], &[]).unwrap())
        });
    for (number, cells) in levels.into_iter().enumerate() {
        let [scan, sphere] = [&scan, &sphere].map(|study| &study.level([number, 0, 0]).unwrap().ends[0]);
        let cell = 1.5 / cells as f64;
        let pairs = [
            (scan.max_pressure, sphere.max_pressure),
            (scan.contact_area, sphere.contact_area),
            (scan.approach + cell * cell / 4.0, sphere.approach),
        ];
        for (scan, sphere) in pairs {
            // rounding of the heights, 1e-16 of some 1, and the tolerance of the solver, 1e-10, some tens of times
            assert!((scan / sphere - 1.0).abs() < 1e-8, "{cells} cells: {scan}, {sphere}");
        }
    }
}

/// Bars of a resampled scan are there, and hold: about Hertz's pressure and area.
#[test]
fn error_bars_of_a_resampled_scan_cover_the_closed_form() {
    let plan = Plan::new(scanned("resample = \"linear\"", 48)).unwrap();
    let [fine, coarse] =
        [&plan, &companion(&plan).unwrap()].map(|plan| solved_level(plan, &mut Silent).unwrap().ends);
    let bars = error_bars(&plan, &fine, &coarse);
    let pressure = 2.0 * 0.5 / std::f64::consts::PI;
    let area = std::f64::consts::PI * 0.25;
    for (quantity, exact) in [(Quantity::MaxPressure, pressure), (Quantity::ContactArea, area)] {
        let said = bars[0].of(quantity).unwrap();
        let bar = said.bar.unwrap();
        assert!((said.value[0] - exact).abs() <= bar && bar < 0.05 * exact, "{said:?}, exact {exact}");
    }
}

/// Heights of the cells alone have no other grid; the message names the way out.
#[test]
fn heights_of_the_cells_alone_are_not_studied() {
    let case = scanned("resample = \"linear\"", 48);
    assert!(companion(&Plan::new(case).unwrap()).is_ok());
    let own = Plan::new(pressed_to(
        0.1,
        "heights]\nvalues = [[0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]]\n",
        4,
    ));
    let plan = own.unwrap();
    for refused in [companion(&plan).map(|_| ()), Resolutions::new(&plan, &[4, 8], &[], &[]).map(|_| ())] {
        let error = refused.unwrap_err();
        assert_eq!(error, ResolutionError::Heights);
        assert!(error.to_string().contains("resample = \"linear\""), "{error}");
    }
}
