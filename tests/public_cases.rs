//! What people bring: files of instruments and spreadsheets in the spellings that they have, units beside numbers, and problems of
//! public questions. The inputs are made here, after public reports; expected are closed forms, or a plain spelling of the same numbers.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fmt::Write;

use fret_core::analytic::Hertz;
use fret_core::case::{Attachments, Case};
use fret_core::history::History;
use fret_core::plan::Plan;
use fret_core::run::{Silent, Simulation};

type Files = BTreeMap<&'static str, Vec<u8>>;

/// Solves a case whose files are these; or what it says instead.
fn outcome(text: &str, files: &Files) -> Result<History, String> {
    let file = |name: &str| files.get(name).cloned().ok_or_else(|| "no such file".to_owned());
    let case = Case::from_toml_with(text, "case.toml", Attachments::files(&file))
        .map_err(|error| error.to_string())?;
    let plan = Plan::new(case).map_err(|error| error.to_string())?;
    Simulation::new(&plan).run(&mut Silent).map_err(|error| error.to_string())
}

fn solved(text: &str, files: &Files) -> History {
    outcome(text, files).unwrap_or_else(|error| panic!("{error}"))
}

fn one(name: &'static str, bytes: impl Into<Vec<u8>>) -> Files {
    Files::from([(name, bytes.into())])
}

/// All words stand in the refusal.
fn refused(text: &str, files: &Files, words: &[&str]) {
    let error = outcome(text, files).expect_err("refused");
    for word in words {
        assert!(error.contains(word), "{error}: expected {word:?}");
    }
}

// ---- a load table with units in its head ----

const BALL_IN_MM: &str = "units = { length = \"mm\", force = \"N\" }\ngrid = { cells = [32, 32], size = \"auto\" }\n\
    upper = { rigid = true }\nlower = { substrate = { young = 210000.0, poisson = 0.3 } }\nprofile = { sphere = { radius = 10.0 } }\n\
    friction = { coefficient = 0.5 }\n[[load]]\nnormal_force = 50.0\nincrements = 4\n[[load]]\nincrements = 1\ntable = \"path.csv\"\n";

/// What is added up increment by increment is right to a few roundings of the largest of the three.
fn near(found: [f64; 3], right: [f64; 3]) {
    let largest = right.into_iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    assert!(
        found.iter().zip(right).all(|(found, right)| (found - right).abs() < 4e-15 * largest),
        "{found:?}"
    );
}

/// A number of the last three increments.
fn last_three(history: &History, value: fn(&fret_core::history::StepRecord) -> f64) -> [f64; 3] {
    let steps = &history.steps[history.steps.len() - 3..];
    [0, 1, 2].map(|step| value(&steps[step]))
}

#[test]
fn a_load_table_in_kilonewtons_is_played_in_newtons() {
    for (case, table) in [
        (BALL_IN_MM.to_owned(), "tangential_force_x [kN]\n0.001\n0.005\n-0.003\n"),
        (BALL_IN_MM.to_owned(), "tangential_force_x (mN)\n1000\n5000\n-3000\n"),
        (BALL_IN_MM.to_owned(), "# rig 3\ntangential_force_x\nkN\n1e-3\n5e-3\n-3e-3\n"),
        (
            BALL_IN_MM.to_owned() + "columns = { tangential_force_x = \"Q [kN]\" }\n",
            "t [s];Q [kN]\n0;0,001\n1;0,005\n2;-0,003\n",
        ),
        (
            BALL_IN_MM.to_owned() + "columns = { tangential_force_x = \"Q\" }\n",
            "# t / s; Q / kN\r\n0; 0.001\r\n1; 0.005\r\n2; -0.003\r\n",
        ),
    ] {
        let history = solved(&case, &one("path.csv", table));
        near(last_three(&history, |step| step.tangential_force[0]), [1.0, 5.0, -3.0]);
    }
    let shift = solved(BALL_IN_MM, &one("path.csv", "shift_x [um]\n0.1\n0.2\n-0.3\n"));
    near(last_three(&shift, |step| step.shift[0]), [1e-4, 2e-4, -3e-4]);
    let twist = solved(BALL_IN_MM, &one("path.csv", "twist [deg]\n0.001\n0.002\n-0.003\n"));
    for (found, degrees) in last_three(&twist, |step| step.twist).into_iter().zip([0.001, 0.002, -0.003]) {
        assert!((found / (degrees * PI / 180.0) - 1.0).abs() < 1e-15); // rounding of two products
    }
    // what the program writes itself
    let own = solved(
        BALL_IN_MM,
        &one("path.csv", "normal_force [N],twist_moment [N mm]\n50,0.1\n51,0.2\n52,0.3\n"),
    );
    near(last_three(&own, |step| step.normal_force), [50.0, 51.0, 52.0]);
}

