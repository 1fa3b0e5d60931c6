// How many threads work can have, where the system may allow fewer than there are processors.
#pragma once

namespace lobelia {

/// How many threads could be started just now, at most `wanted`. Starts them, and ends them again: no limit tells how
/// much of it is left.
int startable_threads(int wanted) noexcept;

/// Threads for work, the calling one among them: one for each processor, or fewer where the system does not allow as
/// many as our libraries start then. Looks once.
int usual_threads() noexcept;

}  // namespace lobelia
