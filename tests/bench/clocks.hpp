#pragma once
// What a piece of work costs: wall time and CPU time of all threads or of this one, in seconds.
#include <ctime>

namespace blendwright::bench {

inline double seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Cost {
  double wall = 0.0, cpu = 0.0;
  Cost& operator+=(const Cost& other) {
    wall += other.wall;
    cpu += other.cpu;
    return *this;
  }
};
template <class Work>
Cost cost_of(Work work, clockid_t cpu_clock = CLOCK_PROCESS_CPUTIME_ID) {
  const double wall = seconds(CLOCK_MONOTONIC), cpu = seconds(cpu_clock);
  work();
  return {seconds(CLOCK_MONOTONIC) - wall, seconds(cpu_clock) - cpu};
}

}  // namespace blendwright::bench
