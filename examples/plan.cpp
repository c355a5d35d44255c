// SPDX-License-Identifier: MIT
// How a scene would be searched, and why; and what an invalid scene says.
#include <cmath>
#include <iostream>
#include <octocell/octocell.hpp>
#include <vector>

int main() {
  std::vector<octocell::Sphere> spheres;
  for (int k = 0; k < 1000; ++k) spheres.push_back({static_cast<float>(3 * k), 0, 0, 1});
  std::cout << octocell::plan(spheres, {.threads = 1}).explain();

  spheres[41].x = std::nanf("");
  try {
    octocell::find_pairs(spheres);
  } catch (const octocell::Error& error) {
    if (error.kind() == octocell::ErrorKind::invalid_sphere)
      spheres.erase(spheres.begin() + *error.sphere());
    std::cout << error.what() << '\n';
  }
  std::cout << spheres.size() << " spheres are left\n";
}
