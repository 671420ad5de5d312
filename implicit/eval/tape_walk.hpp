#pragma once
// What walks over a tape share.
#include <vector>

#include "implicit/eval/nested.hpp"
#include "implicit/eval/tape.hpp"

namespace blendwright {

/// What a walk over a tape finds out about a box; kept (see Nested), so that a walk allocates nothing.
struct Tape::Walk {
  std::vector<Box> boxes;           ///< of the frames
  std::vector<Range> ranges;        ///< of the steps
  std::vector<StepIndex> stand_in;  ///< the step that it equals on the box; itself: none
  std::vector<bool> constant;       ///< whether it is a constant on the box, though its operation is not
  std::vector<Range> args;
  bool shorter = false;

  std::vector<LinearBound> linear;  ///< of the steps
  std::vector<LinearBound> linear_args;

  std::vector<StepIndex> place;  ///< in the shortened tape
  std::vector<std::int32_t> frame_place;
  std::vector<StepIndex> last_use;
  std::vector<std::uint32_t> free;

  /// The place of a frame among those that are kept, which it joins.
  std::int32_t kept_frame(std::int32_t frame, const std::vector<const Frame*>& frames,
                          std::vector<const Frame*>& kept) {
    if (frame < 0) return frame;
    const auto f = static_cast<std::size_t>(frame);
    if (frame_place[f] < 0) {
      frame_place[f] = static_cast<std::int32_t>(kept.size());
      kept.push_back(frames[f]);
    }
    return frame_place[f];
  }
};

}  // namespace blendwright
