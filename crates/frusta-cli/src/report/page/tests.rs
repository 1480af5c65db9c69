//! The page and the panels: well-formed, complete, and safe against the contents of files.

use super::*;
use crate::report::machine::Machine;
use crate::report::omitted::{Omission, omissions};
use crate::report::{Measured, answer};
use frusta::samples::{Family, Mix};
use frusta_lab::{
    Spread, SurveyAlgorithm, SurveyOptions, SurveyTier, Tier, VolumePlan, everyday, paper_table,
    survey, volumes,
};
use resvg::usvg::roxmltree::{Document, Node};
use serde_json::{Value, json};
use std::sync::LazyLock;

/// A small report, measured once.
fn measured() -> Measured {
    static MEASURED: LazyLock<Measured> = LazyLock::new(measure);
    MEASURED.clone()
}

fn measure() -> Measured {
    let options = SurveyOptions {
        cases: 24,
        rounds: 1,
        timed: 4,
        ..SurveyOptions::default()
    };
    let plan = VolumePlan {
        families: vec![Family::Random],
        cases: 20,
        seed: 1,
        threads: 1,
        boxes: 300,
        timed: 300,
        rounds: 1,
    };
    Measured {
        survey: survey(&options, &|_, _| {}),
        everyday: everyday(300, 1, || {}),
        volumes: volumes(&plan, &|_, _| {}),
        paper: paper_table(1, || {}),
    }
}

/// The page's text.
fn page(measured: &Measured, peers: Option<&Value>, omitted: &[Omission]) -> String {
    let page = Page {
        measured,
        machine: &Machine::this(),
        peers,
        command: "frusta report <&>",
        seconds: 1.0,
        omitted,
    };
    text::page(&page).unwrap()
}

/// The page as XML, which it is but for elements without an end.
fn closed(html: &str) -> String {
    let mut xml = html.replacen("<!DOCTYPE html>", "", 1);
    for void in ["<meta ", "<link ", "<img ", "<source "] {
        let mut pieces = xml.split(void);
        let mut out = pieces.next().unwrap().to_owned();
        for piece in pieces {
            out += void;
            out += &piece.replacen('>', "/>", 1);
        }
        xml = out;
    }
    xml
}

/// All numbers of a picture are finite.
fn assert_finite(document: &Document<'_>, name: &str) {
    for node in document.descendants().filter(Node::is_element) {
        if ![
            "path", "line", "circle", "rect", "text", "polygon", "svg", "g",
        ]
        .contains(&node.tag_name().name())
        {
            continue;
        }
        // A label is text: a family is named "infinite".
        for attribute in node.attributes().filter(|a| a.name() != "aria-label") {
            let value = attribute.value();
            assert!(
                !value.contains("NaN") && !value.contains("inf"),
                "{name}: {value}"
            );
        }
    }
}

#[test]
fn the_page_is_whole_and_well_formed() {
    let measured = measured();
    let html = page(&measured, None, &omissions(&measured.survey, false));
    let xml = closed(&html);
    let document = Document::parse(&xml).unwrap();
    assert_finite(&document, "report.html");
    let ids: Vec<&str> = document
        .descendants()
        .filter_map(|n| n.attribute("id"))
        .collect();
    for family in Family::ALL {
        assert!(ids.contains(&family.name()), "{family}");
    }
    // Every link leads somewhere on the page, and nothing is fetched.
    for node in document.descendants().filter(Node::is_element) {
        for key in ["href", "src", "srcset"] {
            let Some(link) = node.attribute(key) else {
                continue;
            };
            let here = link.strip_prefix('#').is_some_and(|id| ids.contains(&id));
            assert!(here || link.starts_with("data:"), "{link}");
        }
    }
    assert!(html.contains("frusta report &lt;&amp;&gt;"));
    assert!(html.contains("--manifest-path benches/peers/Cargo.toml"));
    let images = document.descendants().filter(|n| n.has_tag_name("img"));
    assert!(images.count() >= 6);
    assert!(html.len() < 3_000_000, "{}", html.len());
}

