// Many scenes by one engine.
#pragma once

#include <functional>
#include <mutex>
#include <span>

#include "reference_scenes/at_once.hpp"
#include "reference_scenes/engine.hpp"

namespace lobelia {

/// Calls `take` with each scene's number and result, never two at once.
inline void render_all(Engine& engine, std::span<const Scene> scenes, ReferenceOptions options,
                       const std::function<void(std::size_t, ReferenceResult)>& take) {
  options.scenes = scenes.size();
  Session session(engine, options);
  std::mutex mutex;
  for_each_at_once(
      scenes.size(), session.at_once(),
      [&](std::size_t i) {
        ReferenceResult result = session.render(scenes[i]);
        const std::scoped_lock lock(mutex);
        take(i, std::move(result));
      },
      [&] { session.stop(); });
}

}  // namespace lobelia
