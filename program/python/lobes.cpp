// Lobes and models on arrays.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/records/record.hpp"
#include "base/words/constants.hpp"
#include "base/words/text.hpp"
#include "program/command/options.hpp"
#include "program/python/module.hpp"
#include "renderer/albedo.hpp"
#include "renderer/catalogue_record.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia::python {
namespace {

/// Rounding of a cosine in float32, by which s may lie outside of [0, 2].
constexpr double kRounding = 1e-6;

double checked_exponent(double n) {
  if (!(n >= kMinExponent && n <= kMaxExponent))
    throw Error(ExitCode::kUsage, "exponent {} is out of range; allowed: {:g} to {:g}", n,
                kMinExponent, kMaxExponent);
  return n;
}

/// NaN stays NaN.
template <class T>
T checked_s(T s) {
  if (s < -kRounding || s > 2 + kRounding)
    throw Error(ExitCode::kUsage, "s = {} is out of range; allowed: 0 to 2, it is 1 - cosine", s);
  return std::clamp(s, T(0), T(2));
}

ModelId model_of(const std::string& name) {
  return chosen(name, "model", model_names(), find_model);
}

LobeId lobe_of(const std::string& name, const std::string& formula) {
  cli::LobeOption option;
  py::dict options;
  options["lobe"] = name;
  if (!formula.empty()) options["formula"] = formula;
  parse_options(options, [&](CLI::App& app) {
    cli::OptionGroup group(app);
    option.add_to(group);
  });
  return *option.lobe();
}

Normalisation normalisation_of(const std::string& name) {
  return chosen(name, "normalisation", normalisation_names(), find_normalisation);
}

/// Flat arrays of one length. The exponents are sorted, or a single one is that of all (_lobes.py).
template <class T>
using Flat = py::array_t<T, py::array::c_style | py::array::forcecast>;
using Doubles = Flat<double>;

/// Calls f(exponent, begin, end) for each run of equal exponents, so that what depends on it is made once.
template <class T, class F>
void for_each_exponent(std::span<const T> exponents, std::size_t count, F f) {
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    const T exponent = exponents[exponents.size() == 1 ? 0 : begin];
    end = exponents.size() == 1 ? count : begin;
    while (end < count && exponents[end] == exponent) ++end;
    end = std::max(end, begin + 1);  // a NaN equals nothing
    f(checked_exponent(double(exponent)), begin, end);
  }
}

template <class T>
std::span<const T> values_of(const Flat<T>& array) {
  return {array.data(), std::size_t(array.size())};
}

/// The result of f(exponent, begin, end, values), which sets values[begin, end), without the GIL.
template <class T, class F>
py::array computed(const Flat<T>& exponents, std::size_t count, F f) {
  Flat<T> result{py::ssize_t(count)};
  T* const values = result.mutable_data();
  const std::span<const T> of_all = values_of(exponents);
  {
    const py::gil_scoped_release released;
    for_each_exponent(of_all, count, [&](double exponent, std::size_t begin, std::size_t end) {
      f(exponent, begin, end, values);
    });
  }
  return result;
}

void require_lobe_at(const LobeId& lobe, double n) {
  if (lobe.formula) cli::require_lobe({{}, lobe, {}, n});
}

/// Buffers of a kernel's size and alignment. Its loops are such that the compiler makes vectors of them.
struct Chunk {
  alignas(64) std::array<float, kChunk> given{}, clamped{}, value{};

  void compute(KernelTable::LobeValue kernel, const Highlight& highlight, std::size_t count) {
    constexpr float kLeast = -float(kRounding), kMost = 2 + float(kRounding);
    int outside = 0;
    for (std::size_t i = 0; i < count; ++i) {
      outside |= int(given[i] < kLeast) | int(given[i] > kMost);
      clamped[i] = std::min(std::max(given[i], 0.f), 2.f);
    }
    if (outside != 0)
      for (std::size_t i = 0; i < count; ++i) checked_s(given[i]);
    kernel(highlight, count, clamped.data(), value.data());
    for (std::size_t i = 0; i < count; ++i) value[i] = std::isnan(given[i]) ? given[i] : value[i];
  }
};

/// Float32 by the kernels, in chunks of their size.
py::array value32(const LobeId& lobe, const Flat<float>& n, const Flat<float>& s) {
  const KernelTable::LobeValue kernel = kernels().lobe32(lobe);
  const std::span<const float> given = values_of(s);
  Chunk chunk;
  return computed(n, given.size(),
                  [&](double exponent, std::size_t begin, std::size_t end, float* values) {
                    const Highlight highlight{{}, lobe, {}, exponent};
                    require_lobe_at(lobe, exponent);
                    for (std::size_t at = begin; at < end; at += kChunk) {
                      const std::size_t count = std::min(kChunk, end - at);
                      std::copy_n(&given[at], count, chunk.given.begin());
                      chunk.compute(kernel, highlight, count);
                      std::copy_n(chunk.value.begin(), count, values + at);
                    }
                  });
}

enum class LobeFunction { kValue, kSample, kDensity };

double evaluate(const PreparedLobe& lobe, double x, LobeFunction function) {
  if (function == LobeFunction::kSample) {
    if (x >= 0 && x < 1) return lobe.sample(x);
    throw Error(ExitCode::kUsage, "u = {} is out of range; allowed: 0 to below 1", x);
  }
  const double s = checked_s(x);
  if (std::isnan(s)) return s;
  if (function == LobeFunction::kValue) return lobe.value(s);
  return s > 1 ? 0 : lobe.density(s);
}