#[test]
fn contents_of_other_files_are_escaped() {
    let measured = measured();
    let omitted = [Omission {
        what: "<b>".to_owned(),
        why: "\"&\"".to_owned(),
    }];
    let evil = "<script>alert(1)</script>";
    let peers = json!({
        "rows": [
            {"job": evil, "library": "a&b", "note": "\"<i>", "ns_median": 1.5, "wrong": 3, "cases": 10},
            {"job": ["x"], "library": null, "ns_median": -1e300},
            {"time_ratio_slices": 2.5, "misplaced": 7},
            {"input": "half-lattice", "cases": evil, "function": [evil], "scalar": {"<u>": 1}},
            [evil], 3, null,
        ],
        "headlines": [{"what": "<x> / <y>", "ratio": evil}, {"what": "<z> / <y>", "ratio": 1, "least": 1}],
        "facts": [{"what": evil, "ours": [evil]}],
        "machine": {"cpu": "<cpu>"},
        "bias": "<q>",
    });
    let html = page(&measured, Some(&peers), &omitted);
    assert!(!html.contains(evil) && html.contains("&lt;script&gt;alert"));
    assert!(html.contains("a&amp;b") && html.contains("<b>&lt;b&gt;</b>"));
    assert!(html.contains("&lt;cpu&gt;") && html.contains("<p>&lt;q&gt;</p>"));
    assert!(!html.contains("has no results of them"));
    // Columns that only this row has; what is null or absent is a dash.
    assert!(html.contains(">slices<") && html.contains(">misplaced<"));
    assert!(html.contains("<td class=\"bad\" data-v=\"7\">7</td>"));
    assert!(html.contains("<td>-</td>") && html.contains("<td class=\"t\">-</td>"));
    Document::parse(&closed(&html)).unwrap();
    for nothing in [
        json!({}),
        json!({"rows": []}),
        json!([1]),
        json!({"rows": "x"}),
        json!({"rows": [1, [2]], "bias": "x"}),
    ] {
        let html = page(&measured, Some(&nothing), &[]);
        assert!(html.contains("has no results of them"), "{nothing}");
    }
}

/// The text of all elements of a name, piece by piece.
fn texts(html: &str, name: &str) -> Vec<Vec<String>> {
    let xml = closed(html);
    let document = Document::parse(&xml).unwrap();
    let all = document.descendants().filter(|n| n.has_tag_name(name));
    let pieces = |n: Node<'_, '_>| -> Vec<String> {
        let texts = n.descendants().filter(Node::is_text);
        let texts = texts.filter_map(|n| n.text()).map(str::trim);
        texts.filter(|t| !t.is_empty()).map(str::to_owned).collect()
    };
    all.map(pieces).collect()
}

/// Results of two libraries and ours.
fn peers() -> Value {
    let row = |job: &str, library: &str, function: &str, input: &str, missed: u64| {
        json!({
            "job": job, "library": library, "function": function, "input": input, "cases": 9,
            "phantom": 0, "missed": missed, "refused": 0, "ns_median": 4.5, "time_ratio": 2.0,
        })
    };
    let mut unjudged = row("box", "other", "times only", "half-lattice", 0);
    unjudged["cases"] = Value::Null;
    json!({
        "headlines": [
            {"what": "box: other / ours, f64", "ratio": 2.5, "least": 1.25},
            {"what": "box: other / ours, f32", "ratio": 3.5, "least": 0.5},
            {"what": "quad: third / ours, f64", "ratio": 4.5, "least": 4.25},
        ],
        "rows": [
            row("box", "frusta", "exact", "half-lattice", 0),
            row("box", "frusta", "exact, slices", "half-lattice", 0),
            row("box", "other", "clip", "half-lattice", 7),
            unjudged,
            row("box", "other", "clip", "uniform", 0),
            row("quad", "third", "clip", "half-lattice", 0),
        ],
        "facts": [{"library": "other", "result": "panics"}],
        "bias": "we chose",
    })
}

#[test]
fn other_libraries_wrong_answers_come_first() {
    let html = page(&measured(), Some(&peers()), &[]);
    let html = &html[html.find("id=\"peers\"").unwrap()..html.find("id=\"bias\"").unwrap()];
    let places = [
        "ours, f64",
        "exact; exact, slices",
        "panics",
        "<details>",
        "we chose",
    ];
    let places = places.map(|text| html.find(text).expect(text));
    assert!(places.is_sorted(), "{places:?}");
    let html = format!("<div><h2 {html}></h2></div>");
    let rows: Vec<String> = texts(&html, "tr").iter().map(|r| r.join("|")).collect();
    assert_eq!(
        rows[..3],
        [
            "ours, f64|ours, f32",
            "box: other|2.50|(1.25)|3.50|(0.50)",
            "quad: third|4.50|(4.25)|-",
        ]
    );
    assert_eq!(
        rows[3..7],
        [
            "job|library|functions|cases|phantom|missed|refused",
            "box|frusta|exact; exact, slices|9|0|0|0",
            "box|other|clip|9|0|7|0",
            "quad|third|clip|9|0|0|0",
        ]
    );
    // Then the fact and its heading, and a fold a job.
    assert_eq!(
        rows[9],
        "library|function|input|cases|phantom|missed|refused|ns|ratio"
    );
    assert_eq!(rows.len(), 9 + (1 + 5) + (1 + 1));
    let folds = texts(&html, "summary");
    assert_eq!(folds, [["box", "rows: 5"], ["quad", "rows: 1"]]);
}

