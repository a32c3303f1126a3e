//! Parses YAML into a tree in which every part knows its line. An alias is a copy of what its anchor names, within
//! limits that keep the tree small; the key `<<` merges a mapping. Tags are refused: maps and scenes have none.
//! A key that stands twice in a mapping is refused, unless the format's own reader settles which one counts.

use std::collections::BTreeMap;

use saphyr_parser::{Event, Parser};

use super::node::{YamlNode, YamlValue};
use crate::{ImportError, ImportProblem};

/// Greatest depth of nested lists and mappings.
const DEEPEST: usize = 32;

/// Largest number of values, including keys.
const MAX_VALUES: usize = 200_000;

/// Largest number of the signs `, [ ] { }`. The parser keeps a whole list in brackets until it ends, some hundred bytes
/// a value.
const MAX_SIGNS: usize = 50_000;

/// Largest number of keys of one mapping: each is compared with those before it.
const MAX_KEYS: usize = 100;

/// Largest size of the texts that aliases copy, bytes.
const MAX_COPIED: usize = 1 << 20;

/// A list or mapping whose end has not been read, with the number of its anchor, 0 for none.
enum OpenNode {
    List(usize, usize, Vec<YamlNode>),
    Mapping(usize, usize, Vec<(String, usize, YamlNode)>, Option<(String, usize)>),
}

/// What an anchor names, and how large it is.
struct Anchored {
    node: YamlNode,
    values: usize,
    bytes: usize,
    depth: usize,
}

impl Anchored {
    fn new(node: YamlNode) -> Self {
        let [values, bytes, depth] = node.size();
        Anchored { node, values, bytes, depth }
    }
}

/// What becomes of a key that stands in one mapping twice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum RepeatedKeys {
    /// It is refused: readers disagree on it. yaml-cpp takes the first one, PyYAML the last.
    #[default]
    Refused,
    /// The last one counts.
    LastCounts,
}

/// A document under construction.
#[derive(Default)]
struct YamlBuilder {
    repeated: RepeatedKeys,
    notes: Vec<String>,
    open: Vec<OpenNode>,
    whole: Option<YamlNode>,
    values: usize,
    anchors: BTreeMap<usize, Anchored>,
    copied: usize,
}

/// Parses a file that holds one document. An empty file is an empty mapping. A key that stands in a mapping twice is
/// refused.
pub(crate) fn read(text: &str) -> Result<YamlNode, ImportError> {
    build(text, RepeatedKeys::Refused).map(|builder| builder.whole())
}

/// Parses a file as PyYAML does: of a key that stands in a mapping twice the last one counts. Also returns a note on
/// each.
pub(crate) fn read_as_python(text: &str) -> Result<(YamlNode, Vec<String>), ImportError> {
    let mut builder = build(text, RepeatedKeys::LastCounts)?;
    let notes = std::mem::take(&mut builder.notes);
    Ok((builder.whole(), notes))
}

fn build(text: &str, repeated: RepeatedKeys) -> Result<YamlBuilder, ImportError> {
    if text.bytes().filter(|b| b",[]{}".contains(b)).count() > MAX_SIGNS {
        return Err(unsupported(
            0,
            &format!("more than {MAX_SIGNS} of the signs , [ ] {{ }}; lists of a line each have none"),
        ));
    }
    let mut builder = YamlBuilder { repeated, ..YamlBuilder::default() };
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| syntax(error.marker().line(), error.info()))?;
        builder.take(event, span.start.line())?;
    }
    Ok(builder)
}

impl YamlBuilder {
    fn whole(self) -> YamlNode {
        self.whole.unwrap_or(YamlNode { line: 1, value: YamlValue::Mapping(Vec::new()) })
    }

    fn take(&mut self, event: Event, line: usize) -> Result<(), ImportError> {
        match event {
            Event::Scalar(_, _, _, Some(_)) | Event::SequenceStart(_, Some(_)) | Event::MappingStart(_, Some(_)) => {
                Err(unsupported(line, "tags"))
            }
            Event::Scalar(text, _, anchor, _) => {
                self.close(YamlNode { line, value: YamlValue::Scalar(text.into()) }, anchor, 1)
            }
            Event::Alias(anchor) => self.copy(anchor, line),
            Event::SequenceStart(..) | Event::MappingStart(..) if self.open.len() == DEEPEST => {
                Err(syntax(line, "nested too deeply"))
            }
            Event::SequenceStart(anchor, _) => {
                self.open.push(OpenNode::List(anchor, line, Vec::new()));
                Ok(())
            }
            Event::MappingStart(anchor, _) => {
                self.open.push(OpenNode::Mapping(anchor, line, Vec::new(), None));
                Ok(())
            }
            Event::SequenceEnd | Event::MappingEnd => match self.open.pop() {
                Some(OpenNode::List(anchor, line, nodes)) => {
                    self.close(YamlNode { line, value: YamlValue::List(nodes) }, anchor, 1)
                }
                Some(OpenNode::Mapping(anchor, line, entries, _)) => {
                    self.close(YamlNode { line, value: YamlValue::Mapping(merged(entries)?) }, anchor, 1)
                }
                None => Ok(()),
            },
            Event::DocumentStart(_) if self.whole.is_some() => Err(syntax(line, "a second document")),
            _ => Ok(()),
        }
    }

