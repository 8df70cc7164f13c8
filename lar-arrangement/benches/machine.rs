//! What a second thread is worth on this machine for work that shares nothing, the most that a program can get out of it:
//! `cargo bench -p lar-arrangement --bench machine`
//!
//! Each kind of work is done by turns by one thread and, in halves, by two. Printed are medians of the times and of their ratios.

#![expect(clippy::print_stdout, reason = "a bench that reports")]

use std::hint::black_box;
use std::ops::Range;
use std::thread;
use std::time::Instant;

const TURNS: usize = 25;
/// Numbers of 8 bytes: several times what caches hold.
const N: usize = 1 << 23;

fn main() {
    let numbers: Vec<u64> = (0..N as u64).collect();
    // Each place once: steps by a multiple of the golden section, modulo a power of two.
    let scattered: Vec<u32> =
        (0..N as u32).map(|i| i.wrapping_mul(0x9e37_79b1) >> (32 - N.ilog2())).collect();
    println!("two halves by one thread and by two, medians of {TURNS} turns");
    report("arithmetic in registers", |range, _| {
        let mix = |x: u64, i: usize| (x ^ i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
        black_box(range.fold(1, |x, i| mix(mix(x, i), i + 1)));
    });
    report("numbers read in scattered order", |range, _| {
        let found = scattered[range].iter().map(|&i| numbers[i as usize]);
        black_box(found.fold(0u64, u64::wrapping_add));
    });
    report("a list read and another written", |range, own| {
        own.iter_mut().zip(&numbers[range]).for_each(|(to, from)| *to = from + 1);
        black_box(own);
    });
    report("a list written to new memory", |range, _| {
        black_box(numbers[range].iter().map(|from| from + 1).collect::<Vec<u64>>());
    });
}

/// Prints how long some work takes that is given ranges of 0..N, and as many numbers to write to.
fn report(name: &str, work: impl Fn(Range<usize>, &mut [u64]) + Sync) {
    let mut own = vec![1; N];
    let (left, right) = own.split_at_mut(N / 2);
    let mut turns: Vec<[f64; 3]> = Vec::new();
    for _ in 0..TURNS {
        let one = milliseconds(|| {
            work(0..N / 2, left);
            work(N / 2..N, right);
        });
        let two = milliseconds(|| {
            thread::scope(|scope| {
                scope.spawn(|| work(0..N / 2, left));
                work(N / 2..N, right);
            });
        });
        turns.push([one, two, one / two]);
    }
    let [one, two, ratio] = [0, 1, 2].map(|k| {
        turns.sort_unstable_by(|a, b| a[k].total_cmp(&b[k]));
        turns[TURNS / 2][k]
    });
    println!("{name:<34} {one:7.1} ms {two:7.1} ms  {ratio:.2} times as fast");
}

fn milliseconds(f: impl FnOnce()) -> f64 {
    let begin = Instant::now();
    f();
    begin.elapsed().as_secs_f64() * 1e3
}
