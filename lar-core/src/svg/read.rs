//! Reading SVG: which elements are drawn, and where.
//!
//! The document is walked with an explicit stack. `g`, `a`, `svg` and `switch` pass their transforms on, `use`
//! draws what it names, and what only serves other elements (`defs`, `symbol`, `clipPath`, …), text and
//! images are passed over. Elements with `display: none` are not drawn. Of style only this and the fill rule say
//! anything about shape; style sheets are not read.

use super::pen::{Map, Pen, Stop};
use super::shapes::{self, Fault};
use super::{Drawing, NamedShapes, SvgError};
use crate::atomic_write::read;
use roxmltree::{Document, Node, ParsingOptions};
use rustc_hash::FxHashMap;
use std::path::Path;
use svgtypes::{Length, LengthUnit};

/// Reads the shapes of an SVG file: paths with all commands, `rect`, `circle`, `ellipse`, `line`, `polyline`
/// and `polygon`, in groups, with transforms. No point of a curve is farther than `tolerance` from its chord.
/// O(size of the file + number of points).
///
/// # Errors
/// When the file cannot be read, is no SVG, an attribute is malformed or uses what is not supported (lengths
/// in % or em, nested `viewBox`), a point is not finite, or the tolerance asks for more points than a file of
/// this size is allowed (a million and a hundred a byte).
///
/// ```
/// let path = std::env::temp_dir().join(format!("lar-plan-{}.svg", std::process::id()));
/// std::fs::write(&path, "<svg><rect width='2' height='1'/></svg>").unwrap();
/// let plan = lar_core::read_svg(&path, 0.01)?;
/// assert_eq!(plan.to_model().f_vector(), [4, 4]);
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), lar_core::SvgError>(())
/// ```
#[doc(alias = "svg2lar")]
#[doc(alias = "svg2lines")]
pub fn read_svg(path: impl AsRef<Path>, tolerance: f64) -> Result<Drawing, SvgError> {
    let path = path.as_ref();
    let bytes = read(path)?;
    let text = str::from_utf8(&bytes).map_err(|e| {
        let line = 1 + bytes[..e.valid_up_to()].iter().filter(|&&b| b == b'\n').count();
        SvgError::NotUtf8 { file: path.to_owned(), line }
    })?;
    parse_svg(text, path, tolerance)
}

/// Reads the text of an SVG file; `file` is for messages. O(size of the text and of what `use` repeats).
///
/// # Errors
/// As [`read_svg`].
///
/// ```
/// use lar_core::parse_svg;
/// let text = r#"<svg xmlns="http://www.w3.org/2000/svg"><g transform="translate(1 2)">
///     <path d="M0 0h4v3z m1 1q1 0 1 1"/></g></svg>"#;
/// let drawing = parse_svg(text, "a.svg", 0.01)?;
/// assert_eq!(drawing.polylines[0].points.coords(), [1., -2., 5., -2., 5., -5.]);
/// assert!(drawing.polylines[0].closed && !drawing.polylines[1].closed);
/// # Ok::<(), lar_core::SvgError>(())
/// ```
pub fn parse_svg(text: &str, file: impl AsRef<Path>, tolerance: f64) -> Result<Drawing, SvgError> {
    let file = file.as_ref();
    if !(tolerance > 0. && tolerance.is_finite()) {
        return Err(SvgError::Tolerance { value: tolerance });
    }
    check_entities(text, file)?;
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| SvgError::Xml {
        file: file.to_owned(),
        line: e.pos().row as usize,
        message: e.to_string(),
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(SvgError::NotSvg { file: file.to_owned(), found: root.tag_name().name().to_owned() });
    }
    let limit = 1_000_000 + 100 * text.len();
    let pen = Pen::new(tolerance, limit);
    let ids = document.descendants().filter_map(|node| Some((node.attribute("id")?, node))).collect();
    let mut walk = Walk { file, root, ids, pen, limit, tolerance, visits: limit };
    walk.run()?;
    Ok(walk.pen.drawing)
}

