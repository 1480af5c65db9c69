//! Marks in charts: a shape for each algorithm, a colour for each kind of tier; tiers in `f32` are
//! hollow.

use frusta_lab::{SurveyAlgorithm, SurveyTier};

/// The tier's class in the style sheet, which is its colour.
pub(super) fn colour(tier: SurveyTier) -> &'static str {
    match tier {
        SurveyTier::PlainF32 | SurveyTier::PlainF64 => "plain",
        SurveyTier::ExactFast | SurveyTier::ExactFastF32 => "fast",
        SurveyTier::ExactNearest | SurveyTier::ExactNearestF32 => "nearest",
        SurveyTier::ExactInward | SurveyTier::ExactInwardF32 => "inward",
    }
}

/// The outlines, of about the area of a circle; that of V/W, which is one, is empty.
pub(super) fn shape(algorithm: SurveyAlgorithm) -> &'static [[f64; 2]] {
    match algorithm {
        SurveyAlgorithm::Vw => &[],
        SurveyAlgorithm::LiangBarskyTuned => {
            &[[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]]
        }
        SurveyAlgorithm::LiangBarskyTextbook => &[[0.0, -1.3], [1.3, 0.0], [0.0, 1.3], [-1.3, 0.0]],
        SurveyAlgorithm::CyrusBeck => &[[0.0, -1.25], [1.2, 0.85], [-1.2, 0.85]],
        SurveyAlgorithm::CohenSutherland => &[[0.0, 1.25], [-1.2, -0.85], [1.2, -0.85]],
        SurveyAlgorithm::SixPlanes => &[
            [-1.15, -0.4],
            [-0.4, -0.4],
            [-0.4, -1.15],
            [0.4, -1.15],
            [0.4, -0.4],
            [1.15, -0.4],
            [1.15, 0.4],
            [0.4, 0.4],
            [0.4, 1.15],
            [-0.4, 1.15],
            [-0.4, 0.4],
            [-1.15, 0.4],
        ],
    }
}
