//! frusta on points and boxes: one call each, and in batches.

use super::{BoxTest, GridBox};
use crate::peer::{Contestant, Peer, Timed, Who};
use frusta::cull::{BoxArrays, BoxSet, ContainmentMasks};
use frusta::{Aabb, Containment, Culler, Frustum, NonFinite, Vec3, VolumeError};
use std::hint::black_box;

/// `Frustum::contains`, for boxes of zero size.
pub struct OursPoint(Frustum);

impl OursPoint {
    /// Tests against this frustum.
    pub fn new(frustum: &Frustum) -> Self {
        Self(frustum.clone())
    }
}

impl Peer for OursPoint {
    type Case = GridBox;
    type Input = Vec3<f32>;
    type Output<'a> = Result<bool, NonFinite>;

    fn who(&self) -> Who {
        Who {
            library: "frusta",
            function: "Frustum::contains",
            scalar: "f32",
            note: "a point; exact",
        }
    }

    fn prepare(&self, block: &GridBox) -> Vec3<f32> {
        block.min.into()
    }

    fn run(&mut self, point: &Vec3<f32>) -> Result<bool, NonFinite> {
        self.0.contains(*point)
    }

    fn answer(&mut self, block: &GridBox) -> Option<bool> {
        let point = self.prepare(block);
        self.run(&point).ok()
    }
}

/// What times of one call a box are compared with.
pub const REFERENCE_BOX: &str = "Culler::classify";
/// What times of lists are compared with: the list of boxes that are kept.
pub const REFERENCE_BOXES: &str = "Culler::over, visible in a set";
/// What times of lists are compared with, too: the list of a plain slice of boxes.
pub const REFERENCE_SLICE: &str = "Culler::over, visible in a slice";

/// `Culler::classify`, plane by plane, or `Culler::classify_exact`.
pub struct OursBox {
    culler: Culler,
    exact: bool,
}

impl OursBox {
    /// Tests against this frustum, with separating axes or by its planes alone.
    pub fn new(frustum: &Frustum, exact: bool) -> Self {
        let culler = Culler::new(frustum);
        Self { culler, exact }
    }
}

impl Peer for OursBox {
    type Case = GridBox;
    type Input = Aabb<f32>;
    type Output<'a> = Result<Containment, VolumeError>;

    fn who(&self) -> Who {
        let (function, note) = match self.exact {
            true => ("Culler::classify_exact", "three-way, exact"),
            false => (
                REFERENCE_BOX,
                "three-way; outside and inside exact, conservative by design",
            ),
        };
        Who {
            library: "frusta",
            function,
            scalar: "f32",
            note,
        }
    }

    fn prepare(&self, block: &GridBox) -> Aabb<f32> {
        Aabb::new(block.min, block.max)
    }

    fn run(&mut self, block: &Aabb<f32>) -> Result<Containment, VolumeError> {
        if self.exact {
            self.culler.classify_exact(*block)
        } else {
            self.culler.classify(*block)
        }
    }

    fn answer(&mut self, block: &GridBox) -> Option<bool> {
        let block = self.prepare(block);
        self.run(&block).ok().map(|c| c != Containment::Outside)
    }
}

impl BoxTest for OursBox {
    fn list_name(&self) -> &'static str {
        match self.exact {
            true => "Culler::classify_exact, list",
            false => "Culler::classify, list",
        }
    }

    #[inline]
    fn sees(&mut self, block: &Aabb<f32>) -> bool {
        self.run(block) != Ok(Containment::Outside)
    }
}

/// A batch function and its input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Batch {
    /// Classes as masks, from a structure of arrays.
    Masks,
    /// A draw list, from a structure of arrays.
    List,
    /// A draw list, from an array of structures.
    ListOfBoxes,
    /// Classes as masks, of boxes that are kept.
    MasksOfSet,
    /// A draw list, of boxes that are kept.
    ListOfSet,
}

