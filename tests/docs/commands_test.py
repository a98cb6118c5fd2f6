#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every command of the program that README.md, CONTRIBUTING.md, a page of docs/ or a workflow there
shows is one that the program takes.

    commands_test.py PROGRAM TREE

A command is a line that begins with `floorproof` or `./floorproof`, as a shell reads it: quotes,
comments, variables, lines that go on. Of each

  the subcommand and every option are ones that the program knows,
  files of models/ and docs/ are there,
  what is cheap is run, in a folder a page and in the page's order, so that a later line finds what
  an earlier one has left: a drive of one second; one episode of a campaign, of every variant where
  a later line names its folder,
  what is dear is read as far as its first input, which is one that does not exist; so values and
  what is required were looked at. A scenario's --set are read by `scene`.

Commands between backquotes may leave things out, so of them only names are looked at. Commands of
the launcher (test, setup, ...) are held against the launcher's own head.
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

# What pages leave to the reader. Files lie in every page's folder; words stand for an argument.
SCENARIO = """scenario: 1
site: TREE/models/sites/small_room.yaml
robot: beluga
plan: {planner: boustrophedon}
physics: {timestep_s: 0.005}
randomise: {start.x_m: {normal: [1.0, 0.02]}}
success: {min_coverage: 0.9}
"""
VARIANTS = """matrix:
  plan.planner: [boustrophedon, spiral]
  floors: [{label: dry, site.floor.friction: 0.8}, {label: wet, site.floor.friction: 0.4}]
"""
TWO_PLANNERS = """matrix:
  planner:
    - {label: ours, plan: {planner: boustrophedon}}
    - {label: mine, plan: {command: [./rows.py]}}
"""
PLAN = "x_m,y_m\n0.5,0.5\n2.5,0.5\n"
MAP = "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n"
SCENARIOS = ("scenario.yaml", "my_scenario.yaml", "hall.yaml", "A.yaml", "B.yaml", "C.yaml", "S",
             "floor/scenario.yaml")
MAPS = ("MY_MAP.yaml", "MAP.yaml", "../shared/maps/lab_small/map.yaml")
ROBOTS = ("my_robot.xml", "burger.xml", "FILE")
MAKE_A_ROBOT = ("docs/robot.md", "docs/tutorial-your-robot.md")  # by their first command
WORDS = {"ROBOT": "beluga", "N": "2"}
VARIABLES = {"N": "2", "a": "0", "b": "1"}  # of a job script that a page shows in parts
# Commands that need what is not made by a command line of their page.
NAMES_ONLY = {
    ("docs/adding-a-planner.md", "plan"): "the planner that the page adds",
    ("docs/cluster.md", "merge"): "shards that GNU parallel had driven",
    ("docs/report.md", "report"): "any campaign's folder",
}

CHEAP = ("list", "doctor", "init", "plan", "scene", "robot", "report", "merge", "compare", "replay",
         "run", "campaign")
SECONDS = 200  # of one command, on a machine that is busy with other things; idle, a few at most
DONE = (0, 1, 4)  # done, not a success, undecided: any that is neither bad usage nor a broken tool
UNKNOWN = "--no-such-option"


def page_names(tree):
    return ["README.md", "CONTRIBUTING.md"] + [
        str(path.relative_to(tree)) for kind in ("*.md", "examples/*.yml")
        for path in sorted((tree / "docs").glob(kind))]


def command_lines(text):
    """(number, line) of each command line; those that end with a backslash go on."""
    lines = text.splitlines()
    for at, line in enumerate(lines):
        if not re.match(r"\s*(time )?(\./)?floorproof(\s|$)", line):
            continue
        number = at + 1
        while line.endswith("\\") and at + 1 < len(lines):
            at += 1
            line = line[:-1] + lines[at]
        yield number, line.strip()


def inline_commands(text):
    for at, line in enumerate(text.splitlines()):
        for command in re.findall(r"`((?:\./)?floorproof [^`]*)`", line):
            yield at + 1, command


def arguments_of(line, folder):
    """The arguments as bash expands them; without brackets around what may be left out, and `...`.
    Where the output goes is no argument."""
    line = re.sub(r"\s>\s*\S+$", "", line)
    script = 'floorproof() { printf "%s\\0" "$@"; }\n' + re.sub(r"^(time )?(\./)?", "", line)
    done = subprocess.run(["bash", "-c", script], cwd=folder, env={**os.environ, **VARIABLES},
                          capture_output=True, text=True, timeout=SECONDS)
    if done.returncode:
        return None
    words = [word.strip("[]") if re.match(r"\[--|\w+\]$", word) else word
             for word in done.stdout.split("\0")[:-1]]
    return [WORDS.get(word, word) for word in words if word != "..."]


