"""What goes in and out of the mode manager and the energy model: what is seen of a walk, commands, answers, charge."""

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

from pdr_core.records_gait import Behaviour


class Mode(Enum):
    """What navigates, and what for; the values are those of pdr_msgs/NavigationMode."""

    INITIALISING = 0  # the filter navigates and calibrates the step length model
    SWINGS = 1  # the filter navigates, the sensor switches its gyro on for each swing
    DEAD_RECKONING = 2  # steps by the model, the gyro off
    EXAMINING = 3  # the gyro on for one whole step, which the filter measures and the model foretells
    STANDING = 4
    SUSPICION = 5  # a turn is suspected: the gyro on
    FAULT = 6  # the gyro cannot be switched: it stays on, the filter navigates


@dataclass(frozen=True)
class MeasuredStride:
    """A stride that the filter has measured, and what the step length model says of it."""

    start_ns: int
    stamp_ns: int
    filter_m: float
    model_m: float  # NaN: no model yet
    model_sd_m: float  # of the model's strides against the filter's (Zhou Table 3)


@dataclass(frozen=True)
class Walk:
    """What is seen of a walk at a stamp."""

    stamp_ns: int
    behaviour: Behaviour
    rest_tested: bool  # the first rest has told its gyro bias
    model_ready: bool  # the step length model is good for the behaviour that was walked last
    turn_suspected: bool
    strides: tuple[MeasuredStride, ...] = ()  # that became known since the last record
    reckoned: int = 0  # strides that dead reckoning has taken since then


class Sensed(NamedTuple):
    """What the samples themselves tell of the driver."""

    gyro: bool  # some of the last ones have rates
    magnetometer: bool
    rate_hz: float  # 0: not known


@dataclass(frozen=True)
class ModeCommand:
    """A mode, and what the driver has to do for it."""

    number: int  # 1, 2, 3 ...
    stamp_ns: int  # when it was decided
    mode: Mode
    why: str  # in plain words
    gyro: bool  # wanted on
    rate_hz: float  # wanted of the sensor; a slower one keeps its own
    not_before_ns: int  # the first sample at or after it is the first that it shall hold for
    on_motion: bool = False  # the sensor itself switches the gyro, off while the foot stands
    model_failed: bool = False  # the step length model of the strides walked last is to be learnt anew


class Outcome(Enum):
    """What became of a command."""

    ACKNOWLEDGED = "acknowledged"
    REFUSED = "refused"
    TIMED_OUT = "not answered in time"
    DIED = "lost: the driver is gone"


@dataclass(frozen=True)
class DriverAnswer:
    """What the driver says to a command; missing answers are no records: the manager notices."""

    number: int  # of the command
    stamp_ns: int  # when it became known
    outcome: Outcome
    effective_ns: int  # stamp of the first sample it holds for
    settling_s: float  # after that stamp until the rates can be trusted
    text: str = ""  # why not, in plain words


class RateAnswer(NamedTuple):
    """What the driver says of the rate of its samples."""

    rate_hz: float  # in force; 0: it has not taken the wish
    effective_ns: int
    text: str = ""  # why not, in plain words


@dataclass(frozen=True)
class PowerState:
    """The sensor from a stamp on: this gyro power and this rate, until the next record."""

    stamp_ns: int
    gyro_on: bool  # powered, whether or not its rates can be trusted already
    rate_hz: float


@dataclass(frozen=True)
class Charge:
    """What was drawn from the battery."""

    sensor_mah: float  # by the sensor
    node_mah: float  # by the sensor and by what sends its samples


@dataclass(frozen=True)
class Energy:
    """What a walk has cost, against the same walk with the gyro always on at the full rate."""

    part: str
    duration_s: float
    gyro_on_s: float
    switch_ons: int
    start_up_mah: float  # of the sensor's charge: what the gyro drew before its rates could be trusted
    drawn: Charge
    always_on: Charge

    @property
    def gyro_on_share(self) -> float:
        """Share of the time, 0 .. 1."""
        return share(self.gyro_on_s, self.duration_s)

    @property
    def sensor_mah_per_h(self) -> float:
        """Mean current of the sensor [mA]."""
        return share(self.drawn.sensor_mah * 3600.0, self.duration_s)

    @property
    def node_mah_per_h(self) -> float:
        """Mean current of the node [mA]."""
        return share(self.drawn.node_mah * 3600.0, self.duration_s)

    @property
    def sensor_saved_share(self) -> float:
        """Share of the sensor's charge that is saved, 0 .. 1."""
        return share(self.always_on.sensor_mah - self.drawn.sensor_mah, self.always_on.sensor_mah)

    @property
    def node_saved_share(self) -> float:
        """Share of the node's charge that is saved, 0 .. 1."""
        return share(self.always_on.node_mah - self.drawn.node_mah, self.always_on.node_mah)


@dataclass(frozen=True)
class ModeReport:
    """What the mode manager says: the newest command, what became of it, and what all has cost."""

    stamp_ns: int  # the newest that was heard of the walk
    command: ModeCommand | None  # None: nothing was decided yet
    answer: DriverAnswer | None  # None: not yet
    gyro_powered: bool
    rate_hz: float  # 0: not known
    energy: Energy


def share(part: float, whole: float) -> float:
    """Return part / whole; 0 of nothing."""
    return part / whole if whole > 0.0 else 0.0
