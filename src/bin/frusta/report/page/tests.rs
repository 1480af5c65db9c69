//! The page and the panels: well-formed, whole, and safe against what files say.

use super::*;
use crate::report::machine::Machine;
use crate::report::omitted::{Omission, omissions};
use frusta::report::{
    PaperTable, Survey, SurveyAlgorithm, SurveyOptions, SurveyTier, paper_table, survey,
};
use frusta::samples::Family;
use resvg::usvg::roxmltree::{Document, Node};
use serde_json::{Value, json};
use std::sync::LazyLock;

/// A small report, measured once.
fn measured() -> (Survey, PaperTable) {
    static MEASURED: LazyLock<(Survey, PaperTable)> = LazyLock::new(measure);
    MEASURED.clone()
}

fn measure() -> (Survey, PaperTable) {
    let options = SurveyOptions {
        cases: 24,
        rounds: 1,
        timed: 4,
        ..SurveyOptions::default()
    };
    (survey(&options, &|_| {}), paper_table(1, || {}))
}

/// The page's text.
fn page(
    survey: &Survey,
    paper: &PaperTable,
    peers: Option<&Value>,
    omitted: &[Omission],
) -> String {
    let page = Page {
        survey,
        paper,
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

/// No number of a picture is none.
fn assert_finite(document: &Document<'_>, name: &str) {
    for node in document.descendants().filter(Node::is_element) {
        if ![
            "path", "line", "circle", "rect", "text", "polygon", "svg", "g",
        ]
        .contains(&node.tag_name().name())
        {
            continue;
        }
        for attribute in node.attributes() {
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
    let (survey, paper) = measured();
    let html = page(&survey, &paper, None, &omissions(&survey, false));
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
fn what_others_say_is_escaped() {
    let (survey, paper) = measured();
    let omitted = [Omission {
        what: "<b>".to_owned(),
        why: "\"&\"".to_owned(),
    }];
    let evil = "<script>alert(1)</script>";
    let peers = json!({"rows": [
        {"job": evil, "library": "a&b", "note": "\"<i>", "ns_median": 1.5, "wrong": 3, "cases": 10},
        {"job": ["x"], "library": null, "ns_median": -1e300},
        {"time_ratio_slices": 2.5, "misplaced": 7},
    ]});
    let html = page(&survey, &paper, Some(&peers), &omitted);
    assert!(!html.contains(evil) && html.contains("&lt;script&gt;alert"));
    assert!(html.contains("a&amp;b") && html.contains("<b>&lt;b&gt;</b>"));
    assert!(!html.contains("has no results of them"));
    // Columns that only this row has; what is null or absent is a dash.
    assert!(html.contains(">time ratio slices<") && html.contains(">misplaced<"));
    assert!(html.contains("<td class=\"bad\" data-v=\"7\">7</td>"));
    assert!(html.contains("<td>-</td>") && html.contains("<td class=\"t\">-</td>"));
    Document::parse(&closed(&html)).unwrap();
    for nothing in [
        json!({}),
        json!({"rows": []}),
        json!([1]),
        json!({"rows": "x"}),
    ] {
        let html = page(&survey, &paper, Some(&nothing), &[]);
        assert!(html.contains("has no results of them"), "{nothing}");
    }
}

#[test]
fn panels_are_files_of_their_own() {
    let (survey, paper) = measured();
    let page = Page {
        survey: &survey,
        paper: &paper,
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
        // Each row has a mark at least, the key twelve more.
        let rows = survey.rows.iter().filter(|row| row.family == *family);
        assert!(marks.count() >= rows.count() + 12, "{family}");
    }
}

#[test]
fn extreme_rows_have_finite_places() {
    let (mut survey, paper) = measured();
    let values = [
        0.0,
        5e-324,
        1e-300,
        1e308,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ];
    for (i, row) in survey.rows.iter_mut().enumerate() {
        row.error_u_scale.max = values[i % 7];
        row.time_ratio = values[i / 7 % 7];
        row.ns_median = values[i / 49 % 7];
        row.wrong_class = [0, 1, row.cases][i % 3];
    }
    let html = page(&survey, &paper, None, &[]);
    assert_finite(&Document::parse(&closed(&html)).unwrap(), "report.html");
    survey.rows.clear();
    survey.witnesses.clear();
    let html = page(&survey, &paper, None, &[]);
    assert!(html.contains("There are none."));
    Document::parse(&closed(&html)).unwrap();
}

#[test]
fn sums_are_sums() {
    let (survey, _) = measured();
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
