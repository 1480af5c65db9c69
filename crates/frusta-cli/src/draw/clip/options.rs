//! The flags of pictures.

use crate::draw::Theme;
use clap::{Args, ValueEnum};

/// `--picture`
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum View {
    /// What the camera sees, hidden lines included
    #[default]
    Camera,
    /// The frustum from the side, behind and above, with what is inside, clipped and outside
    Outside,
}

/// Flags for pictures.
#[derive(Args, Debug, Default)]
#[command(next_help_heading = "Pictures (-o FILE.svg or FILE.png)")]
pub(crate) struct PictureArgs {
    /// What the picture shows [default: camera]
    #[arg(long, value_name = "VIEW")]
    picture: Option<View>,
    /// Its colours [default: light]
    #[arg(long)]
    theme: Option<Theme>,
    /// Its width, 200 to 8000; of a tall one the height, without the caption [default: 1200]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u16).range(200..=8000))]
    width: Option<u16>,
}

/// The same with the defaults filled in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    pub(crate) view: View,
    pub(crate) theme: Theme,
    pub(crate) width: u16,
}

impl PictureArgs {
    /// The first flag given, if any.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let given = [
            (self.picture.is_some(), "--picture"),
            (self.theme.is_some(), "--theme"),
            (self.width.is_some(), "--width"),
        ];
        given
            .iter()
            .find(|(given, _)| *given)
            .map(|(_, name)| *name)
    }

    /// The options, with defaults.
    pub(crate) fn options(&self) -> Options {
        Options {
            view: self.picture.unwrap_or_default(),
            theme: self.theme.unwrap_or_default(),
            width: self.width.unwrap_or(1200),
        }
    }
}
