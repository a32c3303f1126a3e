//! `Shard`, one of the parts that a sweep is divided into.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// Part `number` of `of`, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: u64,
    of: u64,
}

/// Why there is no such shard.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ShardError {
    /// A text of another form.
    #[error("{0:?} is no shard: write K/N with K from 1 to N, as 3/8")]
    Form(String),
    /// No cluster's variables.
    #[error("no task number: neither SLURM_ARRAY_TASK_ID, nor HQ_TASK_ID, nor JOB_COMPLETION_INDEX is set; write K/N")]
    NoTask,
    /// A task number without a number of tasks.
    #[error("{0} does not say how many tasks there are: write auto/N")]
    NoCount(&'static str),
    /// A variable that holds no whole number.
    #[error("{name}={value:?} is no whole number")]
    Variable {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: String,
    },
    /// An array that leaves numbers out, so that its count of tasks does not say which they are.
    #[error(
        "the array's tasks are {count} of the numbers {first} to {last}: with gaps nobody can tell which rows are \
         whose; number them without gaps, or write auto/N for N shards, of which the tasks 1 to N are numbered"
    )]
    Gaps {
        /// The number of the first task.
        first: u64,
        /// The number of the last task.
        last: u64,
        /// The number of tasks.
        count: u64,
    },
    /// A task beyond the number of shards.
    #[error("{name}={value}: there are {of} shards; number the tasks from {first}")]
    Beyond {
        /// The variable.
        name: &'static str,
        /// Its value.
        value: u64,
        /// The number of shards.
        of: u64,
        /// The number of the first task.
        first: u64,
    },
}

impl Shard {
    /// The whole sweep.
    pub const WHOLE: Shard = Shard { number: 1, of: 1 };

    /// The shard of this number, from 1; `None` beyond the end.
    pub fn new(number: u64, of: u64) -> Option<Self> {
        (1..=of).contains(&number).then_some(Shard { number, of })
    }

    /// The shard that a cluster's engine asks for by its environment, which `variable` reads. `count` is the number of
    /// shards where the command line says it.
    ///
    /// | engine | the task | numbered from | the count |
    /// |---|---|---|---|
    /// | HyperQueue | `HQ_TASK_ID` | 1 | `count` |
    /// | Kubernetes Indexed Job | `JOB_COMPLETION_INDEX` | 0 | `count` |
    /// | Slurm array | `SLURM_ARRAY_TASK_ID` | 1 | `count` |
    /// | the same | the same | `SLURM_ARRAY_TASK_MIN` | without `count`: `SLURM_ARRAY_TASK_COUNT` |
    ///
    /// An array that leaves numbers out, as `--array=1-7:2` or `--array=1,2,9`, has no shards without `count`: that
    /// `SLURM_ARRAY_TASK_MIN` to `SLURM_ARRAY_TASK_MAX` are as many as its tasks is checked.
    ///
    /// # Errors
    /// [`ShardError`] when no engine says a task, nobody a count, or an array leaves numbers out.
    pub fn of_engine(count: Option<u64>, variable: impl Fn(&str) -> Option<String>) -> Result<Self, ShardError> {
        let number = |name: &'static str| {
            variable(name)
                .map(|value| value.parse::<u64>().map_err(|_| ShardError::Variable { name, value }))
                .transpose()
        };
        // HyperQueue's workers may themselves be tasks of a Slurm array
        let (name, task, first) = if let Some(task) = number("HQ_TASK_ID")? {
            ("HQ_TASK_ID", task, 1)
        } else if let Some(task) = number("JOB_COMPLETION_INDEX")? {
            ("JOB_COMPLETION_INDEX", task, 0)
        } else if let Some(task) = number("SLURM_ARRAY_TASK_ID")? {
            // With a count the tasks are 1 to N, so that some of them can be submitted again. Without one the array
            // itself is the count.
            let first = if count.is_some() { None } else { number("SLURM_ARRAY_TASK_MIN")? };
            ("SLURM_ARRAY_TASK_ID", task, first.unwrap_or(1))
        } else {
            return Err(ShardError::NoTask);
        };
        let of = match count {
            Some(of) => of,
            None if name == "SLURM_ARRAY_TASK_ID" => {
                let count = number("SLURM_ARRAY_TASK_COUNT")?.ok_or(ShardError::NoCount(name))?;
                let last = number("SLURM_ARRAY_TASK_MAX")?;
                if let Some(last) = last.filter(|last| last.checked_sub(first) != count.checked_sub(1)) {
                    return Err(ShardError::Gaps { first, last, count });
                }
                count
            }
            None => return Err(ShardError::NoCount(name)),
        };
        let shard = task.checked_sub(first).and_then(|k| Shard::new(k.saturating_add(1), of));
        shard.ok_or(ShardError::Beyond { name, value: task, of, first })
    }

    /// The rows of this shard, of `runs` in all. Shards differ by one row at most, and together have each row once.
    pub fn rows(self, runs: u64) -> Range<u64> {
        let cut = |k: u64| (u128::from(runs) * u128::from(k) / u128::from(self.of)) as u64;
        cut(self.number - 1)..cut(self.number)
    }
}

