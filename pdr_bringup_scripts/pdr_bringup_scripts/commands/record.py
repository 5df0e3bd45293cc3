"""`pdr record`: writes what running nodes hear and say to one file."""

from pathlib import Path

import typer

from pdr_bringup_scripts.options import finite


def record(
    out: Path = typer.Option(None, "--out", "-o", help="the file, .mcap; default: a new one in pdr_runs"),
    namespace: str = typer.Option("pdr", help="where the nodes are, those of both feet too; / for all of them"),
    duration: float = typer.Option(None, min=0.1, callback=finite, help="end after this time [s]; default: Ctrl-C"),
) -> None:
    """Record raw input, parameters and output of nodes that are running to one MCAP; a crash loses a second at most.

    Example: `pdr record --namespace me --out walk.mcap` before the walk, and then `pdr run walk.mcap --as-recorded`
    """
    from pdr_bringup_scripts.live.chain import checked_namespace
    from pdr_bringup_scripts.live.recording_live import new_file, record_nodes
    from pdr_bringup_scripts.terminal import Terminal

    home = checked_namespace(namespace) if namespace.strip("/") else ""
    print(record_nodes(home, out or new_file(), duration, Terminal()))
