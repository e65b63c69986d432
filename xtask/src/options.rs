//! Command-line options, taken one by one so that whatever is left over is an error.

/// What of the command line has not been understood yet.
pub(crate) struct Options {
    left: Vec<String>,
}

impl Options {
    pub(crate) fn new(arguments: Vec<String>) -> Self {
        Self { left: arguments }
    }

    /// Takes the switch `name`; true if it was given.
    pub(crate) fn flag(&mut self, name: &str) -> bool {
        let before = self.left.len();
        self.left.retain(|argument| argument != name);
        self.left.len() < before
    }

    /// Takes `name VALUE` or `name=VALUE`.
    pub(crate) fn value(&mut self, name: &str) -> Result<Option<String>, String> {
        let joined = format!("{name}=");
        if let Some(at) = self.left.iter().position(|argument| argument.starts_with(&joined)) {
            return Ok(Some(self.left.remove(at)[joined.len()..].to_owned()));
        }
        let Some(at) = self.left.iter().position(|argument| argument == name) else { return Ok(None) };
        self.left.remove(at);
        if at < self.left.len() && !self.left[at].starts_with("--") {
            Ok(Some(self.left.remove(at)))
        } else {
            Err(format!("`{name}` needs a value"))
        }
    }

    /// Takes every `name VALUE`.
    pub(crate) fn values(&mut self, name: &str) -> Result<Vec<String>, String> {
        let mut values = Vec::new();
        while let Some(value) = self.value(name)? {
            values.push(value);
        }
        Ok(values)
    }

    /// Takes the first word that is no option.
    pub(crate) fn word(&mut self) -> Option<String> {
        let at = self.left.iter().position(|argument| !argument.starts_with('-'))?;
        Some(self.left.remove(at))
    }

    /// Refuses what nobody asked for.
    pub(crate) fn finish(&self) -> Result<(), String> {
        if self.left.is_empty() { Ok(()) } else { Err(format!("unknown arguments: {}", self.left.join(" "))) }
    }
}

#[cfg(test)]
mod tests {
    use super::Options;

    fn options(line: &str) -> Options {
        Options::new(line.split_whitespace().map(str::to_owned).collect())
    }

    #[test]
    fn options_are_taken_once_and_in_any_order() {
        let mut given = options("bench --keep-going --json out.json --filter=nbody");
        assert_eq!(given.word().as_deref(), Some("bench"));
        assert!(given.flag("--keep-going"));
        assert!(!given.flag("--keep-going"));
        assert_eq!(given.value("--json"), Ok(Some("out.json".into())));
        assert_eq!(given.value("--filter"), Ok(Some("nbody".into())));
        assert_eq!(given.finish(), Ok(()));
    }

    #[test]
    fn missing_values_and_leftovers_are_refused() {
        assert!(options("--json --filter x").value("--json").is_err());
        assert!(options("--skpi test").finish().is_err());
    }
}
