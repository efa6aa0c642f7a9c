"""From the table of a segment to the segment: properties of its sheet, files of its modes."""

from dataclasses import dataclass
from pathlib import Path

from foldwing.errors import InputError
from foldwing.model.faults import as_input_error, file_path, shown
from foldwing.model.material import Material, strip_inertia, strip_properties
from foldwing.model.modes_file import ModesFile, ModesTable
from foldwing.model.planform import Planform
from foldwing.model.record import suggest
from foldwing.model.schema import ModelFile, SegmentKeys, SegmentTable, WingTable
from foldwing.model.segment import MID_CHORD, NEEDS, Segment, Structure
from foldwing.model.sheet import Sheet

_SHEET = NEEDS[Structure.BEAM]
_OF_BEAMS = (*_SHEET, "mass_centre")
_AS_WRITTEN = (*_OF_BEAMS, "elastic_axis", "lift_slope")
_EXAMPLES = {"span": '"14 cm"', "chord": '"5 cm"', "thickness": '"1/16 in"', "material": '"sheet"'}


@dataclass(frozen=True)
class _Section:
    """What the file says of one segment, by itself or in the wing table."""

    index: int
    keys: SegmentTable
    common: SegmentKeys
    outline: Planform | None

    def value(self, key: str) -> object:
        own = getattr(self.keys, key)
        return getattr(self.common, key) if own is None else own

    def length(self, key: str) -> float:
        value = self.value(key)
        if not isinstance(value, float):
            raise self.missing(key, "must be a length (m), greater than 0 m")
        return value

    @property
    def extent(self) -> dict[str, float]:
        """Span and chord."""
        if self.outline is None or self.keys.corners is None:
            return {"span": self.length("span"), "chord": self.length("chord")}
        low, high = self.outline.extent
        return {"span": high - low, "chord": self.outline.area / (high - low)}

    @property
    def structure(self) -> Structure:
        """What the segment is."""
        if self.keys.modes is not None:
            return Structure.IMPORTED
        return Structure(str(self.value("structure") or Structure.BEAM))

    def missing(self, key: str, limit: str) -> InputError:
        example = _EXAMPLES.get(key)
        remedy = f"Add {key} = {example}" if example else f"Add {key}"
        return InputError(self.path(key), None, limit, f"{remedy} here, or in [wing] for all.")

    def path(self, key: str) -> str:
        own = getattr(self.keys, key) is not None or getattr(self.common, key, None) is None
        return file_path(("wing", "segment", self.index, key) if own else ("wing", key))


def resolved_segment(
    model: ModelFile,
    wing: WingTable,
    index: int,
    outline: Planform | None,
    folder: Path | None,
) -> Segment:
    """Return the segment that a table describes.

    Parameters
    ----------
    model : ModelFile
    wing : WingTable
    index : int
        Of the segment, from 0.
    outline : Planform, optional
        Without it the segment is a rectangle.
    folder : Path, optional
        Where the files that it names are found.

    Raises
    ------
    InputError
        When something is missing or does not fit; it names the field in the file.
    """
    section = _Section(index, wing.segment[index], wing, outline)
    given = {key: section.value(key) for key in _AS_WRITTEN}
    values = {key: value for key, value in given.items() if value is not None}
    values |= section.extent
    material, thickness = _material(model, section), _thickness(section)
    if thickness is not None and len({t for row in thickness for t in row}) == 1:
        values["thickness"] = thickness[0][0]
    structure = section.structure
    if structure is Structure.BEAM:
        values = _beam_values(section, material, values)
    else:
        _check_no_beam(section)
        values["sheet"] = _sheet(section, material, thickness, structure)
    if section.keys.modes is not None:
        values["modes"] = _modes(section, section.keys.modes, values["sheet"], folder)
    with as_input_error(("wing", "segment", index)):
        return Segment.model_validate({**values, "structure": structure, "planform": outline})


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


