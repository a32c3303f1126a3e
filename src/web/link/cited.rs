//! Words of somebody else, as a refusal repeats them.

/// Largest number of characters of a link that its refusal repeats: too few for a sentence of the link's maker.
const MAX_CITED: usize = 12;

/// Largest number of characters of what is said about a script.
const MAX_OF_SCRIPT: usize = 100;

/// Words of somebody else, so that nobody takes them for the lab's: between quotes and cut short.
pub fn cited(text: &str) -> String {
    format!("{:?}", cut(text, MAX_CITED))
}

/// What is said about the link's run, without long names that the link gives: those are between quotes or backticks,
/// where a quote within is escaped.
pub fn requoted(error: &impl ToString) -> String {
    let (mut said, mut name) = (String::new(), None::<(char, String)>);
    let text = error.to_string();
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        match &mut name {
            Some((mark, inner)) if letter == *mark => {
                said.extend([cut(inner, MAX_CITED), letter.to_string()]);
                name = None;
            }
            Some((_, inner)) => {
                inner.push(letter);
                inner.extend((letter == '\\').then(|| letters.next()).flatten());
            }
            None => {
                said.push(letter);
                name = matches!(letter, '"' | '`').then(|| (letter, String::new()));
            }
        }
    }
    // a name without an end
    said.extend(name.map(|(_, inner)| cut(&inner, MAX_CITED)));
    cut(&said, MAX_OF_SCRIPT)
}

/// The text up to a number of characters; dots stand for the rest.
fn cut(text: &str, most: usize) -> String {
    let end = text.char_indices().nth(most).map_or(text.len(), |(at, _)| at);
    format!("{}{}", &text[..end], if end < text.len() { "..." } else { "" })
}
