#pragma once
// The one door to threads.
#include <cstddef>
#include <functional>

namespace blendwright {

/// Calls body(begin, end) for disjoint chunks of at most `grain` that cover [0, count), on all cores. Chunks
/// depend on count and grain only, so results that are written by index are the same bytes for any number of
/// threads. An exception thrown by a chunk is rethrown here.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// Limits the number of threads while it lives (1 = serial). The default is the number of cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

}  // namespace blendwright
