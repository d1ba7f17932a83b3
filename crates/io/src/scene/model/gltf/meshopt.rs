//! `EXT_meshopt_compression`: numbers of vertices and triangles as differences from those before.
//!
//! - ATTRIBUTES: blocks of up to 256 vertices; of each byte of a vertex the differences from the vertex before, in groups of sixteen of 0, 2,
//!   4 or 8 bits, where the largest stands for a whole byte.
//! - TRIANGLES: a byte a triangle, which says what edge and vertex of the last sixteen it shares (Lengyel & Kapoulkine's
//!   edge fifo, after Deering 1995, doi:10.1145/218380.218391).
//! - INDICES: differences from one of two numbers before.
//!
//! Filters turn whole numbers into unit vectors, turns and floating-point numbers. Khronos vendor extension, Kapoulkine 2022.

use serde::Deserialize;

use crate::error::FileError;

/// What the extension says of a buffer view.
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Compressed {
    pub(super) buffer: usize,
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    pub(super) byte_stride: usize,
    pub(super) count: usize,
    mode: String,
    filter: Option<String>,
}

/// How much larger than its code anything can be.
const MOST_GAIN: usize = 256;

impl Compressed {
    /// No more can come out.
    pub(super) fn most_bytes(&self) -> u64 {
        let said = self.count.saturating_mul(self.byte_stride);
        said.min(self.byte_length.saturating_mul(MOST_GAIN)) as u64
    }

    /// The bytes that stand for `code`.
    pub(super) fn decode(&self, code: &[u8]) -> Result<Vec<u8>, FileError> {
        let size =
            self.count.checked_mul(self.byte_stride).filter(|&size| size <= code.len().saturating_mul(MOST_GAIN));
        let size = size.ok_or_else(|| damaged("is too short"))?;
        let mut bytes = Vec::with_capacity(size);
        match (self.mode.as_str(), self.byte_stride) {
            ("ATTRIBUTES", stride) if stride > 0 && stride <= 256 && stride % 4 == 0 => {
                self.attributes(code, &mut bytes)?
            }
            ("TRIANGLES", 2 | 4) if self.count.is_multiple_of(3) => self.triangles(code, &mut bytes)?,
            ("INDICES", 2 | 4) => self.indices(code, &mut bytes)?,
            (mode, stride) => {
                return Err(FileError::new(format!("compressed `{mode}` cannot have a stride of {stride}")));
            }
        }
        match self.filter.as_deref() {
            None | Some("NONE") => {}
            Some("OCTAHEDRAL") if self.byte_stride == 4 => bytes.chunks_exact_mut(4).for_each(octahedral::<1>),
            Some("OCTAHEDRAL") if self.byte_stride == 8 => bytes.chunks_exact_mut(8).for_each(octahedral::<2>),
            Some("QUATERNION") if self.byte_stride == 8 => bytes.chunks_exact_mut(8).for_each(quaternion),
            Some("EXPONENTIAL") => bytes.chunks_exact_mut(4).for_each(exponential),
            Some(filter) => {
                return Err(FileError::new(format!("the filter `{filter}` of compressed numbers does not exist")));
            }
        }
        Ok(bytes)
    }

    fn attributes(&self, code: &[u8], bytes: &mut Vec<u8>) -> Result<(), FileError> {
        const GROUP: usize = 16;
        const LEAST_TAIL: usize = 32;
        let (stride, count) = (self.byte_stride, self.count);
        let Some((0xa0, body)) = code.split_first().map(|(first, body)| (*first, body)) else {
            return Err(damaged("does not begin as vertices do"));
        };
        let tail = stride.max(LEAST_TAIL);
        let mut data = Reader(body.get(..body.len().saturating_sub(tail)).unwrap_or_default());
        let mut last = code.get(code.len().saturating_sub(stride)..).unwrap_or_default().to_vec();
        let in_block = ((8192 / stride) & !(GROUP - 1)).clamp(GROUP, 256);
        let mut done = 0;
        while done < count {
            let elements = in_block.min(count - done);
            let groups = elements.div_ceil(GROUP);
            let start = bytes.len();
            bytes.resize(start + elements * stride, 0);
            for (k, last) in last.iter_mut().enumerate() {
                let widths = data.take(groups.div_ceil(4))?;
                for group in 0..groups {
                    let width = widths.get(group / 4).map_or(0, |w| (w >> (group % 4 * 2)) & 3);
                    for (i, delta) in data.group(width)?.into_iter().enumerate() {
                        let element = group * GROUP + i;
                        if element < elements {
                            *last = last.wrapping_add((delta >> 1) ^ (delta & 1).wrapping_neg());
                            bytes[start + element * stride + k] = *last;
                        }
                    }
                }
            }
            done += elements;
        }
        Ok(())
    }

