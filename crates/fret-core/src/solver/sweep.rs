//! One pass over the cells of several fields: new values, sums and maxima together, in an order that never depends on the
//! machine.

use pulp::Arch;

const LANES: usize = 8;

/// For every cell replaces the values of `outputs` and adds up what `step` returns: `N` sums and `M` maxima (of values that
/// are not negative). `step` sees the old values of the outputs and the inputs of one cell.
///
/// The partial sums are eight, whatever the processor: its widest instructions give the same bits as its narrowest.
///
/// # Panics
/// When the fields are not of one length.
#[inline(always)]
pub fn sweep<const O: usize, const K: usize, const N: usize, const M: usize>(
    outputs: [&mut [f64]; O],
    inputs: [&[f64]; K],
    step: impl Fn([f64; O], [f64; K]) -> ([f64; O], [f64; N], [f64; M]),
) -> ([f64; N], [f64; M]) {
    Arch::new().dispatch(
        #[inline(always)]
        move || swept(outputs, inputs, step),
    )
}

#[inline(always)]
fn swept<const O: usize, const K: usize, const N: usize, const M: usize>(
    mut outputs: [&mut [f64]; O],
    inputs: [&[f64]; K],
    step: impl Fn([f64; O], [f64; K]) -> ([f64; O], [f64; N], [f64; M]),
) -> ([f64; N], [f64; M]) {
    let len =
        inputs.first().map_or_else(|| outputs.first().map_or(0, |field| field.len()), |field| field.len());
    assert!(inputs.iter().all(|field| field.len() == len) && outputs.iter().all(|field| field.len() == len));
    let mut sums = [[0.0_f64; LANES]; N];
    let mut most = [[0.0_f64; LANES]; M];
    let mut first = 0;
    while first < len {
        let count = LANES.min(len - first);
        let mut old = [[0.0; LANES]; O];
        let mut given = [[0.0; LANES]; K];
        if count == LANES {
            for (row, field) in old.iter_mut().zip(&outputs) {
                row.copy_from_slice(&field[first..first + LANES]);
            }
            for (row, field) in given.iter_mut().zip(&inputs) {
                row.copy_from_slice(&field[first..first + LANES]);
            }
            for lane in 0..LANES {
                let (new, terms, sizes) = step(old.map(|row| row[lane]), given.map(|row| row[lane]));
                for output in 0..O {
                    old[output][lane] = new[output];
                }
                for term in 0..N {
                    sums[term][lane] += terms[term];
                }
                for size in 0..M {
                    most[size][lane] =
                        if sizes[size] > most[size][lane] { sizes[size] } else { most[size][lane] };
                }
            }
            for (row, field) in old.iter().zip(&mut outputs) {
                field[first..first + LANES].copy_from_slice(row);
            }
        } else {
            for lane in 0..count {
                let mut values = [0.0; O];
                for output in 0..O {
                    values[output] = outputs[output][first + lane];
                }
                let (new, terms, sizes) = step(values, inputs.map(|field| field[first + lane]));
                for output in 0..O {
                    outputs[output][first + lane] = new[output];
                }
                for term in 0..N {
                    sums[term][lane] += terms[term];
                }
                for size in 0..M {
                    most[size][lane] =
                        if sizes[size] > most[size][lane] { sizes[size] } else { most[size][lane] };
                }
            }
        }
        first += LANES;
    }
    let folded = |l: [f64; LANES]| ((l[0] + l[1]) + (l[2] + l[3])) + ((l[4] + l[5]) + (l[6] + l[7]));
    (sums.map(folded), most.map(|lanes| lanes.into_iter().fold(0.0, f64::max)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_sums_and_maxima_of_any_length() {
        for len in [0, 1, 7, 8, 9, 40, 61] {
            let a: Vec<f64> = (0..len).map(|i| i as f64).collect();
            let mut b = vec![2.0; len];
            let ([plain, squares], [most]) = sweep([&mut b], [&a], |[b], [a]| ([b * a], [a, a * a], [a]));
            let n = len as f64;
            // small integers: exact in any order
            assert_eq!(plain, n * (n - 1.0).max(0.0) / 2.0);
            assert_eq!(squares, a.iter().map(|a| a * a).sum::<f64>());
            assert_eq!(most, (n - 1.0).max(0.0));
            assert!(b.iter().enumerate().all(|(i, b)| *b == 2.0 * i as f64));
        }
    }
}
