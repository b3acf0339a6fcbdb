//! The tokens of a text, one after another.

use std::fmt;

/// A part of a text.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token<'a> {
    /// A name or a word, with `:` and `.` within, and the `[]` of an array's type after it.
    Name(&'a str),
    /// A number, as it is written.
    Number(&'a str),
    Text(String),
    /// `@…@`.
    Asset(&'a str),
    /// `<…>`.
    Path(&'a str),
    /// One of `( ) [ ] { } = , ; : &`.
    Mark(u8),
    End,
}

impl fmt::Display for Token<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(word) | Self::Number(word) => write!(f, "`{}`", start(word)),
            Self::Text(text) => write!(f, "\"{}\"", start(text)),
            Self::Asset(asset) => write!(f, "@{}@", start(asset)),
            Self::Path(path) => write!(f, "<{}>", start(path)),
            Self::Mark(mark) => write!(f, "`{}`", char::from(*mark)),
            Self::End => write!(f, "the end"),
        }
    }
}

fn start(text: &str) -> String {
    text.chars().take(40).collect()
}

/// A text being read.
pub(super) struct Lexer<'a> {
    text: &'a str,
    at: usize,
    /// The token after the current position, where it was looked at, and its end.
    ahead: Option<(Token<'a>, usize)>,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, at: 0, ahead: None }
    }

    /// The line that is being read, from 1.
    pub(super) fn line(&self) -> usize {
        self.text.as_bytes()[..self.at].iter().filter(|&&b| b == b'\n').count() + 1
    }

    /// An error at this place.
    pub(super) fn fault(&self, problem: impl fmt::Display) -> String {
        format!("line {}: {problem}", self.line())
    }

    /// The next token, left where it is.
    pub(super) fn peek(&mut self) -> Result<&Token<'a>, String> {
        if self.ahead.is_none() {
            let from = self.at;
            let token = self.lex()?;
            self.ahead = Some((token, self.at));
            self.at = from;
        }
        Ok(&self.ahead.as_ref().expect("it was just looked at").0)
    }

    /// The next token.
    pub(super) fn next(&mut self) -> Result<Token<'a>, String> {
        if let Some((token, end)) = self.ahead.take() {
            self.at = end;
            return Ok(token);
        }
        self.lex()
    }

    /// Takes a mark, if it is next.
    pub(super) fn takes(&mut self, mark: u8) -> Result<bool, String> {
        let is_next = *self.peek()? == Token::Mark(mark);
        if is_next {
            self.next()?;
        }
        Ok(is_next)
    }

    /// Takes a mark, which has to be next.
    pub(super) fn expect(&mut self, mark: u8) -> Result<(), String> {
        if self.takes(mark)? {
            return Ok(());
        }
        let found = self.peek()?.to_string();
        Err(self.fault(format!("`{}` is expected, not {found}", char::from(mark))))
    }

    /// Takes a number, which has to be next: the fast way for long arrays.
    pub(super) fn number(&mut self) -> Result<&'a str, String> {
        if let Some((_, _)) = self.ahead {
            return match self.next()? {
                // `inf` and `nan` look like names.
                Token::Number(number) | Token::Name(number) => Ok(number),
                other => Err(self.fault(format!("a number is expected, not {other}"))),
            };
        }
        self.skip_blank();
        let rest = &self.text.as_bytes()[self.at..];
        let length = rest.iter().take_while(|&&b| is_of_number(b)).count();
        if length == 0 {
            let found = self.peek()?.to_string();
            return Err(self.fault(format!("a number is expected, not {found}")));
        }
        let number = &self.text[self.at..self.at + length];
        self.at += length;
        Ok(number)
    }

    fn skip_blank(&mut self) {
        let bytes = self.text.as_bytes();
        while let Some(&b) = bytes.get(self.at) {
            match b {
                b' ' | b'\t' | b'\r' | b'\n' => self.at += 1,
                b'#' => self.skip_to(b"\n"),
                b'/' if bytes[self.at..].starts_with(b"//") => self.skip_to(b"\n"),
                b'/' if bytes[self.at..].starts_with(b"/*") => self.skip_to(b"*/"),
                _ => break,
            }
        }
    }

    fn skip_to(&mut self, end: &[u8]) {
        let rest = &self.text.as_bytes()[self.at..];
        let found = rest.windows(end.len()).position(|w| w == end);
        self.at += found.map_or(rest.len(), |i| i + end.len());
    }

    fn lex(&mut self) -> Result<Token<'a>, String> {
        self.skip_blank();
        let bytes = self.text.as_bytes();
        let Some(&b) = bytes.get(self.at) else { return Ok(Token::End) };
        match b {
            b'"' | b'\'' => self.string(b),
            b'@' => self.asset(),
            b'<' => {
                let path = self.until(self.at + 1, ">")?;
                self.at += path.len() + 2;
                Ok(Token::Path(path))
            }
            b'(' | b')' | b'[' | b']' | b'{' | b'}' | b'=' | b',' | b';' | b':' | b'&' => {
                self.at += 1;
                Ok(Token::Mark(b))
            }
            b'0'..=b'9' | b'-' | b'+' | b'.' => {
                let length = bytes[self.at..].iter().take_while(|&&b| is_of_number(b)).count();
                let number = &self.text[self.at..self.at + length];
                self.at += length;
                Ok(Token::Number(number))
            }
            _ => self.name(),
        }
    }

    fn name(&mut self) -> Result<Token<'a>, String> {
        let rest = &self.text[self.at..];
        let is_of_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | ':' | '.');
        let length = rest.find(|c| !is_of_name(c)).unwrap_or(rest.len());
        if length == 0 {
            let c = rest.chars().next().unwrap_or(' ');
            return Err(self.fault(format!("{c:?} has no place here")));
        }
        // A name before `:` keeps it only where more follows, as in `a: 1`.
        let mut name = rest[..length].trim_end_matches(':');
        if rest[name.len()..].starts_with("[]") {
            name = &rest[..name.len() + 2];
        }
        self.at += name.len();
        Ok(Token::Name(name))
    }

    /// The text from a place to what ends it.
    fn until(&self, from: usize, end: &str) -> Result<&'a str, String> {
        let rest = &self.text[from..];
        let length = rest.find(end);
        let length = length.ok_or_else(|| self.fault(format!("`{end}` is missing")))?;
        Ok(&rest[..length])
    }

    fn asset(&mut self) -> Result<Token<'a>, String> {
        let mark = if self.text[self.at..].starts_with("@@@") { "@@@" } else { "@" };
        let from = self.at + mark.len();
        let mut end = from + self.until(from, mark)?.len();
        if mark.len() > 1 {
            // Three that belong to the path have a backslash before them; up to two may stand before the last three.
            while self.text[..end].ends_with('\\') && end > from {
                end += mark.len();
                end += self.until(end, mark)?.len();
            }
            let more = self.text[end + mark.len()..].bytes().take_while(|b| *b == b'@').count();
            end += more.min(2);
        }
        self.at = end + mark.len();
        Ok(Token::Asset(&self.text[from..end]))
    }

    fn string(&mut self, quote: u8) -> Result<Token<'a>, String> {
        let bytes = self.text.as_bytes();
        let long = bytes[self.at..].starts_with(&[quote; 3]);
        let width = if long { 3 } else { 1 };
        let (first, mut end) = (self.at + width, self.at + width);
        loop {
            match bytes.get(end) {
                None => return Err(self.fault("a string has no end")),
                Some(b'\n') if !long => return Err(self.fault("a string has no end")),
                Some(b'\\') => end += 2,
                Some(&b) if b == quote && (!long || bytes[end..].starts_with(&[quote; 3])) => break,
                Some(_) => end += 1,
            }
        }
        let text = unescaped(&self.text[first..end]);
        self.at = end + width;
        Ok(Token::Text(text))
    }
}

