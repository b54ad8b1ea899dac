//! The judgement of the two bodies.

use super::body_file::BodyFile;
use super::coating::{self, material};
use super::judge::Judge;
use crate::document::At;
use crate::kernel::sublayers::{RESPONSE_BOUND, SublayerError, layered_half_space};
use crate::model::{Base, Body, ContactPair, Layer};

/// The pair; `None` when something about it was refused.
pub(super) fn bodies(judge: &mut Judge, upper: &At<BodyFile>, lower: &At<BodyFile>) -> Option<ContactPair> {
    let (first, second) = (body(judge, "upper", upper), body(judge, "lower", lower));
    match ContactPair::new(first?, second?) {
        Ok(pair) => Some(pair),
        Err(error) => judge.refuse(lower.span(), error.to_string(), ""),
    }
}

fn body(judge: &mut Judge, which: &str, given: &At<BodyFile>) -> Option<Body> {
    let body = &given.value;
    if body.rigid.as_ref().is_some_and(|rigid| rigid.value) {
        let elastic = ["coatings", "substrate", "base"].map(|key| judge.places.of(&format!("{which}.{key}")));
        return match elastic.into_iter().flatten().next() {
            Some(span) => judge.both(span, &format!("{which}: rigid = true and an elastic part")),
            None => Some(Body::Rigid),
        };
    }
    let base = match (&body.substrate, &body.base) {
        (Some(substrate), None) => {
            let place = format!("{which}.substrate");
            material(judge, &place, &substrate.value.young, &substrate.value.poisson).map(Base::Elastic)
        }
        (None, Some(_)) => Some(Base::Rigid),
        (Some(_), Some(base)) => {
            judge.both(base.span(), &format!("{which}: a substrate and base = \"rigid\""))
        }
        (None, None) => judge.refuse(
            given.span(),
            format!("{which}: nothing says what it is made of"),
            "rigid = true, or substrate = { young = ..., poisson = ... }, or base = \"rigid\" under coatings",
        ),
    };
    let coatings = body.coatings.iter().flat_map(|list| list.iter().enumerate());
    let layers: Vec<Option<Layer>> = coatings
        .map(|(index, entry)| coating::layer(judge, &format!("{which}.coatings[{index}]"), entry))
        .collect();
    let layers: Option<Vec<Layer>> = layers.into_iter().collect();
    match layered_half_space(&layers?, base?, RESPONSE_BOUND) {
        Ok(half_space) => Some(Body::Elastic(half_space)),
        Err(error @ SublayerError::TooSteep { .. }) => {
            let span = body.coatings.as_ref().map_or(given.span(), At::span);
            judge.refuse(
                span,
                format!("{which}.coatings: {error}"),
                "a modulus that changes less, or gradient.layers = ... to be content with so many",
            )
        }
        Err(SublayerError::Material(error)) => judge.refuse(given.span(), format!("{which}: {error}"), ""),
    }
}
