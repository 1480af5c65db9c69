//! Taking turns: on a machine that others use, too, times drift within seconds;
//! ratios of times taken side by side drift less.

/// One pass over the segments, and its nanoseconds for each.
pub(crate) type Pass<'a> = Box<dyn FnMut() -> f64 + 'a>;

/// Median times, and median ratios of the first one's time to each.
pub(crate) fn take_turns(passes: &mut [Pass<'_>], rounds: usize) -> Vec<(f64, f64)> {
    let mut times = vec![Vec::new(); passes.len()];
    let mut ratios = vec![Vec::new(); passes.len()];
    for round in 0..rounds + 2 {
        let mut now = vec![0.0; passes.len()];
        for turn in 0..passes.len() {
            let i = (round + turn) % passes.len();
            now[i] = passes[i]();
        }
        // The first rounds warm up.
        if round >= 2 {
            for (i, &time) in now.iter().enumerate() {
                times[i].push(time);
                ratios[i].push(now[0] / time);
            }
        }
    }
    let median = |mut v: Vec<f64>| {
        v.sort_by(f64::total_cmp);
        v[v.len() / 2]
    };
    let medians = times.into_iter().zip(ratios);
    medians.map(|(t, r)| (median(t), median(r))).collect()
}
