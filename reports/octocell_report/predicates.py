# SPDX-License-Identifier: MIT
"""The overlap tests that rows may be run with, and how far off their wrong pairs are."""

EXACT = "exact"  # what users get; the others are run to be compared with it
FLOAT32 = "f32"  # what is usually written

# From what claims most to what is usually simplest; each in a few words of a formula.
MEANINGS = {
    EXACT: "float32 with a proved filter, then integers",
    "q16_exact": "16-bit positions in the cell; survivors as exact",
    "f64": "float64, D ≤ s²",
    FLOAT32: "float32, D ≤ s²",
    "f32_sqrt": "float32, √D ≤ s",
    "q16_cell": "16-bit positions in the cell",
    "gram_f32": "float32, |p|² + |q|² − 2pq from the origin",
    "f16_cell": "float16 positions in the cell",
    "aabb_only": "bounding boxes alone; loses none",
}
PREDICATES = tuple(MEANINGS)
SCENE_CLASSES = ("random", "structured", "extreme")
