//! Other libraries' results, as their file has them: its headlines, the wrong answers
//! on the half-lattice, inputs that end badly, then all of its rows.
//!
//! The file may come from anywhere: its contents are shown as text; what is missing is left out,
//! and values of an unexpected kind are shown as they are.

use super::tables::sortable;
use super::words::{count, figure};
use maud::{Markup, html};
use serde_json::Value;
use std::collections::BTreeMap;

/// The input whose wrong answers are shown first.
const LATTICE: &str = "half-lattice";

/// The columns of the half-lattice's wrong answers; functions that are alike share a row.
const COUNTS: [&str; 10] = [
    "job",
    "library",
    "functions",
    "scalar",
    "cases",
    "phantom",
    "missed",
    "misplaced",
    "outside",
    "refused",
];

/// The columns of a job's rows: wrong answers before times, so that they are seen.
const ROWS: [&str; 20] = [
    "library",
    "version",
    "function",
    "scalar",
    "input",
    "cases",
    "wrong",
    "phantom",
    "missed",
    "misplaced",
    "outside",
    "refused",
    "ns_median",
    "time_ratio",
    "time_ratio_slices",
    "time_ratio_boxes",
    "time_ratio_f32",
    "time_ratio_slices_f32",
    "max_error_u_scale",
    "note",
];

/// Columns that should be zero.
const FAULTS: [&str; 5] = ["wrong", "phantom", "missed", "misplaced", "refused"];

/// The columns of single inputs that end badly.
const FACTS: [&str; 6] = ["library", "version", "what", "input", "result", "ours"];

/// The columns of headlines that are shown as a list.
const HEADLINES: [&str; 3] = ["what", "ratio", "least"];

/// Separates, in a headline, a peer from what it is compared with.
const OVER: &str = " / ";

/// With more columns than these, headlines are shown as a list.
const MOST_COLUMNS: usize = 8;

/// Longer texts are broken into lines.
const LONGEST_LINE: usize = 32;

/// The section; without a file, how to get one.
pub(super) fn section(peers: Option<&Value>) -> Markup {
    html! {
        h2 #peers { "Other libraries" }
        @match peers.and_then(|peers| Some((peers, rows(peers)?))) {
            Some((peers, rows)) => { (results(peers, rows)) }
            None => {
                p {
                    "This report has no results of them. They are measured in a workspace of their own, \
                     so that no build of frusta depends on them, and shown here if their file is given:"
                }
                pre {
                    "cargo run --release --manifest-path benches/peers/Cargo.toml -- --out peers.json\n"
                    "frusta report --peers peers.json"
                }
            }
        }
    }
}

/// The file's rows, if any of them can be shown.
pub(super) fn rows(peers: &Value) -> Option<&[Value]> {
    let rows = peers.get("rows")?.as_array()?;
    let known = |key: &&str| rows.iter().any(|row| !row[*key].is_null());
    (ROWS.iter().any(known) || known(&"job")).then_some(rows)
}

fn results(peers: &Value, rows: &[Value]) -> Markup {
    html! {
        p {
            "Other crates at the same jobs on the same inputs, their answers compared with the same \
             rational arithmetic. A library that promises less is not wrong by its own measure; its \
             notes say what it promises."
        }
        @if let Some(table) = headlines(peers) {
            h3 { "Run times" }
            (table)
            p.soft {
                "Their time as a multiple of exact-class V/W's, or of the function of frusta that heads the \
                 column: the geometric mean over the everyday mixes and, in brackets, the least. Above 1 is \
                 slower than frusta. " (measured(peers))
            }
        }
        @if let Some(table) = lattice(rows) {
            h3 { "Wrong answers on the half-lattice" }
            p {
                "Ends on half-integer points around small integer sets, where most cases touch something \
                 and every coordinate is exact in f32. Phantom: a hit where there is nothing. Missed: the \
                 opposite. Misplaced: an end in a wrong place. Outside: an end that is not in the set by a \
                 rounding, which is not called wrong."
            }
            (table)
        }
        @if let Some(table) = list(peers, "facts", &FACTS) {
            h3 { "Inputs that end badly" }
            (table)
        }
        h3 { "All of it, job by job" }
        p.soft {
            "Ratios are to exact-class V/W in f64, one segment a call; slices, f32: to the same over \
             slices, in f32. For boxes: to one call of Culler::classify a box; slices: to the list of a \
             set; plain slice: to the list of a plain slice. Larger is slower; a dash stands for no value."
        }
        @for (job, rows) in grouped(rows.iter().map(|row| (text(&row["job"]), row))) {
            details {
                summary { b { (job) } " " span.soft { "rows: " (rows.len()) } }
                @if let Some(table) = table(&rows, &ROWS) { (table) }
            }
        }
        @if let Some(Value::String(bias)) = peers.get("bias") {
            h3 { "What is unfair about it" }
            p { (bias) }
        }
    }
}

/// On what the times were taken, and how often.
fn measured(peers: &Value) -> Markup {
    let machine = ["cpu", "os", "arch", "rustc"].map(|key| &peers["machine"][key]);
    let machine: Vec<String> = machine
        .into_iter()
        .filter(|v| !v.is_null())
        .map(text)
        .collect();
    html! {
        @if !machine.is_empty() { "Measured on: " (machine.join(", ")) ". " }
        @if let Some(rounds) = peers["rounds"].as_u64() { "Medians over " (count(rounds)) " rounds." }
    }
}

