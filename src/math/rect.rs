//! Axis-parallel rectangles in a frustum's frame.

/// A value for each of the four sides of a frustum: the bounds of a rectangle, or
/// slopes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rect {
    /// The side at smaller `x`.
    pub left: f64,
    /// The side at larger `x`.
    pub right: f64,
    /// The side at smaller `y`.
    pub bottom: f64,
    /// The side at larger `y`.
    pub top: f64,
}

impl Rect {
    /// Creates a rectangle from its four sides.
    #[must_use]
    pub const fn new(left: f64, right: f64, bottom: f64, top: f64) -> Self {
        Self {
            left,
            right,
            bottom,
            top,
        }
    }

    /// The rectangle centred on the origin with these half-extents.
    #[must_use]
    pub const fn centred(half_width: f64, half_height: f64) -> Self {
        // Not negation: it would turn 0 into -0.
        Self::new(0.0 - half_width, half_width, 0.0 - half_height, half_height)
    }

    /// The four sides in the order left, right, bottom, top.
    #[must_use]
    pub const fn to_array(self) -> [f64; 4] {
        [self.left, self.right, self.bottom, self.top]
    }

    /// Whether `-left = right` and `-bottom = top`.
    pub fn is_symmetric(self) -> bool {
        -self.left == self.right && -self.bottom == self.top
    }
}
