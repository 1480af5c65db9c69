//! The cases that the benchmarks time, their answers compared already.

use super::{
    COUNT, Form, Mix, assert_answers_agree, assert_exact_agree, frustum, samples, wrong_answers,
};
use frusta::clip::SegmentClipper;
use frusta::samples::Placement;
use frusta::{Frustum, NonFinite, Pose, Real, Segment, SegmentClip};

/// A call like any other: whether the compiler would inline an algorithm into
/// the loop that times it says nothing about the algorithm.
#[inline(never)]
pub fn call<T: Real>(
    clipper: &impl SegmentClipper<T>,
    frustum: &Frustum,
    segment: &Segment<T>,
) -> Result<SegmentClip<T>, NonFinite> {
    clipper.clip_segment(frustum, segment)
}

/// The singular samples at one place.
pub struct Singular {
    pub place: &'static str,
    pub frustum: Frustum,
    pub segments: Vec<Segment<f64>>,
    /// How many answers of each plain algorithm are wrong.
    pub wrong: [(&'static str, usize); 6],
}

/// The 78 singular samples where all boundary values are exact, and elsewhere,
/// where plain answers may be wrong: they are counted instead.
pub fn singular() -> [Singular; 2] {
    [
        ("frame", Placement::IDENTITY),
        ("world", Placement::rotated([1, 2, 2, 4])),
    ]
    .map(|(place, placement)| {
        let (frustum, segments) = samples::<f64>(&placement);
        assert_exact_agree(&frustum, &segments);
        let wrong = wrong_answers(&frustum, &segments);
        for (name, wrong) in wrong {
            let parametric = !matches!(name, "cohen-sutherland" | "six-planes");
            let exact = place == "frame" && parametric;
            assert!(!exact || wrong == 0, "{name}: {wrong}");
        }
        Singular {
            place,
            frustum,
            segments,
            wrong,
        }
    })
}

/// A form that the plain tier knows, on a mix, and nearly the same set of points
/// in the general form.
pub struct FormCase {
    pub form: Form,
    pub mix: Mix,
    pub general: Frustum,
    pub own: Frustum,
    pub segments: Vec<Segment<f64>>,
}

/// The forms that are faster than the general one.
pub fn form_cases() -> impl Iterator<Item = FormCase> {
    let forms = [Form::Symmetric, Form::Orthographic, Form::Infinite];
    let all = forms
        .into_iter()
        .flat_map(|form| Mix::ALL.map(|mix| (form, mix)));
    all.map(|(form, mix)| {
        let shapes = [form.generalised(), form.shape()];
        let [general, own] = shapes.map(|shape| frustum(shape, &Pose::IDENTITY));
        let segments = mix.segments::<f64>(COUNT, &Pose::IDENTITY);
        let classes = [&general, &own].map(|f| assert_answers_agree(f, &segments));
        assert_eq!(classes[0], classes[1], "not the same set of points");
        FormCase {
            form,
            mix,
            general,
            own,
            segments,
        }
    })
}