class Page:
    """A page's folder, in which its commands are run."""

    def __init__(self, program, tree, name, folder):
        self.program, self.tree, self.name, self.folder = program, tree, name, folder
        folder.mkdir()
        for link in ("models", "docs"):
            (folder / link).symlink_to(tree / link)
        scenario = SCENARIO.replace("TREE", str(tree))
        for file in SCENARIOS:
            self.write(file, scenario + (VARIANTS if name == "docs/campaigns.md" else ""))
        self.write("my/two.yaml", scenario + TWO_PLANNERS)
        (folder / "my/rows.py").symlink_to(tree / "docs/examples/rows.py")
        self.write("plan.csv", PLAN)
        for robot in ROBOTS if name not in MAKE_A_ROBOT else ():
            (folder / robot).symlink_to(tree / "models/beluga.xml")
        (folder / "my_robot.urdf").symlink_to(tree / "models/others/kobuki.urdf")
        width, height = 60, 40  # a room of 3 m x 2 m
        rows = [bytes([0 if x in (0, width - 1) or y in (0, height - 1) else 254
                       for x in range(width)]) for y in range(height)]
        for map_file in MAPS:
            self.write(map_file, MAP)
            ((folder / map_file).parent / "map.pgm").write_bytes(
                f"P5 {width} {height} 255\n".encode() + b"".join(rows))

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def run(self, arguments):
        """The exit status, and what was said on stderr."""
        done = subprocess.run([self.program, *arguments], cwd=self.folder, capture_output=True,
                              text=True, errors="replace", timeout=SECONDS)
        return done.returncode, done.stderr.strip()

    def findings(self):
        """One line for each thing that is wrong with a command of the page."""
        text = (self.tree / self.name).read_text(encoding="utf-8")
        for number, line in command_lines(text):
            later = "\n".join(text.splitlines()[number:])
            yield from self.of_command(number, line, later)
        for number, line in inline_commands(text):
            yield from self.of_command(number, line, None)

    def of_command(self, number, line, later):
        """`later` is the page's text from there on; of commands between backquotes None."""
        arguments = arguments_of(line, self.folder)
        if arguments is None:
            found = "the shell refuses it"
        elif arguments and arguments[0] in launcher_commands(self.tree):
            found = refusal_of_launcher(self.tree, arguments)
        else:
            found = self.unknown_name(arguments) or self.missing_file(arguments)
            if not found and later is not None and (self.name, arguments[0]) not in NAMES_ONLY:
                found = self.refusal(arguments, later)
        if found:
            yield f"{self.name}:{number}: {line}\n    {found}"

    def unknown_name(self, arguments):
        if not arguments or arguments[0].startswith("-"):  # --version
            status, said = self.run(arguments)
            return None if status == 0 else said
        status, said = self.run([*arguments, UNKNOWN])
        if status != 2 or UNKNOWN not in said:
            return said or f"status {status}"
        return None

    def missing_file(self, arguments):
        for word in arguments:
            if re.match(r"(models|docs)/", word) and not (self.tree / word).exists():
                return f"there is no {word}"
        return None

    def refusal(self, arguments, later):
        command = arguments[0]
        if command in CHEAP and "--ladder" not in arguments:
            status, said = self.run(shortened(arguments, later))
            return None if status in DONE else said or f"status {status}"
        if len(arguments) == 1 or arguments[1].startswith("-"):
            return None  # no input; its names were looked at
        absent = "absent" + pathlib.Path(arguments[1]).suffix
        status, said = self.run([command, absent, *arguments[2:]])
        if status != 2 or absent not in said:
            return said or f"status {status}"
        return self.refusal_of_settings(arguments)

    def refusal_of_settings(self, arguments):
        pairs = zip(arguments, arguments[1:])
        settings = [word for option, value in pairs if option == "--set" for word in (option, value)]
        if not settings or not arguments[1].endswith(".yaml"):
            return None
        status, said = self.run(["scene", arguments[1], *settings, "--out", "settings.xml"])
        return None if status == 0 else said


