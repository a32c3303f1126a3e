//! Parses YAML into a tree in which every part knows its line. Anchors, aliases and tags are refused: maps and scenes
//! have none, and without them the tree is no larger than the file.

use saphyr_parser::{Event, Parser};

use super::error::wrong_value;
use super::{ImportError, ImportProblem};

/// Greatest depth of nested lists and mappings.
const DEEPEST: usize = 32;

/// Largest number of values, including keys.
const MAX_VALUES: usize = 200_000;

/// Largest number of the signs `, [ ] { }`. The parser keeps a whole list in brackets until it ends, some hundred bytes
/// a value.
const MAX_SIGNS: usize = 50_000;

/// Largest number of keys of one mapping: each is compared with those before it.
const MAX_KEYS: usize = 100;

/// A part of a file.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct YamlNode {
    pub line: usize,
    pub value: YamlValue,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum YamlValue {
    /// A text, without its quotes.
    Scalar(String),
    List(Vec<YamlNode>),
    /// Keys with their lines, no two of them equal.
    Mapping(Vec<(String, usize, YamlNode)>),
}

/// A list or mapping whose end has not been read.
enum OpenNode {
    List(usize, Vec<YamlNode>),
    Mapping(usize, Vec<(String, usize, YamlNode)>, Option<(String, usize)>),
}

/// Parses a file that holds one document. An empty file is an empty mapping.
pub(super) fn read(text: &str) -> Result<YamlNode, ImportError> {
    if text.bytes().filter(|b| b",[]{}".contains(b)).count() > MAX_SIGNS {
        return Err(unsupported(
            0,
            &format!("more than {MAX_SIGNS} of the signs , [ ] {{ }}; lists of a line each have none"),
        ));
    }
    let mut open: Vec<OpenNode> = Vec::new();
    let mut whole: Option<YamlNode> = None;
    let mut values = 0;
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| syntax(error.marker().line(), error.info()))?;
        let line = span.start.line();
        let closed = match event {
            Event::Scalar(_, _, 1.., _)
            | Event::SequenceStart(1.., _)
            | Event::MappingStart(1.., _)
            | Event::Alias(_) => {
                return Err(unsupported(line, "anchors and aliases; write the value out"));
            }
            Event::Scalar(_, _, _, Some(_)) | Event::SequenceStart(_, Some(_)) | Event::MappingStart(_, Some(_)) => {
                return Err(unsupported(line, "tags"));
            }
            Event::Scalar(text, ..) => Some(YamlNode { line, value: YamlValue::Scalar(text.into()) }),
            Event::SequenceStart(..) | Event::MappingStart(..) if open.len() == DEEPEST => {
                return Err(syntax(line, "nested too deeply"));
            }
            Event::SequenceStart(..) => {
                open.push(OpenNode::List(line, Vec::new()));
                None
            }
            Event::MappingStart(..) => {
                open.push(OpenNode::Mapping(line, Vec::new(), None));
                None
            }
            Event::SequenceEnd | Event::MappingEnd => open.pop().map(|part| match part {
                OpenNode::List(line, nodes) => YamlNode { line, value: YamlValue::List(nodes) },
                OpenNode::Mapping(line, entries, _) => YamlNode { line, value: YamlValue::Mapping(entries) },
            }),
            Event::DocumentStart(_) if whole.is_some() => return Err(syntax(line, "a second document")),
            _ => None,
        };
        let Some(node) = closed else { continue };
        values += 1;
        if values > MAX_VALUES {
            return Err(unsupported(line, &format!("more than {MAX_VALUES} values")));
        }
        match open.last_mut() {
            None => whole = Some(node),
            Some(OpenNode::List(_, nodes)) => nodes.push(node),
            Some(OpenNode::Mapping(_, entries, key)) => match key.take() {
                Some((key, key_line)) => entries.push((key, key_line, node)),
                None => *key = Some(key_of(node, entries)?),
            },
        }
    }
    Ok(whole.unwrap_or(YamlNode { line: 1, value: YamlValue::Mapping(Vec::new()) }))
}

/// Reads a node as a key of a mapping. Refuses a key that is there already.
fn key_of(node: YamlNode, before: &[(String, usize, YamlNode)]) -> Result<(String, usize), ImportError> {
    match node.value {
        _ if before.len() == MAX_KEYS => {
            Err(unsupported(node.line, &format!("more than {MAX_KEYS} keys of one mapping")))
        }
        YamlValue::Scalar(text) if before.iter().any(|(key, ..)| *key == text) => {
            Err(ImportError::at(node.line, text, ImportProblem::Syntax("the key stands there twice".into())))
        }
        YamlValue::Scalar(text) => Ok((text, node.line)),
        _ => Err(syntax(node.line, "a key must be a word")),
    }
}

