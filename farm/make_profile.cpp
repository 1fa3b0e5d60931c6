#include "farm/make_result.hpp"
#include "farm/profile_scene.hpp"
#include "records/record.hpp"

namespace lobelia {

void make_profile(const Scene& scene, const std::vector<MadePicture>& pictures,
                  ResultDraft& draft) {
  std::vector<Image> images;
  images.reserve(pictures.size());
  NamedImages named;
  for (const auto& picture : pictures) {
    // The profile draws the formula under that name already.
    if (picture.engine == records::kAnalytic) continue;
    images.push_back(read_whole_picture(picture.directory / picture_file(picture.engine), scene));
    named.emplace_back(picture.engine, &images.back());
  }
  records::write_record(draft.file("profile.json"), profile_scene(scene, 0, 0, named));
}

}  // namespace lobelia