def shortened(arguments, later):
    """The same command, of one second and one episode, without a film: films have tests of their
    own. `later` is the page's text from there on."""
    short, rest = [], [word for word in arguments if word not in ("--video", "--no-films")]
    while rest:
        word = rest.pop(0)
        short.append(word)
        if word == "--episodes":
            first = int(rest.pop(0).partition(":")[0])
            short.append(f"{first}:{first + 1}")
        elif word == "--episode":
            rest.pop(0)
            short.append("0")
    if arguments[0] in ("run", "campaign"):
        short += ["--set", "time_limit_s=1"]
    if arguments[0] == "campaign":
        short.append("--no-films")
        if "--episodes" not in short:
            short += ["--episodes", "0:1"]
        if folder_of(arguments) not in later:
            short += ["--time-limit", "0.01"]
    return short


def folder_of(arguments):
    """Where results go, as a later line would write it."""
    if "--out" in arguments:
        return arguments[arguments.index("--out") + 1]
    return "out/" + pathlib.Path(arguments[1]).stem


def launcher_commands(tree):
    """By the launcher's head: each of its own commands, and what it says may follow."""
    commands = {}
    for name, rest in re.findall(r"^#   \./floorproof ([a-z]+)(?: (.*))?$",
                                 (tree / "floorproof").read_text(encoding="utf-8"), re.M):
        commands.setdefault(name, []).append(re.split(r"\s{2,}", rest)[0])
    return commands


def refusal_of_launcher(tree, arguments):
    usage = " ".join(launcher_commands(tree)[arguments[0]])
    for word in arguments[1:]:
        if word.startswith("--") and word not in re.findall(r"--[a-z-]+", usage):
            return f"{word}: not in the launcher's head"
        if not word.startswith("--") and not re.search(r"[A-Z]", usage):
            return f"{word}: `{arguments[0]}` takes no argument"
    return None


def findings(program, tree, names, folder):
    """Of all pages, in their order; pages are looked at side by side."""
    pages = [Page(program, tree, name, folder / str(at) / "page") for at, name in enumerate(names)
             if (folder / str(at)).mkdir() is None]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return [line for lines in pool.map(lambda page: list(page.findings()), pages)
                for line in lines]


# Commands that are wrong, and a word of what must be said of each.
WRONG = {
    "floorproof rnu scenario.yaml": "unknown command",
    "floorproof run scenario.yaml --vidoe": "did you mean --video?",
    "./floorproof campaign scenario.yaml": "-n",
    "floorproof campaign scenario.yaml -n many": "-n",
    "floorproof run scenario.yaml --set plan.planer=spiral": "plan.planer",
    "floorproof rare scenario.yaml --set plan.planer=spiral": "plan.planer",
    "floorproof rare scenario.yaml --max-n few": "--max-n",
    "floorproof run models/scenarios/gone.yaml --video": "there is no models/scenarios/gone.yaml",
    "floorproof run 'scenario.yaml": "the shell refuses it",
    "floorproof run scenario.yaml \\\n    --vidoe": "did you mean --video?",
    "See `floorproof plan S --besides T`.": "did you mean --beside?",
    "./floorproof test --al": "--al: not in the launcher's head",
    "./floorproof setup now": "takes no argument",
}
RIGHT = """
    floorproof run scenario.yaml --set 'plan={planner: spiral}'   # a comment
    floorproof robot my_robot.xml --ladder [--jobs N]
    floorproof suite htetro --methods step,ramp
    ./floorproof test --all -R Spiral
"""


def self_test(program, tree, folder):
    """What is wrong is found, and what is right is not: else the rest says nothing."""
    small = folder / "tree"
    (small / "docs").mkdir(parents=True)
    for link in ("models", "floorproof"):
        (small / link).symlink_to(tree / link)
    wrong = []
    for text, wanted in {**WRONG, RIGHT: None}.items():
        (small / "README.md").write_text("\n" + text + "\n", encoding="utf-8")
        with tempfile.TemporaryDirectory(dir=folder) as scratch:
            found = findings(program, small, ["README.md"], pathlib.Path(scratch))
        if (found != [] if wanted is None else len(found) != 1 or wanted not in found[0]):
            wrong.append(f"self-test: {text}\n    wanted {wanted}, found {found}")
    return wrong


def main():
    program, tree = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        found = self_test(program, tree, folder)
        (folder / "pages").mkdir()
        names = page_names(tree)
        found += findings(program, tree, names, folder / "pages")
    print("\n".join(found) or f"the commands of {len(names)} pages are right")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
