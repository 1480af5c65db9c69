//! The bytes behind glTF accessors, read with every length checked.
//!
//! The `gltf` crate's own readers panic where an accessor's count, stride or
//! sparse part lies; these return an error that names the accessor. Nothing is
//! allocated that the file does not back with bytes.

use crate::failure::{Failure, shorten};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use frusta::Vec3;
use gltf::accessor::{DataType, Dimensions};
use gltf::json;
use gltf::json::validation::Checked;
use percent_encoding::percent_decode_str;
use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt::Display;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// A document and its buffers.
pub(super) struct Data<'a> {
    root: &'a json::Root,
    /// Number of points in meshes from accessors without a view.
    bare: u64,
    buffers: Vec<Cow<'a, [u8]>>,
}

impl<'a> Data<'a> {
    /// Loads all buffers: the binary chunk, data URIs, files beside the document.
    pub(super) fn load(
        file: &Path,
        root: &'a json::Root,
        blob: Option<&'a [u8]>,
    ) -> Result<Self, Failure> {
        let mut buffers = Vec::with_capacity(root.buffers.len());
        for (i, buffer) in root.buffers.iter().enumerate() {
            let bytes = match (&buffer.uri, blob) {
                (Some(uri), _) => load_uri(file, uri, buffer.byte_length.0).map(Cow::Owned),
                (None, Some(blob)) if i == 0 => Ok(Cow::Borrowed(blob)),
                (None, _) => Err("it has no uri, and there is no binary chunk for it".to_owned()),
            };
            let place = format_args!("buffer {i}");
            let bytes = bytes.map_err(|why| Failure::at(file, place, why))?;
            let (claimed, have) = (buffer.byte_length.0, bytes.len());
            if (have as u64) < claimed {
                let why = format!("byteLength is {claimed}; there are {have} bytes");
                return Err(Failure::at(file, format_args!("buffer {i}"), why));
            }
            buffers.push(bytes);
        }
        let bare = bare_points(root);
        Ok(Self {
            root,
            bare,
            buffers,
        })
    }

    /// Whether points without a view, which have no bytes behind them, are few enough.
    fn check_bare(&self) -> Result<(), String> {
        const MOST: u64 = 1 << 20;
        if self.bare > MOST {
            return Err(format!(
                "{} points without a buffer view in all; at most {MOST} are read",
                self.bare
            ));
        }
        Ok(())
    }

    /// The part of a buffer that a view shows.
    fn view(&self, index: usize) -> Result<&[u8], String> {
        let view = &self.root.buffer_views[index];
        let start = view.byte_offset.map_or(0, |o| o.0) as usize;
        let bytes = &self.buffers[view.buffer.value()];
        let part = bytes
            .get(start..)
            .and_then(|rest| rest.get(..view.byte_length.0 as usize));
        part.ok_or_else(|| {
            let buffer = view.buffer.value();
            format!("buffer view {index} reaches beyond the end of buffer {buffer}")
        })
    }

    /// `count` elements of `size` bytes in a view from `offset` on.
    fn elements(
        &self,
        view: usize,
        offset: u64,
        size: usize,
        count: u64,
    ) -> Result<Elements<'_>, String> {
        let bytes = self.view(view)?;
        let stride = match self.root.buffer_views[view].byte_stride {
            Some(stride) if stride.0 >= size => stride.0,
            Some(stride) if stride.0 > 0 => {
                return Err(format!(
                    "byteStride is {}; an element takes {size}",
                    stride.0
                ));
            }
            _ => size,
        };
        let needed = count.checked_sub(1).map_or(Some(0), |n| {
            n.checked_mul(stride as u64)?.checked_add(size as u64)
        });
        let have = (bytes.len() as u64).checked_sub(offset);
        match (needed, have) {
            (Some(needed), Some(have)) if needed <= have => {}
            _ => {
                let length = bytes.len();
                return Err(format!(
                    "{count} elements from byte {offset} do not fit buffer view {view} of {length} bytes"
                ));
            }
        }
        Ok(Elements {
            bytes: &bytes[offset as usize..],
            stride,
            size,
            count: count as usize,
        })
    }

    /// The positions of accessors, by accessor; each is prepared once.
    pub(super) fn all_positions(&self, accessors: impl Iterator<Item = usize>) -> PositionSet<'_> {
        let mut all = HashMap::new();
        for index in accessors {
            all.entry(index).or_insert_with(|| {
                let prepared = Positions::new(self, index);
                prepared.map_err(|why| format!("accessor {index}: {why}"))
            });
        }
        PositionSet(all)
    }

    /// An accessor's vertex indices, all below `points`.
    pub(super) fn indices(&self, index: usize, points: u64) -> Result<Vec<u32>, String> {
        let read = || {
            let accessor = &self.root.accessors[index];
            let (kind, dimensions) = types(accessor);
            if dimensions != Dimensions::Scalar
                || !matches!(kind, DataType::U8 | DataType::U16 | DataType::U32)
            {
                return Err("indices must be unsigned SCALARs".to_owned());
            }
            let Some(view) = accessor.buffer_view.filter(|_| accessor.sparse.is_none()) else {
                return Err("sparse indices are not supported".to_owned());
            };
            let offset = accessor.byte_offset.map_or(0, |o| o.0);
            let elements = self.elements(view.value(), offset, kind.size(), accessor.count.0)?;
            let indices: Vec<u32> = elements.iter().map(unsigned).collect();
            match indices.iter().position(|&i| u64::from(i) >= points) {
                Some(at) => Err(format!(
                    "index {at} asks for vertex {} of {points}",
                    indices[at]
                )),
                None => Ok(indices),
            }
        };
        read().map_err(|why| format!("accessor {index}: {why}"))
    }
}

