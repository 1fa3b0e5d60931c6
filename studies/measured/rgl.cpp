// RGL's format (Dupuy and Jakob 2018, "An Adaptive Parameterization for Efficient Material Acquisition and Rendering"): a
// "tensor file" of named arrays, little endian. The BRDF is a table over warped half vectors:
//
//   f_r (N.L) = rgb(warp(u_m)) ndf(u_m) / (4 sigma(u_i)),  u = (sqrt(2 theta / pi), (phi + pi) / (2 pi))
//
// m is the half vector, its phi counted from i; i is the eye, as in a path tracer. `warp` takes u_m to the share of the
// visible normals `vndf` before it: by rows first, then within the row. Tables are bilinear, and linear in theta_i.
//
// Source: the paper, section 5, and what the authors' brdf-loader computes. Only isotropic materials in RGB are read.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <span>

#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "base/words/text.hpp"
#include "studies/measured/measured.hpp"

namespace lobelia::measured {
namespace {

constexpr std::string_view kMagic("tensor_file\0\1\0", 14);  // with version 1.0
constexpr std::size_t kMostFields = 64, kMostDimensions = 8;
/// Bytes of a number by the type's code: 8, 16, 32 and 64 bits, unsigned and signed; then 16, 32 and 64 bits of float.
constexpr std::size_t kTypeBytes[] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
constexpr std::uint8_t kUint8 = 1, kFloat32 = 10;

struct Field {
  std::uint8_t type = 0;
  std::uint64_t offset = 0, bytes = 0;
  std::vector<std::size_t> shape = {};
};

class TensorFile {
 public:
  TensorFile(const std::string& bytes, const std::string& where) : bytes_(bytes), where_(where) {
    if (!bytes.starts_with(kMagic)) fail("is no tensor file of version 1.0");
    at_ = kMagic.size();
    const auto count = next<std::uint32_t>();
    if (count > kMostFields) fail("has {} fields; allowed: up to {}", count, kMostFields);
    for (std::uint32_t i = 0; i < count; ++i) read_field();
    refuse_overlaps();
  }

  bool has(const std::string& name) const { return fields_.contains(name); }
  std::uint8_t byte(const std::string& name) const {
    return std::uint8_t(bytes_[field(name, kUint8, 1).offset]);
  }
  std::vector<std::size_t> shape(const std::string& name, std::size_t dimensions) const {
    return field(name, kFloat32, dimensions).shape;
  }
  std::vector<float> values(const std::string& name, double least = -kMostValue) const {
    const Field& found = fields_.at(name);
    std::vector<float> values(found.bytes / sizeof(float));
    std::memcpy(values.data(), bytes_.data() + found.offset, found.bytes);
    for (const float value : values)
      if (!(value >= least && value <= kMostValue))
        fail("a value of '{}' is {}; allowed: {:g} to {:g}", name, value, least, kMostValue);
    return values;
  }
  template <class... Values>
  [[noreturn]] void fail(fmt::format_string<Values...> text, Values&&... values) const {
    throw Error(ExitCode::kInput, "{}: {}", where_,
                fmt::format(text, std::forward<Values>(values)...));
  }

