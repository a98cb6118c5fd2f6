# SPDX-License-Identifier: Apache-2.0
"""Campaigns from Python are the command line's."""
from __future__ import annotations

import csv
import subprocess
import sys

import pytest

import floorproof


def test_the_same_bytes_as_the_command_line(drawing, command_line, tmp_path, monkeypatch):
    for where in ("python", "shell"):  # files name the campaign's folder as it was named
        (tmp_path / where).mkdir()
    monkeypatch.chdir(tmp_path / "python")
    campaign = floorproof.campaign(drawing, 12, out="c", jobs=2)
    assert campaign.end == "all episodes are done"
    assert campaign.variants["default"]["n"] == 12
    subprocess.run([command_line, "campaign", drawing.file, "-n", "12", "--jobs", "1", "--no-films",
                    "--out", "c"], cwd=tmp_path / "shell", check=True, capture_output=True)
    for name in ("summary.json", "episodes.csv", "junit.xml", "failing_episodes.csv",
                 "dependence.csv"):
        there = tmp_path / "shell" / "c" / name
        assert (tmp_path / "python" / "c" / name).read_bytes() == there.read_bytes(), name
    assert 0 < campaign.variants["default"]["failures"]["any_failure"]["k"] < 12


def test_shards_are_merged(drawing, tmp_path):
    whole = floorproof.campaign(drawing, 4, out=tmp_path / "whole")
    for a, b in ((0, 2), (2, 4)):
        floorproof.campaign(drawing, 4, episodes=(a, b), out=tmp_path / f"{a}")
    merged = floorproof.merge([tmp_path / "0", tmp_path / "2"], tmp_path / "merged")
    assert merged.summary == whole.summary
    assert ((tmp_path / "merged" / "episodes.csv").read_bytes()
            == (tmp_path / "whole" / "episodes.csv").read_bytes())


def test_a_campaign_goes_on(drawing, tmp_path):
    floorproof.campaign(drawing, 2, out=tmp_path / "c")
    with pytest.raises(floorproof.InputError, match="holds a campaign"):
        floorproof.campaign(drawing, 3, out=tmp_path / "c")
    assert floorproof.campaign(drawing, 3, out=tmp_path / "c",
                               resume=True).variants["default"]["n"] == 3
    page = floorproof.report(tmp_path / "c")
    assert "<html" in page.read_text(encoding="utf-8")[:2000]


def test_a_planner_in_python_drives_in_workers(drawing, tmp_path):
    @floorproof.planner("campaigned", uses_seed=True)
    def campaigned(request):
        if request.seed % 2:
            raise RuntimeError("odd")
        x, y, _ = request.start
        return [[x, y], [x + 0.3, y]]

    campaign = floorproof.campaign(drawing.with_(plan="campaigned"), 6, out=tmp_path / "c", jobs=2)
    default = campaign.variants["default"]
    assert default["n"] + default["n_error"] == 6 and default["n_error"] > 0 < default["n"]
    rows = (tmp_path / "c" / "episodes.csv").read_text(encoding="utf-8")
    assert "planner campaigned raised RuntimeError: odd (test_campaign.py:" in rows


@pytest.mark.parametrize("end", [SystemExit(3), KeyboardInterrupt()], ids=["exit", "interrupt"])
def test_a_planner_that_ends_its_worker_is_an_error(drawing, tmp_path, end):
    @floorproof.planner("ending")
    def ending(_):
        raise end

    floorproof.campaign(drawing.with_(plan="ending"), 2, out=tmp_path / "c", jobs=1)
    rows = (tmp_path / "c" / "episodes.csv").read_text(encoding="utf-8")
    assert rows.count(f"planner ending raised {type(end).__name__}") == 2


def test_what_a_planner_has_open_stays_open_in_workers(drawing, tmp_path):
    log = open(tmp_path / "log", "a", encoding="utf-8")

    @floorproof.planner("logging", uses_seed=True)
    def logging(request):
        log.write("asked\n")
        log.flush()
        return "is only asked"

    with log:
        floorproof.campaign(drawing.with_({"drive": "none", "success": None}, plan="logging"), 4,
                            out=tmp_path / "c", jobs=2)
    assert (tmp_path / "log").read_text(encoding="utf-8") == 4 * "asked\n"
    assert "Bad file descriptor" not in (tmp_path / "c" / "episodes.csv").read_text(encoding="utf-8")