    fn triangles(&self, code: &[u8], bytes: &mut Vec<u8>) -> Result<(), FileError> {
        let version = code.first().copied().unwrap_or_default();
        if version != 0xe0 && version != 0xe1 {
            return Err(damaged("does not begin as triangles do"));
        }
        // Codes of vertices that are not among the last ones.
        let most = if version == 0xe1 { 13 } else { 15 };
        let (codes, rest) = code
            .get(1..)
            .and_then(|body| body.split_at_checked(self.count / 3))
            .ok_or_else(|| damaged("is too short"))?;
        let (rest, table) =
            rest.split_at_checked(rest.len().saturating_sub(16)).ok_or_else(|| damaged("is too short"))?;
        let mut data = Reader(rest);
        let (mut edges, mut vertices) = (Recent::<[u32; 2]>::default(), Recent::<u32>::default());
        let (mut next, mut last) = (0_u32, 0_u32);
        for &code in codes {
            let [hi, lo] = [code >> 4, code & 15];
            let triangle = if hi < 15 {
                let [a, b] = edges.back(hi);
                let c = if lo < most {
                    let c = if lo == 0 { fresh(&mut next) } else { vertices.back(lo) };
                    if lo == 0 {
                        vertices.push(c);
                    }
                    c
                } else {
                    last = match lo {
                        13 => last.wrapping_sub(1),
                        14 => last.wrapping_add(1),
                        _ => data.index(last)?,
                    };
                    vertices.push(last);
                    last
                };
                edges.push([c, b]);
                edges.push([a, c]);
                [a, b, c]
            } else {
                let is_listed = lo < 14;
                let more =
                    if is_listed { table.get(usize::from(lo)).copied().unwrap_or_default() } else { data.take(1)?[0] };
                let parts = [if lo == 15 { 15 } else { 0 }, more >> 4, more & 15];
                if !is_listed && more == 0 {
                    next = 0;
                }
                // All that are new or seen before are told apart first, then those by their difference.
                let mut triangle = parts.map(|part| match part {
                    0 => fresh(&mut next),
                    15 if !is_listed => 0,
                    part => vertices.back(part - 1),
                });
                for (vertex, part) in triangle.iter_mut().zip(parts) {
                    if part == 15 && !is_listed {
                        last = data.index(last)?;
                        *vertex = last;
                    }
                }
                let [a, b, c] = triangle;
                for (i, (vertex, part)) in triangle.into_iter().zip(parts).enumerate() {
                    if i == 0 || part == 0 || part == 15 && !is_listed {
                        vertices.push(vertex);
                    }
                }
                [[b, a], [c, b], [a, c]].into_iter().for_each(|edge| edges.push(edge));
                triangle
            };
            triangle.into_iter().for_each(|index| self.write(index, bytes));
        }
        Ok(())
    }

    fn indices(&self, code: &[u8], bytes: &mut Vec<u8>) -> Result<(), FileError> {
        let Some((0xd0 | 0xd1, body)) = code.split_first().map(|(first, body)| (*first, body)) else {
            return Err(damaged("does not begin as indices do"));
        };
        let (mut data, mut last) = (Reader(body), [0_u32; 2]);
        for _ in 0..self.count {
            let number = data.number()?;
            let last = &mut last[(number & 1) as usize];
            *last = last.wrapping_add(signed(number >> 1));
            self.write(*last, bytes);
        }
        Ok(())
    }

    fn write(&self, index: u32, bytes: &mut Vec<u8>) {
        bytes.extend(index.to_le_bytes().into_iter().take(self.byte_stride));
    }
}

fn damaged(how: &str) -> FileError {
    FileError::new(format!("compressed numbers are damaged: their code {how}"))
}

/// A vertex that was not there yet.
fn fresh(next: &mut u32) -> u32 {
    let vertex = *next;
    *next = next.wrapping_add(1);
    vertex
}

/// 0, −1, 1, −2, 2 … for 0, 1, 2, 3, 4 …
fn signed(number: u32) -> u32 {
    (number >> 1) ^ (number & 1).wrapping_neg()
}

/// The last sixteen of a kind.
#[derive(Default)]
struct Recent<T> {
    items: [T; 16],
    count: usize,
}

