//! Sums of a few `f64` components that do not overlap: exact arithmetic on the stack.
//!
//! Source: Shewchuk, "Adaptive precision floating-point arithmetic and fast
//! robust geometric predicates" (1997). Components are in order of increasing
//! magnitude, without zeros and without common bits.
//!
//! Everything is built from one step, the addition of one component to an expansion
//! (Shewchuk's GROW-EXPANSION, theorem 10), which is right for any expansion
//! without overlap. The linear-time merges need stronger properties of their
//! input, and for two to eight components they are not faster.
//!
//! The results are exact as long as no product has bits below 2^-1074 and nothing
//! overflows: the caller checks the range of its input ([`in_safe_range`]). A result
//! of more than [`CAPACITY`] components is an [`Overflow`].

use super::Number;
use super::float::{exp2, fast_two_sum, two_diff, two_prod, two_sum};
use std::cmp::Ordering;

/// The most components an expansion can have.
pub(crate) const CAPACITY: usize = 12;

/// Whether a value may enter a polynomial of degree 6: it is zero, or its magnitude is in
/// 2^-125 .. 2^150. Six factors then have no bit below 2^(-6 (125 + 52)) = 2^-1062 > 2^-1074,
/// and no sum of such products reaches 2^1000.
#[inline]
pub(crate) fn in_safe_range(value: f64) -> bool {
    let magnitude = value.abs();
    magnitude == 0.0 || (LEAST_SAFE_MAGNITUDE..SAFE_MAGNITUDE_LIMIT).contains(&magnitude)
}

const LEAST_SAFE_MAGNITUDE: f64 = exp2(-125);
const SAFE_MAGNITUDE_LIMIT: f64 = exp2(150);

/// The error for a result of more than [`CAPACITY`] components.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Overflow;

/// An exact sum of `f64` components.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expansion {
    len: usize,
    parts: [f64; CAPACITY],
}

impl Expansion {
    const ZERO: Expansion = Expansion {
        len: 0,
        parts: [0.0; CAPACITY],
    };

    fn parts(&self) -> &[f64] {
        &self.parts[..self.len]
    }

    /// Adds one component.
    fn grow(&mut self, value: f64) -> Result<(), Overflow> {
        let mut carry = value;
        let mut kept = 0;
        for i in 0..self.len {
            let (sum, rest) = two_sum(carry, self.parts[i]);
            carry = sum;
            if rest != 0.0 {
                self.parts[kept] = rest;
                kept += 1;
            }
        }
        self.len = kept;
        if carry != 0.0 {
            *self.parts.get_mut(kept).ok_or(Overflow)? = carry;
            self.len += 1;
        }
        Ok(())
    }

    /// Reduces the number of components without changing the value; the last one is then
    /// within one unit in its last place of the value (Shewchuk's COMPRESS).
    fn compress(&mut self) {
        if self.len < 2 {
            return;
        }
        let mut bottom = self.len;
        let mut carry = self.parts[self.len - 1];
        for i in (0..self.len - 1).rev() {
            let (sum, rest) = fast_two_sum(carry, self.parts[i]);
            if rest == 0.0 {
                carry = sum;
            } else {
                bottom -= 1;
                self.parts[bottom] = sum;
                carry = rest;
            }
        }
        bottom -= 1;
        self.parts[bottom] = carry;
        let mut kept = 0;
        let mut carry = self.parts[bottom];
        for i in bottom + 1..self.len {
            let (sum, rest) = fast_two_sum(self.parts[i], carry);
            carry = sum;
            if rest != 0.0 {
                self.parts[kept] = rest;
                kept += 1;
            }
        }
        self.parts[kept] = carry;
        self.len = if carry == 0.0 { kept } else { kept + 1 };
    }

    /// The value, with a relative error of at most `u (1 + 4 u)`.
    pub(crate) fn estimate(&self) -> f64 {
        self.parts().iter().fold(0.0, |sum, part| sum + part)
    }
}

impl Number for Expansion {
    type Overflow = Overflow;

    fn from_f64(value: f64) -> Self {
        let mut e = Expansion::ZERO;
        e.parts[0] = value;
        e.len = usize::from(value != 0.0);
        e
    }

    fn difference(a: f64, b: f64) -> Self {
        let (high, low) = two_diff(a, b);
        let mut e = Expansion::from_f64(low);
        if high != 0.0 {
            e.parts[e.len] = high;
            e.len += 1;
        }
        e
    }

    fn add(&self, other: &Self) -> Result<Self, Overflow> {
        let mut sum = *self;
        for &part in other.parts() {
            sum.grow(part)?;
        }
        sum.compress();
        Ok(sum)
    }

    fn mul(&self, other: &Self) -> Result<Self, Overflow> {
        // For more components, big integers are faster.
        if 2 * self.len * other.len > CAPACITY {
            return Err(Overflow);
        }
        let mut product = Expansion::ZERO;
        for &a in self.parts() {
            for &b in other.parts() {
                let (high, low) = two_prod(a, b);
                product.grow(low)?;
                product.grow(high)?;
            }
        }
        product.compress();
        Ok(product)
    }

    fn neg(mut self) -> Self {
        for part in &mut self.parts[..self.len] {
            *part = -*part;
        }
        self
    }

    fn sign(&self) -> Ordering {
        match self.parts().last() {
            None => Ordering::Equal,
            Some(&top) if top > 0.0 => Ordering::Greater,
            Some(_) => Ordering::Less,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_have_no_components() {
        for zero in [
            Expansion::from_f64(0.0),
            Expansion::from_f64(-0.0),
            Expansion::difference(3.0, 3.0),
        ] {
            assert_eq!((zero.len, zero.sign()), (0, Ordering::Equal));
        }
    }
}
