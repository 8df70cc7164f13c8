//! The window of lar-viewer in a browser: what the pages of `lar export-html` run.
//!
//! Everything but this file is the viewer itself; here the browser stands for the desktop, and answers that are written in
//! the page for the arrangement.

use lar_arrangement::Expression;
use lar_core::Chain;
use lar_viewer::session::{Session, WrapStep};
use lar_viewer::{Answers, Host, Queries, SharedView, ViewerError};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = larHost, js_name = copy)]
    fn copy_text(text: &str);

    #[wasm_bindgen(js_namespace = larHost, js_name = save)]
    fn save_file(name: &str, bytes: &[u8]);

    #[wasm_bindgen(js_namespace = larHost)]
    fn fail(text: &str);
}

/// Shows a view that was written by `SharedView::to_json` in a canvas at the end of the page.
#[wasm_bindgen]
pub fn open(view: &str) {
    std::panic::set_hook(Box::new(|panic| fail(&panic.to_string())));
    if let Err(error) = opened(view) {
        fail(&error.to_string());
    }
}

fn opened(view: &str) -> Result<(), ViewerError> {
    let view = SharedView::from_json(view)?;
    let queries = Recorded { session: view.session.clone(), answers: view.answers.clone() };
    let failed = |error: ViewerError| fail(&error.to_string());
    lar_viewer::open(view, Box::new(queries), Box::new(Browser), Box::new(failed))
}

/// The browser instead of a desktop.
struct Browser;

impl Host for Browser {
    fn copy(&mut self, text: &str) {
        copy_text(text);
    }

    fn save(&mut self, name: &str, bytes: &[u8]) -> Result<(), ViewerError> {
        save_file(name, bytes);
        Ok(())
    }
}

/// Answers of the arrangement that the complex comes from.
struct Recorded {
    /// Shares its complex with the window.
    session: Session,
    answers: Answers,
}

impl Queries for Recorded {
    fn boolean(&self, expression: &str) -> Result<Chain, String> {
        let data = self.session.data();
        let expression = Expression::parse(expression, data.solids()).map_err(|e| e.to_string())?;
        self.answers.cells_where(data, &expression.operands(), |inside| expression.evaluate(inside))
    }

    fn wrapping(&self, cell: u32) -> Result<Vec<WrapStep>, String> {
        self.answers.wrapping(self.session.data(), cell)
    }
}
