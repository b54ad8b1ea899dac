use crate::case::{Attachments, Case};

const HEAD: &str = "[grid]\ncells = [16, 16]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n[lower]\n\
                    substrate = { young = 1.0, poisson = 0.3 }\n[profile.sphere]\nradius = 100.0\n\
                    [friction]\ncoefficient = 0.3\n[[load]]\nnormal_force = 0.01\nincrements = 1\n";

/// Messages of a case whose second stage reads `more` and whose only file holds `file`.
fn refusal(more: &str, file: &str) -> String {
    let text = format!("{HEAD}[[load]]\nincrements = 2\n{more}\n");
    let attachments = |name: &str| match name {
        "path.csv" => Ok(file.as_bytes().to_vec()),
        _ => Err("no such file".to_owned()),
    };
    match Case::from_toml_with(&text, "case.toml", Attachments::files(&attachments)) {
        Ok(_) => String::new(),
        Err(error) => {
            assert_eq!(error.mistakes().len(), 1, "{error}");
            assert!(error.place(&error.mistakes()[0]).is_some(), "{error}");
            error.mistakes()[0].message.clone()
        }
    }
}

#[test]
fn a_good_table_is_read_whatever_its_separator() {
    for file in [
        "tangential_force_x,twist\n1e-3,0\n-1e-3,1e-4\n",
        "\u{feff}# rig 3\ntangential_force_x; twist\n 1e-3 ; 0\n-1e-3;1e-4\n",
        "tangential_force_x\ttwist\n1e-3\t0\n-1e-3\t1e-4",
    ] {
        assert_eq!(refusal("table = \"path.csv\"", file), "");
    }
}

#[test]
fn every_wrong_table_is_refused_once_and_in_words() {
    let table = "table = \"path.csv\"";
    let named = "table = \"path.csv\"\ncolumns = { shift_x = \"Q\" }";
    for (more, file, words) in [
        ("table = \"other.csv\"", "", "\"other.csv\": no such file"),
        (table, "force\n1.0\n", "column \"force\" is no control"),
        (table, "", "no column"),
        (table, "shift_x\n", "0 rows"),
        (table, "shift_x,shift_y\n1e-3\n", "line 2 has 1 cell, its head 2 cells"),
        (table, "shift_x,shift_x\n1e-3,1e-3\n", "column \"shift_x\" stands there twice"),
        (
            table,
            "shift_x\n1e-3\nnan\n",
            "line 3, column \"shift_x\": \"nan\" stands for a value that was not measured",
        ),
        (table, "shift_x\n1e-3\n1e999\n", "line 3, column \"shift_x\": \"1e999\" is no finite number"),
        (
            table,
            "shift_x\n1e-3\n-1e120\n",
            "line 3, column \"shift_x\": \"-1e120\": must be 1e100 at the most",
        ),
        (table, "normal_force\n1e-2\n1e300\n", "\"1e300\": must be 1e100 at the most"),
        (table, "# a\n\nshift_x\n% b\n1e-3\nx7\n", "line 6, column \"shift_x\": \"x7\" is not a number"),
        (table, "shift_x\nm\n1e-3\nmm\n", "line 4, column \"shift_x\": \"mm\" is not a number"),
        (table, "# shift_x\n1e-3\n1e-3x\n", "line 3, column \"shift_x\""),
        (table, "; rig\nshift_x\n; more\n1e-3\nx\n", "line 5, column \"shift_x\""),
        (table, "shift_x\n1,5\n", "line 2 has 2 cells, its head 1 cell"),
        (table, "shift_x,tangential_force_x\n1e-3,0\n", "one column may do so"),
        (named, "time,P\n0,1\n", "no column \"Q\"; it has: time, P"),
        ("table = \"path.csv\"\ncolumns = { pull = \"Q\" }", "Q\n1\n", "no control is called \"pull\""),
        ("table = \"path.csv\"\nshift = [1.0, 0.0]", "shift_y\n1\n", "a table and a control"),
        ("table = \"path.csv\"\nramp = \"cubic\"", "shift_y\n1\n", "ramp and table"),
        (table, "normal_force\n0.01\n-0.01\n", "normal_force reaches -0.01"),
        (table, "tangential_force_x\n0.02\n", "friction carries at most"),
        ("columns = { shift_x = \"Q\" }\nshift = [1.0, 0.0]", "", "there is no table"),
    ] {
        let found = refusal(more, file);
        assert!(found.contains(words), "{more} {file:?}: {found:?}, expected {words:?}");
    }
}