def _thickness(section: _Section) -> tuple[tuple[float, ...], ...] | None:
    value = section.value("thickness")
    return value if isinstance(value, tuple) else None


def _beam_values(
    section: _Section, material: Material | None, values: dict[str, object]
) -> dict[str, object]:
    """Return the values, with the properties of a strip of sheet where they are not given."""
    absent = [key for key in _SHEET if key not in values]
    if not absent:
        return values
    if material is None and section.value("thickness") is None:
        raise section.missing(absent[0], "must be given, or else a material and a thickness")
    if material is None:
        raise section.missing("material", f"is needed for {', '.join(absent)}")
    if section.value("thickness") is None:
        raise section.missing("thickness", f"is needed for {', '.join(absent)}")
    thickness, chord = values.get("thickness"), values["chord"]
    if not isinstance(thickness, float):
        limit = "must be one value: beams are uniform"
        remedy = 'Take structure = "plate" for a thickness that varies.'
        raise InputError(section.path("thickness"), "several values", limit, remedy)
    assert isinstance(chord, float)
    strip = strip_properties(material, chord, thickness)
    mass = values.get("mass_per_span", strip["mass_per_span"])
    axis, centre = (values.get(key, MID_CHORD) for key in ("elastic_axis", "mass_centre"))
    assert isinstance(mass, float) and isinstance(axis, float) and isinstance(centre, float)
    inertia = strip_inertia(mass, chord, (centre - axis) * chord)
    return {**strip, "inertia_per_span": inertia, **values}


def _check_no_beam(section: _Section) -> None:
    """Refuse what a plate would silently ignore."""
    for key in _OF_BEAMS:
        value = section.value(key)
        if value is not None:
            limit = f"belongs to a beam, and this segment is {_WORDS[section.structure]}"
            remedy = 'Remove it and give material and thickness, or take structure = "beam".'
            raise InputError(section.path(key), shown(value), limit, remedy)


_WORDS = {Structure.PLATE: "a plate", Structure.IMPORTED: "made of imported modes"}


def _sheet(
    section: _Section,
    material: Material | None,
    thickness: tuple[tuple[float, ...], ...] | None,
    structure: Structure,
) -> Sheet | None:
    """Return what a plate is made of; imported modes need none."""
    if structure is Structure.IMPORTED and (material is None or thickness is None):
        return None
    if material is None:
        raise section.missing("material", "is needed for a plate")
    if thickness is None:
        raise section.missing("thickness", "is needed for a plate")
    ratio = material.youngs_modulus / (2.0 * material.shear) - 1.0
    if not -1.0 < ratio <= 0.5:
        limit = f"makes Poisson's ratio E/(2 G) - 1 = {ratio:.3g}, and plates need -1 to 0.5"
        path = file_path(("material", str(section.value("material")), "shear_modulus"))
        remedy = "Correct the moduli, or give poissons_ratio."
        raise InputError(path, material.shear, limit, remedy)
    return Sheet(
        youngs_modulus=material.youngs_modulus,
        poissons_ratio=ratio,
        density=material.density,
        thickness=thickness,
    )


def _modes(
    section: _Section, table: ModesTable, sheet: object, folder: Path | None
) -> dict[str, object]:
    """Return the file of modes, found beside the model, with the mass of the segment."""
    values = {key: getattr(table, key) for key in ModesFile.model_fields}
    for key in ("file", "geometry"):
        if values[key]:
            values[key] = str((folder or Path()) / str(values[key]))
    if values["mass"] is None:
        if not isinstance(sheet, Sheet):
            path = file_path(("wing", "segment", section.index, "modes", "mass"))
            limit = "must be given, or else material and thickness of the segment"
            raise InputError(path, None, limit, 'Add mass = "8.6 g".')
        extent = section.extent
        plate = Segment.model_validate(
            {**extent, "structure": "plate", "planform": section.outline, "sheet": sheet}
        )
        values["mass"] = plate.mass_and_centre.mass
    return values
