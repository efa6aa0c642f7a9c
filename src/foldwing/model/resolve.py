"""From the tables of a model file to a wing or a typical section: all numbers looked up."""

from pathlib import Path

from foldwing.errors import InputError
from foldwing.model.aircraft import QUARTER, Aircraft, quarter_chord
from foldwing.model.faults import as_input_error
from foldwing.model.outlines import outlines
from foldwing.model.parts import Hinge, HingeKind
from foldwing.model.resolve_segment import resolved_segment
from foldwing.model.schema import AircraftTable, HingeTable, ModelFile
from foldwing.model.section import TypicalSection
from foldwing.model.segment import Structure
from foldwing.model.wing import Wing, in_file

_OF_WINGS = ("material", "point_mass", "lattice")
_OF_SECTIONS = {"damping", "damping_threshold"}
"""What of [analysis] a typical section has."""

_BODIES = ("fuselage", "tail")


def resolved(model: ModelFile, folder: Path | None = None) -> Wing:
    """Return the wing that a model file describes.

    Parameters
    ----------
    model : ModelFile
    folder : Path, optional
        Where files that it names are found; the current one by default.

    Raises
    ------
    InputError
        When something is missing or does not fit; it names the field in the file.
    """
    wing = model.wing
    if wing is None:
        raise model.missing("wing")
    shapes = outlines(wing)
    segments = tuple(
        resolved_segment(model, wing, index, shape, folder)
        for index, shape in enumerate(shapes.planforms)
    )
    hinges = tuple(
        _hinge(table.hinge, index, shapes.flares[index - 1])
        for index, table in enumerate(wing.segment)
        if table.hinge is not None
    )
    with as_input_error(place=in_file):
        clamped = Wing(
            title=model.title,
            segments=segments,
            hinges=hinges,
            point_masses=model.point_mass,
            air=model.air,
            analysis=model.analysis,
            lattice=model.lattice,
        )
    if model.aircraft is None:
        return clamped
    if not clamped.is_plain or Structure.IMPORTED in clamped.structures:
        limit = "belongs to a wing of beam or plate rectangles with hinges along the stream"
        raise InputError("aircraft", "a table of this model", limit, "Remove it, or the outlines.")
    if "image" not in model.lattice.model_fields_set:
        clamped = clamped.with_lattice(image=True)
    return clamped.carried_by(_aircraft(model.aircraft, clamped))


def _aircraft(table: AircraftTable, wing: Wing) -> Aircraft:
    """Return the half aircraft, its parts in their places aft of the wing's elastic axis."""
    share = 0.5 if table.figures == "full" else 1.0
    tail = table.tail.model_dump() | {
        "mass": share * table.tail.mass,
        "pitch_inertia": share * table.tail.pitch_inertia,
        "span": share * table.tail.span,
        "x": _tail_place(table, wing),
    }
    fuselage = {
        "mass": share * table.fuselage.mass,
        "pitch_inertia": share * table.fuselage.pitch_inertia,
    }
    weights = [(share * table.tail.mass, float(tail["x"])), wing.mass_and_centre]
    fuselage["x"] = _fuselage_place(table, wing, fuselage["mass"], weights)
    common = {key: getattr(table, key) for key in Aircraft.model_fields if key not in _BODIES}
    with as_input_error(("aircraft",)):
        return Aircraft.model_validate({**common, "fuselage": fuselage, "tail": tail})


def _tail_place(table: AircraftTable, wing: Wing) -> float:
    """Return where the elastic axis of the tail lies; its quarter chord is behind the wing's."""
    tail, ahead = table.tail, quarter_chord(wing.segments[0])
    to_axis = (tail.elastic_axis - QUARTER) * tail.chord
    if tail.x is None:
        assert table.tail_arm is not None
        return ahead + table.tail_arm + to_axis
    if tail.x - to_axis <= ahead:
        limit = (
            f"must put the quarter chord of the tail aft of the wing's: above {ahead + to_axis:g} m"
        )
        remedy = "Measure x aft of the wing's elastic axis; only tails behind the wing are known."
        raise InputError("aircraft.tail.x", tail.x, limit, remedy)
    return tail.x


def _fuselage_place(
    table: AircraftTable, wing: Wing, mass: float, others: list[tuple[float, float]]
) -> float:
    """Return where the fuselage balances the other parts about the centre of gravity."""
    if table.fuselage.x is not None:
        return table.fuselage.x
    assert table.centre_of_gravity is not None
    x_cg = quarter_chord(wing.segments[0]) + table.centre_of_gravity
    return x_cg - sum(m * (x - x_cg) for m, x in others) / mass


def resolved_section(model: ModelFile) -> TypicalSection:
    """Return the typical section that a model file describes.

    Raises
    ------
    InputError
        When something is missing or does not fit; it names the field in the file.
    """
    section = model.section
    if section is None:
        raise model.missing("section")
    if model.wing is None:
        _check_no_wing_tables(model)
        if section.in_ratios and "air" in model.model_fields_set:
            limit = "a section given in ratios has its air density in mass_ratio"
            raise InputError("air", model.air.density, limit, "Remove [air].")
    with as_input_error(("section",)):
        return section.resolved(model.title, model.air, model.analysis)


def _check_no_wing_tables(model: ModelFile) -> None:
    """Refuse what a section would silently ignore."""
    unused = [key for key in _OF_WINGS if key in model.model_fields_set]
    unused += [f"analysis.{key}" for key in sorted(model.analysis.model_fields_set - _OF_SECTIONS)]
    if unused:
        limit = "belongs to a wing, and this file has a section alone"
        raise InputError(unused[0], "a value", limit, f"Remove {unused[0]}.")


def _hinge(table: HingeTable, index: int, flare: float) -> Hinge:
    """Return the hinge of the segment at `index`; its stiffness is that of all springs."""
    stiffness = table.stiffness or 0.0
    positions = table.positions or ()
    springs = table.springs or len(positions) or 1
    kind = HingeKind.SPRING if table.form in ("springs", "stiffness") else HingeKind(table.form)
    spacing = table.spacing or 0.0
    with as_input_error(("wing", "segment", index, "hinge")):
        hinge = Hinge(
            kind=kind,
            stiffness=springs * stiffness,
            springs=springs,
            spacing=spacing,
            positions=positions,
        )
    return hinge.model_copy(update={"fold": table.fold, "flare": flare, "gap": table.gap})
