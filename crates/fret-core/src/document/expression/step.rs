//! The steps that an evaluation takes, and the functions and constants that an expression may name.

/// Numbers that an evaluation holds at once, and parentheses inside one another, at the most: more than any formula needs, and little memory.
pub(super) const DEEPEST: usize = 32;
/// Whole powers up to this one are products, so that `x^2` is `x*x` to the last bit.
const LARGEST_PRODUCT: f64 = 64.0;

/// A rule for one number, and for two.
type OfOne = fn(f64) -> f64;
type OfTwo = fn(f64, f64) -> f64;

/// Functions of one number.
pub(super) const FUNCTIONS: [(&str, OfOne); 14] = [
    ("abs", f64::abs),
    ("sqrt", f64::sqrt),
    ("exp", f64::exp),
    ("ln", f64::ln),
    ("log10", f64::log10),
    ("sin", f64::sin),
    ("cos", f64::cos),
    ("tan", f64::tan),
    ("asin", f64::asin),
    ("acos", f64::acos),
    ("atan", f64::atan),
    ("sinh", f64::sinh),
    ("cosh", f64::cosh),
    ("tanh", f64::tanh),
];
/// Functions of two numbers; those of which a function of several is made, too.
pub(super) const OF_TWO: [(&str, OfTwo, Arguments); 4] = [
    ("min", least, Arguments::Several),
    ("max", greatest, Arguments::Several),
    ("hypot", f64::hypot, Arguments::Two),
    ("mod", f64::rem_euclid, Arguments::Two),
];
/// Names of numbers that do not change.
pub(super) const CONSTANTS: [(&str, f64); 1] = [("pi", std::f64::consts::PI)];

/// The smaller one; no number where one of them is none.
fn least(one: f64, other: f64) -> f64 {
    if one.is_nan() || one < other { one } else { other }
}

/// The larger one; no number where one of them is none.
fn greatest(one: f64, other: f64) -> f64 {
    if one.is_nan() || one > other { one } else { other }
}

/// How many arguments a function takes.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Arguments {
    Two,
    Several,
}

/// A step of an evaluation: puts a number on the pile, or takes one or two from it and puts back what becomes of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Step {
    Number(f64),
    Variable(usize),
    Negative,
    Sum,
    Difference,
    Product,
    Quotient,
    Power,
    Function(usize),
    FunctionOfTwo(usize),
}

impl Step {
    /// Numbers on the pile after it.
    pub fn held_after(self, before: usize) -> usize {
        match self {
            Self::Number(_) | Self::Variable(_) => before + 1,
            Self::Negative | Self::Function(_) => before,
            _ => before - 1,
        }
    }
}

pub(super) fn power(base: f64, exponent: f64) -> f64 {
    if exponent.fract() == 0.0 && exponent.abs() <= LARGEST_PRODUCT {
        base.powi(exponent as i32)
    } else {
        base.powf(exponent)
    }
}

/// Whether a parameter of an expression may be called so.
pub fn is_free_name(name: &str, variables: &[&str]) -> bool {
    let mut letters = name.chars();
    let is_name = letters.next().is_some_and(starts_a_name) && letters.all(is_in_a_name);
    let known = FUNCTIONS.map(|(name, _)| name).into_iter().chain(OF_TWO.map(|(name, ..)| name));
    is_name
        && !known
            .chain(CONSTANTS.map(|(name, _)| name))
            .chain(variables.iter().copied())
            .any(|word| word == name)
}

pub(super) fn starts_a_name(letter: char) -> bool {
    letter.is_ascii_alphabetic() || letter == '_'
}

pub(super) fn is_in_a_name(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || letter == '_'
}
