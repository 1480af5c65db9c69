//! `frusta samples export`: inputs and exact answers as files, to test any
//! program with.

use super::case::Case;
use super::choice;
use crate::failure::Failure;
use crate::io::atomic_file::AtomicFile;
use crate::io::number;
use crate::io::output::csv;
use crate::terminal::print;
use clap::{Args, ValueEnum};
use frusta::Frustum;
use frusta::samples::{Placement, Solid};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Write samples and their exact answers as files, to test any other program
///
/// The answers are those that the samples were made with; nothing is clipped for them.
#[derive(Args, Debug)]
#[command(after_long_help = FILES)]
pub(super) struct ExportArgs {
    /// The folder to write to; which is created if need be
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Only this solid; may be given several times [default: all]
    #[arg(long, value_name = "NAME", value_parser = choice::solid())]
    solid: Vec<Solid>,
    /// Only this place in the world; may be given several times [default: all]
    #[arg(long, value_name = "NAME")]
    placement: Vec<Place>,
    /// Also the near misses: on a feature's line or plane, but apart from the frustum
    #[arg(long)]
    near_misses: bool,
}

/// `--placement`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Place {
    /// The frustum's frame is the world
    Identity,
    /// Rotated by the integer quaternion 1, -2, 2, 4 and moved by 7, -3, 5
    Rotated,
    /// Times 2^-10
    Scaled,
}

impl Place {
    fn name(self) -> &'static str {
        ["identity", "rotated", "scaled"][self as usize]
    }

    fn placement(self) -> Placement {
        match self {
            Self::Identity => Placement::IDENTITY,
            Self::Rotated => Placement::rotated([1, -2, 2, 4]).moved_to([7.0, -3.0, 5.0].into()),
            Self::Scaled => Placement::IDENTITY.scaled(-10),
        }
    }
}

/// A file's name and contents.
type Content = (String, Vec<u8>);

/// Runs the command.
pub(super) fn run(args: &ExportArgs) -> Result<(), Failure> {
    let or_all = |chosen: &[Place]| match chosen {
        [] => Place::value_variants().to_vec(),
        _ => chosen.to_vec(),
    };
    let solids = match &args.solid[..] {
        [] => Solid::ALL.to_vec(),
        chosen => chosen.to_vec(),
    };
    // All of it before the first file: what fails leaves nothing.
    let mut files: Vec<Content> = Vec::new();
    let mut all = Vec::new();
    for solid in &solids {
        for place in or_all(&args.placement) {
            let samples = choice::samples(solid, args.near_misses).into_iter();
            let cases: Vec<Case> = samples
                .map(|sample| Case::new(sample, &place.placement()))
                .collect::<Result<_, _>>()?;
            let frustum = place.placement().place(solid).map_err(Failure::new)?;
            let row = |case: &Case| case.to_json(solid, place.name(), &frustum);
            all.extend(cases.iter().map(row));
            files.extend(contents(solid, place, &frustum, &cases)?);
        }
    }
    let (samples, frusta) = (all.len(), files.len() / 3);
    files.push(("samples.json".to_owned(), json(&Value::from(all))));
    prepare(&args.folder, &files)?;
    for (name, content) in &files {
        let mut file = AtomicFile::create(&args.folder.join(name))?;
        file.write(content)?;
        file.finish()?;
    }
    print(&format!(
        "{samples} samples of {frusta} frusta in {} files in {}\n",
        files.len(),
        args.folder.display()
    ))
}

/// The three files of a frustum.
fn contents(
    solid: &Solid,
    place: Place,
    frustum: &Frustum,
    cases: &[Case],
) -> Result<[Content; 3], Failure> {
    let name = |what: &str| format!("{}-{}.{what}", solid.name, place.name());
    let frustum = serde_json::to_value(frustum).map_err(Failure::new)?;
    let mut segments = b"x0,y0,z0,x1,y1,z1\n".to_vec();
    for case in cases {
        let ends = [case.segment.start, case.segment.end].map(|p| p.to_array());
        for (i, value) in ends.concat().into_iter().enumerate() {
            if i > 0 {
                segments.push(b',');
            }
            number::write(value, &mut segments);
        }
        segments.push(b'\n');
    }
    let expected: Vec<_> = cases.iter().map(|case| case.expected).collect();
    let mut answers = csv::HEADER.as_bytes().to_vec();
    csv::format(0, &expected, &mut answers);
    Ok([
        (name("frustum.json"), json(&frustum)),
        (name("segments.csv"), segments),
        (name("expected.csv"), answers),
    ])
}

fn json(value: &Value) -> Vec<u8> {
    format!("{value:#}\n").into_bytes()
}

/// Makes the folder, or sees that there is nothing in it but what will be
/// replaced: left-overs of another choice would be taken for part of this one.
fn prepare(folder: &Path, files: &[Content]) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|e| Failure::in_file(folder, e))?;
    let entries = std::fs::read_dir(folder).map_err(|e| Failure::in_file(folder, e))?;
    for entry in entries {
        let name = entry.map_err(|e| Failure::in_file(folder, e))?.file_name();
        if !files.iter().any(|(file, _)| name == file.as_str()) {
            return Err(Failure::in_file(
                folder,
                format_args!(
                    "holds {}, which is not a file of this export; choose an empty folder",
                    name.display()
                ),
            ));
        }
    }
    Ok(())
}

const FILES: &str = "\
Files, three for each solid and placement
  NAME.frustum.json   the frustum, as `frusta clip --frustum` reads it: origin o, axes a_k, and the
                      rectangles at both ends in the frame whose coordinates are a_k . (p - o)
  NAME.segments.csv   x0,y0,z0,x1,y1,z1; a sample a row
  NAME.expected.csv   what `frusta clip NAME.segments.csv --frustum NAME.frustum.json -o FILE.csv`
                      has to write, byte for byte; see `frusta clip --help` for the columns
  samples.json        once: all of it as one array: names, labels, numbers also in hexadecimal,
                      reasons
Decimals are the shortest that read back to the same f64. Every number of the inputs and of the
answers is exact, so a program that is right gives these parameters, points and sets and no others.

A folder that holds anything else is refused; files of an earlier export are replaced.

Examples
  frusta samples export samples
      8 solids in 3 places: 24 frusta, 1,566 samples
  frusta samples export samples --solid symmetric --placement identity --near-misses
      the 78 samples and the 26 near misses
  frusta clip samples/spire-rotated.segments.csv --frustum samples/spire-rotated.frustum.json \\
      -o found.csv && cmp found.csv samples/spire-rotated.expected.csv

Exit codes:
  0  done
  2  wrong usage, or a file that cannot be written; the other files may have been written";
