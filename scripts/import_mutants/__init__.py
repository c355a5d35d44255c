# SPDX-License-Identifier: MIT
"""The formats' rules once more, in as few words as they can be said: what mutants are judged by.

A plain reader takes a whole file and gives the points of each frame in Angstrom, or throws Refused.
It shares nothing with octocell_import.
"""

from import_mutants.molecules import gro, mmcif, pdb, swc, xyz
from import_mutants.particles import lammps_data, lammps_dump, ply, trr, vtk
from import_mutants.samples import SAMPLES
from import_mutants.words import Frames, Refused, Unjudged

__all__ = ["PLAIN_READERS", "SAMPLES", "Frames", "Refused", "Unjudged"]

PLAIN_READERS = {
    "gro": gro,
    "lammps-data": lammps_data,
    "lammps-dump": lammps_dump,
    "mmcif": mmcif,
    "pdb": pdb,
    "ply": ply,
    "swc": swc,
    "trr": trr,
    "vtk": vtk,
    "xyz": xyz,
}