HANGS = """
import itertools, sys, time
import floorproof
from floorproof import _watchdog

_watchdog._MARGIN_S = 0.1

def deaf():
    while True:
        try:
            time.sleep(1)
        except BaseException:
            pass

HOW = {"sleep": lambda: time.sleep(1000), "deaf": deaf, "in C": lambda: sum(itertools.repeat(0))}
how, file, out = sys.argv[1:]

@floorproof.planner("hangs", uses_seed=True, timeout_s=0.2)
def hangs(request):
    if request.seed % 2:
        HOW[how]()
    return "is only asked"

scenario = floorproof.load(file, {"drive": "none", "success": None}, plan="hangs")
floorproof.campaign(scenario, 6, out=out, jobs=2)
"""


def test_a_planner_that_hangs_is_an_error_and_the_rest_goes_on(drawing, tmp_path):
    # Whether it could be ended in Python, or with its worker alone, the files are the same.
    tables = {}
    for how in ("sleep", "deaf", "in C"):
        out = tmp_path / how
        subprocess.run([sys.executable, "-c", HANGS, how, drawing.file, out], check=True, timeout=30)
        tables[how] = (out / "episodes.csv").read_bytes()
    with open(tmp_path / "sleep" / "episodes.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    hung = [row["message"] for row in rows if row["outcome"] == "error"]
    assert len(rows) == 6 and 0 < len(hung) < 6
    assert set(hung) == {"planner hangs raised TimeoutError: took more than 0.2 s (timeout_s)"}
    assert tables["sleep"] == tables["deaf"] == tables["in C"]


@pytest.mark.parametrize("options, says", [
    ({"n": 0}, "n = 0: must be at least 1"),
    ({"n": 2, "engine": "slurm"}, "engine = slurm: unknown"),
    ({"n": 2.0}, "n = 2.0: must be a whole number"),
    ({"n": "2"}, "n = '2': must be a whole number"),
    ({"n": 2, "jobs": 1.5}, "jobs = 1.5: must be a whole number"),
    ({"n": 2, "jobs": "all"}, "jobs = 'all': must be a whole number"),
    ({"n": 10**20}, "n = 1000.*: must be a whole number, at most 92"),
    ({"n": 2, "jobs": 10**10}, "jobs = 10000000000: must be a whole number, at most 2147483647"),
    ({"n": 2, "episodes": (-1, 2)}, r"episodes\[0\] = -1: must be at least 0"),
    ({"n": 2, "jobs": True}, "jobs = True: must be a whole number"),
    ({"n": 2, "jobs": 0}, "jobs: 0: must be"),
    ({"n": 2, "time_limit_s": "5"}, "time_limit_s = '5': must be a number"),
    ({"n": 2, "episodes": (0,)}, r"episodes = \(0,\): must be \(a, b\)"),
    ({"n": 2, "episodes": 1}, r"episodes = 1: must be \(a, b\)"),
    ({"n": 2, "episodes": (0, "1")}, r"episodes\[1\] = '1': must be a whole number"),
    ({"n": 2, "episodes": (2, 1)}, "holds no episode"),
    ({"n": 2, "episodes": (0, 9)}, "must lie within -n"),
    ({"n": 2, "address": "auto"}, "address: is no option of engine local"),
])
def test_what_is_no_campaign(drawing, tmp_path, options, says):
    with pytest.raises(floorproof.InputError, match=says):
        floorproof.campaign(drawing, out=tmp_path / "c", **options)


def test_a_folder_without_a_campaign(tmp_path):
    with pytest.raises(floorproof.InputError, match="summary.json"):
        floorproof.Campaign(tmp_path)
    with pytest.raises(floorproof.InputError):
        floorproof.report(tmp_path)


@pytest.mark.parametrize("text, says", [
    ("{}", "summary.json: is not what `floorproof campaign` writes: variants: is missing"),
    ("[]", "must be an object"),
    ('{"variants": []}', "variants = .*: must be an object"),
    ('{"variants": {"wet": 3}}', "variants.wet: must be an object"),
    ('{"variants": {"wet": {"n": "3", "failures": {}}}}', "variants.wet: n = 3: must be a whole n"),
    ("{\n\n", "summary.json:3: "),
])
def test_a_damaged_summary_says_so(tmp_path, text, says):
    (tmp_path / "summary.json").write_text(text, encoding="utf-8")
    with pytest.raises(floorproof.InputError, match=says):
        floorproof.Campaign(tmp_path)
