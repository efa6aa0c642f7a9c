"""Which kind of component modes a segment has."""

from foldwing.model import Analysis, Segment, Structure
from foldwing.structure.beam import beam_modes
from foldwing.structure.component import ComponentModes, Root
from foldwing.structure.plate import Plate, plate_modes


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
        plate = Plate(segment.outline, segment.sheet, segment.elastic_axis)
        return plate_modes(plate, analysis.plate_modes, root)
    raise ValueError(f"structure: got {segment.structure}")
