//! Rules for reference data.

use serde_json::Value;

use crate::workspace::{Workspace, read};

/// Every file of `testdata/` that does not say where its values came from.
pub(super) fn check(workspace: &Workspace) -> Vec<String> {
    let mut problems = Vec::new();
    for path in workspace.files() {
        let place = workspace.relative(&path).to_string().replace('\\', "/");
        if !place.starts_with("testdata/") || path.extension().is_none_or(|extension| extension != "json") {
            continue;
        }
        let data = read(&path)
            .and_then(|text| serde_json::from_str::<Value>(&text).map_err(|error| format!("{place}: {error}")));
        match data {
            Ok(data) => problems.extend(missing(&data).into_iter().map(|what| format!("{place}: {what}"))),
            Err(problem) => problems.push(problem),
        }
    }
    problems
}

/// Golden files carry `meta`; problems with a published solution carry `provenance` or `published_by`.
fn missing(data: &Value) -> Vec<String> {
    let says = |object: &Value, key: &str| object[key].as_str().is_some_and(|text| !text.trim().is_empty());
    if data["meta"].is_object() {
        let keys = ["what", "generator", "verified_by"];
        keys.iter().filter(|key| !says(&data["meta"], key)).map(|key| format!("`meta.{key}` is missing")).collect()
    } else if says(data, "provenance") || says(data, "published_by") {
        Vec::new()
    } else {
        vec!["none of `meta`, `provenance` and `published_by`".into()]
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::missing;

    #[test]
    fn data_without_provenance_is_found() {
        assert!(missing(&json!({"provenance": "a book"})).is_empty());
        assert!(missing(&json!({"meta": {"what": "w", "generator": "g", "verified_by": "v"}})).is_empty());
        assert_eq!(missing(&json!({"meta": {"what": "w", "generator": ""}})).len(), 2);
        assert_eq!(missing(&json!({"values": [1]})).len(), 1);
    }
}
