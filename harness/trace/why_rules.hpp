// SPDX-License-Identifier: MIT
// Where two spheres meet, one function for each way to cut space. Each fills in the cells, the
// meetings and the number of tests of an account.
#pragma once

#include "harness/trace/why.hpp"

namespace octocell::trace {

/// Rules lowest_cell and chapter32.
void meet_in_cells(Account& account, const Plan& plan);

/// Rule as_written; also names the flaw if the answer is wrong.
void meet_as_written(Account& account, const Plan& plan);

/// Method half_shell.
void meet_in_rows(Account& account, const Plan& plan);

/// Method tiles.
void meet_in_tiles(Account& account, const Plan& plan);

}  // namespace octocell::trace
