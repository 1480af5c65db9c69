//! Where right and wrong answers differ, if that is too small for the whole picture.

use super::exact::{Exact, Point, distance, exact, in_frame};
use super::scene::{Scene, points, step_at};
use crate::replay::answers::Replay;
use num_traits::{Signed, Zero};

/// A place to look at closely.
pub(super) struct Spot {
    pub(super) centre: Point,
    /// Half of the window's size.
    pub(super) half: Exact,
    /// Its name.
    pub(super) name: &'static str,
}

/// The spot, where there is one: the exact end that answers are farthest from without
/// being visibly far; else where an answer puts a segment inside that is outside; else
/// a clipped end and its neighbours.
pub(super) fn find(replay: &Replay, scene: &Scene) -> Option<Spot> {
    let visible = size(scene) / exact(50.0);
    let all = replay.answers.iter().filter_map(|a| points(replay, a));
    let all: Vec<[Point; 2]> = all.collect();
    let Some(part) = &replay.truth.part else {
        return claimed(scene, &all);
    };
    let pose = replay.case.frustum.pose();
    let ends = [&part.entry, &part.exit].map(|e| in_frame(pose, &e.point));
    let names = ["where it enters", "where it leaves"];
    let mut best: Option<(Exact, usize)> = None;
    for (i, end) in ends.iter().enumerate() {
        let offs = all.iter().map(|p| distance(&p[i], end));
        let off = offs
            .filter(|d| *d < visible)
            .max()
            .unwrap_or_else(Exact::zero);
        let clipped = [part.entry.clipped, part.exit.clipped][i];
        let better = best.as_ref().is_none_or(|(known, _)| off > *known);
        if (clipped || off.is_positive()) && better {
            best = Some((off, i));
        }
    }
    let (off, i) = best?;
    let half = (off * exact(1.6)).max(step_at(&ends[i]) * exact(4.0));
    Some(Spot {
        centre: ends[i].clone(),
        half,
        name: names[i],
    })
}

/// Where an answer puts a segment inside that is outside.
fn claimed(scene: &Scene, all: &[[Point; 2]]) -> Option<Spot> {
    let [first, _] = all.first()?;
    let (near, far) = (&scene.rims[0], &scene.rims[1]);
    let depth = &far.z - &near.z;
    let share = (&first[2] - &near.z) / &depth;
    let mut off = Exact::zero();
    for k in 0..4 {
        let side = &near.sides[k] + &share * (&far.sides[k] - &near.sides[k]);
        let beyond = if k % 2 == 0 {
            side - &first[k / 2]
        } else {
            &first[k / 2] - side
        };
        off = off.max(beyond);
    }
    let spread = all.iter().flatten().map(|p| distance(p, first));
    let spread = spread.filter(|d| *d < size(scene) / exact(50.0)).max();
    off = off.max(spread.unwrap_or_else(Exact::zero));
    (off < size(scene)).then(|| Spot {
        centre: first.clone(),
        half: (off * exact(1.6)).max(step_at(first) * exact(4.0)),
        name: "where an answer is inside",
    })
}

/// The frustum's largest extent.
fn size(scene: &Scene) -> Exact {
    let [near, far] = &scene.rims;
    let mut size = (&far.z - &near.z).abs();
    for rim in [near, far] {
        let [left, right, bottom, top] = &rim.sides;
        size = size.max(right - left).max(top - bottom);
    }
    size
}
