//! The table of members in Apache Parquet, a file of columns: the values of `members.csv`, bit by bit.

use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};

use crate::{EnsembleError, Member, Results};

/// Members of one group of rows: a reader takes so many at once.
const GROUP: usize = 1 << 18;

type Group<'g, 'f> = SerializedRowGroupWriter<'g, &'f mut Vec<u8>>;

fn column(
    name: &str,
    kind: Physical,
    is_optional: bool,
    logical: Option<LogicalType>,
) -> Result<TypePtr, ParquetError> {
    let repetition = if is_optional { Repetition::OPTIONAL } else { Repetition::REQUIRED };
    let built = Type::primitive_type_builder(name, kind).with_repetition(repetition).with_logical_type(logical);
    Ok(Arc::new(built.build()?))
}

/// Writes a column: what a member lacks is null.
fn put<T: DataType>(
    group: &mut Group<'_, '_>,
    values: impl Iterator<Item = Option<T::T>>,
    is_optional: bool,
) -> Result<(), ParquetError> {
    let (mut present, mut levels) = (Vec::new(), Vec::new());
    for value in values {
        levels.push(i16::from(value.is_some()));
        present.extend(value);
    }
    let Some(mut column) = group.next_column()? else { return Err(ParquetError::EOF("a column is missing".into())) };
    column.typed::<T>().write_batch(&present, is_optional.then_some(levels.as_slice()), None)?;
    column.close()
}

impl Results<'_> {
    /// The table of members as Parquet: the columns of [`table`](Self::table) with the same values.
    ///
    /// | column | type |
    /// |---|---|
    /// | `member` | INT64 |
    /// | varied values | DOUBLE |
    /// | quantities, SI units | optional DOUBLE: null where the CSV has an empty field |
    /// | `failure` | optional UTF-8 |
    ///
    /// Pages are not compressed. Equal results have equal bytes.
    ///
    /// # Errors
    /// [`EnsembleError::Parquet`] when the writer refuses the table, as for two columns of one name.
    ///
    /// # Example
    /// ```
    /// # use piola_ensemble::{Ensemble, Options, Results, compute};
    /// # use piola_scene::Document;
    /// # let scene = Document::parse("orbit.toml", "
    /// #     [central]
    /// #     gm = 1.0
    /// #     [[body]]
    /// #     name = 'comet'
    /// #     semi_major_axis = 1.0
    /// #     eccentricity = 0.5
    /// #     [time]
    /// #     revolutions = 1
    /// # ");
    /// # let ensemble = Ensemble::new(scene, vec!["body.comet.semi_major_axis=1:4:4".parse()?], Vec::new(), 1, 0)?;
    /// # let folder = std::env::temp_dir().join("piola-ensemble-parquet");
    /// # std::fs::create_dir_all(&folder).ok();
    /// # compute(&ensemble, &folder, Options::default(), |_| std::ops::ControlFlow::Continue(()))?;
    /// let results = Results::collect(&ensemble, &folder)?;
    /// assert!(results.parquet()?.starts_with(b"PAR1"));
    /// # std::fs::remove_dir_all(&folder).ok();
    /// # Ok::<(), piola_ensemble::EnsembleError>(())
    /// ```
    pub fn parquet(&self) -> Result<Vec<u8>, EnsembleError> {
        self.written().map_err(|error| EnsembleError::Parquet { cause: error.to_string() })
    }

    fn written(&self) -> Result<Vec<u8>, ParquetError> {
        let mut columns = vec![column("member", Physical::INT64, false, None)?];
        for name in self.ensemble.varied() {
            columns.push(column(&name, Physical::DOUBLE, false, None)?);
        }
        for name in self.ensemble.columns() {
            columns.push(column(name, Physical::DOUBLE, true, None)?);
        }
        columns.push(column("failure", Physical::BYTE_ARRAY, true, Some(LogicalType::String))?);
        let schema = Type::group_type_builder("members").with_fields(columns).build()?;
        let created = format!("piola-ensemble version {}", env!("CARGO_PKG_VERSION"));
        let properties = WriterProperties::builder().set_created_by(created).build();
        let mut content = Vec::new();
        let mut writer = SerializedFileWriter::new(&mut content, Arc::new(schema), Arc::new(properties))?;
        for members in self.members.chunks(GROUP) {
            let mut group = writer.next_row_group()?;
            self.put_members(&mut group, members)?;
            group.close()?;
        }
        writer.close()?;
        Ok(content)
    }

    fn put_members(&self, group: &mut Group<'_, '_>, members: &[Member]) -> Result<(), ParquetError> {
        // A member's number is below the largest number of members, 10⁸.
        put::<Int64Type>(group, members.iter().map(|member| i64::try_from(member.member).ok()), false)?;
        let settings: Vec<Vec<f64>> = members.iter().map(|member| self.ensemble.settings(member.member)).collect();
        for varied in 0..self.ensemble.varied().len() {
            put::<DoubleType>(group, settings.iter().map(|values| Some(values[varied])), false)?;
        }
        for quantity in 0..self.ensemble.columns().len() {
            let values = members.iter().map(|member| Some(member.values[quantity]).filter(|value| value.is_finite()));
            put::<DoubleType>(group, values, true)?;
        }
        let failures = members.iter().map(|member| member.failure.as_ref().map(|why| ByteArray::from(why.as_str())));
        put::<ByteArrayType>(group, failures, true)
    }
}