#[test]
fn headlines_that_are_no_table_are_a_list() {
    let with = |whats: Vec<String>| {
        let lines = whats
            .iter()
            .map(|what| json!({"what": what, "ratio": 1.5, "least": 1}));
        let peers = json!({"headlines": lines.collect::<Vec<_>>(), "rows": [{"library": "x"}]});
        page(&measured(), Some(&peers), &[])
    };
    let many = (0..50).map(|i| format!("who / {i}")).collect();
    for html in [with(vec!["who / one".into(), "other".into()]), with(many)] {
        assert!(html.contains(">least</th>") && html.contains(">who / "));
    }
    assert!(!with(vec!["who / one".into()]).contains(">least</th>"));
}

#[test]
fn everyday_segments_show_wrong_answers_and_what_flatters() {
    let mut measured = measured();
    for row in &mut measured.everyday.rows {
        let exact = row.algorithm == "vw" && row.tier == Tier::Exact;
        row.timing.ratio = Spread::new(vec![match (exact, row.slices) {
            (true, false) => 0.5,
            (true, true) => 0.25,
            _ => 1.0,
        }]);
    }
    let html = page(&measured, None, &[]);
    let sentence = "takes 0.50 times [0.50 to 0.50] the time of textbook Liang-Barsky in plain f64 with \
                    one call a segment, and 0.25 times [0.25 to 0.25] over slices";
    assert!(html.contains(sentence));
    assert!(html.contains("wrong, exact arithmetic <b>0</b>") && html.contains("flatter clippers"));
    let rows = texts(&html, "tr");
    let mean = rows.iter().find(|r| r[0] == "geometric mean").unwrap();
    let speeds: Vec<&String> = mean[1..].iter().step_by(2).collect();
    assert_eq!(speeds, ["1.00", "1.00", "2.00", "1.00", "1.00", "4.00"]);
    assert_eq!(mean[6], "[2.00 to 2.00]");
    for mix in Mix::ALL {
        let of_mix = |r: &&Vec<String>| r.get(1).is_some_and(|name| name == mix.name());
        assert_eq!(rows.iter().filter(of_mix).count(), 2, "{mix}");
    }
    measured.everyday.segments = 1_000_000;
    measured
        .everyday
        .rows
        .iter_mut()
        .for_each(|row| row.wrong = 2);
    let html = page(&measured, None, &[]);
    assert!(
        html.contains("wrong, exact arithmetic <b>32</b>") && !html.contains("flatter clippers")
    );
}

#[test]
fn panels_are_files_of_their_own() {
    let measured = measured();
    let page = Page {
        measured: &measured,
        machine: &Machine::this(),
        peers: None,
        command: "",
        seconds: 0.0,
        omitted: &[],
    };
    for family in Family::ALL {
        let svg = panel(&page, *family);
        let document = Document::parse(&svg).unwrap();
        assert_finite(&document, family.name());
        let marks = document.descendants().filter(|n| {
            let class = n.attribute("class").unwrap_or("");
            class.ends_with(" m") || class.ends_with(" h")
        });
        // Each row has a mark at least, the key eleven more: six algorithms, four colours, hollow.
        let rows = measured.survey.rows.iter();
        let rows = rows.filter(|row| row.family == *family);
        assert!(marks.count() >= rows.count() + 11, "{family}");
    }
}