#[test]
fn units_of_a_load_table_that_cannot_be_converted_are_refused() {
    for (head, words) in [
        ("normal_force [um]", "normal_force in \"um\" is no unit of a force"),
        ("normal_force [bananas]", "\"bananas\" is no unit that is known"),
        ("normal_force [N", "a bracket that is not closed"),
        ("normal_force (s)", "\"s\" is no unit that is known"),
        ("normal_force []", "\"\" is no unit that is known"),
        ("shift_x [GPa]", "\"GPa\" is no unit of a length"),
        ("bulk_stress_x [N]", "\"N\" is no unit of a pressure"),
        ("twist [mm]", "\"mm\" is no unit of a number or angle"),
    ] {
        refused(BALL_IN_MM, &one("path.csv", format!("{head}\n1\n2\n")), &["line 1, column", words]);
    }
    // without units of the case those of SI stand for themselves, and no others
    let without = BALL_IN_MM.split_once('\n').unwrap().1;
    refused(
        without,
        &one("path.csv", "normal_force [kN]\n5\n"),
        &["the case does not name its units", "[units]"],
    );
    let history = solved(without, &one("path.csv", "normal_force [N]\n50\n51\n52\n"));
    near(last_three(&history, |step| step.normal_force), [50.0, 51.0, 52.0]);
}

#[test]
fn a_load_table_with_decimal_commas_is_read() {
    let table = "normal_force;tangential_force_x\n50,5;1,5\n51,5;5,25\n52,5;-3,75\n";
    for bytes in [
        table.as_bytes().to_vec(),
        table.encode_utf16().flat_map(u16::to_be_bytes).collect(),
        table.replace('\n', "\r").into(),
    ] {
        let history = solved(BALL_IN_MM, &one("path.csv", bytes));
        near(last_three(&history, |step| step.tangential_force[0]), [1.5, 5.25, -3.75]);
        near(last_three(&history, |step| step.normal_force), [50.5, 51.5, 52.5]);
    }
    refused(BALL_IN_MM, &one("path.csv", "normal_force\n50,5\n"), &["line 2 has 2 cells", "decimal commas"]);
    refused(BALL_IN_MM, &one("path.csv", "normal_force;twist\n1.000,5;0\n"), &["line 2", "decimal commas"]);
    refused(
        BALL_IN_MM,
        &one("path.csv", "normal_force;tangential_force_x\n50,5;1.5\n"),
        &["line 2", "decimal commas"],
    );
}

// ---- a scan of 16 x 12 heights in micrometres, rows along y ----

const SCAN: &str = "grid = { cells = [16, 12], size = [1e-05, 7.5e-06], periodic = true }\nupper = { rigid = true }\n\
    lower = { substrate = { young = 200000000000.0, poisson = 0.3 }, profile = { heights = { file = \"scan\", rows = \"y\", unit = 1e-06 } } }\n\
    [[load]]\nnormal_force = 0.03\nincrements = 1\n";

/// Height [um] of cell [i, j], in six decimals.
fn height(i: usize, j: usize) -> String {
    let wave = |index: usize, cells: f64| (2.0 * PI * (index as f64 + 0.5) / cells).cos();
    format!("{:.6}", 0.01 * wave(i, 16.0) * wave(j, 12.0))
}

/// The scan as a text.
fn scan(separator: &str) -> String {
    (0..12).fold(String::new(), |text, j| {
        text + &(0..16).map(|i| height(i, j)).collect::<Vec<_>>().join(separator) + "\n"
    })
}

fn points(order: impl Fn(usize) -> usize, unit: f64) -> String {
    (0..192).map(order).fold(String::from("# x y z\n"), |mut text, index| {
        let (i, j) = (index % 16, index / 16);
        let at = |index: usize| (index as f64 + 0.5) * 0.625 * unit;
        writeln!(text, "{:e} {:e} {}", at(i), at(j), height(i, j)).unwrap();
        text
    })
}

