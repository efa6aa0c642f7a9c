"""Results: one labelled dataset per run, written whole with its provenance.

===================  ==========================================================================
`variables`          every variable: dimensions, unit, meaning
`schema`             `build_dataset`, which checks what it is given against them
`flutter_table`      the table of flutter points, as rows and as variables
`provenance`         version, model, options and date, carried by every dataset
`convergence_table`  error bars of a convergence study, by setting
`summary`            the answer and the certificate in one line each
`writing`            netCDF and CSV
`steady_table`       tables of steady loads
`flight_table`       tables of the flight of a rigid aircraft
`aircraft_table`     tables of a flexible aircraft: trim, motions, its wing clamped
`flight_summary`     the answer of a flight in one line
`section_table`      tables of a typical section; `changes` in words
`units`              SI, or the ratios of a section without scales
`folders`            result folders: whole or not at all, never over something else
===================  ==========================================================================
"""

from foldwing.results.aircraft_table import write_aircraft_csv
from foldwing.results.flight_table import write_flight_csv
from foldwing.results.flutter_table import FlutterRow, flutter_rows, table_variables
from foldwing.results.folders import check_writable, default_folder, free_name, result_folder
from foldwing.results.provenance import Source, model_hash, package_version, provenance
from foldwing.results.schema import build_dataset, fold_angle_names
from foldwing.results.section_table import write_changes_csv
from foldwing.results.steady_table import write_steady_csv
from foldwing.results.summary import answer, certificate
from foldwing.results.variables import VARIABLES
from foldwing.results.writing import (
    DATASET_FILE,
    read_dataset,
    write_convergence_csv,
    write_csv,
    write_dataset,
    write_frequencies_csv,
)

__all__ = [
    "DATASET_FILE",
    "VARIABLES",
    "FlutterRow",
    "Source",
    "answer",
    "build_dataset",
    "certificate",
    "check_writable",
    "default_folder",
    "flutter_rows",
    "fold_angle_names",
    "free_name",
    "model_hash",
    "package_version",
    "provenance",
    "read_dataset",
    "result_folder",
    "table_variables",
    "write_aircraft_csv",
    "write_changes_csv",
    "write_convergence_csv",
    "write_csv",
    "write_dataset",
    "write_flight_csv",
    "write_frequencies_csv",
    "write_steady_csv",
]
