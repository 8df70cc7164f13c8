//! A Boolean expression as gates with counters: its value follows single operands as these change, and is known as soon as
//! the known operands decide it.

use crate::expression::{Expression, Operator, Step};

/// What is known of an operand, of a gate or of the whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Value {
    False,
    True,
    Unknown,
}

impl Value {
    fn complement_if(self, negated: bool) -> Self {
        match self {
            Value::False if negated => Value::True,
            Value::True if negated => Value::False,
            value => value,
        }
    }
}

impl From<bool> for Value {
    fn from(is_true: bool) -> Self {
        if is_true { Value::True } else { Value::False }
    }
}

/// What a gate makes of its inputs, of which there are any number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    And,
    Or,
    Parity,
}

/// Where a value comes from.
#[derive(Clone, Copy)]
enum Source {
    Operand(u32),
    Gate(u32),
}

/// A value on its way, perhaps complemented.
#[derive(Clone, Copy)]
struct Wire {
    source: Source,
    negated: bool,
}

/// The gate that a value goes to, and whether it is complemented on the way.
type Target = (u32, bool);

#[derive(Clone, Debug)]
struct Gate {
    kind: Kind,
    /// How many inputs are false, true, unknown.
    n: [u32; 3],
    to: Option<Target>,
}

impl Gate {
    fn value(&self) -> Value {
        let [n_false, n_true, n_unknown] = self.n;
        match self.kind {
            Kind::And if n_false > 0 => Value::False,
            Kind::Or if n_true > 0 => Value::True,
            _ if n_unknown > 0 => Value::Unknown,
            Kind::And => Value::True,
            Kind::Or => Value::False,
            Kind::Parity => (n_true % 2 == 1).into(),
        }
    }
}

/// An expression with a value for each operand, at first unknown.
#[derive(Clone, Debug)]
pub(crate) struct Circuit {
    gates: Vec<Gate>,
    /// Where each operand goes to.
    targets: Vec<Vec<Target>>,
    operands: Vec<Value>,
    top: u32,
}

impl Circuit {
    /// All operands unknown. O(length + solids).
    pub(crate) fn new(expression: &Expression, n_solids: usize) -> Self {
        const BALANCED: &str = "programs are balanced by construction";
        let mut out = Self {
            gates: Vec::new(),
            targets: vec![Vec::new(); n_solids],
            operands: vec![Value::Unknown; n_solids],
            top: 0,
        };
        let mut stack: Vec<Wire> = Vec::new();
        for step in expression.program() {
            match *step {
                Step::Operand(solid) => stack.push(Wire { source: Source::Operand(solid), negated: false }),
                Step::Complement => {
                    let top = stack.last_mut().expect(BALANCED);
                    top.negated = !top.negated;
                }
                Step::Binary(operator) => {
                    let (b, a) = (stack.pop().expect(BALANCED), stack.pop().expect(BALANCED));
                    stack.push(out.joined(operator, a, b));
                }
            }
        }
        out.top = out.push_gate(Kind::Or);
        out.connect(stack.pop().expect(BALANCED), out.top);
        out
    }

    /// The wire of a binary operator. Chains of one operator become one gate.
    fn joined(&mut self, operator: Operator, a: Wire, b: Wire) -> Wire {
        let (kind, b) = match operator {
            Operator::Union => (Kind::Or, b),
            Operator::Intersection => (Kind::And, b),
            Operator::Difference => (Kind::And, Wire { negated: !b.negated, ..b }),
            Operator::SymmetricDifference => (Kind::Parity, b),
        };
        let gate = match a {
            Wire { source: Source::Gate(gate), negated: false } if self.gates[gate as usize].kind == kind => {
                gate
            }
            _ => {
                let gate = self.push_gate(kind);
                self.connect(a, gate);
                gate
            }
        };
        self.connect(b, gate);
        Wire { source: Source::Gate(gate), negated: false }
    }

    fn push_gate(&mut self, kind: Kind) -> u32 {
        self.gates.push(Gate { kind, n: [0; 3], to: None });
        self.gates.len() as u32 - 1
    }

    /// Leads a wire, still unknown, into a gate.
    fn connect(&mut self, wire: Wire, gate: u32) {
        let target = (gate, wire.negated);
        match wire.source {
            Source::Operand(solid) => self.targets[solid as usize].push(target),
            Source::Gate(below) => self.gates[below as usize].to = Some(target),
        }
        self.gates[gate as usize].n[Value::Unknown as usize] += 1;
    }

    /// Changes what is known of an operand. O(gates whose value changes) for each of its occurrences.
    pub(crate) fn set(&mut self, solid: u32, value: Value) {
        let old = std::mem::replace(&mut self.operands[solid as usize], value);
        if old != value {
            for i in 0..self.targets[solid as usize].len() {
                self.change(self.targets[solid as usize][i], old, value);
            }
        }
    }

    fn change(&mut self, mut target: Target, mut old: Value, mut new: Value) {
        loop {
            let (gate, negated) = target;
            let gate = &mut self.gates[gate as usize];
            let before = gate.value();
            gate.n[old.complement_if(negated) as usize] -= 1;
            gate.n[new.complement_if(negated) as usize] += 1;
            (old, new) = (before, gate.value());
            match gate.to {
                Some(next) if old != new => target = next,
                _ => return,
            }
        }
    }

    /// The value of the expression, when the known operands decide it by the rules of three-valued logic.
    pub(crate) fn value(&self) -> Value {
        self.gates[self.top as usize].value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::operand_names;
    use proptest::prelude::*;

    /// Expressions over four operands.
    fn texts() -> impl Strategy<Value = String> {
        let operand = prop::sample::select(vec!["A", "B", "C", "D", "!A", "!C"]).prop_map(str::to_owned);
        operand.prop_recursive(5, 24, 2, |inner| {
            (inner.clone(), prop::sample::select(vec!["|", "&", "-", "^"]), inner, any::<bool>()).prop_map(
                |(a, operator, b, negated)| format!("{}({a} {operator} {b})", if negated { "!" } else { "" }),
            )
        })
    }

    proptest! {
        #[test]
        fn values_follow_the_operands(text in texts(), changes in prop::collection::vec((0u32..4, 0u8..3), 1..40)) {
            let expression = Expression::parse(&text, &operand_names(4)).unwrap();
            let mut circuit = Circuit::new(&expression, 4);
            for (solid, value) in changes {
                circuit.set(solid, [Value::False, Value::True, Value::Unknown][value as usize]);
                let known = |bits: u32| (0..4).all(|k| match circuit.operands[k] {
                    Value::Unknown => true,
                    value => value == (bits >> k & 1 == 1).into(),
                });
                let values: Vec<bool> =
                    (0..16).filter(|&bits| known(bits)).map(|bits| expression.evaluate(|k| bits >> k & 1 == 1)).collect();
                // What is claimed holds whatever the unknown operands are; with all known it is claimed.
                if circuit.value() != Value::Unknown {
                    prop_assert!(values.iter().all(|&v| circuit.value() == v.into()));
                } else {
                    prop_assert!(values.len() > 1);
                }
            }
        }
    }

    #[test]
    fn one_operand_inside_decides_a_union() {
        let mut circuit = Circuit::new(&Expression::union_of(300), 300);
        circuit.set(17, Value::True);
        assert_eq!(circuit.value(), Value::True);
        assert_eq!(circuit.gates.len(), 2, "a chain of one operator is one gate");
        circuit.set(17, Value::False);
        assert_eq!(circuit.value(), Value::Unknown);
    }
}
