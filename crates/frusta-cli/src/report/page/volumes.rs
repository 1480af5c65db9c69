//! Boxes, spheres and batches.

use super::tables::ratio;
use super::words::{count, figure};
use frusta_lab::{FalseAccepts, VolumeKind, VolumeSurvey, VolumeTally, VolumeTime};
use maud::{Markup, html};

/// The section.
pub(super) fn section(volumes: &VolumeSurvey) -> Markup {
    let cases: u64 = volumes.errors.iter().map(|(_, tally)| tally.cases).sum();
    html! {
        h2 #volumes { "Boxes and spheres" }
        p {
            "A program asks of everything that it might draw: is it outside of the frustum, inside, or \
             neither? " (count(cases)) " hard volumes of the families, at least half of them within 4 ulp \
             of touching, were classified alone and in batches, and compared with integer arithmetic."
        }
        (errors(&volumes.errors))
        h3 { "False accepts of the faces" }
        p {
            "No single face rejects a box beyond an edge or a corner of the frustum; the exact test does. \
             The larger the boxes and the narrower the view, the more it rejects. Boxes along the axes, \
             with half extents up to a part of the far distance, placed evenly where one can touch the \
             frustum\'s bounding box; the camera is turned."
        }
        (accepts(&volumes.accepts))
        h3 { "Times" }
        (times(&volumes.times))
        p.soft {
            "All in f32, " (count(volumes.timed as u64)) " of each; batches of "
            (count(VolumeSurvey::PIECE as u64)) " a call. Medians over " (volumes.rounds)
            " rounds, in which all took turns. A set holds boxes that are kept from frame to frame. Segments \
             are the mixed ones; intervals are class and parameters, without points."
        }
    }
}

fn errors(rows: &[(VolumeKind, VolumeTally)]) -> Markup {
    html! {
        div.scroll { table {
            thead { tr {
                th.t {} th { "cases" } th { "wrong" } th { "wrongly outside" } th { "wrong in batches" }
                th { "exact test wrong" }
            } }
            tbody { @for (kind, tally) in rows { tr {
                td.t { (kind.name()) }
                td { (count(tally.cases)) }
                td { (count(tally.wrong)) }
                td { (count(tally.wrongly_outside)) }
                td { (count(tally.wrong_in_batch)) }
                td { (count(tally.wrong_exact)) }
            } } }
        } }
    }
}

fn accepts(rows: &[FalseAccepts]) -> Markup {
    html! {
        div.scroll { table {
            thead { tr {
                th { "half extent" } th { "view, radians" } th { "boxes" } th { "not rejected" }
                th { "of these, outside" } th { "share, %" }
            } }
            tbody { @for row in rows { tr {
                td { (row.size) }
                td { (row.field_of_view) }
                td { (count(row.boxes)) }
                td { (count(row.accepted)) }
                td { (count(row.falsely)) }
                td { (figure(100.0 * row.share())) }
            } } }
        } }
    }
}

fn times(rows: &[VolumeTime]) -> Markup {
    html! {
        div.scroll { table {
            thead { tr {
                th.t { "volume" } th.t { "function" } th { "ns" } th { "times as fast as the first" }
            } }
            tbody { @for row in rows { tr {
                td.t { (row.job) }
                td.t { (row.function) }
                td { (figure(row.timing.nanoseconds)) }
                (ratio(row.timing.speed().unwrap_or_default()))
            } } }
        } }
    }
}
