"""`pdr simulate`: a simulated walk with its truth as a recording."""

from pathlib import Path

import typer

WALKS = (
    "rectangle, straight, still; gui and smooth also campus; smooth also curve, corridor, stairs, run, mixed,"
    " qiu_rectangle, track, stair_climb, octagon, octagon_run, transitions"
)
SENSORS = "how good the sensor is: ideal, consumer, g_sensitive, gui_table_1, gui_table_1_deg, qiu_table_1 or icm_20602"


def simulate(
    out: Path = typer.Option("simulated_walk", "--out", "-o", help="NAME.csv, NAME.mcap, or a rosbag2 directory"),
    motion: str = typer.Option(
        None, help="how the foot moves: smooth, or gui, as his paper prints it; chest: a card there"
    ),
    feet: bool = typer.Option(False, "--feet", help="both feet, left and right, which move smoothly; not as CSV"),
    external: bool = typer.Option(False, "--external", help="somebody else follows her: /robot/pose; not as CSV"),
    walk: str = typer.Option(None, help=WALKS),
    length: float = typer.Option(None, min=1.2, help="length of the walk [m]"),
    rate: float = typer.Option(None, help="samples per second [Hz]"),
    sensor: str = typer.Option(None, help=SENSORS),
    magnetometer: bool = typer.Option(None, "--magnetometer", help="the sensor has a magnetometer too"),
    seed: int = typer.Option(None, help="seed of the noise: the same seed, the same walk"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`; the options come before it"),
    force: bool = typer.Option(False, "--force", help="replace what has that name already"),
) -> None:
    """Write a simulated walk and where the foot really was, as a recording that `pdr run` reads.

    Example: `pdr simulate --length 60 --out walk` and then `pdr run walk`
    """
    from pdr_bringup_scripts.problems import Problem
    from pdr_bringup_scripts.saving import save
    from pdr_bringup_scripts.simulated import simulated_session
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.params import Params
    from pdr_core.params_file import load_params

    if feet and motion in ("gui", "chest"):
        raise Problem("both feet move smoothly: leave out --motion")
    chosen = load_params(params) if params else Params()
    wanted = {
        "motion": motion, "walk": walk, "walk_length_m": length,
        "sample_rate_hz": rate, "sensor_model": sensor, "magnetometer": magnetometer, "seed": seed,
    }  # fmt: skip
    given = {name: value for name, value in wanted.items() if value is not None}
    session = simulated_session(chosen, given, feet, external)
    save(session, list(session.sensors.values()), out, force, "Simulating", Terminal())