/// Queries over 4,096 boxes a call into buffers that are used again.
pub struct OursBatch {
    culler: Culler,
    batch: Batch,
    boxes: Vec<Aabb<f32>>,
    arrays: [Vec<f32>; 6],
    sets: Vec<BoxSet<f32>>,
    masks: ContainmentMasks,
    list: Vec<u32>,
}

/// Boxes in a call.
pub(super) const PIECE: usize = 4096;

impl OursBatch {
    /// Queries against this frustum.
    pub fn new(frustum: &Frustum, batch: Batch) -> Self {
        Self {
            culler: Culler::new(frustum),
            batch,
            boxes: Vec::new(),
            arrays: Default::default(),
            sets: Vec::new(),
            masks: ContainmentMasks::default(),
            list: Vec::new(),
        }
    }

    /// Runs a query over a range of the loaded boxes.
    fn piece(&mut self, from: usize, to: usize) -> Result<(), frusta::VolumeErrorAt> {
        let [a, b, c, d, e, f] = self.arrays.each_ref().map(|array| &array[from..to]);
        let arrays = BoxArrays {
            min: [a, b, c],
            max: [d, e, f],
        };
        match self.batch {
            Batch::Masks => self.culler.over(arrays).masks(&mut self.masks),
            Batch::List => self.culler.over(arrays).visible(&mut self.list),
            Batch::ListOfBoxes => {
                let boxes = &self.boxes[from..to];
                self.culler.over(boxes).visible(&mut self.list)
            }
            Batch::MasksOfSet => {
                let set = &self.sets[from / PIECE];
                self.culler.over(set).masks(&mut self.masks)
            }
            Batch::ListOfSet => {
                let set = &self.sets[from / PIECE];
                self.culler.over(set).visible(&mut self.list)
            }
        }
    }

    fn pieces(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let all = self.boxes.len();
        (0..all)
            .step_by(PIECE)
            .map(move |from| (from, all.min(from + PIECE)))
    }
}

impl Timed for OursBatch {
    fn who(&self) -> Who {
        Who {
            library: "frusta",
            function: match self.batch {
                Batch::Masks => "Culler::over, masks of arrays",
                Batch::MasksOfSet => "Culler::over, masks of a set",
                Batch::ListOfSet => REFERENCE_BOXES,
                Batch::List => "Culler::over, visible in arrays",
                Batch::ListOfBoxes => REFERENCE_SLICE,
            },
            scalar: "f32",
            note: "4,096 a call; outside and inside exact, conservative by design",
        }
    }

    fn pass(&mut self) {
        for (from, to) in self.pieces() {
            let _ = black_box(self.piece(from, to));
            black_box((&self.masks, &self.list));
        }
    }

    fn loaded(&self) -> usize {
        self.boxes.len()
    }
}

impl Contestant<GridBox> for OursBatch {
    fn ask(&mut self, case: &GridBox) -> Option<bool> {
        self.ask_all(&[*case])[0]
    }

    fn ask_all(&mut self, cases: &[GridBox]) -> Vec<Option<bool>> {
        self.load(cases);
        let mut all = Vec::with_capacity(cases.len());
        for (from, to) in self.pieces() {
            let is_done = self.piece(from, to).is_ok();
            let mut seen = vec![false; to - from];
            match self.batch {
                Batch::Masks | Batch::MasksOfSet => {
                    self.masks.visible().for_each(|i| seen[i] = true)
                }
                _ => self.list.iter().for_each(|&i| seen[i as usize] = true),
            }
            all.extend(seen.into_iter().map(|seen| is_done.then_some(seen)));
        }
        all
    }

    fn load(&mut self, cases: &[GridBox]) {
        self.boxes = cases.iter().map(|b| Aabb::new(b.min, b.max)).collect();
        let sets = self.boxes.chunks(PIECE);
        self.sets = sets
            .map(|some| BoxSet::new(some.iter().copied()).expect("boxes"))
            .collect();
        self.arrays = std::array::from_fn(|k| {
            let component = |b: &GridBox| [b.min, b.max][k / 3][k % 3];
            cases.iter().map(component).collect()
        });
    }
}
