#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <unordered_map>

#include "implicit/eval/constant.hpp"
#include "implicit/eval/slots.hpp"
#include "implicit/eval/tape.hpp"
#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

constexpr StepIndex none = std::numeric_limits<StepIndex>::max();

/// Mixes another number into a hash (the multiplier of splitmix64).
std::uint64_t mixed(std::uint64_t hash, std::uint64_t x) {
  hash = (hash ^ x) * 0xbf58476d1ce4e5b9ull;
  return hash ^ (hash >> 29);
}
std::uint64_t bits(double x) {
  std::uint64_t b = 0;
  std::memcpy(&b, &x, sizeof b);
  return b;
}
std::uint64_t bits(const void* p) { return static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(p)); }

/// Steps as they go on a tape: with builder numbering still, but merged.
struct MergedSteps {
  std::vector<Tape::Step> steps;  ///< by builder index
  std::vector<StepIndex> args;
  std::vector<Frame> frames;
  std::vector<std::shared_ptr<const void>> bodies;
  std::vector<StepIndex> into;  ///< the step that it was merged into, or none

  [[nodiscard]] std::span<const StepIndex> args_of(StepIndex i) const {
    return std::span(args).subspan(steps[i].first_arg, steps[i].arg_count);
  }
  bool merge(Tape::Step& step, StepIndex inner_index, std::size_t which) {
    const Tape::Step& inner = steps[inner_index];
    if (inner.arg_count > 0 || !inner.body) return false;
    Merged both = step.op->merge(step.body, which, *inner.op, inner.body);
    if (!both.op) return false;
    const Frame frame = inner.frame < 0 ? Frame{} : frames[static_cast<std::size_t>(inner.frame)];
    step.op = both.op;
    step.body = both.body.get();
    step.frame = inner.frame;
    if (both.scale != Vec3::Ones()) {
      step.frame = static_cast<std::int32_t>(frames.size());
      frames.push_back(frame.scaled(both.scale));
    }
    bodies.push_back(std::move(both.body));
    return true;
  }
  /// The last of a chain of mergers.
  [[nodiscard]] StepIndex final_step(StepIndex i) const {
    while (into[i] != none) i = into[i];
    return i;
  }
};

}  // namespace

struct TapeBuilder::State {
  struct Entry {
    Tape::Step step;
    std::shared_ptr<const void> body;
  };
  std::vector<Entry> entries;
  std::vector<StepIndex> args;
  std::vector<Frame> frames;
  std::vector<TapeMember> members;
  std::unordered_multimap<std::uint64_t, StepIndex> known_steps;
  std::unordered_multimap<std::uint64_t, std::int32_t> known_frames;

  std::int32_t frame_index(const Frame& frame);
  StepIndex step_index(Tape::Step step, std::shared_ptr<const void> body,
                       std::span<const StepIndex> its_args);
  [[nodiscard]] bool same(const Tape::Step& a, const Tape::Step& b, std::span<const StepIndex> b_args) const;
  [[nodiscard]] std::span<const StepIndex> args_of(StepIndex i) const {
    return std::span(args).subspan(entries[i].step.first_arg, entries[i].step.arg_count);
  }
  [[nodiscard]] std::vector<StepIndex> visiting_order() const;
  [[nodiscard]] std::vector<StepIndex> order_for(StepIndex result) const;
  [[nodiscard]] MergedSteps merged(const std::vector<StepIndex>& order) const;
};

std::int32_t TapeBuilder::State::frame_index(const Frame& frame) {
  if (frame.identity) return -1;
  std::uint64_t hash = 0;
  for (int i = 0; i < 9; ++i) hash = mixed(hash, bits(frame.matrix.data()[i]));
  for (int i = 0; i < 3; ++i) hash = mixed(hash, bits(frame.offset[i]));
  const auto [first, last] = known_frames.equal_range(hash);
  for (auto it = first; it != last; ++it)
    if (frames[static_cast<std::size_t>(it->second)] == frame) return it->second;
  frames.push_back(frame);
  const auto index = static_cast<std::int32_t>(frames.size() - 1);
  known_frames.emplace(hash, index);
  return index;
}

bool TapeBuilder::State::same(const Tape::Step& a, const Tape::Step& b,
                              std::span<const StepIndex> b_args) const {
  return a.op == b.op && a.body == b.body && bits(a.constant) == bits(b.constant) && a.frame == b.frame &&
         std::ranges::equal(std::span(args).subspan(a.first_arg, a.arg_count), b_args);
}

StepIndex TapeBuilder::State::step_index(Tape::Step step, std::shared_ptr<const void> body,
                                         std::span<const StepIndex> its_args) {
  std::uint64_t hash = mixed(mixed(bits(step.op), bits(step.body)), bits(step.constant));
  hash = mixed(hash, static_cast<std::uint64_t>(step.frame));
  for (const StepIndex a : its_args) hash = mixed(hash, a);
  const auto [first, last] = known_steps.equal_range(hash);
  for (auto it = first; it != last; ++it)
    if (same(entries[it->second].step, step, its_args)) return it->second;
  step.first_arg = static_cast<std::uint32_t>(args.size());
  step.arg_count = static_cast<std::uint32_t>(its_args.size());
  args.insert(args.end(), its_args.begin(), its_args.end());
  entries.push_back({step, std::move(body)});
  const auto index = static_cast<StepIndex>(entries.size() - 1);
  known_steps.emplace(hash, index);
  return index;
}