fn syntax(line: usize, reason: &str) -> ImportError {
    ImportError::at(line, "", ImportProblem::Syntax(reason.into()))
}

fn unsupported(line: usize, what: &str) -> ImportError {
    ImportError::at(line, "", ImportProblem::Unsupported(what.into()))
}

impl YamlNode {
    /// Reads the node as a number, which may stand in quotes. Errors name it `item`.
    pub fn number(&self, item: &str) -> Result<f64, ImportError> {
        let expected = "a finite number";
        match &self.value {
            YamlValue::Scalar(text) => match text.trim().parse::<f64>() {
                Ok(x) if x.is_finite() => Ok(x),
                _ => Err(ImportError::at(self.line, item, wrong_value(text, expected))),
            },
            _ => Err(self.wrong(item, expected)),
        }
    }

    /// Reads the node as yes or no, by the words of YAML 1.1: in small letters, in capitals or with one capital. Errors
    /// name it `item`.
    pub fn boolean(&self, item: &str) -> Result<bool, ImportError> {
        let text = self.text(item)?;
        let (small, large) = (text.to_ascii_lowercase(), text.to_ascii_uppercase());
        let is_flexible = text == small || text == large || text.get(1..) == small.get(1..);
        match small.as_str() {
            "true" | "yes" | "on" | "y" if is_flexible => Ok(true),
            "false" | "no" | "off" | "n" if is_flexible => Ok(false),
            _ => Err(self.wrong(item, "True or False")),
        }
    }

    /// Reads the node as a text. Errors name it `item`.
    pub fn text(&self, item: &str) -> Result<&str, ImportError> {
        match &self.value {
            YamlValue::Scalar(text) if !text.is_empty() => Ok(text),
            _ => Err(self.wrong(item, "a text")),
        }
    }

    /// Reads the node as a list. Errors name it `item`.
    pub fn list(&self, item: &str) -> Result<&[YamlNode], ImportError> {
        match &self.value {
            YamlValue::List(nodes) => Ok(nodes),
            _ => Err(self.wrong(item, "a list")),
        }
    }

    /// Reads the node as a list of numbers, as many as `count` allows. Errors name it `item`.
    pub fn numbers(
        &self,
        item: &str,
        count: std::ops::RangeInclusive<usize>,
        expected: &'static str,
    ) -> Result<Vec<f64>, ImportError> {
        let nodes = self.list(item).map_err(|_| self.wrong(item, expected))?;
        if !count.contains(&nodes.len()) {
            let found = format!("{} of them", nodes.len());
            return Err(ImportError::at(self.line, item, wrong_value(found, expected)));
        }
        nodes.iter().map(|node| node.number(item)).collect()
    }

    /// Reads the node as a mapping. Errors name it `item`.
    pub fn fields(&self, item: &str) -> Result<Fields<'_>, ImportError> {
        match &self.value {
            YamlValue::Mapping(entries) => {
                Ok(Fields { line: self.line, item: item.to_owned(), left: entries.iter().collect() })
            }
            _ => Err(self.wrong(item, "keys with values")),
        }
    }

    /// The error that `item` is not what is expected.
    pub fn wrong(&self, item: &str, expected: &'static str) -> ImportError {
        let found = match &self.value {
            YamlValue::Scalar(text) => text.clone(),
            YamlValue::List(_) => "a list".into(),
            YamlValue::Mapping(_) => "keys with values".into(),
        };
        ImportError::at(self.line, item, wrong_value(found, expected))
    }
}

/// The entries of a mapping that have not been taken yet.
pub(super) struct Fields<'a> {
    /// The line the mapping begins in.
    pub line: usize,
    item: String,
    left: Vec<&'a (String, usize, YamlNode)>,
}

