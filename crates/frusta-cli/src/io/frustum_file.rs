//! Frusta from JSON files: a rect pair, an infinite rect, a camera's
//! parameters, or a matrix.
//!
//! Read key by key and not through `serde`'s derived readers, because an error
//! must name the key and what was expected there, and because any number may
//! be a text that holds a hexadecimal float.

use crate::failure::{Failure, quote, shorten};
use crate::io::MARK;
use crate::io::number;
use crate::view::{Lens, Parameters};
use frusta::frustum::{ClipSpace, ClipY, DepthRange, MatrixFrustum, MatrixLayout, ViewProjection};
use frusta::{Deviation, Direction, EndRect, Frustum, Pose, Rect, Shape, Vec3};
use serde_json::{Map, Value};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The expected contents, for messages.
const EXPECTED: &str = "expected an object with origin, axes, near and far (a rect pair), with \
     slopes and direction instead of far (infinite), with eye and target (a camera), or with matrix";

/// The longest file that is read, in bytes.
const LONGEST: u64 = 1 << 20;

/// Reads a file.
pub(crate) fn read(file: &Path) -> Result<(Frustum, Option<Deviation>), Failure> {
    let mut text = Vec::new();
    let read = File::open(file).and_then(|f| f.take(LONGEST + 1).read_to_end(&mut text));
    read.map_err(|e| Failure::in_file(file, e))?;
    from_text(file, &text)
}

/// The frustum in a file's text. With one from a matrix comes what the conversion missed.
///
/// # Errors
/// The text is no frustum; the message begins with `file`.
pub fn from_text(file: &Path, text: &[u8]) -> Result<(Frustum, Option<Deviation>), Failure> {
    if text.len() as u64 > LONGEST {
        let why = format!("it is longer than {LONGEST} bytes; is this a frustum?");
        return Err(Failure::in_file(file, why));
    }
    let text = text.strip_prefix(MARK).unwrap_or(text);
    let value: Value = serde_json::from_slice(text)
        .map_err(|e| Failure::in_file(file, format_args!("not JSON: {}", shorten(e))))?;
    parse(&value).map_err(|why| Failure::in_file(file, why))
}

fn parse(value: &Value) -> Result<(Frustum, Option<Deviation>), String> {
    let Value::Object(map) = value else {
        return Err(format!("found {}; {EXPECTED}", kind(value)));
    };
    let object = Object { path: "", map };
    if map.contains_key("matrix") {
        let found = matrix(&object)?;
        let deviation = found.deviation();
        Ok((found.frustum, Some(deviation)))
    } else if map.contains_key("eye") || map.contains_key("target") {
        Ok((camera(&object)?, None))
    } else if map.contains_key("axes") || map.contains_key("origin") {
        Ok((rects(&object)?, None))
    } else {
        Err(EXPECTED.to_owned())
    }
}

fn rects(object: &Object<'_>) -> Result<Frustum, String> {
    let infinite = object.map.contains_key("slopes") || object.map.contains_key("direction");
    object.only(if infinite {
        &["origin", "axes", "near", "slopes", "direction"]
    } else {
        &["origin", "axes", "near", "far"]
    })?;
    let pose = Pose::new(object.vector("origin")?, object.axes("axes")?);
    let near = object.end("near")?;
    let shape = if infinite {
        let slopes = object.child("slopes")?;
        slopes.only(&["left", "right", "bottom", "top"])?;
        Shape::Infinite {
            near,
            slopes: slopes.rect()?,
            direction: match object.number("direction")? {
                1.0 => Direction::PlusZ,
                -1.0 => Direction::MinusZ,
                other => return Err(format!("direction: found {other:?}; expected 1 or -1")),
            },
        }
    } else {
        Shape::Finite {
            near,
            far: object.end("far")?,
        }
    };
    Frustum::new(pose, shape).map_err(|e| e.to_string())
}

