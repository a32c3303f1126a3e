//! `YamlNode`, a part of a YAML file, and `Fields`, the entries of a mapping.

use crate::error::wrong_value;
use crate::{ImportError, ImportProblem};

/// A part of a file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct YamlNode {
    pub line: usize,
    pub value: YamlValue,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum YamlValue {
    /// A text, without its quotes.
    Scalar(String),
    List(Vec<YamlNode>),
    /// Keys with their lines, no two of them equal.
    Mapping(Vec<(String, usize, YamlNode)>),
}

impl YamlNode {
    /// The node's values, keys among them, the bytes of its texts, and its depth.
    pub fn size(&self) -> [usize; 3] {
        let mut size = match &self.value {
            YamlValue::Scalar(text) => return [1, text.len(), 0],
            YamlValue::List(_) => [1, 0, 0],
            YamlValue::Mapping(entries) => [1 + entries.len(), entries.iter().map(|(key, ..)| key.len()).sum(), 0],
        };
        let add = |node: &YamlNode| {
            let [values, bytes, depth] = node.size();
            size = [size[0] + values, size[1] + bytes, size[2].max(depth)];
        };
        match &self.value {
            YamlValue::List(nodes) => nodes.iter().for_each(add),
            YamlValue::Mapping(entries) => entries.iter().map(|(_, _, node)| node).for_each(add),
            YamlValue::Scalar(_) => {}
        }
        [size[0], size[1], size[2] + 1]
    }

    /// A copy of a mapping without this key.
    pub fn without(&self, key: &str) -> YamlNode {
        let mut copy = self.clone();
        if let YamlValue::Mapping(entries) = &mut copy.value {
            entries.retain(|(found, ..)| found != key);
        }
        copy
    }

    /// Whether the node is YAML's nothing.
    pub fn is_null(&self) -> bool {
        matches!(&self.value, YamlValue::Scalar(text) if matches!(text.as_str(), "" | "~" | "null" | "Null" | "NULL"))
    }

    /// What the node says of thing number `i`: of a list that is not one of numbers an item, the last again where there
    /// are too few, else the node itself.
    pub fn each(&self, i: usize) -> &YamlNode {
        let is_number = |node: &YamlNode| matches!(&node.value, YamlValue::Scalar(text) if text.parse::<f64>().is_ok());
        match &self.value {
            YamlValue::List(nodes) if !nodes.iter().all(is_number) => nodes.get(i).or(nodes.last()).unwrap_or(self),
            _ => self,
        }
    }

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
pub(crate) struct Fields<'a> {
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