#[test]
fn a_scan_is_one_contact_in_every_spelling() {
    let pressure = |history: &History| history.fields[0].pressure.clone().unwrap();
    let right = solved(SCAN, &one("scan", scan(" ")));
    // 1.445e9 by a solver of another program with the same cells
    assert!((right.steps[0].max_pressure / 1.445e9 - 1.0).abs() < 5e-4, "{:e}", right.steps[0].max_pressure);
    let comma = |separator: &str| scan("|").replace('.', ",").replace('|', separator);
    let utf16 = |order: fn(u16) -> [u8; 2]| -> Vec<u8> {
        format!("\u{feff}{}", scan("\t")).encode_utf16().flat_map(order).collect()
    };
    let latin1 = [b"# Breite: 10 \xb5m\n", scan("\t").as_bytes()].concat();
    let (little, big) = (utf16(u16::to_le_bytes), utf16(u16::to_be_bytes));
    for (spelling, bytes) in [
        ("commas", scan(",").into_bytes()),
        ("commas and blanks", scan(", ").into_bytes()),
        ("decimal commas and semicolons", comma(";").into_bytes()),
        ("decimal commas and tabs", comma("\t").into_bytes()),
        ("Latin-1", latin1),
        ("UTF-16, little end first", little),
        ("UTF-16, big end first", big),
        ("a mark of UTF-8", format!("\u{feff}{}", scan(" ")).into_bytes()),
        ("a head behind %", format!("% Width: 10 um\n{}", scan("\t")).into_bytes()),
        ("heads behind !, ; and //", format!("! a\n; b\n// c\n{}", scan(" ")).into_bytes()),
        ("carriage returns", scan("\t").replace('\n', "\r").into_bytes()),
        ("points", points(|row| row, 1.0).into_bytes()),
        ("points column by column", points(|row| row / 12 + row % 12 * 16, 1.0).into_bytes()),
        ("points in metres, from the end", points(|row| 191 - row, 1e-6).into_bytes()),
    ] {
        let history = solved(SCAN, &one("scan", bytes));
        assert_eq!(pressure(&history), pressure(&right), "{spelling}");
    }
}

#[test]
fn holes_and_broken_words_of_a_scan_are_refused_with_their_place() {
    let good = scan(" ");
    let line = good.lines().nth(3).unwrap();
    let broken = |word: &str| {
        let row = format!("{} {word}", line.rsplit_once(' ').unwrap().0);
        good.replacen(line, &row, 1)
    };
    for word in ["1.#QNAN", "-1.#IND", "NaN", "BAD", "***", "#N/A"] {
        refused(SCAN, &one("scan", broken(word)), &["line 4, column 16", word, "not measured", "harmonic"]);
    }
    for word in ["1.#INF", "inf", "1e400"] {
        refused(SCAN, &one("scan", broken(word)), &["line 4, column 16", word, "is no finite number"]);
    }
    for word in ["0.0123#", "7#bad", "0x1p-3", "1D-5"] {
        refused(SCAN, &one("scan", broken(word)), &["line 4, column 16", word, "is not a number"]);
    }
    refused(SCAN, &one("scan", broken("")), &["line 4: a row of 15 numbers after rows of 16"]);
    for mark in ["1e38", "-9999", "2147483640", "1e10"] {
        refused(SCAN, &one("scan", broken(mark)), &["height [15, 3] is", "a cell without a measurement"]);
    }
    let comma = scan(" ").replace('.', ",");
    refused(SCAN, &one("scan", comma), &["a decimal comma"]);
    refused(SCAN, &one("scan", scan("|").replace(['.', '|'], ",")), &["a decimal comma"]);
    // points of another grid, and one too few
    let far = points(|row| row, 1.0);
    refused(
        &SCAN.replace("[1e-05, 7.5e-06]", "[2e-05, 1.5e-05]"),
        &one("scan", far.clone()),
        &["points 0.625 x 0.625 apart", "1.25e-6"],
    );
    refused(&SCAN.replace("[16, 12]", "[24, 8]"), &one("scan", far.clone()), &["of 192", "24 x 8"]);
    let fewer: Vec<&str> = far.lines().take(192).collect();
    refused(SCAN, &one("scan", fewer.join("\n")), &["191 points", "16 x 12"]);
}

