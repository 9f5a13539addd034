//! Files that are no mesh, for the tests of this crate and of those that read files through it.

/// Returns each file's name, its bytes, and the message about it, which follows the name.
pub(crate) fn nonsense() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let rows = include_str!("table.txt").lines().filter(|row| !row.starts_with('#'));
    let row = |row: &'static str| {
        let [name, content, message] = row.split(" | ").collect::<Vec<_>>().try_into().expect(row);
        (name, bytes(content), message)
    };
    rows.map(row).collect()
}

fn bytes(escaped: &str) -> Vec<u8> {
    let mut parts = escaped.split('\\');
    let mut bytes = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts {
        let (code, rest) = match part.as_bytes() {
            [b'n', rest @ ..] => (b'\n', rest),
            [b'r', rest @ ..] => (b'\r', rest),
            [b'0', rest @ ..] => (0, rest),
            [b'x', high, low, rest @ ..] => {
                let digit = |byte: u8| (byte as char).to_digit(16).expect("a hexadecimal digit") as u8;
                (16 * digit(*high) + digit(*low), rest)
            }
            _ => panic!("{part} begins with no escape"),
        };
        bytes.push(code);
        bytes.extend_from_slice(rest);
    }
    bytes
}