#[test]
fn extreme_rows_have_finite_places() {
    let mut measured = measured();
    let values = [
        0.0,
        5e-324,
        1e-300,
        1e308,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ];
    for (i, row) in measured.survey.rows.iter_mut().enumerate() {
        row.error_u_scale.max = values[i % 7];
        row.time_ratio = Spread {
            lower: values[i % 7],
            median: values[i / 7 % 7],
            upper: values[i % 5],
        };
        row.ns_median = values[i / 49 % 7];
        row.wrong_class = [0, 1, row.cases][i % 3];
    }
    for (i, row) in measured.everyday.rows.iter_mut().enumerate() {
        row.timing.ratio = Spread::new(vec![values[i % 7]]);
        row.timing.nanoseconds = values[i / 7 % 7];
    }
    let html = page(&measured, None, &[]);
    assert_finite(&Document::parse(&closed(&html)).unwrap(), "report.html");
    measured.survey.rows.clear();
    measured.survey.witnesses.clear();
    let html = page(&measured, None, &[]);
    assert!(html.contains("There are none."));
    Document::parse(&closed(&html)).unwrap();
}

#[test]
fn sums_are_sums() {
    let Measured { survey, .. } = measured();
    let total =
        totals::Total::of_clipper(&survey, SurveyAlgorithm::SixPlanes, SurveyTier::PlainF64);
    assert_eq!(total.cases, 24 * Family::ALL.len() as u64);
    let wrong = survey
        .rows
        .iter()
        .filter(|r| r.algorithm == SurveyAlgorithm::SixPlanes && r.tier == SurveyTier::PlainF64);
    assert_eq!(total.wrong_class, wrong.map(|r| r.wrong_class).sum::<u64>());
    assert!(total.wrong_class > 0 && total.share(total.wrong_class) < 1.0);
    let exact = totals::Total::of(&survey, |row| row.tier.is_exact());
    assert_eq!(exact.wrong(), 0);
    let chosen = worst::choose(&survey);
    assert!((6..=20).contains(&chosen.len()), "{}", chosen.len());
}

#[test]
fn the_chart_comes_first_then_the_answer_the_papers_table_and_the_panels() {
    let measured = measured();
    let html = page(&measured, None, &[]);
    let places = [
        "id=\"chart\"",
        "id=\"answer\"",
        "id=\"paper\"",
        "id=\"panels\"",
    ];
    let places = places.map(|id| html.find(id).expect(id));
    assert!(places.is_sorted(), "{places:?}");
    let chart = &html[places[0]..places[1]];
    for part in [
        "nanoseconds a segment (logarithmic",
        "largest error of the others, u·scale",
        "wrong answers",
        "Colour: arithmetic",
        "Shape: algorithm",
        "unit roundoff",
        "projection reduction",
    ] {
        assert!(chart.contains(part), "{part:?} is not at the first chart");
    }
    for sentence in answer::sentences(&measured) {
        assert!(html[places[1]..places[2]].contains(&sentence), "{sentence}");
    }
    assert!(html[places[2]..places[3]].contains("78 singular samples"));
}

#[test]
fn noisy_ratios_are_marked_and_take_no_part_in_the_answer() {
    let mut measured = measured();
    let quiet = Spread::new(vec![2.0]);
    let noisy = Spread::new(vec![1.0, 7.0, 50.0]);
    let mut families = std::collections::BTreeSet::new();
    for row in &mut measured.survey.rows {
        families.insert(row.family.name());
        row.time_ratio = if families.len() < 9 { noisy } else { quiet };
    }
    for (i, row) in measured.everyday.rows.iter_mut().enumerate() {
        row.timing.ratio = if i < 28 { noisy } else { quiet };
    }
    let [_, everyday, hard] = answer::sentences(&measured);
    assert!(
        everyday.matches("2.00 times [2.00 to 2.00]").count() == 2,
        "{everyday}"
    );
    assert!(
        hard.contains(
            "takes 2.00 times [2.00 to 2.00] (8 of 40 ratios are noisy and left out) the time"
        ),
        "{hard}"
    );
    assert!(hard.ends_with(", 1.00 times that of the same algorithm in plain arithmetic."));
    let html = page(&measured, None, &[]);
    assert!(
        html.contains("~7.00 ") && html.contains("[4.00 to 28.5]") && !everyday.contains("28.5")
    );
    measured
        .survey
        .rows
        .iter_mut()
        .for_each(|row| row.time_ratio = noisy);
    measured
        .everyday
        .rows
        .iter_mut()
        .for_each(|row| row.timing.ratio = noisy);
    let [_, everyday, hard] = answer::sentences(&measured);
    assert!(everyday.contains("too noisy") && hard.contains("too noisy"));
}