fn camera(object: &Object<'_>) -> Result<Frustum, String> {
    object.only(&[
        "eye",
        "target",
        "up",
        "fovy_deg",
        "ortho_height",
        "aspect",
        "near",
        "far",
    ])?;
    let has = |key: &str| object.map.contains_key(key);
    let lens = match (has("fovy_deg"), has("ortho_height")) {
        (true, true) => return Err("fovy_deg and ortho_height exclude each other".to_owned()),
        (false, true) => Lens::Ortho(object.number("ortho_height")?),
        _ => Lens::Fovy(object.number("fovy_deg")?),
    };
    let far = match object.map.get("far") {
        Some(Value::String(text)) if text == "inf" => f64::INFINITY,
        _ => object.number("far")?,
    };
    Parameters {
        eye: object.vector("eye")?,
        target: object.vector("target")?,
        up: object.vector("up")?,
        lens,
        aspect: object.number("aspect")?,
        near: object.number("near")?,
        far,
    }
    .frustum()
    .map_err(|e| e.to_string())
}

fn matrix(object: &Object<'_>) -> Result<MatrixFrustum, String> {
    object.only(&["matrix", "layout", "depth", "reversed", "y", "precision"])?;
    let numbers = object.numbers::<16>("matrix")?;
    let layout = match object.choice("layout", &["column-major", "row-major"], false)? {
        0 => MatrixLayout::ColumnMajorColumnVectors,
        _ => MatrixLayout::RowMajorColumnVectors,
    };
    let clip = ClipSpace {
        depth: match object.choice("depth", &["0..1", "-1..1"], false)? {
            0 => DepthRange::ZeroToOne,
            _ => DepthRange::MinusOneToOne,
        },
        reversed: match object.map.get("reversed") {
            None => false,
            Some(Value::Bool(reversed)) => *reversed,
            Some(other) => return Err(wrong("reversed", other, "true or false")),
        },
        y: match object.choice("y", &["up", "down"], true)? {
            0 => ClipY::Up,
            _ => ClipY::Down,
        },
    };
    // The precision bounds the rounding errors of the entries.
    let found = match object.choice("precision", &["f64", "f32"], true)? {
        0 => ViewProjection::from_flat(numbers, layout).frustum(clip),
        _ => ViewProjection::from_flat(numbers.map(|e| e as f32), layout).frustum(clip),
    };
    found.map_err(|e| format!("matrix: {e}"))
}

/// An object and where in the file it is.
struct Object<'a> {
    path: &'a str,
    map: &'a Map<String, Value>,
}

impl<'a> Object<'a> {
    fn key(&self, key: &str) -> String {
        if self.path.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.path)
        }
    }

    /// Refuses any other key: a misspelt one must not go unnoticed.
    fn only(&self, known: &[&str]) -> Result<(), String> {
        match self.map.keys().find(|k| !known.contains(&k.as_str())) {
            Some(other) => Err(format!(
                "unknown key {}; expected {}",
                quote(&self.key(other)),
                known.join(", ")
            )),
            None => Ok(()),
        }
    }

    fn get(&self, key: &str, expected: &str) -> Result<&'a Value, String> {
        self.map
            .get(key)
            .ok_or_else(|| format!("{} is missing; expected {expected}", self.key(key)))
    }

    fn number(&self, key: &str) -> Result<f64, String> {
        to_number(&self.key(key), self.get(key, NUMBER)?)
    }

    fn numbers<const N: usize>(&self, key: &str) -> Result<[f64; N], String> {
        to_numbers(&self.key(key), self.get(key, &numbers(N))?)
    }

    fn vector(&self, key: &str) -> Result<Vec3<f64>, String> {
        self.numbers::<3>(key).map(Vec3::from)
    }

    fn axes(&self, key: &str) -> Result<[Vec3<f64>; 3], String> {
        const EXPECTED: &str = "three axes of three numbers each";
        let value = self.get(key, EXPECTED)?;
        let Some(rows) = value.as_array().filter(|rows| rows.len() == 3) else {
            return Err(wrong(&self.key(key), value, EXPECTED));
        };
        let mut axes = [Vec3::default(); 3];
        for (i, (axis, row)) in axes.iter_mut().zip(rows).enumerate() {
            *axis = to_numbers::<3>(&format!("{}[{i}]", self.key(key)), row)?.into();
        }
        Ok(axes)
    }

    fn child(&self, key: &'a str) -> Result<Object<'a>, String> {
        const EXPECTED: &str = "an object with left, right, bottom and top";
        let value = self.get(key, EXPECTED)?;
        match value {
            Value::Object(map) => Ok(Object { path: key, map }),
            _ => Err(wrong(&self.key(key), value, EXPECTED)),
        }
    }

    fn end(&self, key: &'a str) -> Result<EndRect, String> {
        let end = self.child(key)?;
        end.only(&["z", "left", "right", "bottom", "top"])?;
        Ok(EndRect {
            z: end.number("z")?,
            rect: end.rect()?,
        })
    }

    fn rect(&self) -> Result<Rect, String> {
        Ok(Rect::new(
            self.number("left")?,
            self.number("right")?,
            self.number("bottom")?,
            self.number("top")?,
        ))
    }

    /// One of some texts; the first where the key is missing and `optional`.
    fn choice(&self, key: &str, choices: &[&str], optional: bool) -> Result<usize, String> {
        if optional && !self.map.contains_key(key) {
            return Ok(0);
        }
        let expected = format!("\"{}\"", choices.join("\" or \""));
        let value = self.get(key, &expected)?;
        let found = choices.iter().position(|&c| value.as_str() == Some(c));
        found.ok_or_else(|| wrong(&self.key(key), value, &expected))
    }
}

