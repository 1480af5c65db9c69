//! glTF 2.0, binary: the parts as lines, a primitive for each class.
//!
//! The container wants all lengths first, so points wait in nameless temporary
//! files, one a class, and memory stays constant. Points are in single
//! precision, as the format has it; where the frustum is far from the origin they
//! are relative to a point near it, which the node's translation adds again.

use crate::draw::Palette;
use crate::failure::Failure;
use crate::io::atomic_file::AtomicFile;
use crate::io::number::Scalar;
use frusta::{Class, Corners, FarCorners, Frustum, SegmentClip, Vec3};
use serde_json::{Value, json};
use std::fs::File;
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};

/// Bytes of a point.
const POINT: u64 = 12;
/// glTF's codes for a buffer of vertices, a float, points and lines.
const VERTICES: u32 = 34962;
const FLOAT: u32 = 5126;
const POINTS: u32 = 0;
const LINES: u32 = 1;

/// Points are relative to a centre if that is more than this many times farther than
/// the frustum is wide: beyond, single precision loses ten bits.
const FAR: f64 = 1024.0;

/// The points of a class in a chunk.
#[derive(Clone, Debug)]
pub(super) struct Points {
    bytes: Vec<u8>,
    low: [f32; 3],
    high: [f32; 3],
}

impl Default for Points {
    fn default() -> Self {
        Self {
            bytes: Vec::new(),
            low: [f32::INFINITY; 3],
            high: [f32::NEG_INFINITY; 3],
        }
    }
}

/// The point that all points are relative to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Centre(Vec3<f64>);

impl Centre {
    /// The origin, or a point near a frustum that is far from it.
    pub(crate) fn of(frustum: &Frustum) -> Self {
        let Corners { near, far } = frustum.corners();
        let far = match far {
            FarCorners::Points(far) => far,
            FarCorners::Directions(_) => near,
        };
        let middle = (near[0] + near[2]) * 0.5;
        let width = |v: Vec3<f64>| {
            v.to_array()
                .into_iter()
                .fold(0.0, |m: f64, c| m.max(c.abs()))
        };
        let corners = near.iter().chain(&far);
        let size = corners
            .map(|&corner| width(corner - near[0]))
            .fold(0.0, f64::max);
        let single = Vec3::from(middle.to_array().map(|c| f64::from(c as f32)));
        Self(if width(middle) > FAR * size && single.is_finite() {
            single
        } else {
            Vec3::default()
        })
    }
}

/// Collects the points of all parts, by class. `Err` is a coordinate that is too
/// large.
pub(super) fn format<T: Scalar>(
    centre: &Centre,
    clips: &[SegmentClip<T>],
) -> Result<[Points; 5], f64> {
    let mut all: [Points; 5] = Default::default();
    for clip in clips {
        let Some(ends) = clip.points() else {
            continue;
        };
        let of_class = &mut all[clip.class as usize];
        let count = if clip.class == Class::Touch { 1 } else { 2 };
        for end in &ends[..count] {
            let point = (end.to_f64() - centre.0).to_array();
            for (k, value) in point.into_iter().enumerate() {
                let single = value as f32;
                if !single.is_finite() {
                    return Err(value);
                }
                of_class.low[k] = of_class.low[k].min(single);
                of_class.high[k] = of_class.high[k].max(single);
                of_class.bytes.extend(single.to_le_bytes());
            }
        }
    }
    Ok(all)
}

/// A file in the making.
pub(crate) struct Model {
    centre: Centre,
    classes: Vec<Spool>,
}

/// A class's points.
struct Spool {
    file: BufWriter<File>,
    count: u64,
    /// Without their bytes.
    bounds: Points,
}

impl Model {
    /// Without any points.
    pub(super) fn new(centre: Centre) -> Result<Self, Failure> {
        let spool = |_: &Class| {
            Ok(Spool {
                file: BufWriter::new(tempfile::tempfile().map_err(|e| spoiled(&e))?),
                count: 0,
                bounds: Points::default(),
            })
        };
        Ok(Self {
            centre,
            classes: Class::ALL
                .iter()
                .map(spool)
                .collect::<Result<_, Failure>>()?,
        })
    }

    /// Adds a chunk's points.
    pub(super) fn add(&mut self, chunk: &[Points; 5]) -> Result<(), Failure> {
        for (spool, points) in self.classes.iter_mut().zip(chunk) {
            spool
                .file
                .write_all(&points.bytes)
                .map_err(|e| spoiled(&e))?;
            spool.count += points.bytes.len() as u64 / POINT;
            for k in 0..3 {
                spool.bounds.low[k] = spool.bounds.low[k].min(points.low[k]);
                spool.bounds.high[k] = spool.bounds.high[k].max(points.high[k]);
            }
        }
        Ok(())
    }

