//! Cycles to initiation from a parameter of the critical plane.

use super::constants::StrainLife;
use crate::model::ElasticMaterial;

/// Cycles are looked for between these powers of ten; beyond the last one life counts as unlimited.
const DECADES: [f64; 2] = [-1.0, 18.0];

/// Cycles to initiation at a Smith-Watson-Topper parameter [pressure]; infinite where 1e18 cycles do not reach it.
///
/// `P = S^2/E (2N)^(2b) + S e (2N)^(b + c)`. Source: Smith, Watson & Topper (1970), *J. Materials* 5, 767; for fretting Szolwinski &
/// Farris (1996), *Wear* 198, 93.
pub fn cycles_by_smith_watson_topper(parameter: f64, material: &ElasticMaterial, law: &StrainLife) -> f64 {
    let StrainLife {
        strength_coefficient: strength,
        strength_exponent: b,
        ductility_coefficient: ductility,
        ductility_exponent: c,
    } = *law;
    cycles(parameter, |reversals| {
        strength * strength / material.young() * reversals.powf(2.0 * b)
            + strength * ductility * reversals.powf(b + c)
    })
}

/// Cycles to initiation at a Fatemi-Socie parameter [-]; infinite where 1e18 cycles do not reach it.
///
/// `P = S/G (2N)^b + e (2N)^c` with the constants of torsion. Source: Fatemi & Socie (1988), *Fatigue Fract. Engng Mater. Struct.* 11, 149.
pub fn cycles_by_fatemi_socie(parameter: f64, material: &ElasticMaterial, law: &StrainLife) -> f64 {
    cycles(parameter, |reversals| {
        law.strength_coefficient / material.shear_modulus() * reversals.powf(law.strength_exponent)
            + law.ductility_coefficient * reversals.powf(law.ductility_exponent)
    })
}

/// The number of cycles at which a falling law has a value, by bisection of its logarithm.
fn cycles(parameter: f64, law: impl Fn(f64) -> f64) -> f64 {
    let at = |decade: f64| law(2.0 * 10.0_f64.powf(decade)) > parameter;
    let [mut low, mut high] = DECADES;
    if at(high) {
        return f64::INFINITY;
    }
    if !at(low) {
        return 10.0_f64.powf(low);
    }
    while high - low > 1e-12 {
        let middle = f64::midpoint(low, high);
        if at(middle) { low = middle } else { high = middle }
    }
    10.0_f64.powf(f64::midpoint(low, high))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: StrainLife = StrainLife {
        strength_coefficient: 1000.0,
        strength_exponent: -0.1,
        ductility_coefficient: 0.4,
        ductility_exponent: -0.6,
    };

    /// The law of strain and stress by hand: at N cycles fully reversed, stress amplitude `S (2N)^b`, strain amplitude by the sum.
    #[test]
    fn the_life_of_a_reversed_test_is_found_back() {
        let steel = ElasticMaterial::new(210e3, 0.3).unwrap();
        for n in [10.0_f64, 1e3, 1e5, 1e8] {
            let stress = 1000.0 * (2.0 * n).powf(-0.1);
            let strain = stress / 210e3 + 0.4 * (2.0 * n).powf(-0.6);
            let found = cycles_by_smith_watson_topper(stress * strain, &steel, &LAW);
            assert!((found / n - 1.0).abs() < 1e-9, "{n}: {found}"); // bisection to 1e-12 of a decade
            let shear = stress / steel.shear_modulus() + 0.4 * (2.0 * n).powf(-0.6);
            let found = cycles_by_fatemi_socie(shear, &steel, &LAW);
            assert!((found / n - 1.0).abs() < 1e-9, "{n}: {found}");
        }
    }

    #[test]
    fn nothing_is_unlimited_life_and_too_much_is_less_than_a_cycle() {
        let steel = ElasticMaterial::new(210e3, 0.3).unwrap();
        assert_eq!(cycles_by_smith_watson_topper(0.0, &steel, &LAW), f64::INFINITY);
        assert_eq!(cycles_by_smith_watson_topper(1e9, &steel, &LAW), 0.1);
    }
}
