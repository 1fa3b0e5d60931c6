// Our own renderer in the place of an engine that is not ours.
#pragma once

#include "reference_scenes/engine.hpp"
#include "reference_scenes/engine_program.hpp"
#include "renderer/render.hpp"
#include "tests/json.hpp"

namespace lobelia {

class OurselvesAsAnEngine final : public Engine {
 public:
  const EngineInfo& info() const override {
    static constexpr EngineInfo kInfo{"lobelia", "Lobelia", "", "", "", "", "", "float"};
    return kInfo;
  }
  const EngineStatus& status() override {
    status_.state = EngineState::kReady;
    return status_;
  }

 protected:
  std::string why_not_simple(const Scene&, const ReferenceOptions&) const override { return {}; }
  void render_simple(std::span<const Scene> scenes, const ReferenceOptions&,
                     const OnResult& on_result) override {
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      ReferenceResult result;
      result.image = lobelia::render(scenes[i], {}).image;
      result.record = reference_record(info(), status_, scenes[i]);
      result.record.method = "ours";
      result.record.passes = 1;
      on_result(i, std::move(result));
    }
  }

 private:
  EngineStatus status_;
};

}  // namespace lobelia
