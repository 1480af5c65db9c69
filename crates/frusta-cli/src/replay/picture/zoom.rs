//! A spot in one of the two planes: the trapezoid's sides there, the segment, all
//! answers, and, where they are few, the points that a scalar type has.

use super::exact::{Exact, Point, Rim, Window, between};
use super::scene::{Scene, points, shown, truth_within};
use super::spot::Spot;
use crate::draw::{Canvas, Pen, Place, Plane, Sizes, draw_segment};
use crate::replay::answers::Replay;
use frusta::Real;
use frusta::oracle::round_nearest;
use frusta_lab::CaseSegment;
use num_traits::{Signed, ToPrimitive, Zero};

/// More points than this in a row would be a tone.
const MOST_POINTS: usize = 26;

/// A plane's picture of a spot.
pub(super) struct Zoom<'a> {
    pub(super) replay: &'a Replay,
    pub(super) scene: &'a Scene,
    pub(super) spot: &'a Spot,
    pub(super) plane: Plane,
    /// The side of the square picture.
    pub(super) side: f64,
}

impl Zoom<'_> {
    /// Draws it.
    pub(super) fn draw(&self, canvas: &mut Canvas) {
        let window = Window::around(self.spot.centre.clone(), &self.spot.half);
        self.region(canvas);
        self.grid(canvas, &window);
        self.segment(canvas, &window);
        self.answers(canvas, &window);
    }

    /// Which coordinate is drawn upwards.
    fn across(&self) -> usize {
        self.plane as usize
    }

    /// Depth grows to the right.
    fn sign(&self) -> f64 {
        self.scene.solid.shape.direction().sign()
    }

    /// From -1..1 to the picture.
    fn to_picture(&self, [depth, across]: Place) -> Place {
        let half = 0.5 * self.side;
        [half * (1.0 + self.sign() * depth), half * (1.0 - across)]
    }

    fn place(&self, window: &Window, p: &Point) -> Place {
        let at = window.place(p).to_array();
        self.to_picture([at[2], at[self.across()]])
    }

    /// The region inside, and the sides that bound it.
    fn region(&self, canvas: &mut Canvas) {
        let mut region = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let sides = self.sides();
        for side in &sides {
            region = side.cut(&region);
        }
        let palette = canvas.palette;
        let places: Vec<Place> = region.iter().map(|&p| self.to_picture(p)).collect();
        if region.len() > 2 {
            canvas.polygon(&places, palette.ink, 0.09, 0.0);
        }
        for i in 0..region.len() {
            let next = (i + 1) % region.len();
            let on = |side: &Side| side.is_at(region[i]) && side.is_at(region[next]);
            if sides.iter().any(on) {
                canvas.line(places[i], places[next], Pen::new(palette.ink, 2.0));
            }
        }
    }

    /// The sides' boundary functions in the window.
    fn sides(&self) -> Vec<Side> {
        let [near, far]: &[Rim; 2] = &self.scene.rims;
        let (centre, half) = (&self.spot.centre, &self.spot.half);
        let k = self.across();
        let depth = &far.z - &near.z;
        let sign = depth.signum();
        let beyond = &centre[2] - &near.z;
        let mut sides = vec![Side::new([
            &beyond * &sign,
            sign.clone() * half,
            Exact::zero(),
        ])];
        if self.replay.case.frustum.shape().far().is_some() {
            let before = (&far.z - &centre[2]) * &sign;
            sides.push(Side::new([before, -sign.clone() * half, Exact::zero()]));
        }
        for (i, inwards) in [(2 * k, 1), (2 * k + 1, -1)] {
            let slope = (&far.sides[i] - &near.sides[i]) / &depth;
            let inwards = Exact::from_integer(inwards.into());
            let value = &centre[k] - &near.sides[i] - &slope * &beyond;
            sides.push(Side::new([
                value * &inwards,
                -slope * half * &inwards,
                half * &inwards,
            ]));
        }
        sides
    }

    fn segment(&self, canvas: &mut Canvas, window: &Window) {
        let [a, b] = &self.scene.ends;
        let Some(range) = window.within([a, b], 1.0, &[self.across(), 2]) else {
            return;
        };
        let [from, to] = range
            .each_ref()
            .map(|t| self.place(window, &between(a, b, t)));
        let clip = truth_within(self.replay, &range);
        let at = |t: f64| [0, 1].map(|i| from[i] + (to[i] - from[i]) * t);
        let sizes = Sizes {
            thick: 4.0,
            thin: 1.7,
            mark: 4.5,
        };
        draw_segment(canvas, &clip, shown(&range), sizes, at);
    }

    /// Plain answers as crosses, exact ones as discs.
    fn answers(&self, canvas: &mut Canvas, window: &Window) {
        let palette = canvas.palette;
        let mut seen: Vec<(bool, Place)> = Vec::new();
        for answer in &self.replay.answers {
            let exact = answer.tier.is_exact();
            for p in points(self.replay, answer).into_iter().flatten() {
                let place = self.place(window, &p);
                let inside = place.iter().all(|c| (0.0..=self.side).contains(c));
                if !inside || seen.contains(&(exact, place)) {
                    continue;
                }
                seen.push((exact, place));
                if exact {
                    canvas.disc(place, 3.2, palette.ink);
                } else {
                    canvas.cross(place, 5.0, Pen::new(palette.wrong, 2.2));
                }
            }
        }
    }

    /// The points with coordinates of the segment's type, in the identity pose.
    fn grid(&self, canvas: &mut Canvas, window: &Window) {
        if !self.replay.case.frustum.pose().is_identity() {
            return;
        }
        let rows = |k: usize| match self.replay.case.segment {
            CaseSegment::Single(_) => representable::<f32>(&self.spot.centre[k], window, k),
            CaseSegment::Double(_) => representable::<f64>(&self.spot.centre[k], window, k),
        };
        if let (Some(depths), Some(acrosses)) = (rows(2), rows(self.across())) {
            for &depth in &depths {
                for &across in &acrosses {
                    let faint = canvas.palette.classes[0];
                    canvas.disc(self.to_picture([depth, across]), 1.6, faint);
                }
            }
        }
    }
}