    /// Writes the container.
    pub(super) fn write(
        mut self,
        out: &mut AtomicFile,
        title: &str,
        palette: &Palette,
    ) -> Result<(), Failure> {
        let total: u64 = self.classes.iter().map(|s| s.count * POINT).sum();
        let mut text = self
            .document(title, palette, total)
            .to_string()
            .into_bytes();
        while !text.len().is_multiple_of(4) {
            text.push(b' ');
        }
        let length = 12 + 8 + text.len() as u64 + if total > 0 { 8 + total } else { 0 };
        let Ok(length) = u32::try_from(length) else {
            let why = format!("the parts take {total} bytes; GLB has room for 4294967295");
            return Err(Failure::new(why));
        };
        out.write(b"glTF\x02\0\0\0")?;
        out.write(&length.to_le_bytes())?;
        out.write(&(text.len() as u32).to_le_bytes())?;
        out.write(b"JSON")?;
        out.write(&text)?;
        if total > 0 {
            out.write(&(total as u32).to_le_bytes())?;
            out.write(b"BIN\0")?;
        }
        let mut piece = vec![0; 1 << 16];
        for spool in &mut self.classes {
            spool
                .file
                .seek(SeekFrom::Start(0))
                .map_err(|e| spoiled(&e))?;
            loop {
                let count = spool
                    .file
                    .get_mut()
                    .read(&mut piece)
                    .map_err(|e| spoiled(&e))?;
                if count == 0 {
                    break;
                }
                out.write(&piece[..count])?;
            }
        }
        Ok(())
    }

    fn document(&self, title: &str, palette: &Palette, total: u64) -> Value {
        let mut views = Vec::new();
        let mut accessors = Vec::new();
        let mut materials = Vec::new();
        let mut primitives = Vec::new();
        let mut start = 0;
        for (class, spool) in Class::ALL.iter().zip(&self.classes) {
            if spool.count == 0 {
                continue;
            }
            let number = accessors.len();
            let length = spool.count * POINT;
            views.push(json!({
                "buffer": 0, "byteOffset": start, "byteLength": length, "target": VERTICES,
            }));
            accessors.push(json!({
                "bufferView": number, "componentType": FLOAT, "count": spool.count, "type": "VEC3",
                "min": spool.bounds.low, "max": spool.bounds.high,
            }));
            materials.push(json!({
                "name": class.name(),
                "pbrMetallicRoughness": {"baseColorFactor": linear(palette.classes[*class as usize])},
                "extensions": {"KHR_materials_unlit": {}},
            }));
            let mode = if *class == Class::Touch {
                POINTS
            } else {
                LINES
            };
            primitives.push(json!({
                "attributes": {"POSITION": number}, "material": number, "mode": mode,
                "extras": {"class": class.name()},
            }));
            start += length;
        }
        let mut node = json!({"name": title, "translation": self.centre.0.to_array()});
        let mut document = json!({
            "asset": {"version": "2.0", "generator": concat!("frusta ", env!("CARGO_PKG_VERSION"))},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
        });
        // glTF allows no empty lists.
        if total > 0 {
            node["mesh"] = json!(0);
            document["extensionsUsed"] = json!(["KHR_materials_unlit"]);
            document["buffers"] = json!([{"byteLength": total}]);
            document["bufferViews"] = json!(views);
            document["accessors"] = json!(accessors);
            document["materials"] = json!(materials);
            document["meshes"] = json!([{"name": "parts", "primitives": primitives}]);
        }
        document["nodes"] = json!([node]);
        document
    }
}

/// glTF's linear red, green, blue and alpha of `#rrggbb`.
fn linear(colour: &str) -> [f64; 4] {
    let channel = |k: usize| {
        let digits = colour.get(1 + 2 * k..3 + 2 * k).unwrap_or("00");
        let value = f64::from(u8::from_str_radix(digits, 16).unwrap_or(0)) / 255.0;
        let linear = if value <= 0.040_45 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        };
        // Enough digits for any screen, and the same everywhere.
        (linear * 1e4).round() / 1e4
    };
    [channel(0), channel(1), channel(2), 1.0]
}

fn spoiled(why: &std::io::Error) -> Failure {
    Failure::new(format_args!("a temporary file: {why}"))
}
