import dataclasses
import re

import pytest
import yaml

from pdr_core.parameter import ParameterError, meta
from pdr_core.params import GROUPS, Params, changed, params_as_mapping, params_from_mapping
from pdr_core.params_file import default_file, load_params, markdown

FIELDS = [(group, field) for group, cls in GROUPS.items() for field in dataclasses.fields(cls)]
NAMES = [f"{group}.{field.name}" for group, field in FIELDS]
HEAD = "/**:\n  ros__parameters:\n"


def written(tmp_path, text):
    path = tmp_path / "params.yaml"
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    ("mapping", "text"),
    [
        ({"filtre": {}}, "filtre: unknown group of parameters, did you mean filter? known are intake"),
        ({"filter": {"gaet": 1.0}}, "filter.gaet: unknown parameter, did you mean gate? known are samples"),
        ({"filter": {"zzz": 1.0}}, "filter.zzz: unknown parameter; known are samples"),
        ({"filter": 3}, "filter = 3: must be a mapping"),
        ({"filter": {"gate": 0.5}}, "filter.gate = 0.5: must be float, within 1 .. 1e+09"),
        ({"filter": {"gate": float("nan")}}, "filter.gate = nan"),
        ({"filter": {"gate": float("inf")}}, "filter.gate = inf"),
        ({"filter": {"gate": "16"}}, "filter.gate = '16': must be float"),
        ({"filter": {"gate": True}}, "filter.gate = True: must be float"),
        ({"simulation": {"seed": 1.0}}, "simulation.seed = 1.0: must be int"),
        ({"simulation": {"seed": True}}, "simulation.seed = True: must be int"),
        ({"node": {"publish_tf": 1}}, "node.publish_tf = 1: must be bool, true or false"),
        ({"intake": {"accel_unit": "mg"}}, "intake.accel_unit = 'mg': must be str, one of m/s^2, g"),
        ({"driver": {"recording": 7}}, "driver.recording = 7: must be str, any"),
    ],
)
def test_what_is_not_allowed_is_named(mapping, text):
    with pytest.raises(ParameterError, match=r".*") as error:
        params_from_mapping(mapping)
    assert text in str(error.value)
    assert "\n" not in str(error.value)


def test_a_number_that_yaml_takes_for_a_text_is_a_number():
    assert params_from_mapping({"filter": {"gyro_bias_walk": "1e-5"}}).filter.gyro_bias_walk == 1e-5


def test_an_integer_stands_for_a_float():
    gate = params_from_mapping({"filter": {"gate": 20}}).filter.gate
    assert (gate, type(gate)) == (20.0, float)


@pytest.mark.parametrize(("group", "field"), FIELDS, ids=NAMES)
def test_every_default_is_allowed_and_every_bound_holds(group, field):
    known = meta(field)
    assert changed(Params(), group, **{field.name: field.default}) == Params()
    assert known.doc
    if known.bounds:
        for bound, beyond in zip(known.bounds, (-1, 1), strict=True):
            changed(Params(), group, **{field.name: type(field.default)(bound)})
            with pytest.raises(ParameterError, match=f"{group}.{field.name}"):
                changed(Params(), group, **{field.name: type(field.default)(bound + beyond * max(1, abs(bound)))})


def test_every_float_has_bounds():
    assert all(meta(field).bounds for _, field in FIELDS if isinstance(field.default, float))


def test_the_default_file_gives_the_defaults(tmp_path):
    assert load_params(written(tmp_path, default_file())) == Params()
    read = yaml.safe_load(default_file())["/**"]["ros__parameters"]
    assert read == params_as_mapping(Params())
    assert {type(v) for group in read.values() for v in group.values()} <= {float, int, str, bool}


def test_a_file_changes_what_it_names(tmp_path):
    params = load_params(written(tmp_path, HEAD + "    filter:\n      gate: 25.0\n"))
    assert params == changed(Params(), "filter", gate=25.0)


@pytest.mark.parametrize(
    "text",
    [
        HEAD + "    use_sim_time: true\n    filter: {gate: 25.0}\n",
        HEAD + "    filter.gate: 25.0\n    qos_overrides: {/parameter_events: {publisher: {depth: 1000}}}\n",
        "/left/zupt_ekf:\n  ros__parameters:\n    filter: {gate: 25.0}\n    start_type_description_service: true\n",
        HEAD + "    filter: {gate: 25.0}\ncontroller_server: {ros__parameters: {rate: 20.0}}\n",
    ],
    ids=["with ROS's own", "dotted", "as dumped", "beside other nodes"],
)
def test_a_file_that_nodes_take_is_taken_offline(tmp_path, text):
    assert load_params(written(tmp_path, text)) == changed(Params(), "filter", gate=25.0)


def test_values_survive_the_way_through_a_mapping():
    other = changed(changed(Params(), "filter", gate=25.0), "node", foot_frame="left")
    assert params_from_mapping(params_as_mapping(other)) == other


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "must hold groups of parameters below '/\\*\\*: ros__parameters:'"),
        ("filter:\n  gate: 20.0\n", "must hold groups of parameters below '/\\*\\*: ros__parameters:'"),
        ("/**: [1]\n", "must hold groups of parameters below '/\\*\\*: ros__parameters:'"),
        ("/**: {ros__parameters: {filter: {gate: [}}}", "cannot be read as YAML"),
        (HEAD + "    filter:\n", "filter = None: parameters are group.name"),
        ("one: {ros__parameters: {}}\ntwo: {ros__parameters: {}}\n", "must hold groups"),
        (HEAD + "    filter:\n      gate: much\n", "filter.gate = 'much'"),
    ],
)
def test_a_bad_file_is_told_in_one_sentence(tmp_path, text, reason):
    with pytest.raises(ParameterError, match=reason) as error:
        load_params(written(tmp_path, text))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("text", [HEAD, HEAD + "    [1, 2]\n"])
def test_a_file_without_parameters_is_told_in_one_sentence(tmp_path, text):
    with pytest.raises(ParameterError):
        load_params(written(tmp_path, text))


def test_an_integer_too_large_for_a_float_is_told_in_one_sentence():
    with pytest.raises(ParameterError):
        params_from_mapping({"filter": {"gate": 10**400}})


def test_a_missing_file_and_a_file_of_bytes_are_told_in_one_sentence(tmp_path):
    (tmp_path / "bytes.yaml").write_bytes(b"\xff\xfe\x00")
    for name, reason in (("none.yaml", "does not exist: check the path"), ("bytes.yaml", "cannot be read")):
        with pytest.raises(ParameterError, match=reason):
            load_params(tmp_path / name)


def test_the_documentation_names_every_parameter():
    text = markdown()
    assert all(f"| `{field.name}` | `{field.default}` |" in text for _, field in FIELDS)


def test_no_cell_of_the_documentation_breaks_its_row():
    rows = [line for line in markdown().splitlines() if line.startswith("| `")]
    assert len(rows) == len(list(FIELDS))
    assert [row for row in rows if len(re.findall(r"(?<!\\)\|", row)) != 7] == []
