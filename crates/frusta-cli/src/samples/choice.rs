//! Which solid, which samples, and what a mistyped name may have meant.

use crate::failure::{Failure, quote};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use frusta::samples::{FrameSample, Solid, near_misses, singular_samples};

/// Options that the list and the sheet have in common.
#[derive(Args, Debug)]
pub(super) struct Choice {
    /// The frustum that the samples are about
    #[arg(long, value_name = "NAME", default_value = "symmetric", value_parser = solid())]
    pub(super) solid: Solid,
    /// Also the near misses: on a feature's line or plane, but apart from the frustum
    #[arg(long)]
    pub(super) near_misses: bool,
}

impl Choice {
    /// The chosen samples, by feature.
    pub(super) fn samples(&self) -> Vec<FrameSample> {
        samples(&self.solid, self.near_misses)
    }
}

/// A solid's samples; each feature's near miss, if wanted, after its others.
pub(super) fn samples(solid: &Solid, with_near_misses: bool) -> Vec<FrameSample> {
    let singular = singular_samples(solid);
    if !with_near_misses {
        return singular;
    }
    let by_feature = singular.chunks(3).zip(near_misses(solid));
    let joined = by_feature.flat_map(|(three, miss)| three.iter().cloned().chain([miss]));
    joined.collect()
}

/// Reads a solid's name; `clap` lists all names if it is unknown.
pub(super) fn solid() -> impl TypedValueParser<Value = Solid> {
    let names = PossibleValuesParser::new(Solid::ALL.map(|s| s.name));
    names.try_map(|name| {
        let found = Solid::ALL.into_iter().find(|s| s.name == name);
        found.ok_or("no such solid")
    })
}

/// The sample of that name, near misses included.
pub(super) fn find(solid: &Solid, name: &str) -> Result<FrameSample, Failure> {
    let mut all = samples(solid, true);
    if let Some(i) = all.iter().position(|s| s.name() == name) {
        return Ok(all.swap_remove(i));
    }
    let names: Vec<String> = all.iter().map(FrameSample::name).collect();
    Err(Failure::new(format_args!(
        "no sample {} of the solid {}; the nearest names are {}",
        quote(name),
        solid.name,
        nearest(name, &names).join(", ")
    )))
}

/// The four names most like a text, those that begin with it first: a feature's
/// name alone gives its samples.
fn nearest<'a>(text: &str, names: &'a [String]) -> Vec<&'a str> {
    // No name is half as long, and comparing a long text takes time.
    let text: String = text.chars().take(64).collect();
    let mut ranked: Vec<&str> = names.iter().map(String::as_str).collect();
    ranked.sort_by_cached_key(|name| (!name.starts_with(&text), distance(&text, name)));
    ranked.truncate(4);
    ranked
}

/// The Levenshtein distance: letters to insert, delete or replace; row by row.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances() {
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance("edge", "edge"), 0);
        assert_eq!(distance("flaw", "lawn"), 2);
    }

    #[test]
    fn what_a_mistyped_name_may_have_meant() {
        let solid = Solid::SYMMETRIC;
        let why = |name: &str| find(&solid, name).unwrap_err().to_string();
        assert!(why("edge-neer-top/crossing").contains("are edge-near-top/crossing,"));
        let all = why("face-far");
        for relation in ["touching", "crossing", "contained", "apart"] {
            assert!(all.contains(&format!("face-far/{relation}")), "{all}");
        }
        assert_eq!(
            find(&solid, "face-far/apart").unwrap().name(),
            "face-far/apart"
        );
    }

    #[test]
    fn a_near_miss_follows_the_samples_of_its_feature() {
        for solid in Solid::ALL {
            let all = samples(&solid, true);
            assert_eq!(all.len() % 4, 0);
            for four in all.chunks(4) {
                assert!(four.iter().all(|s| s.feature == four[0].feature));
            }
        }
    }
}
