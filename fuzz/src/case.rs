//! A frustum and a segment, from bytes.

use arbitrary::{Result, Unstructured};
use frusta::samples::{Placement, Solid};
use frusta::{EndRect, Frustum, Pose, Rect, Segment, Shape, Vec3};

/// A valid frustum and a segment that need not be finite.
pub(crate) struct Case {
    pub(crate) frustum: Frustum,
    pub(crate) segment: Segment<f64>,
}

/// How the frame lies in the world.
enum Placed {
    Exactly(Placement),
    By(Pose),
}

/// Decimal and extreme numbers that no short dyadic one is near.
const RARE: [f64; 16] = [
    0.0,
    -0.0,
    5e-324,
    -1e-310,
    1e-200,
    1e-160,
    -1e-30,
    0.1,
    1.0 / 3.0,
    -3e7,
    1e15,
    1e155,
    -1e200,
    1e300,
    f64::MAX,
    f64::MIN,
];

impl Case {
    /// Near, on and through features. `None` if the numbers make no frustum.
    pub(crate) fn new(u: &mut Unstructured<'_>) -> Result<Option<Self>> {
        let solid = solid(u)?;
        let placed = placed(u)?;
        let frustum = match &placed {
            Placed::Exactly(placement) => placement.place(&solid),
            Placed::By(pose) => Frustum::new(*pose, solid.shape),
        };
        let Ok(frustum) = frustum else {
            return Ok(None);
        };
        let place = |u: &mut Unstructured<'_>| -> Result<Vec3<f64>> {
            let p = solid.at(grid(u, &solid)?);
            Ok(match &placed {
                Placed::Exactly(placement) => placement.point(p),
                Placed::By(pose) => pose.to_world(p),
            })
        };
        let (a, b) = (place(u)?, place(u)?);
        let d = b - a;
        // Half steps along the line: exact while the numbers are short.
        let start = a - d * (f64::from(u.int_in_range(0..=6_i8)?) * 0.5);
        let end = b + d * (f64::from(u.int_in_range(0..=6_i8)?) * 0.5);
        let mut segment = Segment::new(nudged(u, start)?, nudged(u, end)?);
        if u.ratio(1, 16)? {
            let rare = rare(u)?;
            let k = u.choose_index(3)?;
            segment.end[k] = rare;
        }
        Ok(Some(Self { frustum, segment }))
    }

    /// Any numbers at all.
    pub(crate) fn wild(u: &mut Unstructured<'_>) -> Result<Option<Self>> {
        if u.ratio(1, 4)? {
            return Self::new(u);
        }
        let Some(frustum) = crate::build::any(u)? else {
            return Ok(None);
        };
        let mut c = || any_number(u);
        let segment = Segment::new([c()?, c()?, c()?], [c()?, c()?, c()?]);
        Ok(Some(Self { frustum, segment }))
    }

    /// The segment rounded to `f32`; may overflow.
    pub(crate) fn in_singles(&self) -> Segment<f32> {
        let Segment { start, end } = self.segment;
        Segment::new(Vec3::<f32>::from_f64(start), Vec3::<f32>::from_f64(end))
    }
}

/// Any double: special ones often, all bits sometimes.
pub(crate) fn any_number(u: &mut Unstructured<'_>) -> Result<f64> {
    Ok(match u.int_in_range(0..=7_u8)? {
        0..=3 => f64::from(u.int_in_range(-16..=16_i8)?) * 0.5,
        4 | 5 => rare(u)?,
        _ => f64::from_bits(u.arbitrary()?),
    })
}

fn rare(u: &mut Unstructured<'_>) -> Result<f64> {
    if u.ratio(1, 8)? {
        return Ok(f64::from_bits(u.arbitrary()?));
    }
    Ok(*u.choose(&RARE)?)
}

/// One of the known solids, a small integer one, or one off by ulps.
fn solid(u: &mut Unstructured<'_>) -> Result<Solid> {
    let mut solid = *u.choose(&Solid::ALL)?;
    match u.int_in_range(0..=3_u8)? {
        0 | 1 => {}
        2 => {
            if let Shape::Finite { near, far } = &mut solid.shape {
                *near = small_end(u)?;
                *far = small_end(u)?;
            }
        }
        _ => {
            if let Shape::Finite { near, far } = &mut solid.shape {
                *near = nudged_end(u, *near)?;
                *far = nudged_end(u, *far)?;
            } else if let Shape::Infinite { near, slopes, .. } = &mut solid.shape {
                *near = nudged_end(u, *near)?;
                *slopes = nudged_end(
                    u,
                    EndRect {
                        z: 0.0,
                        rect: *slopes,
                    },
                )?
                .rect;
            }
        }
    }
    Ok(solid)
}

