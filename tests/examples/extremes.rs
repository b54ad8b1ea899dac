use fret_validation::extreme_cases::{Outcome, run};
fn main() {
    let a: Vec<u64> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
    let text = std::env::var_os("TEXT").is_some();
    let t = std::time::Instant::now();
    let mut counts = [0; 4];
    for seed in a[0]..a[1] {
        let b = std::time::Instant::now();
        let e = run(seed, [16, 40]);
        let s = b.elapsed().as_secs_f64();
        match &e.outcome {
            Outcome::Certified => counts[0] += 1,
            Outcome::Refused(_) => counts[1] += 1,
            Outcome::Unsolved(_) => counts[2] += 1,
            Outcome::Wrong(_) => counts[3] += 1,
        }
        if e.outcome != Outcome::Certified || s > 5.0 || text {
            println!("{seed} {:?} {s:.1} s {} {}: {:?}", e.family, e.increments, e.in_parts, e.outcome);
            if text { println!("{}", e.text); }
        }
    }
    println!("{counts:?} {:.1} s", t.elapsed().as_secs_f64());
}
