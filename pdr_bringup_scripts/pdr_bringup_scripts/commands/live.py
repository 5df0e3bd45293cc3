"""`pdr live`: estimates what a driver publishes now."""

from pathlib import Path

import typer

from pdr_bringup_scripts.options import finite

DRIVERS = "a driver of ours to start for that topic: simulated, or replayed, with driver.recording set by --params"


def live(
    imu: str = typer.Option(
        "", help="topic of one sensor: sensor_msgs/Imu, raw, 100 Hz or more; default: /imu/data_raw"
    ),
    mag: str = typer.Option("", help="topic of its magnetometer: sensor_msgs/MagneticField, paired with it by stamp"),
    left: str = typer.Option("", help="topic of the sensor on the left foot, where each foot has one"),
    right: str = typer.Option("", help="topic of the sensor on the right foot"),
    left_mag: str = typer.Option("", help="topic of the left foot's magnetometer"),
    right_mag: str = typer.Option("", help="topic of the right foot's magnetometer"),
    pipeline: str = typer.Option("foot", help="where one sensor is: foot, or chest, a card that is worn there"),
    driver: str = typer.Option("none", help=DRIVERS),
    out: Path = typer.Option(None, "--out", "-o", help="folder for recording, trajectory, result and report"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
    duration: float = typer.Option(
        None, min=0.1, callback=finite, help="end after this time from the first sample on [s]; default: Ctrl-C"
    ),
    namespace: str = typer.Option("pdr", help="where our topics are: /pdr/odom, /pdr/step ..."),
) -> None:
    """Estimate the walk that a driver is publishing now, on your ROS graph, until Ctrl-C; any delivery will do.

    Example: `pdr live --imu /foot/imu`, or `pdr live --left /left/imu --right /right/imu`, or
    `pdr live --imu /chest/imu --pipeline chest`: stand still for three seconds, walk, and press Ctrl-C
    """
    from pdr_bringup_scripts.live.chain import checked_namespace
    from pdr_bringup_scripts.live.live_options import LiveOptions
    from pdr_bringup_scripts.live.live_sensor import LiveJob, run_on_driver
    from pdr_bringup_scripts.run.run_folder import new_run_folder, show_result
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.params import Params
    from pdr_core.params_file import load_params

    options = LiveOptions(imu, mag, left, right, left_mag, right_mag, driver, pipeline)
    home = checked_namespace(namespace)
    topics = options.topics(home)
    cast = options.cast(load_params(params) if params else Params(), topics)
    job = LiveJob(topics, options.own_driver, home, duration)
    folder = out or new_run_folder("live")
    show_result(run_on_driver(cast, job, folder, Terminal()), folder)
