"""`pdr demo`: the main job on a simulated walk."""

import time
from pathlib import Path

import typer


def demo(
    out: Path = typer.Option(None, "--out", "-o", help="folder for recording, trajectory, result and report"),
    length: float = typer.Option(None, min=1.2, help="length of the walk [m]; default: 24, with --adaptive 100"),
    rate: float = typer.Option(None, help="speed: 2 walks twice as fast as real; default: 1, with --adaptive 6"),
    dual: bool = typer.Option(False, "--dual", help="a sensor on each foot, and the person between them"),
    adaptive: bool = typer.Option(False, "--adaptive", help="the gyro is switched off where strides can be reckoned"),
    magnetometer: bool = typer.Option(False, "--magnetometer", help="the simulated sensor has a magnetometer too"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
) -> None:
    """Walk with a simulated sensor through all nodes, live, and see how far off the estimate is.

    Example: `pdr demo`, then open the report.html that it names
    """
    from pdr_bringup_scripts.live.cast import both_simulated, one_foot, one_switched_foot
    from pdr_bringup_scripts.live.chain import private_domain
    from pdr_bringup_scripts.live.live_run import live_run
    from pdr_bringup_scripts.problems import Problem
    from pdr_bringup_scripts.run.run_folder import new_run_folder, show_calls, show_result
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.params import Params, changed
    from pdr_core.params_file import load_params

    if dual and adaptive:
        raise Problem("--dual and --adaptive do not go together: the gyro of one foot is switched, not of two")
    usual_m, usual_rate = (100.0, 6.0) if adaptive else (24.0, 1.0)
    length, rate = usual_m if length is None else length, usual_rate if rate is None else rate
    chosen = load_params(params) if params else Params()
    chosen = changed(chosen, "driver", device="simulated", rate_factor=rate)
    chosen = changed(chosen, "simulation", walk_length_m=length)
    if adaptive:  # outdoors: the field holds the heading
        chosen = changed(chosen, "simulation", motion="smooth", sample_rate_hz=100.0)
    if magnetometer or adaptive:
        chosen = changed(changed(chosen, "simulation", magnetometer=True), "node", magnetometer=True)
    one = one_switched_foot if adaptive else one_foot
    cast = both_simulated(chosen, time.time_ns()) if dual else one(chosen)
    folder = out or new_run_folder("demo")
    result = live_run(cast, folder, private_domain(), Terminal())
    show_calls(result)
    show_result(result, folder)
