//! Boolean expressions over named solids: `!` complement binds tightest, then `&` intersection, `-` difference,
//! `^` symmetric difference, `|` union; parentheses. Operators of two arguments group from the left.
//!
//! Names made of letters, digits, `_` and `.` stand as they are, all others between quotes, 'like-this' or "like this".
//!
//! An expression is kept as a program for a stack machine: any depth of nesting, no recursion.

/// One step of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    Operand(u32),
    Complement,
    Binary(Operator),
}

/// Operators of two arguments, in the order in which they bind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Operator {
    Union,
    SymmetricDifference,
    Difference,
    Intersection,
}

impl Operator {
    fn from_symbol(symbol: char) -> Option<Self> {
        Some(match symbol {
            '|' => Operator::Union,
            '^' => Operator::SymmetricDifference,
            '-' => Operator::Difference,
            '&' => Operator::Intersection,
            _ => return None,
        })
    }

    /// For 64 points at once.
    fn apply(self, a: u64, b: u64) -> u64 {
        match self {
            Operator::Union => a | b,
            Operator::SymmetricDifference => a ^ b,
            Operator::Difference => a & !b,
            Operator::Intersection => a & b,
        }
    }
}

/// A Boolean expression over solids numbered from 0.
///
/// ```
/// use lar_arrangement::Expression;
/// let expression = Expression::parse("A - (B | !C)", &["A", "B", "C"])?;
/// assert!(expression.evaluate(|solid| [true, false, true][solid]));
/// assert!(!expression.evaluate(|solid| [true, true, true][solid]));
/// assert_eq!(expression.operands(), [0, 1, 2]);
/// # Ok::<(), lar_arrangement::ExpressionError>(())
/// ```
#[doc(alias = "boolops")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expression {
    program: Vec<Step>,
}

/// Why a text is not an expression. Positions count characters from 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExpressionError {
    /// A name that stands for no operand.
    #[error("expression, position {position}: unknown operand \"{name}\", known are {known}")]
    UnknownName {
        /// Where it stands.
        position: usize,
        /// The name.
        name: String,
        /// The names there are, the first few of many.
        known: String,
    },
    /// A character that has no meaning, or has none at its place.
    #[error("expression, position {position}: expected {expected}, found '{found}'")]
    Unexpected {
        /// Where it stands.
        position: usize,
        /// What could stand there.
        expected: &'static str,
        /// What stands there.
        found: char,
    },
    /// The text ends too early.
    #[error("expression, position {position}: expected {expected}, found the end")]
    Ended {
        /// Where it ends.
        position: usize,
        /// What could stand there.
        expected: &'static str,
    },
}

/// Names for n solids in the order of a spreadsheet's columns: A, B, …, Z, AA, AB, … O(n log n).
///
/// ```
/// let names = lar_arrangement::operand_names(28);
/// assert_eq!((names[0].as_str(), names[25].as_str(), names[27].as_str()), ("A", "Z", "AB"));
/// ```
#[must_use]
pub fn operand_names(n: usize) -> Vec<String> {
    (0..n)
        .map(|i| {
            let mut name = Vec::new();
            let mut rest = i + 1;
            while rest > 0 {
                name.push(b'A' + ((rest - 1) % 26) as u8);
                rest = (rest - 1) / 26;
            }
            name.iter().rev().map(|&b| char::from(b)).collect()
        })
        .collect()
}

impl Expression {
    /// Parses a text; `names[i]` is the name of solid i. Names that are made of other than letters, digits, `_` and
    /// `.`, or begin with none of these but a letter or `_`, stand between quotes of either kind. O(length · names).
    ///
    /// ```
    /// use lar_arrangement::Expression;
    /// let expression = Expression::parse("'path-1' - door", &["path-1", "door"])?;
    /// assert_eq!(expression, Expression::parse("A - B", &["A", "B"])?);
    /// # Ok::<(), lar_arrangement::ExpressionError>(())
    /// ```
    ///
    /// # Errors
    /// With the position and what was expected there.
    pub fn parse(text: &str, names: &[impl AsRef<str>]) -> Result<Self, ExpressionError> {
        Parser::new(text).parse(names)
    }

    /// The solid itself.
    #[must_use]
    pub fn solid(solid: usize) -> Self {
        Self { program: vec![Step::Operand(solid as u32)] }
    }

    /// The union of solids 0..n.
    ///
    /// # Panics
    /// When n is 0.
    #[must_use]
    pub fn union_of(n: usize) -> Self {
        Self::folded(n, Operator::Union)
    }

    /// The intersection of solids 0..n.
    ///
    /// # Panics
    /// When n is 0.
    #[must_use]
    pub fn intersection_of(n: usize) -> Self {
        Self::folded(n, Operator::Intersection)
    }

    fn folded(n: usize, operator: Operator) -> Self {
        assert!(n > 0, "an expression needs an operand");
        let mut program = vec![Step::Operand(0)];
        for solid in 1..n {
            program.extend([Step::Operand(solid as u32), Step::Binary(operator)]);
        }
        Self { program }
    }

