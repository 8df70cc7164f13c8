//! The schemas of docs/schema, and whether a document is what they say.

use serde_json::{Value, json};
use std::path::Path;

/// The schema with this name, which is valid itself.
#[track_caller]
pub(crate) fn schema(name: &str) -> Value {
    let dir = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/schema"));
    let path = dir.join(format!("{name}.schema.json"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let schema = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    jsonschema::meta::validate(&schema).unwrap_or_else(|e| panic!("{name}: {e}"));
    schema
}

/// A document is what its schema says; without one of its fields, or with a field of another type, it is not.
#[track_caller]
pub(crate) fn check(schema: &Value, document: &Value) {
    let validator = jsonschema::draft202012::new(schema).expect("checked when it was read");
    let errors: Vec<_> =
        validator.iter_errors(document).map(|e| format!("{}: {e}", e.instance_path())).collect();
    assert_eq!(errors, [""; 0], "{document}");
    for (pointer, key) in fields("", document) {
        let changed = |change: &dyn Fn(&mut serde_json::Map<String, Value>)| {
            let mut document = document.clone();
            change(document.pointer_mut(&pointer).and_then(Value::as_object_mut).expect("an object"));
            document
        };
        let without = changed(&|object| _ = object.remove(&key));
        assert!(!validator.is_valid(&without), "without {key} of {pointer}");
        let wrong = changed(&|object| _ = object.insert(key.clone(), json!([{}, "wrong"])));
        assert!(!validator.is_valid(&wrong), "with another {key} of {pointer}");
    }
}

/// The fields of all objects, each as a pointer to the object and its key; stages are free to come and go, and complexes in
/// a view have a schema of their own.
fn fields(pointer: &str, value: &Value) -> Vec<(String, String)> {
    match value {
        Value::Object(_) if pointer.ends_with("/stages") || pointer == "/complex" => Vec::new(),
        Value::Object(map) => {
            let below = map.iter().flat_map(|(key, value)| fields(&format!("{pointer}/{key}"), value));
            below.chain(map.keys().map(|key| (pointer.to_owned(), key.clone()))).collect()
        }
        // The first of a list stands for all.
        Value::Array(list) => {
            list.first().map_or_else(Vec::new, |first| fields(&format!("{pointer}/0"), first))
        }
        _ => Vec::new(),
    }
}

/// What a schema says of its fields, named as in docs/formats.md: `a.b`, and `a[].b` in lists.
pub(crate) fn descriptions(path: &str, schema: &Value, found: &mut Vec<(String, String)>) {
    if let Some(text) = schema["description"].as_str() {
        found.push((path.to_owned(), text.to_owned()));
    }
    for (key, below) in schema["properties"].as_object().into_iter().flatten() {
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        descriptions(&path, below, found);
    }
    if schema["items"]["properties"].is_object() {
        descriptions(&format!("{path}[]"), &schema["items"], found);
    }
}
