//! A twin of the frequency response, made otherwise and in hundreds of digits: displacements and tractions carried upward through
//! the layers by the plain exponential of the elastic equations, in which everything grows and cancels, with digits to spare.

use dashu_float::FBig;
use dashu_float::ops::Abs;
use dashu_float::round::mode::HalfEven;
use fret_core::kernel::Response;

use super::bodies::{Layer, Stack};

type Number = FBig<HalfEven, 2>;
type Square = [[Number; 2]; 2];
type Carrier = [[Number; 4]; 4];

/// Layers deeper than this many wavelengths over 2 pi are not felt: `exp(-2 x)` is far below the last digit of anything here.
const UNFELT: f64 = 400.0;
/// Binary digits that thin layers and contrasts may use up, besides those of growing waves.
const DIGITS: usize = 768;

/// Compliance times wavenumber in order (r, z), and that across the wave.
struct Compliance {
    plane: Square,
    tt: Number,
}

/// How far a response is from the twin's at a wavenumber: the worst of `zz`, `rr`, `tt` relative to their own size and of `rz`
/// relative to `sqrt(rr zz)`. `found` is times k.
pub fn error(stack: &Stack, k: f64, found: Response) -> f64 {
    let mut depth = 0.0;
    let felt = stack.coatings.iter().take_while(|layer| {
        let above = depth;
        depth += k * layer.thickness;
        above < UNFELT
    });
    let felt: Vec<&Layer> = felt.collect();
    let growth = depth.min(2.0 * UNFELT) * 4.0 * std::f64::consts::LOG2_E;
    let bits = DIGITS + growth as usize;
    let twin = compliance(stack, &felt, k, bits);
    let [[rr, rz], [_, zz]] = &twin.plane;
    let scale = (rr * zz).sqrt();
    let off = |value: f64, exact: &Number, scale: &Number| {
        ((number(value, bits) - exact).abs() / scale).to_f64().value()
    };
    [
        off(found.zz, zz, zz),
        off(found.rr, rr, rr),
        off(found.tt, &twin.tt, &twin.tt),
        off(found.rz, rz, &scale),
    ]
    .into_iter()
    .fold(0.0, |worst: f64, error| if error.is_nan() { f64::INFINITY } else { worst.max(error) })
}

/// A number of so many binary digits; what is none counts as infinite.
fn number(value: f64, bits: usize) -> Number {
    Number::try_from(value).unwrap_or(Number::INFINITY).with_precision(bits).value()
}

fn compliance(stack: &Stack, felt: &[&Layer], k: f64, bits: usize) -> Compliance {
    let lowest = felt.last().filter(|_| felt.len() < stack.coatings.len() || deep(felt, k));
    let base = lowest.map(|layer| [layer.young, layer.poisson]).or(stack.substrate);
    let mut carried = if let Some([young, poisson]) = base {
        half_space(young, poisson, bits)
    } else {
        let zero = || number(0.0, bits);
        Compliance { plane: [[zero(), zero()], [zero(), zero()]], tt: zero() }
    };
    for layer in felt.iter().rev() {
        let below = sprung(layer, carried, k, bits);
        carried = above(layer, &below, k, bits);
    }
    carried
}

fn deep(felt: &[&Layer], k: f64) -> bool {
    felt.last().is_some_and(|layer| k * layer.thickness > UNFELT)
}

fn shear_modulus(young: f64, poisson: f64, bits: usize) -> Number {
    number(young, bits) / (number(2.0, bits) * (number(1.0, bits) + number(poisson, bits)))
}

/// `(1 - nu)/mu [[1, g], [g, 1]]`, `g = (1 - 2 nu)/(2 (1 - nu))`; across: `1/mu`.
fn half_space(young: f64, poisson: f64, bits: usize) -> Compliance {
    let (one, two, nu) = (number(1.0, bits), number(2.0, bits), number(poisson, bits));
    let mu = shear_modulus(young, poisson, bits);
    let own = (&one - &nu) / &mu;
    let aside = (&one - &two * &nu) / (&two * &mu);
    Compliance { plane: [[own.clone(), aside.clone()], [aside, own]], tt: one / mu }
}

/// What springs show of what lies below them: displacement jumps by traction over stiffness.
fn sprung(layer: &Layer, mut below: Compliance, k: f64, bits: usize) -> Compliance {
    if let Some(springs) = layer.springs {
        let [normal, shear] = springs.map(|stiffness| number(k, bits) / number(stiffness, bits));
        below.plane[0][0] += &shear;
        below.plane[1][1] += normal;
        below.tt += shear;
    }
    below
}

