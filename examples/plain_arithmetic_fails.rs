//! Shows where a textbook clipper in floating point is wrong: segments that touch a face.
//!
//! `cargo run --release --features samples --example plain_arithmetic_fails`

use frusta::Class;
use frusta::clip::{LiangBarsky, LiangBarskyVariant, SegmentClipper, SixPlanes, VwProjection};
use frusta::samples::Family;

const CASES: u64 = 10_000;

/// How many classes a clipper gets wrong, and the first of them.
fn wrong(clipper: &dyn SegmentClipper<f64>, family: Family) -> (u64, Option<(Class, Class)>) {
    let (mut count, mut first) = (0, None);
    for index in 0..CASES {
        let (frustum, segment) = family.case(1, index);
        // Every sample is finite, so both clippers have an answer.
        let (Ok(exact), Ok(found)) = (
            frustum.clip_segment(&segment),
            clipper.clip_segment(&frustum, &segment),
        ) else {
            continue;
        };
        if found.class != exact.class {
            count += 1;
            first = first.or(Some((found.class, exact.class)));
        }
    }
    (count, first)
}

fn main() {
    let clippers: [(&str, Box<dyn SegmentClipper<f64>>); 4] = [
        (
            "Liang-Barsky, plain",
            Box::new(LiangBarsky::plain(LiangBarskyVariant::Textbook)),
        ),
        ("six planes, plain", Box::new(SixPlanes::plain())),
        ("V/W, plain", Box::new(VwProjection::plain())),
        (
            "six planes, exact",
            Box::new(SixPlanes::exact(Default::default())),
        ),
    ];
    for family in [Family::FreePose, Family::HalfLattice] {
        println!("family {family}, {CASES} cases:");
        for (name, clipper) in &clippers {
            let (count, first) = wrong(clipper.as_ref(), family);
            let example = first.map_or(String::new(), |(found, exact)| {
                format!("; such as {found} where the exact answer is {exact}")
            });
            println!("  {name}: {count} wrong{example}");
            if name.ends_with("exact") {
                assert_eq!(count, 0);
            }
        }
    }
}
