//! GeoJSON: line strings and the rings of polygons, as a stream of features.
//!
//! A collection is read feature by feature, so that memory is that of the largest
//! feature. Points are passed over. A position is longitude, latitude and, if there is one, height;
//! they are taken as x, y, z, or as degrees and metres on an ellipsoid.
//!
//! The `geojson` crate reads a feature. Its own reader of collections takes the
//! file's first `[` for the list of features, which a `bbox` before it breaks, so
//! the collection around the features is read here.

use super::{Contents, Format, Input, Positions, ReadOptions, Stream, Take, wgs84};
use crate::failure::{Failure, shorten};
use frusta::{Segment, Vec3};
use geojson::{Feature, GeoJson, Geometry, GeometryValue, Position};
use serde::Deserializer as _;
use serde::de::{DeserializeSeed, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use std::fmt;

/// The format: a geometry, a feature or a collection.
pub(super) struct Geojson;

impl Format for Geojson {
    fn name(&self) -> &'static str {
        "geojson"
    }

    fn description(&self) -> &'static str {
        "GeoJSON"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["geojson", "json"]
    }

    fn is_geographic(&self) -> bool {
        true
    }

    fn open(&self, input: &Input, options: ReadOptions) -> Result<Contents, Failure> {
        let read =
            move |input: &Input, take: &mut Take<'_>| document(input, options.positions, take);
        Ok(Contents::Stream(Stream::new(input, None, read)))
    }
}

/// Reads a document.
fn document(input: &Input, positions: Positions, take: &mut Take<'_>) -> Result<(), Failure> {
    let mut walk = Walk::new(positions, take);
    let mut parser = serde_json::Deserializer::from_reader(input.open()?);
    let read = parser.deserialize_map(Document(&mut walk));
    let read = read.and_then(|rest| parser.end().map(|()| rest));
    let fault = walk.fault.take();
    let read = walk.settle(read, |e| match fault {
        Some(why) => input.failure(why),
        None => input.failure(not_geojson(&e)),
    });
    if let Some(rest) = read? {
        let alone = serde_json::from_value::<GeoJson>(Value::Object(rest));
        let alone = alone.map_err(|e| input.failure(not_geojson(&e)))?;
        let walked = walk.json(&alone);
        walk.settle(walked, |why| input.failure(why))?;
    }
    Ok(())
}

pub(super) fn not_geojson(why: &serde_json::Error) -> String {
    format!("not GeoJSON: {}", shorten(why))
}

/// Gives the segments of geometries.
pub(super) struct Walk<'a, 'b> {
    positions: Positions,
    take: &'a mut Take<'b>,
    /// Number of features begun.
    pub(super) feature: u64,
    /// The failure of `take`, if there was one.
    stopped: Option<Failure>,
    /// The fault of a position, if that ended the reading.
    fault: Option<Reason>,
}

/// Why a walk ended early.
type Reason = String;

impl<'a, 'b> Walk<'a, 'b> {
    pub(super) fn new(positions: Positions, take: &'a mut Take<'b>) -> Self {
        Self {
            positions,
            take,
            feature: 0,
            stopped: None,
            fault: None,
        }
    }

    /// A result's failure; the one from `take` before any other.
    pub(super) fn settle<T, E>(
        &mut self,
        read: Result<T, E>,
        fail: impl FnOnce(E) -> Failure,
    ) -> Result<T, Failure> {
        read.map_err(|e| self.stopped.take().unwrap_or_else(|| fail(e)))
    }

    pub(super) fn json(&mut self, json: &GeoJson) -> Result<(), Reason> {
        match json {
            GeoJson::Geometry(geometry) => self.numbered(Some(geometry)),
            GeoJson::Feature(feature) => self.feature(feature),
            GeoJson::FeatureCollection(list) => {
                list.features.iter().try_for_each(|f| self.feature(f))
            }
        }
    }

    fn feature(&mut self, feature: &Feature) -> Result<(), Reason> {
        self.numbered(feature.geometry.as_ref())
    }

    /// A feature's geometry, or one alone.
    fn numbered(&mut self, geometry: Option<&Geometry>) -> Result<(), Reason> {
        let number = self.feature;
        self.feature += 1;
        let walked = geometry.map_or(Ok(()), |geometry| self.geometry(geometry));
        walked.map_err(|why| format!("feature {number}: {why}"))
    }

    fn geometry(&mut self, geometry: &Geometry) -> Result<(), Reason> {
        match &geometry.value {
            GeometryValue::Point { .. } | GeometryValue::MultiPoint { .. } => Ok(()),
            GeometryValue::LineString { coordinates } => self.line(coordinates, false),
            GeometryValue::MultiLineString { coordinates } => {
                coordinates.iter().try_for_each(|l| self.line(l, false))
            }
            GeometryValue::Polygon { coordinates } => {
                coordinates.iter().try_for_each(|r| self.line(r, true))
            }
            GeometryValue::MultiPolygon { coordinates } => coordinates
                .iter()
                .flatten()
                .try_for_each(|r| self.line(r, true)),
            GeometryValue::GeometryCollection { geometries } => {
                geometries.iter().try_for_each(|g| self.geometry(g))
            }
        }
    }

