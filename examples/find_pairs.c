/* SPDX-License-Identifier: MIT
   All pairs of a scene, in C. */
#include <octocell/octocell.h>
#include <stdio.h>

int main(void) {
  const octocell_sphere spheres[] = {{0, 0, 0, 1}, {3.5F, 3, 0, 1}, {5, 2, 0, 1}, {5, 4, 0, 1}};
  octocell_pairs* pairs = NULL;
  octocell_error error;
  if (octocell_find_pairs(spheres, 4, NULL, &pairs, &error) != OCTOCELL_OK) {
    fprintf(stderr, "%s\n", error.message);
    return 1;
  }
  for (size_t k = 0; k < octocell_pairs_size(pairs); ++k) {
    const octocell_pair pair = octocell_pairs_data(pairs)[k];
    printf("%u %u\n", (unsigned)pair.i, (unsigned)pair.j);
  }
  octocell_pairs_free(pairs);
  return 0;
}