/// The XML parser lets one reference to an entity expand to 255 others: what entities can grow to is bounded
/// before they are.
fn check_entities(text: &str, file: &Path) -> Result<(), SvgError> {
    const LIMIT: usize = 1 << 26;
    let Some(start) = text.find("<!ENTITY") else { return Ok(()) };
    let declarations = text.find("]>").unwrap_or(text.len());
    let references = text.bytes().filter(|&b| b == b'&').count();
    if references.saturating_mul(256).saturating_mul(declarations) <= LIMIT {
        return Ok(());
    }
    let line = 1 + text[..start].bytes().filter(|&b| b == b'\n').count();
    let found = format!("{references} references to {declarations} bytes of declarations");
    Err(SvgError::Unsupported { file: file.to_owned(), line, what: "so much use of entities", found })
}

/// An element to be drawn.
#[derive(Clone, Copy)]
struct Visit<'a, 'i> {
    node: Node<'a, 'i>,
    map: Map,
    id: Option<&'a str>,
    even_odd: bool,
    /// How many `use` elements led here.
    uses: usize,
}

/// What is to be done next.
enum Step<'a, 'i> {
    Visit(Visit<'a, 'i>),
    /// The named element of this number has been drawn.
    Close(usize),
}

struct Walk<'a, 'i> {
    file: &'a Path,
    root: Node<'a, 'i>,
    ids: FxHashMap<&'a str, Node<'a, 'i>>,
    pen: Pen,
    limit: usize,
    tolerance: f64,
    /// Elements that may still be visited; `use` can copy in powers.
    visits: usize,
}

impl<'a, 'i> Walk<'a, 'i> {
    fn run(&mut self) -> Result<(), SvgError> {
        let root = Visit { node: self.root, map: Map::UPRIGHT, id: None, even_odd: false, uses: 0 };
        let mut stack = vec![Step::Visit(root)];
        while let Some(step) = stack.pop() {
            let visit = match step {
                Step::Visit(visit) => visit,
                Step::Close(named) => {
                    self.close(named);
                    continue;
                }
            };
            self.visits = match self.visits.checked_sub(1) {
                Some(left) => left,
                None => return Err(self.too_large(visit.node, "elements")),
            };
            if visit.node.is_element() && !hidden(visit.node) {
                self.visit(visit, &mut stack)?;
            }
        }
        Ok(())
    }

    fn visit(&mut self, visit: Visit<'a, 'i>, stack: &mut Vec<Step<'a, 'i>>) -> Result<(), SvgError> {
        let Visit { node, map, id, even_odd, uses } = visit;
        if let Some(id) = node.attribute("id") {
            let named = &mut self.pen.drawing.named;
            stack.push(Step::Close(named.len()));
            named.push(NamedShapes { id: id.to_owned(), shapes: self.pen.shape..self.pen.shape });
        }
        let id = node.attribute("id").or(id);
        let even_odd = match property(node, "fill-rule") {
            Some("evenodd") => true,
            Some("nonzero") => false,
            _ => even_odd,
        };
        let local = shapes::transform(node).map_err(|fault| self.fault(node, fault))?;
        let map = map.after(&local);
        match node.tag_name().name() {
            "g" | "a" | "switch" => push_children(stack, &Visit { node, map, id, even_odd, uses }),
            "svg" => {
                let map = map.after(&self.nested(node)?);
                push_children(stack, &Visit { node, map, id, even_odd, uses });
            }
            "use" => self.reference(Visit { node, map, id, even_odd, uses }, stack)?,
            name => {
                self.pen.map = map;
                self.pen.id = id.map(str::to_owned);
                self.pen.even_odd = even_odd;
                let before = self.pen.drawing.polylines.len();
                shapes::draw(&mut self.pen, node, name).map_err(|fault| self.fault(node, fault))?;
                self.pen.shape += usize::from(self.pen.drawing.polylines.len() > before);
            }
        }
        Ok(())
    }

    /// Without shapes a named element is forgotten, and so are those in it, which have none either.
    fn close(&mut self, named: usize) {
        let (end, all) = (self.pen.shape, &mut self.pen.drawing.named);
        if all[named].shapes.start == end {
            all.truncate(named);
        } else {
            all[named].shapes.end = end;
        }
    }

    /// Where an `svg` inside another stands.
    fn nested(&self, node: Node<'_, '_>) -> Result<Map, SvgError> {
        if node == self.root {
            return Ok(Map::translation(0., 0.));
        }
        if let Some(found) = node.attribute("viewBox") {
            return Err(self.unsupported(node, "viewBox of a nested element", found));
        }
        let at = |name| length(node, name).map_err(|fault| self.fault(node, fault));
        Ok(Map::translation(at("x")?.unwrap_or(0.), at("y")?.unwrap_or(0.)))
    }

