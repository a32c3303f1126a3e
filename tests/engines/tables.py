"""tables.py PARQUET CSV: pandas, polars and DuckDB read the merged table of a sweep, each with its types, units and values.

Every cell of every reader is the CSV's: the same whole number, the same 64 bits of a number, the same text, nothing where it is
empty. The units come from the metadata of the file, as each reader hands it out.
"""

import csv
import json
import sys

import duckdb
import pandas
import polars
import pyarrow.parquet

parquet, table = sys.argv[1:]
with open(table, newline="") as stream:
    names, *rows = csv.reader(stream)

columns = json.loads(pyarrow.parquet.read_metadata(parquet).metadata[b"motion-lab.columns"])
assert [column["name"] for column in columns] == names
read = {"whole": int, "number": float, "text": str}
expected = {
    column["name"]: [None if row[i] == "" else read[column["kind"]](row[i]) for row in rows]
    for i, column in enumerate(columns)
}
kinds = [column["kind"] for column in columns]


def check(reader, types, known, units, values):
    """`types` of the columns, which `known` names for each kind; the metadata's entry; a function from name to values."""
    assert [str(t) for t in types] == [known[kind] for kind in kinds], (reader, types)
    assert json.loads(units) == columns, reader
    cells = 0
    for name in names:
        found = values(name)
        # numbers that are equal and not the same bits are zeros of two signs, of which a table has one
        assert found == expected[name], (reader, name)
        cells += len(found)
    with_unit = sum(1 for column in columns if column["unit"])
    print(f"{reader}: {len(rows)} rows, {len(names)} columns, {with_unit} with a unit; {cells} cells equal those of the CSV")


frame = pandas.read_parquet(parquet, dtype_backend="pyarrow")
check(
    f"pandas {pandas.__version__}",
    frame.dtypes,
    {"whole": "uint64[pyarrow]", "number": "double[pyarrow]", "text": "string[pyarrow]"},
    pyarrow.parquet.read_schema(parquet).metadata[b"motion-lab.columns"],
    lambda name: [None if value is pandas.NA else value for value in frame[name].array],
)
lazy = polars.read_parquet(parquet)
check(
    f"polars {polars.__version__}",
    lazy.schema.dtypes(),
    {"whole": "UInt64", "number": "Float64", "text": "String"},
    polars.read_parquet_metadata(parquet)["motion-lab.columns"],
    lambda name: lazy[name].to_list(),
)
base = duckdb.connect()
described = base.execute(f"describe select * from '{parquet}'").fetchall()
entry = base.execute(f"select value from parquet_kv_metadata('{parquet}') where key = 'motion-lab.columns'").fetchall()
check(
    f"DuckDB {duckdb.__version__}",
    [row[1] for row in described],
    {"whole": "UBIGINT", "number": "DOUBLE", "text": "VARCHAR"},
    entry[0][0],
    lambda name: [row[0] for row in base.execute(f"select \"{name}\" from '{parquet}' order by file_row_number").fetchall()],
)
print("a question:", base.execute(f"select count(*), sum(contacts), round(avg(path_m), 6) from '{parquet}'").fetchall()[0])
