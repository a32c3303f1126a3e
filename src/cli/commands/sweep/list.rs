//! What a study would run, a line for each run.

use crate::batch::{RunRow, Shard, Study};
use motion_lab_sim::export::csv_cell;

use crate::cli::support::console::note;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome};

/// Lists the runs of a shard as comma-separated values: the parameters, and why a run can't be.
pub fn list(study: &Study, shard: Shard, data: &mut Data) -> Result<Outcome, Failure> {
    let columns = study.columns();
    let width = columns.iter().position(|column| column.name == "failure").map_or(columns.len(), |at| at + 1);
    let names: Vec<String> = columns[..width].iter().map(|column| csv_cell(&column.name)).collect();
    data.data_line(names.join(","))?;
    let mut wrong = 0;
    for row in shard.rows(study.runs()) {
        if data.is_closed() {
            break;
        }
        let reason = study.setup(row).err();
        wrong += u64::from(reason.is_some());
        let cells = study.failed(row, &reason.unwrap_or_default()).cells.into_iter().take(width).collect();
        data.data_line(RunRow { row, cells }.to_table_line())?;
    }
    let axes = study.axes().map(|(name, len)| len.map_or_else(|| name.clone(), |len| format!("{name} ({len})")));
    let axes = axes.collect::<Vec<_>>().join(", ");
    let axes = if axes.is_empty() { "nothing".to_owned() } else { axes };
    let runs = counted(study.runs(), "run");
    note(format!("{runs}, varying {axes}; {wrong} of those listed can't be run"));
    Ok(Outcome::Done)
}
