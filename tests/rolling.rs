//! Contacts that roll: Carter's creepage, the numbers of CONTACT's example, and one problem in the frames of the bodies and of the contact.

use std::f64::consts::PI;

use fret_core::history::History;
use fret_validation::{run, solved};

/// Two cylinders of one material with E* = 1 and the relative radius 100, pressed to a half-width of 1; friction 0.3.
fn cylinders(grid: &str, kinematics: &str, loads: &str) -> String {
    let force = PI / 400.0;
    format!(
        "[grid]\n{grid}\n[upper]\nsubstrate = {{ young = 1.82, poisson = 0.3 }}\n[lower]\nsubstrate = {{ young = 1.82, poisson = 0.3 }}\n\
         [profile.cylinder]\nradius = 100.0\naxis = \"y\"\n[friction]\ncoefficient = 0.3\n[kinematics]\n{kinematics}\n[solver]\ntolerance = 1e-9\n\
         [[load]]\nnormal_force = {force:e}\nincrements = 1\n{loads}"
    )
}

/// Carter (1926): under a tractive force Q the creepage is `mu a/R (1 - sqrt(1 - Q/(mu P)))`, and the stick zone of half-length
/// `a sqrt(1 - Q/(mu P))` lies at the leading edge.
#[test]
fn the_creepage_of_cylinders_is_carters() {
    for (fraction, expected) in [(0.25, 0.133_975), (0.5, 0.292_893), (0.75, 0.5), (0.9, 0.683_772)] {
        let force = fraction * 0.3 * PI / 400.0;
        let loads = format!(
            "[[load]]\ntangential_force = [{force:e}, 0.0]\nincrements = 4\n[[load]]\nroll = 3.5\nincrements = 280\n"
        );
        let history = solved(&cylinders("cells = 256\nsize = 3.2", "frame = \"contact\"", &loads));
        let last = history.steps.last().unwrap();
        let [creepage, across] = last.creepage.unwrap();
        let found = creepage * 100.0 / 0.3;
        let zones = history.fields.last().unwrap().zone.as_ref().unwrap();
        let stick: Vec<usize> =
            (0..256).filter(|i| zones[[*i, 0]] == fret_core::model::Zone::Stick).collect();
        let half = 0.5 * stick.len() as f64 * 3.2 / 256.0;
        println!(
            "Carter, Q = {fraction} mu P: creepage {found:.6} ({:+.2} %), stick {half:.4} of {:.4}, up to x = {:.3}",
            100.0 * (found / expected - 1.0),
            (1.0_f64 - fraction).sqrt(),
            history.grid.centre(0, *stick.last().unwrap())
        );
        assert!((found / expected - 1.0).abs() < 0.005 && across == 0.0, "{found}");
        // to a cell at either end, and at the leading edge to one
        assert!((half - (1.0_f64 - fraction).sqrt()).abs() < 0.0125);
        assert!((history.grid.centre(0, *stick.last().unwrap()) - 1.0).abs() < 0.02);
    }
}

/// The example carter2d of CONTACT (Vollebregt), 50 elements over the contact: G = 82 000, nu = 0.28, P = 178.9 a unit of length, R = 500,
/// mu = 0.3, creepage 2.4e-4 gives Q = 0.6480 mu P by its rule, which is that of end points, an element an increment. Exact: 0.64.
#[test]
fn creepage_prescribed_gives_the_force_of_contacts_example() {
    let text = |integration: &str| {
        format!(
            "[grid]\ncells = 60\nsize = 2.4\n[upper]\nsubstrate = {{ young = 209920.0, poisson = 0.28 }}\n[lower]\n\
             substrate = {{ young = 209920.0, poisson = 0.28 }}\n[profile.cylinder]\nradius = 500.0\naxis = \"y\"\n[friction]\ncoefficient = 0.3\n\
             [kinematics]\nframe = \"contact\"\n[solver]\nintegration = \"{integration}\"\n\
             [[load]]\nnormal_force = 178.9\nincrements = 1\n[[load]]\nroll = 4.0\ncreepage = [2.4e-4, 0.0]\nincrements = 100\n"
        )
    };
    let force = |text: &str| {
        let history = run(text).unwrap();
        let last = history.steps.last().unwrap();
        assert!((last.creepage.unwrap()[0] / 2.4e-4 - 1.0).abs() < 1e-9);
        last.tangential_force[0] / (0.3 * 178.9)
    };
    let [ends, second] = [force(&text("end_point")), force(&text("second_order"))];
    println!(
        "carter2d: Q/(mu P) = {ends:.4} by end points (CONTACT 0.6480), {second:.4} of second order (exact 0.64)"
    );
    assert!((ends - 0.6480).abs() < 2e-4, "{ends}");
    assert!((second - 0.64).abs() < 0.5 * (0.648 - 0.64), "{second}");
}

fn ball(frame: &str, integration: &str) -> History {
    // cells of 0.1 in both; the grid of the bodies holds the way
    let [cells, size] = if frame == "bodies" { [64, 28].map(|n| n as f64) } else { [28.0, 28.0] };
    solved(&format!(
        "[grid]\ncells = [{cells}, {size}]\nsize = [{:?}, {:?}]\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.2 }}\n\
         [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n[kinematics]\nframe = \"{frame}\"\n\
         [solver]\ntolerance = 1e-9\nintegration = \"{integration}\"\n[output]\nevery = 1\n\
         [[load]]\nnormal_force = 1.2e-2\nincrements = 3\n[[load]]\ntangential_force = [1e-3, 0.0]\nincrements = 2\n\
         [[load]]\nroll = [1.6, 0.0]\nincrements = 16\n",
        0.1 * cells,
        0.1 * size
    ))
}

/// A rigid ball on an elastic flat, pulled and rolled: the grid fixed to the bodies, or with the contact, is one problem.
#[test]
fn the_frame_of_the_bodies_and_that_of_the_contact_agree() {
    for integration in ["end_point", "second_order"] {
        let [bodies, contact] = ["bodies", "contact"].map(|frame| ball(frame, integration));
        let mut largest = 0.0_f64;
        for (step, rolled) in (5..21).zip(1..=16_usize) {
            let [one, other] = [&bodies, &contact].map(|history| history.fields_of(step).unwrap());
            let (p, r) = (one.pressure.as_ref().unwrap(), other.pressure.as_ref().unwrap());
            let (q, s) = (&one.shear.as_ref().unwrap()[0], &other.shear.as_ref().unwrap()[0]);
            let most = r.iter().copied().fold(0.0, f64::max);
            for ((i, j), pressure) in r.indexed_iter() {
                let at = [i + 18 + rolled, j];
                largest = largest.max((p[at] - pressure).abs() / most).max((q[at] - s[[i, j]]).abs() / most);
            }
        }
        let [one, other] =
            [&bodies, &contact].map(|history| history.steps.last().unwrap().creepage.unwrap()[0]);
        println!(
            "frames, {integration}: tractions differ by {largest:.1e} of the largest pressure, creepage {one:.6e} {other:.6e}"
        );
        // residuals of 1e-9; the rule of second order sees the cells at the edge of the region otherwise
        assert!(largest < if integration == "end_point" { 1e-6 } else { 1e-3 }, "{largest:e}");
        assert!(one > 0.0 && (one / other - 1.0).abs() < 1e-3);
    }
}
