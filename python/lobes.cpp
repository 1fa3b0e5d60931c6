// Lobes and models on arrays. All arguments are broadcast.
#include <algorithm>
#include <array>
#include <cmath>

#include "cli/options.hpp"
#include "core/constants.hpp"
#include "core/text.hpp"
#include "python/module.hpp"
#include "records/record.hpp"
#include "renderer/albedo.hpp"
#include "renderer/catalogue_record.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia::python {
namespace {

/// Rounding of a cosine in float32, by which s may lie outside of [0, 2].
constexpr double kRounding = 1e-6;

double checked_exponent(double n) {
  if (!(n >= kMinExponent && n <= kMaxExponent))
    throw Error(ExitCode::kUsage, fmt::format("exponent {} is out of range; allowed: {:g} to {:g}",
                                              n, kMinExponent, kMaxExponent));
  return n;
}

/// NaN stays NaN.
template <class T>
T checked_s(T s) {
  if (s < -kRounding || s > 2 + kRounding)
    throw Error(ExitCode::kUsage,
                fmt::format("s = {} is out of range; allowed: 0 to 2, it is 1 - cosine", s));
  return std::clamp(s, T(0), T(2));
}

ModelId model_of(const std::string& name) {
  return chosen(name, "model", model_names(), join(model_names()), find_model);
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
  return chosen(name, "normalisation", normalisation_names(), join(normalisation_names()),
                find_normalisation);
}

/// One array of each argument and the result, with the strides of the broadcast shape.
template <class T>
class Broadcast {
 public:
  using Array = py::array_t<T, py::array::forcecast>;

  Broadcast(std::vector<Array> given) : given_(std::move(given)) {
    for (const Array& one : given_)
      if (std::size_t(one.ndim()) > shape_.size()) shape_.resize(std::size_t(one.ndim()), 1);
    for (const Array& one : given_)
      for (std::size_t axis = first_axis(one); axis < shape_.size(); ++axis) {
        const py::ssize_t size = one.shape(py::ssize_t(axis - first_axis(one)));
        if (size == 1) continue;
        if (shape_[axis] != 1 && shape_[axis] != size)
          throw Error(ExitCode::kUsage,
                      fmt::format("shapes {} cannot be broadcast together", shapes_text()));
        shape_[axis] = size;
      }
    result_ = Array(shape_);
    for (const Array& one : given_) {
      std::vector<py::ssize_t> strides(shape_.size(), 0);
      for (std::size_t axis = first_axis(one); axis < shape_.size(); ++axis)
        if (const auto own = py::ssize_t(axis - first_axis(one)); one.shape(own) != 1)
          strides[axis] = one.strides(own);
      strides_.push_back(std::move(strides));
    }
    strides_.emplace_back(result_.strides(), result_.strides() + shape_.size());
    for (Array& one : given_) data_.push_back(reinterpret_cast<const char*>(one.data()));
    data_.push_back(reinterpret_cast<const char*>(result_.data()));
  }

  /// Calls visit(places, others) for each combination of the argument's own values, and others(visit) calls
  /// visit(row) for all that is combined with it. So what depends on the argument is made once for each of its values.
  template <class Visit>
  void for_each_of(std::size_t argument, Visit visit) const {
    std::vector<Axis> own, others;
    for (std::size_t axis = 0; axis < shape_.size(); ++axis) {
      Axis one{shape_[axis], {}};
      for (const auto& strides : strides_) one.strides.push_back(strides[axis]);
      if (one.size != 1) (one.strides[argument] != 0 ? own : others).push_back(std::move(one));
    }
    merge(own);
    merge(others);
    walk(own, data_, [&](const Row& outer) {
      for (py::ssize_t i = 0; i < outer.count; ++i)
        visit(outer.at(argument, i), [&](auto inner) { walk(others, outer.places_at(i), inner); });
    });
  }

  using Places = std::vector<const char*>;
  /// Elements at equal distances in every array.
  struct Row {
    const Places& places;
    py::ssize_t count;
    const std::vector<py::ssize_t>& strides;

    const T& at(std::size_t argument, py::ssize_t i) const {
      return *reinterpret_cast<const T*>(places[argument] + i * strides[argument]);
    }
    /// The result has no other owner yet.
    T& result(py::ssize_t i) const {
      return *reinterpret_cast<T*>(const_cast<char*>(places.back() + i * strides.back()));
    }
    Places places_at(py::ssize_t i) const {
      Places moved = places;
      for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += i * strides[k];
      return moved;
    }
  };
  const Array& array() const { return result_; }

