"""The `pdr` command: pedestrian dead reckoning from inertial sensors on the shoe."""

from pdr_bringup_scripts.problems import told


def command_line() -> None:
    """Read the command line and do what it says; the imports stand here, where a Ctrl-C is answered."""
    import typer

    from pdr_bringup_scripts.commands import (
        bench,
        calibrate,
        compare,
        convert,
        demo,
        evaluate,
        live,
        params,
        record,
        replay,
        run,
        simulate,
        test,
    )

    app = typer.Typer(
        help=__doc__,
        no_args_is_help=True,
        add_completion=False,
        rich_markup_mode="markdown",
        context_settings={"help_option_names": ["-h", "--help"]},
        pretty_exceptions_enable=False,
    )
    for module in (demo, test, live, record, run, replay, simulate, convert, evaluate, compare, bench, params):
        name = module.__name__.rsplit(".", 1)[-1]
        allowed = {"allow_extra_args": True, "ignore_unknown_options": True} if name == "test" else {}
        app.command(name, context_settings=allowed)(getattr(module, name))
    app.add_typer(calibrate.calibrate, name="calibrate")
    app(prog_name="pdr")


def main() -> None:
    """Run the command line; an error a user can mend is one sentence and exit code 2."""
    told(command_line)


if __name__ == "__main__":
    main()
