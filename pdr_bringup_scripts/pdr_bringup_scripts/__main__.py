"""The `pdr` command: pedestrian dead reckoning from inertial sensors on the shoe."""

import typer

from pdr_bringup_scripts.commands import bench, demo, params, replay, run, test

app = typer.Typer(
    help=__doc__,
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
)
for module in (demo, test, run, replay, params, bench):
    name = module.__name__.rsplit(".", 1)[-1]
    allowed = {"allow_extra_args": True, "ignore_unknown_options": True} if name == "test" else {}
    app.command(name, context_settings=allowed)(getattr(module, name))


def main() -> None:
    """Run the command line; an error a user can mend is one sentence and exit code 2."""
    from pdr_bringup_scripts.problems import told

    told(lambda: app(prog_name="pdr"))


if __name__ == "__main__":
    main()
