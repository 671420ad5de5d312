#pragma once
// Objects that calls of one thread keep from call to call. Operations may evaluate other tapes (offsets do),
// so a call may run inside another one: each depth has its own object.
#include <cstddef>
#include <memory>
#include <vector>

namespace blendwright {

/// The T of this depth, while this object lives.
template <class T>
class Nested {
 public:
  Nested() : depth_(places().used++) {
    if (depth_ == places().list.size()) places().list.push_back(std::make_unique<T>());
    mine_ = places().list[depth_].get();
  }
  ~Nested() { --places().used; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;
  T& operator*() const { return *mine_; }

 private:
  struct Places {
    std::vector<std::unique_ptr<T>> list;
    std::size_t used = 0;
  };
  static Places& places() {
    thread_local Places all;
    return all;
  }
  std::size_t depth_;
  T* mine_;
};

}  // namespace blendwright
