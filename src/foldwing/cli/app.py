"""Commands and their options. What they do is imported when they run."""

from pathlib import Path
from typing import Annotated

import typer

from foldwing.cli import options

app = typer.Typer(
    name="foldwing",
    help="Flutter and divergence of folding wings, from a model file to a picture.",
    epilog="Start with: foldwing boundary three-segment --fold2 0:150:2.5 --fold3 level",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(wanted: bool) -> None:
    if wanted:
        from foldwing.results.provenance import package_version

        typer.echo(f"foldwing {package_version()}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    pass


@app.command()
def examples(
    name: Annotated[str | None, typer.Argument(help="Show this one.", show_default=False)] = None,
    copy: Annotated[
        Path | None, typer.Option("--copy", metavar="FILE", help="Copy it to a new file.")
    ] = None,
) -> None:
    """List the shipped models, show one, or copy one to start from."""
    from foldwing.cli.commands import run_examples

    run_examples(name, copy)


@app.command()
def schema() -> None:
    """Print the JSON schema of model files, for editors."""
    from foldwing.cli.commands import run_schema

    run_schema()


@app.command()
def modes(
    model: options.Model,
    fold: options.Fold = None,
    fold_of: options.FoldOf = None,
    basis: options.Basis = None,
    structure: options.Structure = None,
    measured: options.Measured = None,
    clamped: options.Clamped = False,
    plot: options.Plot = True,
    out: options.Out = None,
    force: options.Force = False,
    json: options.Json = False,
) -> None:
    """Natural frequencies and mode shapes."""
    from foldwing.cli.commands import Output, run_modes
    from foldwing.cli.request import Request

    request = Request(
        model, fold, fold_of, basis=basis, structure=structure, measured=measured, clamped=clamped
    )
    run_modes(request, Output(plot, out, force, json))


@app.command()
def flutter(
    model: options.Model,
    fold: options.Fold = None,
    fold_of: options.FoldOf = None,
    speeds: options.Speeds = None,
    max_speed: options.MaxSpeed = None,
    aero: options.Aero = None,
    drop_mode: options.DropMode = None,
    panels: options.Panels = None,
    spacing: options.Spacing = None,
    gap: options.Gap = None,
    basis: options.Basis = None,
    structure: options.Structure = None,
    damping: options.Damping = None,
    damping_threshold: options.Threshold = None,
    method: options.Method = "sweep",
    time_step: options.TimeStep = None,
    clamped: options.Clamped = False,
    plot: options.Plot = True,
    out: options.Out = None,
    force: options.Force = False,
    json: options.Json = False,
) -> None:
    """Flutter and divergence points, and eigenvalues against airspeed."""
    from foldwing.cli.commands import Output, run_flutter
    from foldwing.cli.request import Request

    request = Request(
        model,
        fold,
        fold_of,
        basis=basis,
        structure=structure,
        aero=aero,
        drop_mode=drop_mode,
        panels=panels,
        spacing=spacing,
        gap=gap,
        damping=options.number("--damping", damping, "0.01"),
        damping_threshold=options.number("--damping-threshold", damping_threshold, "0.02"),
        max_speed=options.number("--max-speed", max_speed, "60"),
        speeds=speeds,
        method=method,
        time_step=options.number("--time-step", time_step, "0.0003"),
        clamped=clamped,
    )
    run_flutter(request, Output(plot, out, force, json))


@app.command()
def boundary(
    model: options.Model,
    fold: options.Fold = None,
    fold_of: options.FoldOf = None,
    max_speed: options.MaxSpeed = None,
    aero: options.Aero = None,
    drop_mode: options.DropMode = None,
    panels: options.Panels = None,
    spacing: options.Spacing = None,
    gap: options.Gap = None,
    basis: options.Basis = None,
    structure: options.Structure = None,
    damping: options.Damping = None,
    damping_threshold: options.Threshold = None,
    measured: options.Measured = None,
    trace: options.Trace = False,
    clamped: options.Clamped = False,
    tail_aero: options.TailAero = None,
    trim: options.Trim = None,
    jobs: options.Jobs = "1",
    plot: options.Plot = True,
    out: options.Out = None,
    force: options.Force = False,
    json: options.Json = False,
) -> None:
    """Flutter and divergence points against fold angle."""
    from foldwing.cli.commands import Output, run_boundary
    from foldwing.cli.request import Request

    request = Request(
        model,
        fold,
        fold_of,
        basis=basis,
        structure=structure,
        aero=aero,
        drop_mode=drop_mode,
        panels=panels,
        spacing=spacing,
        gap=gap,
        damping=options.number("--damping", damping, "0.01"),
        damping_threshold=options.number("--damping-threshold", damping_threshold, "0.02"),
        max_speed=options.number("--max-speed", max_speed, "60"),
        measured=measured,
        trace=trace,
        jobs=options.processes(jobs),
        clamped=clamped,
        tail_aero=tail_aero,
        trim=trim,
    )
    run_boundary(request, Output(plot, out, force, json))


@app.command()
def convergence(
    model: options.Model,
    fold: options.Fold = None,
    fold_of: options.FoldOf = None,
    max_speed: options.MaxSpeed = None,
    aero: options.Aero = None,
    drop_mode: options.DropMode = None,
    panels: options.Panels = None,
    spacing: options.Spacing = None,
    gap: options.Gap = None,
    basis: options.Basis = None,
    structure: options.Structure = None,
    damping: options.Damping = None,
    damping_threshold: options.Threshold = None,
    vary: options.Vary = None,
    levels: options.Levels = None,
    clamped: options.Clamped = False,
    jobs: options.Jobs = "1",
    plot: options.Plot = True,
    out: options.Out = None,
    force: options.Force = False,
    json: options.Json = False,
) -> None:
    """Error bars of the flutter points of one case: mesh, wake, time step, modes."""
    from foldwing.cli.commands import Output
    from foldwing.cli.convergence import run_convergence
    from foldwing.cli.request import Request

    request = Request(
        model,
        fold,
        fold_of,
        basis=basis,
        structure=structure,
        aero=aero,
        drop_mode=drop_mode,
        panels=panels,
        spacing=spacing,
        gap=gap,
        damping=options.number("--damping", damping, "0.01"),
        damping_threshold=options.number("--damping-threshold", damping_threshold, "0.02"),
        max_speed=options.number("--max-speed", max_speed, "60"),
        jobs=options.processes(jobs),
        vary=vary,
        levels=levels,
        clamped=clamped,
    )
    run_convergence(request, Output(plot, out, force, json))


@app.command()
def steady(
    model: options.Model,
    fold: options.Fold = None,
    fold_of: options.FoldOf = None,
    alpha: options.Alpha = "5",
    speed: options.Speed = "20",
    panels: options.Panels = None,
    spacing: options.Spacing = None,
    gap: options.Gap = None,
    image: options.Image = False,
    clamped: options.Clamped = False,
    plot: options.Plot = True,
    out: options.Out = None,
    force: options.Force = False,
    json: options.Json = False,
) -> None:
    """Steady lift, induced drag, hinge moments and circulation by the vortex lattice."""
    from foldwing.cli.commands import Output
    from foldwing.cli.steady import SteadyRequest, run_steady

    request = SteadyRequest(
        model,
        fold,
        fold_of,
        panels=panels,
        spacing=spacing,
        gap=gap,
        alpha=options.given_number("--alpha", alpha, "5"),
        speed=options.given_number("--speed", speed, "20"),
        image=image,
        clamped=clamped,
    )
    run_steady(request, Output(plot, out, force, json))


@app.command()
def aircraft(
    model: options.Model,
    fold: options.Fold = None,
    fold_of: options.FoldOf = None,
    speeds: options.Speeds = None,
    max_speed: options.MaxSpeed = None,
    aero: options.Aero = None,
    tail_aero: options.TailAero = None,
    trim: options.Trim = None,
    drop_mode: options.DropMode = None,
    panels: options.Panels = None,
    spacing: options.Spacing = None,
    gap: options.Gap = None,
    basis: options.Basis = None,
    structure: options.Structure = None,
    damping: options.Damping = None,
    damping_threshold: options.Threshold = None,
    plot: options.Plot = True,
    out: options.Out = None,
    force: options.Force = False,
    json: options.Json = False,
) -> None:
    """Trim, flight modes, flutter and divergence of an aircraft, beside its wing clamped."""
    from foldwing.cli.aircraft import run_aircraft
    from foldwing.cli.commands import Output
    from foldwing.cli.request import Request

    request = Request(
        model,
        fold,
        fold_of,
        basis=basis,
        structure=structure,
        aero=aero,
        drop_mode=drop_mode,
        panels=panels,
        spacing=spacing,
        gap=gap,
        damping=options.number("--damping", damping, "0.01"),
        damping_threshold=options.number("--damping-threshold", damping_threshold, "0.02"),
        max_speed=options.number("--max-speed", max_speed, "60"),
        speeds=speeds,
        tail_aero=tail_aero,
        trim=trim,
    )
    run_aircraft(request, Output(plot, out, force, json))


@app.command()
def flight(
    model: options.Model,
    fold: options.Fold = None,
    fold_of: options.FoldOf = None,
    speed: options.CruiseSpeed = None,
    speeds: options.FlightSpeeds = None,
    tail_aero: options.TailAero = None,
    trim: options.Trim = None,
    plot: options.Plot = True,
    out: options.Out = None,
    force: options.Force = False,
    json: options.Json = False,
) -> None:
    """Phugoid and short period of a rigid aircraft, its derivatives and flight paths."""
    from foldwing.cli.commands import Output
    from foldwing.cli.flight import FlightRequest, run_flight

    request = FlightRequest(
        model,
        fold,
        fold_of,
        speed=options.number("--speed", speed, "54"),
        speeds=speeds,
        tail_aero=tail_aero,
        trim=trim,
    )
    run_flight(request, Output(plot, out, force, json))


@app.command()
def section(
    model: options.Model,
    torsion: options.Torsion = None,
    speeds: options.SectionSpeeds = None,
    max_speed: options.SectionMaxSpeed = None,
    aero: options.SectionAero = "strip",
    damping: options.Damping = None,
    damping_threshold: options.Threshold = None,
    plot: options.Plot = True,
    out: options.Out = None,
    force: options.Force = False,
    json: options.Json = False,
) -> None:
    """Flutter of a typical section of two or three degrees of freedom."""
    from foldwing.cli.commands import Output
    from foldwing.cli.section import SectionRequest, run_section

    request = SectionRequest(
        model,
        torsion,
        speeds,
        max_speed=options.number("--max-speed", max_speed, "30"),
        aero=aero,
        damping=options.number("--damping", damping, "0.01"),
        damping_threshold=options.number("--damping-threshold", damping_threshold, "0.02"),
    )
    run_section(request, Output(plot, out, force, json))
