#include "reference_scenes/engines/programs/scene_program.hpp"

#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace lobelia {
namespace {

std::istream& operator>>(std::istream& in, Three& three) {
  return in >> three[0] >> three[1] >> three[2];
}

CameraScene read_scene(const std::string& file) {
  std::ifstream in(file);
  CameraScene scene;
  std::string word, kind;
  while (in >> word && word != "end") {
    if (word == "scene") {
      in >> scene.name;
    } else if (word == "seconds") {
      in >> scene.seconds;
    } else if (word == "film") {
      in >> scene.width >> scene.height;
    } else if (word == "window") {
      in >> scene.left >> scene.right >> scene.bottom >> scene.top;
    } else if (word == "light") {
      CameraScene::Light& light = scene.lights.emplace_back();
      in >> kind >> light.place >> light.strength;
      light.is_distant = kind == "directional";
    } else if (word == "material") {
      CameraScene::Material& material = scene.materials.emplace_back();
      in >> material.kind >> material.exponent >> material.strength >> material.diffuse;
    } else if (word == "sphere") {
      CameraScene::Sphere& sphere = scene.spheres.emplace_back();
      in >> sphere.centre >> sphere.radius >> sphere.material;
    } else if (word == "plane") {
      CameraScene::Plane& plane = scene.planes.emplace_back();
      in >> plane.point >> plane.normal >> plane.material;
    } else {
      throw std::runtime_error("a scene with '" + word + "'");
    }
  }
  if (!in) throw std::runtime_error("no scene in '" + file + "'");
  return scene;
}

/// PFM, whose first row is the lowest.
void write_picture(const CameraScene& scene, const std::vector<float>& rgb) {
  const std::size_t size = 3 * std::size_t(scene.width) * std::size_t(scene.height);
  if (rgb.size() != size) throw std::runtime_error("a picture of another size");
  std::ofstream out(scene.name + "-0.pfm", std::ios::binary);
  out << "PF\n" << scene.width << ' ' << scene.height << "\n-1.0\n";
  out.write(reinterpret_cast<const char*>(rgb.data()), std::streamsize(size * sizeof(float)));
  if (!out.flush()) throw std::runtime_error("the picture cannot be written");
}

double seconds_of(const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

void tell_done(const std::string& name, std::chrono::steady_clock::time_point begun) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  std::printf("lobelia: done %s %.6f %.6f %lld\n", name.c_str(),
              std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(),
              seconds_of(used.ru_utime) + seconds_of(used.ru_stime),
              1024LL * (long long)used.ru_maxrss);
}

void alarm_in(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = time_t(seconds);
  timer.it_value.tv_usec = suseconds_t((seconds - double(timer.it_value.tv_sec)) * 1e6);
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

void render_file(const std::string& file, const RenderScene& render) {
  CameraScene scene;
  scene.name = '?';
  const auto begun = std::chrono::steady_clock::now();
  try {
    scene = read_scene(file);
    std::printf("lobelia: begin %s\n", scene.name.c_str());
    std::fflush(stdout);
    alarm_in(scene.seconds);
    write_picture(scene, render(scene));
    tell_done(scene.name, begun);
  } catch (const std::exception& error) {
    std::printf("lobelia: failed %s %s\n", scene.name.c_str(), error.what());
  }
  alarm_in(0);
  std::fflush(stdout);
}

}  // namespace

int run_scene_program(int argc, char** argv, const std::function<std::string()>& version,
                      const RenderScene& render) {
  if (argc != 2) {
    std::fprintf(stderr, "%s --version or FILE\n", argv[0]);
    return 2;
  }
  std::string file = argv[1];
  if (file == "--version") {
    try {
      std::puts(version().c_str());
      return 0;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      return 1;
    }
  }
  ::signal(SIGALRM, SIG_DFL);
  do {
    render_file(file, render);
    std::puts("lobelia: more");
    std::fflush(stdout);
  } while (std::getline(std::cin, file) && !file.empty());
  return 0;
}

}  // namespace lobelia
