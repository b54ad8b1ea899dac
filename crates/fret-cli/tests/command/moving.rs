//! Surfaces that move, on the page of a run: the scar of each body, and the surfaces in the slider. Judged against the shape of the cylinder in
//! closed form, and the raw files of the results.

use serde_json::Value;

use crate::bench::Bench;
use crate::shown::floats;
use crate::swept::column;

/// A cylinder of radius 6 that rubs a flat in gross slip, and wears it and is worn.
const CYLINDER: &str = r#"[grid]
cells = 64
size = 0.6
datum = 6.0

[upper]
substrate = { young = 200e3, poisson = 0.3, wear_coefficient = 1.9e-8 }

[lower]
substrate = { young = 200e3, poisson = 0.3, wear_coefficient = 2.9e-8 }

[profile.cylinder]
radius = 6.0
axis = "y"

[friction]
coefficient = 0.8

[kinematics]
displacement = "finite"

[wear]
law = "archard"
every = 100
largest_step = 0.05

[[load]]
name = "press"
normal_force = 18.5
increments = 4

[[load]]
name = "fretting"
shift = [0.025, 0.0]
increments = 8
cycles = 100

[output]
fields = ["pressure", "worn_depth"]
every = 3
"#;

/// The page of a case, and the numbers of the increments it shows: moments of the slider, and the axes of a chart.
struct Page {
    text: String,
    moments: Vec<Value>,
}

impl Page {
    fn of(bench: &Bench, case: &str) -> Self {
        let answer = bench.file("case.toml", case).fret(&["run", "case.toml", "--out", "run", "--quiet"]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        assert_eq!(bench.fret(&["report", "run"]).code, Some(0));
        let text = bench.text("run/report.html");
        let held = text.split("id=\"moments\">").nth(1).unwrap().split("</script>").next().unwrap();
        let moments = serde_json::from_str(held).unwrap();
        Self { text, moments }
    }

    /// The frame of a chart.
    fn axes(&self, chart: &str) -> Vec<f64> {
        let chart = self.text.split(&format!("aria-label=\"{chart}\"")).nth(1).unwrap();
        let axes = chart.split("data-axes=\"").nth(1).unwrap().split('"').next().unwrap();
        serde_json::from_str(axes).unwrap()
    }

    /// Points of a path in a frame.
    fn points(path: &str, axes: &[f64]) -> Vec<[f64; 2]> {
        let [left, right, lower, upper, x0, x1, y0, y1, _] = axes[..] else { panic!("nine numbers") };
        let point = |point: &str| {
            let (x, y) = point.trim().split_once(' ').unwrap();
            let [x, y]: [f64; 2] = [x, y].map(|number| number.parse().unwrap());
            [x0 + (x - left) / (right - left) * (x1 - x0), y0 + (y - lower) / (upper - lower) * (y1 - y0)]
        };
        path.split(['M', 'L']).filter(|part| !part.is_empty()).map(point).collect()
    }

    /// A surface at a moment.
    fn surface(&self, moment: &Value, body: &str) -> Vec<[f64; 2]> {
        let axes = self.axes("surfaces along a line through the contact");
        Self::points(moment[format!("{body}-surface")]["d"].as_str().unwrap(), &axes)
    }
}

const SCARS: &str =
    "wear depth of the upper body, in its own frame, which moves with it along a line through the contact";

/// A tenth of a unit of a drawing of 200 units of height.
fn drawn(axes: &[f64]) -> f64 {
    (axes[7] - axes[6]).abs() / 1500.0
}

#[test]
fn a_cylinder_that_does_not_wear_moves_as_a_parabola() {
    let bench = Bench::new("moving-unworn");
    let (before, rest) = CYLINDER.split_once("[wear]").unwrap();
    let rest = rest.split_once("[[load]]").unwrap().1.replace("cycles = 100\n", "cycles = 1\n");
    let before = before.replace(", wear_coefficient = 1.9e-8", "").replace(", wear_coefficient = 2.9e-8", "");
    let page = Page::of(&bench, &format!("{before}[[load]]{rest}").replace(", \"worn_depth\"", ""));
    let shifts = column(&bench.text("run/history.csv"), "shift_x");
    let axes = page.axes("surfaces along a line through the contact");
    let mut farthest = 0.0_f64;
    for moment in &page.moments {
        let increment = moment["word-increment"]["text"].as_str().unwrap().split(':').next().unwrap();
        let shift: f64 = shifts[increment.parse::<usize>().unwrap()].parse().unwrap();
        farthest = farthest.max(shift.abs());
        assert!(page.surface(moment, "lower").iter().all(|[_, z]| z.abs() <= drawn(&axes)), "a flat");
        // Its lowest cell touches the flat: up to half a cell off the lowest point of the parabola.
        let lowest = (0.6_f64 / 64.0 / 2.0).powi(2) / 12.0;
        for [x, z] in page.surface(moment, "upper") {
            let exact = (x - shift).powi(2) / 12.0;
            // The slope of the parabola over a tenth of a unit across.
            let off = drawn(&axes) + (x - shift).abs() / 6.0 * 1e-4 + lowest;
            assert!((z - exact).abs() <= off, "{x} {z} against {exact}, shift {shift}");
        }
    }
    assert!((farthest - 0.025).abs() < 1e-9, "the turn is kept: {farthest}");
}

#[test]
fn each_body_has_its_scar_in_its_own_frame() {
    let bench = Bench::new("moving-worn");
    let page = Page::of(&bench, CYLINDER);
    for words in
        ["Wear depth of the lower body,", "Wear depth of the upper body, in its own frame", "Wear scars"]
    {
        assert!(page.text.contains(words), "the page lacks {words:?}");
    }
    assert!(!page.text.contains("both bodies together"), "they move against each other");
    assert!(!page.text.contains("NaN"), "every number is one");
    crate::shown::assert_balanced(&page.text);
    let deepest = |name: &str, place: usize| {
        let chunk = std::fs::read(bench.folder.join(format!("run/fields.zarr/{name}/c/{place}/0"))).unwrap();
        floats(&chunk[..chunk.len() - 4]).into_iter().fold(0.0, f64::max)
    };
    let axes = page.axes("surfaces along a line through the contact");
    let last = page.moments.len() - 1;
    let mut worn = 0.0;
    for (place, moment) in page.moments.iter().enumerate() {
        let lowest = page.surface(moment, "lower").iter().map(|[_, z]| *z).fold(0.0, f64::min);
        worn = deepest("lower_worn_depth", place);
        assert!((lowest + worn).abs() <= drawn(&axes), "{place}: {lowest} against {worn}");
    }
    assert!(worn > 10.0 * drawn(&axes), "there is a scar that can be seen");
    let axes = page.axes(SCARS);
    let chart = page.text.split(&format!("aria-label=\"{SCARS}\"")).nth(1).unwrap();
    let chart = chart.split("</svg>").next().unwrap();
    let highest = chart
        .split("<path class=\"line")
        .skip(1)
        .flat_map(|path| Page::points(path.split(" d=\"").nth(1).unwrap().split('"').next().unwrap(), &axes))
        .map(|[_, depth]| depth)
        .fold(0.0, f64::max);
    let upper = deepest("upper_worn_depth", last);
    assert!((highest - upper).abs() <= drawn(&axes), "{highest} against {upper}");
    assert!((upper - worn).abs() > 10.0 * drawn(&axes), "the scars differ");
}
