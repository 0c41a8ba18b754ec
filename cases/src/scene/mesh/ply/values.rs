//! The numbers after a header, one after another, in each of the encodings.

use super::header::Kind;
use crate::scene::mesh::fault::{Fault, Place, quoted};
use crate::scene::mesh::text::{is_blank, is_end, real, whole};

/// A stream of numbers. Its faults do not name the element that they belong to.
pub(super) trait Values {
    /// Returns the offset at which the next number starts or is expected.
    fn at(&mut self) -> usize;

    /// Returns the place of an offset, for a fault in that element.
    fn place(&self, at: usize, element: String) -> Place;

    /// Reads the next number, which has that type, as a double.
    fn real(&mut self, kind: Kind) -> Result<f64, Fault>;

    /// Reads the next number, which has that integer type.
    fn whole(&mut self, kind: Kind) -> Result<i64, Fault>;

    /// Skips `n` numbers of that type, whatever they are.
    fn skip(&mut self, kind: Kind, n: usize) -> Result<(), Fault>;

    /// Returns how many numbers of that type the rest of the file can hold at most.
    fn most(&self, kind: Kind) -> usize;

    /// Returns the number of bytes after the last element. The file is wrong if there are any.
    fn surplus(&mut self) -> usize;
}

const HELP_SHORT: &str =
    "the header promises more than the file holds: write the file again, or correct the counts";

fn short(at: usize) -> Fault {
    Fault::at(at, "the file ends here", HELP_SHORT)
}

/// Numbers as words. Line ends do not matter.
#[derive(Clone)]
pub(super) struct Text<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Text<'a> {
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at }
    }

    fn word(&mut self) -> Result<&'a [u8], Fault> {
        let start = self.at();
        let rest = &self.bytes[start..];
        let length =
            rest.iter().position(|byte| is_blank(*byte) || is_end(*byte)).unwrap_or(rest.len());
        self.at = start + length;
        if length == 0 { Err(short(start)) } else { Ok(&rest[..length]) }
    }

    fn wrong(&self, word: &[u8], what: &str) -> Fault {
        Fault::at(
            self.at - word.len(),
            format!("{} is not {what}", quoted(word)),
            "correct the number",
        )
    }
}

impl Values for Text<'_> {
    fn at(&mut self) -> usize {
        while self.bytes.get(self.at).is_some_and(|byte| is_blank(*byte) || is_end(*byte)) {
            self.at += 1;
        }
        self.at
    }

    fn place(&self, at: usize, _: String) -> Place {
        Place::Text(at)
    }

    fn real(&mut self, kind: Kind) -> Result<f64, Fault> {
        if kind.range().is_some() {
            return self.whole(kind).map(|number| number as f64);
        }
        let word = self.word()?;
        let number = match kind {
            Kind::Float32 => std::str::from_utf8(word)
                .ok()
                .and_then(|word| word.parse::<f32>().ok())
                .map(f64::from),
            _ => real(word),
        };
        number.ok_or_else(|| self.wrong(word, "a number"))
    }

    fn whole(&mut self, kind: Kind) -> Result<i64, Fault> {
        let word = self.word()?;
        let (least, most) = kind.range().unwrap_or((i64::MIN, i64::MAX));
        // `3.0` is a whole number as well.
        let as_real =
            || real(word).filter(|x| x.fract() == 0.0 && x.abs() < 1e15).map(|x| x as i64);
        whole(word)
            .or_else(as_real)
            .filter(|number| (least..=most).contains(number))
            .ok_or_else(|| self.wrong(word, &format!("a whole number from {least} to {most}")))
    }

    fn skip(&mut self, _: Kind, n: usize) -> Result<(), Fault> {
        (0..n).try_for_each(|_| self.word().map(|_| ()))
    }

    fn most(&self, _: Kind) -> usize {
        (self.bytes.len() - self.at).div_ceil(2)
    }

    fn surplus(&mut self) -> usize {
        self.bytes.len() - self.at()
    }
}

/// Numbers as bytes, the least significant byte first if `LITTLE`, else last.
#[derive(Clone)]
pub(super) struct Binary<'a, const LITTLE: bool> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a, const LITTLE: bool> Binary<'a, LITTLE> {
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at }
    }

    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let mut number = *rest.first_chunk::<N>().ok_or_else(|| short(self.bytes.len()))?;
        self.at += N;
        if !LITTLE {
            number.reverse();
        }
        Ok(number)
    }
}

impl<const LITTLE: bool> Values for Binary<'_, LITTLE> {
    fn at(&mut self) -> usize {
        self.at
    }

    fn place(&self, at: usize, element: String) -> Place {
        Place::Binary(at, element)
    }

    #[inline]
    fn real(&mut self, kind: Kind) -> Result<f64, Fault> {
        Ok(match kind {
            Kind::Float32 => f32::from_le_bytes(self.take()?).into(),
            Kind::Float64 => f64::from_le_bytes(self.take()?),
            _ => self.whole(kind)? as f64,
        })
    }

    #[inline]
    fn whole(&mut self, kind: Kind) -> Result<i64, Fault> {
        Ok(match kind {
            Kind::Int8 => i8::from_le_bytes(self.take()?).into(),
            Kind::Uint8 => u8::from_le_bytes(self.take()?).into(),
            Kind::Int16 => i16::from_le_bytes(self.take()?).into(),
            Kind::Uint16 => u16::from_le_bytes(self.take()?).into(),
            Kind::Int32 => i32::from_le_bytes(self.take()?).into(),
            Kind::Uint32 => u32::from_le_bytes(self.take()?).into(),
            Kind::Float32 | Kind::Float64 => self.real(kind)? as i64,
        })
    }

    fn skip(&mut self, kind: Kind, n: usize) -> Result<(), Fault> {
        if n > self.most(kind) {
            return Err(short(self.bytes.len()));
        }
        self.at += n * kind.size();
        Ok(())
    }

    fn most(&self, kind: Kind) -> usize {
        (self.bytes.len() - self.at) / kind.size()
    }

    fn surplus(&mut self) -> usize {
        // Editors and some programs append a line end.
        let rest = &self.bytes[self.at..];
        if rest.iter().all(|byte| is_end(*byte) || is_blank(*byte)) { 0 } else { rest.len() }
    }
}
