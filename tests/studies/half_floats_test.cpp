// Highlights in half floats: the textbook fails, ours holds, and so does what is exported, which is computed here from its
// very text.
#include "studies/cost/half_floats.hpp"

#include <fmt/format.h>

#include "base/system/files.hpp"
#include "lobelia_paths.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia::cost {
namespace {

constexpr LobeAngle kAngles[] = {LobeAngle::kReflection, LobeAngle::kHalfVector};

TEST(HalfFloats, HoldForEveryExportedLobeWithSubnormalsAndWithout) {
  for (const LobeAngle angle : kAngles)
    for (const LobeId& lobe : some_of(all_lobes()))
      for (const double n : kHalfExponents)
        for (const Subnormals subnormals : {Subnormals::kKept, Subnormals::kFlushed}) {
          // The vectors: 1.3e-3 sqrt(n) measured, of cs2. The lobe: as in shading_error_bound.
          const double allowed =
              1.5e-3 * std::sqrt(n) + 2 * lobe_float32_error(lobe, n).of_peak * 0x1p13;
          EXPECT_LE(half_errors(HalfForm::kExported, angle, lobe, n, subnormals).rounding, allowed)
              << info(lobe).name << " " << n;
        }
}

TEST(TheTableForPhones, HasTheFiguresOfTheProgram) {
  const std::string page =
      read_file(std::filesystem::path(LOBELIA_SOURCE_DIR) / "docs/export.md", 1 << 20);
  const auto row = [](const char* words, HalfForm form, const char* lobe, LobeAngle angle,
                      Subnormals subnormals) {
    std::string line = fmt::format("| {} |", words);
    for (const double n : kHalfExponents)
      line +=
          fmt::format(" {:.2g} |", half_errors(form, angle, *find_lobe(lobe), n, subnormals).all);
    return line;
  };
  const auto kept = Subnormals::kKept, flushed = Subnormals::kFlushed;
  const auto half = LobeAngle::kHalfVector, mirror = LobeAngle::kReflection;
  for (const std::string& line :
       {row("`pow(dot(N, H), n)`", HalfForm::kTextbook, "cosine", half, kept),
        row("`pow(dot(R, L), n)`", HalfForm::kTextbook, "cosine", mirror, kept),
        row("s not scaled, subnormals flushed", HalfForm::kStable, "cosine", half, flushed),
        row("exported, N and H", HalfForm::kExported, "cosine", half, flushed),
        row("exported, R and L", HalfForm::kExported, "cosine", mirror, flushed),
        row("exported with cs16, N and H", HalfForm::kExported, "cs16", half, flushed),
        row("exported, difference in highp", HalfForm::kDifferenceInFloat32, "cosine", half, kept)})
    EXPECT_THAT(page, testing::HasSubstr(line));
}

}  // namespace
}  // namespace lobelia::cost
