//! The judgement of residual stresses.

use super::judge::Judge;
use super::parts::{Layer, NamedBody, layers};
use crate::model::{ResidualLayer, ResidualStress};

/// Residual stresses of a body; none of what is refused.
pub(super) fn residual(judge: &mut Judge, body: NamedBody<'_>) -> ResidualStress {
    let of_layer = |layer: &Layer<'_>| ResidualLayer { top: layer.top, rows: rows(judge, layer) };
    ResidualStress::new(layers(body).iter().map(of_layer).collect())
}

fn rows(judge: &mut Judge, layer: &Layer<'_>) -> Vec<(f64, [f64; 2])> {
    let Some(given) = layer.residual_stress else { return Vec::new() };
    let rows = given.rows();
    let finite = rows.iter().all(|(depth, [x, y])| depth.is_finite() && x.is_finite() && y.is_finite());
    let rises = rows.windows(2).all(|pair| pair[0].0 < pair[1].0);
    let inside = rows.iter().all(|(depth, _)| (0.0..=layer.thickness * (1.0 + 1e-9)).contains(depth));
    let wrong = match (finite, rises, inside) {
        (false, ..) => "must be finite",
        (_, false, _) => "depths must rise from row to row",
        (_, _, false) => "depths count from the upper face of the layer, from 0 to its thickness",
        _ => return rows,
    };
    judge.refuse::<()>(
        given.span(),
        format!("{}.residual_stress: {wrong}", layer.place),
        "residual_stress = -2e9, or [along x, along y], or [[0.0, -2e9], [1e-6, -1e9]]",
    );
    Vec::new()
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