/// `3-of-8`, as file names have it.
impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-of-{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let wrong = || ShardError::Form(text.to_owned());
        let (number, of) = text.split_once('/').ok_or_else(wrong)?;
        let number = number.parse().map_err(|_| wrong())?;
        Shard::new(number, of.parse().map_err(|_| wrong())?).ok_or_else(wrong)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_the_rows_evenly_and_leave_none_out() {
        for (runs, of) in [(10, 3), (3, 7), (1, 1), (10_000_000, 1499), (6, 6)] {
            let mut next = 0;
            for number in 1..=of {
                let rows = Shard::new(number, of).unwrap().rows(runs);
                assert_eq!(rows.start, next, "{number}/{of}");
                assert!((runs / of..=runs.div_ceil(of)).contains(&(rows.end - rows.start)));
                next = rows.end;
            }
            assert_eq!(next, runs);
        }
        assert_eq!("3/8".parse(), Ok(Shard { number: 3, of: 8 }));
        for wrong in ["0/8", "9/8", "3", "3/", "a/b", "1/0", "3/8/9", "-1/2"] {
            assert_eq!(wrong.parse::<Shard>(), Err(ShardError::Form(wrong.into())));
        }
    }

    /// The engines' documentation gives the names and where their numbers begin.
    #[test]
    fn engines_say_their_task_by_the_environment() {
        let of = |count, set: &[(&str, &str)]| {
            let found = |name: &str| set.iter().find(|(n, _)| *n == name).map(|(_, value)| (*value).to_owned());
            Shard::of_engine(count, found).map(|shard| shard.to_string())
        };
        let array = [("SLURM_ARRAY_TASK_ID", "12"), ("SLURM_ARRAY_TASK_COUNT", "4"), ("SLURM_ARRAY_TASK_MIN", "10")];
        assert_eq!(of(None, &array), Ok("3-of-4".into()), "an array 10-13");
        assert_eq!(of(Some(20), &array), Ok("12-of-20".into()), "some tasks of 1-20 once more");
        // sbatch(1): --array=1-7:2 is 1, 3, 5, 7, and --array=10,12,13 is those three
        let with_max = |id, min, max, count| {
            let names = ["ID", "MIN", "MAX", "COUNT"].map(|name| format!("SLURM_ARRAY_TASK_{name}"));
            let set: Vec<(&str, &str)> = names.iter().map(String::as_str).zip([id, min, max, count]).collect();
            [of(None, &set), of(Some(20), &set)]
        };
        assert_eq!(with_max("12", "10", "13", "4")[0], Ok("3-of-4".into()));
        assert_eq!(with_max("7", "7", "7", "1")[0], Ok("1-of-1".into()), "an array of one");
        let gaps = |first, last, count| Err(ShardError::Gaps { first, last, count });
        assert_eq!(with_max("3", "1", "7", "4"), [gaps(1, 7, 4), Ok("3-of-20".into())]);
        assert_eq!(with_max("10", "10", "13", "3"), [gaps(10, 13, 3), Ok("10-of-20".into())]);
        assert_eq!(with_max("1", "1", "2", "4")[0], gaps(1, 2, 4), "numbers that no array has");
        assert_eq!(of(Some(5), &[("HQ_TASK_ID", "5")]), Ok("5-of-5".into()));
        assert_eq!(of(Some(5), &[("HQ_TASK_ID", "2"), array[0], array[1], array[2]]), Ok("2-of-5".into()));
        assert_eq!(of(Some(5), &[("JOB_COMPLETION_INDEX", "0")]), Ok("1-of-5".into()));
        assert_eq!(of(Some(5), &[("JOB_COMPLETION_INDEX", "4")]), Ok("5-of-5".into()));
        assert_eq!(of(None, &[("HQ_TASK_ID", "5")]), Err(ShardError::NoCount("HQ_TASK_ID")));
        assert_eq!(of(None, &array[..1]), Err(ShardError::NoCount("SLURM_ARRAY_TASK_ID")));
        assert_eq!(of(Some(5), &[]), Err(ShardError::NoTask));
        let wrong = ShardError::Variable { name: "HQ_TASK_ID", value: "x".into() };
        assert_eq!(of(Some(5), &[("HQ_TASK_ID", "x")]), Err(wrong));
        let beyond = |value, first, name| Err(ShardError::Beyond { name, value, of: 5, first });
        assert_eq!(of(Some(5), &[("JOB_COMPLETION_INDEX", "5")]), beyond(5, 0, "JOB_COMPLETION_INDEX"));
        assert_eq!(of(Some(5), &[("HQ_TASK_ID", "0")]), beyond(0, 1, "HQ_TASK_ID"));
    }
}