    /// The segments between neighbours; a ring that its file leaves open is
    /// closed.
    fn line(&mut self, line: &[Position], is_ring: bool) -> Result<(), Reason> {
        let mut points = line.iter();
        let Some(first) = points.next() else {
            return Ok(());
        };
        let first = self.point(first)?;
        let mut last = first;
        for position in points {
            let next = self.point(position)?;
            self.give(last, next)?;
            last = next;
        }
        if is_ring && last != first {
            self.give(last, first)?;
        }
        Ok(())
    }

    fn give(&mut self, start: Vec3<f64>, end: Vec3<f64>) -> Result<(), Reason> {
        (self.take)(Segment { start, end }).map_err(|failure| {
            let reason = failure.to_string();
            self.stopped = Some(failure);
            reason
        })
    }

    fn point(&self, position: &Position) -> Result<Vec3<f64>, Reason> {
        let (x, y, z) = match *position.as_slice() {
            [x, y] => (x, y, 0.0),
            [x, y, z, ..] => (x, y, z),
            [..] => return Err("a position has fewer than two numbers".to_owned()),
        };
        match self.positions {
            Positions::AsGiven => Ok(Vec3::new(x, y, z)),
            Positions::Ecef => wgs84::ecef(x, y, z),
        }
    }
}

/// A document's outermost object: gives the features of a collection; anything
/// else is handed back whole.
struct Document<'w, 'a, 'b>(&'w mut Walk<'a, 'b>);

impl<'de> Visitor<'de> for Document<'_, '_, '_> {
    type Value = Option<Map<String, Value>>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a GeoJSON object")
    }

    fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Self::Value, M::Error> {
        let mut others = Map::new();
        let mut found = false;
        while let Some(key) = map.next_key::<String>()? {
            if key == "features" {
                found = true;
                map.next_value_seed(Features(self.0))?;
            } else if found && key != "type" {
                map.next_value::<IgnoredAny>()?;
            } else {
                others.insert(key, map.next_value()?);
            }
        }
        if !found {
            return Ok(Some(others));
        }
        match others.get("type").and_then(Value::as_str) {
            Some("FeatureCollection") => Ok(None),
            _ => Err(M::Error::custom(
                "an object with features must have the type FeatureCollection",
            )),
        }
    }
}

/// A collection's list of features.
struct Features<'w, 'a, 'b>(&'w mut Walk<'a, 'b>);

impl<'de> DeserializeSeed<'de> for Features<'_, '_, '_> {
    type Value = ();

    fn deserialize<D: serde::Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Features<'_, '_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of features")
    }

    fn visit_seq<S: SeqAccess<'de>>(self, mut list: S) -> Result<(), S::Error> {
        loop {
            let number = self.0.feature;
            let next = list.next_element::<Feature>();
            let next = next.map_err(|e| S::Error::custom(format_args!("feature {number}: {e}")))?;
            let Some(feature) = next else {
                return Ok(());
            };
            if let Err(why) = self.0.feature(&feature) {
                self.0.fault = Some(why);
                return Err(S::Error::custom("a feature is invalid"));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::{corruption, open};

    fn read(input: &Input, positions: Positions) -> Result<Vec<Segment<f64>>, Failure> {
        let edges = None;
        let Contents::Stream(stream) = open(input, ReadOptions { edges, positions })? else {
            panic!("GeoJSON is a stream");
        };
        let mut out = Vec::new();
        stream.read(&mut |segment| {
            out.push(segment);
            Ok(())
        })?;
        Ok(out)
    }

    #[test]
    fn corrupted_files_are_read_or_refused_and_never_panic() {
        let line = r#"{"type": "LineString", "coordinates": [[0, 0], [10, 20.5], [1e1, 30, 7]]}"#;
        let polygon = r#"{"type": "Polygon", "coordinates": [[[0, 0], [10, 0], [0, 10]], [[1, 1],
            [2, 1], [1, 2], [1, 1]]]}"#;
        let several = format!(
            "{{\"type\": \"GeometryCollection\", \"geometries\": [{line}, {polygon},
            {{\"type\": \"Point\", \"coordinates\": [1, 2]}}]}}"
        );
        let feature = |geometry: &str| {
            format!(
                "{{\"type\": \"Feature\", \"properties\": {{\"a\": 1}}, \"geometry\": {geometry}}}"
            )
        };
        let list = [feature(line), feature(&several), feature("null")];
        let whole = format!(
            "{{\"type\": \"FeatureCollection\", \"bbox\": [0, 0, 1, 1],\n\"features\": [\n{}\n]}}",
            list.join(",\n")
        );
        let samples = [whole, several.clone(), feature(polygon)].map(String::into_bytes);
        for positions in [Positions::AsGiven, Positions::Ecef] {
            corruption::check("a.json", &samples, 15_000, |input| read(input, positions));
        }
        let sequence = format!("\u{1e}{}\n\u{1e}{several}\n{line}\n", list.join("\n"));
        let samples = [sequence.into_bytes()];
        corruption::check("a.ndjson", &samples, 10_000, |input| {
            read(input, Positions::AsGiven)
        });
    }
}
