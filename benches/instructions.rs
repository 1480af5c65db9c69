//! How many instructions the hot paths take, which does not depend on what else
//! the machine does.
//!
//! `cargo bench --bench instructions [-- --out FILE]`. The program starts itself under
//! callgrind, which counts the instructions, the conditional branches and those
//! that its *simulated* predictor gets wrong: a table of counters as processors
//! had in 2000, without the long histories of today's, so that these are
//! comparable with each other only. Real mispredictions are counted by `perf stat`,
//! where the machine has counters for them.
//!
//! A count is of one pass over segments that the passes before have not seen,
//! with the call and the loop around it; over a slice, of one call for 1024 segments.
//! Without valgrind nothing is counted, and a message says so; so it does about slices
//! where valgrind does not know this processor's instructions, as valgrind 3.19 does not know
//! some of AVX2 code. The table goes to the standard output, the numbers to FILE
//! (`target/instructions.json` if none is given): an object with `valgrind`, its version;
//! `segments`, how many each count is of; `rows`, a list of objects with
//! `algorithm, tier, mix`, and, for a segment, `instructions, branches,
//! mispredicted_simulated` and `mispredicted` (null where nothing counts them).

use frusta::clip::{CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, VwProjection};
use frusta::samples::Placement;
use frusta::{Accuracy, Frustum, Pose, Real, Segment, SegmentClip};
use frusta_lab::mixes::{Form, Mix, assert_exact_agree, call, frustum, samples};
use std::cell::RefCell;
use std::error::Error;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Segments in one count, after as many others that are not counted.
const COUNT: usize = 16_384;

/// Passes that `perf` sees beside the first, whose start-up costs it sees, too.
const PASSES: usize = 64;

/// Segments clipped with one call, over slices.
const PIECE: usize = 1024;

/// Segments of a kind, in both precisions, and the frustum they are clipped by.
struct Case {
    name: &'static str,
    frustum: Frustum,
    doubles: Vec<Segment<f64>>,
    singles: Vec<Segment<f32>>,
}

/// The mixes in the frame, and the 78 singular samples.
fn cases() -> Vec<Case> {
    let pose = Pose::IDENTITY;
    let mut all: Vec<Case> = Mix::ALL
        .into_iter()
        .map(|mix| Case {
            name: mix.name(),
            frustum: frustum(Form::Symmetric.shape(), &pose),
            doubles: mix.segments(2 * COUNT, &pose),
            singles: mix.segments(2 * COUNT, &pose),
        })
        .collect();
    let (frustum, mut doubles) = samples(&Placement::IDENTITY);
    doubles.truncate(2 * COUNT);
    let (_, mut singles) = samples(&Placement::IDENTITY);
    singles.truncate(2 * COUNT);
    all.push(Case {
        name: "singular-78",
        frustum,
        doubles,
        singles,
    });
    all
}

/// Clips one half of a case's segments.
type Run = Box<dyn Fn(&Case, usize)>;

/// What is counted: an algorithm in a tier.
struct Row {
    algorithm: &'static str,
    tier: &'static str,
    run: Run,
}

/// One pass over a half.
fn pass<T: Real>(clipper: &impl SegmentClipper<T>, frustum: &Frustum, all: &[Segment<T>]) {
    for segment in all {
        let _ = black_box(&call(clipper, frustum, segment));
    }
}

fn half<T>(all: &[Segment<T>], number: usize) -> &[Segment<T>] {
    &all[number * COUNT..][..COUNT]
}

fn in_doubles(
    algorithm: &'static str,
    tier: &'static str,
    clipper: impl SegmentClipper<f64> + 'static,
) -> Row {
    let run = move |case: &Case, i| pass(&clipper, &case.frustum, half(&case.doubles, i));
    Row {
        algorithm,
        tier,
        run: Box::new(run),
    }
}

