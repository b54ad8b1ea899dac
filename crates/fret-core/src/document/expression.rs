//! An expression of numbers in named variables, as it is written on paper: read once, evaluated often. Powers bind before signs (`-x^2` is
//! `-(x^2)`) and from the right.

use std::ops::Range;

/// Numbers that an evaluation holds at once, and parentheses inside one another, at the most: more than any formula needs, and little memory.
const DEEPEST: usize = 32;
/// Whole powers up to this one are products, so that `x^2` is `x*x` to the last bit.
const LARGEST_PRODUCT: f64 = 64.0;

/// A rule for one number, and for two.
type OfOne = fn(f64) -> f64;
type OfTwo = fn(f64, f64) -> f64;

/// Functions of one number.
const FUNCTIONS: [(&str, OfOne); 14] = [
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
const OF_TWO: [(&str, OfTwo, Arguments); 4] = [
    ("min", least, Arguments::Several),
    ("max", greatest, Arguments::Several),
    ("hypot", f64::hypot, Arguments::Two),
    ("mod", f64::rem_euclid, Arguments::Two),
];
/// Names of numbers that do not change.
const CONSTANTS: [(&str, f64); 1] = [("pi", std::f64::consts::PI)];

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
enum Arguments {
    Two,
    Several,
}

/// A step of an evaluation: puts a number on the pile, or takes one or two from it and puts back what becomes of them.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Step {
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

/// What is wrong with an expression.
#[derive(Debug, Clone, PartialEq)]
pub struct ExpressionError {
    /// What.
    pub message: String,
    /// What is allowed.
    pub help: String,
    /// Bytes of the expression that it is about.
    pub at: Range<usize>,
}

/// An expression that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    steps: Vec<Step>,
}

impl Expression {
    /// Reads an expression in `variables`; `constants` are names of numbers.
    ///
    /// # Errors
    /// When it is none.
    pub fn parse(
        text: &str,
        variables: &[&str],
        constants: &[(String, f64)],
    ) -> Result<Self, ExpressionError> {
        let mut reading =
            Reading { text, at: 0, variables, constants, steps: Vec::new(), held: 0, inside: 0 };
        reading.sum()?;
        match reading.next() {
            None => Ok(Self { steps: reading.steps }),
            Some(')') => Err(reading.wrong_here(") without its (", "")),
            Some(_) => Err(reading.wrong_here(
                &format!("found {:?}, expected an operator or the end", reading.word()),
                "products are written with *: 2*x, 3*(x + y)",
            )),
        }
    }

    /// Whether it depends on the variable of that number.
    pub fn has(&self, variable: usize) -> bool {
        self.steps.contains(&Step::Variable(variable))
    }

    /// Its value; of a variable that is not given, no number.
    pub fn at(&self, variables: &[f64]) -> f64 {
        let mut pile = [0.0; DEEPEST];
        let mut held = 0;
        for step in &self.steps {
            let of_two = |pile: &mut [f64; DEEPEST], rule: &dyn Fn(f64, f64) -> f64| {
                pile[held - 2] = rule(pile[held - 2], pile[held - 1]);
            };
            match *step {
                Step::Number(number) => pile[held] = number,
                Step::Variable(number) => pile[held] = variables.get(number).copied().unwrap_or(f64::NAN),
                Step::Negative => pile[held - 1] = -pile[held - 1],
                Step::Function(number) => pile[held - 1] = FUNCTIONS[number].1(pile[held - 1]),
                Step::Sum => of_two(&mut pile, &|one, other| one + other),
                Step::Difference => of_two(&mut pile, &|one, other| one - other),
                Step::Product => of_two(&mut pile, &|one, other| one * other),
                Step::Quotient => of_two(&mut pile, &|one, other| one / other),
                Step::Power => of_two(&mut pile, &power),
                Step::FunctionOfTwo(number) => of_two(&mut pile, &OF_TWO[number].1),
            }
            held = step.held_after(held);
        }
        pile[0]
    }
}

impl Step {
    /// Numbers on the pile after it.
    fn held_after(self, before: usize) -> usize {
        match self {
            Self::Number(_) | Self::Variable(_) => before + 1,
            Self::Negative | Self::Function(_) => before,
            _ => before - 1,
        }
    }
}

