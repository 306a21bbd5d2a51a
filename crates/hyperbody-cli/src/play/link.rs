//! A scene as part of an address, as web/src/scenes/library.ts packs it: raw deflate, then base64 with the letters of addresses.

use std::io::Write;

use flate2::Compression;
use flate2::write::DeflateEncoder;

use crate::failure::Failure;

/// The text, packed.
pub(super) fn packed(text: &str) -> Result<String, Failure> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    let bytes = encoder.write_all(text.as_bytes()).and_then(|()| encoder.finish());
    bytes.map(|bytes| base64_url(&bytes)).map_err(|error| Failure::Work(format!("the scene cannot be packed: {error}")))
}

/// Base64 for addresses, without padding (RFC 4648, section 5).
fn base64_url(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let word = group.iter().fold(0_u32, |word, &byte| word << 8 | u32::from(byte)) << (8 * (3 - group.len()));
        for place in 0..=group.len() {
            let letter = LETTERS[(word >> (18 - 6 * place)) as usize & 63];
            text.push(char::from(letter));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::base64_url;

    /// The vectors of RFC 4648, section 10, without their padding, and one with both letters that differ.
    #[test]
    fn base64_is_that_of_the_standard() {
        let pairs = [("", ""), ("f", "Zg"), ("fo", "Zm8"), ("foo", "Zm9v"), ("foob", "Zm9vYg"), ("foobar", "Zm9vYmFy")];
        for (plain, packed) in pairs {
            assert_eq!(base64_url(plain.as_bytes()), packed);
        }
        assert_eq!(base64_url(&[0xfb, 0xef, 0xff]), "--__");
    }
}
