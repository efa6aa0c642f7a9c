"""Modes of a structure on points, from files of other programs and of tests, and to such files.

===============  ===============================================================================
`mode_set`       frequencies, modal masses and shapes on points
`checks`         what a mode set must fulfil
`placement`      axes of a file in the plane of a segment
`complex_modes`  complex shapes made real
`raw`            modes as they stand in a file, and their way into SI units
`reading`        which reader a file needs
`writing`        a file whole or not at all
`tables`         CSV: sections of a text file, written by hand or by a spreadsheet
`netcdf`         netCDF
`universal`      universal files, datasets 55, 15, 2411 and 164
`punch`          Nastran punch files
`nastran`        Nastran geometry from bulk data, and OP2 files
===============  ===============================================================================
"""

from foldwing.structure.mode_files.mode_set import ModeSet
from foldwing.structure.mode_files.placement import Placement
from foldwing.structure.mode_files.reading import read_modes
from foldwing.structure.mode_files.writing import write_modes

__all__ = ["ModeSet", "Placement", "read_modes", "write_modes"]
