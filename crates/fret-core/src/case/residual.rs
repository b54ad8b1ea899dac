//! The judgement of residual stresses.

use toml::Spanned;

use super::body_file::BodyFile;
use super::judge::Judge;
use super::residual_file::ResidualFile;
use crate::model::{ResidualLayer, ResidualStress};

/// Residual stresses of a body; none of what is refused.
pub(super) fn residual(judge: &mut Judge, which: &str, body: &BodyFile) -> ResidualStress {
    let mut layers = Vec::new();
    let mut top = 0.0;
    let coatings = body.coatings.as_ref().map_or(&[][..], |list| list.get_ref());
    for (index, coating) in coatings.iter().enumerate() {
        let coating = coating.get_ref();
        let thickness = *coating.thickness.get_ref();
        let place = format!("{which}.coatings[{index}]");
        let rows = rows(judge, &place, coating.residual_stress.as_ref(), thickness);
        layers.push(ResidualLayer { top, rows });
        top += thickness;
    }
    if let Some(substrate) = &body.substrate {
        let place = format!("{which}.substrate");
        let rows = rows(judge, &place, substrate.get_ref().residual_stress.as_ref(), f64::INFINITY);
        layers.push(ResidualLayer { top, rows });
    }
    ResidualStress::new(layers)
}

fn rows(
    judge: &mut Judge,
    place: &str,
    given: Option<&Spanned<ResidualFile>>,
    thickness: f64,
) -> Vec<(f64, [f64; 2])> {
    let Some(given) = given else { return Vec::new() };
    let rows = &given.get_ref().0;
    let finite = rows.iter().all(|(depth, [x, y])| depth.is_finite() && x.is_finite() && y.is_finite());
    let rises = rows.windows(2).all(|pair| pair[0].0 < pair[1].0);
    let inside = rows.iter().all(|(depth, _)| (0.0..=thickness * (1.0 + 1e-9)).contains(depth));
    let wrong = match (finite, rises, inside) {
        (false, ..) => Some("must be finite"),
        (_, false, _) => Some("depths must rise from row to row"),
        (_, _, false) => Some("depths count from the upper face of the layer, from 0 to its thickness"),
        _ => None,
    };
    if let Some(wrong) = wrong {
        judge.refuse::<()>(
            given.span(),
            format!("{place}.residual_stress: {wrong}"),
            "residual_stress = -2e9, or [along x, along y], or [[0.0, -2e9], [1e-6, -1e9]]",
        );
        return Vec::new();
    }
    rows.clone()
}

#[cfg(test)]
mod tests {
    use crate::case::Case;

    fn read(substrate: &str, coating: &str) -> Result<Case, String> {
        let text = format!(
            "[grid]\ncells = 64\nsize = 1.0\n[upper]\nrigid = true\n[lower]\ncoatings = [{{ thickness = 0.5, young = 2.0, poisson = 0.3{coating} }}]\n\
             substrate = {{ young = 1.0, poisson = 0.3{substrate} }}\n[profile.cylinder]\nradius = 100.0\naxis = \"y\"\n[[load]]\n\
             normal_force = 1e-4\nincrements = 1\n"
        );
        Case::from_toml(&text, "case.toml").map_err(|error| error.to_string())
    }

    #[test]
    fn numbers_pairs_and_tables_are_read() {
        let none = read("", "").unwrap();
        assert!(none.residual_stress[0].is_none());
        let case = read(", residual_stress = [[0.0, -3.0, -1.0], [2.0, 0.0, 0.0]]", ", residual_stress = -7")
            .unwrap();
        let [lower, upper] = &case.residual_stress;
        let crate::model::Body::Elastic(body) = case.bodies.lower() else { panic!("elastic") };
        assert_eq!(lower.at(body, 0, 0.5), [-7.0, -7.0]);
        assert_eq!(lower.at(body, 1, 1.5), [-1.5, -0.5]);
        assert!(upper.is_none());
        let pair = read("", ", residual_stress = [1.0, 2.0]").unwrap();
        assert_eq!(pair.residual_stress[0].at(body, 0, 0.0), [1.0, 2.0]);
        assert_eq!(pair.residual_stress[0].at(body, 1, 0.5), [0.0, 0.0]);
    }

    /// Layers count from the surface down, their tables from their own upper faces to the lower ones.
    #[test]
    fn each_layer_of_a_stack_has_its_own_table() {
        let second =
            "}, { thickness = 0.25, young = 3.0, poisson = 0.3, residual_stress = [[0.0, 4.0], [0.25, 8.0]]";
        let case =
            read(", residual_stress = 6", &format!(", residual_stress = [[0.0, 1.0], [0.5, 3.0]]{second}"))
                .unwrap();
        let crate::model::Body::Elastic(body) = case.bodies.lower() else { panic!("elastic") };
        let [stress, _] = &case.residual_stress;
        for (layer, depth, exact) in
            [(0, 0.25, 2.0), (1, 0.5, 4.0), (1, 0.625, 6.0), (1, 0.75, 8.0), (2, 0.9, 6.0)]
        {
            assert_eq!(stress.at(body, layer, depth), [exact; 2], "layer {layer}, depth {depth}");
        }
    }

    #[test]
    fn what_is_no_residual_stress_is_refused_where_it_stands() {
        for (coating, words) in [
            (", residual_stress = inf", "must be finite"),
            (", residual_stress = [[0.0, 1.0], [0.0, 2.0]]", "depths must rise"),
            (", residual_stress = [[0.0, 1.0], [0.7, 2.0]]", "to its thickness"),
            (", residual_stress = [[0.0, 1.0], [0.501, 2.0]]", "to its thickness"),
            (", residual_stress = [[-0.1, 1.0], [0.5, 2.0]]", "to its thickness"),
            (", residual_stress = [[0.3, 1.0], [0.2, 2.0]]", "depths must rise"),
            (", residual_stress = [[0.0, 1.0, inf], [0.5, 2.0, 1.0]]", "must be finite"),
            (", residual_stress = [[0.0, inf, 1.0], [0.5, 2.0, 1.0]]", "must be finite"),
            (", residual_stress = [[inf, 1.0, 1.0]]", "must be finite"),
            (", residual_stress = []", "rows [[depth, stress], ...]"),
            (", residual_stress = [1.0]", "rows [[depth, stress], ...]"),
            (", residual_stress = \"high\"", "a stress, two of them"),
        ] {
            let error = read("", coating).unwrap_err();
            assert!(error.contains(words), "{coating}: {error}");
        }
    }
}
