#include "renderer/accelerator.hpp"

#include <embree3/rtcore.h>

#include "base/system/error.hpp"
#include "base/system/module.hpp"
#include "renderer/chord.hpp"

namespace lobelia {
namespace {

LOBELIA_MODULE_FUNCTION(embree_module, rtcAttachGeometry);
LOBELIA_MODULE_FUNCTION(embree_module, rtcCommitGeometry);
LOBELIA_MODULE_FUNCTION(embree_module, rtcCommitScene);
LOBELIA_MODULE_FUNCTION(embree_module, rtcGetDeviceError);
LOBELIA_MODULE_FUNCTION(embree_module, rtcIntersect1);
LOBELIA_MODULE_FUNCTION(embree_module, rtcNewDevice);
LOBELIA_MODULE_FUNCTION(embree_module, rtcNewGeometry);
LOBELIA_MODULE_FUNCTION(embree_module, rtcNewScene);
LOBELIA_MODULE_FUNCTION(embree_module, rtcOccluded1);
LOBELIA_MODULE_FUNCTION(embree_module, rtcReleaseDevice);
LOBELIA_MODULE_FUNCTION(embree_module, rtcReleaseGeometry);
LOBELIA_MODULE_FUNCTION(embree_module, rtcReleaseScene);
LOBELIA_MODULE_FUNCTION(embree_module, rtcSetGeometryBoundsFunction);
LOBELIA_MODULE_FUNCTION(embree_module, rtcSetGeometryIntersectFunction);
LOBELIA_MODULE_FUNCTION(embree_module, rtcSetGeometryOccludedFunction);
LOBELIA_MODULE_FUNCTION(embree_module, rtcSetGeometryUserData);
LOBELIA_MODULE_FUNCTION(embree_module, rtcSetGeometryUserPrimitiveCount);
LOBELIA_MODULE_FUNCTION(embree_module, rtcSetSceneFlags);

/// Embree's boxes and rays are float32. They are relative to the middle of all spheres, so that no coordinate is
/// beyond twice the extent, and boxes are wider by this share of it: some sixteen roundings.
constexpr double kMargin = 0x1p-20;

float below(double x) { return std::nextafter(float(x), -std::numeric_limits<float>::infinity()); }
float above(double x) { return std::nextafter(float(x), std::numeric_limits<float>::infinity()); }

/// The search of one ray, which Embree passes to the callbacks.
struct Search : RTCIntersectContext {
  Vec3 origin, direction;
  double start;  ///< along our ray, where Embree's ray starts
  int leaves;
  std::span<const int> touched;
  double distance;  ///< of the nearest so far, or the limit
  int found;
};

}  // namespace

struct Accelerator::State {
  std::span<const Sphere> spheres;
  Vec3 middle;
  double extent = 0;  ///< from the middle to the farthest point of a sphere
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  static void bounds(const RTCBoundsFunctionArguments* a) {
    const auto& state = *static_cast<const State*>(a->geometryUserPtr);
    const Sphere& sphere = state.spheres[a->primID];
    const Vec3 c = sphere.center - state.middle;
    const double reach = sphere.radius + kMargin * state.extent;
    RTCBounds& b = *a->bounds_o;
    b.lower_x = below(c.x - reach), b.upper_x = above(c.x + reach);
    b.lower_y = below(c.y - reach), b.upper_y = above(c.y + reach);
    b.lower_z = below(c.z - reach), b.upper_z = above(c.z + reach);
  }

  static void intersect(const RTCIntersectFunctionNArguments* a) {
    if (!a->valid[0]) return;
    auto& search = *static_cast<Search*>(a->context);
    const auto& state = *static_cast<const State*>(a->geometryUserPtr);
    const int index = int(a->primID);
    if (index == search.leaves) return;
    const Chord chord = chord_of(state.spheres[a->primID], search.origin, search.direction);
    if (!(chord.half_squared > 0)) return;
    const double t = chord.entry();
    if (!(t > 0) || t > search.distance) return;
    if (!is_outside(state.spheres[a->primID], search.origin)) return;
    if (t == search.distance && index > search.found) return;
    search.distance = t;
    search.found = index;
    auto* ray = reinterpret_cast<RTCRayHit*>(a->rayhit);
    // Still tries spheres that are farther by less than the margin.
    ray->ray.tfar = above(t - search.start + kMargin * state.extent);
    ray->hit.geomID = a->geomID;
    ray->hit.primID = a->primID;
  }