#[test]
fn a_hole_of_a_friction_map_is_no_coefficient() {
    let case = "grid = { cells = [16, 12], size = [1e-05, 7.5e-06] }\nupper = { rigid = true }\n\
        lower = { substrate = { young = 2e11, poisson = 0.3 } }\nprofile = { sphere = { radius = 1e-4 } }\n\
        friction = { map = \"scan\" }\n[[load]]\nnormal_force = 1e-4\nincrements = 1\n";
    let map = (0..16).fold(String::new(), |text, _| text + &"0.3 ".repeat(11) + "0.3\n");
    assert!(outcome(case, &one("scan", map.clone())).is_ok());
    refused(
        case,
        &one("scan", map.replacen("0.3\n", "1.#QNAN\n", 1)),
        &["line 1, column 12", "not measured"],
    );
    let strength = case.replace("map = \"scan\"", "coefficient = 0.3, max_shear = \"scan\"");
    refused(
        &strength,
        &one("scan", map.replacen("0.3\n", "1.#QNAN\n", 1)),
        &["line 1, column 12", "not measured"],
    );
}

// ---- a stylus profile in a line contact ----

#[test]
fn a_stylus_profile_is_one_line_contact_in_every_form() {
    let case = "units = { length = \"mm\", force = \"N\" }\ngrid = { cells = 256, size = 0.04 }\nupper = { rigid = true }\n\
        lower = { substrate = { young = 200000.0, poisson = 0.3 }, profile = { heights = { file = \"profile\" } } }\n\
        profile = { cylinder = { radius = 0.25, axis = \"y\" } }\n[[load]]\nnormal_force = 20.0\nincrements = 1\n";
    let height = |k: usize| 1e-5 * (2.0 * PI * (k as f64 + 0.5) / 32.0).cos();
    let npy = {
        let head = "{'descr': '<f8', 'fortran_order': False, 'shape': (256,), }\n";
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((head.len() as u16).to_le_bytes());
        bytes.extend(head.as_bytes());
        bytes.extend((0..256).flat_map(|k| height(k).to_le_bytes()));
        bytes
    };
    let list = |from: &str, row: &dyn Fn(usize) -> String, between: &str| -> Vec<u8> {
        format!("{from}{}", (0..256).map(row).collect::<Vec<_>>().join(between)).into_bytes()
    };
    let x = |k: usize| (k as f64 - 127.5) * 0.04 / 256.0;
    let exact = solved(case, &one("profile", npy));
    // 70 cells and 3686.5 MPa by the same profile as a column
    assert_eq!(exact.steps[0].contact_cells, 70);
    assert!((exact.steps[0].max_pressure - 3686.5).abs() < 0.05, "{}", exact.steps[0].max_pressure);
    for (form, bytes, tolerance) in [
        ("a column", list("", &|k| format!("{:e}", height(k)), "\n"), 0.0),
        ("a row", list("", &|k| format!("{:e}", height(k)), " "), 0.0),
        ("pairs x z", list("", &|k| format!("{:e} {:e}", x(k), height(k)), "\n"), 0.0),
        // five digits of the heights: 1e-10 mm of an approach of 1e-4
        (
            "pairs in a few digits",
            list("# x z\n", &|k| format!("{:.7};{:.4e}", x(255 - k), height(255 - k)), "\n"),
            1e-5,
        ),
    ] {
        let history = solved(case, &one("profile", bytes));
        assert_eq!(history.steps[0].contact_cells, 70, "{form}");
        let off = history.steps[0].max_pressure / exact.steps[0].max_pressure - 1.0;
        assert!(off.abs() <= tolerance, "{form}: {off:e}");
    }
    let written: Vec<String> = (0..256).map(|k| format!("{:e}", height(k))).collect();
    let values = case.replace("file = \"profile\"", &format!("values = [{}]", written.join(", ")));
    assert_eq!(solved(&values, &Files::new()).steps[0].max_pressure, exact.steps[0].max_pressure);
    let wide = list("", &|k| format!("{:e} {:e}", 1.5 * x(k), height(k)), "\n");
    refused(case, &one("profile", wide), &["points 0.000234375 apart", "0.00015625", "size = 0.06"]);
}

// ---- messages whose way out is one ----

