// SPDX-License-Identifier: MIT
// The planted faults, in the order of what they break. Each name occurs in exactly one other place,
// in OCTOCELL_FAULT, on the line that it breaks; tests/mutation/test_mutation.py checks that.
#pragma once

#include <cstdint>

// clang-format off
#define OCTOCELL_FAULT_TABLE(fault) \
  /* The predicate. */ \
  fault(filter_growth_too_small, "radii grow by 4u, not 6u, before float32 compares them") \
  fault(filter_sure_fraction_too_large, "float32 is sure below 1 - 22u, not 1 - 24u") \
  fault(filter_no_radius_floor, "tiny radii may square to zero in the safe filter") \
  fault(filter_no_sure_floor, "the safe filter is sure where squares have lost bits") \
  fault(filter_touching_apart, "< for <= in float32: points that are one are apart") \
  fault(float64_bound_too_small, "float64 trusts itself to 1 U, not 10 U") \
  fault(float64_touching_apart, "< for <= in float64: spheres that touch are apart") \
  fault(two_sum_error_dropped, "the error term of TwoSum is taken for zero") \
  fault(integer_add_carry_dropped, "no carry from limb to limb in a sum") \
  fault(integer_square_carry_dropped, "no carry past the row of a product") \
  fault(integer_touching_apart, "< for <= in integers: spheres that touch are apart") \
  fault(subnormal_as_normal, "subnormal numbers get the hidden bit") \
  /* Flags. */ \
  fault(flags_one_way, "only one of the two masks is asked") \
  fault(flags_search_given_up, "the masks of static spheres do not count when the search is skipped") \
  /* The grid and the plan. */ \
  fault(grid_truncates, "trunc for floor: two cells meet in one at zero") \
  fault(grid_no_upper_clamp, "coordinates above the box are not clamped") \
  fault(grid_reciprocal_rounded_down, "the reciprocal of a cell's width is one too small") \
  fault(grid_id_not_wrapped, "x is not reduced to its period in an id") \
  fault(grid_period_too_short, "a wrapped axis may have a period of 2") \
  fault(grid_cell_rounded_down, "cells a unit narrower than asked for") \
  fault(column_reach_rounded_down, "a diameter's columns, rounded down") \
  fault(level_radius_of_last, "a size class goes by its last radius, not its largest") \
  fault(key_bits_one_short, "the key has a bit less than the greatest id") \
  fault(fast_filter_for_tiny_radii, "the fast filter is chosen without a look at the smallest radius") \
  fault(chapter32_extent_rounded_down, "sqrt 2 rounded down") \
  fault(chapter32_counts_twice, "the home of only one of the two may come first") \
  /* impl_cpu, stage by stage. */ \
  fault(bounds_radius_unchecked, "the largest radius is not compared with the plan's") \
  fault(bounds_last_spheres_unseen, "the last one to four spheres are not looked at") \
  fault(cells_without_p_plus_r, "the highest cell is that of p, not of p + r") \
  fault(cells_without_last_corner, "the eighth corner's cell is not listed") \
  fault(cells_last_column_missing, "< for <= in the cells of a large sphere") \
  fault(order_unchecked_between_blocks, "ids sorted within blocks count as sorted") \
  fault(sort_last_digit_skipped, "the highest digit is not sorted by") \
  fault(sort_unstable, "the parts of the input change places") \
  fault(index_last_cell_missing, "the last cell is not listed") \
  fault(index_row_lost_between_blocks, "a row that begins with a block is not listed") \
  fault(index_blocks_left_over, "blocks count that only an earlier frame had spheres for") \
  fault(lowest_cell_rule_dropped, "a pair counts in every cell that both meet") \
  fault(lanes_touching_apart, "< for <= in lanes: spheres that touch are apart") \
  fault(tile_pairs_with_self, "a sphere is tested against itself") \
  fault(tile_last_missing, "the last tile of a crowded cell is not tested") \
  fault(shell_row_missing, "one of the four neighbouring rows is not visited") \
  fault(border_distance_short, "only spheres within a radius of a row's border have partners beyond") \
  fault(border_of_first_sphere, "a wrapped row is taken to hold the cell of its first sphere") \
  fault(shell_seam_not_crossed, "the first columns of a wrapped row miss the last") \
  fault(shell_last_lane_missing, "the last lane of a vector is masked out") \
  fault(flags_unasked_in_sink, "pairs are kept whatever their flags") \
  fault(uncertain_pairs_taken_as_pairs, "what float32 cannot decide counts as overlap") \
  fault(uncertain_pairs_after_first_block_lost, "stage 6 decides the first 4096 uncertain pairs only") \
  fault(uncertain_pairs_uncounted, "count_only plans leave uncertain pairs out") \
  /* Its lists. */ \
  fault(list_clips_at_capacity, "a full list says that it holds all there is") \
  fault(list_one_short_of_full, "a list that is just full keeps no more") \
  fault(list_last_block_lost, "a writer does not flush at its end") \
  fault(list_counts_31_bits, "pairs are counted in 31 bits") \
  /* Its frames. */ \
  fault(frame_ignores_radius, "a changed radius goes unnoticed") \
  fault(frame_ignores_last_of_block, "the last sphere of a block is not compared") \
  fault(frame_keeps_flags, "changed flags go unnoticed") \
  fault(frame_skin_twice_too_wide, "spheres may move by the whole skin, not half") \
  fault(frame_statics_unseen, "static spheres are taken to stand") \
  fault(frame_box_unseen, "neighbor pairs are taken to keep the plan's facts") \
  fault(frame_movers_stay_in_order, "movers are met where they were, too") \
  fault(frame_pairs_of_movers_stand, "pairs are dropped if the first of the two moved") \
  fault(frame_movers_not_forgotten, "marks of movers outlive the search of all") \
  /* impl_thrust. */ \
  fault(thrust_shell_row_missing, "one of the neighbouring rows is not visited") \
  fault(thrust_last_cell_short, "the last cell misses its last sphere") \
  fault(thrust_lowest_cell_rule_dropped, "a pair counts in every cell that both meet") \
  fault(thrust_uncertain_pairs_taken_as_pairs, "what float32 cannot decide counts as overlap") \
  /* Files. */ \
  fault(text_last_line_lost, "a last line without a line break is not read") \
  /* impl_cuda_custom. */ \
  fault(cuda_stale_look_back, "all passes of the sort share one meaning of the look-back flags") \
  fault(cuda_order_left_behind, "ids that come in order stay on the side where they are") \
  fault(cuda_column_reach_short, "a column of the neighbouring rows is missing") \
  fault(cuda_layer_missing, "the row above is met instead of the layer behind") \
  fault(cuda_blocks_missing, "half of the spheres have no thread") \
  fault(cuda_uncertain_pairs_in_pairs_counter, "uncertain pairs are counted with the pairs") \
  fault(cuda_prediction_kept, "a frame has the frame mode of the last, whatever it finds")
// clang-format on

namespace octocell::faults {

enum class Fault : std::uint8_t {
  none,
#define OCTOCELL_FAULT_NAME(name, what) name,
  OCTOCELL_FAULT_TABLE(OCTOCELL_FAULT_NAME)
#undef OCTOCELL_FAULT_NAME
};

/// By the environment, before main().
extern const Fault chosen;

}  // namespace octocell::faults
