"""Edits of the program that nobody aimed, for scripts/mutants --draw.

They are drawn from the production files by lines and made in one copy of the tree, each asleep until the environment names it
(tests/mutants/mutant.h). One run of every test writes down which edits it reaches; an edit is then judged by those tests alone, its
own folder's first and quick ones first, until one fails. That test must pass with the edit asleep and fail again with it awake. An
edit that cannot sleep, such as a constant of the compiler, is made alone.
"""
import concurrent.futures
import contextlib
import dataclasses
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import tempfile
import threading
import time

from production_folders import production_folders

ROOT = pathlib.Path(__file__).resolve().parent.parent
HEADER = "tests/mutants/mutant.h"
FOLDERS = [folder for folder in production_folders() if folder != "python"]
COUNTED_TWICE = ("haptics", "servo")
ALSO_TESTED_IN = {"render": ["headset"], "app": ["headset"]}  # folders of tests alone
MARKS = DRAWN = 4096  # as in mutant.h
LEFT_OUT = {"long", "deep", "monado", "architecture", "fuzz"}  # labels


COMPARISONS = {"<": ("<=", "Less"), "<=": ("<", "LessEqual"), ">": (">=", "Greater"), ">=": (">", "GreaterEqual"),
               "==": ("!=", "Equal"), "!=": ("==", "NotEqual")}


def variants(line, opens_function):
    """What one line can be turned into: (kind, line, the line that holds both, with N for the edit's number, or None)."""
    code = line.split("//")[0].rstrip()
    if not code.strip() or code.lstrip().startswith(("#", "static_assert", "namespace", "using", "case", "default", "*", "}")):
        return
    bare = re.sub(r'"(?:\\.|[^"\\])*"', lambda m: '"' + "_" * (len(m[0]) - 2) + '"', code)
    if condition := re.match(r"^(\s*(?:\} else )?(?:if|while) \()(.*)(\)(?: \{| \w.*;)?)$", bare):
        first, last = condition.span(2)
        if bare[first:last].count("(") == bare[first:last].count(")") and ";" not in bare[first:last]:
            asked = code[first:last]
            yield ("negated condition", code[:first] + "!(" + asked + ")" + code[last:],
                   code[:first] + "afm_mutants::is_awake<N>() != static_cast<bool>(" + asked + ")" + code[last:])
    if re.match(r"^\s+[\w.\->:\[\]*]+(\(.*\)| [-+*/|&^]?= .*);$", bare) and not re.match(r"^\s+(return|throw|delete|co_)", bare):
        yield "dropped statement", "", re.sub(r"^(\s+)", r"\1if (!afm_mutants::is_awake<N>()) ", code)
    for place in re.finditer(r"(?<=[\w)\]]) ([-+]) (?=[\w(])", bare):
        other, asleep = {"+": ("-", 1), "-": ("+", -1)}[place[1]]
        yield ("swapped sign", code[: place.start(1)] + other + code[place.end(1):],
               code[: place.start(1)] + f"+ afm_mutants::Sign<N, {asleep}>() *" + code[place.end(1):])
    for place in re.finditer(r"(?<=[\w)\]]) (<=|>=|==|!=|<|>) (?=[\w(\-!])", bare):
        other, name = COMPARISONS[place[1]]
        yield ("swapped comparison", code[: place.start(1)] + other + code[place.end(1):],
               code[: place.end(1)] + f" afm_mutants::{name}<N>() " + place[1] + code[place.end(1):])
    for place in re.finditer(r"(?<![\w.'])(\d[\d']*\.\d+(?:e-?\d+)?F?|[1-9]\d*)(?![\w.'])", bare):
        for factor in ("0", "2"):
            call = "factor_at_run_time" if "constexpr" in code else "factor"
            both = code[: place.start(1)] + f"({place[1]} * afm_mutants::{call}<N, {factor}>())" + code[place.end(1):]
            # what is a constant of the compiler could not sleep
            both = both.replace("constexpr", "const")
            yield f"constant x {factor}", code[: place.start(1)] + f"({place[1]} * {factor})" + code[place.end(1):], both
    if opens_function:
        value = "return;" if re.match(r"^(static )?void |^\w+::~?\w+\(", code) else "return {};"
        yield "early return", code + " " + value, code + f" if (afm_mutants::is_awake<N>()) {value}"