fn is_of_number(b: u8) -> bool {
    b.is_ascii_alphanumeric() || matches!(b, b'.' | b'-' | b'+' | b'_')
}

fn unescaped(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text.chars();
    while let Some(c) = rest.next() {
        if c != '\\' {
            out.push(c);
            continue;
        }
        match rest.next() {
            Some('n') => out.push('\n'),
            Some('r') => out.push('\r'),
            Some('t') => out.push('\t'),
            Some('x') => {
                let digits: String =
                    rest.clone().take(2).take_while(char::is_ascii_hexdigit).collect();
                rest.by_ref().take(digits.len()).for_each(drop);
                out.push(u8::from_str_radix(&digits, 16).map_or('x', char::from));
            }
            Some(c) => out.push(c),
            None => {}
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_between_three_marks_have_marks_of_their_own() {
        for (text, path) in [
            ("@./a.png@ x", "./a.png"),
            ("@@@./a@2x.png@@@ x", "./a@2x.png"),
            ("@@@a\\@@@b@@@ x", "a\\@@@b"),
            ("@@@a@@@@@ x", "a@@"),
        ] {
            let mut lexer = Lexer::new(text);
            assert!(matches!(lexer.next(), Ok(Token::Asset(found)) if found == path), "{text}");
            assert!(matches!(lexer.next(), Ok(Token::Name("x"))), "{text}");
        }
        assert!(Lexer::new("@@@a\\@@@").next().is_err());
    }
}
