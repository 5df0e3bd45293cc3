"""Which options of `pdr run` go together, and which pipeline they choose."""

from dataclasses import fields
from inspect import signature
from itertools import combinations, product

import pytest

from pdr_bringup_scripts.commands.run import run as command
from pdr_bringup_scripts.problems import Problem
from pdr_bringup_scripts.run.external_run import run_external
from pdr_bringup_scripts.run.known_points import KnownPoint
from pdr_bringup_scripts.run.offline import run_adaptive, run_chest, run_foot, run_smoothed
from pdr_bringup_scripts.run.run_choice import pipeline_of_one
from pdr_bringup_scripts.run.run_options import RULES, RunOptions
from pdr_core.params import Params

TYPED = {
    "--sensor": {"sensor": "imu"},
    "--feet": {"feet": "left,right"},
    "--detector": {"detector": "glrt"},
    "--time-gate": {"time_gate": "kmeans"},
    "--level-ground": {"level_ground": True},
    "--smooth": {"smooth": True},
    "--time-gate kmeans_offline": {"time_gate": "kmeans_offline"},
    "--pipeline chest": {"pipeline": "chest"},
    "--adaptive": {"adaptive": True},
    "--external": {"external": "/robot/pose"},
    "--at": {"at": (KnownPoint(2.0, 0.0, 0.0),)},
}
WHOLE = ("--smooth", "--time-gate kmeans_offline")
PAIRS = [(rule.option, other) for rule in RULES for other in rule.without]


@pytest.mark.parametrize(("option", "other"), PAIRS)
def test_what_does_not_go_together_is_named_and_nothing_else(option: str, other: str) -> None:
    with pytest.raises(Problem, match=f"^{option} .*: leave out {other}$"):
        RunOptions(**TYPED[option], **TYPED[other])


def test_a_walk_is_estimated_in_one_way_and_all_else_goes_together() -> None:
    ways = ("--external", "--pipeline chest", "--feet", "--adaptive")
    refused = {*combinations(ways, 2), *product(ways, WHOLE), ("--feet", "--sensor")} - {("--external", "--feet")}
    refused |= {("--at", other) for other in ("--external", "--pipeline chest", "--adaptive", *WHOLE)}
    refused |= set(product(["--pipeline chest"], ["--detector", "--time-gate", "--level-ground"]))
    assert set(PAIRS) == refused
    for one, other in combinations(TYPED, 2):
        if not {(one, other), (other, one)} & refused:
            RunOptions(**TYPED[one] | TYPED[other])


@pytest.mark.parametrize("wrong", [{"pipeline": "knee"}, {"time_gate": "shoe"}])
def test_an_unknown_name_is_answered_with_the_known_ones(wrong: dict[str, str]) -> None:
    with pytest.raises(Problem, match="choose from"):
        RunOptions(**wrong)


def test_to_aid_somebody_else_is_needed() -> None:
    with pytest.raises(Problem, match="--aid says what --external is for"):
        RunOptions(aid=True)


@pytest.mark.parametrize(
    ("option", "run"),
    [
        ("--sensor", run_foot),
        ("--time-gate kmeans_offline", run_foot),
        ("--smooth", run_smoothed),
        ("--adaptive", run_adaptive),
        ("--pipeline chest", run_chest),
        ("--external", run_external),
    ],
)
def test_an_option_chooses_the_pipeline(option: str, run: object) -> None:
    assert pipeline_of_one(RunOptions(**TYPED[option])) is run


ONE_ALONE = ("--sensor", "--pipeline chest", "--adaptive", *WHOLE)


@pytest.mark.parametrize("option", TYPED)
def test_feet_walk_together_only_where_nothing_is_asked_of_one(option: str) -> None:
    assert RunOptions(**TYPED[option]).each_alone is (option in ONE_ALONE)
    assert not RunOptions().each_alone


def test_options_change_parameters() -> None:
    options = RunOptions(detector="glrt", time_gate="kmeans_offline", level_ground=True, heading="hde")
    changed = options.applied_to(Params())
    assert (changed.stance.detector, changed.stance.time_gate) == ("glrt", "kmeans")
    assert (changed.filter.level_ground, changed.heading.constraint) == (True, "hde")
    assert RunOptions(external="/robot/pose", aid=True).applied_to(Params()).external.mode == "aid"
    assert RunOptions().applied_to(Params()) == Params()


def test_every_option_of_the_record_is_one_of_the_command() -> None:
    assert {field.name for field in fields(RunOptions)} <= set(signature(command).parameters)
