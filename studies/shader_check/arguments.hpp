// The arguments that a shader function may take, by their names: what --arguments says.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/highlight.hpp"
#include "studies/shader_check/declarations.hpp"
#include "studies/shader_check/points.hpp"
#include "studies/shader_check/run_shaders.hpp"

namespace lobelia::shader_check {

struct ArgumentInfo {
  std::string_view name, meaning;
  int components = 1;
};
/// "N", "V", ..., for the help and docs/check_shader.md. A number such as 1.5 is an argument too.
std::span<const ArgumentInfo> argument_infos();

/// The values that a call takes, each as components of a point.
class Arguments {
 public:
  /// `knows_model`: false while it is looked for, so that no value may depend on it.
  explicit Arguments(const Highlight& highlight, bool knows_model = true)
      : highlight_(highlight), knows_model_(knows_model) {}
  void set_highlight(const Highlight& highlight) { highlight_ = highlight; }

  /// The components of "N", "-L" or "1.5", as expressions. Throws Error(kUsage) that names `option`, the unknown word and
  /// what is allowed, or that says that there are too many, or that the model is not known.
  std::vector<std::string> add(const std::string& word, std::string_view option);

  /// The points' components: first those that common_vectors() and the like name, then those that were added.
  ShaderPoints of(const std::vector<Point>& points) const;

 private:
  struct Given {
    std::string word;
    std::size_t info = 0, first = 0;
    bool negative = false;
    double number = 0;  ///< if `info` is past the last
  };
  std::size_t components() const;
  std::vector<Given> given_;
  Highlight highlight_;
  bool knows_model_;
};

/// Whether a function with these words can know the exponent only through a roughness.
bool is_of_roughness(std::span<const std::string> words);
bool depends_on_model(std::span<const std::string> words);

/// Lists for --arguments, the likeliest first, at most `most`: a word for each parameter that is a number or a vector and
/// not only a result. Names and types that tell leave one word.
std::vector<std::string> likely_arguments(const FunctionDeclaration& function, std::size_t most);

/// The parameters that have a word in such a list.
bool takes_word(const Declared& parameter);

/// Calls of functions that take the common components.
std::string common_vectors(ShaderText language);  ///< "vec3(...), vec3(...), vec3(...)": N, V, L
std::string common_exponent();
std::string common_coefficient();

}  // namespace lobelia::shader_check