  static void occluded(const RTCOccludedFunctionNArguments* a) {
    if (!a->valid[0]) return;
    auto& search = *static_cast<Search*>(a->context);
    const auto& state = *static_cast<const State*>(a->geometryUserPtr);
    const int index = int(a->primID);
    if (index == search.leaves || std::ranges::find(search.touched, index) != search.touched.end())
      return;
    const Sphere& sphere = state.spheres[a->primID];
    if (!blocks(sphere, inner_radius(sphere), search.origin, search.direction, search.distance))
      return;
    search.found = index;
    reinterpret_cast<RTCRay*>(a->ray)->tfar = -std::numeric_limits<float>::infinity();
  }

  /// Sets `ray` to the part near the spheres, in Embree's numbers; false if the ray passes them all.
  bool begin(Search& search, RTCRay& ray) const {
    rtcInitIntersectContext(&search);
    const Vec3 from = search.origin - middle;
    const double along = -dot(from, search.direction);
    const Vec3 off_axis = from + along * search.direction;
    const double reach = 1.001 * extent;
    if (dot(off_axis, off_axis) > reach * reach) return false;
    search.start = std::max(0.0, along - 1.5 * extent);
    const double end = along + 1.5 * extent;
    if (end < 0) return false;
    const Vec3 start = from + search.start * search.direction;
    ray.org_x = float(start.x), ray.org_y = float(start.y), ray.org_z = float(start.z);
    ray.dir_x = float(search.direction.x), ray.dir_y = float(search.direction.y);
    ray.dir_z = float(search.direction.z);
    ray.tnear = 0;
    ray.tfar = above(std::min(end, search.distance) - search.start + kMargin * extent);
    ray.time = 0;
    ray.mask = ~0u;
    ray.flags = 0;
    ray.id = 0;
    return ray.tfar > 0;
  }
};

Accelerator::Accelerator(std::span<const Sphere> spheres) : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.spheres = spheres;
  Vec3 low{kInfinity, kInfinity, kInfinity}, high = -low;
  for (const Sphere& s : spheres) {
    low = {std::min(low.x, s.center.x - s.radius), std::min(low.y, s.center.y - s.radius),
           std::min(low.z, s.center.z - s.radius)};
    high = {std::max(high.x, s.center.x + s.radius), std::max(high.y, s.center.y + s.radius),
            std::max(high.z, s.center.z + s.radius)};
  }
  state.middle = 0.5 * (low + high);
  state.extent = 0.5 * length(high - low);
  state.device = rtcNewDevice(nullptr);
  if (!state.device) throw Error(ExitCode::kInternal, "Embree does not start");
  state.scene = rtcNewScene(state.device);
  rtcSetSceneFlags(state.scene, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(state.device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, unsigned(spheres.size()));
  rtcSetGeometryUserData(geometry, &state);
  rtcSetGeometryBoundsFunction(geometry, &State::bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &State::intersect);
  rtcSetGeometryOccludedFunction(geometry, &State::occluded);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(state.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(state.scene);
  if (const RTCError error = rtcGetDeviceError(state.device); error != RTC_ERROR_NONE)
    throw Error(ExitCode::kInternal,
                "Embree cannot sort the spheres: error " + std::to_string(int(error)));
}

Accelerator::~Accelerator() = default;

Accelerator::Hit Accelerator::nearest(Vec3 origin, Vec3 direction, int leaves) const {
  Search search{};
  search.origin = origin, search.direction = direction, search.leaves = leaves;
  search.distance = kInfinity, search.found = -1;
  RTCRayHit ray{};
  if (!state_->begin(search, ray.ray)) return {};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->scene, &search, &ray);
  return search.found < 0 ? Hit{} : Hit{search.found, search.distance};
}

bool Accelerator::blocked(Vec3 point, Vec3 to_light, double distance, int leaves,
                          std::span<const int> touched) const {
  Search search{};
  search.origin = point, search.direction = to_light, search.leaves = leaves;
  search.touched = touched;
  search.distance = distance, search.found = -1;
  RTCRay ray{};
  if (!state_->begin(search, ray)) return false;
  rtcOccluded1(state_->scene, &search, &ray);
  return search.found >= 0;
}

}  // namespace lobelia
