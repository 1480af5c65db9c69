//! A query over many volumes: a source, options, then one of three outputs.

use super::ContainmentMasks;
use super::block_driver::Request;
use super::output::Output;
use super::source::{Query, VolumeSource};
use crate::cull::{Containment, Culler, VolumeCounts, VolumeErrorAt};

impl Culler {
    /// Starts a query over many boxes or spheres: each answer is that of [`Culler::classify`], or with
    /// [`exact`](VolumeQuery::exact) that of [`Culler::classify_exact`].
    ///
    /// A query takes options, [`exact`](VolumeQuery::exact), [`parallel`](VolumeQuery::parallel),
    /// [`keep_invalid`](VolumeQuery::keep_invalid) and [`counted`](VolumeQuery::counted), then
    /// writes one output:
    ///
    /// | output | for each volume | use |
    /// |---|---|---|
    /// | [`visible`](VolumeQuery::visible) | its index, unless it is outside | a draw list; the fastest |
    /// | [`masks`](VolumeQuery::masks) | two bits: outside, inside | to combine with other masks |
    /// | [`classes`](VolumeQuery::classes) | a [`Containment`] | to branch on |
    ///
    /// [`VolumeSource`] lists what a query can read, and which source is fastest.
    ///
    /// ```
    /// use frusta::cull::{BoxSet, ContainmentMasks};
    /// use frusta::{Aabb, Containment, Culler, EndRect, Frustum, Pose, Shape, Sphere, VolumeCounts};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// let cube = |x: f32| Aabb::new([x, 0.0, 2.0], [x + 0.5, 0.5, 2.5]);
    /// let boxes = [cube(0.0), cube(2.0), cube(9.0)];
    ///
    /// let mut visible = Vec::new();
    /// culler.over(&boxes).visible(&mut visible)?;
    /// assert_eq!(visible, [0, 1]);
    ///
    /// let (mut classes, mut counts) = (Vec::new(), VolumeCounts::default());
    /// culler.over(&boxes).counted(&mut counts).classes(&mut classes)?;
    /// assert_eq!(classes, [Containment::Inside, Containment::Crossing, Containment::Outside]);
    ///
    /// // Boxes that stay the same from frame to frame.
    /// let (set, mut masks) = (BoxSet::new(boxes)?, ContainmentMasks::default());
    /// culler.over(&set).masks(&mut masks)?;
    /// assert_eq!(masks.outside(), [0b100]);
    ///
    /// let spheres = vec![Sphere::new([0.0, 0.0, 2.0], 0.5); 3];
    /// culler.over(&spheres).visible(&mut visible)?;
    /// assert_eq!(visible, [0, 1, 2]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn over<S: VolumeSource>(&self, source: S) -> VolumeQuery<'_, S> {
        let request = Request {
            culler: self,
            keeps_invalid: false,
            is_exact: false,
        };
        VolumeQuery {
            request,
            source,
            counts: None,
            is_parallel: false,
        }
    }
}

/// A query over many volumes, made by [`Culler::over`].
///
/// It runs when it is given an output.
#[derive(Debug)]
#[must_use = "a query runs when it is given an output: `visible`, `classes` or `masks`"]
pub struct VolumeQuery<'q, S> {
    request: Request<'q>,
    source: S,
    counts: Option<&'q mut VolumeCounts>,
    is_parallel: bool,
}

impl<'q, S: VolumeSource> VolumeQuery<'q, S> {
    /// Runs on rayon's threads, those of the pool that the caller is in.
    ///
    /// Output and counts do not depend on the number of threads. Indices are gathered in a
    /// list for each piece of 8,192 volumes and then joined, which allocates.
    ///
    /// ```
    /// use frusta::{Aabb, Culler, EndRect, Frustum, Pose, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// let cube = |i: u16| Aabb::new([f32::from(i % 7), 0.0, 1.5], [f32::from(i % 7), 1.0, 2.0]);
    /// let boxes: Vec<_> = (0..50_000).map(cube).collect();
    /// let (mut one_thread, mut many_threads) = (Vec::new(), Vec::new());
    /// culler.over(&boxes).visible(&mut one_thread)?;
    /// culler.over(&boxes).parallel().visible(&mut many_threads)?;
    /// assert_eq!(one_thread, many_threads);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[cfg(feature = "parallel")]
    pub fn parallel(mut self) -> Self {
        self.is_parallel = true;
        self
    }

    /// Adds to `counts` how often each stage of the exact decisions was needed; nothing on an
    /// error.
    pub fn counted(mut self, counts: &'q mut VolumeCounts) -> Self {
        self.counts = Some(counts);
        self
    }

