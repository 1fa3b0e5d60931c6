#include "farm/farm.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for_each.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/host.hpp"
#include "core/interrupt.hpp"
#include "core/text.hpp"
#include "core/threads.hpp"
#include "core/version.hpp"
#include "farm/cell_store.hpp"
#include "farm/finish_cell.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/reference_metadata.hpp"
#include "reference_scenes/replicates.hpp"
#include "renderer/render_error.hpp"
#include "renderer/render_record.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// Counts steps and tells the caller, from any thread.
class ProgressCounter {
 public:
  ProgressCounter(const FarmOptions& options, std::size_t total)
      : options_(options), total_(total) {}
  void expect(const std::string& what, std::size_t count) {
    const std::scoped_lock lock(mutex_);
    stages_.push_back({what, 0, count});
  }
  void step(const std::string& what) {
    const std::scoped_lock lock(mutex_);
    ++done_;
    FarmProgress progress{done_, total_, ""};
    for (auto& stage : stages_) {
      if (stage.what == what) ++stage.done;
      if (stage.done == stage.count || stage.count == 0) continue;
      if (!progress.running.empty()) progress.running += ", ";
      progress.running += fmt::format("{} {}/{}", stage.what, stage.done, stage.count);
    }
    if (options_.on_progress) options_.on_progress(progress);
  }
  void skip(std::size_t steps) {
    const std::scoped_lock lock(mutex_);
    total_ -= steps;
  }

 private:
  struct Stage {
    std::string what;
    std::size_t done, count;
  };
  const FarmOptions& options_;
  std::mutex mutex_;
  std::size_t done_ = 0, total_;
  std::vector<Stage> stages_;
};

class Farm {
 public:
  Farm(const Grid& grid, const fs::path& directory, const FarmOptions& options)
      : grid_(grid),
        directory_(directory),
        options_(options),
        cells_(cells_of(grid)),
        progress_(options, cells_.size() * (2 + grid.engines.size())) {
    for (const auto& cell : cells_) stores_.emplace_back(directory, grid, cell);
    problems_.resize(cells_.size());
    not_comparable_.resize(cells_.size());
    status_.assign(cells_.size(), "missing");
  }