 private:
  std::size_t first_axis(const Array& one) const { return shape_.size() - std::size_t(one.ndim()); }
  std::string shapes_text() const {
    std::string text;
    for (const Array& one : given_)
      text += fmt::format("{}({})", text.empty() ? "" : ", ",
                          fmt::join(one.shape(), one.shape() + one.ndim(), ", "));
    return text;
  }
  struct Axis {
    py::ssize_t size;
    std::vector<py::ssize_t> strides;  ///< bytes, of each argument and of the result
  };
  /// Makes one axis of two where the arrays allow it, so that rows are long.
  static void merge(std::vector<Axis>& axes) {
    for (std::size_t i = axes.size(); i-- > 1;) {
      const Axis& inner = axes[i];
      const auto fits = [&](std::size_t k) {
        return axes[i - 1].strides[k] == inner.strides[k] * inner.size;
      };
      bool all_fit = true;
      for (std::size_t k = 0; k < inner.strides.size(); ++k) all_fit = all_fit && fits(k);
      if (!all_fit) continue;
      axes[i - 1] = {axes[i - 1].size * inner.size, inner.strides};
      axes.erase(axes.begin() + std::ptrdiff_t(i));
    }
  }
  template <class Visit>
  static void walk(const std::vector<Axis>& axes, Places places, Visit&& visit) {
    for (const Axis& axis : axes)
      if (axis.size == 0) return;
    const Axis single{1, std::vector<py::ssize_t>(places.size(), 0)};
    const Axis& last = axes.empty() ? single : axes.back();
    const std::size_t outer = axes.empty() ? 0 : axes.size() - 1;
    std::vector<py::ssize_t> index(outer, 0);
    for (;;) {
      visit(Row{places, last.size, last.strides});
      std::size_t k = outer;
      for (; k > 0; --k) {
        const Axis& axis = axes[k - 1];
        const bool ends = ++index[k - 1] == axis.size;
        const py::ssize_t steps = ends ? 1 - axis.size : 1;
        for (std::size_t i = 0; i < places.size(); ++i) places[i] += steps * axis.strides[i];
        if (!ends) break;
        index[k - 1] = 0;
      }
      if (k == 0) return;
    }
  }

