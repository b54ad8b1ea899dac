//! The judgement of the profile.

use toml::Spanned;

use super::file::{ProfileFile, WaveFile};
use super::judge::Judge;
use crate::model::Profile;

/// The profile; `None` when something about it was refused.
pub(super) fn profile(judge: &mut Judge, given: &Spanned<ProfileFile>) -> Option<Profile> {
    let (profile, lengths) = match given.get_ref() {
        ProfileFile::Sphere(sphere) => {
            (Profile::Sphere { radius: *sphere.radius.get_ref() }, vec![("sphere", "radius", &sphere.radius)])
        }
        ProfileFile::Ellipsoid(ellipsoid) => (
            Profile::Ellipsoid {
                radius_x: *ellipsoid.radius_x.get_ref(),
                radius_y: *ellipsoid.radius_y.get_ref(),
            },
            vec![
                ("ellipsoid", "radius_x", &ellipsoid.radius_x),
                ("ellipsoid", "radius_y", &ellipsoid.radius_y),
            ],
        ),
        ProfileFile::Wave(wave) => return self::wave(judge, given, wave),
        ProfileFile::Cylinder(_) => return unbuilt(judge, given, "cylinder"),
        ProfileFile::RoundedPunch(_) => return unbuilt(judge, given, "rounded_punch"),
        ProfileFile::FlatPunch(_) => return unbuilt(judge, given, "flat_punch"),
        ProfileFile::Cone(_) => return unbuilt(judge, given, "cone"),
        ProfileFile::Heights(_) => return unbuilt(judge, given, "heights"),
    };
    positive(judge, lengths).then_some(profile)
}

fn wave(judge: &mut Judge, given: &Spanned<ProfileFile>, wave: &WaveFile) -> Option<Profile> {
    let mut lengths = vec![("wave", "amplitude", &wave.amplitude)];
    lengths.extend(wave.wavelength_x.as_ref().map(|length| ("wave", "wavelength_x", length)));
    lengths.extend(wave.wavelength_y.as_ref().map(|length| ("wave", "wavelength_y", length)));
    if lengths.len() == 1 {
        return judge.refuse(
            given.span(),
            "profile.wave: neither wavelength_x nor wavelength_y",
            "a wave needs a length along at least one axis",
        );
    }
    let length = |value: &Option<Spanned<f64>>| value.as_ref().map(|value| *value.get_ref());
    let profile = Profile::Wave {
        amplitude: *wave.amplitude.get_ref(),
        wavelengths: [length(&wave.wavelength_x), length(&wave.wavelength_y)],
    };
    positive(judge, lengths).then_some(profile)
}

/// Refuses every length that is not positive and finite.
fn positive(judge: &mut Judge, lengths: Vec<(&str, &str, &Spanned<f64>)>) -> bool {
    let mut good = true;
    for (shape, name, given) in lengths {
        let value = *given.get_ref();
        if !(value.is_finite() && value > 0.0) {
            good = false;
            let message = format!("profile.{shape}.{name} = {value:?}: must be a positive finite length");
            judge.refuse::<()>(given.span(), message, "");
        }
    }
    good
}

fn unbuilt(judge: &mut Judge, given: &Spanned<ProfileFile>, shape: &str) -> Option<Profile> {
    judge.refuse(
        given.span(),
        format!("profile.{shape} is not built yet"),
        "built are: profile.sphere, profile.ellipsoid, profile.wave",
    )
}
