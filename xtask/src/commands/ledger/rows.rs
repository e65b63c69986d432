//! The rows of `docs/ledger.toml`.

use std::collections::HashSet;

use toml::{Table, Value};

/// One numbered equation.
#[derive(Debug, PartialEq)]
pub(super) struct Row {
    pub(super) id: String,
    /// The crate's folder.
    pub(super) folder: String,
    pub(super) what: String,
    pub(super) is_done: bool,
    /// Rust paths, such as `piola_kinematics::Attitude`.
    pub(super) items: Vec<String>,
    /// Folder of the crate, test target and test, such as `kinematics::it::laws::name`; `lib` is the unit tests.
    pub(super) tests: Vec<String>,
}

/// The rows that could be read, and everything wrong with the others.
pub(super) fn parse(text: &str) -> (Vec<Row>, Vec<String>) {
    let (mut rows, mut problems) = (Vec::new(), Vec::new());
    let table: Table = match text.parse() {
        Ok(table) => table,
        Err(error) => return (rows, vec![format!("docs/ledger.toml: {error}")]),
    };
    let mut ids = HashSet::new();
    for entry in table.get("row").and_then(Value::as_array).into_iter().flatten() {
        match row(entry) {
            Ok(row) if ids.insert(row.id.clone()) => rows.push(row),
            Ok(row) => problems.push(format!("{}: stands twice in docs/ledger.toml", row.id)),
            Err(problem) => problems.push(problem),
        }
    }
    if rows.is_empty() {
        problems.push("docs/ledger.toml has no rows".into());
    }
    (rows, problems)
}

fn row(entry: &Value) -> Result<Row, String> {
    let table = entry.as_table().ok_or("a row of docs/ledger.toml is no table")?;
    let text = |key: &str| table.get(key).and_then(Value::as_str).map(str::to_owned);
    let id = text("id").ok_or("a row of docs/ledger.toml has no `id`")?;
    if let Some(unknown) =
        table.keys().find(|key| !["id", "crate", "what", "status", "item", "test"].contains(&key.as_str()))
    {
        return Err(format!("{id}: unknown key `{unknown}`"));
    }
    let folder = text("crate").ok_or_else(|| format!("{id}: no `crate`"))?;
    let what = text("what").ok_or_else(|| format!("{id}: no `what`"))?;
    let is_done = match text("status").as_deref() {
        Some("done") => true,
        Some("open") => false,
        _ => return Err(format!("{id}: `status` must be \"open\" or \"done\"")),
    };
    let row = Row { is_done, items: strings(table, "item"), tests: strings(table, "test"), id, folder, what };
    if row.is_done && (row.items.is_empty() || row.tests.is_empty()) {
        return Err(format!("{}: a finished row names an `item` and a `test`", row.id));
    }
    Ok(row)
}

/// One string or a list of them.
fn strings(table: &Table, key: &str) -> Vec<String> {
    match table.get(key) {
        Some(Value::String(one)) => vec![one.clone()],
        Some(Value::Array(many)) => many.iter().filter_map(Value::as_str).map(str::to_owned).collect(),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::parse;

    const HEAD: &str = "[[row]]\nid = \"W1\"\ncrate = \"kinematics\"\nwhat = \"velocity\"\n";

    #[test]
    fn a_row_has_one_item_or_several() {
        let (rows, problems) =
            parse(&format!("{HEAD}status = \"done\"\nitem = \"a::B\"\ntest = [\"k::it::c\", \"k::lib::d\"]"));
        assert_eq!(problems, Vec::<String>::new());
        assert_eq!((rows[0].items.len(), rows[0].tests.len()), (1, 2));
    }

    #[test]
    fn an_unfinished_or_misspelt_row_is_refused() {
        for tail in ["status = \"done\"", "status = \"nearly\"", "", "status = \"open\"\nitems = \"a\""] {
            let (rows, problems) = parse(&format!("{HEAD}{tail}"));
            assert!(rows.is_empty() && !problems.is_empty(), "{tail}");
        }
        let open = format!("{HEAD}status = \"open\"\n");
        assert!(parse(&open).1.is_empty());
        assert_eq!(parse(&format!("{open}{open}")).1.len(), 1);
    }
}
