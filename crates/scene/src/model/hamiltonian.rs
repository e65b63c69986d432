//! Hamiltonians and questions from checked records.

use piola_document::Record;
use piola_document::units::Dimension;
use piola_expression::{Expression, Variable};
use piola_simulation::phase::{BracketQuestion, NewVariables, PhaseExpression, PhaseQuestions, PhaseSystem};
use piola_simulation::questions::MechanismQuestions;

use super::{Builder, TimeSpan};
use piola_expression::text::{self, ExpressionNames, NameMeaning};

/// Relative tolerance of sections and exponents when none is asked for.
const TOLERANCE: f64 = 1e-12;

impl Builder<'_> {
    pub(super) fn hamiltonian(&mut self, scene: &Record, table: &Record) -> Option<PhaseSystem> {
        let records = scene.records("coordinate");
        if records.is_empty() && !scene.has("coordinate") {
            return self.refused(
                table.place.clone(),
                "[hamiltonian] without coordinates",
                "at least one [[coordinate]]",
            );
        }
        let mut names = ExpressionNames::new(false);
        let (mut coordinates, mut momenta) = (Vec::new(), Vec::new());
        for (i, record) in records.iter().enumerate() {
            let name = record.text("name")?.to_string();
            let momentum = record.text("momentum").map_or_else(|| format!("p_{name}"), str::to_string);
            for (key, name, variable) in
                [("name", &name, Variable::Coordinate(i)), ("momentum", &momentum, Variable::Conjugate(i))]
            {
                if !names.add(name, NameMeaning::Variable(variable), Dimension::NONE) {
                    return self.refused(
                        record.place_of(key),
                        format!("the name `{name}` is taken"),
                        "a name unlike t, pi, any coordinate, momentum and function",
                    );
                }
            }
            coordinates.push(name);
            momenta.push(momentum);
        }
        let united = scene.parameters("parameters").iter().find(|parameter| parameter.dimension != Dimension::NONE);
        if let Some(parameter) = united {
            return self.refused(
                parameter.place.clone(),
                format!("`{}` has a unit", parameter.name),
                "a pure number: nothing in a [hamiltonian] has a unit",
            );
        }
        if scene.has("parameters") && !scene.fields.contains_key("parameters") {
            return None;
        }
        self.parameters(scene, &mut names);
        let energy = self.phase_expression(table, "energy", &names);
        let questions = self.phase_questions(scene, &names);
        let numbers = |key: &str| records.iter().map(|record| record.number(key)).collect::<Option<Vec<f64>>>();
        let (start, momentum) = (numbers("start")?, numbers("momentum_at_start")?);
        if let Some(reference) = scene.record("reference") {
            self.refuse(
                reference.place.clone(),
                "[reference] in a scene of [hamiltonian]",
                "nothing: a reference has positions of bodies",
            );
        }
        let built = PhaseSystem::new(energy?, (coordinates, momenta), start, momentum);
        let refused = |error| {
            self.refuse(table.place.clone(), format!("{error}"), "finite numbers");
        };
        let mut system = built.map_err(refused).ok()?;
        system.questions = questions?;
        system.questions.brackets = self.brackets(scene, &names)?;
        system.questions.new_variables = self.new_variables(scene, &names, system.freedom())?;
        Some(system)
    }

    fn phase_expression(&mut self, record: &Record, key: &'static str, names: &ExpressionNames) -> Option<Expression> {
        record.text(key)?;
        text::of_key(record, key, names, Dimension::NONE).map_err(|mistake| self.wrong(*mistake)).ok()
    }

    fn brackets(&mut self, scene: &Record, names: &ExpressionNames) -> Option<Vec<BracketQuestion>> {
        let records = scene.records("bracket");
        self.unique_names(&[records]);
        let mut bracket = |record: &Record| {
            let first = PhaseExpression(self.phase_expression(record, "first", names)?);
            let second = if record.has("second") {
                Some(PhaseExpression(self.phase_expression(record, "second", names)?))
            } else {
                None
            };
            Some(BracketQuestion { name: record.text("name")?.to_string(), first, second })
        };
        records.iter().map(&mut bracket).collect()
    }

    /// The change of variables, if there is one: as many new coordinates as there are old ones.
    #[expect(clippy::option_option, reason = "a mistake, or nothing asked")]
    fn new_variables(
        &mut self,
        scene: &Record,
        names: &ExpressionNames,
        freedom: usize,
    ) -> Option<Option<NewVariables>> {
        let records = scene.records("new_coordinate");
        let Some(first) = records.first() else { return Some(None) };
        self.unique_names(&[records]);
        if records.len() != freedom {
            return self.refused(
                first.place.clone(),
                format!("{} new coordinates of {freedom} old ones", records.len()),
                format!("{freedom} [[new_coordinate]]"),
            );
        }
        let mut functions = |key: &'static str| {
            records.iter().map(|record| self.phase_expression(record, key, names)).collect::<Option<Vec<_>>>()
        };
        let (coordinates, momenta) = (functions("coordinate"), functions("momentum"));
        match NewVariables::new(coordinates?, momenta?) {
            Ok(variables) => Some(Some(variables)),
            Err(error) => {
                self.refused(first.place.clone(), error.to_string(), "functions of the coordinates and momenta")
            }
        }
    }

    fn phase_questions(&mut self, scene: &Record, names: &ExpressionNames) -> Option<PhaseQuestions> {
        let tolerance = scene.record("integrator").and_then(|table| table.number("tolerance")).unwrap_or(TOLERANCE);
        let Some(asked) = scene.record("questions") else {
            return Some(PhaseQuestions { tolerance, ..PhaseQuestions::default() });
        };
        let section = if asked.has("section") {
            let surface = self.phase_expression(asked, "section", names)?;
            Some((PhaseExpression(surface), asked.count("crossings")? as usize))
        } else {
            None
        };
        Some(PhaseQuestions { section, exponent: asked.flag("exponent")?, tolerance, ..PhaseQuestions::default() })
    }

    /// The questions to a mechanism.
    pub(super) fn mechanism_questions(&mut self, scene: &Record) -> Option<MechanismQuestions> {
        let Some(asked) = scene.record("questions") else { return Some(MechanismQuestions::default()) };
        let questions = MechanismQuestions {
            equilibrium: asked.flag("equilibrium")?,
            modes: asked.flag("modes")?,
            energies: asked.flag("energies")?,
        };
        let small = [("equilibrium", questions.equilibrium), ("modes", questions.modes)];
        if let Some((key, _)) = small.into_iter().find(|(_, asked)| *asked && scene.has("constraint")) {
            return self.refused(
                asked.place_of(key),
                format!("`{key}` under a [[constraint]]"),
                "a mechanism of joints alone: small motions under multipliers are not there yet",
            );
        }
        Some(questions)
    }

    /// Refuses questions to what has no answer to them.
    pub(super) fn answerable(&mut self, scene: &Record, time: Option<TimeSpan>) {
        let Some(asked) = scene.record("questions") else { return };
        if asked.flag("exponent") == Some(true) && time.is_some_and(|time| time.end < time.start) {
            self.refuse(asked.place_of("exponent"), "`exponent` of a run backwards in time", "an end after the start");
        }
        let of = [
            ("section", "hamiltonian"),
            ("crossings", "hamiltonian"),
            ("exponent", "hamiltonian"),
            ("equilibrium", "mechanism"),
            ("modes", "mechanism"),
            ("energies", "mechanism"),
        ];
        for (key, kind) in of.into_iter().filter(|(key, kind)| asked.has(key) && !scene.has(kind)) {
            self.refuse(
                asked.place_of(key),
                format!("`{key}` is no question to this scene"),
                format!("a scene of [{kind}]"),
            );
        }
    }
}
