//! Mutations of files of text: bytes, ranges, numbers, and parts of other files.

/// SplitMix64.
pub struct Random(u64);

/// What numbers become.
const NUMBERS: [&str; 16] = [
    "0",
    "-1",
    "1",
    "2",
    "-0.0",
    "1e308",
    "-1e308",
    "1e-308",
    "1e-3",
    "inf",
    "nan",
    "999999999999",
    "18446744073709551615",
    "1e9",
    "0.1",
    "3.7",
];

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    /// Returns one of some files with one to four changes.
    pub fn mutated(mut self, corpus: &[Vec<u8>]) -> Vec<u8> {
        let mut data = corpus[self.below(corpus.len())].clone();
        for _ in 0..1 + self.below(4) {
            self.change(&mut data, corpus);
        }
        data
    }

    /// Returns a range of up to `most` bytes.
    fn range(&mut self, length: usize, most: usize) -> std::ops::Range<usize> {
        let from = self.below(length);
        from..(from + 1 + self.below(most)).min(length)
    }

    fn change(&mut self, data: &mut Vec<u8>, corpus: &[Vec<u8>]) {
        if data.is_empty() {
            data.push(self.next() as u8);
            return;
        }
        match self.below(8) {
            0 => {
                let at = self.below(data.len());
                data[at] ^= 1 << self.below(8);
            }
            1 => {
                let gone = self.range(data.len(), 40);
                data.drain(gone);
            }
            2 => {
                let again = self.range(data.len(), 60);
                let (at, part) = (self.below(data.len()), data[again].to_vec());
                data.splice(at..at, part);
            }
            3 => data.truncate(self.below(data.len()) + 1),
            4 => {
                let other = &corpus[self.below(corpus.len())];
                let part = other[self.range(other.len(), 80)].to_vec();
                let gone = self.range(data.len(), 20);
                data.splice(gone, part);
            }
            _ => self.number(data),
        }
    }

    /// Changes one of the numbers.
    fn number(&mut self, data: &mut Vec<u8>) {
        let digit = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+' | b'e');
        let is_start = |at: usize, data: &[u8]| data[at].is_ascii_digit() && (at == 0 || !digit(&data[at - 1]));
        let starts: Vec<usize> = (0..data.len()).filter(|&at| is_start(at, data)).collect();
        if starts.is_empty() {
            return;
        }
        let from = starts[self.below(starts.len())];
        let to = from + data[from..].iter().take_while(|byte| digit(byte)).count();
        data.splice(from..to, NUMBERS[self.below(NUMBERS.len())].bytes());
    }
}