/// Elements in a buffer, all of which are there.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'a> Elements<'a> {
    fn iter(&self) -> impl Iterator<Item = &'a [u8]> {
        let size = self.size;
        let chunks = self.bytes.chunks(self.stride).take(self.count);
        chunks.map(move |chunk| &chunk[..size])
    }

    #[inline]
    fn get(&self, index: u32) -> &'a [u8] {
        &self.bytes[index as usize * self.stride..][..self.size]
    }
}

/// Positions by accessor; an error begins with the accessor.
pub(super) struct PositionSet<'a>(HashMap<usize, Result<Positions<'a>, String>>);

impl<'a> PositionSet<'a> {
    /// An accessor's positions.
    pub(super) fn get(&self, accessor: usize) -> Result<&Positions<'a>, String> {
        match self.0.get(&accessor) {
            Some(Ok(positions)) => Ok(positions),
            Some(Err(why)) => Err(why.clone()),
            None => Err(format!("accessor {accessor}: it has not been prepared")),
        }
    }
}

/// An accessor's points, which are decoded one by one.
pub(super) struct Positions<'a> {
    /// The accessor's index.
    index: usize,
    count: u64,
    kind: DataType,
    normalized: bool,
    /// `None` for zeros.
    elements: Option<Elements<'a>>,
    /// Points that replace those of `elements`.
    sparse: HashMap<u32, &'a [u8]>,
}

impl<'a> Positions<'a> {
    /// Checks everything but the coordinates.
    fn new(data: &'a Data<'_>, index: usize) -> Result<Self, String> {
        let accessor = &data.root.accessors[index];
        let (kind, dimensions) = types(accessor);
        if dimensions != Dimensions::Vec3 {
            return Err("POSITION must be VEC3".to_owned());
        }
        let count = accessor.count.0;
        if count > u64::from(u32::MAX) {
            return Err(format!("{count} points are too many"));
        }
        let size = 3 * kind.size();
        let elements = match accessor.buffer_view {
            Some(view) => {
                let offset = accessor.byte_offset.map_or(0, |o| o.0);
                Some(data.elements(view.value(), offset, size, count)?)
            }
            None => {
                data.check_bare()?;
                None
            }
        };
        let mut replaced = HashMap::new();
        if let Some(sparse) = &accessor.sparse {
            let places = sparse_indices(data, sparse, count)?;
            let values = data.elements(
                sparse.values.buffer_view.value(),
                sparse.values.byte_offset.0,
                size,
                sparse.count.0,
            )?;
            replaced.extend(places.into_iter().zip(values.iter()));
        }
        Ok(Self {
            index,
            count,
            kind,
            normalized: accessor.normalized,
            elements,
            sparse: replaced,
        })
    }

    /// Number of points, below 2^32.
    pub(super) fn len(&self) -> u64 {
        self.count
    }

