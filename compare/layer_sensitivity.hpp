// Differences that the limits find in changed copies of a file's layer, by its type.
#pragma once

#include "compare/layers.hpp"
#include "compare/sensitivity.hpp"

namespace lobelia {

/// Changed copies of a layer of `file` that was read, in the part that is compared:
///   colours       as sensitivity();
///   alpha         opaque, transparent, lower;
///   depth         surfaces that are gone, or nearer;
///   vectors       turned, longer, opposite;
///   identifiers   one bit, two identifiers exchanged; of a Cryptomatte also the coverage;
/// and copies that are no difference. Throws Error(kInput) for a layer without anything to change, or with colours that are
/// not finite; otherwise as read_picture().
std::vector<Change> layer_sensitivity(const Picture& layer, const std::string& file,
                                      const ComparisonOptions& options);

}  // namespace lobelia
