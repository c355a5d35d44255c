# SPDX-License-Identifier: MIT
"""Elements: their symbols, their van der Waals radii, and which one an atom's name means."""

import re
from functools import cache

import gemmi

MASSES = {gemmi.Element(z).name: gemmi.Element(z).weight for z in range(1, 119)} | {"D": 2.014}
SYMBOLS = frozenset(MASSES)

# Angstrom, as text so that they are rounded once, in the unit that is written.
# A. Bondi, J. Phys. Chem. 68 (1964) 441; hydrogen and the main-group elements that Bondi lacks:
# M. Mantina et al., J. Phys. Chem. A 113 (2009) 5806. Elements on which tables differ are left out.
_TABLE = (
    "H 1.10 D 1.10 He 1.40 Li 1.82 Be 1.53 B 1.92 C 1.70 N 1.55 O 1.52 F 1.47 Ne 1.54 Na 2.27"
    " Mg 1.73 Al 1.84 Si 2.10 P 1.80 S 1.80 Cl 1.75 Ar 1.88 K 2.75 Ca 2.31 Ni 1.63 Cu 1.40 Zn 1.39"
    " Ga 1.87 Ge 2.11 As 1.85 Se 1.90 Br 1.85 Kr 2.02 Rb 3.03 Sr 2.49 Pd 1.63 Ag 1.72 Cd 1.58"
    " In 1.93 Sn 2.17 Sb 2.06 Te 2.06 I 1.98 Xe 2.16 Cs 3.43 Ba 2.68 Au 1.66 Tl 1.96 Pb 2.02"
    " Bi 2.07"
).split()
RADII = dict(zip(_TABLE[::2], _TABLE[1::2], strict=True))

_MASS_TOLERANCE = 0.015  # below the 0.020 between N and a united CH2
_LIGHT_TOLERANCE = 0.005  # mass 1 is that of Lennard-Jones particles, not of hydrogen

# In these an atom's first letter is its element; CA is a carbon, and MW of water is no atom at all.
_BIOMOLECULES = frozenset(
    "ALA ARG ASN ASP CYS GLN GLU GLY HIS ILE LEU LYS MET PHE PRO SER THR TRP TYR VAL"
    " HSD HSE HSP HID HIE HIP HISA HISB HISH HISD HISE CYX CYM CYS2 CYSH ASH ASPH GLH GLUH LYN LYSH"
    " ACE NME NMA NAC NH2 A C G U T DA DC DG DT DU ADE CYT GUA URA THY RA RC RG RU"
    " HOH SOL WAT H2O TIP TIP3 TIP4 TIP5 TIP3P TIP4P T3P T4P T5P SPC SPCE".split()
)
_CHARMM_IONS = {"SOD": "Na", "CLA": "Cl", "POT": "K", "CAL": "Ca", "CES": "Cs", "LIT": "Li"}
_ION_RESIDUES = frozenset(("ION", "IONS"))
# Elsewhere the first letter decides too, but for these, whose second letter is no place or number.
_TWO_LETTERS = frozenset("CL BR SI SE FE ZN MG MN CU LI AL AU AG PT".split())


def symbol(text: str) -> str | None:
    """Returns the element that is written out, in any case: C, CL, Cl."""
    found = text.strip().capitalize()
    return found if found in SYMBOLS else None


def symbol_of_mass(mass: float) -> str | None:
    tolerance = _MASS_TOLERANCE if mass > 2 else _LIGHT_TOLERANCE
    near = [s for s in RADII if abs(MASSES[s] - mass) <= tolerance]
    return near[0] if len(near) == 1 else None


@cache
def element_of(name: str, residue: str) -> str | None:
    """Returns the element of an atom whose file has only names; None if it is none, or unknown."""
    letters = _letters(name)
    if residue.strip() in _BIOMOLECULES:
        return letters[0] if letters and letters[0] in "HCNOSP" else None
    if letters == _letters(residue) or residue.strip() in _ION_RESIDUES:
        return _CHARMM_IONS.get(letters) or symbol(letters)
    if letters[:2] in _TWO_LETTERS:
        return letters[:2].capitalize()
    return letters[0] if letters and letters[0] in "HCNOSPFIB" else symbol(letters)


@cache
def element_of_pdb(name: str, residue: str) -> str | None:
    """Returns the same for PDB's four columns, where symbols of two letters start in the first."""
    letters = _letters(name)
    if residue.strip() in _BIOMOLECULES or letters == _letters(residue):
        return element_of(name, residue)
    if name[:1].isalpha() and not (name[0] == "H" and len(name.strip()) == 4):
        return symbol(name[:2]) or element_of(name, residue)
    return symbol(letters[:1])


def _letters(name: str) -> str:
    """The first run of letters, in capitals: HB of 1HB2."""
    found = re.search("[A-Za-z]+", name)
    return found[0].upper() if found else ""
