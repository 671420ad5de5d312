#pragma once
// The words a job file may use where it chooses: one table per family, read by the job reader, the schema,
// `list` and the report.
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "app/pipeline/job.hpp"

namespace blendwright {

/// One word of a family, what it stands for and what it means.
template <class E>
struct Choice {
  std::string_view name;
  E value;
  std::string_view description;
};

[[nodiscard]] std::span<const Choice<LengthUnit>> unit_choices();
[[nodiscard]] std::span<const Choice<Continuity>> continuity_choices();
[[nodiscard]] std::span<const Choice<TrimlineSpec::Kind>> trimline_choices();
[[nodiscard]] std::span<const Choice<MagnitudeRule>> magnitude_choices();
[[nodiscard]] std::span<const Choice<SideSpec::Keep>> keep_choices();
[[nodiscard]] std::span<const Choice<CorrespondenceRule>> correspondence_choices();
[[nodiscard]] std::span<const Choice<BlendMode>> mode_choices();
[[nodiscard]] std::span<const Choice<BlendFrame>> frame_choices();
[[nodiscard]] std::span<const Choice<SixthOrderFamily>> family_choices();
[[nodiscard]] std::span<const Choice<ObjectiveKind>> objective_choices();
[[nodiscard]] std::span<const Choice<OutputFormat>> format_choices();
[[nodiscard]] std::span<const Choice<StepSchema>> step_schema_choices();

/// The word for a value of a family.
template <class E>
[[nodiscard]] std::string_view word_for(std::span<const Choice<E>> choices, E value) {
  for (const Choice<E>& c : choices)
    if (c.value == value) return c.name;
  return "?";
}

struct Word {
  std::string_view name, description;
};
/// A family without its values: for the schema and for `list`.
struct WordFamily {
  std::string_view name, description;
  std::vector<Word> words;
};
/// Every family above, and the kinds of faces and edges that selectors know.
[[nodiscard]] const std::vector<WordFamily>& word_families();
/// Throws std::out_of_range for an unknown name.
[[nodiscard]] const WordFamily& word_family(std::string_view name);

}  // namespace blendwright