impl<T: Copy> Recent<T> {
    fn push(&mut self, item: T) {
        self.items[self.count % 16] = item;
        self.count += 1;
    }

    /// The last one is 0 back.
    fn back(&self, by: u8) -> T {
        self.items[self.count.wrapping_sub(1).wrapping_sub(by.into()) % 16]
    }
}

/// What is left of a code.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], FileError> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or_else(|| damaged("ends too early"))?;
        self.0 = rest;
        Ok(taken)
    }

    /// Sixteen differences, of 0, 2, 4 or 8 bits as the width says.
    fn group(&mut self, width: u8) -> Result<[u8; 16], FileError> {
        let mut group = [0; 16];
        match width {
            0 => {}
            3 => group.copy_from_slice(self.take(16)?),
            _ => {
                let bits = 2 * usize::from(width);
                let (packed, most, in_byte) = (self.take(2 * bits)?, (1_u8 << bits) - 1, 8 / bits);
                for (i, slot) in group.iter_mut().enumerate() {
                    // The first one is in the highest bits.
                    let byte = packed.get(i / in_byte).copied().unwrap_or_default();
                    let value = (byte >> (8 - bits * (i % in_byte + 1))) & most;
                    *slot = if value == most { self.take(1)?[0] } else { value };
                }
            }
        }
        Ok(group)
    }

    /// A number in groups of seven bits, the lowest first.
    fn number(&mut self) -> Result<u32, FileError> {
        let mut number = 0;
        for shift in (0..35).step_by(7) {
            let byte = self.take(1)?[0];
            number |= u32::from(byte & 127) << shift;
            if byte < 128 {
                break;
            }
        }
        Ok(number)
    }

    fn index(&mut self, last: u32) -> Result<u32, FileError> {
        Ok(last.wrapping_add(signed(self.number()?)))
    }
}

/// Numbers of N bytes.
fn get<const N: usize>(bytes: &[u8], i: usize) -> f32 {
    match bytes.get(i * N..i * N + N) {
        Some(&[a]) => f32::from(a as i8),
        Some(&[a, b]) => f32::from(i16::from_le_bytes([a, b])),
        _ => 0.0,
    }
}

fn set<const N: usize>(bytes: &mut [u8], i: usize, value: f32) {
    let rounded = value.round_ties_even() as i16;
    if let Some(slot) = bytes.get_mut(i * N..i * N + N) {
        slot.copy_from_slice(&rounded.to_le_bytes()[..N]);
    }
}

/// A unit vector that was laid on an octahedron; its third number is what counts as 1.
fn octahedral<const N: usize>(bytes: &mut [u8]) {
    let one = get::<N>(bytes, 2).max(1.0);
    let most = if N == 1 { 127.0 } else { 32767.0 };
    let (mut x, mut y) = (get::<N>(bytes, 0) / one, get::<N>(bytes, 1) / one);
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    x -= fold.copysign(x);
    y -= fold.copysign(y);
    let scale = most / (x * x + y * y + z * z).sqrt();
    [x, y, z].into_iter().enumerate().for_each(|(i, c)| set::<N>(bytes, i, c * scale));
}

/// A turn without its largest number; which that is, and what counts as 1 / √2, is in the fourth.
fn quaternion(bytes: &mut [u8]) {
    let last = bytes.get(6..8).map_or(0, |b| u16::from_le_bytes([b[0], b[1]]));
    let largest = usize::from(last & 3);
    let scale = std::f32::consts::FRAC_1_SQRT_2 / f32::from(last | 3);
    let small = [0, 1, 2].map(|i| get::<2>(bytes, i) * scale);
    let rest = (1.0 - small.iter().map(|c| c * c).sum::<f32>()).max(0.0).sqrt();
    for (i, c) in [small[0], small[1], small[2]].into_iter().enumerate() {
        set::<2>(bytes, (largest + 1 + i) % 4, c * 32767.0);
    }
    set::<2>(bytes, largest, rest * 32767.0);
}

/// A mantissa of 24 bits, and an exponent of 8 above it.
fn exponential(bytes: &mut [u8]) {
    let Ok(raw) = <[u8; 4]>::try_from(&*bytes) else { return };
    let raw = i32::from_le_bytes(raw);
    let (mantissa, exponent) = ((raw << 8) >> 8, raw >> 24);
    bytes.copy_from_slice(&(libm::ldexp(f64::from(mantissa), exponent) as f32).to_le_bytes());
}