 private:
  template <class T>
  T next() {
    if (bytes_.size() - at_ < sizeof(T)) fail("ends before its fields do");
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

  void read_field() {
    const std::size_t length = next<std::uint16_t>();
    if (length > bytes_.size() - at_) fail("ends before its fields do");
    const std::string name = bytes_.substr(at_, length), shown = printable(name);
    at_ += length;
    const std::size_t dimensions = next<std::uint16_t>();
    if (dimensions > kMostDimensions)
      fail("'{}' has {} dimensions; allowed: up to {}", shown, dimensions, kMostDimensions);
    Field field{next<std::uint8_t>()};
    if (field.type == 0 || field.type >= std::size(kTypeBytes))
      fail("'{}' has the unknown type {}", shown, field.type);
    field.offset = next<std::uint64_t>();
    field.bytes = kTypeBytes[field.type];
    for (std::size_t i = 0; i < dimensions; ++i) {
      const auto size = next<std::uint64_t>();
      // Neither product nor sum below can overflow, because a file is far smaller than 2^32 bytes.
      if (size == 0 || size > bytes_.size())
        fail("'{}' has a side of {}; allowed: 1 to the file's {} bytes", shown, size,
             bytes_.size());
      field.shape.push_back(size);
      field.bytes = std::min<std::uint64_t>(field.bytes * size, bytes_.size() + 1);
    }
    if (field.offset > bytes_.size() || field.bytes > bytes_.size() - field.offset)
      fail("'{}' ends beyond the end of the file", shown);
    if (!fields_.emplace(name, std::move(field)).second) fail("'{}' is there twice", shown);
  }

  void refuse_overlaps() const {
    std::vector<const Field*> sorted;
    for (const auto& [name, field] : fields_) sorted.push_back(&field);
    std::ranges::sort(sorted, {}, [](const Field* field) { return field->offset; });
    std::uint64_t end = at_;
    for (const Field* field : sorted) {
      if (field->offset < end) fail("two fields overlap at byte {}", field->offset);
      end = field->offset + field->bytes;
    }
  }

  const Field& field(const std::string& name, std::uint8_t type, std::size_t dimensions) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) fail("has no field '{}'", name);
    if (found->second.type != type || found->second.shape.size() != dimensions)
      fail("'{}' has {} dimensions of type {}; allowed: {} of type {}", name,
           found->second.shape.size(), found->second.type, dimensions, type);
    return found->second;
  }

  const std::string& bytes_;
  const std::string& where_;
  std::size_t at_ = 0;
  std::map<std::string, Field> fields_;
};

/// Two neighbouring slices of tables over theta_i.
struct Slices {
  std::size_t first;
  double share;  ///< of the next one
};

/// Equally large tables, bilinear over the unit square; one for each slice and channel.
struct Table {
  std::size_t width, height, channels = 1;
  std::vector<float> values;

  struct Cell {
    std::size_t column, row;
    double x, y;  ///< within it, 0 to 1
  };
  Cell cell(double u, double v) const {
    u *= double(width - 1);
    v *= double(height - 1);
    const std::size_t column = std::min(std::size_t(std::max(u, 0.0)), width - 2);
    const std::size_t row = std::min(std::size_t(std::max(v, 0.0)), height - 2);
    return {column, row, u - double(column), v - double(row)};
  }
  double operator()(std::size_t column, std::size_t row, Slices at, std::size_t channel = 0) const {
    const std::size_t step = channels * width * height;
    const std::size_t here = at.first * step + channel * width * height + row * width + column;
    return at.share == 0 ? values[here]
                         : std::lerp(double(values[here]), values[here + step], at.share);
  }
  double interpolated(double u, double v, Slices at = {}, std::size_t channel = 0) const {
    const auto [column, row, x, y] = cell(u, v);
    const auto along = [&](std::size_t r) {
      return std::lerp((*this)(column, r, at, channel), (*this)(column + 1, r, at, channel), x);
    };
    return std::lerp(along(row), along(row + 1), y);
  }
};

/// Takes a place in the unit square to the share of a density before it: of its row, and of all rows.
class Warp {
 public:
  Warp(Table density, const TensorFile& file) : density_(std::move(density)), before_(density_) {
    const std::size_t width = density_.width, height = density_.height;
    const std::size_t slices = density_.values.size() / (width * height);
    rows_ = {1, height, 1, std::vector<float>(slices * height)};
    for (std::size_t slice = 0; slice < slices; ++slice) {
      std::vector<double> sums(width * height);
      const std::span values(density_.values.data() + slice * width * height, width * height);
      double total = 0, last = 0;
      std::vector<double> totals;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % width > 0) sums[i] = sums[i - 1] + (double(values[i - 1]) + values[i]) / 2;
        if (i % width + 1 < width) continue;
        if (i >= width) total += (last + sums[i]) / 2;
        last = sums[i];
        totals.push_back(total);
      }
      if (!(total > 0)) file.fail("'vndf' is 0 in its slice {}", slice);
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = float(values[i] / total);
        before_.values[slice * width * height + i] = float(sums[i] / total);
      }
      for (std::size_t row = 0; row < height; ++row)
        rows_.values[slice * height + row] = float(totals[row] / total);
    }
  }

  /// None where the density is 0 in the whole row.
  std::optional<std::pair<double, double>> operator()(double u, double v, Slices at) const {
    const auto [column, row, x, y] = density_.cell(u, v);
    const auto mixed = [&](const Table& table, std::size_t i) {
      return std::lerp(table(i, row, at), table(i, row + 1, at), y);
    };
    const double left = mixed(density_, column), right = mixed(density_, column + 1);
    const std::size_t end = density_.width - 1;
    const double whole = mixed(before_, end);
    if (!(whole > 0)) return std::nullopt;
    const double here = mixed(before_, column) + x * (left + x * (right - left) / 2);
    const double low = before_(end, row, at), high = before_(end, row + 1, at);
    return std::pair(here / whole, rows_(0, row, at) + y * (low + y * (high - low) / 2));
  }

 private:
  Table density_, before_, rows_;
};

