"""What the user describes: a wing or a typical section, its air and how it is analysed.

=============  =====================================================================
Module         Responsibility
=============  =====================================================================
faults         wording of errors: where, value, limit, remedy
quantities     numbers with units and bounds, resolved to SI floats
record         base of all tables: frozen, unknown keys rejected with a suggestion
listed         quantities in lists
material       materials, section properties of a strip of sheet
sheet          a sheet whose thickness varies
planform       outline of a segment, its hinge edges and chords
frames         where the segments of a folded wing are
parts, wing    the resolved wing that the physics uses
aircraft       what the wing belongs to: fuselage, tail, trim
flight         an aircraft in longitudinal flight: the table and its three forms
section        the resolved typical section; section_table as it is written
schema         the tables of a model file as written; JSON schema
resolve        from the tables to the wing
library        the models and measurements shipped with the package
reader         from a file or the name of an example to the wing
=============  =====================================================================
"""

from foldwing.model.aircraft import Aircraft, Fuselage, Tail
from foldwing.model.flight import (
    Airframe,
    DerivativesModel,
    DerivativesTable,
    FlightModel,
    StateMatrixModel,
    Surface,
)
from foldwing.model.frames import Frames, frames
from foldwing.model.library import (
    ExampleInfo,
    example_names,
    example_text,
    list_examples,
    measurement_names,
)
from foldwing.model.material import Material, strip_inertia, strip_properties
from foldwing.model.parts import Air, Analysis, Hinge, HingeKind, Lattice, PointMass
from foldwing.model.planform import (
    Planform,
    flare_of,
    hinge_direction,
    rectangle,
    trapezoid,
)
from foldwing.model.reader import (
    folder_of,
    model_text,
    parse_file,
    parse_flight,
    parse_model,
    parse_section,
    read_flight,
    read_model,
    read_section,
)
from foldwing.model.schema import json_schema
from foldwing.model.section import TypicalSection
from foldwing.model.segment import Segment, Structure
from foldwing.model.sheet import Sheet
from foldwing.model.wing import Wing

__all__ = [
    "Air",
    "Aircraft",
    "Airframe",
    "Analysis",
    "DerivativesModel",
    "DerivativesTable",
    "ExampleInfo",
    "FlightModel",
    "Frames",
    "Fuselage",
    "Hinge",
    "HingeKind",
    "Lattice",
    "Material",
    "Planform",
    "PointMass",
    "Segment",
    "Sheet",
    "StateMatrixModel",
    "Structure",
    "Surface",
    "Tail",
    "TypicalSection",
    "Wing",
    "example_names",
    "example_text",
    "flare_of",
    "folder_of",
    "frames",
    "hinge_direction",
    "json_schema",
    "list_examples",
    "measurement_names",
    "model_text",
    "parse_file",
    "parse_flight",
    "parse_model",
    "parse_section",
    "read_flight",
    "read_model",
    "read_section",
    "rectangle",
    "strip_inertia",
    "strip_properties",
    "trapezoid",
]