    fn reference(&self, visit: Visit<'a, 'i>, stack: &mut Vec<Step<'a, 'i>>) -> Result<(), SvgError> {
        const DEEPEST: usize = 32;
        let Visit { node, map, id, even_odd, uses } = visit;
        let href =
            node.attribute("href").or_else(|| node.attribute(("http://www.w3.org/1999/xlink", "href")));
        let href = href.unwrap_or("");
        let Some(&target) = href.strip_prefix('#').and_then(|name| self.ids.get(name)) else {
            return Err(self.unsupported(node, "a reference to what is not in the file", href));
        };
        if uses >= DEEPEST {
            return Err(self.unsupported(node, "nesting of references deeper than 32", href));
        }
        let map = map.after(&self.nested(node)?);
        let uses = uses + 1;
        if target.tag_name().name() == "symbol" {
            if let Some(found) = target.attribute("viewBox") {
                return Err(self.unsupported(target, "viewBox of a nested element", found));
            }
            push_children(stack, &Visit { node: target, map, id, even_odd, uses });
        } else {
            stack.push(Step::Visit(Visit { node: target, map, id, even_odd, uses }));
        }
        Ok(())
    }

    fn line(&self, node: Node<'_, '_>) -> usize {
        node.document().text_pos_at(node.range().start).row as usize
    }

    fn unsupported(&self, node: Node<'_, '_>, what: &'static str, found: &str) -> SvgError {
        let (file, line) = (self.file.to_owned(), self.line(node));
        SvgError::Unsupported { file, line, what, found: crate::files::clip(found) }
    }

    fn too_large(&self, node: Node<'_, '_>, what: &'static str) -> SvgError {
        let (file, line) = (self.file.to_owned(), self.line(node));
        SvgError::TooLarge { file, line, what, limit: self.limit, tolerance: self.tolerance }
    }

    fn fault(&self, node: Node<'_, '_>, fault: Fault) -> SvgError {
        let (file, line) = (self.file.to_owned(), self.line(node));
        let element = node.tag_name().name().to_owned();
        match fault {
            Fault::Attribute(attribute, expected) => {
                let found = crate::files::clip(node.attribute(attribute).unwrap_or(""));
                SvgError::Attribute { file, line, element, attribute: attribute.to_owned(), found, expected }
            }
            Fault::Stop(Stop::NonFinite([x, y])) => SvgError::NonFinite { file, line, element, x, y },
            Fault::Stop(Stop::TooMany) => self.too_large(node, "points"),
        }
    }
}

fn push_children<'a, 'i>(stack: &mut Vec<Step<'a, 'i>>, parent: &Visit<'a, 'i>) {
    stack.extend(parent.node.children().rev().map(|node| Step::Visit(Visit { node, ..*parent })));
}

fn hidden(node: Node<'_, '_>) -> bool {
    property(node, "display") == Some("none")
}

/// The value that an element gives to a property: in its `style`, or else in the attribute of this name.
fn property<'a>(node: Node<'a, '_>, property: &str) -> Option<&'a str> {
    let style = node.attribute("style").unwrap_or("");
    let mut declared = style.split(';').filter_map(|declaration| declaration.split_once(':'));
    let styled = declared.rfind(|(name, _)| name.trim() == property);
    styled.map(|(_, value)| value).or(node.attribute(property)).map(str::trim)
}

/// A length in user units; `None` when the attribute is absent or `auto`.
pub(super) fn length(node: Node<'_, '_>, name: &'static str) -> Result<Option<f64>, Fault> {
    /// CSS Values and Units 3, section 5.2: 96 px to the inch.
    const INCH: f64 = 96.;
    let Some(text) = node.attribute(name).filter(|&text| text.trim() != "auto") else { return Ok(None) };
    let fault = Fault::Attribute(name, "a length in px, in, cm, mm, pt or pc");
    let Ok(length) = text.trim().parse::<Length>() else { return Err(fault) };
    let unit = match length.unit {
        LengthUnit::None | LengthUnit::Px => 1.,
        LengthUnit::In => INCH,
        LengthUnit::Cm => INCH / 2.54,
        LengthUnit::Mm => INCH / 25.4,
        LengthUnit::Pt => INCH / 72.,
        LengthUnit::Pc => INCH / 6.,
        LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => return Err(fault),
    };
    Ok(Some(length.number * unit))
}
