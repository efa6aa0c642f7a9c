"""Which kind of component modes a segment has; what computes them is imported when it is."""

from foldwing.model import Analysis, Segment, Structure
from foldwing.model.modes_file import ModesFile
from foldwing.structure.beam import beam_modes
from foldwing.structure.component import ComponentModes, Root


def component_modes(segment: Segment, analysis: Analysis, root: Root) -> ComponentModes:
    """Return the component modes of a segment.

    Raises
    ------
    InputError
        When modes to import cannot be read or used.
    """
    if segment.structure is Structure.BEAM:
        return beam_modes(segment, analysis, root)
    if segment.structure is Structure.PLATE and segment.sheet is not None:
        from foldwing.structure.plate import Plate, plate_modes

        plate = Plate(segment.outline, segment.sheet, segment.elastic_axis)
        return plate_modes(plate, analysis.plate_modes, root)
    if segment.modes is None:
        raise ValueError(f"structure: got {segment.structure} without what it is computed from")
    return _imported(segment, segment.modes, root)


def _imported(segment: Segment, file: ModesFile, root: Root) -> ComponentModes:
    from foldwing.structure.imported import imported_modes
    from foldwing.structure.mode_files import Placement, read_modes
    from foldwing.structure.rigid_properties import uniform_sheet

    read = read_modes(
        file.file,
        geometry=file.geometry,
        length_unit=file.length_unit,
        mass_unit=file.mass_unit,
        modal_mass=file.modal_mass,
    )
    outline = segment.outline
    return imported_modes(
        read.placed(Placement(file.origin, file.x_axis, file.y_axis)),
        outline,
        segment.elastic_axis,
        uniform_sheet(outline, file.mass / outline.area),
        root,
        smoothing=file.smoothing,
    )
