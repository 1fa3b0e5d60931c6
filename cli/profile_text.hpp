// Records of profiles as text, tables and charts.
#pragma once

#include <span>
#include <string>

#include "records/profile.hpp"

namespace lobelia::cli {

/// "124.3 +- 0.2": to the first digit of the error, to its second where that is a 1; no finer than a
/// millionth of the value, which is what float32 pictures tell.
std::string with_error(double value, double error);

std::string profile_text(const records::Profile& profile);
/// A line per angle of each: sphere, light, and the columns of its curve. All have the same columns.
std::string profile_csv(std::span<const records::Profile> profiles);
std::string profile_svg(const records::Profile& profile);

std::string blob_text(const records::Blob& blob);
std::string blob_csv(const records::Blob& blob);
std::string blob_svg(const records::Blob& blob);

}  // namespace lobelia::cli
