"""The six commands that tests/faults/inject disturbs: their inputs, their outputs, and what may differ in them."""
import json
import os
import pathlib
import re
import shutil

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A file of others that lies beside the outputs, and in a folder that was written before.
LETTER = "letter.txt"

# Keys of records that differ from run to run, wherever they are: times, and finds in the cache or on the machine.
VARYING_KEYS = {"seconds", "cpuSeconds", "peakMemoryBytes", "engineCommands", "command", "host", "cache", "locks", "threads",
                "plan"}
# In records of these kinds also hashes of records that have such keys.
VARYING_IN_KIND = {"cell": {"files", "seal"}}
# Attributes of XML.
VARYING_TEXT = re.compile(rb'\b(?:time|timestamp|hostname)="[^"]*"')
# Outputs that are not compared: a cache may hold more or less, and what an acceptance keeps is judged as unfinished or not.
NOT_COMPARED = ("run/cache/", "truth/.lobelia-accepted")
UNFINISHED = re.compile(r"\.part$|^run/cache/making/|^truth/\.lobelia-accepted/(?!last\b|lock$|\.gitignore$)|^tmp/.")

FARM = ["farm", "grid.xml", "-o", "run", "--threads", "2"]
COMPARE = ["compare", "mine", "truth", "--threads", "2"]


class Case:
    """A command with its input. `outputs` are what it writes. `earlier` are commands that wrote there before; then a file of
    others lies in the first output, too."""

    def __init__(self, command, arguments, outputs, earlier=()):
        self.command, self.arguments, self.outputs, self.earlier = command, arguments, outputs, earlier
        self.name = f"{command} {outputs[0]}{' again' if earlier else ''}"
        self.accepts = "--accept" in arguments
        self.input = self.code = self.said = self.results = self.old = None
        self.counts, self.before_main = {}, {}

    def is_output(self, name):
        return any(name == output or name.startswith(output + "/") for output in self.outputs) and not name.endswith(LETTER)

    def is_scratch(self, name):
        return name.split("/")[0] in ("home", "tmp")


def cases():
    reports = [f"out/{name}" for name in ("record.json", "table.csv", "junit.xml", "all.md", "maps")]
    options = [word for pair in zip(("--json", "--csv", "--junit", "--markdown", "--diff-image"), reports) for word in pair]
    gallery, publish = ["gallery", "run", "--threads", "2", "-o"], ["gallery", "publish", "run", "--threads", "2", "-o"]
    return [
        Case("farm", FARM, ["run"]),
        Case("farm", FARM, ["run"], [["farm", "old.xml", "-o", "run"]]),
        Case("compare", COMPARE + options, ["out"]),
        Case("compare", COMPARE + options, ["out"], [["compare", "other"] + COMPARE[2:] + options]),
        Case("compare --html", COMPARE + ["--html", "report"], ["report"]),
        Case("compare --html", COMPARE + ["--html", "report"], ["report"], [["compare", "other", "truth", "--html", "report"]]),
        Case("compare --accept", ["compare", "other", "truth", "--threads", "2", "--accept"], ["truth"]),
        Case("gallery", gallery + ["site"], ["site"]),
        Case("gallery", gallery + ["site"], ["site"], [["gallery", "before", "-o", "site"]]),
        Case("gallery publish", publish + ["public"], ["public"]),
        Case("gallery publish", publish + ["public"], ["public"], [["gallery", "publish", "before", "-o", "public"]]),
        Case("gallery publish", publish + ["page.html"], ["page.html"], [["gallery", "publish", "before", "-o", "page.html"]]),
    ]


def tree(place):
    """{name: (mode, time, bytes or target)} of everything below."""
    found = {}
    for folder, folders, files in os.walk(place):
        for name in folders + files:
            path = pathlib.Path(folder, name)
            status = path.lstat()
            content = os.readlink(path) if path.is_symlink() else path.read_bytes() if path.is_file() else None
            changed = None if content is None else status.st_mtime_ns
            found[path.relative_to(place).as_posix()] = (status.st_mode, changed, content)
    return found


def without_varying(value):
    if isinstance(value, list):
        return [without_varying(one) for one in value]
    if not isinstance(value, dict):
        return value
    varying = VARYING_KEYS | VARYING_IN_KIND.get(str(value.get("kind")), set())
    return {key: without_varying(one) for key, one in value.items() if key not in varying}


def comparable(name, content):
    """A file's bytes, without what differs from run to run."""
    if name.endswith(".log"):
        return b""
    if name.endswith(".xml"):
        return VARYING_TEXT.sub(b"", content)
    if name.endswith(".json"):
        try:
            return json.dumps(without_varying(json.loads(content)))
        except ValueError:
            pass
    return content


def results_of(case, files):
    """The results of a command. An empty directory may stay."""
    return {name: (mode, comparable(name, content)) for name, (mode, _, content) in files.items()
            if content is not None and case.is_output(name) and not name.startswith(NOT_COMPARED)}


def others_of(case, files):
    """Files of others."""
    return {name: file for name, file in files.items() if not case.is_output(name) and not case.is_scratch(name)}


def unfinished(files):
    return [name for name, file in files.items() if UNFINISHED.search(name) and file[2] is not None]


def difference(before, after):
    """The first name at which they differ, or an empty text."""
    for name in sorted(before.keys() | after.keys()):
        if before.get(name) != after.get(name):
            what = "missing" if name not in after else "new" if name not in before else "changed"
            return f"{name} is {what}"
    return ""


GRID = '<grid version="1"><scene file="scene.xml"/><film width="16" height="16"/><axis name="exponent" values="{}"/>' \
       '<engine name="analytic"/></grid>\n'


def make_common(bench):
    """All inputs have pictures that pass, pictures that differ, grids, and two runs of a farm."""
    place = bench.place
    for folder in ("home", "tmp", "mine/sub", "truth/sub", "other/sub", "out"):
        (place / folder).mkdir(parents=True)
    shutil.copy(ROOT / "reference_scenes/scenes/head_on.xml", place / "scene.xml")
    (place / "grid.xml").write_text(GRID.format("16, 32"))
    (place / "old.xml").write_text(GRID.format("16, 64"))
    for folder, exponent in (("mine", "20"), ("truth", "20"), ("other", "40")):
        bench.must("render", "-q", "scene.xml", "--width", "16", "--height", "16", "--exponent", exponent,
                   "-o", f"{folder}/x.exr", "--png", f"{folder}/sub/y.png")
        (place / folder / "x.json").unlink()
        # OpenImageIO reads it, in a process of its own.
        (place / folder / "z.ppm").write_bytes(b"P6 16 16 255\n" + bytes([int(exponent), 90, 30]) * 256)
    shutil.copy(place / "other/x.exr", place / "other/sub/new.exr")
    (place / LETTER).write_text("Dear\n")
    bench.must("farm", "old.xml", "-q", "-o", "before")
    bench.must("farm", "grid.xml", "-q", "-o", "run")
    for run in ("before", "run"):
        shutil.rmtree(place / run / "cache")


def prepare(bench, every):
    shutil.rmtree(bench.place, ignore_errors=True)
    make_common(bench)
    shutil.move(bench.place, bench.work / "common")
    for number, case in enumerate(every):
        bench.fresh(bench.work / "common")
        if case.command == "farm":
            shutil.rmtree(bench.place / "run")
        for arguments in case.earlier:
            bench.must(*arguments, "-q")
        if (bench.place / case.outputs[0]).is_dir():
            (bench.place / case.outputs[0] / LETTER).write_text("Dear\n")
        case.input = bench.work / f"input-{number}"
        shutil.move(bench.place, case.input)
