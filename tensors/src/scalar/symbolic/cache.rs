//! Results that are kept while there is room for them.

use std::hash::Hasher;

/// Entries by hashes. A new entry takes the place of an older one when both have the same slot.
pub(super) struct Cache<T> {
    slots: Vec<Option<(u64, Box<T>)>>,
    entries: usize,
}

/// The most slots. Their number grows with the entries.
const MOST: usize = 1 << 17;

impl<T> Default for Cache<T> {
    fn default() -> Self {
        Cache { slots: Vec::new(), entries: 0 }
    }
}

impl<T> Cache<T> {
    /// The entry with a hash. Other values may have the same hash.
    pub fn get(&self, hash: u64) -> Option<&T> {
        let (own, entry) = self.slots.get(self.slot(hash))?.as_ref()?;
        (*own == hash).then_some(entry)
    }

    pub fn put(&mut self, hash: u64, entry: T) {
        if 2 * self.entries >= self.slots.len() && self.slots.len() < MOST {
            let slots = (4 * self.slots.len()).clamp(64, MOST);
            let old = std::mem::take(&mut self.slots);
            self.slots.resize_with(slots, || None);
            self.entries = 0;
            old.into_iter().flatten().for_each(|(hash, entry)| self.place(hash, entry));
        }
        self.place(hash, Box::new(entry));
    }

    fn place(&mut self, hash: u64, entry: Box<T>) {
        let slot = self.slot(hash);
        self.entries += usize::from(self.slots[slot].is_none());
        self.slots[slot] = Some((hash, entry));
    }

    /// The first bits of a hash; out of range as long as there are no slots.
    fn slot(&self, hash: u64) -> usize {
        match self.slots.len() {
            0 => 0,
            slots => (hash >> (64 - slots.ilog2())) as usize,
        }
    }
}

/// A fast hash of machine words, for the tables of one process.
#[derive(Default)]
pub(super) struct Mixer(u64);

impl Hasher for Mixer {
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.write_u64(u64::from_ne_bytes(word));
        }
    }

    fn write_u64(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(26) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    fn write_u32(&mut self, word: u32) {
        self.write_u64(word.into());
    }

    fn write_usize(&mut self, word: usize) {
        self.write_u64(word as u64);
    }

    fn finish(&self) -> u64 {
        (self.0 ^ (self.0 >> 32)).wrapping_mul(0xff51_afd7_ed55_8ccd)
    }
}

/// The hash of a key.
pub(super) fn hash(key: &[u64]) -> u64 {
    let mut mixer = Mixer::default();
    key.iter().for_each(|word| mixer.write_u64(*word));
    mixer.finish()
}
