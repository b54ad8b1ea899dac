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
        ("hypot(1)", "hypot takes two numbers, found 1", 0..5),
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
