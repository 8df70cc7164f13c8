"""The tables of the document, from the results."""

PROGRAMS = ["lar", "manifold3d", "meshlib", "trueform"]
# Relative to the union's volume. meshlib computes with 32-bit coordinates.
AGREEMENT = {"lar": 1e-9, "manifold3d": 1e-6, "meshlib": 1e-4, "trueform": 1e-6}
BEGIN, END = "<!-- tables: made by lar-examples/reliability -->", "<!-- end of tables -->"


def kind(result):
    """What the input is, from its own arrangement."""
    copy = result.get("copy", {})
    if copy.get("closure") != "closed":
        return copy.get("closure", "not read")
    low, high = copy["windings"]
    if (low, high) == (0, 1):
        return "solid"
    return "inside out" if (low, high) == (-1, 0) else "self-crossing"


def verdict(result, program):
    """ok, or how the program failed; the document explains the words."""
    if program not in result:
        return "not read"
    found = result[program]
    if found.get("problem"):
        return found["problem"]
    if "refused" in found:
        return "refused"
    volumes = found["volumes"]
    if any(found["open"].values()):
        return "not closed"
    size = max(map(abs, volumes.values()), default=0.0)
    if size == 0:
        return "nothing"
    slack = AGREEMENT[program] * size
    parts = volumes["difference"] + volumes["reverse"] + volumes["intersection"]
    if abs(volumes["union"] - parts) > slack:
        return "inconsistent volumes"
    ours = result["lar"]["volumes"]
    if program != "lar" and len(ours) == 4 and any(abs(volumes[k] - ours[k]) > slack for k in ours):
        return "other volume"
    return "ok"


def line(result):
    verdicts = ", ".join(f"{p}: {verdict(result, p)}" for p in PROGRAMS)
    alone = result["alone"].get("problem") or result.get("copy", {}).get("problem") or "ok"
    return f"[{kind(result)}] alone: {alone}; {verdicts}"


def summary(results):
    """How often each program answered how, by kind of input."""
    rows = ["| input | models | " + " | ".join(PROGRAMS) + " |", "|---" * (2 + len(PROGRAMS)) + "|"]
    for wanted in ["solid", "inside out", "self-crossing", "unoriented", "open", "not read"]:
        of_kind = [r for r in results.values() if kind(r) == wanted]
        if not of_kind:
            continue
        cells = []
        for program in PROGRAMS:
            counts = {}
            for result in of_kind:
                word = verdict(result, program)
                counts[word] = counts.get(word, 0) + 1
            order = sorted(counts.items(), key=lambda item: (item[0] != "ok", -item[1], item[0]))
            cells.append(", ".join(f"{n} {word}" for word, n in order))
        rows.append(f"| {wanted} | {len(of_kind)} | " + " | ".join(cells) + " |")
    return rows


def details(results):
    columns = [f"{p}, s" for p in PROGRAMS]
    rows = [
        "| model | faces | input | cells | alone, s | " + " | ".join(columns) + " |",
        "|---" * (5 + len(PROGRAMS)) + "|",
    ]
    for name, result in results.items():
        alone = result["alone"]
        cells = [name, alone.get("faces", ""), kind(result), alone.get("cells", "")]
        cells.append(alone.get("problem") or f"{alone['seconds']:.3f}")
        for program in PROGRAMS:
            word = verdict(result, program)
            seconds = result.get(program, {}).get("seconds")
            time = f" {seconds:.2f}" if seconds is not None and word in ("ok", "other volume") else ""
            cells.append(word + time)
        rows.append("| " + " | ".join(map(str, cells)) + " |")
    return rows


def write(document, results):
    """Replaces what stands between the two marks."""
    text = document.read_text()
    before, rest = text.split(BEGIN)
    _, after = rest.split(END)
    tables = "\n".join(["", *summary(results), "", *details(results), ""])
    document.write_text(before + BEGIN + "\n" + tables + "\n" + END + after)
