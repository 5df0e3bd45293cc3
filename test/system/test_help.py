"""The help of a command names everything that its options choose among."""

import re
from inspect import signature

import pytest

from pdr_bringup_scripts.commands.compare import compare
from pdr_bringup_scripts.commands.run import run
from pdr_bringup_scripts.commands.simulate import simulate
from pdr_bringup_scripts.run.run_options import PLACES
from pdr_core.bench.heading_ablation import CONSTRAINTS
from pdr_core.bench.orientations import ORIENTATIONS
from pdr_core.parameter import choices_of
from pdr_core.params import HeadingParams, SimulationParams
from pdr_core.pipeline.stance_phases import TIME_GATES

CHOICES = [
    (simulate, "walk", choices_of(SimulationParams, "walk")),
    (simulate, "motion", choices_of(SimulationParams, "motion")),
    (simulate, "sensor", choices_of(SimulationParams, "sensor_model")),
    (run, "heading", choices_of(HeadingParams, "constraint")),
    (run, "time_gate", TIME_GATES),
    (run, "pipeline", PLACES),
    (compare, "time_gates", TIME_GATES),
    (compare, "headings", CONSTRAINTS),
    (compare, "orientations", ORIENTATIONS),
]


@pytest.mark.parametrize(("command", "option", "choices"), CHOICES)
def test_it_names_every_choice(command, option, choices):
    words = re.findall(r"\w+", signature(command).parameters[option].default.help)
    assert choices
    assert [choice for choice in choices if choice not in words] == []