/// What the surface of a layer shows of what lies below it: displacements and tractions below, carried to its top.
fn above(layer: &Layer, below: &Compliance, k: f64, bits: usize) -> Compliance {
    let x = number(k, bits) * number(layer.thickness, bits);
    if k * layer.thickness > UNFELT {
        return half_space(layer.young, layer.poisson, bits);
    }
    let half = number(0.5, bits);
    let grown = x.exp();
    let shrunk = number(1.0, bits) / &grown;
    let [c, s] = [(&grown + &shrunk) * &half, (&grown - &shrunk) * &half];
    let equations = equations(layer, bits);
    let square = product(&equations, &equations);
    // (M M - 1)^2 = 0: the exponential of -M x is a polynomial of third order in M.
    let double = add(&square, &identity(bits), &number(-1.0, bits));
    let even = add(&scaled(&identity(bits), &c), &double, &(&x * &s * &half));
    let odd = add(&scaled(&identity(bits), &s), &double, &((&x * &c - &s) * &half));
    let upward = add(&even, &product(&equations, &odd), &number(-1.0, bits));
    // Columns: the displacements that unit tractions below cause, and those tractions.
    let part = |rows: usize| -> Square {
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let row = &upward[rows + i];
                &row[0] * &below.plane[0][j] + &row[1] * &below.plane[1][j] + &row[2 + j]
            })
        })
    };
    let mu = shear_modulus(layer.young, layer.poisson, bits);
    Compliance {
        plane: quotient(&part(0), &part(2)),
        tt: (&below.tt * &c + &s / &mu) / (&c + &mu * &below.tt * &s),
    }
}

/// `d/d(k z)` of displacements times k along and into the body, and of the tractions on what lies below.
fn equations(layer: &Layer, bits: usize) -> Carrier {
    let (zero, one, two) = (number(0.0, bits), number(1.0, bits), number(2.0, bits));
    let nu = number(layer.poisson, bits);
    let mu = shear_modulus(layer.young, layer.poisson, bits);
    let b = &one / (&two * (&one - &nu));
    let g = (&one - &two * &nu) * &b;
    let a = &nu / (&one - &nu);
    let minus = number(-1.0, bits);
    let four = number(4.0, bits);
    [
        [zero.clone(), minus.clone(), &minus / &mu, zero.clone()],
        [a.clone(), zero.clone(), zero.clone(), &minus * &g / &mu],
        [&minus * &four * &mu * &b, zero.clone(), zero.clone(), &minus * &a],
        [zero.clone(), zero.clone(), one, zero],
    ]
}

fn identity(bits: usize) -> Carrier {
    std::array::from_fn(|i| std::array::from_fn(|j| number(if i == j { 1.0 } else { 0.0 }, bits)))
}

fn product(one: &Carrier, other: &Carrier) -> Carrier {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let mut sum = &one[i][0] * &other[0][j];
            for inner in 1..4 {
                sum += &one[i][inner] * &other[inner][j];
            }
            sum
        })
    })
}

fn scaled(one: &Carrier, factor: &Number) -> Carrier {
    std::array::from_fn(|i| std::array::from_fn(|j| &one[i][j] * factor))
}

fn add(one: &Carrier, other: &Carrier, factor: &Number) -> Carrier {
    std::array::from_fn(|i| std::array::from_fn(|j| &one[i][j] + &other[i][j] * factor))
}

/// `one` times the inverse of `other`.
fn quotient(one: &Square, other: &Square) -> Square {
    let [[a, b], [c, d]] = other;
    let determinant = a * d - b * c;
    std::array::from_fn(|i| {
        let [p, q] = &one[i];
        [(p * d - q * c) / &determinant, (q * a - p * b) / &determinant]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bonded_film_on_a_rigid_base_answers_long_waves_as_lubrication_theory_says() {
        // zz = k^2 h^3/(3 G), rr = h/G, rz = -k h^2/(2 G), tt = h/G; G = 1, h = 1; next order (k h)^2
        let film = Stack { coatings: vec![Layer::bonded(3.0, 0.5, 1.0)], substrate: None };
        let k = 1e-6;
        let exact = Response { zz: k * k * k / 3.0, rr: k, rz: -0.5 * k * k, tt: k };
        assert!(error(&film, k, exact) < 1e-11);
        let wrong = Response { rz: -exact.rz, ..exact };
        assert!(error(&film, k, wrong) > 1.0);
    }

    #[test]
    fn coating_of_the_material_below_it_is_a_half_space_at_any_wavelength() {
        let stack = Stack::coated(1.0, 0.3, 0.7);
        let mu = 1.0 / 2.6;
        let exact = Response { zz: 0.7 / mu, rr: 0.7 / mu, rz: 0.2 / mu, tt: 1.0 / mu };
        for k in [1e-8, 1e-3, 1.0, 30.0, 500.0, 600.0, 1e4] {
            assert!(error(&stack, k, exact) < 1e-15, "{k}: {:e}", error(&stack, k, exact));
        }
    }
}
