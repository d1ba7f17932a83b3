//! Numbers of 16 bits (IEEE 754 binary16).

/// The number that the bits stand for, exactly.
#[inline]
pub(crate) fn half_to_f32(bits: u16) -> f32 {
    /// 2¹¹²: how far apart the exponents' zeros are.
    const REBIAS: f32 = f32::from_bits((112 + 127) << 23);
    let (sign, magnitude) = (u32::from(bits & 0x8000) << 16, u32::from(bits & 0x7fff));
    let value = match magnitude {
        // Infinite, or no number.
        0x7c00.. => f32::from_bits(0x7f80_0000 | magnitude << 13),
        _ => f32::from_bits(magnitude << 13) * REBIAS,
    };
    f32::from_bits(value.to_bits() | sign)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_of_them() {
        for bits in 0..=u16::MAX {
            let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023) / 1024.0);
            let value = match exponent {
                0 => fraction * 2.0_f64.powi(-14),
                31 if fraction == 0.0 => f64::INFINITY,
                31 => f64::NAN,
                e => (1.0 + fraction) * 2.0_f64.powi(e - 15),
            };
            let value = if bits >> 15 == 1 { -value } else { value };
            let found = half_to_f32(bits);
            assert!(f64::from(found) == value || value.is_nan() && found.is_nan(), "{bits:#06x}: {found}");
        }
    }
}
