"""The machinery behind `params.py`: one dataclass field is a parameter's default, unit, bounds, text and source.

YAML files, ROS declarations and the tables of the documentation are made from it, so none of them can drift.
"""

import dataclasses
import re
from collections.abc import Iterable, Mapping
from contextlib import suppress
from difflib import get_close_matches
from typing import Any, TypeVar

T = TypeVar("T")
YAML_TEXT = re.compile(r"[-+]?[0-9]+[eE][-+]?[0-9]+")  # a number that YAML 1.1 takes for a text: it has no dot
ROS_OWN = ("use_sim_time", "start_type_description_service", "qos_overrides")  # every node has them, offline nobody
Number = float | int
Groups = dict[str, dict[str, Any]]  # {group: {name: value}}, not checked


class ParameterError(ValueError):
    """A parameter is unknown or its value is not allowed; the text names it, its value and its bounds."""


@dataclasses.dataclass(frozen=True)
class Meta:
    """What is known of a parameter beside its default."""

    unit: str
    bounds: tuple[Number, Number] | None
    choices: tuple[str, ...]
    doc: str
    source: str

    @property
    def allowed(self) -> str:
        """The allowed values in words."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        if self.bounds:
            return f"within {self.bounds[0]:g} .. {self.bounds[1]:g}" + (f" {self.unit}" if self.unit else "")
        return "any"


def parameter(
    default: Any,
    doc: str,
    *,
    unit: str = "",
    bounds: tuple[Number, Number] | None = None,
    choices: tuple[str, ...] = (),
    source: str = "",
) -> Any:
    """Declare one parameter as a dataclass field."""
    return dataclasses.field(default=default, metadata={"meta": Meta(unit, bounds, choices, doc, source)})


def meta(field: dataclasses.Field) -> Meta:
    """Return what was declared for a field."""
    return field.metadata["meta"]


def choices_of(group: type, name: str) -> tuple[str, ...]:
    """Return what a parameter of a group picks from."""
    return next(meta(field).choices for field in dataclasses.fields(group) if field.name == name)


def checked(name: str, field: dataclasses.Field, value: Any) -> Any:
    """Return the value as the field's type; an integer where a float is meant is accepted, and 1e-5 without a dot."""
    wanted = type(field.default)
    if wanted is float and (type(value) is int or (isinstance(value, str) and YAML_TEXT.fullmatch(value))):
        with suppress(OverflowError):
            value = float(value)
    known = meta(field)
    good = isinstance(value, wanted) and (wanted is bool or not isinstance(value, bool))
    if good and known.bounds:
        good = known.bounds[0] <= value <= known.bounds[1]  # NaN fails too
    if good and known.choices:
        good = value in known.choices
    if not good:
        allowed = "true or false" if wanted is bool else known.allowed
        raise ParameterError(f"{name} = {value!r}: must be {wanted.__name__}, {allowed}")
    return value


def unknown(prefix: str, name: str, what: str, known: Iterable[str]) -> ParameterError:
    """Return the error that a name is none of the known ones, which says the nearest of them if one is near."""
    names = list(known)
    near = "".join(f", did you mean {match}?" for match in get_close_matches(name, names, 1)) or ";"
    return ParameterError(f"{prefix}{name}: unknown {what}{near} known are {', '.join(names)}")


def grouped(parameters: dict[str, Any]) -> Groups:
    """Return parameters told as {group: {name: value}} or {group.name: value}, without those of ROS itself."""
    groups: Groups = {}
    for name, value in parameters.items():
        group, dot, rest = str(name).partition(".")
        if group in ROS_OWN:
            continue
        if not dot and not isinstance(value, dict):
            raise ParameterError(f"{name} = {value!r}: parameters are group.name, see `pdr params`")
        groups.setdefault(group, {}).update({rest: value} if dot else value)
    return groups


def from_mapping(cls: type[T], mapping: Mapping[str, Any], prefix: str = "") -> T:
    """Build a parameter class from {name: value}; missing names keep their default, unknown ones are an error."""
    fields = {f.name: f for f in dataclasses.fields(cls)}  # type: ignore[arg-type]
    for name in mapping:
        if name not in fields:
            raise unknown(prefix, name, "parameter", fields)
    return cls(**{n: checked(prefix + n, fields[n], v) for n, v in mapping.items()})


def yaml_lines(cls: type, indent: str) -> list[str]:
    """Return the parameters of a class as YAML with their text, unit and bounds as comments."""
    lines = []
    for field in dataclasses.fields(cls):
        known = meta(field)
        lines.append(f"{indent}# {known.doc} ({known.allowed})")
        lines.append(f"{indent}{field.name}: {yaml_value(field.default)}")
    return lines


def yaml_value(value: Any) -> str:
    """Return a value as YAML 1.1 reads it: 1e-05 would be a string, 1.0e-05 is a number."""
    if isinstance(value, bool):
        return str(value).lower()
    text = repr(value)
    return text.replace("e", ".0e") if isinstance(value, float) and "e" in text and "." not in text else text


def markdown_rows(cls: type) -> list[str]:
    """Return one table row per parameter: name, default, unit, allowed values, text, source."""
    rows = []
    for field in dataclasses.fields(cls):
        known = meta(field)
        cells = (f"`{field.name}`", f"`{field.default}`", known.unit, known.allowed, known.doc, known.source)
        rows.append("| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |")
    return rows
