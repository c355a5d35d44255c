// SPDX-License-Identifier: MIT
// Stage 5 where only spheres that are not static may have moved: a thread a mover, against the nine
// rows around it of the static spheres' order, and against the movers of half of the cells around.
// Each pair with a mover is met once (docs/exactness.md: rows without borders).
#include "impl_cuda_custom/coherence/movers.cuh"

#include "impl_cuda_custom/coherence/frames.cuh"
#include "impl_cuda_custom/half_shell/neighbours.cuh"
#include "impl_cuda_custom/pair_sinks.cuh"

namespace octocell::cuda_custom::coherence {
namespace {

/// A block's part of the work, so that there are enough of them: three of the nine rows of static
/// spheres, or the movers.
constexpr unsigned kRowsOfPart = 3;
constexpr unsigned kParts = half_shell::kRowsAround / kRowsOfPart + 1;

struct Job {
  Movers movers;
  half_shell::CellStarts starts;
  const Sphere* sorted;   // with band radii
  const Object* objects;  // their ids
  Band band;
  std::uint32_t sphere_count;
  SinkArguments sink;
  Kept* kept;

  [[nodiscard]] __device__ Sphere with_band_radius(Sphere s) const {
    s.r = band == Band::fast ? band_radius<Band::fast>(s.r) : band_radius<Band::safe>(s.r);
    return s;
  }
};

/// A mover, and what its warp finds.
class Search {
 public:
  __device__ Search(const Job& job, Keep& sink, std::uint32_t m) : job_(job), sink_(sink), m_(m) {
    present_ = m < job.kept->mover_count;
    if (!present_) return;
    id_ = job.movers.ids[m];
    cell_ = job.movers.cells[m];
    sphere_ = job.with_band_radius(load_sphere(job.sink.spheres, id_));
  }

  /// All lanes of the warp call these.
  __device__ void meet_static(int row) {
    using half_shell::Run;
    const Level& level = job_.movers.level;
    const Run run = present_ ? half_shell::open_run(job_.starts, level, cell_,
                                                    half_shell::row_around(row), level.reach)
                             : Run{0, 0};
    const std::uint32_t longest = max_over_warp(run.size());
    for (std::uint32_t k = 0; k < longest; ++k) {
      const bool here = k < run.size();
      const std::uint32_t place = here ? run.begin + k : 0;
      const Sphere other = load_sphere(job_.sorted, place);
      bool may = here && band_may_overlap(sphere_, other);
      const std::uint32_t id = may ? job_.objects[place] : 0;
      may = may && is_static(job_.sink.flags[id]);
      take(may, other, id);
    }
    candidates_ += run.size();
  }

  __device__ void meet_movers() {
    const auto reach = static_cast<std::int64_t>(job_.movers.level.reach);
    const Grid& grid = job_.movers.level.grid;
    for (int row = 0; row < half_shell::kShellRows; ++row) {
      const half_shell::RowStep step = half_shell::shell_row(row);
      const std::int64_t middle = std::int64_t{cell_} + step.y * std::int64_t{grid.stride_y} +
                                  step.z * std::int64_t{grid.stride_z};
      for (std::int64_t k = row == 0 ? 0 : -reach; k <= reach; ++k) meet_cell(middle + k);
    }
  }
  [[nodiscard]] __device__ std::uint64_t candidates() const { return candidates_; }

 private:
  /// Of its own cell it meets those with greater ids.
  __device__ void meet_cell(std::int64_t wanted) {
    const bool exists = present_ && wanted >= 0 && wanted < job_.movers.level.ids;
    const auto cell = static_cast<std::uint32_t>(exists ? wanted : 0);
    std::uint32_t other = exists ? job_.movers.first_of(cell, frame()) : Movers::kNone;
    while (__any_sync(kAllLanes, other != Movers::kNone)) {
      const bool here = other != Movers::kNone && job_.movers.cells[other] == cell;
      const std::uint32_t id = here ? job_.movers.ids[other] : 0;
      const bool meets = here && (cell != cell_ || id > id_);
      const Sphere sphere = job_.with_band_radius(load_sphere(job_.sink.spheres, id));
      take(meets && band_may_overlap(sphere_, sphere), sphere, id);
      candidates_ += meets ? 1 : 0;
      if (other != Movers::kNone) other = job_.movers.next[other];
    }
  }