@dataclasses.dataclass
class DrawnEdit:
    file: str
    number: int  # of the line, from 0
    line: str
    kind: str
    changed: str
    both: str

    def __str__(self):
        return f"{self.file}:{self.number + 1} {self.kind}: {(self.changed or self.line).strip()}"


def drawn_edits(seed):
    """Endless, no line twice: edits that may not compile do not count."""
    chance = random.Random(seed)
    lines = []
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".cpp", ".h") and "build" not in path.parts:
                text = path.read_text().splitlines()
                lines += [(path, number) for number in range(len(text))] * (2 if folder in COUNTED_TWICE else 1)
    seen = set()
    while True:
        path, number = chance.choice(lines)
        text = path.read_text().splitlines()
        line = text[number]
        opens = not line.startswith((" ", "}", "struct", "class", "enum", "namespace")) and line.endswith(("{",)) and ")" in line
        choices = list(variants(line, opens))
        if not choices or (path, number) in seen:
            continue
        seen.add((path, number))
        edit = DrawnEdit(str(path.relative_to(ROOT)), number, line, *chance.choice(choices))
        if not re.search(r"\(0\.0+F? \* [02]\)", edit.changed):  # nothing is still nothing
            yield edit


def kept_draw(path, count, seed):
    """The first edits that are drawn; those of a run before, by number, as far as their lines are still there."""
    if not path.exists():
        source = drawn_edits(seed)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps([dataclasses.asdict(next(source)) for _ in range(DRAWN)]))
    edits = {}
    for number, row in enumerate(json.loads(path.read_text())[:count]):
        edit = DrawnEdit(**row)
        file = ROOT / edit.file
        lines = file.read_text().splitlines() if file.exists() else []
        same = [at for at, line in enumerate(lines) if line == edit.line]
        if same:
            edits[number] = dataclasses.replace(edit, number=min(same, key=lambda at: abs(at - edit.number)))
    return edits


def write_tree(folder, changed):
    """A copy of the tree, in which some files are other texts. What is as it should be is not touched."""
    names = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                           stdout=subprocess.PIPE, text=True).stdout.splitlines()
    names = [name for name in names if (ROOT / name).is_file()]
    for name in names:
        source, target = ROOT / name, folder / name
        content = changed[name].encode() if name in changed else source.read_bytes()
        if target.is_file() and target.read_bytes() == content:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
        shutil.copymode(source, target)
    wanted = set(names)
    for path in list(folder.rglob("*")):
        relative = path.relative_to(folder)
        if relative.parts[0] != "build" and path.is_file() and str(relative) not in wanted:
            path.unlink()


def asleep(edits, folder):
    """The texts that hold all of the edits, by file, and where each lies: {(file, line): number}."""
    texts, places = {}, {}
    for file in sorted({edit.file for edit in edits.values()}):
        lines = (ROOT / file).read_text().splitlines()
        for number, edit in edits.items():
            if edit.file == file:
                both = edit.both
                if file.endswith(".h"):  # a constant of a class needs a place
                    both = re.sub(r"\bstatic const\b", "static inline const", both)
                lines[edit.number] = both.replace("<N", f"<{number}")
                places[(file, edit.number + 1)] = number
        lines[0] = f'#include "{folder}/{HEADER}"  {lines[0]}'  # in front, without moving a line
        texts[file] = "\n".join(lines) + "\n"
    return texts, places