#[test]
fn wrong_cycles_waves_and_steady_states_are_refused() {
    for (more, words) in [
        ("shift = [1.0, 0.0]\ncycles = 2", "the reversal points of this cycle need at least 4"),
        ("shift = [1.0, 0.0]\nwaveform = \"sine\"", "the stage has no cycles"),
        ("shift = [1.0, 0.0]\nphase = { shift = [90.0, 0.0] }", "the stage has no cycles"),
        ("shift = [1.0, \"held\"]\ntangential_force = [0.0, 0.0]", "both at once"),
        ("shift = [\"held\", \"held\"]", "nothing is prescribed"),
        (
            "shift = [1.0, 0.0]\ncycles = 1\nuntil_steady = { tolerance = 1e-3, most_cycles = 3 }",
            "both at once",
        ),
        ("shift = [1.0, 0.0]\nuntil_steady = { tolerance = 2.0, most_cycles = 3 }", "between 0 and 1"),
    ] {
        let found = refusal(more, "");
        assert!(found.contains(words), "{more}: {found:?}, expected {words:?}");
    }
}

#[test]
fn wrong_words_of_a_cycle_are_refused() {
    for (more, words) in [
        ("shift = [1.0, 0.0]\nphase = { twist = 90.0 }", "this stage has no twist"),
        ("shift = [1.0, 0.0]\ndwell = 0.1", "only a trapezoid"),
        ("shift = [1.0, 0.0]\nwaveform = \"trapezoid\"\ndwell = 0.5", "between 0.001 and 0.499"),
        ("shift = [1.0, 0.0]\nramp = \"cubic\"", "ramp and cycles"),
        ("normal_force = 0.02", "normal_force reaches -0.01"),
        ("tangential_force = [2e-3, 2e-3]\nphase = { tangential_force = [inf, 0] }", "must be finite"),
    ] {
        let text = format!("{HEAD}[[load]]\nincrements = 8\ncycles = 1\n{more}\n");
        let error = Case::from_toml(&text, "case.toml").unwrap_err();
        assert_eq!(error.mistakes().len(), 1, "{error}");
        assert!(error.mistakes()[0].message.contains(words), "{error}");
    }
}

#[test]
fn a_motion_of_a_table_has_no_meaning_in_a_periodic_problem() {
    let head = HEAD.replace("size = [3.0, 3.0]", "size = [3.0, 3.0]\nperiodic = true");
    let text = format!("{head}[[load]]\nincrements = 1\ntable = \"path.csv\"\n");
    for (table, words) in [
        ("twist\n1e-3\n", "a rotation is not periodic"),
        ("approach\n1e-3\n", "half-space under a periodic load has no such rigid motion"),
    ] {
        let files = |_: &str| Ok(table.as_bytes().to_vec());
        let error = Case::from_toml_with(&text, "case.toml", Attachments::files(&files)).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn wrong_wear_is_refused() {
    for (wear, words) in [
        ("coefficient = -1.0", "must be zero or positive"),
        ("coefficient = 1.0\nevery = 0", "between 1 and"),
        ("coefficient = 1.0\nlargest_step = 0.0", "must lie above 0"),
        ("coefficient = 1.0\nlimit = 0.0", "positive finite length"),
        ("coefficient = 1.0\nthrough_coating_of = \"lower\"", "this body has no coating"),
        ("coefficient = 1.0\nthrough_coating_of = \"upper\"", "this body has no coating"),
    ] {
        let error = Case::from_toml(&format!("{HEAD}[wear]\n{wear}\n"), "case.toml").unwrap_err();
        assert_eq!(error.mistakes().len(), 1, "{error}");
        assert!(error.mistakes()[0].message.contains(words), "{error}");
    }
}