/// Heights of a rough patch [0.02 um], highest at its edge.
fn patch() -> Files {
    let height = |i: usize, j: usize| {
        ((7 * i * i + 13 * j + i * j) % 23) as f64 / 10.0 + if i == 0 { 1.0 } else { 0.0 }
    };
    let row = |i| (0..24).map(|j| format!("{:.1}", height(i, j))).collect::<Vec<_>>().join(" ");
    one("scan", (0..24).map(row).collect::<Vec<_>>().join("\n"))
}

const PATCH: &str = "units = { length = \"um\", force = \"mN\" }\ngrid = { cells = [24, 24], size = [24.0, 24.0] }\nupper = { rigid = true }\n\
    lower = { substrate = { young = 70.0, poisson = 0.3 }, profile = { heights = { file = \"scan\", unit = 0.02 } } }\n\
    friction = { coefficient = 0.3 }\n[[load]]\nnormal_force = 5.0\nincrements = 1\n";

#[test]
fn heights_that_touch_at_the_edge_are_told_a_way_that_exists() {
    let error = outcome(PATCH, &patch()).expect_err("at the edge");
    assert!(
        error.contains("edge of the grid")
            && error.contains("grid.periodic = true")
            && !error.contains("auto"),
        "{error}"
    );
    // and it is one
    let periodic = PATCH.replace("[24.0, 24.0]", "[24.0, 24.0], periodic = true");
    assert!(solved(&periodic, &patch()).steps[0].contact_cells > 0);
}

#[test]
fn periodic_surfaces_slide_by_a_shift_as_they_are_told() {
    let pulled = |head: &str| format!("{head}[[load]]\ntangential_force = [1.6, 0.0]\nincrements = 2\n");
    let half_space = PATCH.replace("[24.0, 24.0]", "[24.0, 24.0], periodic = true");
    let layer = half_space.replace(
        "substrate = { young = 70.0, poisson = 0.3 }",
        "coatings = [{ thickness = 5.0, young = 70.0, poisson = 0.3 }], base = \"rigid\"",
    );
    for periodic in [half_space, layer] {
        refused(&pulled(&periodic), &patch(), &["prescribe the shift to slide"]);
        let shifted = format!("{periodic}[[load]]\nshift = [50.0, 0.0]\nincrements = 2\n");
        let force = solved(&shifted, &patch()).steps[2].tangential_force[0];
        assert!((force / 1.5 - 1.0).abs() < 1e-6); // all of it slides, so far that hardly any slip turns aside
    }
}

// ---- problems with closed forms ----

/// Force on a rigid body of revolution in a half-space of modulus `E*`, `P = 2 E* Int_0^a (d - g) dx` with `g(a) = d`.
fn reduced(g: impl Fn(f64) -> f64, d: f64, modulus: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1e3);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if g(middle) < d { low = middle } else { high = middle }
    }
    let nodes = 20_000;
    2.0 * modulus * low / f64::from(nodes)
        * (0..nodes).map(|k| d - g(low * (f64::from(k) + 0.5) / f64::from(nodes))).sum::<f64>()
}

#[test]
fn blunt_tips_by_their_heights_carry_what_the_reduction_of_dimensions_says() {
    let modulus = 1.0 / 0.91;
    let case = |size: f64, approach: f64| {
        format!(
            "grid = {{ cells = [65, 65], size = [{size:?}, {size:?}] }}\nupper = {{ rigid = true, profile = {{ heights = {{ file = \"tip\" }} }} }}\n\
             lower = {{ substrate = {{ young = 1.0, poisson = 0.3 }} }}\n[[load]]\napproach = {approach:?}\nincrements = 1\n"
        )
    };
    let tip = |size: f64, gap: &dyn Fn(f64) -> f64| {
        let at = |k: usize| (k as f64 - 32.0) * size / 65.0;
        let row =
            |i| (0..65).map(|j| format!("{:e}", -gap(at(i).hypot(at(j))))).collect::<Vec<_>>().join(" ");
        one("tip", (0..65).map(row).collect::<Vec<_>>().join("\n"))
    };
    // a sphere of radius 1 that goes over into a cone of 20 degrees, smoothly at r = b
    let b = 20_f64.to_radians().tan();
    let gap = |r: f64| if r < b { r * r / 2.0 } else { b * r - b * b / 2.0 };
    let g = |x: f64| {
        if x < b { x * x } else { x * (x - (x * x - b * b).sqrt() + b * (PI / 2.0 - (b / x).asin())) }
    };
    let force = reduced(g, 0.3, modulus);
    let history = solved(&case(1.610_038, 0.3), &tip(1.610_038, &gap));
    assert!((force - 0.25522).abs() < 5e-6, "{force}");
    // 44 cells over the contact, whose pressure falls to zero at its edge
    assert!((history.steps[0].normal_force / force - 1.0).abs() < 2e-4, "{}", history.steps[0].normal_force);
    // a paraboloid of radius 10, worn flat within b: P = 2 E* / (3 R) (2 a^2 + b^2) sqrt(a^2 - b^2), d = a/R sqrt(a^2 - b^2), a = 1
    let (b, radius) = (0.5, 10.0);
    let gap = |r: f64| (r * r - b * b).max(0.0) / (2.0 * radius);
    let root = (1.0_f64 - b * b).sqrt();
    let force = 2.0 * modulus / (3.0 * radius) * (2.0 + b * b) * root;
    let history = solved(&case(2.6, root / radius), &tip(2.6, &gap));
    assert!(
        (history.steps[0].normal_force / force - 1.0).abs() < 2e-4,
        "{} of {force}",
        history.steps[0].normal_force
    );
}

