/* SPDX-License-Identifier: MIT
   Finds every pair of overlapping spheres, exactly: octocell.hpp for C.

   What is a pair, what spheres must be, memory and threads: as octocell.hpp says.

   Functions that can fail return a status and, if `error` is not NULL, describe the failure there.
   Then they write no result. Handles are made by functions named ..._new or find_pairs, and freed
   by
   ..._free, which accepts NULL. */
#ifndef OCTOCELL_H
#define OCTOCELL_H

#include <stddef.h>
#include <stdint.h>

#include "export.h"

#ifdef __cplusplus
extern "C" {
#endif

#ifndef OCTOCELL_SPHERE_AND_PAIR /* octocell_plugin.h has the same */
#define OCTOCELL_SPHERE_AND_PAIR
typedef struct octocell_sphere {
  float x, y, z, r; /* finite, r >= 0 */
} octocell_sphere;

typedef struct octocell_pair {
  uint32_t i, j; /* positions in the scene, i < j */
} octocell_pair;
#endif

typedef enum octocell_status {
  OCTOCELL_OK = 0,
  OCTOCELL_INVALID_SPHERE = 1,   /* error.sphere is the first invalid sphere */
  OCTOCELL_INVALID_ARGUMENT = 2, /* another argument that cannot be used */
  OCTOCELL_LIMIT = 3,            /* larger than this implementation allows */
  OCTOCELL_MEMORY = 4,           /* more memory than this process can have */
  OCTOCELL_UNAVAILABLE = 5,      /* no such device here, or the library was built without it */
  OCTOCELL_STOPPED = 6,          /* options.stop asked for it */
  OCTOCELL_INTERNAL = 7          /* anything else */
} octocell_status;

typedef struct octocell_error {
  octocell_status status;
  uint64_t sphere;   /* for OCTOCELL_INVALID_SPHERE */
  char message[256]; /* one line; shortened if it does not fit */
} octocell_error;

typedef enum octocell_device { OCTOCELL_CPU = 0, OCTOCELL_CUDA = 1 } octocell_device;

/* Space that repeats (octocell.hpp, Options::box). */
typedef struct octocell_box {
  float vector[3][3]; /* one row each: x, y, z */
  int periodic[3];    /* not 0: the scene repeats along this vector */
} octocell_box;

/* |p_i - p_j + S H| <= r_i + r_j, where S are these numbers and H are the vectors of the box. */
typedef struct octocell_shift {
  int32_t a, b, c;
} octocell_shift;

/* Begin with OCTOCELL_OPTIONS and change what should differ. NULL options are OCTOCELL_OPTIONS. */
typedef struct octocell_options {
  size_t size;             /* of this struct, for later releases */
  int threads;             /* 0: all that this process may use */
  int sorted;              /* not 0: pairs are sorted by (i, j) */
  int device;              /* OCTOCELL_CPU or OCTOCELL_CUDA */
  const uint32_t* flags;   /* one word a sphere (octocell.hpp, Flags), or NULL */
  const octocell_box* box; /* copied; or NULL: space does not repeat */
  double cutoff;           /* is added to r_i + r_j */
  /* Called many times during a search, on the caller's thread, with `context`; if it returns
     nonzero, the search ends with OCTOCELL_STOPPED. NULL: never called. */
  int (*stop)(void* context);
  void* context;
} octocell_options;

#define OCTOCELL_OPTIONS \
  { sizeof(octocell_options), 0, 1, OCTOCELL_CPU, NULL, NULL, 0.0, NULL, NULL }

/* The release, for example "0.1.0". */
OCTOCELL_API const char* octocell_version(void);

/* A list of pairs. */
typedef struct octocell_pairs octocell_pairs;
OCTOCELL_API const octocell_pair* octocell_pairs_data(const octocell_pairs* pairs);
OCTOCELL_API size_t octocell_pairs_size(const octocell_pairs* pairs);
/* The shift of each pair; NULL if there was no box, or no pair. */
OCTOCELL_API const octocell_shift* octocell_pairs_shifts(const octocell_pairs* pairs);
OCTOCELL_API void octocell_pairs_free(octocell_pairs* pairs);

/* Finds all pairs of a scene. */
OCTOCELL_API octocell_status octocell_find_pairs(const octocell_sphere* spheres, size_t count,
                                                 const octocell_options* options,
                                                 octocell_pairs** pairs, octocell_error* error);

/* Finds all pairs of a sphere of one set with one of another: i is a position in `spheres`, j one
   in `others`. Flags cannot be used. */
OCTOCELL_API octocell_status octocell_find_pairs_between(
    const octocell_sphere* spheres, size_t count, const octocell_sphere* others, size_t other_count,
    const octocell_options* options, octocell_pairs** pairs, octocell_error* error);

/* Counts the pairs of a scene. Needs no memory for them. */
OCTOCELL_API octocell_status octocell_count(const octocell_sphere* spheres, size_t count,
                                            const octocell_options* options, uint64_t* pairs,
                                            octocell_error* error);

/* Finds the pairs of frame after frame; keeps its memory and its threads. With flags, `flag_count`
   is their number; they are copied. */
typedef struct octocell_finder octocell_finder;
OCTOCELL_API octocell_status octocell_finder_new(const octocell_options* options, size_t flag_count,
                                                 octocell_finder** finder, octocell_error* error);
/* The pairs are valid until the next call with this finder. */
OCTOCELL_API octocell_status octocell_finder_find(octocell_finder* finder,
                                                  const octocell_sphere* spheres, size_t count,
                                                  const octocell_pair** pairs, size_t* pair_count,
                                                  octocell_error* error);
/* Their shifts, valid as long; NULL without a box. */
OCTOCELL_API const octocell_shift* octocell_finder_shifts(const octocell_finder* finder);
/* Moves the pairs of the last octocell_finder_find() out. */
OCTOCELL_API octocell_status octocell_finder_take(octocell_finder* finder, octocell_pairs** pairs,
                                                  octocell_error* error);
OCTOCELL_API void octocell_finder_free(octocell_finder* finder);

/* The pairs of a scene, at most `pairs_per_chunk` at a time (more if one sphere i has more).
   Spheres and flags must stay as they are until octocell_chunks_free(). */
typedef struct octocell_chunks octocell_chunks;
OCTOCELL_API octocell_status octocell_chunks_new(const octocell_sphere* spheres, size_t count,
                                                 uint64_t pairs_per_chunk,
                                                 const octocell_options* options,
                                                 octocell_chunks** chunks, octocell_error* error);
/* The next chunk, to be freed; an empty one after the last. */
OCTOCELL_API octocell_status octocell_chunks_next(octocell_chunks* chunks, octocell_pairs** pairs,
                                                  octocell_error* error);
OCTOCELL_API void octocell_chunks_free(octocell_chunks* chunks);

/* How a list of pairs differs from the answer. The first pair of a kind is set if there is one. */
typedef struct octocell_verification {
  uint64_t missed, false_pairs, duplicates;
  octocell_pair first_missed, first_false, first_duplicate;
} octocell_verification;

/* Compares anyone's list with the answer, in any order; (j, i) counts as (i, j). */
OCTOCELL_API octocell_status octocell_verify(const octocell_sphere* spheres, size_t count,
                                             const octocell_pair* pairs, size_t pair_count,
                                             const octocell_options* options,
                                             octocell_verification* result, octocell_error* error);

/* How a scene would be searched, as text of several lines. */
typedef struct octocell_plan octocell_plan;
OCTOCELL_API octocell_status octocell_plan_new(const octocell_sphere* spheres, size_t count,
                                               const octocell_options* options,
                                               octocell_plan** plan, octocell_error* error);
OCTOCELL_API const char* octocell_plan_explain(const octocell_plan* plan);
OCTOCELL_API void octocell_plan_free(octocell_plan* plan);

#ifdef __cplusplus
}
#endif

#endif
