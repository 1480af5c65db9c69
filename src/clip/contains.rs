//! Whether a point is in a frustum, by the clippers' own exact signs.

use super::exact::Staged;
use super::predicates::Predicates;
use crate::frustum::Frustum;
use crate::math::{End, NonFinite, Real, Segment, Vec3};
use std::cmp::Ordering;

impl Frustum {
    /// Whether a point is in the frustum, decided exactly. The frustum is a closed set: points on
    /// its surface are in it.
    ///
    /// ```
    /// use frusta::{EndRect, Frustum, Pose, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// // A vertex, and the next `f64` beyond it.
    /// assert!(frustum.contains([3.0, 3.0, 3.0])?);
    /// assert!(!frustum.contains([3.0_f64.next_up(), 3.0, 3.0])?);
    /// assert!(frustum.contains([0.5_f32, 0.0, f32::NAN]).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A coordinate of the point is infinite or NaN.
    pub fn contains<T: Real>(&self, point: impl Into<Vec3<T>>) -> Result<bool, NonFinite> {
        let point = point.into();
        NonFinite::check(None, point)?;
        let point = point.to_f64();
        let mut staged = Staged::new(self, Segment::new(point, point));
        let outside = |face| staged.side(face, End::Start) == Ordering::Less;
        Ok(!self.faces().iter().copied().any(outside))
    }
}
