#!/usr/bin/env bash
# Builds the viewer for browsers as one page, which `lar export-html` puts views into: target/lar-viewer.html, or the path
# given. It needs the Rust standard library for wasm32-unknown-unknown, from one of
#   rustup target add wasm32-unknown-unknown
#   apt-get install rustc-web cargo-web rust-web-src lld          (Debian 12)
# and, to make the page smaller, wasm-opt (Debian: apt-get install binaryen).
set -euo pipefail
out=$(realpath -m "${1:-$(dirname "$0")/../../target/lar-viewer.html}")
cd "$(dirname "$0")"
target=wasm32-unknown-unknown
export CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-$PWD/../../target/web}"

# The program that packs the page runs here, and takes longer to optimise than to run.
export CARGO_PROFILE_DEV_OPT_LEVEL=1
cargo build --locked --package lar-viewer-web-bundler
module="$CARGO_TARGET_DIR/$target/release/lar_viewer_web.wasm"

if [ -d "$(rustc --print sysroot)/lib/rustlib/$target/lib" ]; then
    cargo build --locked --package lar-viewer-web --release --target "$target"
elif [ -d /usr/lib/rustlib/src/rust/library ] && [ -x /usr/bin/cargo ]; then
    # Debian ships the library as source; building it is an option that only nightly compilers offer by themselves. The linker
    # is looked for under the name that rustup gives it.
    mkdir -p "$CARGO_TARGET_DIR/bin"
    ln -sf "$(command -v lld)" "$CARGO_TARGET_DIR/bin/rust-lld"
    PATH="$CARGO_TARGET_DIR/bin:$PATH"
    RUSTC_BOOTSTRAP=1 RUSTC=/usr/bin/rustc /usr/bin/cargo build --locked --package lar-viewer-web --release \
        --target "$target" -Z build-std=std,panic_abort
else
    echo "no Rust standard library for $target: run 'rustup target add $target', or on Debian" >&2
    echo "'apt-get install rustc-web cargo-web rust-web-src lld'" >&2
    exit 2
fi

mkdir -p "$(dirname "$out")"
"$CARGO_TARGET_DIR/debug/lar-viewer-web-bundler" "$module" page.html "$out"