fn power(base: f64, exponent: f64) -> f64 {
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

fn starts_a_name(letter: char) -> bool {
    letter.is_ascii_alphabetic() || letter == '_'
}

fn is_in_a_name(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || letter == '_'
}

/// An expression while it is read, by precedence: a sum of products of signed powers.
struct Reading<'t> {
    text: &'t str,
    /// Bytes read.
    at: usize,
    variables: &'t [&'t str],
    constants: &'t [(String, f64)],
    steps: Vec<Step>,
    /// Numbers on the pile after the steps so far.
    held: usize,
    /// Parentheses and exponents that are open.
    inside: usize,
}

type Read = Result<(), ExpressionError>;

impl Reading<'_> {
    fn sum(&mut self) -> Read {
        self.product()?;
        loop {
            let step = match self.next() {
                Some('+') => Step::Sum,
                Some('-') => Step::Difference,
                _ => return Ok(()),
            };
            self.at += 1;
            self.product()?;
            self.take(step)?;
        }
    }

    fn product(&mut self) -> Read {
        self.signed()?;
        loop {
            let step = match self.next() {
                Some('*') => Step::Product,
                Some('/') => Step::Quotient,
                _ => return Ok(()),
            };
            self.at += 1;
            self.signed()?;
            self.take(step)?;
        }
    }

    /// A power, and the signs before it.
    fn signed(&mut self) -> Read {
        let mut negative = false;
        while let Some(sign @ ('+' | '-')) = self.next() {
            negative ^= sign == '-';
            self.at += 1;
        }
        self.power()?;
        if negative { self.take(Step::Negative) } else { Ok(()) }
    }

    fn power(&mut self) -> Read {
        self.operand()?;
        self.next();
        let rest = &self.text[self.at..];
        let sign = ["**", "^"].into_iter().find(|sign| rest.starts_with(sign));
        let Some(sign) = sign else { return Ok(()) };
        let open = self.at;
        self.at += sign.len();
        self.deeper(open, Self::signed)?;
        self.take(Step::Power)
    }

    fn operand(&mut self) -> Read {
        match self.next() {
            Some('(') => self.in_parentheses(Self::sum),
            Some(letter) if letter.is_ascii_digit() || letter == '.' => self.number(),
            Some(letter) if starts_a_name(letter) => self.name(),
            Some(_) => Err(self.wrong_here(
                &format!("found {:?}, expected a number, a name or (", self.word()),
                "operators are + - * / ^; powers are written x^2",
            )),
            None => {
                let end = self.text.len();
                Err(self.wrong(end..end, "it ends where a number, a name or ( is expected", ""))
            }
        }
    }

    fn in_parentheses(&mut self, read: fn(&mut Self) -> Read) -> Read {
        let open = self.at;
        self.at += 1;
        self.deeper(open, read)?;
        if self.next() == Some(')') {
            self.at += 1;
            return Ok(());
        }
        match self.next() {
            None => Err(self.wrong(open..open + 1, "( that is not closed", "")),
            Some(_) => {
                Err(self.wrong_here(&format!("found {:?}, expected an operator or )", self.word()), ""))
            }
        }
    }

    fn deeper(&mut self, open: usize, read: fn(&mut Self) -> Read) -> Read {
        self.inside += 1;
        if self.inside > DEEPEST {
            return Err(self.too_deep(open));
        }
        read(self)?;
        self.inside -= 1;
        Ok(())
    }

    fn number(&mut self) -> Read {
        let rest = &self.text[self.at..];
        let digits = |from: usize| from + rest[from..].bytes().take_while(u8::is_ascii_digit).count();
        let mut end = digits(0);
        if rest[end..].starts_with('.') {
            end = digits(end + 1);
        }
        if let Some(exponent) = rest[end..].strip_prefix(['e', 'E']) {
            let sign = usize::from(exponent.starts_with(['+', '-']));
            let last = digits(end + 1 + sign);
            if last > end + 1 + sign {
                end = last;
            }
        }
        let place = self.at..self.at + end;
        self.at += end;
        match rest[..end].parse::<f64>() {
            Ok(number) if number.is_finite() => self.take(Step::Number(number)),
            Ok(_) => Err(self.wrong(place, "a number that is too large", "")),
            Err(_) => Err(self.wrong(place, &format!("{:?} is no number", &rest[..end]), "")),
        }
    }

    fn name(&mut self) -> Read {
        let rest = &self.text[self.at..];
        let name = &rest[..rest.bytes().take_while(|byte| is_in_a_name(char::from(*byte))).count()];
        let place = self.at..self.at + name.len();
        self.at += name.len();
        if let Some(number) = FUNCTIONS.iter().position(|(known, _)| *known == name) {
            self.opens(&place)?;
            self.in_parentheses(Self::sum)?;
            return self.take(Step::Function(number));
        }
        if let Some(number) = OF_TWO.iter().position(|(known, ..)| *known == name) {
            self.opens(&place)?;
            return self.arguments(number, place);
        }
        if let Some(number) = self.variables.iter().position(|known| *known == name) {
            return self.take(Step::Variable(number));
        }
        let own = self.constants.iter().find(|(known, _)| known == name).map(|(_, value)| *value);
        let known = || CONSTANTS.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
        if let Some(value) = own.or_else(known) {
            return self.take(Step::Number(value));
        }
        let message = format!("unknown name {name:?}");
        Err(self.wrong(place, &message, &self.names()))
    }

    /// Arguments of a function of two numbers, or of several.
    fn arguments(&mut self, number: usize, place: Range<usize>) -> Read {
        let (name, _, takes) = OF_TWO[number];
        let open = self.at;
        self.at += 1;
        self.deeper(open, Self::sum)?;
        let mut count = 1;
        while self.next() == Some(',') {
            self.at += 1;
            self.deeper(open, Self::sum)?;
            self.take(Step::FunctionOfTwo(number))?;
            count += 1;
        }
        match self.next() {
            Some(')') => self.at += 1,
            None => return Err(self.wrong(open..open + 1, "( that is not closed", "")),
            Some(_) => {
                return Err(self.wrong_here(
                    &format!("found {:?}, expected an operator, a comma or )", self.word()),
                    "",
                ));
            }
        }
        match takes {
            Arguments::Two if count != 2 => Err(self.wrong(
                place,
                &format!("{name} takes two numbers, found {count}"),
                &format!("{name}(a, b)"),
            )),
            Arguments::Several if count < 2 => {
                Err(self.wrong(place, &format!("{name} of one number"), &format!("{name}(a, b, ...)")))
            }
            _ => Ok(()),
        }
    }

    /// That a function is followed by its arguments.
    fn opens(&mut self, name: &Range<usize>) -> Read {
        if self.next() == Some('(') {
            return Ok(());
        }
        let word = &self.text[name.clone()];
        let message = format!("{word} without its argument");
        Err(self.wrong(name.clone(), &message, &format!("{word}(...)")))
    }

    /// Takes a step.
    fn take(&mut self, step: Step) -> Read {
        self.held = step.held_after(self.held);
        if self.held > DEEPEST {
            return Err(self.too_deep(self.at.min(self.text.len())));
        }
        self.steps.push(step);
        Ok(())
    }

    /// The next letter but blanks, which are passed over; not read.
    fn next(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    /// The word or letter that stands next.
    fn word(&self) -> &str {
        let rest = &self.text[self.at..];
        let length =
            rest.chars().take_while(|letter| is_in_a_name(*letter)).map(char::len_utf8).sum::<usize>();
        &rest[..length.max(rest.chars().next().map_or(0, char::len_utf8))]
    }

    fn names(&self) -> String {
        let mut own: Vec<&str> = self.variables.to_vec();
        own.extend(self.constants.iter().map(|(name, _)| name.as_str()));
        own.extend(CONSTANTS.map(|(name, _)| name));
        let functions = FUNCTIONS.map(|(name, _)| name).into_iter().chain(OF_TWO.map(|(name, ..)| name));
        format!("known are {}; functions are {}", own.join(", "), functions.collect::<Vec<_>>().join(", "))
    }

    fn too_deep(&self, at: usize) -> ExpressionError {
        self.wrong(at..at, "nested too deeply", "at most 32 parentheses and powers inside one another")
    }

    fn wrong_here(&self, message: &str, help: &str) -> ExpressionError {
        self.wrong(self.at..self.at + self.word().len(), message, help)
    }

    fn wrong(&self, at: Range<usize>, message: &str, help: &str) -> ExpressionError {
        let number = self.text[..at.start].chars().count() + 1;
        ExpressionError { message: format!("{message}, at character {number}"), help: help.to_owned(), at }
    }
}

#[cfg(test)]
mod tests;
