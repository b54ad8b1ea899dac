use crate::case::Case;

fn read([upper, coating, substrate, wear]: [&str; 4]) -> Result<Case, String> {
    let text = format!(
        "[grid]\ncells = [16, 16]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n{upper}\n[lower]\n\
         coatings = [{{ thickness = 0.5, young = 2.0, poisson = 0.3{coating} }}]\n\
         substrate = {{ young = 1.0, poisson = 0.3{substrate} }}\n[profile.sphere]\nradius = 100.0\n\
         [friction]\ncoefficient = 0.3\n{wear}\n[[load]]\nnormal_force = 0.01\nincrements = 1\n\
         [[load]]\ntangential_force = [1e-3, 0.0]\nincrements = 8\ncycles = 1\n"
    );
    Case::from_toml(&text, "case.toml").map_err(|error| error.to_string())
}

const FILM: &str = ", wear_coefficient = 2.0";
const BASE: &str = ", wear_coefficient = 0.5";

#[test]
fn coefficients_of_layers_are_read() {
    let wear = "[wear]\ntolerance = 0.1\nthinning_tolerance = 0.2\nthrough_coating_of = \"lower\"";
    let rule = read(["wear_coefficient = 1.0", FILM, BASE, wear]).unwrap().wear.unwrap();
    let [lower, upper] = rule.layers.as_ref().unwrap().bodies();
    assert_eq!((lower[0].thickness, lower[0].coefficient, lower[1].coefficient), (0.5, 2.0, 0.5));
    assert!(lower[1].thickness.is_infinite() && upper[0].coefficient == 1.0);
    assert_eq!((rule.coefficient, rule.every, rule.largest_rate()), (None, 1_000_000, 3.0));
    assert_eq!((rule.tolerance, rule.thinning_tolerance), (Some(0.1), Some(0.2)));
    // Through 0.5 of the coating the other body has lost half as much.
    assert!((rule.limit.unwrap() - 0.75).abs() < 1e-15);
    let both = read(["", "", "", "[wear]\ncoefficient = 3.0"]).unwrap().wear.unwrap();
    assert_eq!((both.coefficient, both.every, both.layers), (Some(3.0), 1, None));
}

#[test]
fn what_cannot_wear_is_refused_with_words() {
    for (words, message) in [
        (["", FILM, "", "[wear]"], "lower.substrate: no wear_coefficient"),
        (["", FILM, BASE, ""], "without a table [wear]"),
        (["", "", "", "[wear]\nevery = 2"], "[wear] needs a coefficient"),
        (["", FILM, BASE, "[wear]\ncoefficient = 1.0"], "both at once"),
        (["wear_coefficient = -1.0", "", "", "[wear]"], "must be zero or positive"),
        (["", "", "", "[wear]\ncoefficient = 1.0\nthinning_tolerance = 0.1"], "which body wears"),
        (["", FILM, BASE, "[wear]\ntolerance = 0.0"], "must lie above 0"),
        (["", FILM, BASE, "[wear]\nthinning_tolerance = 0.9"], "at 0.5 at the most"),
        (["", ", wear_coefficient = 0.0", BASE, "[wear]\nthrough_coating_of = \"lower\""], "does not wear"),
        (["", FILM, BASE, "[wear]\nthinning_tolerance = 0.1\n[stress]\ndepths = [0.1]"], "stress and wear"),
    ] {
        let error = read(words).unwrap_err();
        assert!(error.contains(message), "{words:?}: {error}");
    }
}

#[test]
fn settings_of_wear_lie_within_their_bounds() {
    let with = |words: &str| read(["", FILM, BASE, &format!("[wear]\n{words}")]);
    let wear = |words: &str| with(words).unwrap_or_else(|error| panic!("{words}: {error}")).wear.unwrap();
    // on the bounds, and beyond
    assert_eq!([1, 1_000_000].map(|every| wear(&format!("every = {every}")).every), [1, 1_000_000]);
    assert_eq!(wear("largest_step = 1.0").largest_step, 1.0);
    assert_eq!(wear("tolerance = 1.0").tolerance, Some(1.0));
    assert_eq!(wear("thinning_tolerance = 0.5").thinning_tolerance, Some(0.5));
    assert_eq!(wear("limit = 1e-9").limit, Some(1e-9));
    for words in ["every = 0", "every = 1000001"] {
        assert!(with(words).unwrap_err().contains("must lie between 1 and 1000000"), "{words}");
    }
    for key in ["largest_step", "tolerance", "thinning_tolerance"] {
        for value in ["0.0", "-0.1", "1.001", "nan"] {
            let error = with(&format!("{key} = {value}")).unwrap_err();
            assert!(
                error.contains(&format!("wear.{key} = ")) && error.contains("must lie above 0"),
                "{error}"
            );
        }
    }
    for value in ["0.0", "-1.0", "inf", "nan"] {
        assert!(with(&format!("limit = {value}")).unwrap_err().contains("positive finite length"), "{value}");
    }
    let both = |value: &str| read(["", "", "", &format!("[wear]\ncoefficient = {value}")]);
    assert_eq!(both("0.0").unwrap().wear.unwrap().coefficient, Some(0.0));
    for value in ["-1.0", "inf", "nan"] {
        assert!(both(value).unwrap_err().contains("must be zero or positive"), "{value}");
        let of_layer = read(["", &format!(", wear_coefficient = {value}"), BASE, "[wear]"]);
        assert!(of_layer.unwrap_err().contains("lower.coatings[0].wear_coefficient"), "{value}");
    }
}

