//! A short name of what may be long: equal things have equal ones.

/// Fowler, Noll and Vo's hash FNV-1a of 64 bits, in hexadecimal digits: tells contents apart, is no protection.
pub fn digest(bytes: impl IntoIterator<Item = u8>) -> String {
    let hash = bytes.into_iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    format!("{hash:016x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_fnv_1a() {
        // Test vectors of the authors' list (isthe.com/chongo/tech/comp/fnv).
        assert_eq!(digest(*b""), "cbf29ce484222325");
        assert_eq!(digest(*b"a"), "af63dc4c8601ec8c");
        assert_eq!(digest(*b"foobar"), "85944171f73967e8");
    }
}
