//! What is said of worlds, scripts and assignments that can't be read: in the words of those who write such files.

use motion_lab::recording::AssignmentFile;
use motion_lab::run::Script;
use motion_lab::worlds::World;
use motion_lab_sim::manifest::Lesson;

const SCRIPT: &str = r#"// a drive
Script(version: 2, events: [
    (tick: 1, robot: "Rusty", input: Drive(128, -128)),
    (tick: 1, robot: "Reach", input: MoveTo([1048576, -5])),
    (tick: 7, robot: "Hitch", input: SetTrailer(true)),
    (tick: 9, robot: "Hitch", input: Release),
], changes: [
    (tick: 3, world: "Lot", change: Close("the gate")),
    (tick: 4, world: "Lot", change: Move(name: "the crate", to: (0, 1, 2))),
    (tick: 5, world: "Lot", change: Add(name: "a post", points: [(0, 1048576), (2097152, 3145728)], radius: 104857)),
])
"#;

const ASSIGNMENT: &str = r#"// parking
Assignment(
    version: 1, world: "lot", robot: "Hitch", start: [6.5, 2.5, 0],
    goal: (at: [7.5, 2.5, 0], within: [0.1, 0.1, 0.1]),
    stay: (hold: 20, at: end),
    limits: (ticks: 200, contacts: 0, reversals: 3),
    points: (goal: 6, contacts: 2, reversals: 2),
    seeds: "0..10",
)
"#;

type Read = fn(&str) -> Option<String>;

/// What each kind of file says of a text; `None` where it takes it.
const KINDS: [Read; 3] = [
    |text| World::parse("w", text).err().map(|error| error.problem.to_string()),
    |text| Script::parse("s", text).err().map(|error| error.problem.to_string()),
    |text| AssignmentFile::parse("a", text).err().map(|error| error.to_string()),
];

/// Words that are RON's, serde's or the names of this program's types, and that no writer of a file knows.
const NOT_OURS: [&str; 19] = [
    "identifier",
    "Identifier",
    "std",
    "xpected",
    "issing field",
    "enum",
    "struct",
    "Text",
    "variant",
    "tuple",
    "RawValue",
    "Spanned",
    "Option",
    "i16",
    "ron::",
    "serde",
    "integer",
    "float",
    "Non-whitespace",
];

/// Every text that a file becomes by cutting it off, or by leaving out, replacing or adding a little.
#[test]
fn no_message_has_the_words_of_the_language_this_program_is_written_in() {
    let world = World::built_in("lot").unwrap().to_ron();
    for (read, whole, every) in [(KINDS[0], &world[..], 3), (KINDS[1], SCRIPT, 1), (KINDS[2], ASSIGNMENT, 1)] {
        assert_eq!(read(whole), None);
        let mut refused = 0;
        for i in (0..whole.len()).filter(|i| whole.is_char_boundary(*i)).step_by(every) {
            let (before, after) = whole.split_at(i);
            let rest: String = after.chars().skip(1).collect();
            let changed = ["", "?", "x", "\"", "7", "[", "}"].map(|new| format!("{before}{new}{rest}"));
            let longer = ["(3 ", "None", "true, ", "\"a\": "].map(|new| format!("{before}{new}{after}"));
            for text in changed.into_iter().chain(longer).chain([before.to_owned()]) {
                let Some(problem) = read(&text) else { continue };
                refused += 1;
                let leak = NOT_OURS.iter().find(|word| problem.contains(*word));
                assert!(leak.is_none(), "{leak:?} in {problem:?}");
            }
        }
        assert!(refused > 1000, "{refused}");
    }
}

/// The sorts of mistakes, of each kind of file, with what is to be said and where.
#[test]
fn mistakes_in_assignments_and_scripts_are_named_with_their_item() {
    for (from, to, said) in [
        ("    limits: (ticks: 200, contacts: 0, reversals: 3),\n", "", "8:1: the field `limits` is missing"),
        (
            "    points: (goal: 6, contacts: 2, reversals: 2),\n    seeds: \"0..10\",\n)",
            "    points: (goal: 6))",
            "7:22: the field `seeds` is missing",
        ),
        (
            "robot:",
            "robots:",
            "3:31: there is no field `robots` here: the fields are version, world, robot, start, goal, stay, limits, points, set_trailer or seeds",
        ),
        ("at: [7.5, 2.5, 0], ", "", "4:35: goal: the field `at` is missing"),
        ("within", "width", "4:31: goal: there is no field `width` here: the fields are at, within or ticks"),
        ("ticks: 200", "ticks: \"200\"", "6:20: limits: a whole number belongs here"),
        ("ticks: 200", "ticks: 2.5", "6:22: limits: a whole number belongs here"),
        ("\"lot\"", "lot", "3:23: world: a text in quotes belongs here"),
        ("start: [6.5, 2.5, 0]", "start: 3", "3:53: start: a list in `[` and `]` belongs here"),
        ("at: end", "at: never", "5:26: stay: there is no `never` here: write any or end"),
        ("at: end", "at: \"end\"", "5:26: stay: a name without quotes belongs here"),
        ("(hold: 20, at: end)", "end", "5:11: stay: \"end\" stands where a list of fields in `(` and `)` belongs"),
        ("(goal: 6, contacts: 2, reversals: 2)", "10", "7:12: points: a list of fields in `(` and `)` belongs here"),
        (
            "\"0..10\"",
            "7",
            "8:12: seeds: a list of seeds, as [1, 2005], or of ranges in quotes, as \"0..100\", belongs here",
        ),
        (
            "\"0..10\"",
            "all",
            "8:15: seeds: a list of seeds, as [1, 2005], or of ranges in quotes, as \"0..100\", belongs here",
        ),
        (",\n)", ",\n", "8:20: the text ends too early: is a bracket or a quote left open?"),
        (",\n)", ",\n) x", "9:2: the text goes on after its last bracket"),
        ("Assignment(", "Exam(", "2:1: \"Exam\" stands where `Assignment` belongs"),
    ] {
        assert!(ASSIGNMENT.contains(from), "{from}");
        let error = AssignmentFile::parse("a", &ASSIGNMENT.replacen(from, to, 1)).unwrap_err();
        assert_eq!(error.to_string(), format!("a:{said}"), "{to}");
    }
    for (from, to, said) in [
        ("tick: 1, ", "", "3: events[0]: the field `tick` is missing"),
        ("tick: 1, ", "tick: 1.5, ", "3: events[0]: a whole number belongs here"),
        ("Drive(128, -128)", "Drive(128)", "3: events[0]: 1 value: there must be 2"),
        (
            "Release",
            "Explode",
            "6: events[3]: there is no `Explode` here: write Drive, MoveTo, Teleport, SetTrailer or Release",
        ),
        ("(0, 1, 2)", "0", "9: changes[1]: `(` belongs here"),
        ("])\n", "])\n)", "11: the text goes on after its last bracket"),
    ] {
        assert!(SCRIPT.contains(from), "{from}");
        let error = Script::parse("s", &SCRIPT.replacen(from, to, 1)).unwrap_err();
        assert_eq!(error.to_string(), format!("s:{said}"), "{to}");
    }
}

#[test]
fn the_page_about_course_pages_lists_every_lesson() {
    let page = include_str!("../../docs/web/course.md");
    let listed: Vec<&str> = page.lines().filter(|line| line.starts_with("| `")).collect();
    let row = |lesson: Lesson| format!("| `{}` | {} | {} |", lesson.id(), lesson.widget.text().short(), lesson.text());
    assert_eq!(listed, Lesson::all().map(row).collect::<Vec<_>>());
}
