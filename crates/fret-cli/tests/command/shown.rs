//! `report` and `export`: what a run found, for people and for other programs. Judged against the raw files of the result folder.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

/// The small sphere, solved, with every field.
fn solved(test: &str) -> Bench {
    let bench = Bench::new(test);
    let all = SPHERE
        .replace("\"zone\"]", "\"slip\", \"gap\", \"zone\"]")
        .replace("poisson = 0.3", "poisson = 0.5")
        .replace("a small sphere", "a small <sphere> & \\\"more\\\"");
    let answer = bench.file("case.toml", &all).fret(&["run", "case.toml", "--out", "run", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    bench
}

/// The bytes of a stored field; a checksum of four bytes stands behind them.
fn raw(bench: &Bench, array: &str, place: usize) -> Vec<u8> {
    let mut chunk =
        std::fs::read(bench.folder.join(format!("run/fields.zarr/{array}/c/{place}/0/0"))).unwrap();
    chunk.truncate(chunk.len() - 4);
    chunk
}

pub fn floats(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).collect()
}

#[test]
fn the_page_stands_alone_and_is_well_formed() {
    let bench = solved("report");
    let answer = bench.fret(&["report", "run"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(answer.out.trim(), "run/report.html");
    let page = bench.text("run/report.html");
    assert_stands_alone(&page);
    for chapter in [
        "Through the history",
        "Fretting loop",
        "Sections through the contact",
        "Stick and slip",
        "Dissipated energy",
        "Against the closed form",
        "Convergence",
        "Automatic simplifications",
        "To cite",
        "Hertz",
        "prefers-color-scheme: dark",
        "@media print",
    ] {
        assert!(page.contains(chapter), "the page lacks {chapter:?}");
    }
    assert!(page.contains("a small &lt;sphere&gt; &amp; &quot;more&quot;"), "the title is text, not tags");
    assert!(!page.contains("NaN") && !page.contains(">inf"), "every number is one");
    assert_balanced(&page);
}

/// No address but those that hold their content, no word by which a script reaches out, and an order to the browser to refuse both.
pub fn assert_stands_alone(page: &str) {
    assert!(page.contains(
        "content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'\""
    ));
    for (place, _) in page.match_indices("src=\"").chain(page.match_indices("href=\"")) {
        let address = page[place..].split('"').nth(1).unwrap();
        // a picture, or another place of the page
        let is_inside = address.starts_with("data:image/") || address.starts_with('#');
        assert!(is_inside, "{}", &address[..address.len().min(60)]);
    }
    // what images hold is letters without meaning; the policy itself is not an address
    let rest: String = page
        .split("base64,")
        .map(|part| {
            part.trim_start_matches(|letter: char| letter.is_ascii_alphanumeric() || "+/=".contains(letter))
        })
        .collect();
    let rest = rest.replace("http-equiv", "");
    for outside in [
        "http",
        "//www",
        "@import",
        "url(",
        "fetch(",
        "XMLHttpRequest",
        "WebSocket",
        "sendBeacon",
        "import(",
        "<link",
        "<iframe",
    ] {
        assert!(!rest.contains(outside), "the page reaches outside: {outside}");
    }
}

/// The slider's moments, and a chart's path turned back into numbers by what its frame says: they are those of the raw files.
#[test]
fn the_slider_shows_the_numbers_of_the_files() {
    let bench = solved("report-slider");
    assert_eq!(bench.fret(&["report", "run", "--out", "page.html"]).code, Some(0));
    let page = bench.text("page.html");
    let held = page.split("id=\"moments\">").nth(1).unwrap().split("</script>").next().unwrap();
    let moments: Vec<Value> = serde_json::from_str(held).unwrap();
    assert_eq!(moments.len(), 5, "one for each kept increment");
    let chart = page.split("aria-label=\"pressure along a line through the contact\"").nth(1).unwrap();
    let axes: Vec<f64> =
        serde_json::from_str(chart.split("data-axes=\"").nth(1).unwrap().split('"').next().unwrap()).unwrap();
    let [_, _, lower, upper, _, _, y0, y1, _] = axes[..] else { panic!("nine numbers") };
    for (place, moment) in moments.iter().enumerate() {
        let path = moment["pressure-line"]["d"].as_str().unwrap();
        let heights = path
            .split(['M', 'L'])
            .filter(|point| !point.is_empty())
            .map(|point| point.split(' ').nth(1).unwrap());
        let highest = heights.map(|height| height.parse::<f64>().unwrap()).fold(f64::INFINITY, f64::min);
        let shown = y0 + (highest - lower) / (upper - lower) * (y1 - y0);
        let field = floats(&raw(&bench, "pressure", place));
        let middle = (0..24).map(|i| field[i * 24 + 12]).fold(0.0, f64::max);
        // A tenth of a unit of the drawing.
        assert!(
            (shown - middle).abs() <= 0.06 * ((y1 - y0) / (upper - lower)).abs(),
            "{place}: {shown} for {middle}"
        );
    }
    let last = moments.last().unwrap();
    assert!(last["word-increment"]["text"].as_str().unwrap().starts_with("18: "), "{last}");
}

/// Without scripts the figures of one increment stand there, and words instead of the slider.
#[test]
fn the_page_is_readable_without_scripts() {
    let bench = solved("report-still");
    assert_eq!(bench.fret(&["report", "run", "--out", "page.html"]).code, Some(0));
    let page = bench.text("page.html");
    assert!(page.contains("id=\"slider\" hidden") && page.contains("<noscript>"));
    for drawn in [
        "id=\"pressure-line\" d=\"M",
        "id=\"shear-line\" d=\"M",
        "id=\"map-0\" href=\"data:image/png",
        "id=\"here\" r",
    ] {
        assert!(page.contains(drawn), "{drawn}");
    }
}

/// Units are declared once: every axis, table and card has them; numbers stay as they are.
#[test]
fn declared_units_stand_on_axes_and_beside_numbers() {
    let bench = Bench::new("report-units");
    let case = SPHERE.replace("[grid]", "[units]\nlength = \"m\"\nforce = \"N\"\n\n[grid]");
    assert_eq!(
        bench.file("case.toml", &case).fret(&["run", "case.toml", "--out", "run", "--quiet"]).code,
        Some(0)
    );
    assert_eq!(bench.fret(&["report", "run"]).code, Some(0));
    let page = bench.text("run/report.html");
    for words in [
        "approach [10⁻⁹ m]",
        "normal force [N]",
        "Units: length m, force N, pressure Pa.",
        "\u{a0}Pa</dd>",
        "\u{a0}N m</dd>",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert_stands_alone(&page);
}

/// Every tag that opens closes again, in order.
pub fn assert_balanced(page: &str) {
    let mut open: Vec<&str> = Vec::new();
    let without_scripts: String = page
        .split("<script")
        .enumerate()
        .map(|(n, part)| if n == 0 { part } else { part.split_once("</script>").unwrap().1 })
        .collect();
    for part in without_scripts.split('<').skip(1) {
        let (tag, _) = part.split_once('>').unwrap();
        let name = tag.split([' ', '\n', '/']).find(|word| !word.is_empty()).unwrap_or("");
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name));
        } else if !(tag.ends_with('/')
            || tag.starts_with('!')
            || ["meta", "img", "input", "br"].contains(&name))
        {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

/// Hertz: the middle of the grid is a corner of cells of 10e-6, so the largest pressure of a cell stands 7.1e-6 beside the peak:
/// sqrt(1 - (7.1 / 30)^2) of it, 2.8 % less; the coarse grid may add half a percent.
#[test]
fn the_page_compares_with_the_closed_form() {
    let bench = solved("report-closed");
    assert_eq!(bench.fret(&["report", "run", "--out", "page.html"]).code, Some(0));
    let page = bench.text("page.html");
    let row = page.split("<td>max pressure</td>").nth(1).unwrap();
    let cells: Vec<&str> = row.split("</td>").take(3).map(|cell| cell.trim_start_matches("<td>")).collect();
    // 6 W E*^2 / (pi^3 R^2), cube root, with E* = E / (1 - 0.25): 5.3334e8.
    assert_eq!(cells[1], "5.3334 · 10⁸");
    let off: f64 = cells[2].replace('−', "-").trim_end_matches(" %").parse().unwrap();
    assert!((-3.3..-2.3).contains(&off), "{off} %");
}

/// A run that starts from a tilted or worn state is no contact of Hertz, though its own case does not tilt or wear; one that starts from a
/// state with slip is one, but no first loading of Cattaneo's.
#[test]
fn what_a_run_starts_from_is_asked_before_a_closed_form_is_drawn() {
    let bench = Bench::new("report-started");
    let (head, _) = SPHERE.split_once("[[load]]").unwrap();
    let head = head.replace("rigid = true", "substrate = { young = 210e9, poisson = 0.3 }");
    let solve = |name: &str, stages: &str, more: &[&str]| {
        let file = format!("{name}.toml");
        bench.file(&file, &format!("{head}{stages}"));
        let answer = bench.fret(&[&["run", &file, "--out", name, "--quiet"], more].concat());
        assert_eq!(answer.code, Some(0), "{name}: {}", answer.err);
        assert_eq!(bench.fret(&["report", name, "--out", "page.html"]).code, Some(0));
        let page = bench.text("page.html");
        ["<td>max pressure</td>", "<td>radius of stick</td>"].map(|row| page.contains(row))
    };
    let press = |more: &str| format!("[[load]]\nnormal_force = 1.0\n{more}\nincrements = 3\n");
    let rub = "[[load]]\ntangential_force = [0.05, 0.0]\nincrements = 4\n";
    assert_eq!(solve("plain", &(press("") + rub), &[]), [true, true]);
    let moving = "[kinematics]\ndisplacement = \"finite\"\n";
    assert_eq!(solve("moving", &(moving.to_owned() + &press("") + rub), &[]), [false, false]);
    assert_eq!(solve("flat", &press(""), &[]), [true, false]);
    assert_eq!(solve("tilted", &press("tilt = [1e-3, \"held\"]"), &[]), [false, false]);
    assert_eq!(solve("from-tilted", rub, &["--from", "tilted"]), [false, false]);
    let back = "[[load]]\ntangential_force = [-0.02, 0.0]\nincrements = 2\n";
    assert_eq!(solve("from-slipped", back, &["--from", "plain"]), [true, false]);
    let wear = "[wear]\ncoefficient = 1e-13\n";
    assert_eq!(solve("worn", &(wear.to_owned() + &press("") + rub), &[]), [false, false]);
    assert_eq!(solve("from-worn", back, &["--from", "worn"]), [false, false]);
}

#[test]
fn a_run_that_is_not_solved_is_shown_as_far_as_it_came() {
    let bench = solved("report-part");
    let record = bench.text("run/run.json").replace("\"status\": \"solved\"", "\"status\": \"interrupted\"");
    bench.file("run/run.json", &record);
    let table = bench.text("run/history.csv");
    let lines: Vec<&str> = table.lines().collect();
    // Ten increments and a torn line.
    bench.file("run/history.csv", &format!("{}\n10,1,1.0,8.9", lines[..11].join("\n")));
    let answer = bench.fret(&["report", "run", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let told: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!((&told["status"], &told["increments"]), (&"reported".into(), &10.into()));
    assert!(
        bench.text("run/report.html").contains("Not the whole history, 10 of 19 increments: interrupted")
    );
}

#[test]
fn an_npz_holds_the_bits_of_the_store() {
    let bench = solved("npz");
    let answer = bench.fret(&["export", "run", "--npz", "--out", "run.npz"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let archive = std::fs::read(bench.folder.join("run.npz")).unwrap();
    // Stored without compression: every field must stand in it as it is, in the order of the steps.
    for name in ["pressure", "shear_x", "slip_y", "gap", "zone"] {
        let whole: Vec<u8> = (0..5).flat_map(|place| raw(&bench, name, place)).collect();
        let found = archive.windows(whole.len()).any(|window| window == whole);
        assert!(found, "{name}");
        let head = "'shape': (5, 24, 24,)".to_string();
        assert!(archive.windows(head.len()).filter(|window| *window == head.as_bytes()).count() >= 5);
    }
    assert_eq!(&archive[..4], b"PK\x03\x04");
}

#[test]
fn a_vtk_image_holds_the_fields_with_x_fastest() {
    let bench = solved("vtk");
    let answer = bench.fret(&["export", "run", "--vtk", "--out", "images", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let told: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(told["files"].as_array().map(Vec::len), Some(6), "a list and five images");
    let list = bench.text("images/history.pvd");
    assert!(list.contains("timestep=\"18\"") && list.contains("file=\"fields_000018.vti\""), "{list}");
    let image = std::fs::read(bench.folder.join("images/fields_000018.vti")).unwrap();
    let start = image.windows(2).position(|window| window == b"\n_").unwrap() + 2;
    let length = u64::from_le_bytes(image[start..start + 8].try_into().unwrap());
    assert_eq!(length, 8 * 24 * 24);
    let pressure = floats(&image[start + 8..][..8 * 24 * 24]);
    let stored = floats(&raw(&bench, "pressure", 4));
    for i in 0..24 {
        for j in 0..24 {
            assert_eq!(pressure[j * 24 + i].to_bits(), stored[i * 24 + j].to_bits());
        }
    }
}

#[test]
fn csv_reads_back_as_the_same_numbers() {
    let bench = solved("csv");
    assert_eq!(bench.fret(&["export", "run", "--csv"]).code, Some(0));
    assert_eq!(bench.text("run/csv/history.csv"), bench.text("run/history.csv"));
    let text = bench.text("run/csv/fields_000018.csv");
    assert_eq!(text.lines().next(), Some("x,y,pressure,shear_x,shear_y,slip_x,slip_y,gap,zone"));
    assert_eq!(text.lines().count(), 1 + 24 * 24);
    let (pressure, zone) = (floats(&raw(&bench, "pressure", 4)), raw(&bench, "zone", 4));
    for (cell, line) in text.lines().skip(1).enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[2].parse(), Ok(pressure[cell]));
        assert_eq!(cells[8].parse(), Ok(zone[cell]));
    }
}

#[test]
fn what_is_no_result_is_refused_and_nothing_is_written() {
    let bench = solved("no-results");
    bench.file("note.txt", "mine");
    std::fs::create_dir(bench.folder.join("empty")).unwrap();
    let before = bench.names();
    for (arguments, words) in [
        (&["report", "nowhere"][..], "no such folder"),
        (&["report", "note.txt"], "a file, not a folder"),
        (&["report", "empty"], "it has no run.json"),
        (&["report", "run", "--out", "empty"], "a folder"),
        (&["report", "run", "--out", "note.txt"], "no .html file"),
        (&["export", "nowhere", "--npz"], "no such folder"),
        (&["export", "run"], "--npz"),
        (&["export", "run", "--npz", "--out", "empty"], "a folder"),
        (&["export", "run", "--npz", "--out", "note.txt"], "no .npz file"),
        (&["export", "run", "--vtk", "--out", "note.txt"], "a file, where the export is a folder"),
        (&["export", "run", "--vtk", "--csv", "--out", "both"], "one form at a time"),
    ] {
        let answer = bench.fret(arguments);
        assert_eq!(answer.code, Some(1), "{arguments:?}: {}", answer.err);
        assert!(answer.err.contains(words), "{arguments:?}: expected {words:?}: {}", answer.err);
        let told = bench.fret(&[arguments, &["--json"]].concat());
        let told: Value = serde_json::from_str(&told.out).unwrap();
        assert_eq!(told["status"], "refused", "{arguments:?}");
    }
    assert_eq!(bench.names(), before);
    assert_eq!(bench.text("note.txt"), "mine");
    assert_eq!(bench.fret(&["export", "run", "--csv", "--out", "note.txt/below"]).code, Some(2));
}

#[test]
fn results_that_were_tampered_with_are_refused_without_a_fall() {
    let bench = solved("tampered");
    for (file, content, words) in [
        ("run.json", "{}", "another program"),
        ("run.json", "[[[[", "not what a run writes"),
        ("history.csv", "increment,stage\n0", "no column"),
        ("history.csv", "", "no column"),
        ("fields.zarr/pressure/zarr.json", "{\"shape\": [5, 1000000000, 1000000000]}", "not an array"),
        ("fields.zarr/pressure/c/4/0/0", "short", "bytes where the grid asks for"),
        ("fields.zarr/x/c/0", "", "no grid"),
        ("fields.zarr/increment/c/0", "\u{0}\u{0}\u{0}\u{0}\u{0}\u{0}\u{0}\u{0}", "asks for 40"),
    ] {
        let path = bench.folder.join("run").join(file);
        let good = std::fs::read(&path).unwrap();
        std::fs::write(&path, content).unwrap();
        let answer = bench.fret(&["export", "run", "--npz"]);
        assert_eq!(answer.code, Some(1), "{file}: {}", answer.err);
        assert!(answer.err.contains(words), "{file}: expected {words:?}: {}", answer.err);
        assert!(!answer.err.contains("panicked"), "{}", answer.err);
        std::fs::write(&path, good).unwrap();
    }
}

/// Where the points stand is not known before; under the chart nothing is laid over them.
#[test]
fn the_residual_that_was_asked_for_is_named_under_its_chart() {
    let bench = solved("report-level");
    assert_eq!(bench.fret(&["report", "run", "--out", "page.html"]).code, Some(0));
    let page = bench.text("page.html");
    let named: Vec<&str> = page.split(">tolerance</").collect();
    assert_eq!(named.len(), 2);
    assert!(named[1].starts_with("li>"), "{}", &named[1][..20]);
    let chart = page.split("aria-label=\"residual of every increment\"").nth(1).unwrap();
    let (drawing, legend) = chart.split_once("</svg>").unwrap();
    assert!(drawing.contains("class=\"level\"") && !drawing.contains(">tolerance<"));
    assert!(legend.trim_start().starts_with("<ul class=\"legend\">"), "{}", &legend[..40]);
}
