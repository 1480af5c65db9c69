//! Queries on rayon's threads, in pieces.
//!
//! A piece is classified as without threads, into its own part of the caller's buffers: the
//! same bits and the same counts with any number of threads. If several volumes are invalid,
//! the error is that of the first. Indices are listed piece by piece and then joined, which
//! allocates.
//!
//! The caller's thread begins at once; the others take pieces as soon as they wake. That takes
//! as long as some ten thousand answers, and many queries are not much longer.

use super::ContainmentMasks;
use super::block_driver::{BLOCK, Request, WORD};
use super::masks::MaskBits;
use super::output::{Classes, Indices, Sink};
use super::source::Query;
use crate::cull::{Containment, VolumeCounts, VolumeErrorAt};
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Volumes or segments in a piece: enough that handing it over costs little in comparison, few
/// enough that it stays in a core's own cache.
pub(in crate::cull) const PIECE: usize = 32 * BLOCK;

/// The range of a piece.
pub(in crate::cull) fn piece_range(piece: usize, len: usize) -> Range<usize> {
    let start = piece * PIECE;
    start..len.min(start + PIECE)
}

pub(super) fn masks(
    request: Request<'_>,
    query: &dyn Query,
    masks: &mut ContainmentMasks,
) -> Result<VolumeCounts, VolumeErrorAt> {
    let bits = masks.prepare(query.count());
    let outside = bits.outside.chunks_mut(PIECE / WORD);
    let pieces = outside.zip(bits.inside.chunks_mut(PIECE / WORD));
    let counts = by_all(pieces, |piece, (outside, inside)| {
        run_piece(request, query, piece, &mut MaskBits { outside, inside })
    })?;
    Ok(counts.into_iter().sum())
}

pub(super) fn classes(
    request: Request<'_>,
    query: &dyn Query,
    classes: &mut Vec<Containment>,
) -> Result<VolumeCounts, VolumeErrorAt> {
    classes.resize(query.count(), Containment::Outside);
    let counts = by_all(classes.chunks_mut(PIECE), |piece, classes| {
        run_piece(request, query, piece, &mut Classes(classes))
    })?;
    Ok(counts.into_iter().sum())
}

pub(super) fn indices(
    request: Request<'_>,
    query: &dyn Query,
    indices: &mut Vec<u32>,
) -> Result<VolumeCounts, VolumeErrorAt> {
    indices.clear();
    let lists = by_all(0..query.count().div_ceil(PIECE), |_, piece| {
        let mut list = Vec::new();
        let mut sink = Indices::new(&mut list, (piece * PIECE) as u32);
        let counts = run_piece(request, query, piece, &mut sink)?;
        Ok((list, counts))
    })?;
    indices.reserve(lists.iter().map(|(list, _)| list.len()).sum());
    let mut total = VolumeCounts::default();
    for (list, counts) in lists {
        indices.extend_from_slice(&list);
        total += counts;
    }
    Ok(total)
}

fn run_piece(
    request: Request<'_>,
    query: &dyn Query,
    piece: usize,
    out: &mut dyn Sink,
) -> Result<VolumeCounts, VolumeErrorAt> {
    let mut counts = VolumeCounts::default();
    query.run(piece_range(piece, query.count()), request, out, &mut counts)?;
    Ok(counts)
}

/// Works on each piece, on this thread and rayon's, and returns the results in the pieces' order;
/// or the first error in that order.
pub(in crate::cull) fn by_all<Piece: Send, Done: Send, E: Send>(
    pieces: impl ExactSizeIterator<Item = Piece> + Send,
    work: impl Fn(usize, Piece) -> Result<Done, E> + Sync,
) -> Result<Vec<Done>, E> {
    let helpers = rayon::current_num_threads().min(pieces.len());
    let left = Mutex::new(Some(pieces.enumerate()));
    let all = Mutex::new(Vec::new());
    // Pieces are taken in order: when one fails, all before it are taken.
    let take = || locked(&left).as_mut()?.next();
    let work_off = || {
        while let Some((i, piece)) = take() {
            let done = work(i, piece);
            if done.is_err() {
                *locked(&left) = None;
            }
            locked(&all).push((i, done));
        }
    };
    rayon::in_place_scope(|scope| {
        for _ in 1..helpers {
            scope.spawn(|_| work_off());
        }
        work_off();
    });
    let mut all = all.into_inner().unwrap_or_else(PoisonError::into_inner);
    all.sort_unstable_by_key(|&(i, _)| i);
    all.into_iter().map(|(_, done)| done).collect()
}

/// Ignores poison: a thread that panicked ends the scope with its panic.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cull::many::tests::{culler_to_3, points};
    use crate::cull::{Aabb, BoxArrays};

    #[test]
    fn any_number_of_threads_takes_each_piece_once() {
        for threads in [1, 2, 7] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().unwrap();
            for pieces in [0, 1, 5, 400] {
                let work = |i, piece| match i {
                    300 | 350 => Err(i),
                    _ => Ok((i, piece)),
                };
                let done = pool.install(|| by_all(1000..1000 + pieces, work));
                let expected = match pieces {
                    400 => Err(300),
                    _ => Ok((0..pieces).map(|i| (i, 1000 + i)).collect()),
                };
                assert_eq!(done, expected);
            }
        }
    }

    #[test]
    fn the_first_error_is_returned_and_buffers_are_emptied() {
        let culler = culler_to_3();
        let mut points = points(3 * PIECE + 77);
        points[2 * PIECE + 5].y = f32::NAN;
        points.last_mut().unwrap().y = f32::NAN;
        let boxes: Vec<_> = points.iter().map(|&p| Aabb::new(p, p)).collect();
        let (mut masks, mut classes, mut list) = (ContainmentMasks::default(), vec![], vec![1]);
        let mut counts = VolumeCounts::default();
        let errors = [
            culler.over(&boxes).parallel().masks(&mut masks),
            culler.over(&boxes).parallel().classes(&mut classes),
            culler
                .over(&boxes)
                .parallel()
                .counted(&mut counts)
                .visible(&mut list),
        ];
        for error in errors {
            assert_eq!(error.unwrap_err().index, 2 * PIECE + 5);
        }
        assert!(masks.is_empty() && classes.is_empty() && list.is_empty());
        assert_eq!(counts, VolumeCounts::default());
        let nothing = BoxArrays::<f64> {
            min: [&[]; 3],
            max: [&[]; 3],
        };
        assert_eq!(culler.over(nothing).parallel().visible(&mut list), Ok(()));
    }
}
