"""`pdr params`: every parameter with its default, unit and bounds."""

import typer


def params(
    markdown: bool = typer.Option(False, "--markdown", help="print tables for the documentation instead of YAML"),
) -> None:
    """Print every parameter with its default, unit and bounds as a YAML file to start from.

    Example: `pdr params > mine.yaml`, then `pdr run walk.mcap --params mine.yaml`
    """
    from pdr_core import params_file

    print(params_file.markdown() if markdown else params_file.default_file(), end="")
