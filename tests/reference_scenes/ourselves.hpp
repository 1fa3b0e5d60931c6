// Our own renderer in the place of an engine that is not ours.
#pragma once

#include "reference_scenes/engine.hpp"
#include "reference_scenes/engine_program.hpp"
#include "renderer/render.hpp"

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
  std::unique_ptr<SimpleSession> open_simple(const ReferenceOptions&) override {
    return std::make_unique<OurSession>(*this);
  }

 private:
  class OurSession final : public SimpleSession {
   public:
    explicit OurSession(const OurselvesAsAnEngine& engine) : engine_(engine) {}
    int at_once(std::size_t) const override { return 1; }
    void stop() override {}
    ReferenceResult render(const Scene& scene, std::size_t) override {
      ReferenceResult result;
      result.image = lobelia::render(scene, {}).image;
      result.record = reference_record(engine_.info(), engine_.status_, scene);
      result.record.method = "ours";
      result.record.passes = 1;
      return result;
    }

   private:
    const OurselvesAsAnEngine& engine_;
  };
  EngineStatus status_;
};

}  // namespace lobelia