fn in_singles(
    algorithm: &'static str,
    tier: &'static str,
    clipper: impl SegmentClipper<f32> + 'static,
) -> Row {
    let run = move |case: &Case, i| pass(&clipper, &case.frustum, half(&case.singles, i));
    Row {
        algorithm,
        tier,
        run: Box::new(run),
    }
}

/// Over slices, into a buffer that the counted pass finds as long as it must be.
fn slices<T: Real>(
    algorithm: &'static str,
    tier: &'static str,
    clipper: impl SegmentClipper<T> + 'static,
    of: fn(&Case) -> &[Segment<T>],
) -> Row {
    let clips = RefCell::new(Vec::<SegmentClip<T>>::new());
    let run = move |case: &Case, i| {
        let mut clips = clips.borrow_mut();
        for piece in half(of(case), i).chunks(PIECE) {
            let done = clipper.clip_segments(&case.frustum, piece, &mut clips);
            done.expect("the segments are finite");
            black_box(&clips);
        }
    };
    Row {
        algorithm,
        tier,
        run: Box::new(run),
    }
}

/// Which of [`rows`] are slices.
const SLICES: usize = 1;

/// All that is counted, in the order of the table: one call a segment, then one a
/// slice.
fn rows() -> [Vec<Row>; 2] {
    [singly(), over_slices()]
}

fn over_slices() -> Vec<Row> {
    use LiangBarskyVariant::{Textbook, Tuned};
    let fast = VwProjection::exact(Accuracy::Fast);
    vec![
        slices(
            "textbook",
            "slices-f64",
            LiangBarsky::plain(Textbook),
            |case| &case.doubles,
        ),
        slices("tuned", "slices-f64", LiangBarsky::plain(Tuned), |case| {
            &case.doubles
        }),
        slices("vw", "slices-plain", VwProjection::plain(), |case| {
            &case.doubles
        }),
        slices("vw", "slices-plain-f32", VwProjection::plain(), |case| {
            &case.singles
        }),
        slices("vw", "slices-fast", fast, |case| &case.doubles),
        slices("vw", "slices-fast-f32", fast, |case| &case.singles),
    ]
}

fn singly() -> Vec<Row> {
    use Accuracy::{Fast, Inward, Nearest};
    use LiangBarskyVariant::{Textbook, Tuned};
    let exact = VwProjection::exact;
    vec![
        in_doubles("textbook", "plain-f64", LiangBarsky::plain(Textbook)),
        in_doubles("tuned", "plain-f64", LiangBarsky::plain(Tuned)),
        in_doubles("cyrus-beck", "plain-f64", CyrusBeck::plain()),
        in_doubles("vw", "plain-f64", VwProjection::plain()),
        in_singles("vw", "plain-f32", VwProjection::plain()),
        in_doubles("vw", "exact-fast", exact(Fast)),
        in_doubles("vw", "exact-nearest", exact(Nearest)),
        in_doubles("vw", "exact-inward", exact(Inward)),
        in_singles("vw", "exact-fast-f32", exact(Fast)),
    ]
}

/// Callgrind counts inside this function, and writes a file at its end.
#[inline(never)]
fn count_here(row: &Row, case: &Case) {
    (row.run)(black_box(case), 1);
}

/// What runs under callgrind: one half of the rows, of all cases.
fn counted(part: usize) {
    let cases = cases();
    for row in &rows()[part] {
        for case in &cases {
            // The simulated predictor and the caches get to know the code.
            (row.run)(case, 0);
            count_here(row, case);
        }
    }
}

/// What runs under `perf`: one row of one case, some times more.
fn repeated(row: usize, case: usize, more: usize) {
    let (rows, cases) = (rows().into_iter().flatten().collect::<Vec<_>>(), cases());
    for _ in 0..=more {
        (rows[row].run)(&cases[case], 1);
    }
}

/// Counts of one pass.
struct Count {
    instructions: f64,
    branches: f64,
    mispredicted_simulated: f64,
    /// By the processor itself.
    mispredicted: Option<f64>,
}

