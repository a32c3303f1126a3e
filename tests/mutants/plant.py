"""Many faults in one build: a function with faults has its body once as it is and once for each of them, and an environment variable says
which is the one that runs. A function that was entered says so to a file, where one is named."""

import re
from collections import defaultdict
from pathlib import Path

# what each crate is given; `at` notes that the function of these faults is entered, and says which fault there is
SWITCH = r"""
#[doc(hidden)]
pub(crate) mod planted {
    use std::io::Write;
    use std::sync::OnceLock;
    use std::sync::atomic::{AtomicBool, Ordering};

    static FAULT: OnceLock<u32> = OnceLock::new();
    static ENTERED: [AtomicBool; NUMBERS] = [const { AtomicBool::new(false) }; NUMBERS];

    pub(crate) fn at(first: u32) -> u32 {
        if !ENTERED[first as usize].swap(true, Ordering::Relaxed)
            && let Some(path) = std::env::var_os("MOTION_LAB_ENTERED")
            && let Ok(mut file) = std::fs::OpenOptions::new().create(true).append(true).open(path)
        {
            let _ = file.write_all(format!("{first}\n").as_bytes());
        }
        *FAULT.get_or_init(|| std::env::var("MOTION_LAB_FAULT").ok().and_then(|text| text.parse().ok()).unwrap_or(0))
    }
}
"""
# comments, strings and what brackets hold do not open a body
SKIPPED = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|[^{(\[)\]"/]+|/', re.S)


def crate_of(file: str) -> str:
    """The folder of a file's crate, whose root is `src/lib.rs` in it."""
    return file[: file.index("src/")]


def place(text: str, span: dict) -> tuple[int, int]:
    """A span as offsets into the text."""
    lines = text.splitlines(keepends=True)
    start, end = (sum(map(len, lines[: at["line"] - 1])) + at["column"] - 1 for at in (span["start"], span["end"]))
    return start, end


def body(text: str, start: int, end: int) -> int:
    """Where the body of the function from `start` to `end` begins: after its brace."""
    depth, at = 0, start
    while at < end:
        if skipped := SKIPPED.match(text, at):
            at = skipped.end()
            continue
        if text[at] == "{" and depth == 0:
            return at + 1
        depth += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(text[at], 0)
        at += 1
    raise ValueError("a function without a body")


class Planted:
    """The faults that a tree's sources hold."""

    def __init__(self, tree: Path, mutants: dict[int, dict]) -> None:
        self.tree = tree
        self.most = max(mutants, default=0) + 1
        self.mutants = dict(mutants)
        self.before = {file: (tree / file).read_text() for file in {mutant["file"] for mutant in mutants.values()}}
        self.roots = {file: (tree / file).read_text() for file in {f"{crate_of(file)}src/lib.rs" for file in self.before}}
        # the first number of each fault's function, by which its tests are known
        self.functions: dict[int, int] = {}
        # the lines of each fault, by file
        self.lines: dict[str, list[tuple[int, int, int]]] = defaultdict(list)

    def write(self) -> None:
        """Writes the sources with their faults."""
        self.functions.clear()
        self.lines.clear()
        for file, text in self.before.items():
            (self.tree / file).write_text(self.planted(file, text))
        for file, text in self.roots.items():
            path = self.tree / file
            base = path.read_text() if file in self.before else text
            path.write_text(base + SWITCH.replace("NUMBERS", str(self.most)))

    def planted(self, file: str, text: str) -> str:
        """A file with its faults."""
        by_function = defaultdict(list)
        for number, mutant in sorted(self.mutants.items()):
            if mutant["file"] == file:
                by_function[place(text, mutant["function"]["span"])].append(number)
        # a function within another one belongs to the other one
        outer: dict[tuple[int, int], list[int]] = {}
        for span, numbers in sorted(by_function.items(), key=lambda entry: (entry[0][0], -entry[0][1])):
            around = next((other for other in outer if other[0] <= span[0] and span[1] <= other[1]), None)
            outer.setdefault(around or span, []).extend(numbers)
        pieces, last = [], 0
        for (start, end), numbers in sorted(outer.items()):
            begin, close = body(text, start, end), end - 1
            head = re.sub(r"\bconst ((?:unsafe )?fn\b)", r"\1", text[start:begin])
            whole = text[begin:close]
            given = ", ".join(map(str, numbers))
            pieces += [text[last:start], head, f" match crate::planted::at({numbers[0]}) {{ fault if ![{given}].contains(&fault) => {{{whole}}}\n"]
            for number in numbers:
                mutant = self.mutants[number]
                first, after = (at - begin for at in place(text, mutant["span"]))
                arm = whole[:first] + mutant["replacement"] + whole[after:]
                above = "".join(pieces).count("\n") + 1
                pieces.append(f"{number if number != numbers[-1] else '_'} => {{{arm}}}\n")
                self.lines[file].append((above, above + arm.count("\n"), number))
                self.functions[number] = numbers[0]
            pieces.append("}}")
            last = end
        return "".join([*pieces, text[last:]])

    def blamed(self, errors: list[dict]) -> set[int]:
        """The faults that a compiler's errors are about: none where an error is about none of them."""
        found = set()
        for error in errors:
            here = set()
            for span in error["spans"]:
                if span["is_primary"]:
                    lines = self.lines.get(span["file_name"], [])
                    here |= {number for first, last, number in lines if first <= span["line_start"] and span["line_end"] <= last}
            if not here and error["spans"]:
                return set()
            found |= here
        return found

    def constants(self) -> set[int]:
        """The faults within `const fn`, which something constant may call."""
        found = set()
        for number, mutant in self.mutants.items():
            text = self.before[mutant["file"]]
            start, end = place(text, mutant["function"]["span"])
            if re.search(r"\bconst (unsafe )?fn\b", text[start : body(text, start, end)]):
                found.add(number)
        return found

    def drop(self, numbers: set[int]) -> None:
        """Leaves faults out."""
        for number in numbers:
            del self.mutants[number]
