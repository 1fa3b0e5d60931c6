// lobelia_shader_runner: runs shaders that somebody else wrote on a real driver, for
// studies/shader_check/run_shaders.cpp. Crashes, endless loops and the driver's libraries stay in this process.
#include "studies/shader_check/runner/runner.hpp"

#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

namespace lobelia::shader_runner {
namespace {

std::size_t number(const char* text, std::size_t most) {
  std::size_t value = 0;
  const char* const end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, value);
  if (error != std::errc() || rest != end || value > most)
    throw Failure(kRunnerBroken,
                  std::string("not a number up to ") + std::to_string(most) + ": " + text);
  return value;
}

std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) throw Failure(kRunnerBroken, file + ": cannot be read");
  return bytes;
}

std::vector<float> read_points(const Work& work) {
  const std::string bytes = bytes_of(kPointsFile);
  std::vector<float> points(work.points * work.texels * 4);
  if (bytes.size() != points.size() * sizeof(float))
    throw Failure(kRunnerBroken, "the points do not have the size that was announced");
  std::memcpy(points.data(), bytes.data(), bytes.size());
  return points;
}

void write_results(const std::string& file, const std::vector<float>& results) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(results.data()),
            std::streamsize(results.size() * sizeof(float)));
  if (!out.flush()) throw Failure(kRunnerBroken, file + ": cannot be written");
}

void run(int argument_count, char** arguments) {
  constexpr int kFirstProgram = 7;
  if (argument_count <= kFirstProgram)
    throw Failure(kRunnerBroken, "egl|vulkan TOKEN POINTS TEXELS OUTPUTS ROUNDS PROGRAM...");
  // Each line is one write, so that no word of a driver comes to stand within it.
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  const char* const token = arguments[2];
  const Work work{number(arguments[3], kMostInvocations), number(arguments[4], 64),
                  number(arguments[5], kMostInvocations)};
  const std::size_t rounds = number(arguments[6], 1000);
  if (work.invocations() == 0 || work.invocations() > kMostInvocations ||
      work.points * work.texels > kMostInvocations)
    throw Failure(kRunnerBroken, "too many points or outputs, or none");
  const std::vector<float> points = read_points(work);
  const auto driver = std::string_view(arguments[1]) == "egl" ? make_egl_driver(work, points)
                                                              : make_vulkan_driver(work, points);
  std::printf("%s %s%s\n", token, kDeviceLine, driver->device().c_str());
  std::printf("%s %s%s\n", token, kDriverLine, driver->version().c_str());
  const auto count = std::size_t(argument_count - kFirstProgram);
  const auto begin = [&](std::size_t k) { std::printf("%s %s%zu\n", token, kProgramLine, k); };
  for (std::size_t k = 0; k < count; ++k) {
    begin(k);
    driver->add(bytes_of(arguments[kFirstProgram + k]));
  }
  for (std::size_t k = 0; k < count; ++k) {
    begin(k);
    driver->run(k);
    write_results(std::string(arguments[kFirstProgram + k]) + ".out", driver->results());
  }
  using Clock = std::chrono::steady_clock;
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < count; ++k) {
      const Clock::time_point begun = Clock::now();
      driver->run(k);
      std::printf("%s %s%zu %.9g\n", token, kSecondsLine, k,
                  std::chrono::duration<double>(Clock::now() - begun).count());
    }
}

}  // namespace
}  // namespace lobelia::shader_runner

int main(int argument_count, char** arguments) {
  try {
    lobelia::shader_runner::run(argument_count, arguments);
    return lobelia::kRunnerDone;
  } catch (const lobelia::shader_runner::Failure& failure) {
    std::printf("%s\n", failure.what());
    return failure.code;
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return lobelia::kRunnerBroken;
  }
}
