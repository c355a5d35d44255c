// SPDX-License-Identifier: MIT
#include "harness/cli/find_images.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/images/periodic_box.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/files/decimal.hpp"
#include "harness/files/json_text.hpp"
#include "harness/files/save.hpp"

namespace octocell::cli {
namespace {

constexpr std::string_view kAxes = "xyz";

std::vector<float> numbers_of(const std::string& text) {
  std::vector<float> numbers;
  std::string_view rest = text;
  for (;;) {
    const std::size_t comma = rest.find(',');
    const DecimalFloat number = parse_float(rest.substr(0, comma));
    if (number.kind != DecimalFloat::Kind::number) {
      throw InputError(fmt::format("--box {}: '{}' is not a float32", text, rest.substr(0, comma)));
    }
    numbers.push_back(number.value);
    if (comma == std::string_view::npos) return numbers;
    rest.remove_prefix(comma + 1);
  }
}

/// Reads 1 number (a cube), 3 (a cuboid) or 9 (three vectors).
Box box_of(const std::string& text) {
  const std::vector<float> n = numbers_of(text);
  Box box = {};
  if (n.size() == 9) {
    for (std::size_t k = 0; k < 9; ++k) box.vector[k / 3][k % 3] = n[k];
  } else if (n.size() == 1 || n.size() == 3) {
    for (std::size_t a = 0; a < 3; ++a) box.vector[a][a] = n[n.size() == 1 ? 0 : a];
  } else {
    throw InputError(
        fmt::format("--box {}: {} numbers; must be 1 (a cube), 3 (a cuboid) or 9 (three vectors)",
                    text, n.size()));
  }
  return box;
}

void set_periodic(Box& box, const std::string& axes) {
  std::ranges::fill(box.periodic, false);
  for (const char axis : axes) {
    const std::size_t a = kAxes.find(axis);
    if (a == std::string_view::npos || box.periodic[a]) {
      throw InputError(
          fmt::format("--periodic {}: must name vectors of the box: x, y, z, each once", axes));
    }
    box.periodic[a] = true;
  }
  if (axes.empty()) throw InputError("--periodic: names no vector of the box: x, y, z");
}

std::string axes_of(const Box& box) {
  std::string axes;
  for (std::size_t a = 0; a < 3; ++a) {
    if (box.periodic[a]) axes += kAxes[a];
  }
  return axes;
}

struct ImageReport {
  const Scene& scene;
  const ImageOptions& options;
  const Implementation& how;
  images::Question question;
  images::ImagePairs found;
  double total_ms;
};

nlohmann::ordered_json to_json(const ImageReport& report) {
  nlohmann::ordered_json json = {{"scene", report.scene.spec},
                                 {"n", report.scene.spheres.size()},
                                 {"backend", report.how.backend->name}};
  if (report.options.box) {
    json["box"] = report.question.box.vector;
    json["periodic"] = axes_of(report.question.box);
  }
  json["cutoff"] = report.question.gap;
  json["images"] = report.found.images;
  json["compared_directly"] = report.found.compared_directly;
  json["pairs"] = report.found.count;
  json["total_ms"] = report.total_ms;
  return json;
}

void print_text(const ImageReport& report) {
  fmt::print("scene       {} ({} spheres{})\n", report.scene.spec, report.scene.spheres.size(),
             report.scene.flags.empty() ? "" : " with flags");
  if (report.options.box) {
    const auto& v = report.question.box.vector;
    fmt::print("box         ({})  ({})  ({}), repeats along {}\n", fmt::join(v[0], ", "),
               fmt::join(v[1], ", "), fmt::join(v[2], ", "), axes_of(report.question.box));
  }
  if (report.question.gap != 0.0) fmt::print("cutoff      {}\n", report.question.gap);
  if (report.found.compared_directly) {
    fmt::print("search      each two spheres compared\n");
  } else {
    fmt::print("search      {}, with {} images\n", report.how.label(), report.found.images);
  }
  if (report.how.has_known_issues()) {
    fmt::print("            may lose pairs: {}\n", report.how.backend->known_issues);
  }
  fmt::print("pairs       {}\n", report.found.count);
  fmt::print("total       {:.3f} ms\n", report.total_ms);
}

}  // namespace

void add_image_options(CLI::App& sub, ImageOptions& options) {
  sub.add_option("--box", options.box,
                 "Let the scene repeat: a side, three sides, or three vectors as nine numbers, "
                 "separated by commas");
  sub.add_option("--periodic", options.periodic, "Along which vectors of the box (default xyz)");
  sub.add_option("--cutoff", options.cutoff, "Is added to the sum of two radii (default 0)");
  sub.add_option("--shifts", options.shifts,
                 "Write in which image each pair meets: NPY, (M, 3) int32, in the pairs' order");
}

images::Question question_of(SceneView scene, const ImageOptions& options) {
  images::Question question = {.scene = scene, .gap = options.cutoff};
  if (options.box) {
    question.box = box_of(*options.box);
    if (options.periodic) set_periodic(question.box, *options.periodic);
  } else if (options.periodic || options.shifts) {
    throw InputError(
        fmt::format("{}: there is no --box", options.periodic ? "--periodic" : "--shifts"));
  }
  images::require_valid(question);
  prepare(question.box);  // or refuses
  return question;
}

int find_images(const Scene& scene, const ImageOptions& options, const Implementation& how,
                const PlanOptions& plan_options, const ImageOutputs& outputs) {
  if (how.negative_control()) {
    throw InputError(
        fmt::format("{} can be wrong; --box and --cutoff need what is exact", how.label()));
  }
  const std::unique_ptr<PairFinder> finder = how.backend->create();
  PlanOptions open = plan_options;
  open.count_only = false;
  images::ImageFinder images(plan_options.threads);
  HostClock clock(Marks::off);
  clock.start();
  images::ImagePairs found =
      images.find(question_of(scene.view(), options), {.sorted = true, .count_only = outputs.count},
                  [&](SceneView enclosing) {
                    find_completely(*finder, enclosing, open);
                    return finder->take_pairs();
                  });
  const ImageReport report = {.scene = scene,
                              .options = options,
                              .how = how,
                              .question = question_of(scene.view(), options),
                              .found = std::move(found),
                              .total_ms = clock.stop().total_ms};
  save_image_pairs(
      outputs.pairs.value_or(""), {report.found.pairs.items.data(), report.found.pairs.count},
      options.shifts.value_or(""), {report.found.shifts.data(), report.found.pairs.count});
  if (outputs.json) {
    fmt::print("{}\n", json_text(to_json(report), 2));
  } else {
    print_text(report);
  }
  return 0;
}

}  // namespace octocell::cli
