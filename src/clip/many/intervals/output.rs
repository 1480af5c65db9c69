//! Where the answers of a batch go.

use crate::clip::{Accuracy, Class, SegmentClip, StageCounts, many};
use crate::frustum::Frustum;
use crate::math::{NonFiniteAt, Real, Segment};
use crate::simd::Level;

/// Class and parameters of many segments.
///
/// `t0` and `t1` are the parameters of a part's entry and exit, `0 <= t0 <= t1 <= 1`: the same
/// bits as from [`Frustum::clip_segment`](crate::Frustum::clip_segment). For a segment that is
/// outside they are 1 and 0.
///
/// [`Culler::clip_intervals`](crate::Culler::clip_intervals) fills it, and reuses its memory.
#[derive(Clone, Debug)]
pub struct SegmentIntervals<T> {
    classes: Vec<Class>,
    t0: Vec<T>,
    t1: Vec<T>,
    uncertain: Uncertain<T>,
}

impl<T> Default for SegmentIntervals<T> {
    fn default() -> Self {
        Self {
            classes: Vec::new(),
            t0: Vec::new(),
            t1: Vec::new(),
            uncertain: Uncertain::default(),
        }
    }
}

impl<T: PartialEq> PartialEq for SegmentIntervals<T> {
    fn eq(&self, other: &Self) -> bool {
        (&self.classes, &self.t0, &self.t1) == (&other.classes, &other.t0, &other.t1)
    }
}

impl<T: Real> SegmentIntervals<T> {
    /// Number of segments.
    #[must_use]
    pub fn len(&self) -> usize {
        self.classes.len()
    }

    /// Whether there are no segments.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.classes.is_empty()
    }

    /// The class of each segment.
    #[must_use]
    pub fn classes(&self) -> &[Class] {
        &self.classes
    }

    /// The parameter at which each segment enters; 1 if it is outside.
    #[must_use]
    pub fn t0(&self) -> &[T] {
        &self.t0
    }

    /// The parameter at which each segment leaves; 0 if it is outside.
    #[must_use]
    pub fn t1(&self) -> &[T] {
        &self.t1
    }

    /// Class, `t0` and `t1` of the segment with an index.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<(Class, T, T)> {
        let class = *self.classes.get(index)?;
        Some((class, *self.t0.get(index)?, *self.t1.get(index)?))
    }

    /// Class, `t0` and `t1` of each segment, in order.
    pub fn iter(&self) -> impl Iterator<Item = (Class, T, T)> + '_ {
        let parameters = self.t0.iter().zip(&self.t1);
        let all = self.classes.iter().zip(parameters);
        all.map(|(class, (t0, t1))| (*class, *t0, *t1))
    }

    /// The indices of the segments that are not outside, in ascending order.
    pub fn visible(&self) -> impl Iterator<Item = usize> + '_ {
        let all = self.classes.iter().enumerate();
        all.filter_map(|(i, class)| (*class != Class::Outside).then_some(i))
    }

    /// Number of segments that were not certain in the batch's own type, and so were clipped as
    /// a slice in `f64`. It may depend on the machine's vector width, and is 0 without vector
    /// registers; the answers do not.
    #[must_use]
    pub fn uncertain(&self) -> usize {
        self.uncertain.count
    }

    /// Removes all segments.
    pub(crate) fn clear(&mut self) {
        self.classes.clear();
        self.t0.clear();
        self.t1.clear();
        self.uncertain.begin();
    }

    /// Places for the answers of `len` segments, all to be overwritten.
    pub(crate) fn prepare(&mut self, len: usize) -> Out<'_, T> {
        self.classes.resize(len, Class::Outside);
        self.t0.resize(len, T::ZERO);
        self.t1.resize(len, T::ZERO);
        self.uncertain.begin();
        Out {
            classes: &mut self.classes,
            t0: &mut self.t0,
            t1: &mut self.t1,
            uncertain: &mut self.uncertain,
        }
    }
}

/// Where answers go: a place for each segment.
pub(crate) struct Out<'a, T> {
    pub(crate) classes: &'a mut [Class],
    pub(crate) t0: &'a mut [T],
    pub(crate) t1: &'a mut [T],
    /// Working memory.
    pub(crate) uncertain: &'a mut Uncertain<T>,
}

/// Segments that are not certain: clipped as a slice, many at a time.
#[derive(Clone, Debug)]
pub(crate) struct Uncertain<T> {
    /// How many have been clipped.
    pub(crate) count: usize,
    /// Those that wait, and their indices.
    segments: Vec<Segment<T>>,
    indices: Vec<usize>,
    clips: Vec<SegmentClip<T>>,
}

impl<T> Uncertain<T> {
    /// Removes all, and starts counting.
    pub(super) fn begin(&mut self) {
        self.count = 0;
        self.segments.clear();
        self.indices.clear();
    }

    pub(super) fn push(&mut self, index: usize, segment: Segment<T>) {
        self.segments.push(segment);
        self.indices.push(index);
    }
}

impl<T> Default for Uncertain<T> {
    fn default() -> Self {
        Self {
            count: 0,
            segments: Vec::new(),
            indices: Vec::new(),
            clips: Vec::new(),
        }
    }
}

impl<T: Real> Out<'_, T> {
    /// Clips the segments that wait, if there are `least` of them, as a slice. Segments that are
    /// not finite wait in the batch's order.
    pub(super) fn clip_uncertain(
        &mut self,
        level: Level,
        frustum: &Frustum,
        least: usize,
    ) -> Result<(), NonFiniteAt> {
        let Uncertain {
            count,
            segments,
            indices,
            clips,
        } = &mut *self.uncertain;
        if indices.len() < least {
            return Ok(());
        }
        let counts = &mut StageCounts::default();
        let source = (&*segments).into();
        many::clip_exact(level, frustum, source, Accuracy::Fast, clips, counts).map_err(
            |error| NonFiniteAt {
                index: indices[error.index],
                ..error
            },
        )?;
        for (&i, clip) in indices.iter().zip(clips.iter()) {
            self.classes[i] = clip.class;
            let part = clip.part.as_ref();
            (self.t0[i], self.t1[i]) =
                part.map_or((T::ONE, T::ZERO), |part| (part.entry.t, part.exit.t));
        }
        *count += indices.len();
        segments.clear();
        indices.clear();
        Ok(())
    }
}