/// Where the numbers of `T` are in a window; `None` if they are too many.
fn representable<T: Real>(centre: &Exact, window: &Window, k: usize) -> Option<Vec<f64>> {
    let middle: T = round_nearest(centre);
    let mut places = Vec::new();
    for step in [T::next_up as fn(T) -> T, T::next_down] {
        let mut value = middle;
        loop {
            let exact = Exact::from_float(value.to_f64())?;
            let place = window.coordinate(k, &exact);
            if place.abs() > 1.0 {
                break;
            }
            if places.len() > MOST_POINTS {
                return None;
            }
            places.push(place);
            value = step(value);
        }
    }
    Some(places)
}

/// A linear function on the window, not negative inside.
struct Side([f64; 3]);

impl Side {
    /// From the value in the middle and the slopes along depth and across.
    fn new(terms: [Exact; 3]) -> Self {
        let largest = terms.iter().map(Signed::abs).max();
        let largest = largest.filter(|l| !l.is_zero());
        Self(terms.map(|term| match &largest {
            Some(largest) => (term / largest).to_f64().unwrap_or(0.0),
            None => 0.0,
        }))
    }

    fn at(&self, [depth, across]: Place) -> f64 {
        self.0[0] + self.0[1] * depth + self.0[2] * across
    }

    /// Whether a corner was cut here; this is a drawing's own roundoff.
    fn is_at(&self, p: Place) -> bool {
        self.at(p).abs() < 1e-9
    }

    /// What of a convex polygon is inside.
    fn cut(&self, polygon: &[Place]) -> Vec<Place> {
        let mut inside = Vec::new();
        for (i, &p) in polygon.iter().enumerate() {
            let q = polygon[(i + 1) % polygon.len()];
            let (at_p, at_q) = (self.at(p), self.at(q));
            if at_p >= 0.0 {
                inside.push(p);
            }
            if (at_p >= 0.0) != (at_q >= 0.0) {
                let t = at_p / (at_p - at_q);
                inside.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
            }
        }
        inside
    }
}
