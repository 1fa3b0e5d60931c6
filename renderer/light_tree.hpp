// One of many lights, drawn with a probability that follows what it can bring to a point (Conty Estevez and Kulla 2018,
// "Importance sampling of many lights with adaptive tree splitting"; here without splitting and without cones of normals).
//
// A binary tree of boxes around the lights. A draw goes down from the root, at each node to one of its two parts by
// their bounds: power over the square of the distance, 0 below the surface's horizon. So a draw takes as many steps as
// the number of lights has binary digits, and a light that can bring something is drawn sometimes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/words/vec.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/scene/lights/lights.hpp"

namespace lobelia {

class LightTree {
 public:
  /// A tree of the lights at these indices that shine: all are delta lights, or all are area lights. `closeness` is the
  /// scene's (renderer/scene/contact.hpp).
  LightTree(const std::vector<Light>& lights, std::span<const int> indices, double closeness);

  struct Choice {
    int light = -1;          ///< index in the scene; -1: no light reaches the point
    double probability = 0;  ///< over 0 if there is a light
  };
  /// A light for a point of a surface and its normal, by a random number in [0, 1).
  Choice choose(Vec3 point, Vec3 normal, double u) const;
  /// The probability with which choose() draws the light.
  double probability(int light, Vec3 point, Vec3 normal) const;

  /// The rays of a chunk, and the distances up to which they look for lights.
  struct Rays {
    const Vec3Chunk& origin;
    const Vec3Chunk& to_eye;  ///< rays run opposite to it
    const double* distance;
  };
  /// Calls meet(light, rays) for each area light that some of the rays may meet, with their indices.
  template <class Meet>
  void find_met(const Rays& rays, std::span<const int> indices, const Meet& meet) const;

 private:
  struct Node {
    Vec3 center, half;  ///< of a box; of the directions to distant lights
    double power = 0;   ///< intensity; irradiance of distant lights
    Vec3 normal;        ///< of a light that shines to one side; zero for others
    bool is_distant = false;
    int light = -1;  ///< of a leaf
    int second = 0;  ///< the first part follows its node
  };
  struct Ray {
    Vec3 origin, inverse;  ///< of each component of the direction
    double distance;
  };
  void build(std::span<Node> leaves);
  static double importance(const Node& node, Vec3 point, Vec3 normal);
  /// The share of a node's first part; negative if neither can bring anything.
  double first_share(std::size_t node, Vec3 point, Vec3 normal) const;
  Ray ray_of(const Rays& rays, int index) const;
  bool crosses(const Ray& ray, const Node& node) const;

  std::vector<Node> nodes_;
  std::vector<int> leaf_of_;  ///< by light; -1: not in the tree
  std::vector<int> parent_;   ///< by node; -1 of the root
  double slack_;              ///< of boxes, for rays
};

template <class Meet>
void LightTree::find_met(const Rays& rays, std::span<const int> indices, const Meet& meet) const {
  if (nodes_.empty()) return;
  std::vector<Ray> all(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) all[i] = ray_of(rays, indices[i]);
  // The nodes to look at, each with the rays that cross its parent's box: a stack.
  struct Task {
    std::size_t node, begin, end;
  };
  std::vector<std::uint16_t> kept(indices.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = std::uint16_t(i);
  std::vector<Task> tasks{{0, 0, kept.size()}};
  std::vector<int> found;
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const Node& node = nodes_[task.node];
    // Later tasks need only the entries before task.end.
    kept.resize(task.end);
    for (std::size_t k = task.begin; k < task.end; ++k)
      if (const std::uint16_t i = kept[k]; crosses(all[i], node)) kept.push_back(i);
    if (kept.size() == task.end) continue;
    if (node.light < 0) {
      tasks.push_back({std::size_t(node.second), task.end, kept.size()});
      tasks.push_back({task.node + 1, task.end, kept.size()});
      continue;
    }
    found.clear();
    for (std::size_t k = task.end; k < kept.size(); ++k) found.push_back(indices[kept[k]]);
    meet(node.light, std::span<const int>(found));
  }
}

}  // namespace lobelia
