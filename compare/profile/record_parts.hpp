// Parts that the records of profiles with and without a scene share, docs/records.md.
#pragma once

#include "compare/profile/peak.hpp"
#include "compare/profile/zones.hpp"
#include "core/record.hpp"

namespace lobelia {

Json point_json(FilmPoint point);
Json peak_json(const Peak& peak);
Json zones_json(const std::array<ZoneError, kZoneCount>& zones);

}  // namespace lobelia