    /// Adds a copy of what an anchor names.
    fn copy(&mut self, anchor: usize, line: usize) -> Result<(), ImportError> {
        let named = self.anchors.get(&anchor).ok_or_else(|| syntax(line, "an alias of a part that has not ended"))?;
        self.copied += named.bytes;
        if self.copied > MAX_COPIED {
            return Err(unsupported(line, &format!("aliases that copy more than {MAX_COPIED} bytes")));
        }
        if self.open.len() + named.depth > DEEPEST {
            return Err(syntax(line, "nested too deeply"));
        }
        let (node, values) = (named.node.clone(), named.values);
        self.close(node, 0, values)
    }

    /// Adds a finished node to the list or mapping that it stands in. It holds this number of values.
    fn close(&mut self, node: YamlNode, anchor: usize, values: usize) -> Result<(), ImportError> {
        self.values += values;
        if self.values > MAX_VALUES {
            return Err(unsupported(node.line, &format!("more than {MAX_VALUES} values")));
        }
        if anchor > 0 {
            let named = Anchored::new(node.clone());
            self.copied += named.bytes;
            self.values += named.values;
            self.anchors.insert(anchor, named);
        }
        match self.open.last_mut() {
            None => self.whole = Some(node),
            Some(OpenNode::List(_, _, nodes)) => nodes.push(node),
            Some(OpenNode::Mapping(_, _, entries, key)) => match key.take() {
                Some((key, key_line)) => entries.push((key, key_line, node)),
                None => {
                    if self.repeated == RepeatedKeys::LastCounts {
                        self.notes.extend(without_earlier(&node, entries));
                    }
                    *key = Some(key_of(node, entries)?);
                }
            },
        }
        Ok(())
    }
}

/// The entries of a mapping with those that its key `<<` adds: those whose keys are not there.
fn merged(mut entries: Vec<(String, usize, YamlNode)>) -> Result<Vec<(String, usize, YamlNode)>, ImportError> {
    let Some(at) = entries.iter().position(|(key, ..)| key == "<<") else { return Ok(entries) };
    let (_, line, node) = entries.remove(at);
    let sources = match node.value {
        YamlValue::List(nodes) => nodes,
        _ => vec![node],
    };
    for source in sources {
        let YamlValue::Mapping(more) = source.value else { return Err(syntax(line, "<< takes keys with values")) };
        for entry in more {
            if entries.len() == MAX_KEYS {
                return Err(unsupported(line, &format!("more than {MAX_KEYS} keys of one mapping")));
            }
            if entries.iter().all(|(key, ..)| *key != entry.0) {
                entries.push(entry);
            }
        }
    }
    Ok(entries)
}

/// Removes the entry of this key, if there is one, and returns a note on it. Of `<<` every one counts.
fn without_earlier(key: &YamlNode, before: &mut Vec<(String, usize, YamlNode)>) -> Option<String> {
    let YamlValue::Scalar(text) = &key.value else { return None };
    let at = before.iter().position(|(earlier, ..)| earlier == text && text != "<<")?;
    let (name, line, _) = before.remove(at);
    Some(format!("{name} stands in line {line} and again in line {}, which counts", key.line))
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
    fn aliases_are_copies_and_merges_add_keys() {
        let plain = |node: &YamlNode| format!("{:?}", node.value).replace(|c: char| c.is_ascii_digit(), "");
        let same = |text: &str, expected: &str| {
            assert_eq!(plain(&read(text).unwrap()), plain(&read(expected).unwrap()), "{text}");
        };
        same("a: &x [u, {v: w}]\nb: *x\nc: &y t\nd: *y", "a: [u, {v: w}]\nb: [u, {v: w}]\nc: t\nd: t");
        same("a: &x {u: v, k: w}\nb: {<<: *x, k: own}", "a: {u: v, k: w}\nb: {k: own, u: v}");
        same("a: &x {u: v}\nc: &y {u: n, m: n}\nb: {<<: [*x, *y]}", "a: {u: v}\nc: {u: n, m: n}\nb: {u: v, m: n}");
        assert!(refusal("a: &x [1, *x]").contains("an alias of a part that has not ended"));
        assert!(refusal("b: {<<: 1}").contains("<< takes keys with values"));
        assert!(read("a: *x").is_err(), "an alias of nothing");
    }

    /// Without the limits, a file of a kilobyte is a tree of gigabytes.
    #[test]
    fn aliases_of_aliases_stay_small() {
        let mut text = String::from("a0: &a0 [x, x, x, x, x, x, x, x, x]\n");
        for i in 1..10 {
            let before = format!("*a{}", i - 1);
            text += &format!("a{i}: &a{i} [{}]\n", [before.as_str(); 9].join(", "));
        }
        assert!(refusal(&text).contains("not supported: more than 200000 values"), "{}", refusal(&text));
        // copies that have no anchor of their own count, too
        let wide = format!("a: &a [{}]\nb: [{}]\n", ["x"; 100].join(", "), ["*a"; 2100].join(", "));
        assert!(refusal(&wide).contains("not supported: more than 200000 values"));
        let long = format!("a: &a {}\nb: [{}]\n", "x".repeat(50_000), ["*a"; 100].join(", "));
        assert!(refusal(&long).contains("not supported: aliases that copy more than 1048576 bytes"));
        let deep = format!("a: &a {}{}\nb: {}*a{}\n", "[".repeat(20), "]".repeat(20), "[".repeat(20), "]".repeat(20));
        assert!(refusal(&deep).contains("nested too deeply"));
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
