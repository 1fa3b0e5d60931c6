// Parts that the records of profiles with and without a scene share.
#pragma once

#include "compare/profile/peak.hpp"
#include "compare/profile/zones.hpp"
#include "records/profile.hpp"

namespace lobelia {

records::Point point_record(FilmPoint point);
records::Peak peak_record(const Peak& peak);
records::ZoneErrors zones_record(const std::array<ZoneError, kZoneCount>& zones);

}  // namespace lobelia