class Build:
    """The copy in which the edits sleep."""

    def __init__(self, seed, folders, copy):
        self.folders = folders
        self.test_folders = sorted({*folders, *(more for folder in folders for more in ALSO_TESTED_IN.get(folder, []))})
        kept = ROOT / "build" / f"drawn-mutants-{seed}"
        self.folder = copy or kept
        self.drawn_path = kept.with_suffix(".drawn.json")
        self.restless_path = kept.with_suffix(".restless.txt")  # the numbers of those that cannot sleep
        self.reach_path = kept.with_suffix(".reach.json")
        self.verdicts_path = kept.with_suffix(".verdicts.txt")

    def run(self, *command):
        return subprocess.run([str(part) for part in command], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True)

    def targets(self, folders):
        """The test programs of the folders, and what they start."""
        listed = self.run("ninja", "-C", "build/release", "-t", "targets", "all").stdout
        names = set(re.findall(rf"^(test_(?:{'|'.join(folders)})_\w+): phony", listed, re.M))
        return sorted(names | {"touchafm-servo"} | ({"touchafm"} if "app" in folders else set()))

    def make(self, edits):
        """Returns those of the edits that sleep beside one another."""
        restless = {int(line) for line in self.restless_path.read_text().split()} if self.restless_path.exists() else set()
        while True:
            edits = {number: edit for number, edit in edits.items() if number not in restless}
            texts, places = asleep(edits, self.folder)
            self.folder.mkdir(parents=True, exist_ok=True)
            write_tree(self.folder, texts)
            if not (self.folder / "build" / "release" / "build.ninja").exists():
                self.run("cmake", "--preset", "release")
            built = self.run("cmake", "--build", "--preset", "release", "--target", *self.targets(self.test_folders), "--", "-k", "0")
            if built.returncode == 0:
                return edits
            found = set()
            pattern = rf"^\S*?{self.folder}/([\w/.]+):(\d+)(?::\d+)?: +(?:error|note|required)"
            for file, line in re.findall(pattern, re.sub(r"\x1b\[[\d;]*[mK]", "", built.stdout), re.M):
                file = os.path.normpath(file)  # a unity build names it by way of its own folder
                # what lacks before an edit is missed in the line before
                found |= {places[place] for place in ((file, int(line)), (file, int(line) + 1)) if place in places}
            if not found:
                raise SystemExit("error: the copy does not build, and no edit is to blame:\n" + built.stdout[-20000:])
            for number in sorted(found):
                print(f"cannot sleep: {edits[number]}", flush=True)
            restless |= found
            self.restless_path.write_text("".join(f"{number}\n" for number in sorted(restless)))


@dataclasses.dataclass
class Test:
    name: str  # as ctest calls it
    command: list  # of the program
    case: str  # of GoogleTest, or nothing where the program is one test
    serial: bool
    folder: str
    seconds: float = 0.0
    reached: tuple = ()


def listed_tests(build):
    tests = []
    for row in json.loads(build.run("ctest", "--preset", "release", "--show-only=json-v1").stdout)["tests"]:
        properties = {each["name"]: each["value"] for each in row["properties"]}
        command = row.get("command", [])
        if not command or row["name"].split(".")[0] not in build.test_folders or LEFT_OUT & set(properties.get("LABELS", [])) or row["name"].startswith("app.InstalledProgram"):
            continue
        case = next((part.split("=", 1)[1] for part in command if part.startswith("--gtest_filter=")), "")
        tests.append(Test(row["name"], [part for part in command if not part.startswith("--gtest")], case,
                          bool(properties.get("RUN_SERIAL")), properties.get("WORKING_DIRECTORY", str(build.folder))))
    return tests


class Judge:
    def __init__(self, build):
        self.build = build
        self.alone = threading.Lock()  # a test of real time has no second one beside it
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith("AFM_MUTANT")}
        self.tests = self.with_reach(listed_tests(build))

    def run(self, test, cases, environment, limit):
        """Passed or not, and what it printed."""
        command = test.command + ([f"--gtest_filter={':'.join(cases)}"] if cases and cases[0] else [])
        with self.alone if test.serial else contextlib.nullcontext():
            with tempfile.TemporaryFile("w+", errors="replace") as output:
                with subprocess.Popen(command, cwd=test.folder, stdout=output, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                      start_new_session=True, env=self.environment | {"GTEST_FAIL_FAST": "1"} | environment) as process:
                    try:
                        passed = process.wait(limit) == 0
                    except subprocess.TimeoutExpired:
                        passed = False
                    finally:
                        try:
                            os.killpg(process.pid, 9)  # what it started and left
                        except ProcessLookupError:
                            pass
                output.seek(0)
                return passed, output.read()

    def with_reach(self, tests):
        """The tests that pass while every edit sleeps, with their seconds and the edits that they reach."""
        known = json.loads(self.build.reach_path.read_text()) if self.build.reach_path.exists() else {}

        def measure(test):
            built = os.path.getmtime(test.command[-1]) if os.path.exists(test.command[-1]) else 0
            row = known.get(test.name)
            if row is None or row["built"] != built:
                with tempfile.NamedTemporaryFile() as marks:
                    marks.truncate(MARKS)
                    for _ in range(2):
                        begin = time.monotonic()
                        passed, _ = self.run(test, [test.case], {"AFM_MUTANT_REACHED": marks.name}, 300)
                        if passed:
                            break
                    reached = [number for number, mark in enumerate(pathlib.Path(marks.name).read_bytes()) if mark]
                row = {"built": built, "passed": passed, "seconds": time.monotonic() - begin, "reached": reached}
                known[test.name] = row
                if not passed:
                    print(f"left out, as it fails while every edit sleeps: {test.name}", flush=True)
            test.seconds, test.reached = row["seconds"], frozenset(row["reached"])
            return row["passed"]

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            passed = list(pool.map(measure, tests))
        self.build.reach_path.write_text(json.dumps(known))
        return [test for test, good in zip(tests, passed) if good]

    def notice(self, number, edit):
        """The test that fails with the edit awake."""
        programs = {}
        for test in self.tests:
            if number in test.reached:
                programs.setdefault(tuple(test.command), []).append(test)
        if not programs:
            return None

        def rank(tests):
            seconds = sum(test.seconds for test in tests)
            return tests[0].serial, seconds * (0.2 if tests[0].name.startswith(edit.file.split("/")[0] + ".") else 1)

        for tests in sorted(programs.values(), key=rank):
            if failed := self.failing(tests, {"AFM_MUTANT": str(number)}):
                return failed
        return None

    def failing(self, tests, awake):
        cases = {test.case: test for test in tests}
        limit = 30 + 5 * sum(test.seconds for test in tests)
        while cases:
            passed, output = self.run(tests[0], list(cases), awake, limit)
            if passed:
                return None
            named = [name for name in re.findall(r"^\[  FAILED  \] ([\w./]+)", output, re.M) if name in cases]
            begun = [name for name in re.findall(r"^\[ RUN      \] ([\w./]+)", output, re.M) if name in cases]
            suspect = (named or begun[-1:] or list(cases))[0]
            alone = [suspect]
            if self.run(tests[0], alone, {}, limit)[0] and not self.run(tests[0], alone, awake, limit)[0]:
                return cases[suspect].name
            del cases[suspect]  # it fails, or passes, by itself
        return None


