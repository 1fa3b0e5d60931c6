// Every effect: rays in waves of a chunk, from the camera to what they meet, to the lights, and on.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "renderer/accelerator.hpp"
#include "renderer/filter.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/kernels/lights.hpp"
#include "renderer/lights/environment.hpp"
#include "renderer/reflector.hpp"
#include "renderer/work.hpp"

namespace lobelia {

/// A sample of a pixel.
struct PixelSample {
  int x = 0, y = 0;
  std::uint32_t index = 0;
};

/// What a camera ray found.
struct SampleResult {
  Rgb radiance;      ///< not weighted
  bool negative;     ///< drawn from the filter's negative part
  int surface = -1;  ///< that the camera ray met: spheres, then planes; -1 none
};

class WaveRenderer {
 public:
  /// Both must outlive it.
  WaveRenderer(const Scene& scene, const Plan& plan);
  ~WaveRenderer();

  /// The buffers of one thread.
  struct Workspace;
  struct WorkspaceDeleter {
    void operator()(Workspace*) const;
  };
  using WorkspacePointer = std::unique_ptr<Workspace, WorkspaceDeleter>;
  static WorkspacePointer make_workspace();
  static Work& work_of(Workspace&);

  /// At most kChunk samples; one result each.
  void render(std::span<const PixelSample> samples, std::span<SampleResult> results,
              Workspace& workspace) const;

  const FilterSampler& filter() const { return filter_; }

 private:
  struct Wave;
  struct PreparedMaterial;
  struct Group;

  void camera_wave(std::span<const PixelSample> samples, std::span<SampleResult> results,
                   Workspace& work) const;
  void follow(Wave& wave, Workspace& work) const;
  void trace(Wave& wave, Workspace& work) const;
  void add_emitters(Wave& wave, Workspace& work) const;
  void shade(Wave& wave, Workspace& work) const;
  void shade_group(Wave& wave, Group group, std::size_t hits, Workspace& work) const;
  void light_delta(const Wave& wave, Group group, std::size_t light, std::size_t hits,
                   Workspace& work) const;
  void light_sized(const Wave& wave, Group group, std::size_t light, std::size_t hits,
                   Workspace& work) const;
  void find_visible(std::size_t light, Group group, std::size_t hits, Workspace& work) const;
  void add_light(Group group, Precision precision, Rgb emitted, const Rgb* tints, std::size_t hits,
                 Workspace& work) const;
  void hide_behind_planes(std::size_t light, std::size_t hits, Workspace& work) const;
  void spawn_mirror(const Wave& wave, Group group, bool one_of_two, std::size_t hits,
                    Workspace& work) const;
  void spawn_scattered(const Wave& wave, Group group, bool one_of_two, std::size_t hits,
                       Workspace& work) const;
  void sample_light(std::size_t light, std::size_t hits, Workspace& work) const;

  const Scene& scene_;
  const Plan& plan_;
  const KernelTable& kernels_ = kernels();
  CameraFrame frame_;
  FilterSampler filter_;
  std::vector<PreparedMaterial> materials_;
  std::vector<std::unique_ptr<Environment>> environments_;    ///< by light; null for others
  std::vector<std::optional<PreparedRectangle>> rectangles_;  ///< by light; none for others
  std::vector<Vec3> plane_u_, plane_v_;                       ///< of each plane's checker
  std::unique_ptr<Accelerator> accelerator_;                  ///< null where a loop is faster
  bool one_by_one_;  ///< surfaces are shaded each by itself, so that each has its own occluders
  bool any_sized_ = false;
};

}  // namespace lobelia
