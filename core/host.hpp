// Which machine a result was made on.
#pragma once

#include "core/record.hpp"

namespace lobelia {

/// {"processor": ..., "threads": ..., "system": ...}
Json host_record();

}  // namespace lobelia