#[test]
fn a_rough_surface_is_in_full_contact_from_the_mean_pressure_that_closes_its_deepest_valley() {
    // Waves a_k cos(k x + ..) of the gap need pressures E*/2 |k| a_k: all is closed where the sum with the mean is positive.
    let modulus = 1.0 / 0.91;
    let waves = [(1.0, 0.0, 4e-3), (0.0, 2.0, 2e-3), (3.0, 1.0, 1e-3), (2.0, -3.0, 8e-4)];
    let at = |k: usize| (k as f64 + 0.5) / 32.0;
    let sum = |i: usize, j: usize, of: &dyn Fn(f64) -> f64| -> f64 {
        waves
            .iter()
            .map(|&(m, n, a)| {
                a * of(2.0 * PI * f64::hypot(m, n)) * (2.0 * PI * (m * at(i) + n * at(j))).cos()
            })
            .sum()
    };
    let cells = || (0..32).flat_map(|i| (0..32).map(move |j| (i, j)));
    let closing = cells().map(|(i, j)| -0.5 * modulus * sum(i, j, &|k| k)).fold(0.0, f64::max);
    let row = |i| (0..32).map(|j| format!("{:e}", sum(i, j, &|_| 1.0))).collect::<Vec<_>>().join(" ");
    // Cells of one pressure each respond to a wave a little less: a few per cent of the shortest one here.
    let loads = [0.5, 0.95, 0.999, 1.05]
        .map(|share| format!("[[load]]\nnormal_force = {:e}\nincrements = 1\n", share * closing));
    let case = "grid = { cells = [32, 32], size = [1.0, 1.0], periodic = true }\nupper = { rigid = true }\n\
        lower = { substrate = { young = 1.0, poisson = 0.3 }, profile = { heights = { file = \"scan\" } } }\n";
    let history = solved(
        &format!("{case}{}", loads.concat()),
        &one("scan", (0..32).map(row).collect::<Vec<_>>().join("\n")),
    );
    let touching: Vec<usize> = history.steps.iter().map(|step| step.contact_cells).collect();
    assert!(touching[0] < touching[1] && touching[1] < touching[2] && touching[2] < 1024, "{touching:?}");
    assert_eq!(touching[3], 1024);
}

