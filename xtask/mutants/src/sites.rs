//! The operators of a crate that may be changed.
//!
//! They stand in bodies of functions that all features compile. What the compiler computes (constants, types, patterns)
//! cannot ask a switch, and what stands inside a macro is no expression before it is expanded.

use std::ops::Range;
use std::path::{Path, PathBuf};

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, BinOp, Expr, Meta, UnOp};

use crate::files::read;

/// One operator, with the expression it makes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Site {
    /// From the root, with `/`.
    pub(crate) file: String,
    /// Bytes of the whole expression.
    pub(crate) expression: Bytes,
    /// Bytes of the operator.
    pub(crate) operator: Bytes,
    pub(crate) sign: Sign,
    pub(crate) line: usize,
    pub(crate) column: usize,
}

/// `start..end`, in order of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Bytes {
    pub(crate) start: usize,
    pub(crate) end: usize,
}

impl Bytes {
    pub(crate) fn overlaps(self, other: Self) -> bool {
        self.start < other.end && other.start < self.end
    }

    pub(crate) fn contains(self, other: Self) -> bool {
        self.start <= other.start && other.end <= self.end
    }

    pub(crate) fn range(self) -> Range<usize> {
        self.start..self.end
    }
}

impl From<Range<usize>> for Bytes {
    fn from(range: Range<usize>) -> Self {
        Self { start: range.start, end: range.end }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Sign {
    Add,
    Sub,
    Mul,
    Div,
    AddAssign,
    SubAssign,
    MulAssign,
    DivAssign,
    Neg,
}

/// How an operator is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Change {
    /// By its inverse; a sign is left out.
    Inverse,
    /// The result changes its sign: for products that have no quotient, as those of matrices.
    Negated,
}

impl Sign {
    fn of(operator: &BinOp) -> Option<Self> {
        Some(match operator {
            BinOp::Add(_) => Self::Add,
            BinOp::Sub(_) => Self::Sub,
            BinOp::Mul(_) => Self::Mul,
            BinOp::Div(_) => Self::Div,
            BinOp::AddAssign(_) => Self::AddAssign,
            BinOp::SubAssign(_) => Self::SubAssign,
            BinOp::MulAssign(_) => Self::MulAssign,
            BinOp::DivAssign(_) => Self::DivAssign,
            _ => return None,
        })
    }

    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Sub | Self::Neg => "-",
            Self::Mul => "*",
            Self::Div => "/",
            Self::AddAssign => "+=",
            Self::SubAssign => "-=",
            Self::MulAssign => "*=",
            Self::DivAssign => "/=",
        }
    }

    fn inverse(self) -> &'static str {
        match self {
            Self::Add => "-",
            Self::Sub => "+",
            Self::Mul => "/",
            Self::Div => "*",
            Self::AddAssign => "-=",
            Self::SubAssign => "+=",
            Self::MulAssign => "/=",
            Self::DivAssign => "*=",
            Self::Neg => "",
        }
    }

    /// What to try when `change` does not compile.
    pub(crate) fn after(self, change: Change) -> Option<Change> {
        let is_product = matches!(self, Self::Mul | Self::Div);
        (is_product && change == Change::Inverse).then_some(Change::Negated)
    }

    /// Such as `a - b → a + b`.
    pub(crate) fn described(self, change: Change) -> String {
        let (now, then) = (self.text(), self.inverse());
        match (self, change) {
            (Self::Neg, _) => "-a → a".into(),
            (_, Change::Inverse) => format!("a {now} b → a {then} b"),
            (_, Change::Negated) => format!("a {now} b → -(a {now} b)"),
        }
    }
}

impl Site {
    /// The expression with the change behind the switch.
    ///
    /// An inverse binds as its operator does, so the text around it need not be understood.
    pub(crate) fn switched(&self, text: &str, number: u32, change: Change) -> String {
        let original = &text[self.expression.range()];
        let changed = match change {
            Change::Negated => format!("-({original})"),
            Change::Inverse => format!(
                "{}{}{}",
                &text[self.expression.start..self.operator.start],
                self.sign.inverse(),
                &text[self.operator.end..self.expression.end]
            ),
        };
        format!("(if crate::mutant_switch::is({number}) {{ ({changed}) }} else {{ ({original}) }})")
    }
}