/// The second array is s, or the random number of kSample.
py::array lobe64(const LobeId& lobe, const Doubles& n, const Doubles& second,
                 LobeFunction function) {
  const std::span<const double> given = values_of(second);
  return computed(n, given.size(),
                  [&](double exponent, std::size_t begin, std::size_t end, double* values) {
                    require_lobe_at(lobe, exponent);
                    const PreparedLobe prepared = prepare(lobe, exponent);
                    for (std::size_t i = begin; i < end; ++i)
                      values[i] = evaluate(prepared, given[i], function);
                  });
}

/// function(highlight, i) for each place of arrays of that length.
template <class Function>
py::array of_highlight(Highlight highlight, const Doubles& n, py::ssize_t count,
                       Function function) {
  return computed(n, std::size_t(count),
                  [&](double exponent, std::size_t begin, std::size_t end, double* values) {
                    highlight.exponent = exponent;
                    cli::require_lobe(highlight);
                    for (std::size_t i = begin; i < end; ++i)
                      values[i] = function(std::as_const(highlight), i);
                  });
}

double checked_incidence(double radians) {
  if (!(radians >= 0 && radians <= kMostGrazing))
    throw Error(ExitCode::kUsage, "incidence {} is out of range; allowed: 0 to {:.6g} radians",
                radians, kMostGrazing);
  return radians;
}

void check_cosine(const char* name, double cosine) {
  if (cosine < -1 - kRounding || cosine > 1 + kRounding)
    throw Error(ExitCode::kUsage, "{} = {} is out of range; allowed: -1 to 1", name, cosine);
}

double checked_radiance(const Highlight& highlight, double n_dot_l, double n_dot_v, double given) {
  const double s = checked_s(given);
  check_cosine("n_dot_l", n_dot_l);
  check_cosine("n_dot_v", n_dot_v);
  if (std::isnan(n_dot_l) || std::isnan(n_dot_v) || std::isnan(s)) return kNaN;
  return n_dot_v > 0 ? highlight_radiance(highlight, n_dot_l, n_dot_v, s) : 0;
}

}  // namespace

void add_lobes(py::module_& module) {
  module.def("lobe_names",
             [] { return std::vector<std::string>(lobe_names().begin(), lobe_names().end()); });
  module.def("model_names",
             [] { return std::vector<std::string>(model_names().begin(), model_names().end()); });
  module.def("catalogue", [](double exponent) {
    return records::record_text(catalogue_record(checked_exponent(exponent)));
  });
  py::class_<LobeId>(module, "Lobe")
      .def(py::init(&lobe_of), py::arg("name"), py::arg("formula") = "")
      .def_property_readonly(
          "name", [](const LobeId& lobe) { return info(lobe).name; },
          "As in scene files: \"cs16\".")
      .def_property_readonly(
          "title", [](const LobeId& lobe) { return info(lobe).title; }, "For people.")
      .def_property_readonly(
          "formula", [](const LobeId& lobe) { return info(lobe).formula; }, "In s and n, as text.")
      .def_property_readonly(
          "source", [](const LobeId& lobe) { return info(lobe).source; }, "Where it is from.")
      .def("_value32", &value32)
      .def("_value64", [](const LobeId& lobe, const Doubles& n,
                          const Doubles& s) { return lobe64(lobe, n, s, LobeFunction::kValue); })
      .def("_sample", [](const LobeId& lobe, const Doubles& n,
                         const Doubles& u) { return lobe64(lobe, n, u, LobeFunction::kSample); })
      .def("_density", [](const LobeId& lobe, const Doubles& n, const Doubles& s) {
        return lobe64(lobe, n, s, LobeFunction::kDensity);
      });
  py::class_<Highlight>(module, "Highlight")
      .def(py::init(
          [](const std::string& model, const LobeId& lobe, const std::string& normalisation) {
            return Highlight{model_of(model), lobe, normalisation_of(normalisation)};
          }))
      .def("coefficient",
           [](const Highlight& highlight, const Doubles& n) {
             return of_highlight(highlight, n, n.size(), [](const Highlight& one, std::size_t) {
               return radiance_coefficient(one);
             });
           })
      .def("normalisation_constant",
           [](const Highlight& highlight, const Doubles& n) {
             return of_highlight(highlight, n, n.size(), [](const Highlight& one, std::size_t) {
               return normalisation_constant(one);
             });
           })
      .def("albedo",
           [](const Highlight& highlight, const Doubles& n, const Doubles& incidence,
              bool of_light) {
             const std::span<const double> angles = values_of(incidence);
             return of_highlight(highlight, n, incidence.size(),
                                 [&](const Highlight& one, std::size_t i) {
                                   const double radians = checked_incidence(angles[i]);
                                   return of_light ? directional_albedo_of_light(one, radians)
                                                   : directional_albedo(one, radians);
                                 });
           })
      .def("radiance", [](const Highlight& highlight, const Doubles& n, const Doubles& n_dot_l,
                          const Doubles& n_dot_v, const Doubles& s) {
        const std::span<const double> light = values_of(n_dot_l), eye = values_of(n_dot_v),
                                      versine = values_of(s);
        return of_highlight(highlight, n, s.size(), [&](const Highlight& one, std::size_t i) {
          return checked_radiance(one, light[i], eye[i], versine[i]);
        });
      });
}

}  // namespace lobelia::python