#[test]
fn two_spheres_crossed_wires_and_a_shear_strength_have_their_closed_forms() {
    let head = |cells: usize| {
        format!(
            "units = {{ length = \"mm\", force = \"N\" }}\ngrid = {{ cells = [{cells}, {cells}], size = \"auto\" }}\n"
        )
    };
    let spheres = head(128)
        + "upper = { substrate = { young = 20000.0, poisson = 0.3 }, profile = { sphere = { radius = 50.0 } } }\n\
           lower = { substrate = { young = 20000.0, poisson = 0.3 }, profile = { sphere = { radius = 50.0 } } }\n\
           [[load]]\napproach = 4.0\nincrements = 1\n";
    let history = solved(&spheres, &Files::new());
    let step = &history.steps[0];
    // Hertz: a^2 = R d with R = 25, P = 4/3 E* sqrt(R) d^1.5, p0 = 3 P / (2 pi a^2), E* = E / (2 (1 - nu^2))
    let modulus = 20_000.0 / 1.82;
    let force = 4.0 / 3.0 * modulus * 5.0 * 8.0;
    let off = [step.normal_force / force - 1.0, step.max_pressure / (1.5 * force / (PI * 100.0)) - 1.0];
    assert!((force - 586_081.0).abs() < 1.0 && off.iter().all(|off| off.abs() < 3e-4), "{off:?}"); // some 50 cells in the radius

    let wires = head(48)
        + "upper = { substrate = { young = 200000.0, poisson = 0.3 }, profile = { cylinder = { radius = 0.25, axis = \"x\" } } }\n\
           lower = { substrate = { young = 200000.0, poisson = 0.3 }, profile = { cylinder = { radius = 0.25, axis = \"y\" } } }\n\
           [[load]]\nnormal_force = 1.0\nincrements = 1\n";
    let exact = Hertz::sphere(0.25, 1.0, 200_000.0 / 1.82).unwrap();
    let approach = solved(&wires, &Files::new()).steps[0].approach;
    assert!(
        (exact.approach - 5.7116e-4).abs() < 1e-8 && (approach / exact.approach - 1.0).abs() < 5e-4,
        "{approach}"
    ); // 20 cells

    let bounded = head(64)
        + "upper = { substrate = { young = 210000.0, poisson = 0.3 } }\nlower = { substrate = { young = 210000.0, poisson = 0.3 } }\n\
           profile = { sphere = { radius = 10.0 } }\nfriction = { coefficient = 0.3, max_shear = 100.0 }\n\
           [[load]]\nnormal_force = 50.0\nincrements = 1\n[[load]]\nshift = [0.01, 0.0]\nincrements = 8\n";
    // the sum of min(mu p, s mu p0) over Hertz's ellipsoid: pi a^2 mu p0 (s - s^3/3)
    let exact = Hertz::sphere(10.0, 50.0, 210_000.0 / 1.82).unwrap();
    let s = 100.0 / (0.3 * exact.max_pressure);
    let force = PI * exact.contact_radius.powi(2) * 0.3 * exact.max_pressure * (s - s.powi(3) / 3.0);
    let history = solved(&bounded, &Files::new());
    let pulled = history.steps.last().unwrap().tangential_force[0];
    assert!((force - 6.6773).abs() < 1e-3 && (pulled / force - 1.0).abs() < 2e-3, "{pulled} of {force}"); // 1/25 of a radius a cell
}

#[test]
fn one_contact_in_four_systems_of_units_is_one_contact() {
    // Lengths and forces of one system in another; 1 lbf and 1 in by definition.
    let case = |length: f64, force: f64| {
        let pressure = force / (length * length);
        format!(
            "grid = {{ cells = [32, 32], size = \"auto\" }}\nupper = {{ substrate = {{ young = {:e}, poisson = 0.33 }} }}\n\
             lower = {{ coatings = [{{ thickness = {:e}, young = {:e}, poisson = 0.2 }}], substrate = {{ young = {:e}, poisson = 0.3 }} }}\n\
             profile = {{ sphere = {{ radius = {:e} }} }}\nfriction = {{ coefficient = 0.4 }}\n\
             [[load]]\nnormal_force = {:e}\nincrements = 6\nramp = \"cubic\"\n[[load]]\ntangential_force = [{:e}, 0.0]\ncycles = 1\nincrements = 16\n",
            72e9 * pressure,
            20e-6 * length,
            300e9 * pressure,
            210e9 * pressure,
            5e-3 * length,
            10.0 * force,
            2.4 * force
        )
    };
    let si = solved(&case(1.0, 1.0), &Files::new());
    for (length, force) in [(1e3, 1.0), (1e6, 1e3), (1.0 / 0.0254, 1.0 / 4.448_221_615_260_5)] {
        let history = solved(&case(length, force), &Files::new());
        for (one, other) in si.steps.iter().zip(&history.steps) {
            // the tolerance of the solver is 1e-8, and rounding takes other ways
            let same = |one: f64, other: f64, of: f64| (one - other).abs() <= 1e-7 * of;
            assert!(same(
                one.max_pressure * force / (length * length),
                other.max_pressure,
                other.max_pressure
            ));
            assert!(same(
                one.dissipated_energy * force * length,
                other.dissipated_energy,
                history.steps.last().unwrap().dissipated_energy
            ));
            assert_eq!(one.contact_cells, other.contact_cells);
        }
    }
}