def judge_alone(build, edit):
    """For an edit that cannot sleep: made alone, by the tests of its own folder, then by those of all."""
    lines = (ROOT / edit.file).read_text().splitlines()
    lines[edit.number] = edit.changed
    write_tree(build.folder, {edit.file: "\n".join(lines) + "\n"})
    own = edit.file.split("/")[0]
    for folders in ([own], [folder for folder in build.folders if folder != own]):
        if not folders:
            continue
        if build.run("cmake", "--build", "--preset", "release", "--target", *build.targets(folders)).returncode != 0:
            return "does not compile", ""
        done = build.run("ctest", "--preset", "release", "-R", rf"^({'|'.join(folders)})\.", "-E", "InstalledProgram", "-LE",
                         "^(" + "|".join(sorted(LEFT_OUT)) + ")$", "--timeout", 120, "--stop-on-failure")
        if failed := re.findall(r"^\s+\d+ - (\S+) \(", done.stdout, re.M):
            return "noticed", failed[0]
    return "SURVIVED", ""


def judge_drawn(count, seed, folders, copy):
    """Of the first `count` edits drawn, prints a verdict for each that compiles and lies in the folders; returns the verdicts."""
    build = Build(seed, folders, copy)
    drawn = kept_draw(build.drawn_path, count, seed)
    sleeping = build.make(drawn)
    judge = Judge(build)
    kept = {}  # by number: verdict, the test that failed, the edit
    if build.verdicts_path.exists():
        kept = {int(row[0]): row[1:] for row in (line.split("\t") for line in build.verdicts_path.read_text().splitlines())}

    def judged(number):
        edit = drawn[number]
        if number in alone:
            return judge_alone(build, edit)
        if by := judge.notice(number, edit):
            return "noticed", by
        return "SURVIVED", "" if any(number in test.reached for test in judge.tests) else "no test reaches it"

    def verdict(number):
        if number not in kept:
            kept[number] = [*judged(number), str(drawn[number])]
            with build.verdicts_path.open("a") as file:
                file.write("\t".join([str(number), *kept[number]]) + "\n")
        result, by, edit = kept[number]
        print(f"{result:9} {number} {edit} [{by}]", flush=True)
        return result

    mine = [number for number, edit in drawn.items() if edit.file.split("/")[0] in folders]
    reached = {number for test in judge.tests for number in test.reached}
    # a constant of the compiler, such as one within a table, cannot sleep either: it never wakes
    alone = {number for number in mine
             if number not in sleeping or number not in reached and drawn[number].kind.startswith("constant")}
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        verdicts = list(pool.map(verdict, [number for number in mine if number not in alone]))
    verdicts += [verdict(number) for number in mine if number in alone]
    return [each for each in verdicts if each != "does not compile"]