/// What callgrind wrote: the events' names and their sums.
fn parse(text: &str) -> Outcome<Count> {
    let line = |key: &str| {
        let found = text.lines().find_map(|line| line.strip_prefix(key));
        found.ok_or_else(|| format!("callgrind's file has no line {key}"))
    };
    let names: Vec<&str> = line("events:")?.split_whitespace().collect();
    let sums = line("totals:").or_else(|_| line("summary:"))?;
    let sums: Vec<f64> = sums
        .split_whitespace()
        .map(str::parse)
        .collect::<Result<_, _>>()?;
    let sum = |name: &str| {
        let found = names.iter().zip(&sums).find(|(n, _)| **n == name);
        // Trailing zeros are left out.
        found.map_or(0.0, |(_, sum)| sum / COUNT as f64)
    };
    Ok(Count {
        instructions: sum("Ir"),
        branches: sum("Bc"),
        mispredicted_simulated: sum("Bcm"),
        mispredicted: None,
    })
}

/// A program's answer to `--version`; `None` if there is no such program.
fn version(program: &str) -> Option<String> {
    let output = Command::new(program).arg("--version").output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    output.status.success().then_some(text)
}

/// All counts of one part of the rows, row by row; `None` if valgrind does not know an
/// instruction.
fn under_callgrind(folder: &Path, part: usize, how_many: usize) -> Outcome<Option<Vec<Count>>> {
    let out = folder.join(format!("out.{part}"));
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--branch-sim=yes", "--quiet"])
        .arg("--toggle-collect=instructions::count_here")
        .arg("--dump-after=instructions::count_here")
        .arg(format!("--callgrind-out-file={}", out.display()))
        .arg(std::env::current_exe()?)
        .args(["--counted", &part.to_string()])
        .stderr(Stdio::piped())
        .output()?;
    let said = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        if said.contains("SIGILL") {
            return Ok(None);
        }
        return Err(format!("valgrind: {}\n{said}", output.status).into());
    }
    (1..=how_many)
        .map(|i| {
            let file = folder.join(format!("out.{part}.{i}"));
            parse(&std::fs::read_to_string(file)?)
        })
        .collect::<Outcome<_>>()
        .map(Some)
}

/// Branches that the processor itself mispredicted in a run of this program, or
/// `perf`'s own run of `true`; `None` where it does not count them.
fn mispredictions(args: Option<[String; 3]>) -> Option<f64> {
    let mut perf = Command::new("perf");
    perf.args(["stat", "-x,", "-e", "branch-misses:u", "--"]);
    match args {
        Some(args) => perf
            .arg(std::env::current_exe().ok()?)
            .arg("--repeated")
            .args(args),
        None => perf.arg("true"),
    };
    let output = perf.output().ok()?;
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    let line = text.lines().find(|line| line.contains("branch-misses"))?;
    line.split(',').next()?.parse().ok()
}

/// The processor's mispredictions in one pass: more passes less one.
fn mispredictions_in(row: usize, case: usize) -> Option<f64> {
    let of = |more: usize| mispredictions(Some([row, case, more].map(|n| n.to_string())));
    Some((of(PASSES)? - of(0)?) / (PASSES * COUNT) as f64)
}

/// Prints one quantity of all counts.
fn table(title: &str, rows: &[Row], cases: &[Case], counts: &[Count], of: impl Fn(&Count) -> f64) {
    println!("\n{title}");
    print!("{:27}", "");
    cases.iter().for_each(|case| print!(" {:>13}", case.name));
    println!();
    for (row, counts) in rows.iter().zip(counts.chunks(cases.len())) {
        print!("{:10} {:16}", row.algorithm, row.tier);
        counts
            .iter()
            .for_each(|count| print!(" {:13.2}", of(count)));
        println!();
    }
}

