"""`pdr demo`: the main job on a simulated walk."""

from pathlib import Path

import typer


def demo(
    out: Path = typer.Option(None, "--out", "-o", help="folder for recording, trajectory, result and report"),
    length: float = typer.Option(24.0, help="length of the simulated walk [m]"),
    rate: float = typer.Option(1.0, help="speed: 2 walks twice as fast as real"),
    magnetometer: bool = typer.Option(False, "--magnetometer", help="the simulated sensor has a magnetometer too"),
    params: Path = typer.Option(None, help="parameter file, see `pdr params`"),
) -> None:
    """Walk with a simulated sensor through all nodes, live, and see how far off the estimate is.

    Example: `pdr demo`, then open the report.html that it names
    """
    from pdr_bringup_scripts.chain import private_domain
    from pdr_bringup_scripts.live import live_run
    from pdr_bringup_scripts.run_folder import new_run_folder, show_result
    from pdr_bringup_scripts.terminal import Terminal
    from pdr_core.params import Params, changed
    from pdr_core.params_file import load_params

    chosen = load_params(params) if params else Params()
    chosen = changed(chosen, "driver", device="simulated", rate_factor=rate)
    chosen = changed(chosen, "simulation", walk_length_m=length)
    if magnetometer:
        chosen = changed(changed(chosen, "simulation", magnetometer=True), "node", magnetometer=True)
    folder = out or new_run_folder("demo")
    show_result(live_run(chosen, folder, private_domain(), Terminal()), folder)
