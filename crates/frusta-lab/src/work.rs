//! Kinds of work, for estimates of the time that is left.

/// A kind of work whose units take about the same time each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Work {
    /// Cases of a family, compared with rational arithmetic.
    Cases,
    /// Rounds in which the clippers of a family are timed.
    CaseRounds,
    /// Rounds on a mix of everyday segments.
    EverydayRounds,
    /// Hard volumes, compared with integer arithmetic.
    Volumes,
    /// Everyday boxes of which false accepts are counted.
    Boxes,
    /// Rounds in which functions on volumes are timed.
    VolumeRounds,
    /// Rounds of the paper's table.
    PaperRounds,
}

impl Work {
    /// All kinds, in the order in which a report goes through them.
    pub const ALL: [Work; 7] = [
        Work::Cases,
        Work::CaseRounds,
        Work::EverydayRounds,
        Work::Volumes,
        Work::Boxes,
        Work::VolumeRounds,
        Work::PaperRounds,
    ];
}

/// Called, from any thread, with the number of units that were done since the last call.
pub type OnWork<'a> = &'a (dyn Fn(Work, u64) + Sync);
