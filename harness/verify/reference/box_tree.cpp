// SPDX-License-Identifier: MIT
// Boxes are p - r and p + r in float64. Rounding is monotone and comparisons include equality. So
// the boxes of overlapping spheres meet, however they were rounded: p - r <= q + s implies fl(p -
// r) <= fl(q + s).
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/available_memory.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::reference {
namespace {

constexpr std::size_t kLeafSpheres = 8;

struct Box {
  std::array<double, 3> low;
  std::array<double, 3> high;

  [[nodiscard]] bool meets(const Box& other) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (low[a] > other.high[a] || other.low[a] > high[a]) return false;
    }
    return true;
  }
  void include(const Box& other) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], other.low[a]);
      high[a] = std::max(high[a], other.high[a]);
    }
  }
};

template <typename SphereType>
Box box_of(const SphereType& s) {
  const double r = s.r;
  return {{s.x - r, s.y - r, s.z - r}, {s.x + r, s.y + r, s.z + r}};
}

/// A node covers order[begin, end). The children of node k are nodes 2k + 1 and 2k + 2.
template <typename SphereType>
class BoxTree {
 public:
  BoxTree(std::span<const SphereType> spheres, AllFlags flags)
      : spheres_(spheres), flags_(flags), order_(spheres.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!order_.empty()) build(0, 0, order_.size());
  }

  std::vector<Pair> join() {
    if (!order_.empty()) join_node(0);
    std::sort(pairs_.begin(), pairs_.end());
    return std::move(pairs_);
  }

 private:
  struct Node {
    Box box;
    std::size_t begin;
    std::size_t end;
    [[nodiscard]] bool leaf() const { return end - begin <= kLeafSpheres; }
  };

  Box build(std::size_t node, std::size_t begin, std::size_t end) {
    if (nodes_.size() <= node) nodes_.resize(2 * node + 3);
    Box box = box_of(spheres_[order_[begin]]);
    for (std::size_t k = begin + 1; k < end; ++k) box.include(box_of(spheres_[order_[k]]));
    nodes_[node] = {box, begin, end};
    if (nodes_[node].leaf()) return box;
    const std::size_t middle = begin + (end - begin) / 2;
    split_at_median(begin, middle, end);
    build(2 * node + 1, begin, middle);
    build(2 * node + 2, middle, end);
    return box;
  }

  /// Splits along the axis on which the centres are spread most.
  void split_at_median(std::size_t begin, std::size_t middle, std::size_t end) {
    const auto centre = [this](std::uint32_t i, int axis) -> double {
      const SphereType& s = spheres_[i];
      return axis == 0 ? s.x : axis == 1 ? s.y : s.z;
    };
    int widest = 0;
    double spread = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
      double low = centre(order_[begin], axis);
      double high = low;
      for (std::size_t k = begin; k < end; ++k) {
        low = std::min(low, centre(order_[k], axis));
        high = std::max(high, centre(order_[k], axis));
      }
      if (high - low > spread) {
        spread = high - low;
        widest = axis;
      }
    }
    const auto at = [this](std::size_t k) { return order_.begin() + static_cast<long>(k); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t i, std::uint32_t j) {
      return centre(i, widest) < centre(j, widest);
    });
  }

  void join_node(std::size_t node) {
    if (nodes_[node].leaf()) return join_leaf(nodes_[node]);
    join_node(2 * node + 1);
    join_node(2 * node + 2);
    join_nodes(2 * node + 1, 2 * node + 2);
  }

  void join_nodes(std::size_t a, std::size_t b) {
    const Node& first = nodes_[a];
    const Node& second = nodes_[b];
    if (!first.box.meets(second.box)) return;
    if (first.leaf() && second.leaf()) return join_leaves(first, second);
    const bool descend_second =
        first.leaf() || (!second.leaf() && second.end - second.begin > first.end - first.begin);
    if (descend_second) {
      join_nodes(a, 2 * b + 1);
      join_nodes(a, 2 * b + 2);
      return;
    }
    join_nodes(2 * a + 1, b);
    join_nodes(2 * a + 2, b);
  }

  void join_leaf(const Node& node) {
    for (std::size_t i = node.begin; i < node.end; ++i) {
      for (std::size_t j = i + 1; j < node.end; ++j) test(order_[i], order_[j]);
    }
  }

  void join_leaves(const Node& a, const Node& b) {
    for (std::size_t i = a.begin; i < a.end; ++i) {
      for (std::size_t j = b.begin; j < b.end; ++j) test(order_[i], order_[j]);
    }
  }

  void test(std::uint32_t i, std::uint32_t j) {
    if (!flags_.empty() && !allowed(flags_[i], flags_[j])) return;
    if (overlap(spheres_[i], spheres_[j])) {
      append_within_memory(pairs_, make_pair_of(i, j), "the exact pairs");
    }
  }

  std::span<const SphereType> spheres_;
  AllFlags flags_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  std::vector<Pair> pairs_;
};

}  // namespace

std::vector<Pair> box_tree(std::span<const Sphere> spheres, AllFlags flags) {
  return BoxTree<Sphere>(spheres, flags).join();
}

std::vector<Pair> box_tree(std::span<const DoubleSphere> spheres, AllFlags flags) {
  return BoxTree<DoubleSphere>(spheres, flags).join();
}

}  // namespace octocell::reference