/// Every site of the crate whose root is `lib.rs` of `folder`, by file and position.
pub(crate) fn of_crate(root: &Path, folder: &str) -> Result<Vec<Site>, String> {
    let mut sites = Vec::new();
    let mut files = vec![PathBuf::from(format!("{folder}/lib.rs"))];
    while let Some(path) = files.pop() {
        let text = read(&root.join(&path))?;
        let file = path.to_string_lossy().replace('\\', "/");
        let found = of_file(&file, &text).map_err(|error| format!("{file}: {error}"))?;
        sites.extend(found.sites);
        files.extend(found.modules.into_iter().map(|module| module.resolve(root)));
    }
    sites.sort();
    Ok(sites)
}

/// What a file holds, and the modules that stand in other files.
struct Found {
    sites: Vec<Site>,
    modules: Vec<Module>,
}

struct Module {
    /// The folder of the files of this module's parent.
    folder: PathBuf,
    name: String,
    /// Of the attribute `path`.
    path: Option<PathBuf>,
}

impl Module {
    fn resolve(self, root: &Path) -> PathBuf {
        if let Some(path) = self.path {
            return path;
        }
        let file = self.folder.join(format!("{}.rs", self.name));
        if root.join(&file).is_file() { file } else { self.folder.join(self.name).join("mod.rs") }
    }
}

fn of_file(file: &str, text: &str) -> syn::Result<Found> {
    let path = Path::new(file);
    let parent = path.parent().unwrap_or(Path::new("")).to_path_buf();
    let name = path.file_stem().unwrap_or_default();
    let folder = if name == "lib" || name == "mod" { parent.clone() } else { parent.join(name) };
    let found = Found { sites: Vec::new(), modules: Vec::new() };
    let mut finder = Finder { file, text, parent, folder, found };
    let parsed = syn::parse_file(text)?;
    if is_compiled(&parsed.attrs) {
        finder.visit_file(&parsed);
    }
    Ok(finder.found)
}

struct Finder<'t> {
    file: &'t str,
    text: &'t str,
    parent: PathBuf,
    folder: PathBuf,
    found: Found,
}

impl Finder<'_> {
    fn add(&mut self, expression: Range<usize>, operator: Range<usize>, sign: Sign) {
        // What a procedural macro's group would hide has no place in the text.
        if self.text.get(operator.clone()) != Some(sign.text()) || expression.end < operator.end {
            return;
        }
        let before = &self.text[..operator.start];
        let start_of_line = before.rfind('\n').map_or(0, |at| at + 1);
        self.found.sites.push(Site {
            file: self.file.to_owned(),
            expression: expression.into(),
            operator: operator.into(),
            sign,
            line: before.matches('\n').count() + 1,
            column: before[start_of_line..].chars().count() + 1,
        });
    }
}

/// Visits the item unless it is not compiled.
macro_rules! where_compiled {
    ($($visit:ident: $item:ident),+ $(,)?) => {
        $(fn $visit(&mut self, item: &'ast syn::$item) {
            if is_compiled(&item.attrs) {
                visit::$visit(self, item);
            }
        })+
    };
}

