"""`pdr calibrate`: the commands that find the parameters of a sensor from a recording."""

import typer

from pdr_bringup_scripts.commands.calibrate_mag import mag
from pdr_bringup_scripts.commands.calibrate_mounting import mounting

calibrate = typer.Typer(help="Find the parameters of a sensor from a recording.", no_args_is_help=True)
calibrate.command()(mag)
calibrate.command()(mounting)