  __device__ void take(bool may, const Sphere& other, std::uint32_t id) {
    if (!__any_sync(kAllLanes, may)) return;
    const bool sure = may && (job_.band == Band::fast ? band_is_sure<Band::fast>(sphere_, other)
                                                      : band_is_sure<Band::safe>(sphere_, other));
    const Verdict verdict = !may ? Verdict::apart : sure ? Verdict::overlap : Verdict::doubt;
    sink_.take(verdict, make_pair_of(id_, id));
  }

  /// The number under which this frame's first kernel has placed the movers.
  [[nodiscard]] __device__ std::uint64_t frame() const { return job_.kept->frames - 1; }

  const Job& job_;
  Keep& sink_;
  std::uint32_t m_;
  bool present_ = false;
  std::uint32_t id_ = 0;
  std::uint32_t cell_ = 0;
  Sphere sphere_ = {};
  std::uint64_t candidates_ = 0;
};

/// A search has put all spheres in order; which of them are movers?
__device__ void list_movers(const Job& job) {
  __shared__ std::uint32_t place;
  const std::uint32_t block = blockIdx.y * gridDim.x + blockIdx.x;
  const std::uint32_t stride = gridDim.x * gridDim.y * kBlockThreads;
  for (std::uint32_t begin = block * kBlockThreads; begin < job.sphere_count; begin += stride) {
    const std::uint32_t i = begin + threadIdx.x;
    const bool moves = i < job.sphere_count && !is_static(job.sink.flags[i]);
    const Scan scan = scan_over_block(moves ? 1 : 0);
    if (threadIdx.x == 0) {
      place = atomicAdd(&job.kept->mover_count, static_cast<std::uint32_t>(scan.total));
    }
    __syncthreads();
    if (moves && place + scan.before < job.movers.room) job.movers.ids[place + scan.before] = i;
    __syncthreads();  // place may be written again
  }
}

/// Blocks (x, y): movers x, part y.
__global__ void __launch_bounds__(kBlockThreads, 4) movers_kernel(const __grid_constant__ Job job) {
  __shared__ Keep::Shared shared;
  const Course course = job.sink.state->course;
  if (course == Course::search) return list_movers(job);
  if (course != Course::movers) return;
  Keep sink(job.sink, shared);
  Search search(job, sink, blockIdx.x * kBlockThreads + threadIdx.x);
  if (blockIdx.y + 1 == kParts) {
    search.meet_movers();
  } else {
    for (unsigned k = 0; k < kRowsOfPart; ++k) {
      search.meet_static(static_cast<int>(blockIdx.y * kRowsOfPart + k));
    }
  }
  sink.close();
  add_over_block(&job.sink.state->candidates, search.candidates());
}

}  // namespace

void test_movers(Workspace& w) {
  const Job job = {.movers = movers_of(w),
                   .starts = half_shell::starts_of(w),
                   .sorted = w.sorted_spheres.data(),
                   .objects = w.sorted().values,
                   .band = band_of(w.plan.test),
                   .sphere_count = static_cast<std::uint32_t>(w.sphere_count()),
                   .sink = sink_arguments_of(w),
                   .kept = w.kept.data()};
  const dim3 movers_by_parts(blocks_for(w.mover_room), kParts);
  movers_kernel<<<movers_by_parts, kBlockThreads, 0, w.stream>>>(job);
  cuda::check_launch();
}

}  // namespace octocell::cuda_custom::coherence