    /// The numbers of the solids that occur, ascending. O(n log n).
    #[must_use]
    pub fn operands(&self) -> Vec<usize> {
        let mut all: Vec<usize> = self
            .program
            .iter()
            .filter_map(|step| match step {
                Step::Operand(solid) => Some(*solid as usize),
                _ => None,
            })
            .collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The value where `inside` says which solids contain the point. O(length).
    pub fn evaluate(&self, inside: impl Fn(usize) -> bool) -> bool {
        self.evaluate_bits(&mut Vec::new(), |solid| u64::from(inside(solid))) & 1 == 1
    }

    /// Operands and operators in reverse Polish order.
    pub(crate) fn program(&self) -> &[Step] {
        &self.program
    }

    /// Number of operands and operators.
    pub(crate) fn len(&self) -> usize {
        self.program.len()
    }

    /// The same for 64 points at once, a bit each, with a stack to be used again.
    pub(crate) fn evaluate_bits(&self, stack: &mut Vec<u64>, inside: impl Fn(usize) -> u64) -> u64 {
        const BALANCED: &str = "programs are balanced by construction";
        stack.clear();
        for step in &self.program {
            match *step {
                Step::Operand(solid) => stack.push(inside(solid as usize)),
                Step::Complement => {
                    let top = stack.last_mut().expect(BALANCED);
                    *top = !*top;
                }
                Step::Binary(operator) => {
                    let b = stack.pop().expect(BALANCED);
                    let a = stack.last_mut().expect(BALANCED);
                    *a = operator.apply(*a, b);
                }
            }
        }
        stack.pop().expect(BALANCED)
    }
}

/// What waits on the operator stack.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pending {
    Complement,
    Binary(Operator),
    Parenthesis,
}

/// Dijkstra's shunting yard: operands go to the program at once, operators when one that binds less follows.
struct Parser {
    characters: Vec<char>,
    at: usize,
    program: Vec<Step>,
    pending: Vec<Pending>,
}

impl Parser {
    fn new(text: &str) -> Self {
        Self { characters: text.chars().collect(), at: 0, program: Vec::new(), pending: Vec::new() }
    }

    fn parse(mut self, names: &[impl AsRef<str>]) -> Result<Expression, ExpressionError> {
        loop {
            self.operand(names)?;
            if self.after_operand()? {
                return Ok(Expression { program: self.program });
            }
        }
    }

    /// Reads complements and opening parentheses up to a name.
    fn operand(&mut self, names: &[impl AsRef<str>]) -> Result<(), ExpressionError> {
        const EXPECTED: &str = "a name, '!' or '('";
        loop {
            match self.next_symbol() {
                Some('!') => self.pending.push(Pending::Complement),
                Some('(') => self.pending.push(Pending::Parenthesis),
                Some(c) if c.is_alphabetic() || c == '_' => {
                    let is_part = |c: &char| c.is_alphanumeric() || *c == '_' || *c == '.';
                    let name = self.characters[self.at..].iter().take_while(|c| is_part(c)).collect();
                    return self.named(name, 0, names);
                }
                Some(quote @ ('\'' | '"')) => {
                    let name: String =
                        self.characters[self.at + 1..].iter().take_while(|c| **c != quote).collect();
                    let end = self.at + 1 + name.chars().count();
                    if end == self.characters.len() {
                        self.at = end;
                        return Err(self.unexpected(None, "the other quote"));
                    }
                    return self.named(name, 1, names);
                }
                found => return Err(self.unexpected(found, EXPECTED)),
            }
            self.at += 1;
        }
    }

    /// Adds the operand of this name, which stands between so many quotes on each side.
    fn named(
        &mut self,
        name: String,
        n_quotes: usize,
        names: &[impl AsRef<str>],
    ) -> Result<(), ExpressionError> {
        let position = self.at + 1;
        let Some(solid) = names.iter().position(|known| known.as_ref() == name) else {
            return Err(ExpressionError::UnknownName { position, name, known: listed(names) });
        };
        self.at += name.chars().count() + 2 * n_quotes;
        self.program.push(Step::Operand(solid as u32));
        Ok(())
    }

    /// Reads closing parentheses up to an operator (false) or the end (true).
    fn after_operand(&mut self) -> Result<bool, ExpressionError> {
        const EXPECTED: &str = "an operator (& - ^ |) or ')'";
        loop {
            match self.next_symbol() {
                None => {
                    self.reduce(None);
                    return match self.pending.pop() {
                        None => Ok(true),
                        Some(_) => Err(self.unexpected(None, "')'")),
                    };
                }
                Some(')') => {
                    self.reduce(None);
                    if self.pending.pop().is_none() {
                        return Err(self.unexpected(Some(')'), "an operator (& - ^ |) or the end"));
                    }
                    self.at += 1;
                }
                Some(c) => {
                    let Some(operator) = Operator::from_symbol(c) else {
                        return Err(self.unexpected(Some(c), EXPECTED));
                    };
                    self.reduce(Some(operator));
                    self.pending.push(Pending::Binary(operator));
                    self.at += 1;
                    return Ok(false);
                }
            }
        }
    }

