//! Closed intervals of a segment's parameter.

/// The closed interval `start..=end`, never empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    start: f64,
    end: f64,
}

impl Interval {
    /// The parameters of a whole segment, `0..=1`.
    pub const UNIT: Interval = Interval {
        start: 0.0,
        end: 1.0,
    };

    /// From both ends; `None` if `start > end` or either is NaN.
    #[must_use]
    pub fn new(start: f64, end: f64) -> Option<Self> {
        (start <= end).then_some(Self { start, end })
    }

    /// The least number in it.
    pub fn start(self) -> f64 {
        self.start
    }

    /// The greatest number in it.
    pub fn end(self) -> f64 {
        self.end
    }

    /// What two intervals have in common: the last step of the paper's method
    /// in the plane, where a hit on one trapezoid counts only if it is also
    /// one on the other.
    ///
    /// ```
    /// use frusta::Interval;
    /// let a = Interval::new(0.0, 0.5).unwrap();
    /// let b = Interval::new(0.5, 1.0).unwrap();
    /// assert_eq!(a.intersection(b), Interval::new(0.5, 0.5));
    /// assert_eq!(a.intersection(Interval::new(0.75, 1.0).unwrap()), None);
    /// ```
    #[must_use]
    pub fn intersection(self, other: Self) -> Option<Self> {
        Self::new(self.start.max(other.start), self.end.min(other.end))
    }

    /// Whether the number is in it, ends included.
    pub fn contains(self, t: f64) -> bool {
        self.start <= t && t <= self.end
    }
}
