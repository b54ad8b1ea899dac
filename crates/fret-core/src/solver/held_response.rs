//! The response of the pair over cells, held while operators are made of it: most increments go on with those of the last one.

use std::sync::OnceLock;

use crate::compliance::SurfaceResponse;

/// Makes a response, with the same bits whenever it is asked.
pub type ResponseMaker<'a> = Box<dyn Fn() -> SurfaceResponse + Send + Sync + 'a>;

/// The response of the pair over cells.
pub enum HeldResponse<'a> {
    /// Held throughout.
    Kept(SurfaceResponse),
    /// Held from when it is asked for until it is given back.
    AtNeed {
        /// What is held.
        held: OnceLock<SurfaceResponse>,
        /// Makes it.
        make: ResponseMaker<'a>,
        /// Whether the problem is periodic.
        is_periodic: bool,
    },
}

impl<'a> HeldResponse<'a> {
    /// The same response, which `make` makes again after it was given back.
    pub fn made_again_by(self, make: ResponseMaker<'a>) -> Self {
        match self {
            Self::Kept(response) => {
                let is_periodic = response.is_periodic();
                Self::AtNeed { held: OnceLock::from(response), make, is_periodic }
            }
            Self::AtNeed { held, is_periodic, .. } => Self::AtNeed { held, make, is_periodic },
        }
    }

    /// The response.
    pub fn get(&self) -> &SurfaceResponse {
        match self {
            Self::Kept(response) => response,
            Self::AtNeed { held, make, .. } => held.get_or_init(make),
        }
    }

    /// Frees its memory where it can be made again.
    pub fn give_back(&mut self) {
        if let Self::AtNeed { held, .. } = self {
            held.take();
        }
    }

    /// Whether the problem is periodic.
    pub fn is_periodic(&self) -> bool {
        match self {
            Self::Kept(response) => response.is_periodic(),
            Self::AtNeed { is_periodic, .. } => *is_periodic,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use crate::kernel::{Components, influence_coefficients};
    use crate::model::{Body, ContactPair, ElasticMaterial, HalfSpace};

    #[test]
    fn a_response_is_made_again_only_after_it_was_given_back() {
        let elastic = HalfSpace::homogeneous(ElasticMaterial::new(1.0, 0.3).unwrap());
        let pair = ContactPair::new(Body::Rigid, Body::Elastic(elastic)).unwrap();
        let response = || {
            SurfaceResponse::FreeSpace(influence_coefficients(&pair, [4, 3], [1.0; 2], Components::NORMAL))
        };
        let made = AtomicUsize::new(0);
        let make = || {
            made.fetch_add(1, Ordering::Relaxed);
            response()
        };
        let own = |held: &HeldResponse<'_>| match held.get() {
            SurfaceResponse::FreeSpace(coefficients) => coefficients.zz.as_ref().map(|zz| zz[[0, 0]]),
            SurfaceResponse::Periodic(_) => None,
        };
        let mut kept = HeldResponse::Kept(response());
        let first = own(&kept);
        kept.give_back();
        assert_eq!(own(&kept), first);
        let mut at_need = kept.made_again_by(Box::new(make));
        for times in [0, 1, 2] {
            assert_eq!((own(&at_need), own(&at_need), at_need.is_periodic()), (first, first, false));
            assert_eq!(made.load(Ordering::Relaxed), times);
            at_need.give_back();
        }
    }
}
