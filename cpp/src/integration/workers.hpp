#pragma once

#include <functional>

#include "cdcr/types.hpp"

namespace cdcr::detail {

/// Asked by a task, now and then, and before each: whether to go on.
using GoOn = std::function<bool()>;

/// task(i, go_on) for i = 0 to count - 1, shared among so many threads, one of them the caller; as
/// many as there are processors for 0. In the caller alone `progress` is asked, with the number of
/// tasks that have ended: false, or what a task or it throws, ends all. Throws the first of that.
void for_each_task(Index count, int threads,
                   const std::function<void(Index task, const GoOn& go_on)>& task,
                   const std::function<bool(Index ended)>& progress);

}  // namespace cdcr::detail