const NUMBER: &str = "a number (or a text that holds a hexadecimal float)";

fn numbers(count: usize) -> String {
    format!("{count} numbers")
}

fn to_number(path: &str, value: &Value) -> Result<f64, String> {
    match value {
        Value::Number(number) => number
            .as_f64()
            .filter(|v| v.is_finite())
            .ok_or_else(|| wrong(path, value, "a finite number")),
        Value::String(text) => number::parse_finite(text).map_err(|why| format!("{path}: {why}")),
        _ => Err(wrong(path, value, NUMBER)),
    }
}

fn to_numbers<const N: usize>(path: &str, value: &Value) -> Result<[f64; N], String> {
    let Some(items) = value.as_array().filter(|items| items.len() == N) else {
        return Err(wrong(path, value, &numbers(N)));
    };
    let mut out = [0.0; N];
    for (i, (out, item)) in out.iter_mut().zip(items).enumerate() {
        *out = to_number(&format!("{path}[{i}]"), item)?;
    }
    Ok(out)
}

fn wrong(path: &str, value: &Value, expected: &str) -> String {
    format!("{path}: found {}; expected {expected}", kind(value))
}

fn kind(value: &Value) -> String {
    match value {
        Value::Null => "null".to_owned(),
        Value::Bool(b) => b.to_string(),
        Value::Number(n) => n.to_string(),
        Value::String(text) => quote(text),
        Value::Array(items) => format!("an array of {}", items.len()),
        Value::Object(_) => "an object".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::corruption::{Corruption, check_message};

    #[test]
    fn corrupted_files_are_read_or_refused_and_never_panic() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/");
        let mut samples = ["camera", "infinite", "pair"]
            .map(|name| std::fs::read(format!("{folder}{name}.json")).unwrap())
            .to_vec();
        samples.push(
            b"\xef\xbb\xbf{\"matrix\": [1.5, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.2, -1, 0, 0, -0.22, 0],\n\
              \"layout\": \"column-major\", \"depth\": \"-1..1\", \"reversed\": false,\n\
              \"y\": \"down\", \"precision\": \"f32\"}\n"
                .to_vec(),
        );
        let file = Path::new("a.json");
        let mut corruption = Corruption::new();
        let (mut whole, mut refused) = (0, 0);
        for round in 0..20_000 {
            let sample = &samples[round % samples.len()];
            if round < samples.len() {
                from_text(file, sample).unwrap();
            }
            match from_text(file, &corruption.of(sample)) {
                Ok((frustum, _)) => {
                    whole += 1;
                    // All of its numbers are finite.
                    let text = format!("{:?}", frustum.pose());
                    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
                }
                Err(failure) => {
                    refused += 1;
                    check_message(&failure, "a.json");
                }
            }
        }
        assert!(whole > 1000 && refused > 1000, "{whole} {refused}");
    }
}