/// The headlines, `PEER / WHOM`: a row a peer, a column what it is compared with.
fn headlines(peers: &Value) -> Option<Markup> {
    let all = peers.get("headlines")?.as_array()?;
    let split = all.iter().map(|line| {
        let (peer, whom) = line["what"].as_str()?.rsplit_once(OVER)?;
        Some((peer, (whom, line)))
    });
    let Some(split) = split.collect::<Option<Vec<_>>>() else {
        return list(peers, "headlines", &HEADLINES);
    };
    let columns = grouped(split.iter().map(|(_, (whom, _))| (*whom, ())));
    if columns.is_empty() || columns.len() > MOST_COLUMNS {
        return list(peers, "headlines", &HEADLINES);
    }
    let mut heads = vec![("", "t")];
    heads.extend(columns.iter().map(|(whom, _)| (*whom, "")));
    let body = html! {
        @for (peer, lines) in grouped(split.into_iter()) {
            tr {
                td.t { (peer) }
                @for (whom, _) in &columns {
                    (ratio(lines.iter().find(|(to, _)| to == whom).map(|(_, line)| *line)))
                }
            }
        }
    };
    Some(sortable(&heads, &body))
}

/// A headline's numbers.
fn ratio(line: Option<&Value>) -> Markup {
    let numbers = line.and_then(|line| Some((line["ratio"].as_f64()?, line["least"].as_f64()?)));
    html! {
        @match numbers {
            Some((ratio, least)) => {
                td data-v=(ratio) { (figure(ratio)) span.soft { " (" (figure(least)) ")" } }
            }
            None => { td { "-" } }
        }
    }
}

/// What was counted on the half-lattice. Functions of one library that were wrong as
/// often in each way share a row.
fn lattice(rows: &[Value]) -> Option<Markup> {
    let judged = |row: &&Value| row["input"] == LATTICE && !row["cases"].is_null();
    let kinds = grouped(rows.iter().filter(judged).map(|row| {
        let kind = COUNTS.map(|key| row[key].to_string());
        (kind, row)
    }));
    let merged = kinds.iter().map(|(_, alike)| {
        let functions: Vec<String> = alike.iter().map(|row| text(&row["function"])).collect();
        let mut row = alike[0].clone();
        row["functions"] = functions.join("; ").into();
        row
    });
    let merged: Vec<Value> = merged.collect();
    table(&merged.iter().collect::<Vec<_>>(), &COUNTS)
}

/// Things with the same key together, in the order in which the keys first come.
fn grouped<K: Ord + Clone, V>(all: impl Iterator<Item = (K, V)>) -> Vec<(K, Vec<V>)> {
    let mut places = BTreeMap::new();
    let mut groups: Vec<(K, Vec<V>)> = Vec::new();
    for (key, value) in all {
        let place = *places.entry(key.clone()).or_insert(groups.len());
        if place == groups.len() {
            groups.push((key, Vec::new()));
        }
        groups[place].1.push(value);
    }
    groups
}

/// One of the file's lists as a table.
fn list(peers: &Value, name: &str, columns: &[&str]) -> Option<Markup> {
    let all: Vec<&Value> = peers.get(name)?.as_array()?.iter().collect();
    table(&all, columns)
}

/// Objects as a table, without the columns that none of them has; `None` if that is
/// all of them.
fn table(rows: &[&Value], columns: &[&str]) -> Option<Markup> {
    let known = |key: &&&str| rows.iter().any(|row| !row[**key].is_null());
    let keys: Vec<&str> = columns.iter().filter(known).copied().collect();
    let class = |key| if is_text(key) { "t" } else { "" };
    let heads: Vec<(&str, &str)> = keys.iter().map(|key| (heading(key), class(key))).collect();
    let body = html! {
        @for row in rows { tr { @for key in &keys { (cell(key, &row[*key])) } } }
    };
    (!keys.is_empty()).then(|| sortable(&heads, &body))
}

/// What stands above a column.
fn heading(key: &str) -> &str {
    match key {
        "ns_median" => "ns",
        "time_ratio" => "ratio",
        "time_ratio_slices" => "slices",
        "time_ratio_boxes" => "plain slice",
        "time_ratio_f32" => "f32",
        "time_ratio_slices_f32" => "slices f32",
        "max_error_u_scale" => "max u·scale",
        "ours" => "frusta's answer",
        other => other,
    }
}

fn is_text(key: &str) -> bool {
    let words = ["job", "function", "functions", "scalar", "note"];
    FACTS.contains(&key) || words.contains(&key)
}

/// A cell, whatever the file has there.
fn cell(key: &str, value: &Value) -> Markup {
    match value {
        Value::Number(n) => {
            let number = n.as_f64().unwrap_or(0.0);
            let text = match n.as_u64() {
                Some(whole) => count(whole),
                None => figure(number),
            };
            let fault = FAULTS.contains(&key);
            html! { td.bad[fault && number > 0.0] data-v=(number) { (text) } }
        }
        Value::Null if !is_text(key) => html! { td { "-" } },
        other => {
            let text = text(other);
            // Notes are last in their rows, which are many: broken, they make all of them tall.
            let broken = key != "note" && text.chars().count() > LONGEST_LINE;
            let ours = key == "library" && text == "frusta";
            html! { td.t.w[broken].own[ours] { (text) } }
        }
    }
}

/// A text as it is, other things as JSON, a dash for nothing.
fn text(value: &Value) -> String {
    match value {
        Value::Null => "-".to_owned(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
