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

    /// Creates an interval from its ends; `None` if `start > end` or either is NaN.
    #[must_use]
    pub fn new(start: f64, end: f64) -> Option<Self> {
        (start <= end).then_some(Self { start, end })
    }

    /// The lower end.
    pub fn start(self) -> f64 {
        self.start
    }

    /// The upper end.
    pub fn end(self) -> f64 {
        self.end
    }

    /// The intersection of two intervals; `None` if it is empty.
    ///
    /// It is the last step of the paper's method in the plane: a point counts only
    /// if it is in both trapezoids.
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

    /// Whether a parameter is in the interval, ends included.
    pub fn contains(self, t: f64) -> bool {
        self.start <= t && t <= self.end
    }
}
