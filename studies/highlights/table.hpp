// A light in view, and a highlight that differs: whether the default limits find it, however bright the light is.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/records/verify.hpp"

namespace lobelia::highlights {

/// The light's radiance, in units of the highlight's peak.
inline constexpr double kLights[] = {5, 50, 500, 5000, 50000};

/// Made scenes, each with a small light and one highlight: narrow, broad, elongated, on black and on lit surfaces, near the
/// light and far. The highlight is 5 % and 30 % dimmer, moved by 4 pixels, gone, and only in the judged picture, alone; and
/// once the picture is only rounded to half floats. All are compared as `lobelia compare` does without options, beside each
/// of kLights. `on_progress` gets the share done.
records::VerifyHighlights measure_table(const std::function<void(double)>& on_progress);

std::string table_text(const records::VerifyHighlights& measured);

}  // namespace lobelia::highlights