#[test]
fn cycles_of_wear_stand_for_others_where_these_are_alike() {
    let with = |every: usize, cycles: &str| {
        let load = "[[load]]\nnormal_force = 0.01\nincrements = 1\n[[load]]\ntangential_force = [1e-3, 0.0]\nincrements = 8\n";
        read(["", FILM, BASE, &format!("[wear]\nevery = {every}\n{load}{cycles}")])
    };
    for (every, envelope) in [(1, [1.0, 0.5]), (1, [1.0, 1.0]), (2, [0.5, 0.5])] {
        let wear = with(every, &format!("cycles = 4\nenvelope = {envelope:?}")).unwrap().wear;
        assert_eq!(wear.unwrap().every, every);
    }
    let found = with(2, "cycles = 4\nenvelope = [1.0, 0.5]").unwrap_err();
    assert!(found.contains("wear and load[1]: amplitudes that change"), "{found}");
    let found = with(1, "until_steady = { tolerance = 1e-3, most_cycles = 9 }").unwrap_err();
    assert!(found.contains("wear and load[1]: until_steady"), "{found}");
}

#[test]
fn a_coefficient_of_a_body_is_that_of_what_has_no_layers() {
    // a body that is rigid below its coating has no substrate to say it of
    let film = "coatings = [{ thickness = 0.5, young = 2.0, poisson = 0.3, wear_coefficient = 2.0 }]";
    let text = |body: &str| {
        format!(
            "[grid]\ncells = [16, 16]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n[lower]\n{body}\n[profile.sphere]\n\
             radius = 100.0\n[friction]\ncoefficient = 0.3\n[wear]\nthrough_coating_of = \"lower\"\n\
             [[load]]\nnormal_force = 0.01\nincrements = 1\n"
        )
    };
    let read = |body: &str| Case::from_toml(&text(body), "case.toml").map_err(|error| error.to_string());
    let layers = |body: &str| read(body).unwrap().wear.unwrap().layers.unwrap().bodies()[0].to_vec();
    let of = |body: &str| layers(body).iter().map(|layer| layer.coefficient).collect::<Vec<_>>();
    assert_eq!(of(&format!("base = \"rigid\"\n{film}")), [2.0, 0.0]);
    assert_eq!(of(&format!("base = \"rigid\"\nwear_coefficient = 0.25\n{film}")), [2.0, 0.25]);
    let substrate = "substrate = { young = 1.0, poisson = 0.3, wear_coefficient = 0.5 }";
    assert_eq!(of(&format!("{film}\n{substrate}")), [2.0, 0.5]);
    let found = read(&format!("wear_coefficient = 0.25\n{film}\n{substrate}")).unwrap_err();
    assert!(found.contains("belongs into the substrate"), "{found}");
}

#[test]
fn a_coating_is_gone_where_its_body_has_lost_its_thickness() {
    let gone = |words: [&str; 4]| read(words).unwrap().wear.unwrap().coating;
    // The depth of both bodies together that through_coating_of has: the other body has lost half as much.
    assert!((gone(["wear_coefficient = 1.0", FILM, BASE, "[wear]"]).unwrap() - 0.75).abs() < 1e-15);
    // One coefficient of both together: its whole depth is that of the coated body.
    assert_eq!(gone(["", "", "", "[wear]\ncoefficient = 3.0"]), Some(0.5));
    // Coatings that do not wear stay.
    assert_eq!(gone(["", ", wear_coefficient = 0.0", BASE, "[wear]"]), None);
}
