# SPDX-License-Identifier: MIT
"""Functions of other packages, with their signatures and their answers, by Octocell's search.

Their numbers are float64. The search is made with float32 spheres that are wide enough to miss no
pair; each pair is then decided for the numbers as given, over the reals. The originals decide by
rounded arithmetic, so they may differ for a distance within a few roundings of the cutoff.
"""
