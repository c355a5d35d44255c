/* SPDX-License-Identifier: MIT */
/* One function of yours, and Octocell judges it: `octocell try mine.cpp` (docs/how_to/bring_your_own.md).
 *
 * A sphere is four float32: x, y, z, r, in any unit of length, the same for all four. All are finite, and r >= 0.
 * A pair is two ids i and j of different spheres with |p_i - p_j|^2 <= (r_i + r_j)^2 over the real numbers: spheres
 * that touch are a pair. Ids count from 0. Each pair is wanted once, in any order, i < j or j < i.
 */
#ifndef OCTOCELL_PLUGIN_H
#define OCTOCELL_PLUGIN_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef OCTOCELL_SPHERE_AND_PAIR /* octocell.h has the same */
#define OCTOCELL_SPHERE_AND_PAIR
typedef struct octocell_sphere { float x, y, z, r; } octocell_sphere;
typedef struct octocell_pair { uint32_t i, j; } octocell_pair;
#endif

/* Finds the pairs of a scene. Needed; the name is looked up in the shared library, so C++ needs extern "C".
 *
 * spheres   n of them, aligned to 16 bytes; null if n is 0. Only read them.
 * n         0 to 2^28.
 * pairs     room for `capacity` pairs, aligned to 16 bytes. Write pairs[0] to pairs[*count - 1]; nothing behind
 *           pairs[capacity - 1].
 * count     write the number of pairs there. If it is larger than `capacity`, the room was too small: write what
 *           fits, or nothing, but count on to the end. The caller then calls again, with that much room.
 * stream    null today. Later the CUDA stream in which the work belongs; null is the default stream.
 *
 * All arrays are in the host's memory and belong to the caller; they are valid until the function returns. A program
 * for a GPU copies them itself. The work must be finished when the function returns.
 * Returns 0, or another number if it failed; then nothing is read.
 */
int find_pairs(const octocell_sphere* spheres, uint32_t n, octocell_pair* pairs, uint64_t capacity, uint64_t* count,
               void* stream);

/* Optional. Called before the first find_pairs() of a scene with n spheres: allocate here what is reused. What it
 * allocates belongs to the plug-in. Returns 0, or another number if it failed. */
int prepare(uint32_t n);

/* Optional. Called behind the last find_pairs() after each prepare(): free here what that allocated. */
void finish(void);

#ifdef __cplusplus
}
#endif
#endif