    /// Moves to the program what binds at least as much as the operator that follows, or all up to a parenthesis.
    fn reduce(&mut self, next: Option<Operator>) {
        while let Some(&top) = self.pending.last() {
            let step = match top {
                Pending::Complement => Step::Complement,
                Pending::Binary(operator) if next.is_none_or(|next| operator >= next) => {
                    Step::Binary(operator)
                }
                _ => return,
            };
            self.program.push(step);
            self.pending.pop();
        }
    }

    fn next_symbol(&mut self) -> Option<char> {
        while self.characters.get(self.at).is_some_and(|c| c.is_whitespace()) {
            self.at += 1;
        }
        self.characters.get(self.at).copied()
    }

    fn unexpected(&self, found: Option<char>, expected: &'static str) -> ExpressionError {
        let position = self.at + 1;
        match found {
            Some(found) => ExpressionError::Unexpected { position, expected, found },
            None => ExpressionError::Ended { position, expected },
        }
    }
}

/// The first few of the names, and how many more there are.
fn listed(names: &[impl AsRef<str>]) -> String {
    const MOST: usize = 20;
    let shown: Vec<&str> = names.iter().take(MOST).map(AsRef::as_ref).collect();
    let more = names.len() - shown.len();
    shown.join(", ") + &if more > 0 { format!(" and {more} more") } else { String::new() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const NAMES: [&str; 4] = ["A", "B", "C", "wheel_2"];

    /// The truth table as a number: bit i is the value where solid k is inside if bit k of i is set.
    #[track_caller]
    fn table(text: &str) -> u16 {
        let expression = Expression::parse(text, &NAMES).unwrap_or_else(|e| panic!("{text}: {e}"));
        (0..16u16).map(|i| u16::from(expression.evaluate(|k| i >> k & 1 == 1)) << i).sum()
    }

    const A: u16 = 0xaaaa;
    const B: u16 = 0xcccc;
    const C: u16 = 0xf0f0;
    const D: u16 = 0xff00;

    #[test]
    fn operators_bind_as_documented() {
        assert_eq!(table("A|B"), A | B);
        assert_eq!(table("A-B-C"), A & !B & !C);
        assert_eq!(table("A-(B-C)"), A & !(B & !C));
        assert_eq!(table("A|B&C"), A | (B & C));
        assert_eq!(table("A^B-C"), A ^ (B & !C));
        assert_eq!(table("A-B&C"), A & !(B & C));
        assert_eq!(table("A|B^C"), A | (B ^ C));
        assert_eq!(table("!A&B"), !A & B);
        assert_eq!(table("!!A"), A);
        assert_eq!(table("!(A|B)"), !(A | B));
        assert_eq!(table(" ( ( A ) ) & wheel_2 "), A & D);
        assert_eq!(table("'A'-\"wheel_2\" ^ B"), (A & !D) ^ B);
    }

    #[track_caller]
    fn refused(text: &str, message: &str) {
        let error = Expression::parse(text, &NAMES).expect_err(text);
        assert_eq!(error.to_string(), message);
    }

    #[test]
    fn what_is_no_expression_is_refused_with_its_place() {
        refused("", "expression, position 1: expected a name, '!' or '(', found the end");
        refused("A |", "expression, position 4: expected a name, '!' or '(', found the end");
        refused("A | & B", "expression, position 5: expected a name, '!' or '(', found '&'");
        refused("A B", "expression, position 3: expected an operator (& - ^ |) or ')', found 'B'");
        refused("(A | B", "expression, position 7: expected ')', found the end");
        refused("A | B)", "expression, position 6: expected an operator (& - ^ |) or the end, found ')'");
        refused("A + B", "expression, position 3: expected an operator (& - ^ |) or ')', found '+'");
        refused("A | D", "expression, position 5: unknown operand \"D\", known are A, B, C, wheel_2");
        refused("A - 'B", "expression, position 7: expected the other quote, found the end");
        refused("A - ''", "expression, position 5: unknown operand \"\", known are A, B, C, wheel_2");
        refused("3", "expression, position 1: expected a name, '!' or '(', found '3'");
    }

    #[test]
    fn of_many_names_a_few_are_listed() {
        let error = Expression::parse("x", &operand_names(1000)).expect_err("no such name").to_string();
        assert!(
            error.ends_with(
                "known are A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T and 980 more"
            )
        );
    }

    #[test]
    fn nesting_has_no_limit() {
        let deep = format!("{}A{}", "(!".repeat(100_000), ")".repeat(100_000));
        assert!(Expression::parse(&deep, &NAMES).expect("balanced").evaluate(|k| k == 0));
    }

    proptest! {
        #[test]
        fn no_text_panics(text in "[ABCw()!&|^ '\"-]{0,40}|\\PC{0,40}") {
            let _ = Expression::parse(&text, &NAMES);
        }
    }
}
