//! A register of `f32` as two of `f64`, and values looked up for each lane.

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f32x16, f64x4, f64x8, u8x64, u32x8, u32x16};

/// A register of `f32`.
pub(super) trait Widen<S: Simd>: SimdFloat<S, Element = f32> {
    /// A register of `f64` with half of the lanes.
    type Wide: SimdFloat<S, Element = f64>;

    /// Eight values.
    type Table;

    fn table(simd: S, values: [f64; 8]) -> Self::Table;

    /// The first half of the lanes, then the second.
    fn to_wide(self) -> [Self::Wide; 2];

    /// Each value rounded to the nearest `f32`.
    fn from_wide(halves: [Self::Wide; 2]) -> Self;

    /// The value at each lane's index, from each table: for the first half of the lanes, then for
    /// the second.
    fn look_up(tables: &[Self::Table; 4], indices: Self::Bits) -> [[Self::Wide; 4]; 2];
}

/// Eight values, and their lower and upper words.
pub(super) struct Table {
    values: [f64; 8],
    #[cfg_attr(
        not(any(target_arch = "x86", target_arch = "x86_64")),
        allow(dead_code, reason = "only AVX2 looks words up")
    )]
    words: [[u32; 8]; 2],
}

impl<S: Simd> Widen<S> for f32x8<S> {
    type Wide = f64x4<S>;
    type Table = Table;

    fn table(_: S, values: [f64; 8]) -> Table {
        Table {
            values,
            words: [
                values.map(|v| v.to_bits() as u32),
                values.map(|v| (v.to_bits() >> 32) as u32),
            ],
        }
    }

    #[inline(always)]
    fn to_wide(self) -> [f64x4<S>; 2] {
        let (first, second) = self.widen();
        [first, second]
    }

    #[inline(always)]
    fn from_wide([first, second]: [f64x4<S>; 2]) -> Self {
        f64x4::narrow(first, second)
    }

    #[inline(always)]
    fn look_up(tables: &[Table; 4], indices: u32x8<S>) -> [[f64x4<S>; 4]; 2] {
        let simd = indices.token();
        let [x, y, z, offset] = tables;
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Some(avx2) = simd.level().as_avx2() {
            let indices = avx2::in_turn(avx2, indices.into());
            let x = avx2::look_up(avx2, x.words, indices);
            let y = avx2::look_up(avx2, y.words, indices);
            let z = avx2::look_up(avx2, z.words, indices);
            let offset = avx2::look_up(avx2, offset.words, indices);
            return [
                [
                    x[0].simd_into(simd),
                    y[0].simd_into(simd),
                    z[0].simd_into(simd),
                    offset[0].simd_into(simd),
                ],
                [
                    x[1].simd_into(simd),
                    y[1].simd_into(simd),
                    z[1].simd_into(simd),
                    offset[1].simd_into(simd),
                ],
            ];
        }
        let [a, b, c, d, e, f, g, h]: [u32; 8] = indices.into();
        let (first, second) = ([a, b, c, d], [e, f, g, h]);
        [
            [
                four(simd, x, first),
                four(simd, y, first),
                four(simd, z, first),
                four(simd, offset, first),
            ],
            [
                four(simd, x, second),
                four(simd, y, second),
                four(simd, z, second),
                four(simd, offset, second),
            ],
        ]
    }
}

/// Four of eight values.
#[inline(always)]
fn four<S: Simd>(simd: S, table: &Table, [a, b, c, d]: [u32; 4]) -> f64x4<S> {
    let at = |index: u32| table.values[index as usize & 7];
    [at(a), at(b), at(c), at(d)].simd_into(simd)
}

/// Values are looked up by their words.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
mod avx2 {
    use fearless_simd::prelude::*;
    use fearless_simd::{f64x4, kernel, u32x8};
    #[cfg(target_arch = "x86")]
    use std::arch::x86::*;
    #[cfg(target_arch = "x86_64")]
    use std::arch::x86_64::*;

    kernel!(
        /// Lanes 0, 1, 4, 5, 2, 3, 6, 7: interleaved words then come in order.
        #[inline(always)]
        pub(super) fn in_turn(avx2: Avx2, indices: [u32; 8]) -> [u32; 8] {
            let indices = u32x8::simd_from(avx2, indices).into();
            let indices = _mm256_permute4x64_epi64::<0b11_01_10_00>(indices);
            u32x8::simd_from(avx2, indices).into()
        }
    );

    kernel!(
        /// The values with these words, at eight indices from [`in_turn`].
        #[inline(always)]
        pub(super) fn look_up(
            avx2: Avx2,
            words: [[u32; 8]; 2],
            indices: [u32; 8],
        ) -> [[f64; 4]; 2] {
            let indices = u32x8::simd_from(avx2, indices).into();
            let [low, high] = words;
            let low: __m256i = u32x8::simd_from(avx2, low).into();
            let high: __m256i = u32x8::simd_from(avx2, high).into();
            let low = _mm256_permutevar8x32_epi32(low, indices);
            let high = _mm256_permutevar8x32_epi32(high, indices);
            let first = _mm256_castsi256_pd(_mm256_unpacklo_epi32(low, high));
            let second = _mm256_castsi256_pd(_mm256_unpackhi_epi32(low, high));
            [
                f64x4::simd_from(avx2, first).into(),
                f64x4::simd_from(avx2, second).into(),
            ]
        }
    );
}

impl<S: Simd> Widen<S> for f32x16<S> {
    type Wide = f64x8<S>;
    type Table = f64x8<S>;

    fn table(simd: S, values: [f64; 8]) -> f64x8<S> {
        values.simd_into(simd)
    }

    #[inline(always)]
    fn to_wide(self) -> [f64x8<S>; 2] {
        let (first, second) = self.widen();
        [first, second]
    }

    #[inline(always)]
    fn from_wide([first, second]: [f64x8<S>; 2]) -> Self {
        f64x8::narrow(first, second)
    }

    #[inline(always)]
    fn look_up(tables: &[f64x8<S>; 4], indices: u32x16<S>) -> [[f64x8<S>; 4]; 2] {
        let simd = indices.token();
        let [x, y, z, offset] = *tables;
        let bytes: u8x64<S> = (indices << 3).bitcast();
        let each = u8x64::simd_from(simd, BYTES);
        let first = bytes.swizzle_dyn(u8x64::simd_from(simd, LOWEST_BYTES[0])) + each;
        let second = bytes.swizzle_dyn(u8x64::simd_from(simd, LOWEST_BYTES[1])) + each;
        [
            [
                x.swizzle_dyn(first),
                y.swizzle_dyn(first),
                z.swizzle_dyn(first),
                offset.swizzle_dyn(first),
            ],
            [
                x.swizzle_dyn(second),
                y.swizzle_dyn(second),
                z.swizzle_dyn(second),
                offset.swizzle_dyn(second),
            ],
        ]
    }
}

/// For each byte of eight `f64`, the lowest byte of the `f32` of the same lane: of the first half
/// of a register, and of the second.
const LOWEST_BYTES: [[u8; 64]; 2] = {
    let mut bytes = [[0; 64]; 2];
    let mut i = 0;
    while i < 64 {
        bytes[0][i] = 4 * (i as u8 / 8);
        bytes[1][i] = 32 + bytes[0][i];
        i += 1;
    }
    bytes
};

/// The indices of an `f64`'s bytes, eight times.
const BYTES: [u8; 64] = {
    let mut bytes = [0; 64];
    let mut i = 0;
    while i < 64 {
        bytes[i] = i as u8 % 8;
        i += 1;
    }
    bytes
};