/// The arguments of every step in the order in which they are best computed: the one that needs the most
/// results at a time first.
std::vector<StepIndex> TapeBuilder::State::visiting_order() const {
  std::vector<StepIndex> order = args;
  std::vector<std::uint32_t> need(entries.size(), 1);
  for (StepIndex i = 0; i < entries.size(); ++i) {
    const auto mine = std::span(order).subspan(entries[i].step.first_arg, entries[i].step.arg_count);
    std::ranges::stable_sort(mine, [&](StepIndex a, StepIndex b) { return need[a] > need[b]; });
    for (std::uint32_t k = 0; k < mine.size(); ++k) need[i] = std::max(need[i], need[mine[k]] + k);
  }
  return order;
}

/// The steps that `result` needs, arguments before users.
std::vector<StepIndex> TapeBuilder::State::order_for(StepIndex result) const {
  const std::vector<StepIndex> visiting = visiting_order();
  std::vector<bool> done(entries.size(), false);
  struct Open {
    StepIndex step;
    std::uint32_t next;
  };
  std::vector<Open> open{{result, 0}};
  std::vector<StepIndex> order;
  while (!open.empty()) {
    Open& top = open.back();
    const Tape::Step& step = entries[top.step].step;
    if (top.next < step.arg_count) {
      const StepIndex a = visiting[step.first_arg + top.next++];
      if (!done[a]) open.push_back({a, 0});
    } else {
      done[top.step] = true;
      order.push_back(top.step);
      open.pop_back();
    }
  }
  return order;
}

TapeBuilder::TapeBuilder() : state_(std::make_unique<State>()) {}
TapeBuilder::~TapeBuilder() = default;

StepIndex TapeBuilder::add(const Op& op, std::shared_ptr<const void> body, const Frame& frame,
                           std::span<const StepIndex> args) {
  for (const StepIndex a : args)
    if (a >= state_->entries.size())
      throw InputError("args", "has step " + std::to_string(a) + ", must be a step of this tape, which has " +
                                   std::to_string(state_->entries.size()));
  const void* place = body.get();
  return state_->step_index({&op, place, 0.0, state_->frame_index(frame), 0, 0, 0}, std::move(body), args);
}

StepIndex TapeBuilder::constant(double c) {
  return state_->step_index({&detail::constant_op(), nullptr, c, -1, 0, 0, 0}, nullptr, {});
}

void TapeBuilder::member(TapeMember member) { state_->members.push_back(member); }

/// Merges what can be merged among the steps in `order`.
MergedSteps TapeBuilder::State::merged(const std::vector<StepIndex>& order) const {
  MergedSteps m{
      std::vector<Tape::Step>(entries.size()), {}, frames, {}, std::vector<StepIndex>(entries.size(), none)};
  std::vector<std::uint32_t> uses(entries.size(), 0);
  for (const StepIndex i : order)
    for (const StepIndex a : args_of(i)) ++uses[a];
  std::vector<StepIndex> its_args;
  for (const StepIndex i : order) {
    Tape::Step step = entries[i].step;
    if (entries[i].body) m.bodies.push_back(entries[i].body);
    its_args.assign(args_of(i).begin(), args_of(i).end());
    for (std::size_t which = step.op->merge ? its_args.size() : 0; which-- > 0;) {
      const StepIndex a = its_args[which];
      if (uses[a] != 1 || !m.merge(step, a, which)) continue;
      m.into[a] = i;
      its_args.erase(its_args.begin() + static_cast<std::ptrdiff_t>(which));
      break;
    }
    step.first_arg = static_cast<std::uint32_t>(m.args.size());
    step.arg_count = static_cast<std::uint32_t>(its_args.size());
    m.args.insert(m.args.end(), its_args.begin(), its_args.end());
    m.steps[i] = step;
  }
  return m;
}

std::shared_ptr<const Tape> TapeBuilder::finish(StepIndex result) {
  const State& s = *state_;
  if (result >= s.entries.size()) throw InputError("result", "is not a step of this tape");
  const std::vector<StepIndex> order = s.order_for(result);
  MergedSteps merged = s.merged(order);
  const auto owned = std::make_shared<Tape::Owned>(Tape::Owned{std::move(merged.bodies), merged.frames});
  const std::shared_ptr<Tape> tape(new Tape);
  std::vector<std::int32_t> frame_place(owned->frames.size(), -1);
  const auto place_of_frame = [&](std::int32_t frame) {
    if (frame < 0) return frame;
    const auto f = static_cast<std::size_t>(frame);
    if (frame_place[f] < 0) {
      frame_place[f] = static_cast<std::int32_t>(tape->frames_.size());
      tape->frames_.push_back(&owned->frames[f]);
    }
    return frame_place[f];
  };
  std::vector<StepIndex> place(s.entries.size(), none);
  for (const StepIndex i : order) {
    if (merged.into[i] != none) continue;
    place[i] = static_cast<StepIndex>(tape->steps_.size());
    Tape::Step step = merged.steps[i];
    step.first_arg = static_cast<std::uint32_t>(tape->args_.size());
    for (const StepIndex a : merged.args_of(i)) tape->args_.push_back(place[a]);
    step.frame = place_of_frame(step.frame);
    tape->steps_.push_back(step);
  }
  for (const TapeMember& m : s.members) {
    if (m.step >= place.size()) continue;
    const StepIndex last = merged.final_step(m.step);
    if (place[last] == none) continue;
    Tape::Member member{{place[last], m.level, m.index}};
    if (last != m.step) {
      member.leaf = merged.steps[m.step];
      member.leaf.frame = place_of_frame(member.leaf.frame);
    }
    tape->members_.push_back(member);
  }
  std::ranges::stable_sort(tape->members_, {}, [](const Tape::Member& m) { return m.at.step; });
  tape->owned_ = owned;
  std::vector<StepIndex> last_use;
  std::vector<std::uint32_t> free;
  tape->slots_ = detail::assign_slots(tape->steps_, tape->args_, last_use, free);
  return tape;
}

}  // namespace blendwright
