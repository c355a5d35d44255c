// SPDX-License-Identifier: MIT
// RapidCheck's default is 100 cases, new ones each time. Here there are many, the same for
// everyone; RC_PARAMS="max_success=1000000" in the environment sets others.
#include <cstdlib>

namespace {

[[maybe_unused]] const int kParametersSet =
    setenv("RC_PARAMS", "seed=1 max_success=50000 max_discard_ratio=100", /*replace=*/0);

}  // namespace