  std::vector<Array> given_;
  std::vector<py::ssize_t> shape_;
  Array result_;
  std::vector<std::vector<py::ssize_t>> strides_;  ///< of each argument, then of the result
  Places data_;
};

using Doubles = Broadcast<double>;

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

/// s, n: float32 by the kernels, in chunks of their size.
py::array value32(const LobeId& lobe, const Broadcast<float>::Array& s,
                  const Broadcast<float>::Array& n) {
  const Broadcast<float> all({s, n});
  {
    const py::gil_scoped_release released;
    const KernelTable::LobeValue kernel = kernels().lobe32(lobe);
    Chunk chunk;
    all.for_each_of(1, [&](float exponent, const auto& for_others) {
      const Highlight highlight{{}, lobe, {}, checked_exponent(double(exponent))};
      require_lobe_at(lobe, highlight.exponent);
      for_others([&](const auto& row) {
        for (py::ssize_t begin = 0; begin < row.count; begin += kChunk) {
          const auto count = std::min(py::ssize_t(kChunk), row.count - begin);
          const bool is_dense = row.strides[0] == sizeof(float);
          if (is_dense) std::copy_n(&row.at(0, begin), count, chunk.given.begin());
          for (py::ssize_t i = 0; i < count && !is_dense; ++i)
            chunk.given[std::size_t(i)] = row.at(0, begin + i);
          chunk.compute(kernel, highlight, std::size_t(count));
          for (py::ssize_t i = 0; i < count; ++i)
            row.result(begin + i) = chunk.value[std::size_t(i)];
        }
      });
    });
  }
  return all.array();
}

enum class LobeFunction { kValue, kSample, kDensity };

double evaluate(const PreparedLobe& lobe, double x, LobeFunction function) {
  if (function == LobeFunction::kSample) {
    if (x >= 0 && x < 1) return lobe.sample(x);
    throw Error(ExitCode::kUsage, fmt::format("u = {} is out of range; allowed: 0 to below 1", x));
  }
  const double s = checked_s(x);
  if (std::isnan(s)) return s;
  if (function == LobeFunction::kValue) return lobe.value(s);
  return s > 1 ? 0 : lobe.density(s);
}

/// The first argument is s, or the random number of kSample.
py::array lobe64(const LobeId& lobe, const Doubles::Array& first, const Doubles::Array& n,
                 LobeFunction function) {
  const Doubles all({first, n});
  {
    const py::gil_scoped_release released;
    all.for_each_of(1, [&](double given, const auto& for_others) {
      const double exponent = checked_exponent(given);
      require_lobe_at(lobe, exponent);
      const PreparedLobe prepared = prepare(lobe, exponent);
      for_others([&](const auto& row) {
        for (py::ssize_t i = 0; i < row.count; ++i)
          row.result(i) = evaluate(prepared, row.at(0, i), function);
      });
    });
  }
  return all.array();
}

/// function(highlight, argument), where argument(k) is the k-th of `arguments`; the first one is the exponent.
template <class Function>
py::array of_highlight(Highlight highlight, std::vector<Doubles::Array> arguments,
                       Function function) {
  const Doubles all(std::move(arguments));
  {
    const py::gil_scoped_release released;
    all.for_each_of(0, [&](double exponent, const auto& for_others) {
      highlight.exponent = checked_exponent(exponent);
      cli::require_lobe(highlight);
      for_others([&](const auto& row) {
        for (py::ssize_t i = 0; i < row.count; ++i)
          row.result(i) =
              function(std::as_const(highlight), [&](std::size_t k) { return row.at(k, i); });
      });
    });
  }
  return all.array();
}

double checked_incidence(double radians) {
  if (!(radians >= 0 && radians <= kMostGrazing))
    throw Error(ExitCode::kUsage,
                fmt::format("incidence {} is out of range; allowed: 0 to {:.6g} radians", radians,
                            kMostGrazing));
  return radians;
}

void check_cosine(const char* name, double cosine) {
  if (cosine < -1 - kRounding || cosine > 1 + kRounding)
    throw Error(ExitCode::kUsage,
                fmt::format("{} = {} is out of range; allowed: -1 to 1", name, cosine));
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
      .def(py::init(&lobe_of))
      .def_property_readonly("name", [](const LobeId& lobe) { return info(lobe).name; })
      .def_property_readonly("title", [](const LobeId& lobe) { return info(lobe).title; })
      .def_property_readonly("formula", [](const LobeId& lobe) { return info(lobe).formula; })
      .def_property_readonly("source", [](const LobeId& lobe) { return info(lobe).source; })
      .def("value32", &value32)
      .def("value64",
           [](const LobeId& lobe, const Doubles::Array& s, const Doubles::Array& n) {
             return lobe64(lobe, s, n, LobeFunction::kValue);
           })
      .def("sample",
           [](const LobeId& lobe, const Doubles::Array& u, const Doubles::Array& n) {
             return lobe64(lobe, u, n, LobeFunction::kSample);
           })
      .def("density", [](const LobeId& lobe, const Doubles::Array& s, const Doubles::Array& n) {
        return lobe64(lobe, s, n, LobeFunction::kDensity);
      });
  py::class_<Highlight>(module, "Highlight")
      .def(py::init(
          [](const std::string& model, const LobeId& lobe, const std::string& normalisation) {
            return Highlight{model_of(model), lobe, normalisation_of(normalisation)};
          }))
      .def("coefficient",
           [](const Highlight& highlight, const Doubles::Array& n) {
             return of_highlight(highlight, {n}, [](const Highlight& one, auto) {
               return radiance_coefficient(one);
             });
           })
      .def("albedo",
           [](const Highlight& highlight, const Doubles::Array& n, const Doubles::Array& incidence,
              bool of_light) {
             return of_highlight(highlight, {n, incidence},
                                 [of_light](const Highlight& one, auto argument) {
                                   const double radians = checked_incidence(argument(1));
                                   return of_light ? directional_albedo_of_light(one, radians)
                                                   : directional_albedo(one, radians);
                                 });
           })
      .def("radiance",
           [](const Highlight& highlight, const Doubles::Array& n, const Doubles::Array& n_dot_l,
              const Doubles::Array& n_dot_v, const Doubles::Array& s) {
             return of_highlight(
                 highlight, {n, n_dot_l, n_dot_v, s}, [](const Highlight& one, auto argument) {
                   return checked_radiance(one, argument(1), argument(2), argument(3));
                 });
           });
}

}  // namespace lobelia::python
