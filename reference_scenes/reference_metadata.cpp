#include "reference_scenes/reference_metadata.hpp"

#include <fmt/format.h>

#include "renderer/render_record.hpp"

namespace lobelia {

ImageMetadata reference_metadata(const Scene& scene, const Json& record) {
  ImageMetadata metadata = render_metadata(scene);
  const Json& engine = record.at("engine");
  metadata.emplace_back("lobelia:engine",
                        fmt::format("{} {}", engine.at("title").get<std::string>(),
                                    engine.at("version").get<std::string>()));
  metadata.emplace_back("lobelia:witness", record.at("witness").get<std::string>());
  return metadata;
}

}  // namespace lobelia
