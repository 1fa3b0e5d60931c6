#include "reference_scenes/engines/povray/povray_options.hpp"

#include <fmt/format.h>

#include "core/files.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace fs = std::filesystem;

std::vector<std::string> povray_options(const Film& film, int threads, bool statistics) {
  return {"Output_to_File=on",
          "Output_File_Type=E",  // OpenEXR: always half float
          fmt::format("Width={}", film.width), fmt::format("Height={}", film.height),
          "Antialias=off",  // the ray goes through the middle of the pixel
          "Jitter=off", "Quality=9", "Output_Alpha=off",
          "Display=off",  // no window
          "Pause_When_Done=off",
          "Continue_Trace=off",  // never go on with an older picture
          // No chatter, but not All_Console, which would hide errors too.
          "Debug_Console=off", "Render_Console=off",
          statistics ? "Statistic_Console=on" : "Statistic_Console=off", "Verbose=off",
          fmt::format("Work_Threads={}", threads)};
}

void write_povray_ini(const fs::path& directory, const std::string& stem, double gain,
                      const std::vector<std::string>& options) {
  std::string text = fmt::format(
      "; {} times too bright, for half floats. The passes, divided by theirs, add up.\n"
      "Input_File_Name={}.pov\nOutput_File_Name={}.exr\n",
      exact_text(gain), stem, stem);
  for (const std::string& option : options) text += option + "\n";
  write_file(directory / (stem + ".ini"), text);
}

std::vector<std::string> povray_home(const fs::path& home, const std::string& version) {
  const auto minor = version.find('.') + 1;
  const fs::path settings = home / ".povray" / version.substr(0, version.find('.', minor));
  make_directories(settings);
  write_file(settings / "povray.conf",
             "[File I/O Security]\nrestricted\n"
             "[Shellout Security]\nforbidden\n"
             "[Permitted Paths]\nread* = %INSTALLDIR%/include\nread+write = .\n");
  write_file(home / "povray.ini", "; In place of the system's and the user's.\n");
  std::vector<std::string> environment = engine_environment(home);
  environment.push_back(fmt::format("POVINI={}", (home / "povray.ini").string()));
  return environment;
}

}  // namespace lobelia
