/* SPDX-License-Identifier: MIT */
/* One stage of yours, the others are ours: `octocell try mine.cpp --stage sort` (docs/how_to/bring_your_own.md).
 *
 * Define the one function that --stage names. Stages 2 to 5 by the rule lowest_cell are docs/stages/.
 * All arrays are in the host's memory and belong to the caller. Inputs are only read; the work must be finished when
 * the function returns. A list that is written has room for `capacity` entries; if there are more, write nothing behind
 * the end, but count on. The function returns 0, or another number if it failed.
 */
#ifndef OCTOCELL_STAGE_H
#define OCTOCELL_STAGE_H

#include "octocell_plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Cells are cubes. The cell of a coordinate v on an axis is floor((v - corner) / side) in double, and then at least 0
 * and at most cells - 1. The id of cell (x, y, z) is x + cells[0] * (y + cells[1] * z). */
typedef struct octocell_grid { double corner[3]; double side; uint32_t cells[3]; } octocell_grid;

/* An entry is a cell id and an object: the number of a sphere, with four control bits above its 28 bits. */
#define OCTOCELL_PHANTOM (1u << 31)   /* the cell is not the sphere's home */
#define OCTOCELL_LOWEST_X (1u << 28)  /* on x, the cell is the lowest one that the sphere meets */
#define OCTOCELL_LOWEST_Y (1u << 29)
#define OCTOCELL_LOWEST_Z (1u << 30)
#define OCTOCELL_SPHERE ((1u << 28) - 1)

/* A cell's entries in the sorted arrays: first its homes, then its phantoms. */
typedef struct octocell_cell { uint32_t begin, homes, phantoms; } octocell_cell;

/* Stage 2. The home of sphere i, the cell of its centre, becomes entry i. Behind the n homes, in any order, follow the
 * phantoms: all other cells that its box meets. The box reaches from p - r to p + r, computed in float; it meets all
 * cells from that of its lower to that of its upper corner. *count is the number of all entries. */
int cell_ids(const octocell_sphere* spheres, uint32_t n, const octocell_grid* grid, uint32_t* ids, uint32_t* objects,
             uint64_t capacity, uint64_t* count);

/* Stage 3. Sorts n entries by their ids, which are below 2^key_bits; key_bits is 0 to 32. Each object goes along with
 * its id, and entries of the same id keep their order. */
int sort(const uint32_t* ids, const uint32_t* objects, uint32_t n, uint32_t key_bits, uint32_t* sorted_ids,
         uint32_t* sorted_objects);

/* Stage 4. Lists, in any order, each cell with at least two of the n sorted entries. */
int cell_index(const uint32_t* ids, const uint32_t* objects, uint32_t n, octocell_cell* cells, uint64_t capacity,
               uint64_t* count);

/* Stage 5, with the exact decision of stage 6. Lists each pair once, in any order. Two entries of a cell are a pair if
 * their spheres overlap (octocell_plugin.h), and if on each axis the cell is the lowest one of at least one of them. */
int pair_tests(const octocell_sphere* spheres, uint32_t n, const uint32_t* ids, const uint32_t* objects,
               uint32_t entries, const octocell_cell* cells, uint32_t cell_count, octocell_pair* pairs,
               uint64_t capacity, uint64_t* count);

#ifdef __cplusplus
}
#endif
#endif