  FarmSummary run() {
    find_engines();
    make_directories(directory_);
    remove_abandoned_files(directory_);
    std::vector<std::size_t> unfinished;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (!options_.again) status_[i] = stores_[i].finished_status(cell_inputs(i));
      if (status_[i] != "missing" && !status_[i].empty()) {
        keep_cell();
      } else {
        status_[i] = "missing";
        unfinished.push_back(i);
      }
    }
    // Now as well as at the end: a run that is killed has its record too.
    write_farm_record();
    try {
      for (const std::size_t i : unfinished) stores_[i].prepare(options_.again);
      render_ours(unfinished);
      render_references(unfinished);
      finish(unfinished);
    } catch (...) {
      try {
        write_farm_record();
      } catch (const Error&) {  // the first failure is the one to tell
      }
      throw;
    }
    write_farm_record();
    return summarise();
  }

 private:
  struct EngineHere {
    std::unique_ptr<Engine> engine;
    std::string name, version;  ///< version empty: not available
  };

  void find_engines() {
    for (const auto& name : grid_.engines) {
      const auto program = options_.programs.find(name);
      EngineHere here{
          make_engine(name, program == options_.programs.end() ? fs::path() : program->second),
          name, ""};
      const EngineStatus& status = here.engine->status();
      if (status.available)
        here.version = status.version;
      else if (program != options_.programs.end())  // asked for by its path: a mistake, not a lack
        throw Error(ExitCode::kEngine,
                    fmt::format("{}: {}", here.engine->info().title, status.why));
      else
        summary_.absent_engines.push_back(fmt::format("{} is left out: {}; to get it: {}",
                                                      here.engine->info().title, status.why,
                                                      here.engine->info().install_hint));
      engines_.push_back(std::move(here));
    }
  }

  Json cell_inputs(std::size_t i) const {
    Json inputs = stores_[i].inputs("");
    for (const auto& here : engines_) inputs["engines"][here.name] = here.version;
    return inputs;
  }

  void keep_cell() {
    std::size_t pictures = 1;
    for (const auto& here : engines_) pictures += here.version.empty() ? 0 : 1;
    summary_.kept += pictures;
    progress_.skip(2 + engines_.size());
  }

  void render_ours(const std::vector<std::size_t>& unfinished) {
    std::vector<std::size_t> todo;
    for (const std::size_t i : unfinished)
      if (options_.again || !stores_[i].has_current_image(kOurs, "render", stores_[i].inputs("")))
        todo.push_back(i);
    kept_pictures(unfinished.size() - todo.size());
    progress_.expect(kOurs, todo.size());
    for_each_cell(todo, [&](std::size_t i) {
      // Cells side by side, each on one thread: a cell is too small to be divided.
      RenderOptions single;
      single.threads = 1;
      const RenderResult result = render(stores_[i].scene(), single);
      const std::string file = std::string(kOurs) + ".exr";
      Json record = render_record(stores_[i].scene(), result,
                                  {"lobelia", "render", "scene.xml", "-o", file}, file);
      record["inputs"] = stores_[i].inputs("");
      // An engine's average is compared with it, by the noise of both.
      const Image error = needs_replicates(stores_[i].scene())
                              ? standard_error_of_render(stores_[i].scene(), single)
                              : Image();
      stores_[i].store_image(kOurs, result.image, error, render_metadata(stores_[i].scene()),
                             record);
      progress_.step(kOurs);
    });
    summary_.rendered += todo.size();
  }

  /// Every engine in a thread of its own: they wait for processes, not for each other.
  void render_references(const std::vector<std::size_t>& unfinished) {
    std::vector<std::vector<std::size_t>> todos(engines_.size());
    std::vector<std::exception_ptr> failures(engines_.size());
    for (std::size_t e = 0; e < engines_.size(); ++e) {
      if (engines_[e].version.empty()) {
        progress_.skip(unfinished.size());
        continue;
      }
      std::vector<std::size_t>& todo = todos[e];
      std::size_t refused = 0;
      for (const std::size_t i : unfinished) {
        if (const std::string why = engines_[e].engine->why_not(stores_[i].scene(), {});
            !why.empty()) {
          not_comparable_[i].push_back({engines_[e].name, why});
          ++refused;
        } else if (options_.again ||
                   !stores_[i].has_current_image(engines_[e].name, "reference",
                                                 stores_[i].inputs(engines_[e].version))) {
          todo.push_back(i);
        }
      }
      progress_.skip(refused);
      kept_pictures(unfinished.size() - todo.size() - refused);
      progress_.expect(engines_[e].name, todo.size());
    }
    {
      std::vector<std::jthread> threads;
      for (std::size_t e = 0; e < engines_.size(); ++e) {
        if (todos[e].empty()) continue;
        threads.emplace_back([this, e, &todos, &failures] {
          try {
            render_with(engines_[e], todos[e]);
          } catch (...) {
            failures[e] = std::current_exception();
          }
        });
      }
    }
    for (const auto& failure : failures)
      if (failure) std::rethrow_exception(failure);
  }

  void render_with(EngineHere& here, const std::vector<std::size_t>& todo) {
    std::vector<Scene> scenes;
    for (const std::size_t i : todo) scenes.push_back(stores_[i].scene());
    if (scenes.empty()) return;
    ReferenceOptions options;
    options.threads = options_.threads;
    options.time_limit = options_.time_limit;
    const TemporaryDirectory logs;
    options.log_directory = logs.path();
    here.engine->render(scenes, options, [&](std::size_t k, ReferenceResult result) {
      std::error_code none;  // an engine may have had nothing to say
      fs::copy_file(logs.path() / fmt::format("{}-{}.log", here.name, k),
                    stores_[todo[k]].file(here.name + ".log"), fs::copy_options::overwrite_existing,
                    none);
      store_reference(here, todo[k], std::move(result));
      progress_.step(here.name);
    });
  }

  void store_reference(const EngineHere& here, std::size_t i, ReferenceResult result) {
    if (!result.error.empty()) {
      const std::scoped_lock lock(mutex_);
      problems_[i].push_back({here.name, result.error});
      return;
    }
    const std::string file = here.name + ".exr";
    Json command{"lobelia", "reference", "scene.xml", "--engine", here.name, "-o", file};
    if (const auto program = options_.programs.find(here.name); program != options_.programs.end())
      command.insert(command.end(), {"--" + here.name, program->second.string()});
    result.record["command"] = std::move(command);
    result.record["image"] = {
        {"file", file}, {"width", result.image.width()}, {"height", result.image.height()}};
    const ImageMetadata metadata = reference_metadata(stores_[i].scene(), result.record);
    result.record["inputs"] = stores_[i].inputs(here.version);
    stores_[i].store_image(here.name, result.image, result.standard_error, metadata, result.record);
    const std::scoped_lock lock(mutex_);
    ++summary_.rendered;
  }

  void finish(const std::vector<std::size_t>& unfinished) {
    progress_.expect("comparing", unfinished.size());
    for_each_cell(unfinished, [&](std::size_t i) {
      std::vector<std::string> references;
      for (const auto& here : engines_)
        if (!here.version.empty() &&
            stores_[i].has_current_image(here.name, "reference", stores_[i].inputs(here.version)))
          references.push_back(here.name);
      try {
        status_[i] =
            finish_cell(stores_[i], references, not_comparable_[i], problems_[i], cell_inputs(i));
      } catch (const Error& error) {
        // A disk that is full ends the farm; whatever is wrong with this cell is its own result.
        if (error.code() == ExitCode::kOutput) throw;
        problems_[i].push_back({kOurs, error.what()});
        status_[i] = "failed";
      }
      progress_.step("comparing");
    });
  }

  void for_each_cell(const std::vector<std::size_t>& todo,
                     const std::function<void(std::size_t)>& work) {
    ThreadLimit(options_.threads).run([&] {
      oneapi::tbb::parallel_for_each(todo, [&](std::size_t i) {
        throw_if_interrupted();
        work(i);
      });
    });
    throw_if_interrupted();
  }

  void kept_pictures(std::size_t count) {
    summary_.kept += count;
    progress_.skip(count);
  }

  void write_farm_record() const {
    Json record = make_record("farm");
    record["title"] = grid_.title;
    record["grid"] = grid_.file_name;
    record["command"] = shell_join(options_.command);
    record["host"] = host_record();
    record["axes"] = Json::array();
    for (const auto& axis : grid_.axes) {
      Json values = Json::array();
      for (const auto& value : axis.values)
        values.push_back({{"value", value.value}, {"label", value.label}});
      record["axes"].push_back({{"name", axis.name}, {"values", std::move(values)}});
    }
    record["engines"] = Json::array(
        {{{"name", kOurs}, {"title", "Lobelia"}, {"version", kVersion}, {"available", true}}});
    for (const auto& here : engines_) {
      const EngineInfo& info = here.engine->info();
      Json engine{{"name", info.name}, {"title", info.title}};
      engine["available"] = !here.version.empty();
      if (here.version.empty()) {
        engine["why"] = here.engine->status().why;
        engine["install"] = info.install_hint;
      } else {
        engine["version"] = here.version;
      }
      record["engines"].push_back(std::move(engine));
    }
    record["cells"] = Json::array();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      Json axes = Json::object();
      for (const auto& [name, value] : cells_[i].axes) axes[name] = value;
      record["cells"].push_back({{"id", cells_[i].id}, {"status", status_[i]}, {"axes", axes}});
    }
    write_record(directory_ / "farm.json", record);
  }

  std::size_t count_foreign_cells() const {
    std::set<std::string> ids;
    for (const auto& cell : cells_) ids.insert(cell.id);
    std::size_t foreign = 0;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(directory_ / "cells", ignored))
      if (!ids.contains(entry.path().filename().string())) ++foreign;
    return foreign;
  }

  FarmSummary summarise() {
    summary_.cells = cells_.size();
    for (const CellStore& store : stores_)
      for (const Material& material : store.scene().materials)
        if (std::string text = warning(material.highlight); !text.empty())
          summary_.warnings.insert(std::move(text));
    summary_.foreign = count_foreign_cells();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (status_[i] == "pass") ++summary_.pass;
      if (status_[i] == "differs") ++summary_.differs;
      if (status_[i] == "undecided") ++summary_.undecided;
      if (status_[i] == "unchecked") ++summary_.unchecked;
      if (status_[i] == "failed") ++summary_.failed;
      if (status_[i] == "missing") ++summary_.missing;
      for (const auto& problem : problems_[i])
        summary_.problems.push_back(
            fmt::format("{}: {}: {}", cells_[i].id, problem.engine, problem.message));
    }
    return summary_;
  }

  const Grid& grid_;
  const fs::path directory_;
  const FarmOptions& options_;
  const std::vector<Cell> cells_;
  std::vector<CellStore> stores_;
  std::vector<std::vector<CellProblem>> not_comparable_;  ///< by cell
  std::vector<std::vector<CellProblem>> problems_;        ///< by cell
  std::vector<std::string> status_;                       ///< by cell
  std::vector<EngineHere> engines_;
  ProgressCounter progress_;
  std::mutex mutex_;
  FarmSummary summary_;
};

}  // namespace

FarmSummary run_farm(const Grid& grid, const fs::path& directory, const FarmOptions& options) {
  return Farm(grid, directory, options).run();
}

}  // namespace lobelia
