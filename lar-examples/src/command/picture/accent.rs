//! What stands out of the cells that are shown: as what is clicked, typed and replayed in the window.

use crate::CommandError;
use lar_viewer::CellRef;
use lar_viewer::session::{Command, Highlight, Queries, Relation, Session};

/// What stands out. Cells are named as their numbers show them: v0, e5, f12, c3.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct Accent {
    /// Highlights a cell: v0, e5, f12, c3.
    #[arg(long, value_name = "CELL")]
    select: Option<String>,
    /// Highlights the boundary chain of a cell, orange where it is positive, blue where it is negative.
    #[arg(long, value_name = "CELL", group = "chain")]
    boundary: Option<String>,
    /// Highlights the coboundary chain of a cell.
    #[arg(long, value_name = "CELL", group = "chain")]
    coboundary: Option<String>,
    /// Highlights the cells where a Boolean expression holds, such as "A & !B".
    #[arg(long = "where", value_name = "EXPRESSION", group = "chain")]
    holds: Option<String>,
    /// A picture of the gift wrapping of a cell, counted from 0: chain and boundary, corolla, and so on; the last when no
    /// number is given.
    #[arg(long, value_name = "CELL[:PICTURE]", group = "chain")]
    wrapping: Option<String>,
    /// Measures from vertex to vertex, and the angle at the second of three.
    #[arg(long, value_name = "VERTEX,VERTEX[,VERTEX]", value_delimiter = ',')]
    measure: Vec<String>,
}

impl Accent {
    /// Makes it stand out in a session. What the complex alone does not tell is asked.
    pub(crate) fn apply(&self, session: &mut Session, queries: &dyn Queries) -> Result<(), CommandError> {
        if let Some(name) = &self.select {
            let cell = cell(session, name)?;
            session.apply(Command::Select(Some(cell)));
        }
        for (name, relation) in
            [(&self.boundary, Relation::Boundary), (&self.coboundary, Relation::Coboundary)]
        {
            if let Some(name) = name {
                let cell = cell(session, name)?;
                session.apply(Command::Highlight(cell, relation));
            }
        }
        if let Some(expression) = &self.holds {
            let chain = queries.boolean(expression).map_err(CommandError::Usage)?;
            let label = expression.trim().to_owned();
            session.apply(Command::ShowChain(Highlight { label, chain, within: None }));
        }
        if let Some(text) = &self.wrapping {
            wrap(session, queries, text)?;
        }
        if ![0, 2, 3].contains(&self.measure.len()) {
            let refused = format!("two or three vertices are measured, not {}", self.measure.len());
            return Err(CommandError::Usage(refused));
        }
        for name in &self.measure {
            let place = cell(session, name)?;
            let at = session.data().position(place.index).filter(|_| place.dim == 0);
            let at =
                at.ok_or_else(|| CommandError::Usage(format!("{place} is no vertex to measure from")))?;
            session.apply(Command::Measure(at));
        }
        Ok(())
    }
}

/// The cell of this name.
pub(crate) fn cell(session: &Session, name: &str) -> Result<CellRef, CommandError> {
    session.data().find(name, session.data().dim()).map_err(CommandError::Usage)
}

/// Goes to a picture of the gift wrapping of a cell.
fn wrap(session: &mut Session, queries: &dyn Queries, text: &str) -> Result<(), CommandError> {
    let (name, picture) = match text.split_once(':') {
        None => (text, usize::MAX),
        Some((name, number)) => {
            let refused = || CommandError::Usage(format!("{number:?} is no number of a picture"));
            (name, number.trim().parse().map_err(|_| refused())?)
        }
    };
    let cell = cell(session, name)?;
    if cell.dim != 3 {
        return Err(CommandError::Usage(format!("{cell} is no cell of space, which alone are wrapped")));
    }
    let steps = queries.wrapping(cell.index).map_err(CommandError::Usage)?;
    session.apply(Command::StartReplay(cell, steps));
    session.apply(Command::GoTo(picture));
    Ok(())
}