/// Passes over what the compiler computes.
macro_rules! passed_over {
    ($($visit:ident: $item:ident),+ $(,)?) => {
        $(fn $visit(&mut self, _: &'ast syn::$item) {})+
    };
}

impl<'ast> Visit<'ast> for Finder<'_> {
    where_compiled! {
        visit_item_impl: ItemImpl,
        visit_item_trait: ItemTrait,
        visit_local: Local,
        visit_arm: Arm,
        visit_field_value: FieldValue,
        visit_expr_block: ExprBlock,
        visit_expr_if: ExprIf,
        visit_expr_for_loop: ExprForLoop,
        visit_expr_call: ExprCall,
        visit_expr_method_call: ExprMethodCall,
    }

    passed_over! {
        visit_attribute: Attribute,
        visit_item_const: ItemConst,
        visit_item_static: ItemStatic,
        visit_impl_item_const: ImplItemConst,
        visit_trait_item_const: TraitItemConst,
        visit_expr_const: ExprConst,
        visit_variant: Variant,
        visit_type: Type,
        visit_pat: Pat,
        visit_generics: Generics,
        visit_angle_bracketed_generic_arguments: AngleBracketedGenericArguments,
        visit_macro: Macro,
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        if is_compiled(&item.attrs) && item.sig.constness.is_none() {
            visit::visit_item_fn(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        if is_compiled(&item.attrs) && item.sig.constness.is_none() {
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if is_compiled(&item.attrs) && item.sig.constness.is_none() {
            visit::visit_trait_item_fn(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_compiled(&item.attrs) {
            return;
        }
        let name = item.ident.to_string();
        if item.content.is_some() {
            self.folder.push(&name);
            visit::visit_item_mod(self, item);
            self.folder.pop();
        } else {
            let path = path_of(&item.attrs).map(|path| self.parent.join(path));
            self.found.modules.push(Module { folder: self.folder.clone(), name, path });
        }
    }

    fn visit_expr_repeat(&mut self, expression: &'ast syn::ExprRepeat) {
        // The length is a constant.
        self.visit_expr(&expression.expr);
    }

    fn visit_expr_binary(&mut self, expression: &'ast syn::ExprBinary) {
        if !is_compiled(&expression.attrs) {
            return;
        }
        if let Some(sign) = Sign::of(&expression.op) {
            let (left, right) = (expression.left.span().byte_range(), expression.right.span().byte_range());
            self.add(left.start..right.end, expression.op.span().byte_range(), sign);
        }
        visit::visit_expr_binary(self, expression);
    }

    fn visit_expr_unary(&mut self, expression: &'ast syn::ExprUnary) {
        if let UnOp::Neg(sign) = &expression.op {
            let (sign, of) = (sign.span().byte_range(), expression.expr.span().byte_range());
            // A negative number is a number.
            if !matches!(&*expression.expr, Expr::Lit(_)) {
                self.add(sign.start..of.end, sign, Sign::Neg);
            }
        }
        visit::visit_expr_unary(self, expression);
    }
}

/// The path that an attribute gives to a module.
fn path_of(attributes: &[Attribute]) -> Option<String> {
    attributes.iter().filter(|attribute| attribute.path().is_ident("path")).find_map(|attribute| {
        let Meta::NameValue(value) = &attribute.meta else { return None };
        let Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(path), .. }) = &value.value else { return None };
        Some(path.value())
    })
}

/// Whether a library with all features on this machine has what stands below the attributes.
fn is_compiled(attributes: &[Attribute]) -> bool {
    attributes.iter().all(|attribute| {
        if attribute.path().is_ident("test") {
            return false;
        }
        if !attribute.path().is_ident("cfg") {
            return true;
        }
        attribute.parse_args::<Meta>().ok().and_then(|condition| holds(&condition)) == Some(true)
    })
}

/// Nothing where the condition is not one that we know.
fn holds(condition: &Meta) -> Option<bool> {
    match condition {
        Meta::Path(path) => {
            let name = path.get_ident()?.to_string();
            match name.as_str() {
                "test" | "doc" | "docsrs" => Some(false),
                "debug_assertions" => Some(true),
                "unix" => Some(cfg!(unix)),
                "windows" => Some(cfg!(windows)),
                _ => None,
            }
        }
        Meta::NameValue(value) => {
            let Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) = &value.value else { return None };
            match value.path.get_ident()?.to_string().as_str() {
                "feature" => Some(true),
                "target_arch" => Some(text.value() == std::env::consts::ARCH),
                "target_os" => Some(text.value() == std::env::consts::OS),
                _ => None,
            }
        }
        Meta::List(list) => {
            let parts = syn::punctuated::Punctuated::<Meta, syn::Token![,]>::parse_terminated;
            let parts: Vec<_> = list.parse_args_with(parts).ok()?.iter().map(holds).collect();
            match list.path.get_ident()?.to_string().as_str() {
                "not" => parts.first().copied().flatten().map(|holds| !holds),
                "all" => parts.into_iter().try_fold(true, |all, part| Some(all && part?)),
                "any" => parts.into_iter().try_fold(false, |any, part| Some(any || part?)),
                _ => None,
            }
        }
    }
}

#[cfg(test)]
mod tests;
