// SPDX-License-Identifier: MIT
#include "harness/files/real_scenes.hpp"

#include <filesystem>
#include <system_error>

namespace octocell {
namespace {

constexpr RealScene kRealScenes[] = {
    {"1A2C", "data/1A2C.pqr", 5'313, "a protein, each atom with its own radius"},
    {"adk_oplsaa", "data/adk_oplsaa.npy", 47'681, "a protein in water"},
    {"bigbox", "data/bigbox.npy", 132'303, "a box of water"},
    {"packing3d_bed", "data/real/packing3d_bed.npy", 96'685, "a bed of grains in a cylinder"},
    {"packing3d_cooling", "data/real/packing3d_cooling.npy", 24'000, "equal grains that touch"},
    {"packing3d_lattice", "data/real/packing3d_lattice.npy", 68'921,
     "a lattice, 20,172 pairs touch exactly"},
    {"hipparcos_stars", "data/real/hipparcos_stars.npy", 113'552, "stars, linked within 5 parsecs"},
    {"navis_neurons", "data/real/navis_neurons.npy", 23'221, "the nodes of five neurons"},
    {"curobo_robots", "data/real/curobo_robots.npy", 172'544, "256 robots side by side"},
    {"deme_wheel", "data/real/deme_wheel.npy", 32'540, "the surface of a rover's wheel"},
    {"voro_cylinder", "data/real/voro_cylinder.npy", 2'300, "equal spheres packed in a cylinder"},
    {"voro_torus", "data/real/voro_torus.npy", 2'393, "equal spheres packed in a torus"},
    {"voro_cube_poly", "data/real/voro_cube_poly.npy", 159, "spheres of many sizes packed in a cube"},
    {"lammps_discs", "data/real/lammps_discs.npy", 10'000, "discs, radii with a power law"},
};

}  // namespace

std::span<const RealScene> real_scenes() { return kRealScenes; }

bool is_there(const RealScene& scene) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(scene.path, ignored);
}

}  // namespace octocell
