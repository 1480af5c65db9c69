//! A sample somewhere in the world, and its answer as a clipper would give it.
//!
//! A sample's expectation has parameters and faces; the points follow, exactly:
//! `p + t (q - p)` of dyadic numbers is dyadic. It is computed with rationals,
//! and checked to be an `f64`.

use super::labels;
use crate::draw::Subject;
use crate::failure::Failure;
use crate::io::number::short;
use frusta::math::hex;
use frusta::oracle::round_nearest;
use frusta::samples::{ExpectedPart, FrameSample, Placement, Solid};
use frusta::{FaceSet, Frustum, Part, PartEnd, Segment, SegmentClip, Vec3};
use num_rational::BigRational;
use serde_json::{Value, json};

/// A sample in a pose.
pub(super) struct Case {
    pub(super) sample: FrameSample,
    pub(super) segment: Segment<f64>,
    pub(super) expected: SegmentClip<f64>,
}

impl Case {
    /// Puts a sample in its place.
    pub(super) fn new(sample: FrameSample, placement: &Placement) -> Result<Self, Failure> {
        let segment = placement.segment(&sample.segment);
        let part = match &sample.expected.part {
            Some(part) => Some(exact_part(&segment, part).ok_or_else(|| {
                Failure::new(format_args!("{}: no f64 equals its answer", sample.name()))
            })?),
            None => None,
        };
        let class = sample.expected.class;
        Ok(Self {
            sample,
            segment,
            expected: SegmentClip { class, part },
        })
    }

    /// The subject of its drawing.
    pub(super) fn subject<'a>(&'a self, solid: &'a Solid) -> Subject<'a> {
        Subject {
            solid,
            feature: Some(self.sample.feature),
            segment: self.segment,
            clip: &self.expected,
            shown: [0.0, 1.0],
        }
    }

    /// Everything about it, in one flat object.
    pub(super) fn to_json(&self, solid: &Solid, placement: &str, frustum: &Frustum) -> Value {
        let (sample, expected) = (&self.sample, &self.expected);
        let part = expected.part.as_ref();
        let ends = part.map(|p| [&p.entry, &p.exit]);
        let each =
            |of: fn(&PartEnd<f64>) -> Value| ends.map(|ends| Value::from(ends.map(of).to_vec()));
        let segment = [self.segment.start, self.segment.end].map(Vec3::to_array);
        let [enter, leave, coplanar] = sets(part);
        json!({
            "name": sample.name(),
            "solid": solid.name,
            "placement": placement,
            "feature": sample.feature.to_string(),
            "kind": sample.feature.kind().name(),
            "relation": sample.relation.name(),
            "intersections": labels::intersections(sample),
            "direction": labels::direction(sample),
            "position": sample.labels.position.name(),
            "frustum": frustum,
            "segment": segment,
            "segment_hex": segment.map(|p| p.map(hex::format)),
            "class": expected.class.name(),
            "t": each(|end| end.t.into()),
            "points": each(|end| json!(end.point.to_array())),
            "points_hex": each(|end| json!(end.point.to_array().map(hex::format))),
            "clipped": each(|end| end.clipped.into()),
            "enter": names(enter),
            "leave": names(leave),
            "coplanar": names(coplanar),
            "reason": sample.reason,
        })
    }
}

/// The entry, exit and coplanar set.
pub(super) fn sets(part: Option<&Part<f64>>) -> [FaceSet; 3] {
    part.map_or([FaceSet::EMPTY; 3], |p| {
        [p.entry.faces, p.exit.faces, p.coplanar]
    })
}

fn names(set: FaceSet) -> Vec<&'static str> {
    set.iter().map(|face| face.name()).collect()
}

/// A point for people.
pub(super) fn point(p: Vec3<f64>) -> String {
    p.to_array().map(short).join(" ")
}

fn exact_part(segment: &Segment<f64>, part: &ExpectedPart) -> Option<Part<f64>> {
    let end = |i: usize| {
        let (t, clipped) = (part.t[i], part.clipped[i]);
        let point = if clipped {
            exact_point(segment, t)?
        } else {
            [segment.start, segment.end][i]
        };
        Some(PartEnd {
            t,
            point,
            clipped,
            faces: part.faces[i],
            inward: !clipped,
        })
    };
    Some(Part {
        entry: end(0)?,
        exit: end(1)?,
        coplanar: part.coplanar,
    })
}

/// `p + t (q - p)`; `None` if a coordinate is not an `f64`.
fn exact_point(segment: &Segment<f64>, t: f64) -> Option<Vec3<f64>> {
    let t = BigRational::from_float(t)?;
    let mut point = Vec3::default();
    for k in 0..3 {
        let p = BigRational::from_float(segment.start[k])?;
        let q = BigRational::from_float(segment.end[k])?;
        let exact = &p + &t * (q - &p);
        point[k] = round_nearest(&exact);
        if BigRational::from_float(point[k]) != Some(exact) {
            return None;
        }
    }
    Some(point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use frusta::Accuracy;
    use frusta::clip::{SegmentClipper, VwProjection};
    use frusta::samples::singular_samples;

    #[test]
    fn points_are_exact_or_refused() {
        let segment = Segment::new([0.0, -1.0, 4.0], [1.0, 3.0, 4.0]);
        let found = exact_point(&segment, 0.25);
        assert_eq!(found, Some(Vec3::new(0.25, 0.0, 4.0)));
        let fine = Segment::new([1.0, 0.0, 0.0], [1.0_f64.next_up(), 0.0, 0.0]);
        assert_eq!(exact_point(&fine, 0.5), None);
    }

    #[test]
    fn every_expectation_is_what_nearest_gives() {
        let placement = Placement::rotated([1, -2, 2, 4]).moved_to([7.0, -3.0, 5.0].into());
        for solid in Solid::ALL {
            let frustum = placement.place(&solid).unwrap();
            for sample in singular_samples(&solid) {
                let case = Case::new(sample, &placement).unwrap();
                let clipper = VwProjection::exact(Accuracy::Nearest);
                let found = clipper.clip_segment(&frustum, &case.segment).unwrap();
                assert_eq!(found, case.expected, "{}", case.sample.name());
            }
        }
    }
}
