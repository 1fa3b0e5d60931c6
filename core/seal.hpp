// The hash by which a change of a record itself shows, as that of its files shows by the hashes in it.
#pragma once

#include <string>

#include "core/record.hpp"

namespace lobelia {

/// The SHA-256 of a record without its member `seal`, which is where it stands.
std::string seal_of(Json record);

}  // namespace lobelia
