"""Parameters of the mode manager and of the energy model."""

from dataclasses import dataclass

from pdr_core.parameter import parameter


@dataclass(frozen=True)
class PowerParams:
    """When the gyro is on, and what it costs (Zhou section 4)."""

    calibration_m: float = parameter(
        50.0,
        "L0: so far the filter walks with a behaviour before dead reckoning takes over",
        unit="m",
        bounds=(5.0, 1e4),
        source="Zhou Table 2 gives no figure; the 40 strides of its section 5",
    )
    examine_every_s: float = parameter(
        60.0,
        "T0: the step length model is examined so often",
        unit="s",
        bounds=(2.0, 1e4),
        source="Zhou Table 1 gives no figure; an examination takes 3 s: 5 % of the time",
    )
    examine_sd: float = parameter(
        3.0, "a stride fits within so many deviations of the model", bounds=(0.5, 20.0), source="Zhou Table 3"
    )
    settle_s: float = parameter(
        0.05,
        "the gyro's rates count so long after it was switched on, or longer where the driver says so",
        unit="s",
        bounds=(0.0, 10.0),
        source="35 ms by the data sheets of common parts, and three samples at 200 Hz",
    )
    stand_s: float = parameter(
        1.0, "the gyro goes off once the foot has stood for so long", unit="s", bounds=(0.1, 600.0)
    )
    swing_s: float = parameter(
        2.0,
        "a foot that moves for longer without a stride of a walk wakes the gyro",
        unit="s",
        bounds=(0.0, 600.0),
        source="the first stride of a walk takes less",
    )
    calm_strides: int = parameter(
        2, "a suspected turn is over after so many strides without one", bounds=(1, 100), source="hysteresis"
    )
    filter_rate_hz: float = parameter(
        1000.0,
        "rate that is wanted of the sensor while the filter navigates; a slower one keeps its own",
        unit="Hz",
        bounds=(20.0, 4000.0),
    )
    reckoning_rate_hz: float = parameter(
        50.0,
        "rate that is wanted while the gyro is off",
        unit="Hz",
        bounds=(10.0, 4000.0),
        source="Zhou section 4.3; its Table 5 shows no loss down to 20 Hz",
    )
    duty: str = parameter(
        "none",
        "where the gyro is on once the gait is calibrated: where a turn is suspected; for some strides of many; "
        "or in every swing, switched by the sensor itself, and the filter navigates on",
        choices=("none", "strides", "swing"),
    )
    duty_on_strides: int = parameter(1, "the gyro is on for so many strides ...", bounds=(1, 1000))
    duty_of_strides: int = parameter(4, "... of so many", bounds=(1, 1000))
    wake_mps2: float = parameter(
        4.0,
        "swing: the gyro goes on where the specific force changes by so much in 40 ms",
        unit="m/s^2",
        bounds=(0.5, 50.0),
        source="a heel that leaves the floor; docs/energy.md",
    )
    quiet_mps2: float = parameter(
        2.0, "swing: a foot whose specific force changes by less in 40 ms stands", unit="m/s^2", bounds=(0.1, 50.0)
    )
    strike_mps2: float = parameter(
        20.0,
        "swing: a change by so much in 10 ms is the heel that strikes",
        unit="m/s^2",
        bounds=(1.0, 500.0),
        source="docs/energy.md",
    )
    strike_on_s: float = parameter(
        0.03, "swing: the gyro stays on for so long after the heel has struck", unit="s", bounds=(0.0, 1.0)
    )
    swing_least_s: float = parameter(
        0.45,
        "swing: the gyro stays on at least so long, for the toe that pushes off is as hard as a heel",
        unit="s",
        bounds=(0.05, 5.0),
    )
    answer_timeout_s: float = parameter(
        1.0, "a driver that has not answered for so long is at fault", unit="s", bounds=(0.05, 60.0)
    )
    retry_s: float = parameter(
        5.0, "a driver at fault is asked again to keep the gyro on so often", unit="s", bounds=(0.1, 600.0)
    )
    silent_s: float = parameter(
        2.0,
        "where nothing is heard of the walk for so long, by the wall clock, the driver is taken to be gone",
        unit="s",
        bounds=(0.2, 600.0),
    )
    part: str = parameter(
        "mpu9250",
        "the sensor whose charge is counted",
        choices=("mpu9250", "mpu6050", "lsm6dso", "bmi270", "l3gd20_lis3dh"),
        source="docs/energy.md",
    )