impl<'a> Fields<'a> {
    /// Takes the value of a key, if it is there.
    pub fn take(&mut self, key: &str) -> Option<&'a YamlNode> {
        let at = self.left.iter().position(|(k, ..)| k == key)?;
        Some(&self.left.remove(at).2)
    }

    /// Takes the value of a key that must be there.
    pub fn need(&mut self, key: &'static str) -> Result<&'a YamlNode, ImportError> {
        self.take(key).ok_or_else(|| ImportError::at(self.line, &self.item, ImportProblem::Missing(key)))
    }

    /// The remaining keys, with their lines.
    pub fn others(&self) -> impl Iterator<Item = (&'a str, usize)> {
        self.left.iter().map(|(key, line, _)| (key.as_str(), *line))
    }

    /// Takes one of the remaining keys, with its line.
    pub fn rest(&mut self) -> Option<(&'a str, usize)> {
        self.left.pop().map(|(key, line, _)| (key.as_str(), *line))
    }

    /// Refuses keys that have not been taken.
    pub fn finish(mut self, known: &str) -> Result<(), ImportError> {
        self.left.reverse();
        match self.rest() {
            None => Ok(()),
            Some((key, line)) => {
                let at = if self.item.is_empty() { key.to_owned() } else { format!("{}.{key}", self.item) };
                Err(ImportError::at(line, at, ImportProblem::Unsupported(format!("this key; known are {known}"))))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> String {
        read(text).unwrap_err().to_string()
    }

    #[test]
    fn parts_know_their_lines() {
        let tree = read("# head\na: 1\nb:\n  - {c: [1, 2.5], d: 'x'}\n  - e\n").unwrap();
        let mut fields = tree.fields("").unwrap();
        assert_eq!(fields.need("a").unwrap().number("a"), Ok(1.0));
        let list = fields.need("b").unwrap().list("b").unwrap();
        assert_eq!((list[0].line, list[1].line), (4, 5));
        let mut inner = list[0].fields("b[0]").unwrap();
        assert_eq!(inner.need("c").unwrap().numbers("c", 2..=3, "two or three numbers"), Ok(vec![1.0, 2.5]));
        let error = inner.finish("c").unwrap_err().to_string();
        assert!(error.contains(":4: b[0].d: not supported"), "{error}");
        assert!(fields.need("z").unwrap_err().to_string().contains("`z` is missing"));
        assert!(fields.finish("").is_ok());
        assert!(read("").unwrap().fields("").unwrap().finish("").is_ok());
    }

    #[test]
    fn what_is_no_tree_of_its_own_size_is_refused() {
        assert!(refusal("a: &x 1\nb: *x").contains(":1: not supported: anchors"));
        assert!(refusal("a: !!str 1").contains("tags"));
        assert!(refusal("a: 1\nb: 2\na: 3").contains(":3: a: the key stands there twice"));
        assert!(refusal("a: 1\n---\nb: 2").contains("a second document"));
        assert!(refusal("? [a]\n: 1").contains("a key must be a word"));
        assert!(refusal(&"[".repeat(33)).contains("nested too deeply"));
        assert!(refusal(&"- ".repeat(33)).contains("nested too deeply"));
        // an error, not a crash
        assert!(read(&"[".repeat(100_000)).is_err() && read(&"- ".repeat(100_000)).is_err());
        assert!(refusal("a: [1, 2").starts_with(":"), "an end is missing");
        let keys = |n: usize| (0..n).map(|k| format!("k{k}: 1\n")).collect::<String>();
        assert!(read(&keys(100)).is_ok());
        assert!(refusal(&keys(101)).starts_with(":101: not supported: more than 100 keys of one mapping"));
        // the list itself is a value, too, and so are the mapping around it and its key
        let values = |n: usize| format!("a:\n{}", "- 1\n".repeat(n - 3));
        assert!(read(&values(200_000)).is_ok());
        assert!(refusal(&values(200_001)).contains("not supported: more than 200000 values"));
        let signs = |n: usize| format!("a: [{}1]", "1,".repeat(n - 2));
        assert!(read(&signs(50_000)).is_ok());
        assert!(refusal(&signs(50_001)).contains("not supported: more than 50000 of the signs , [ ] { }"));
    }

    #[test]
    fn numbers_are_finite_and_may_stand_in_quotes() {
        for bad in [".nan", ".inf", "nan", "inf", "-infinity", "1e999", "0x10", "'1m'", "one", "", "[1]"] {
            let tree = read(&format!("a: {bad}")).unwrap();
            let number = tree.fields("").unwrap().need("a").unwrap().number("a");
            assert!(number.unwrap_err().to_string().contains("it must be a finite number"), "{bad}");
        }
        for good in ["0.5", "'0.5'", "\"0.5\"", "+.5", "5e-1", "5.0E-01", "' 0.5 '"] {
            let tree = read(&format!("a: {good}")).unwrap();
            assert_eq!(tree.fields("").unwrap().need("a").unwrap().number("a"), Ok(0.5), "{good}");
        }
    }

    #[test]
    fn yes_and_no_have_the_words_of_yaml() {
        let boolean =
            |text: &str| read(&format!("a: {text}")).unwrap().fields("").unwrap().need("a").unwrap().boolean("a");
        for (yes, no) in
            [("true", "false"), ("True", "False"), ("TRUE", "'FALSE'"), ("yes", "no"), ("On", "OFF"), ("Y", "n")]
        {
            assert_eq!((boolean(yes), boolean(no)), (Ok(true), Ok(false)), "{yes} {no}");
        }
        for neither in ["tRUE", "nO", "1", "maybe", "''", "[true]"] {
            assert!(boolean(neither).is_err(), "{neither}");
        }
    }
}
