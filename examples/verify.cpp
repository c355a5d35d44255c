// SPDX-License-Identifier: MIT
// Is a list of pairs right? For lists of any origin.
#include <iostream>
#include <octocell/octocell.hpp>
#include <vector>

int main() {
  const std::vector<octocell::Sphere> spheres = {
      {0, 0, 0, 1}, {3.5, 3, 0, 1}, {5, 2, 0, 1}, {5, 4, 0, 1}};
  const std::vector<octocell::Pair> anyones = {{3, 1}, {2, 3}, {1, 3}, {0, 1}};

  const octocell::Verification result = octocell::verify(spheres, anyones);
  std::cout << (result.exact() ? "exact\n" : "not exact\n") << "missed " << result.missed
            << ", the first " << result.first_missed->i << ' ' << result.first_missed->j << '\n'
            << "false " << result.false_pairs << ", the first " << result.first_false->i << ' '
            << result.first_false->j << '\n'
            << "repeated " << result.duplicates << '\n';
}
