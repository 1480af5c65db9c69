//! From sums of ink to colours, by histogram equalisation.
//!
//! A pixel's tone is its rank among all inked pixels of its layer, so that
//! sparse and dense regions alike use the whole range of tones: what datashader
//! (datashader.org) calls `eq_hist`. Tones go from near the paper's colour through
//! the layer's own to near the ink's.

use super::density::{Density, FULL};
use super::layer::Layer;
use crate::draw::Palette;
use crate::failure::Failure;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use png::{BitDepth, ColorType, Compression, Encoder};

/// Red, green, blue.
type Rgb = [u8; 3];

/// Bits of a sum that its bin keeps.
const BITS: u32 = 7;
/// Tones for which colours are prepared.
const TONES: usize = 256;

/// Ranks of sums.
struct Equaliser {
    /// By bin, from 0 to 1.
    ranks: Vec<f32>,
}

impl Equaliser {
    /// From all sums that are not zero.
    fn new(sums: impl Iterator<Item = u64>) -> Self {
        let mut counts = vec![0_u64; bin(u64::MAX) + 1];
        for sum in sums {
            counts[bin(sum)] += 1;
        }
        counts[0] = 0;
        let total = counts.iter().sum::<u64>().max(1) as f32;
        let mut below = 0;
        // The middle of those with the same sum.
        let rank = |&count: &u64| {
            let rank = (below as f32 + 0.5 * count as f32) / total;
            below += count;
            rank
        };
        Self {
            ranks: counts.iter().map(rank).collect(),
        }
    }

    /// A sum's rank; never less than a lower sum's.
    fn rank(&self, sum: u64) -> f32 {
        self.ranks[bin(sum)]
    }
}

/// Sums by size, with a relative width below 1 %.
fn bin(sum: u64) -> usize {
    let shift = (u64::BITS - (sum >> BITS).leading_zeros()).saturating_sub(1);
    (shift << BITS) as usize + (sum >> shift) as usize
}

/// The picture of all layers over each other, as the address of an embedded PNG.
pub(super) fn image(density: &Density, palette: &Palette) -> Result<String, Failure> {
    let [width, height] = density.size();
    let mut pixels = vec![rgb(palette.paper); width * height];
    for layer in Layer::ALL {
        paint(&mut pixels, density, layer, palette);
    }
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(pixels.as_flattened()))
        .map_err(|e| Failure::new(format_args!("drawing a picture: {e}")))?;
    Ok(format!(
        "data:image/png;base64,{}",
        BASE64_STANDARD.encode(file)
    ))
}

/// Paints a layer over the others.
fn paint(pixels: &mut [Rgb], density: &Density, layer: Layer, palette: &Palette) {
    let (Some(sums), Some(again)) = (density.sums(layer), density.sums(layer)) else {
        return;
    };
    let equaliser = Equaliser::new(sums);
    let colours = ramp(layer, palette);
    for (pixel, sum) in pixels.iter_mut().zip(again) {
        if sum > 0 {
            let tone = (equaliser.rank(sum) * (TONES - 1) as f32) as usize;
            // Rare layers have thin rims; the common ones' are pale.
            let cover = match layer {
                Layer::Outside | Layer::Inside => 1.0,
                _ => (sum as f32 / FULL as f32).min(1.0),
            };
            *pixel = mix(*pixel, colours[tone], cover);
        }
    }
}

/// A layer's colours from its sparsest place to its densest.
fn ramp(layer: Layer, palette: &Palette) -> [Rgb; TONES] {
    let [paper, strong] = [palette.paper, palette.strong].map(rgb);
    let own = rgb(layer.style(palette).colour);
    // Where the ramp begins and ends: how far from its own colour to the paper's
    // and to the strongest. Rare layers are as strong everywhere as they can be.
    let (sparse, dense) = match layer {
        Layer::Outside => (0.85, -0.35),
        Layer::Rest => (0.75, -0.35),
        Layer::Inside | Layer::Boundary => (0.8, 0.8),
        Layer::Cross => (0.25, 0.1),
        Layer::Touch | Layer::Cut => (0.0, 0.0),
    };
    std::array::from_fn(|i| {
        let tone = i as f32 / (TONES - 1) as f32;
        let at = -sparse + tone * (sparse + dense);
        if at < 0.0 {
            mix(own, paper, -at)
        } else {
            mix(own, strong, at)
        }
    })
}

/// Some of a layer's colours, `#rrggbb`, for a legend.
pub(super) fn samples(layer: Layer, palette: &Palette, count: usize) -> Vec<String> {
    let ramp = ramp(layer, palette);
    let step = (TONES - 1) / (count - 1).max(1);
    let text = |i: usize| {
        let [r, g, b] = ramp[i * step];
        format!("#{r:02x}{g:02x}{b:02x}")
    };
    (0..count).map(text).collect()
}

fn mix(from: Rgb, to: Rgb, part: f32) -> Rgb {
    std::array::from_fn(|i| {
        let (from, to) = (f32::from(from[i]), f32::from(to[i]));
        (from + (to - from) * part).round() as u8
    })
}

/// From `#rrggbb`; black if it is malformed.
fn rgb(text: &str) -> Rgb {
    let byte = |i: usize| {
        let digits = text.get(2 * i + 1..2 * i + 3).unwrap_or("0");
        u8::from_str_radix(digits, 16).unwrap_or(0)
    };
    [byte(0), byte(1), byte(2)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_go_up_one_by_one() {
        assert_eq!((bin(0), bin(1), bin(255), bin(256)), (0, 1, 255, 256));
        let sums = (0..100_000).chain((0..30).map(|i| 200_000 << (i / 3)));
        let bins: Vec<usize> = sums.map(bin).collect();
        assert!(bins.windows(2).all(|b| b[0] <= b[1]));
        assert!(bins[..99_999].windows(2).all(|b| b[1] <= b[0] + 1));
    }

    #[test]
    fn more_ink_is_never_a_weaker_tone_and_tones_are_used_evenly() {
        let sums: Vec<u64> = (1..2000_u64).map(|i| i * i % 70_001).collect();
        let equaliser = Equaliser::new(sums.iter().copied());
        let mut sorted = sums.clone();
        sorted.sort_unstable();
        let ranks: Vec<f32> = sorted.iter().map(|&s| equaliser.rank(s)).collect();
        assert!(ranks.windows(2).all(|r| r[0] <= r[1]));
        assert!(ranks.iter().all(|r| (0.0..=1.0).contains(r)));
        let dark = ranks.iter().filter(|&&r| r > 0.5).count();
        assert!((950..1050).contains(&dark), "{dark}");
    }

    #[test]
    fn colours_are_read_and_mixed() {
        assert_eq!(rgb("#ff8000"), [255, 128, 0]);
        assert_eq!(rgb("?"), [0; 3]);
        assert_eq!(mix([0; 3], [100; 3], 0.25), [25; 3]);
    }
}
