//! `bundler MODULE.wasm PAGE.html OUT.html`: the page with the viewer in it, still without a view.
//!
//! wasm-bindgen makes the JavaScript between browser and module; Binaryen's wasm-opt, when it is installed, makes the module
//! smaller.

use base64::{Engine, prelude::BASE64_STANDARD};
use flate2::{Compression, write::GzEncoder};
use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::process::Command;
use std::{env, fs};
use walrus::{ExportItem, RefType, Table};
use wasm_bindgen_cli_support::Bindgen;

/// The name under which wasm-bindgen exports the table of references to JavaScript.
const TABLE: &str = "__wbindgen_externrefs";

/// Where the page takes the viewer.
const MARK: &str = "<!--lar:viewer-->";

fn main() -> Result<(), Box<dyn Error>> {
    let [module, page, out] = <[String; 3]>::try_from(env::args().skip(1).collect::<Vec<_>>())
        .map_err(|_| "usage: bundler MODULE.wasm PAGE.html OUT.html")?;
    let mut bound =
        Bindgen::new().input_path(&module).no_modules(true)?.typescript(false).generate_output()?;
    let wasm = optimized(bound.wasm_mut().emit_wasm(), Path::new(&out))?;
    // A script ends at the first `</script`, whatever it means there.
    let glue = bound.js().replace("</", "<\\/");
    let packed = BASE64_STANDARD.encode(gzip(&wasm)?);
    let viewer = format!(
        "<script>\n{glue}\n</script>\n<script id=\"lar-viewer\" type=\"application/octet-stream\">{packed}</script>"
    );
    let page = fs::read_to_string(page)?;
    let (before, after) = page.split_once(MARK).ok_or("the page has no place for the viewer")?;
    let page = [before, &viewer, after].concat();
    println!("{out}: {} bytes; module {} bytes, {} in the page", page.len(), wasm.len(), packed.len());
    Ok(fs::write(out, page)?)
}

/// The module as wasm-opt makes it, or as it is without wasm-opt.
fn optimized(wasm: Vec<u8>, out: &Path) -> Result<Vec<u8>, Box<dyn Error>> {
    let [from, to] = ["unoptimized.wasm", "optimized.wasm"].map(|name| out.with_file_name(name));
    fs::write(&from, &wasm)?;
    let run = Command::new("wasm-opt").args(["-Os", "--all-features"]).arg(&from).arg("-o").arg(&to).status();
    let result = match run {
        Ok(status) if status.success() => with_exported_table(&fs::read(&to)?)?,
        Ok(status) => return Err(format!("wasm-opt: {status}").into()),
        Err(_) => {
            println!(
                "without wasm-opt, which would make the page smaller (Debian: apt-get install binaryen)"
            );
            wasm
        }
    };
    for file in [from, to] {
        let _ = fs::remove_file(file);
    }
    Ok(result)
}

/// The module with the table of references to JavaScript exported, which the glue fills. wasm-opt 108, as in
/// Debian 12, exports the first table whatever the name.
fn with_exported_table(wasm: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut module = walrus::ModuleConfig::new().generate_name_section(false).parse(wasm)?;
    let references = module.tables.iter().find(|table| table.element_ty == RefType::EXTERNREF).map(Table::id);
    for export in module.exports.iter_mut() {
        if let (ExportItem::Table(table), Some(references), TABLE) =
            (&mut export.item, references, &*export.name)
        {
            *table = references;
        }
    }
    Ok(module.emit_wasm())
}

fn gzip(bytes: &[u8]) -> Result<Vec<u8>, std::io::Error> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}
