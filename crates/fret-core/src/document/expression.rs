//! An expression of numbers in named variables, as it is written on paper: read once, evaluated often. Powers bind before signs (`-x^2` is
//! `-(x^2)`) and from the right.

use std::ops::Range;

/// Numbers that an evaluation holds at once, and parentheses inside one another, at the most: more than any formula needs, and little memory.
const DEEPEST: usize = 32;
/// Whole powers up to this one are products, so that `x^2` is `x*x` to the last bit.
const LARGEST_PRODUCT: f64 = 64.0;

/// Functions of one number.
const FUNCTIONS: [(&str, fn(f64) -> f64); 14] = [
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
const OF_TWO: [(&str, fn(f64, f64) -> f64, Arguments); 4] = [
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
            Arguments::Two if count != 2 => {
                Err(self.wrong(place, &format!("{name} of {count} numbers"), &format!("{name}(a, b)")))
            }
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
mod tests {
    use rand_pcg::Pcg64Mcg;
    use rand_pcg::rand_core::Rng;

    use super::{DEEPEST, Expression, is_free_name};

    fn parse(text: &str) -> Result<Expression, super::ExpressionError> {
        Expression::parse(text, &["x", "y"], &[("R".to_owned(), 8.0), ("k_1".to_owned(), 3.0)])
    }

    /// At x = 2, y = 3.
    fn value(text: &str) -> f64 {
        parse(text).unwrap_or_else(|error| panic!("{text}: {error:?}")).at(&[2.0, 3.0])
    }

    #[test]
    fn it_means_what_it_means_on_paper() {
        for (text, right) in [
            ("1 + 2*3", 7.0),
            ("(1 + 2)*3", 9.0),
            ("8 - 4 - 2", 2.0),
            ("8/4/2", 1.0),
            ("-x^2", -4.0),
            ("2^-1", 0.5),
            ("2^3^2", 512.0),
            ("2**3", 8.0),
            ("-2^2 + --3", -1.0),
            ("2*-3", -6.0),
            ("1e-3*1.5E+3 + .5 + 2.", 4.0),
            ("(x^2 + y^2)/(2*R)", 0.8125),
            ("k_1 * pi / pi", 3.0),
            ("max(1, max(x, y), 2) + min(y, x)", 5.0),
            ("hypot(3, 4) + mod(-1, 3)", 7.0),
            ("\tsqrt( 16 )\n+ abs(-1)", 5.0),
            ("cos(0) + ln(exp(2)) + log10(1e3)", 6.0),
            ("4^0.5 + 10^-2*100", 3.0),
        ] {
            let found = value(text);
            assert!((found - right).abs() < 1e-14, "{text}: {found} for {right}");
        }
    }

    /// So that a sphere by a formula is the sphere.
    #[test]
    fn a_square_is_a_product_to_the_last_bit() {
        let square = parse("x^2").unwrap();
        let mut random = Pcg64Mcg::new(1);
        for _ in 0..1000 {
            let x = random.next_u64() as f64 * 1e-17;
            assert_eq!(square.at(&[x, 0.0]), x * x);
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        for (text, words, at) in [
            ("", "it ends where a number", 0..0),
            ("x +", "it ends where a number", 3..3),
            ("2x", "found \"x\", expected an operator", 1..2),
            ("x + z^2", "unknown name \"z\", at character 5", 4..5),
            ("x²", "found \"²\", expected an operator or the end, at character 2", 1..3),
            ("é + z", "found \"é\", expected a number", 0..2),
            ("(x + y", "( that is not closed, at character 1", 0..1),
            ("x)", ") without its (", 1..2),
            ("sin x", "sin without its argument", 0..3),
            ("hypot(1)", "hypot of 1 numbers", 0..5),
            ("max(1)", "max of one number", 0..3),
            ("sin(1, 2)", "found \",\", expected an operator or )", 5..6),
            ("min(1, 2", "( that is not closed", 3..4),
            ("1.2.3", "found \".\", expected an operator", 3..4),
            (".", "\".\" is no number", 0..1),
            ("1e999", "too large", 0..5),
            ("log(x)", "unknown name \"log\"", 0..3),
            ("x ^ ", "it ends where", 4..4),
            ("3 $ 4", "found \"$\"", 2..3),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.message.contains(words), "{text}: {error:?}");
            assert_eq!(error.at, at, "{text}: {error:?}");
        }
        let help = parse("z").unwrap_err().help;
        assert!(help.starts_with("known are x, y, R, k_1, pi; functions are abs, sqrt"), "{help}");
    }

    #[test]
    fn it_is_nested_only_so_deeply() {
        let nested = |depth: usize| format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
        assert!(parse(&nested(DEEPEST)).is_ok());
        for text in [
            nested(DEEPEST + 1),
            nested(200_000),
            "(".repeat(200_000),
            "2^".repeat(200_000),
            "sin(".repeat(200_000),
            "x+(".repeat(200_000),
            "min(1,".repeat(200_000),
        ] {
            assert!(parse(&text).unwrap_err().message.contains("nested too deeply"));
        }
        // signs and long sums are not nested
        assert_eq!(value(&format!("{}x", "-".repeat(200_000))), 2.0);
        assert_eq!(value(&format!("0{}", "+x".repeat(100_000))), 200_000.0);
    }

    /// Two hundred thousand texts of the letters that formulas are made of, and some that they are not: read or refused at a place inside, and what is
    /// read has a value.
    #[test]
    fn no_text_does_harm() {
        let letters: Vec<char> = "xy R(),^*/+-..0123e sincosmaxsqrt pi_αé²\t\n\u{0}∞{}".chars().collect();
        let mut random = Pcg64Mcg::new(7);
        let mut below = |bound: usize| (random.next_u64() % bound as u64) as usize;
        let mut read = 0;
        for _ in 0..200_000 {
            let text: String = (0..below(24)).map(|_| letters[below(letters.len())]).collect();
            match parse(&text) {
                Ok(expression) => {
                    expression.at(&[2.0, 3.0]);
                    expression.at(&[]);
                    read += 1;
                }
                Err(error) => assert!(text.get(error.at.clone()).is_some(), "{text:?}: {error:?}"),
            }
        }
        assert!(read > 1000, "{read}");
    }

    #[test]
    fn names_of_parameters_are_free() {
        for (name, is_free) in [
            ("R", true),
            ("a_1", true),
            ("_", true),
            ("x", false),
            ("pi", false),
            ("sin", false),
            ("max", false),
            ("1a", false),
            ("a b", false),
            ("", false),
            ("µ", false),
        ] {
            assert_eq!(is_free_name(name, &["x", "y"]), is_free, "{name}");
        }
    }

    #[test]
    fn it_knows_what_it_depends_on() {
        let expression = parse("x^2/(2*R)").unwrap();
        assert_eq!([0, 1].map(|variable| expression.has(variable)), [true, false]);
        assert!(value("max(0/0, 1)").is_nan() && value("min(1, 0/0)").is_nan());
    }
}
