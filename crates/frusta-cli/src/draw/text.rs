//! Text broken into lines.

/// Lines of at most `most` letters, broken at spaces where there are any.
pub(crate) fn wrapped(text: &str, most: usize) -> Vec<String> {
    let most = most.max(8);
    let mut lines = vec![String::new()];
    for word in text.split_inclusive(' ') {
        let letters: Vec<char> = word.chars().collect();
        for piece in letters.chunks(most) {
            let piece: String = piece.iter().collect();
            match lines.last_mut() {
                Some(line) if line.chars().count() + piece.trim_end().chars().count() <= most => {
                    line.push_str(&piece);
                }
                _ => lines.push(piece),
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_broken_at_spaces_or_where_they_must() {
        assert_eq!(wrapped("a short one", 20), ["a short one"]);
        assert_eq!(
            wrapped("--eye 1,2,3 --up 0,1,0", 12),
            ["--eye 1,2,3 ", "--up 0,1,0"]
        );
        assert_eq!(wrapped("0123456789abcdef", 8), ["01234567", "89abcdef"]);
        assert_eq!(wrapped("", 8), [""]);
    }
}
