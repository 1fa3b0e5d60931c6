// Files with layers, compared layer by layer.
#pragma once

#include "base/pictures/image_io.hpp"
#include "base/system/error.hpp"
#include "compare/layer_types.hpp"
#include "compare/layers.hpp"
#include "tests/base/picture_files.hpp"
#include "tests/test.hpp"

namespace lobelia::fixtures {

class LayerFiles : public ::testing::Test {
 protected:
  static constexpr int kSide = 16, kPixels = kSide * kSide;
  using Texts = std::map<std::string, std::string>;

  /// A file of these channels beside a grey picture.
  std::filesystem::path file(const std::string& name, std::vector<ExrChannel> channels,
                             const Texts& texts = {}) {
    for (const char* letter : {"R", "G", "B"})
      channels.push_back({letter, std::vector<float>(kPixels, 0.5f)});
    write_exr_parts(path(name), {{.data = window(0, 0, kSide, kSide),
                                  .display = window(0, 0, kSide, kSide),
                                  .channels = std::move(channels),
                                  .texts = texts}});
    return path(name);
  }
  std::filesystem::path path(const std::string& name) const { return directory_.path() / name; }

  static ComparisonOptions options() {
    ComparisonOptions options;
    options.highlight = true;
    return options;
  }
  /// Every layer of a.exr against those of b.exr.
  OtherLayers compare_all(const ComparisonOptions& how = options()) const {
    PicturePair pair = read_pair(path("a.exr"), path("b.exr"), {});
    return compare_others(path("a.exr"), path("b.exr"), pair, {{}, true, false}, how);
  }
  /// The only layer beside the picture.
  LayerComparison compare_one(const ComparisonOptions& how = options()) const {
    const OtherLayers all = compare_all(how);
    EXPECT_EQ(all.compared.size(), 1u);
    return all.compared.empty() ? LayerComparison{} : all.compared.front();
  }
  LayerComparison compare_channels(const std::vector<ExrChannel>& a,
                                   const std::vector<ExrChannel>& b,
                                   const ComparisonOptions& how = options()) {
    file("a.exr", a);
    file("b.exr", b);
    return compare_one(how);
  }
  static double value(const LayerComparison& layer, std::string_view id) {
    return layer.comparison ? layer.comparison->value(id) : -1;
  }

  TemporaryDirectory directory_;
};

}  // namespace lobelia::fixtures
