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

/// A mark at a position, with a text that is shown when it is pointed at.
pub(super) fn mark(
    algorithm: SurveyAlgorithm,
    tier: SurveyTier,
    [x, y]: [f64; 2],
    radius: f64,
    title: &str,
) -> String {
    let fill = if tier.is_single() { "h" } else { "m" };
    let class = format!("{} {fill}", colour(tier));
    let title = if title.is_empty() {
        String::new()
    } else {
        format!("<title>{title}</title>")
    };
    if algorithm == SurveyAlgorithm::Vw {
        let r = radius;
        return format!(
            "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\">{title}</circle>\n"
        );
    }
    let path: String = shape(algorithm)
        .iter()
        .enumerate()
        .map(|(i, [dx, dy])| {
            let step = if i == 0 { 'M' } else { 'L' };
            format!("{step}{:.1} {:.1}", x + dx * radius, y + dy * radius)
        })
        .collect();
    format!("<path class=\"{class}\" d=\"{path}Z\">{title}</path>\n")
}

/// The outlines other than the circle, with about its area.
fn shape(algorithm: SurveyAlgorithm) -> &'static [[f64; 2]] {
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
