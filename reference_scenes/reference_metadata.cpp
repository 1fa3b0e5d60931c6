#include "reference_scenes/reference_metadata.hpp"

#include <fmt/format.h>

#include "renderer/render_record.hpp"

namespace lobelia {

ImageMetadata reference_metadata(const Scene& scene, const records::Reference& record) {
  ImageMetadata metadata = render_metadata(scene);
  metadata.emplace_back("lobelia:engine",
                        fmt::format("{} {}", record.engine.title, record.engine.version));
  metadata.emplace_back("lobelia:witness", record.witness);
  return metadata;
}

}  // namespace lobelia
