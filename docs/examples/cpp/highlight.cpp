// Renders a scene with two models, compares the pictures, and measures the highlight: highlight SCENE.xml
#include <exception>
#include <iostream>
#include <lobelia/lobelia.hpp>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: highlight SCENE.xml\n";
    return 2;
  }
  try {
    const lobelia::Rendered reference = lobelia::render(argv[1]);
    lobelia::RenderSettings other;
    other.model = "modified_phong";
    const lobelia::Rendered changed = lobelia::render(argv[1], other);

    const lobelia::Comparison comparison = lobelia::compare(changed.picture, reference.picture);
    std::cout << "verdict: " << comparison.verdict << "\n";
    for (const lobelia::Judged& limit : comparison.limits)
      if (!limit.pass)
        std::cout << limit.metric << " " << limit.value << " is over " << limit.limit << "\n";

    for (const lobelia::Highlight& highlight : lobelia::profile(reference.picture).highlights)
      std::cout << "highlight at " << highlight.x << ", " << highlight.y << ": peak "
                << highlight.peak << ", half-width " << highlight.major_half_width << " pixels\n";

    for (const lobelia::Lobe& lobe : lobelia::lobes())
      std::cout << lobe.name
                << " at 10 degrees: " << lobelia::lobe_value(lobe.name, 0.015192246987791981, 64)
                << "\n";
    lobelia::write_exr("highlight.exr", changed.picture);
  } catch (const lobelia::Error& error) {
    std::cerr << error.what() << "\n";
    return int(error.code());
  }
}