fn json(valgrind: &str, rows: &[Row], cases: &[Case], counts: &[Count]) -> serde_json::Value {
    let each = rows
        .iter()
        .flat_map(|row| cases.iter().map(move |case| (row, case)));
    let list: Vec<_> = each
        .zip(counts)
        .map(|((row, case), count)| {
            serde_json::json!({
                "algorithm": row.algorithm,
                "tier": row.tier,
                "mix": case.name,
                "instructions": count.instructions,
                "branches": count.branches,
                "mispredicted_simulated": count.mispredicted_simulated,
                "mispredicted": count.mispredicted,
            })
        })
        .collect();
    serde_json::json!({ "valgrind": valgrind, "segments": COUNT, "rows": list })
}

/// Counts all rows that this valgrind can count, and says what it cannot.
fn count(valgrind: &str, cases: &[Case]) -> Outcome<(Vec<Row>, Vec<Count>)> {
    let folder = std::env::temp_dir().join(format!("frusta-instructions-{}", std::process::id()));
    std::fs::create_dir(&folder)?;
    let (mut counted, mut counts) = (Vec::new(), Vec::new());
    let mut failure = None;
    for (part, rows) in rows().into_iter().enumerate() {
        match under_callgrind(&folder, part, rows.len() * cases.len()) {
            Ok(Some(found)) => {
                counts.extend(found);
                counted.extend(rows);
            }
            Ok(None) if part == SLICES => println!(
                "NOT COUNTED: slices: {valgrind} does not know an instruction that they use here"
            ),
            Ok(None) => failure = Some("valgrind does not know an instruction".into()),
            Err(error) => failure = Some(error),
        }
    }
    std::fs::remove_dir_all(&folder)?;
    failure.map_or(Ok((counted, counts)), Err)
}

/// Counts, prints and writes.
fn report(valgrind: &str, file: &Path) -> Outcome<()> {
    let cases = cases();
    for case in &cases {
        assert_exact_agree(&case.frustum, &case.doubles);
        assert_exact_agree(&case.frustum, &case.singles);
    }
    println!("{valgrind}; {COUNT} segments a count, symmetric frustum, in the frame");
    let (rows, mut counts) = count(valgrind, &cases)?;
    let print = |title, counts: &[Count], of: fn(&Count) -> f64| {
        table(title, &rows, &cases, counts, of);
    };
    print("instructions a segment", &counts, |c| c.instructions);
    print("conditional branches a segment", &counts, |c| c.branches);
    let title = "branches mispredicted a segment, SIMULATED by callgrind";
    print(title, &counts, |c| c.mispredicted_simulated);
    if mispredictions(None).is_some() {
        for (i, count) in counts.iter_mut().enumerate() {
            count.mispredicted = mispredictions_in(i / cases.len(), i % cases.len());
        }
        let title = "branches mispredicted a segment, counted by the processor";
        print(title, &counts, |c| c.mispredicted.unwrap_or(f64::NAN));
    } else {
        println!(
            "\nNOT COUNTED: branches that this processor mispredicts (perf stat -e branch-misses \
             is not there or not supported)"
        );
    }
    let text = serde_json::to_string_pretty(&json(valgrind, &rows, &cases, &counts))?;
    std::fs::write(file, text + "\n")?;
    println!("\n{}", file.display());
    Ok(())
}

fn main() -> Outcome<()> {
    // Cargo passes --bench, too.
    let args: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| a != "--bench")
        .collect();
    let words: Vec<&str> = args.iter().map(String::as_str).collect();
    match words[..] {
        ["--counted", part] => counted(part.parse()?),
        ["--repeated", row, case, more] => repeated(row.parse()?, case.parse()?, more.parse()?),
        _ => {
            let Some(valgrind) = version("valgrind") else {
                println!(
                    "NOT COUNTED: instructions are counted by valgrind, which is not installed"
                );
                return Ok(());
            };
            let file = match words[..] {
                ["--out", file] => PathBuf::from(file),
                _ => Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("instructions.json"),
            };
            report(&valgrind, &file)?;
        }
    }
    Ok(())
}