/// The field's last two dimensions are a table, the ones before it are `front`.
Table table_of(const TensorFile& file, const std::string& name,
               const std::vector<std::size_t>& front, double least) {
  const auto shape = file.shape(name, front.size() + 2);
  if (!std::ranges::equal(front, std::span(shape).first(front.size())))
    file.fail("'{}' has other sides than theta_i and phi_i", name);
  Table table{shape[shape.size() - 1], shape[shape.size() - 2], 1, file.values(name, least)};
  if (std::min(table.width, table.height) < 2)
    file.fail("'{}' is {} x {}; allowed: 2 x 2 or more", name, table.width, table.height);
  return table;
}

struct Rgl {
  std::vector<float> theta;
  Table ndf, sigma, rgb;
  Warp warp;

  std::optional<Rgb> radiance(Vec3 i, Vec3 o) const {
    constexpr Vec3 kNormal{0, 0, 1};
    const auto place = [&](Vec3 v) { return std::sqrt(angle_between(v, kNormal) / kRightAngle); };
    const Vec3 m = normalize(i + o);
    const double turn = (std::atan2(m.y, m.x) - std::atan2(i.y, i.x) + kPi) / (2 * kPi);
    const double u = place(m), v = turn - std::floor(turn);
    const Slices at = slices(angle_between(i, kNormal));
    const auto warped = warp(u, v, at);
    if (!warped) return std::nullopt;
    const double factor = ndf.interpolated(u, v) / (4 * sigma.interpolated(place(i), 0.5));
    if (!std::isfinite(factor)) return std::nullopt;
    const auto channel = [&](std::size_t k) {  // colours out of gamut are negative
      return factor * std::max(rgb.interpolated(warped->first, warped->second, at, k), 0.0);
    };
    return Rgb{channel(0), channel(1), channel(2)};
  }

  Slices slices(double angle) const {
    if (theta.size() == 1) return {0, 0};
    const auto above = std::upper_bound(theta.begin() + 1, theta.end() - 1, float(angle));
    const double low = *(above - 1), high = *above;
    return {std::size_t(above - 1 - theta.begin()),
            std::clamp((angle - low) / (high - low), 0.0, 1.0)};
  }
};

}  // namespace

MeasuredBrdf parse_rgl(const std::string& bytes, const std::string& where) {
  const TensorFile file(bytes, where);
  if (!file.has("rgb") && file.has("spectra"))
    file.fail("is a spectral file; allowed: the same material in RGB");
  const std::size_t azimuths = file.shape("phi_i", 1)[0], angles = file.shape("theta_i", 1)[0];
  if (azimuths > 2)  // of an isotropic material all are the same
    file.fail("has {} azimuths, so it is anisotropic; allowed: 1 or 2", azimuths);
  if (file.byte("jacobian") != 1) file.fail("'jacobian' is 0; allowed: 1");
  const std::vector<float> theta = file.values("theta_i", 0);
  if (std::ranges::adjacent_find(theta, std::greater_equal{}) != theta.end())
    file.fail("the angles 'theta_i' do not ascend");
  Table rgb = table_of(file, "rgb", {azimuths, angles, 3}, -kMostValue);
  rgb.channels = 3;
  auto rgl = std::make_shared<const Rgl>(
      Rgl{theta, table_of(file, "ndf", {}, 0), table_of(file, "sigma", {}, 0), std::move(rgb),
          Warp(table_of(file, "vndf", {azimuths, angles}, 0), file)});
  return {.format = "RGL", .radiance = [rgl](Vec3 to_eye, Vec3 to_light) {
            return rgl->radiance(to_eye, to_light);
          }};
}

}  // namespace lobelia::measured
