#include "studies/stability/report.hpp"

#include <cmath>
#include <limits>
#include <memory>

#include "core/timing.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia::stability {
namespace {

constexpr int kRounds = 31, kCalls = 100;
constexpr double kExponent = 1024;

/// Per value; each work computes kChunk values.
std::vector<records::Nanoseconds> nanoseconds(const std::vector<std::function<void()>>& works) {
  std::vector<std::function<void()>> repeated;
  for (const auto& work : works)
    repeated.push_back([&work] {
      for (int call = 0; call < kCalls; ++call) work();
    });
  std::vector<records::Nanoseconds> result;
  for (const Times& times : interleaved(repeated, kRounds)) {
    const double median = times.median / (1e-9 * kCalls * double(kChunk));
    result.push_back({median, 2 * times.spread * median});
  }
  return result;
}

/// s at lobe values between these two, or nothing if the lobe is never that small.
std::vector<double> places(LobeId lobe, double most, double least) {
  const double begin = s_of_value(lobe, kExponent, most, 200),
               end = s_of_value(lobe, kExponent, least, 200);
  // A polynomial falls to 0 within the rounding of s.
  if (!(end - begin > 1e-4 * begin)) return {};
  std::vector<double> s(kChunk);
  for (std::size_t i = 0; i < kChunk; ++i)
    s[i] = begin + (end - begin) * (double(i) + 0.5) / double(kChunk);
  return s;
}

/// Points that see their lobe at these s: the eye along the normal, the light beside it.
struct Points {
  Vec3Chunk normal{}, to_eye{}, to_light{};
  alignas(64) double value[kChunk]{};
  explicit Points(const std::vector<double>& s) {
    for (std::size_t i = 0; i < kChunk; ++i) {
      normal.z[i] = to_eye.z[i] = 1;
      to_light.x[i] = std::sqrt(s[i] * (2 - s[i]));
      to_light.z[i] = 1 - s[i];
    }
  }
};

std::function<void()> shading(std::shared_ptr<Points> points, const Highlight& h, Precision p) {
  return [points, h, kernel = kernels().shade(h, p)] {
    kernel(h, kChunk, points->normal, points->to_eye, points->to_light, points->value);
  };
}

/// The time of products with denormal results.
records::StabilityStall without_care() {
  const auto works = [](float factor) {
    const auto values = std::make_shared<std::vector<float>>(kChunk, 1e-30f);
    const auto results = std::make_shared<std::vector<float>>(kChunk);
    return [=] {
      const volatile float by = factor;
      for (std::size_t i = 0; i < kChunk; ++i) (*results)[i] = (*values)[i] * by;
    };
  };
  const auto t = nanoseconds({works(0.5f), works(1e-10f)});
  return {"no care", "float32", t[0], t[1]};
}

/// s at which the lobe is denormal in that precision.
std::vector<double> underflowing(LobeId lobe, Precision precision) {
  return precision == Precision::kFloat64 ? places(lobe, std::numeric_limits<double>::min(), 1e-320)
                                          : places(lobe, std::numeric_limits<float>::min(), 1e-44);
}

}  // namespace

std::vector<records::StabilityStall> measure_stalls(const std::vector<LobeId>& lobes) {
  std::vector<records::StabilityStall> stalls;
  const ModelId phong = *find_model("phong_rdf");
  for (const LobeId& lobe : lobes) {
    const auto ordinary = places(lobe, 0.9, 0.1);
    const Highlight h{phong, lobe, Normalisation::kExact, kExponent};
    for (const Precision p : {Precision::kFloat32, Precision::kMixed, Precision::kFloat64}) {
      const auto tiny = underflowing(lobe, p);
      if (tiny.empty()) continue;
      const auto t = nanoseconds({shading(std::make_shared<Points>(ordinary), h, p),
                                  shading(std::make_shared<Points>(tiny), h, p)});
      stalls.push_back({std::string(info(lobe).name), std::string(name(p)), t[0], t[1]});
    }
  }
  stalls.push_back(without_care());
  return stalls;
}

std::vector<records::StabilityPrice> measure_prices(const std::vector<LobeId>& lobes) {
  std::vector<records::StabilityPrice> prices;
  for (const char* model : {"modified_phong", "modified_blinn_phong"})
    for (const LobeId& lobe : lobes) {
      const Highlight h{*find_model(model), lobe, Normalisation::kExact, kExponent};
      const auto points = std::make_shared<Points>(places(lobe, 0.9, 0.1));
      const auto t = nanoseconds({shading(points, h, Precision::kFloat32),
                                  shading(points, h, Precision::kMixed),
                                  shading(points, h, Precision::kFloat64)});
      prices.push_back({std::string(info(lobe).name), model, t[0], t[1], t[2]});
    }
  return prices;
}

}  // namespace lobelia::stability