    /// Decides exactly, as [`Culler::classify_exact`] does: a volume is crossing only if frustum and volume have a point in
    /// common, as a selection needs it.
    ///
    /// What face planes decide takes as long as without; a volume that crosses takes some hundred nanoseconds more.
    ///
    /// ```
    /// use frusta::{Aabb, Culler, EndRect, Frustum, Pose, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// // Beyond the edge between right and far, outside neither of them; touching that edge.
    /// let boxes = [3.5, 3.0].map(|x| Aabb::new([x, -9.0, 2.0], [9.0, 9.0, 9.0]));
    /// let mut visible = Vec::new();
    /// culler.over(&boxes).visible(&mut visible)?;
    /// assert_eq!(visible, [0, 1]);
    /// culler.over(&boxes).exact().visible(&mut visible)?;
    /// assert_eq!(visible, [1]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn exact(mut self) -> Self {
        self.request.is_exact = true;
        self
    }

    /// Takes a volume that fails its `check` as crossing, instead of failing: whatever else is in
    /// view is still drawn. The others' answers do not change.
    ///
    /// [`VolumeCounts::invalid`], by [`counted`](VolumeQuery::counted), says how many there are.
    ///
    /// ```
    /// use frusta::{Aabb, Containment, Culler, EndRect, Frustum, Pose, Shape, VolumeCounts};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// let boxes = [
    ///     Aabb::new([0.0_f32, 0.0, 2.0], [0.5, 0.5, 2.5]),
    ///     Aabb::new([9.0, 0.0, 2.0], [9.5, 0.5, 2.5]),
    ///     Aabb::new([9.0, f32::NAN, 2.0], [9.5, 0.5, 2.5]),
    /// ];
    /// let mut visible = Vec::new();
    /// assert_eq!(culler.over(&boxes).visible(&mut visible).unwrap_err().index, 2);
    ///
    /// let mut counts = VolumeCounts::default();
    /// culler.over(&boxes).keep_invalid().counted(&mut counts).visible(&mut visible)?;
    /// assert_eq!((visible, counts.invalid), (vec![0, 2], 1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn keep_invalid(mut self) -> Self {
        self.request.keeps_invalid = true;
        self
    }

    /// Writes the indices of the volumes that are not outside, in the order of the source.
    ///
    /// Whether a volume is inside need not be decided, so this takes a third less time than
    /// classes. Beyond 2^32 volumes indices start again at 0.
    ///
    /// # Errors
    /// The first volume that fails its `check`, without [`keep_invalid`](VolumeQuery::keep_invalid);
    /// `indices` is then empty. The volumes of a [`BoxSet`](super::BoxSet) or of [`RelativeBoxes`](super::RelativeBoxes) were checked
    /// before: a query over these never fails.
    pub fn visible(self, indices: &mut Vec<u32>) -> Result<(), VolumeErrorAt> {
        self.write_to(indices)
    }

    /// Writes the class of each volume.
    ///
    /// # Errors
    /// Those of [`VolumeQuery::visible`]; `classes` is then empty.
    pub fn classes(self, classes: &mut Vec<Containment>) -> Result<(), VolumeErrorAt> {
        self.write_to(classes)
    }

    /// Writes the class of each volume as bits.
    ///
    /// # Errors
    /// Those of [`VolumeQuery::visible`]; `masks` is then empty.
    pub fn masks(self, masks: &mut ContainmentMasks) -> Result<(), VolumeErrorAt> {
        self.write_to(masks)
    }

    fn write_to(self, output: &mut dyn Output) -> Result<(), VolumeErrorAt> {
        let query = self.source.query(self.request.culler);
        write(self.request, &query, self.is_parallel, output, self.counts)
    }
}

fn write(
    request: Request<'_>,
    query: &dyn Query,
    is_parallel: bool,
    output: &mut dyn Output,
    total: Option<&mut VolumeCounts>,
) -> Result<(), VolumeErrorAt> {
    let mut counts = VolumeCounts::default();
    let done = if is_parallel {
        write_parallel(request, query, output, &mut counts)
    } else {
        output.write(request, query, &mut counts)
    };
    match (&done, total) {
        (Ok(()), Some(total)) => *total += counts,
        (Ok(()), None) => {}
        (Err(_), _) => output.clear(),
    }
    done
}

#[cfg(feature = "parallel")]
fn write_parallel(
    request: Request<'_>,
    query: &dyn Query,
    output: &mut dyn Output,
    counts: &mut VolumeCounts,
) -> Result<(), VolumeErrorAt> {
    *counts = output.write_parallel(request, query)?;
    Ok(())
}

/// Without the feature no query is parallel.
#[cfg(not(feature = "parallel"))]
fn write_parallel(
    request: Request<'_>,
    query: &dyn Query,
    output: &mut dyn Output,
    counts: &mut VolumeCounts,
) -> Result<(), VolumeErrorAt> {
    output.write(request, query, counts)
}
