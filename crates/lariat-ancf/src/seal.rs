//! Seals for saved states: a first line with their kind, the version of this package and a
//! checksum, so that what another version wrote, and what was damaged, is refused.
//!
//! A [`Cable`](crate::Cable) is plain serde data, in a format of the program's choice, and most
//! formats read a changed digit as another number. The seal goes around the bytes:
//!
//! ```
//! use lariat_ancf::seal::{seal, unseal};
//! use lariat_ancf::{Cable, Section, Vector3};
//!
//! let ends = [Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)];
//! let cable = Cable::builder().points(ends).section(Section::from_stiffness(1e5, 0.1, 0.1)?).build()?;
//! let saved = seal("cable", &serde_json::to_vec(&cable)?);
//! let read: Cable = serde_json::from_slice(unseal("cable", &saved)?)?;
//! assert_eq!(read.positions(), cable.positions());
//! let mut damaged = saved.clone();
//! *damaged.last_mut().unwrap() ^= 1;
//! assert!(unseal("cable", &damaged).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Validity
//! Every change of a single byte is found, and of other changes all but one of 2e19. It guards
//! against accidents, not against who means to deceive.
//!
//! # References
//! Fowler, Noll & Vo, *The FNV non-cryptographic hash algorithm*, FNV-1a of 64 bits.

/// The checksum of bytes that come one after the other, and their number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Checksum {
    hash: u64,
    length: u64,
}

impl Checksum {
    /// That of no bytes.
    pub const EMPTY: Checksum = Checksum { hash: 0xcbf2_9ce4_8422_2325, length: 0 };

    /// Returns the checksum of some bytes.
    pub fn of(bytes: &[u8]) -> Self {
        let mut sum = Checksum::EMPTY;
        sum.add(bytes);
        sum
    }

    /// Adds bytes behind those so far.
    pub fn add(&mut self, bytes: &[u8]) {
        // each step is one to one in the hash, so that no later byte hides a changed one
        let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        self.hash = bytes.iter().fold(self.hash, step);
        self.length += bytes.len() as u64;
    }

    /// Returns the checksum as a number.
    pub fn value(&self) -> u64 {
        self.hash
    }

    /// Returns the number of bytes.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Returns the checksum as 16 hexadecimal digits.
    pub fn digits(&self) -> String {
        format!("{:016x}", self.hash)
    }
}

/// Why bytes are not taken for what they should be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SealError {
    /// They are of another kind or version, or were never sealed.
    #[error("not a saved {kind}: it does not begin with {expected:?}")]
    Other {
        /// What was expected.
        kind: String,
        /// How that begins.
        expected: String,
    },
    /// They are not those that were sealed.
    #[error("not a saved {kind}: it is damaged: its checksum is not that of its contents")]
    Damaged {
        /// What was expected.
        kind: String,
    },
}

/// Returns how the bytes of a kind begin.
fn first_words(kind: &str) -> String {
    format!("lariat {kind} {} ", env!("CARGO_PKG_VERSION"))
}

/// Returns the rest of the first line.
fn checksum_line(body: &[u8]) -> String {
    Checksum::of(body).digits() + "\n"
}

/// Returns the bytes of an object of a kind, such as `cable`, under a seal.
pub fn seal(kind: &str, body: &[u8]) -> Vec<u8> {
    [first_words(kind).as_bytes(), checksum_line(body).as_bytes(), body].concat()
}

/// Returns the bytes under a seal, if they are those that this version sealed as this kind.
///
/// # Errors
/// [`SealError::Other`] for another kind or version, [`SealError::Damaged`] for changed bytes.
pub fn unseal<'a>(kind: &str, bytes: &'a [u8]) -> Result<&'a [u8], SealError> {
    let expected = first_words(kind);
    let Some(rest) = bytes.strip_prefix(expected.as_bytes()) else {
        return Err(SealError::Other { kind: kind.to_string(), expected });
    };
    let parts = rest.split_at_checked(checksum_line(&[]).len());
    let whole = parts.filter(|(line, body)| *line == checksum_line(body).as_bytes());
    whole.map(|(_, body)| body).ok_or_else(|| SealError::Damaged { kind: kind.to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// *Source.* The test vectors of the authors of FNV-1a.
    #[test]
    fn the_checksum_is_fnv_1a() {
        assert_eq!(Checksum::of(b"").digits(), "cbf29ce484222325");
        assert_eq!(Checksum::of(b"a").digits(), "af63dc4c8601ec8c");
        assert_eq!(Checksum::of(b"foobar").digits(), "85944171f73967e8");
    }

    /// Every bit that flips, every end that is missing, every byte too many is found.
    #[test]
    fn damage_is_refused() {
        let sealed = seal("cable", b"{\"x\": 1.25, \"y\": [0, 1]}");
        assert_eq!(unseal("cable", &sealed).unwrap(), b"{\"x\": 1.25, \"y\": [0, 1]}");
        for bit in 0..8 * sealed.len() {
            let mut damaged = sealed.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            assert!(unseal("cable", &damaged).is_err(), "{bit}");
        }
        assert!((0..sealed.len()).all(|end| unseal("cable", &sealed[..end]).is_err()));
        assert!(unseal("cable", &[&sealed[..], b" "].concat()).is_err());
        assert!(matches!(unseal("world", &sealed), Err(SealError::Other { .. })));
    }
}