fn small_end(u: &mut Unstructured<'_>) -> Result<EndRect> {
    let mut small =
        |low: i8, high: i8| -> Result<f64> { Ok(f64::from(u.int_in_range(low..=high)?) * 0.5) };
    let (z, left, bottom) = (small(-9, 9)?, small(-9, 9)?, small(-9, 9)?);
    let (width, height) = (small(0, 9)?, small(0, 9)?);
    Ok(EndRect::new(z, left, left + width, bottom, bottom + height))
}

fn nudged_end(u: &mut Unstructured<'_>, end: EndRect) -> Result<EndRect> {
    let [left, right, bottom, top] = end.rect.to_array();
    let mut nudge = |v: f64| nudged_number(u, v);
    let (left, right, bottom, top) = (nudge(left)?, nudge(right)?, nudge(bottom)?, nudge(top)?);
    Ok(EndRect {
        z: nudge(end.z)?,
        rect: Rect::new(left, right, bottom, top),
    })
}

fn placed(u: &mut Unstructured<'_>) -> Result<Placed> {
    let mut placement = Placement::IDENTITY;
    match u.int_in_range(0..=4_u8)? {
        0 => return Ok(Placed::Exactly(placement)),
        1 => placement = *u.choose(&Placement::signed_permutations())?,
        2 | 3 => {
            let mut q = || u.int_in_range(-4..=4_i8);
            let q = [q()?, q()?, q()?, q()?];
            if q != [0; 4] {
                placement = Placement::rotated(q);
            }
        }
        _ => {
            // Rounded, skew axes.
            let mut c = || -> Result<f64> { Ok(f64::from(u.arbitrary::<i8>()?) / 7.0) };
            let mut v = || -> Result<_> { Ok(Vec3::new(c()?, c()?, c()?)) };
            return Ok(Placed::By(Pose::new(v()?, [v()?, v()?, v()?])));
        }
    }
    let mut c = || -> Result<f64> { Ok(f64::from(u.arbitrary::<i8>()?) * 0.5) };
    let origin = Vec3::new(c()?, c()?, c()?);
    let exponent = match u.int_in_range(0..=3_u8)? {
        0 | 1 => 0,
        2 => u.int_in_range(-60..=60_i16)?,
        _ => u.int_in_range(-1060..=1000_i16)?,
    };
    Ok(Placed::Exactly(placement.moved_to(origin).scaled(exponent)))
}

/// The middle of a feature, a quarter point of the grid, or one around it.
fn grid(u: &mut Unstructured<'_>, solid: &Solid) -> Result<[f64; 3]> {
    let features = solid.features();
    if u.ratio(1, 2)? {
        return Ok(u.choose(&features)?.grid());
    }
    let mut c = || -> Result<f64> {
        Ok(match u.int_in_range(0..=3_u8)? {
            0 => 0.0,
            1 => 1.0,
            _ => f64::from(u.int_in_range(-4..=12_i8)?) * 0.125,
        })
    };
    Ok([c()?, c()?, c()?])
}

fn nudged(u: &mut Unstructured<'_>, p: Vec3<f64>) -> Result<Vec3<f64>> {
    let mut nudge = |v: f64| nudged_number(u, v);
    Ok(Vec3::new(nudge(p.x)?, nudge(p.y)?, nudge(p.z)?))
}

/// Mostly the number itself, else up to 4 ulp up or down.
fn nudged_number(u: &mut Unstructured<'_>, v: f64) -> Result<f64> {
    let steps = match u.int_in_range(0..=11_i8)? {
        steps @ 0..=8 => steps - 4,
        _ => 0,
    };
    let step = if steps < 0 {
        f64::next_down
    } else {
        f64::next_up
    };
    Ok((0..steps.unsigned_abs()).fold(v, |v, _| step(v)))
}
