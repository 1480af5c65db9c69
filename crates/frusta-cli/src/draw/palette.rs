//! Colours, on light and on dark paper.
//!
//! The five classes have the hues of Okabe and Ito's set ("Color Universal
//! Design", 2008), which stay apart for every common kind of colour blindness;
//! lighter on dark paper.

use clap::ValueEnum;

/// `--theme`
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Theme {
    /// Dark strokes on light paper
    #[default]
    Light,
    /// Light strokes on dark paper
    Dark,
}

/// A theme's colours, as `#rrggbb`.
#[derive(Debug)]
pub(crate) struct Palette {
    /// Around the picture.
    pub(crate) page: &'static str,
    /// Behind the strokes.
    pub(crate) paper: &'static str,
    /// Where strokes are densest.
    pub(crate) strong: &'static str,
    /// Text and frames.
    pub(crate) ink: &'static str,
    /// Grid lines, hidden lines, remarks.
    pub(crate) faint: &'static str,
    /// By class, in the order of [`frusta::Class::ALL`].
    pub(crate) classes: [&'static str; 5],
    /// Where a segment was cut.
    pub(crate) cut: &'static str,
    /// Wrong answers.
    pub(crate) wrong: &'static str,
    /// Under the subject of a picture, like a highlighter.
    pub(crate) highlight: &'static str,
}

const LIGHT: Palette = Palette {
    page: "#f4f3ee",
    paper: "#fffefb",
    strong: "#00060d",
    ink: "#33312c",
    faint: "#b9b6ad",
    classes: ["#9a978f", "#b0578d", "#00805d", "#0072b2", "#d55e00"],
    cut: "#8c2d04",
    wrong: "#c4001d",
    highlight: "#ffd84a",
};

const DARK: Palette = Palette {
    page: "#101216",
    paper: "#191c22",
    strong: "#ffffff",
    ink: "#dddad2",
    faint: "#4d525c",
    classes: ["#767b86", "#e29cc5", "#2fc29a", "#56b4e9", "#f0a13a"],
    cut: "#ffe08a",
    wrong: "#ff6b6b",
    highlight: "#8f6f00",
};

impl Theme {
    /// Its colours.
    pub(crate) fn palette(self) -> &'static Palette {
        match self {
            Self::Light => &LIGHT,
            Self::Dark => &DARK,
        }
    }
}
