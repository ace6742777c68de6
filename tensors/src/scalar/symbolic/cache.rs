//! A hash table of results with a limited number of entries.

use std::hash::Hasher;

/// Entries that are found by their hashes. They are stored in buckets of a few entries. The number
/// of buckets grows with the number of entries up to `MOST`, which is a power of two. When this
/// limit is reached, a new entry in a full bucket replaces an older entry.
pub(super) struct Cache<T, const MOST: usize> {
    buckets: Vec<[Option<(u64, T)>; WAYS]>,
    entries: usize,
}

/// The number of entries of a bucket. With one pointer for each entry, a bucket is as long as a
/// cache line of the processor.
const WAYS: usize = 4;

impl<T, const MOST: usize> Default for Cache<T, MOST> {
    fn default() -> Self {
        Cache { buckets: Vec::new(), entries: 0 }
    }
}

impl<T, const MOST: usize> Cache<T, MOST> {
    /// The entry with this hash. The caller must compare the value, because other values may have
    /// the same hash.
    pub fn get(&self, hash: u64) -> Option<&T> {
        let bucket = self.buckets.get(self.bucket(hash))?;
        let found = bucket.iter().flatten().find(|(own, _)| *own == hash);
        found.map(|(_, entry)| entry)
    }

    /// Stores an entry. It replaces an entry with the same hash.
    pub fn put(&mut self, hash: u64, entry: T) {
        if self.entries >= 2 * self.buckets.len() && self.buckets.len() < MOST {
            let buckets = (4 * self.buckets.len()).clamp(16, MOST);
            let old = std::mem::take(&mut self.buckets);
            self.buckets.resize_with(buckets, || [const { None }; WAYS]);
            self.entries = 0;
            let entries = old.into_iter().flatten().flatten();
            entries.for_each(|(hash, entry)| self.place(hash, entry));
        }
        self.place(hash, entry);
    }

    fn place(&mut self, hash: u64, entry: T) {
        let at = self.bucket(hash);
        let bucket = &mut self.buckets[at];
        let way = bucket.iter().position(|slot| slot.as_ref().is_none_or(|(own, _)| *own == hash));
        // the lowest bits of the hash choose the entry, because they do not choose the bucket
        let way = way.unwrap_or(hash as usize % WAYS);
        self.entries += usize::from(bucket[way].is_none());
        bucket[way] = Some((hash, entry));
    }

    /// The bucket of a hash, which the highest bits of the hash choose. The result is out of range
    /// if there are no buckets.
    fn bucket(&self, hash: u64) -> usize {
        match self.buckets.len() {
            0 => 0,
            buckets => (hash >> (64 - buckets.ilog2())) as usize,
        }
    }
}

/// A fast hash of machine words. It is only for tables within one process.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_is_found_until_another_takes_its_place() {
        const MOST: usize = 64;
        let mut cache = Cache::<u64, MOST>::default();
        assert_eq!(cache.get(0), None);
        let key = |at: u64| hash(&[at]);
        for at in 0..10 * (WAYS * MOST) as u64 {
            cache.put(key(at), at);
            assert_eq!(cache.get(key(at)), Some(&at));
        }
        assert!(cache.entries <= WAYS * MOST);
        let found = (0..10 * (WAYS * MOST) as u64).filter_map(|at| Some((at, cache.get(key(at))?)));
        assert!(
            found.fold(0, |count, (at, entry)| {
                assert_eq!(at, *entry);
                count + 1
            }) == cache.entries
        );
        cache.put(key(0), 1);
        cache.put(key(0), 2);
        assert_eq!(cache.get(key(0)), Some(&2));
    }
}
