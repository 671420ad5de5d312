#include "implicit/relations/set_relation.hpp"

#include <array>

#include "implicit/relations/box_search.hpp"

namespace blendwright {
namespace {

using detail::Half;

/// "No point is in all of these."
Proof nothing_in(std::span<const Half> halves, const SearchOptions& options, const Progress& progress) {
  const std::optional<Box> domain = detail::search_domain(halves, options);
  if (!domain) return {.answer = Answer::proven, .witness = {}, .undecided = {}, .cells = {}};
  return detail::find_common_point(halves, *domain, options, progress).proof;
}

SetRelation::Kind kind_of(const SetRelation& r) {
  using Kind = SetRelation::Kind;
  if (r.apart.answer == Answer::proven) return Kind::disjoint;
  if (r.first_in_second.answer == Answer::proven) return Kind::first_inside_second;
  if (r.second_in_first.answer == Answer::proven) return Kind::second_inside_first;
  const bool overlap = r.apart.answer == Answer::refuted && r.first_in_second.answer == Answer::refuted &&
                       r.second_in_first.answer == Answer::refuted;
  return overlap ? Kind::overlapping : Kind::undecided;
}

}  // namespace

std::string_view name(SetRelation::Kind kind) {
  constexpr std::array<std::string_view, 5> names{"disjoint", "first inside second", "second inside first",
                                                  "overlapping", "undecided"};
  return names[static_cast<std::size_t>(kind)];
}

Proof is_empty(const ScalarField& solid, const SearchOptions& options, const Progress& progress) {
  const std::array halves{Half{&solid}};
  return nothing_in(halves, options, progress);
}

Proof is_inside(const ScalarField& inner, const ScalarField& outer, const SearchOptions& options,
                const Progress& progress) {
  const std::array halves{Half{&inner}, Half{&outer, true}};
  return nothing_in(halves, options, progress);
}

Proof is_apart(const ScalarField& first, const ScalarField& second, const SearchOptions& options,
               const Progress& progress) {
  const std::array halves{Half{&first}, Half{&second}};
  return nothing_in(halves, options, progress);
}

SetRelation set_relation(const ScalarField& first, const ScalarField& second, const SearchOptions& options,
                         const Progress& progress) {
  // Five searches, each a fifth of the way.
  double done = 0.0;
  Progress part;
  part.stop = progress.stop;
  part.report = [&](double fraction, std::string_view stage) {
    progress.report(done + 0.2 * fraction, stage);
  };
  const auto next = [&](Proof proof) {
    done += 0.2;
    return proof;
  };
  SetRelation r;
  r.first_empty = next(is_empty(first, options, part));
  r.second_empty = next(is_empty(second, options, part));
  r.apart = next(is_apart(first, second, options, part));
  r.first_in_second = next(is_inside(first, second, options, part));
  r.second_in_first = next(is_inside(second, first, options, part));
  r.kind = kind_of(r);
  return r;
}

}  // namespace blendwright
