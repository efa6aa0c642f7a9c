"""From the tables of a model file to a wing or a typical section: all numbers looked up."""

from dataclasses import dataclass

from foldwing.errors import InputError
from foldwing.model.aircraft import QUARTER, Aircraft, quarter_chord
from foldwing.model.faults import as_input_error, file_path, shown
from foldwing.model.material import Material, strip_inertia, strip_properties
from foldwing.model.parts import MID_CHORD, Hinge, HingeKind, Segment
from foldwing.model.record import suggest
from foldwing.model.schema import AircraftTable, HingeTable, ModelFile, SegmentKeys, WingTable
from foldwing.model.section import TypicalSection
from foldwing.model.wing import Wing, in_file

_SHEET = ("bending_stiffness", "torsion_stiffness", "mass_per_span", "inertia_per_span")
_OF_WINGS = ("material", "point_mass", "lattice")
_OF_SECTIONS = {"damping", "damping_threshold"}
"""What of [analysis] a typical section has."""

_BODIES = ("fuselage", "tail")
_EXAMPLES = {"span": '"14 cm"', "chord": '"5 cm"', "thickness": '"1/16 in"', "material": '"sheet"'}


def resolved(model: ModelFile) -> Wing:
    """Return the wing that a model file describes.

    Raises
    ------
    InputError
        When something is missing or does not fit; it names the field in the file.
    """
    wing = model.wing
    if wing is None:
        raise model.missing("wing")
    segments = tuple(_segment(model, wing, index) for index in range(len(wing.segment)))
    hinges = tuple(
        _hinge(table.hinge, index)
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


@dataclass(frozen=True)
class _Section:
    """What the file says of one segment, by itself or in the wing table."""

    index: int
    keys: SegmentKeys
    common: SegmentKeys

    def value(self, key: str) -> object:
        own = getattr(self.keys, key)
        return getattr(self.common, key) if own is None else own

    def length(self, key: str) -> float:
        value = self.value(key)
        if not isinstance(value, float):
            raise self.missing(key, "must be a length (m), greater than 0 m")
        return value

    def missing(self, key: str, limit: str) -> InputError:
        example = _EXAMPLES.get(key)
        remedy = f"Add {key} = {example}" if example else f"Add {key}"
        return InputError(self.path(key), None, limit, f"{remedy} here, or in [wing] for all.")

    def path(self, key: str) -> str:
        own = getattr(self.keys, key) is not None or getattr(self.common, key) is None
        return file_path(("wing", "segment", self.index, key) if own else ("wing", key))


def _segment(model: ModelFile, wing: WingTable, index: int) -> Segment:
    section = _Section(index, wing.segment[index], wing)
    given = {key: section.value(key) for key in Segment.model_fields}
    values = {key: value for key, value in given.items() if value is not None}
    values |= {"span": section.length("span"), "chord": section.length("chord")}
    material = _material(model, section)
    if any(key not in values for key in _SHEET):
        values = _sheet_values(section, material, values) | values
    with as_input_error(("wing", "segment", index)):
        return Segment.model_validate(values)


def _material(model: ModelFile, section: _Section) -> Material | None:
    name = section.value("material")
    if name is None:
        return None
    material = model.material.get(str(name))
    if material is None:
        limit = "must be the name of a [material.NAME] table"
        remedy = suggest(name, model.material)
        raise InputError(section.path("material"), shown(name), limit, remedy)
    return material


def _sheet_values(
    section: _Section, material: Material | None, values: dict[str, object]
) -> dict[str, object]:
    """Return the section properties of a strip of sheet of the segment's material."""
    absent = [key for key in _SHEET if key not in values]
    thickness = section.value("thickness")
    if material is None and thickness is None:
        raise section.missing(absent[0], "must be given, or else a material and a thickness")
    if material is None:
        raise section.missing("material", f"is needed for {', '.join(absent)}")
    if not isinstance(thickness, float):
        raise section.missing("thickness", f"is needed for {', '.join(absent)}")
    chord = section.length("chord")
    strip = strip_properties(material, chord, thickness)
    mass = values.get("mass_per_span", strip["mass_per_span"])
    axis, centre = (values.get(key, MID_CHORD) for key in ("elastic_axis", "mass_centre"))
    assert isinstance(mass, float) and isinstance(axis, float) and isinstance(centre, float)
    return {**strip, "inertia_per_span": strip_inertia(mass, chord, (centre - axis) * chord)}


def _hinge(table: HingeTable, index: int) -> Hinge:
    """Return the hinge of the segment at `index`; its stiffness is that of all springs."""
    stiffness = table.stiffness or 0.0
    springs = table.springs or 1
    kind = HingeKind.SPRING if table.form in ("springs", "stiffness") else HingeKind(table.form)
    with as_input_error(("wing", "segment", index, "hinge")):
        hinge = Hinge(
            kind=kind, stiffness=springs * stiffness, springs=springs, spacing=table.spacing or 0.0
        )
    return hinge.model_copy(update={"fold": table.fold, "gap": table.gap})