    /// A point, which must be finite.
    #[inline]
    pub(super) fn point(&self, index: u32) -> Result<Vec3<f64>, String> {
        let replaced = match self.sparse.is_empty() {
            true => None,
            false => self.sparse.get(&index).copied(),
        };
        let bytes = replaced.or_else(|| self.elements.as_ref().map(|e| e.get(index)));
        let Some(bytes) = bytes else {
            return Ok(Vec3::default());
        };
        let size = self.kind.size();
        let at = |k: usize| component(&bytes[k * size..][..size], self.kind, self.normalized);
        let point = Vec3::new(at(0), at(1), at(2));
        if point.is_finite() {
            return Ok(point);
        }
        Err(format!(
            "accessor {}: point {index} is {point}; it must be finite",
            self.index
        ))
    }
}

/// At most `most` bytes of what a buffer names.
fn load_uri(file: &Path, uri: &str, most: u64) -> Result<Vec<u8>, String> {
    if let Some(rest) = uri.strip_prefix("data:") {
        let (_, text) = rest
            .split_once(";base64,")
            .ok_or("its data URI is not base64")?;
        return BASE64_STANDARD
            .decode(text)
            .map_err(|e| format!("its data URI: {e}"));
    }
    if uri.contains("://") {
        return Err("its uri is not a file; only files beside the document are read".to_owned());
    }
    let name = percent_decode_str(uri)
        .decode_utf8()
        .map_err(|_| "its uri is not UTF-8".to_owned())?;
    let path = file.parent().unwrap_or(Path::new("")).join(name.as_ref());
    // The name is the file's own words, of any length.
    let fail = |why: &dyn Display| shorten(format_args!("{}: {why}", path.display()));
    // A device or a named pipe might never end, or never begin.
    let data = path.metadata().map_err(|e| fail(&e))?;
    if !data.is_file() {
        return Err(fail(&"not a regular file"));
    }
    let mut bytes = Vec::new();
    let read = File::open(&path).and_then(|f| f.take(most).read_to_end(&mut bytes));
    read.map_err(|e| fail(&e))?;
    Ok(bytes)
}

fn sparse_indices(
    data: &Data<'_>,
    sparse: &json::accessor::sparse::Sparse,
    count: u64,
) -> Result<Vec<u32>, String> {
    let kind = match sparse.indices.component_type {
        Checked::Valid(kind) => kind.0,
        Checked::Invalid => return Err("sparse: indices of an unknown type".to_owned()),
    };
    let places: Vec<u32> = data
        .elements(
            sparse.indices.buffer_view.value(),
            sparse.indices.byte_offset.0,
            kind.size(),
            sparse.count.0,
        )?
        .iter()
        .map(unsigned)
        .collect();
    match places.iter().find(|&&p| u64::from(p) >= count) {
        Some(place) => Err(format!("sparse: element {place} of {count}")),
        None => Ok(places),
    }
}

/// Number of points in meshes from accessors without a view.
fn bare_points(root: &json::Root) -> u64 {
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let positions = primitives.filter_map(|p| p.attributes.get(&super::POSITIONS));
    let accessors = positions.filter_map(|index| root.accessors.get(index.value()));
    let bare = accessors.filter(|accessor| accessor.buffer_view.is_none());
    bare.fold(0, |sum, accessor| sum.saturating_add(accessor.count.0))
}

fn types(accessor: &json::Accessor) -> (DataType, Dimensions) {
    match (accessor.component_type, accessor.type_) {
        (Checked::Valid(kind), Checked::Valid(dimensions)) => (kind.0, dimensions),
        // The validation has refused it already.
        _ => (DataType::F32, Dimensions::Mat4),
    }
}

/// One component, by glTF's rules for normalized integers.
fn component(bytes: &[u8], kind: DataType, normalized: bool) -> f64 {
    let scaled = |value: f64, most: f64| {
        if normalized {
            (value / most).max(-1.0)
        } else {
            value
        }
    };
    match (kind, bytes) {
        (DataType::I8, &[a]) => scaled(f64::from(a.cast_signed()), 127.0),
        (DataType::U8, &[a]) => scaled(f64::from(a), 255.0),
        (DataType::I16, &[a, b]) => scaled(f64::from(i16::from_le_bytes([a, b])), 32767.0),
        (DataType::U16, &[a, b]) => scaled(f64::from(u16::from_le_bytes([a, b])), 65535.0),
        (DataType::U32, &[a, b, c, d]) => f64::from(u32::from_le_bytes([a, b, c, d])),
        (DataType::F32, &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => f64::NAN,
    }
}

fn unsigned(bytes: &[u8]) -> u32 {
    bytes
        .iter()
        .rev()
        .fold(0, |value, &byte| (value << 8) | u32::from(byte))
}
