"""`pdr live`: estimates what a driver publishes now."""

from pathlib import Path

import typer

from pdr_bringup_scripts.options import finite

DRIVERS = "a driver of ours to start for that topic: simulated, or replayed, with driver.recording set by --params"


def live(
    imu: str = typer.Option("/imu/data_raw", help="topic of the driver: sensor_msgs/Imu, raw, 100 Hz or more"),
    mag: str = typer.Option("", help="topic of its magnetometer: sensor_msgs/MagneticField, paired with it by stamp"),
    driver: str = typer.Option("none", help=DRIVERS),
    out: Path = typer.Option(None, "--out", "-o", help="folder for recording, trajectory, result and report"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
    duration: float = typer.Option(
        None, min=0.1, callback=finite, help="end after this time from the first sample on [s]; default: Ctrl-C"
    ),
    namespace: str = typer.Option("pdr", help="where our topics are: /pdr/odom, /pdr/step ..."),
) -> None:
    """Estimate the walk that a driver is publishing now, on your ROS graph, until Ctrl-C; any delivery will do.

    Example: `pdr live --imu /foot/imu`, stand still for three seconds, walk, and press Ctrl-C
    """
    from pdr_bringup_scripts.chain import checked_namespace
    from pdr_bringup_scripts.live_sensor import LiveJob, checked_topic, run_on_driver
    from pdr_bringup_scripts.problems import Problem
    from pdr_bringup_scripts.relay import DriverTopics
    from pdr_bringup_scripts.run_folder import new_run_folder, show_result
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.params import Params, changed
    from pdr_core.params_file import load_params

    chosen, own_driver = load_params(params) if params else Params(), driver != "none"
    if chosen.node.magnetometer and not mag:
        raise Problem("node.magnetometer is true: say by --mag on which topic the magnetometer is")
    if own_driver:
        chosen = changed(changed(chosen, "driver", device=driver), "simulation", magnetometer=bool(mag))
    if driver == "replayed" and not chosen.driver.recording:
        raise Problem("--driver replayed needs driver.recording in a file of --params, or use `pdr replay RECORDING`")
    home = checked_namespace(namespace)
    topics = DriverTopics(checked_topic(imu, home), checked_topic(mag, home) if mag else "", own_driver)
    if topics.imu == topics.mag:
        raise Problem(f"{topics.imu} cannot be both --imu and --mag: a topic has one type")
    folder = out or new_run_folder("live")
    show_result(run_on_driver(chosen, LiveJob(topics, own_driver, home, duration), folder, Terminal()), folder)
