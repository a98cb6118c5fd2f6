# SPDX-License-Identifier: Apache-2.0
"""The JSON Schemas that the program prints, as a validator of others reads them."""
from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml

import floorproof

MODELS = Path(__file__).resolve().parents[2] / "models"
VARIANTS_ALONE = ("safety_detection", "safety_study")  # what they draw, their variants hold


class Yaml12(yaml.SafeLoader):
    """PyYAML reads YAML 1.1, in which 1e3 is a text and `no` a boolean."""


Yaml12.yaml_implicit_resolvers = {}
for tag, pattern in (("null", r"~|null|Null|NULL|"), ("bool", r"true|True|false|False"),
                     ("int", r"[-+]?[0-9]+"),
                     ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")):
    Yaml12.add_implicit_resolver(f"tag:yaml.org,2002:{tag}", re.compile(f"^(?:{pattern})$"), None)


def of_yaml(text: str) -> Any:
    return yaml.load(text, Yaml12)


@pytest.fixture(scope="module", name="validator")
def _validator(command_line):
    def made(kind: str) -> jsonschema.Draft7Validator:
        printed = subprocess.run([command_line, "schema", kind], capture_output=True, text=True,
                                 check=True)
        assert printed.stderr == ""
        return jsonschema.Draft7Validator(json.loads(printed.stdout))
    return {kind: made(kind) for kind in ("site", "scenario")}


def test_both_are_schemas_of_the_draft_that_they_name(validator):
    for one in validator.values():
        assert one.schema["$schema"] == "http://json-schema.org/draft-07/schema#"
        jsonschema.Draft7Validator.check_schema(one.schema)


@pytest.mark.parametrize("kind, file", [
    (kind, file) for kind in ("site", "scenario")
    for file in sorted((MODELS / f"{kind}s").glob("*.yaml"))], ids=lambda part: Path(part).stem)
def test_what_comes_with_the_program_is_valid(validator, kind, file):
    validator[kind].validate(of_yaml(file.read_text(encoding="utf-8")))


@pytest.mark.parametrize("file", [
    file for file in sorted((MODELS / "scenarios").glob("*.yaml"))
    if file.stem not in VARIANTS_ALONE], ids=lambda file: file.stem)
def test_so_is_every_key_with_its_default(validator, file):
    scenario = of_yaml(floorproof.load(file).resolved(file.parent))
    validator["scenario"].validate(scenario)
    validator["site"].validate(scenario["site"])


@pytest.mark.parametrize("wrong", [
    {"robott": "beluga"},
    {"robot": "beluuga"},
    {"plan": {"planner": "spiral", "overlapp": 0.1}},
    {"plan": {"overlap": 2}},
    {"faults": [{"type": "weak_motor", "height_m": 1}]},
    {"randomise": {"seed": {"uniform": [1, 2]}}},
    {"matrix": {"robot": "beluga"}},
    {"control_hz": "fast"},
    {"site": 7.5, "start": {"x": 1}},
    {"start": {"x_m": "left"}},
    {"gate": {"metric": "stack"}},
])
def test_what_is_wrong_is_wrong_for_both(validator, room, wrong):
    validator["scenario"].validate(room)
    assert not validator["scenario"].is_valid({**room, **wrong})
    if "gate" not in wrong:  # which campaigns read
        with pytest.raises(floorproof.InputError):
            floorproof.load({**room, **wrong})
