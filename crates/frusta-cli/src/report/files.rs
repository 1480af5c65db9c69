//! A report's folder.
//!
//! Its files are created before anything is measured, so that a folder that cannot be written is
//! reported at once. They get their names when all of them are complete.

use super::data::{Report, Witness};
use super::{Page, page, text};
use crate::failure::Failure;
use crate::io::atomic_file::AtomicFile;
use frusta::samples::Family;
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The files of a report, begun.
pub(crate) struct Folder {
    folder: PathBuf,
    json: AtomicFile,
    rows: AtomicFile,
    witnesses: AtomicFile,
    lines: AtomicFile,
    html: AtomicFile,
    tables: AtomicFile,
    panels: Vec<(Family, AtomicFile)>,
}

impl Folder {
    /// Makes the folder if it does not exist, and begins the files.
    pub(crate) fn begin(folder: &Path, families: &[Family]) -> Result<Self, Failure> {
        make(folder)?;
        let begin = |name| AtomicFile::create(&folder.join(name));
        let (json, rows) = (begin("report.json")?, begin("rows.csv")?);
        let (witnesses, lines) = (begin("witnesses.csv")?, begin("witnesses.txt")?);
        let (html, tables) = (begin("report.html")?, begin("tables.txt")?);
        let panels = folder.join("panels");
        make(&panels)?;
        let panel = |&family: &Family| {
            let file = AtomicFile::create(&panels.join(format!("{family}.svg")))?;
            Ok((family, file))
        };
        Ok(Self {
            folder: folder.to_owned(),
            json,
            rows,
            witnesses,
            lines,
            html,
            tables,
            panels: families.iter().map(panel).collect::<Result<_, _>>()?,
        })
    }

    /// Writes the files, then gives them their names.
    pub(crate) fn finish(mut self, page: &Page<'_>, report: &Report<'_>) -> Result<(), Failure> {
        self.json.write(report.to_json().as_bytes())?;
        self.rows.write(&self.csv("rows.csv", &report.rows)?)?;
        self.witnesses
            .write(&self.csv("witnesses.csv", &report.witnesses)?)?;
        self.lines.write(lines(&report.witnesses).as_bytes())?;
        self.tables.write(text::tables(page.measured).as_bytes())?;
        self.html.write(page::html(page)?.as_bytes())?;
        for (family, file) in &mut self.panels {
            file.write(page::panel(page, *family).as_bytes())?;
        }
        let data = [
            self.rows,
            self.witnesses,
            self.lines,
            self.tables,
            self.json,
        ];
        let panels = self.panels.into_iter().map(|(_, file)| file);
        let mut files = data.into_iter().chain(panels).chain([self.html]);
        files.try_for_each(AtomicFile::finish)
    }

    /// Records as CSV, their keys first.
    fn csv<T: Serialize>(&self, name: &str, records: &[T]) -> Result<Vec<u8>, Failure> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut written = records
            .iter()
            .try_for_each(|record| writer.serialize(record));
        if written.is_ok() {
            written = writer.flush().map_err(csv::Error::from);
        }
        let bytes = written.and_then(|()| writer.into_inner().map_err(|e| e.into_error().into()));
        bytes.map_err(|e| Failure::in_file(&self.folder.join(name), e))
    }
}

/// Makes a folder if it does not exist.
fn make(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|e| {
        let why = match e.kind() {
            ErrorKind::AlreadyExists => "it is a file".to_owned(),
            ErrorKind::NotADirectory => "it would be in a file".to_owned(),
            kind => kind.to_string(),
        };
        Failure::in_file(folder, format_args!("cannot be made a folder: {why}"))
    })
}

/// Every worst input once, under comments that name the rows that it is the worst of: a file for
/// `frusta replay`.
fn lines(witnesses: &[Witness<'_>]) -> String {
    // In the order of their first occurrence.
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    let mut inputs: Vec<(&Witness<'_>, BTreeMap<String, Vec<String>>)> = Vec::new();
    for witness in witnesses {
        let place = *places.entry(witness.line).or_insert_with(|| {
            inputs.push((witness, BTreeMap::new()));
            inputs.len() - 1
        });
        let Witness {
            algorithm,
            tier,
            worst,
            value,
            ..
        } = witness;
        // Counts are integers; errors may have 300 digits.
        let way = if *value < 1e9 {
            format!("{worst} {value}")
        } else {
            format!("{worst} {value:e}")
        };
        let names = inputs[place].1.entry(way).or_default();
        names.push(format!("{algorithm} {tier}"));
    }
    let mut text = String::from("# The worst inputs of a report: frusta replay FILE\n");
    for (witness, ways) in inputs {
        let Witness {
            family, case, line, ..
        } = witness;
        text += &format!("\n# {family}, case {case}\n");
        for (way, names) in ways {
            text += &format!("# {way}: {}\n", names.join(", "));
        }
        text += &format!("{line}\n");
    }
    text
}
